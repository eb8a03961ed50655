"""Vertices as a graphics card wants them: split where a position has several texture coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.core.mesh import Mesh
from facemorph.core.triangles import Triangles


@dataclass(frozen=True, eq=False)
class SplitVertices:
    """G drawn vertices derived from V positions.

    position_of  (G,) int32, the position each drawn vertex is a copy of: the map back
    uvs          (G, 2) float32, (0, 0) where the file has none
    triangles    (T, 3) int32 over the drawn vertices
    """

    position_of: Int32
    uvs: Float32
    triangles: Int32


def split_vertices(mesh: Mesh, triangles: Triangles) -> SplitVertices:
    """One drawn vertex for each pair of position and texture coordinate that a triangle uses."""
    position = mesh.corner_vertices[triangles.corners].astype(np.int64)
    if mesh.corner_uvs is None or not len(mesh.uvs):
        uv = np.full_like(position, -1)
    else:
        uv = mesh.corner_uvs[triangles.corners].astype(np.int64)
    width = len(mesh.uvs) + 1
    pairs, drawn = np.unique(position * width + (uv + 1), return_inverse=True)
    position_of, uv_of = np.divmod(pairs, width)
    uvs = np.concatenate([np.zeros((1, 2), np.float32), mesh.uvs])[uv_of]
    return SplitVertices(
        position_of.astype(np.int32),
        np.ascontiguousarray(uvs, np.float32),
        drawn.reshape(position.shape).astype(np.int32),
    )
