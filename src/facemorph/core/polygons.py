"""A mesh with some of its polygons: the vertices, and what they are numbered by, stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Bool, Int32
from facemorph.core.mesh import Labels, Mesh


def with_polygons(mesh: Mesh, kept: Bool) -> Mesh:
    """`mesh` with the polygons that `kept` (P,) says, in their order; all V vertices stay where they are."""
    sizes = np.diff(mesh.polygon_starts)
    corners = np.repeat(kept, sizes)
    starts = np.concatenate([[0], np.cumsum(sizes[kept])]).astype(np.int32)
    return replace(
        mesh,
        polygon_starts=starts,
        corner_vertices=mesh.corner_vertices[corners],
        corner_uvs=_some(mesh.corner_uvs, corners),
        corner_normals=_some(mesh.corner_normals, corners),
        groups=_labelled(mesh.groups, kept),
        objects=_labelled(mesh.objects, kept),
        materials_used=_labelled(mesh.materials_used, kept),
    )


def _some(index: Int32 | None, kept: Bool) -> Int32 | None:
    return None if index is None else index[kept]


def _labelled(labels: Labels | None, kept: Bool) -> Labels | None:
    return None if labels is None else Labels(labels.names, labels.index[kept])
