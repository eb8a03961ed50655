"""The cut lower end of a bust: found, so that it can fade away instead of ending like a mistake."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Int32
from facemorph.core.mesh import Mesh

LOW_PART = 0.25  # of the height: a cut that reaches higher is the rim of a mask, not of a bust
FADE = 0.10  # of the height: how long the fade is
WIDE_ENOUGH = 0.3  # of the box's width: smaller holes are no cut through a neck or chest


@dataclass(frozen=True, eq=False)
class Hem:
    """Heights (model units) between which the surface fades in, and the triangles (T,) bool it touches."""

    low: float
    high: float
    triangles: Bool


def hem_of(mesh: Mesh, triangles: Int32) -> Hem | None:
    """The hem of `mesh`, or None where it has no open lower end.

    A bust is open along edges of one triangle only, all of them in the lowest quarter of its height.
    """
    if not len(triangles):
        return None
    low, high = (float(value) for value in mesh.bounds[:, 1])
    height = high - low
    line = low + LOW_PART * height
    if height <= 0.0:
        return None
    below = mesh.positions[:, 1] < line
    rim = _open_edges(triangles[below[triangles].any(axis=1)], below, mesh.vertex_count)
    if not len(rim) or not below[rim].all():
        return None
    points = mesh.positions[np.unique(rim)]
    width = float(np.ptp(mesh.positions[:, 0]))
    if float(np.ptp(points[:, 0])) < WIDE_ENOUGH * width:
        return None
    start = min(float(points[:, 1].max()), low + 0.06 * height)
    end = start + FADE * height
    lowly = mesh.positions[:, 1] < end + 0.05 * height
    touched: Bool = np.asarray(lowly[triangles].any(axis=1))
    return Hem(start, end, touched)


def _open_edges(triangles: Int32, below: Bool, vertex_count: int) -> Int32:
    """Edges (E, 2) of one triangle only, of those that touch a vertex `below` the line."""
    pairs = [triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]
    edges = np.concatenate(pairs).astype(np.int64)
    edges = edges[below[edges].any(axis=1)]
    edges.sort(axis=1)
    keys, count = np.unique(edges[:, 0] * vertex_count + edges[:, 1], return_counts=True)
    lonely = keys[count == 1]
    return np.stack([lonely // vertex_count, lonely % vertex_count], axis=1).astype(np.int32)
