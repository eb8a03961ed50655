"""The cut lower end of a bust: found, so that it can fade away instead of ending like a mistake."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float32, Int32, distinct
from facemorph.core.mesh import Mesh

LOW_PART = 0.25  # of the height: a cut that reaches higher is the rim of a mask, not of a bust
FADE = 0.15  # of the height: how long the fade is
WIDE_ENOUGH = 0.3  # of the box's width: smaller holes are no cut through a neck or chest
_MOST_RIM_POINTS = 400


@dataclass(frozen=True, eq=False)
class Hem:
    """The cut: `kept` (V,) float32, 0 at it to 1 away from it; `triangles` (T,) bool, those that fade."""

    kept: Float32
    triangles: Bool


def hem_of(mesh: Mesh, triangles: Int32, apart: Bool | None = None) -> Hem | None:
    """The hem of `mesh`, or None where it has no open lower end.

    Triangles `apart` (T,) are no part of the bust: hair that hangs down to its shoulders. A bust is open
    along edges of one triangle only, all of them in the lowest quarter of its height.
    """
    low, high = (float(value) for value in mesh.bounds[:, 1])
    height = high - low
    if not len(triangles) or not height > 0.0:
        return None
    below = mesh.positions[:, 1] < low + LOW_PART * height
    own = np.ones(len(triangles), bool) if apart is None else ~apart
    rim = _open_edges(triangles[below[triangles].any(axis=1) & own], below, mesh.vertex_count)
    if not len(rim) or not below[rim].all():
        return None
    points = mesh.positions[distinct(rim)]
    if float(np.ptp(points[:, 0])) < WIDE_ENOUGH * float(np.ptp(mesh.positions[:, 0])):
        return None
    kept = np.ones(mesh.vertex_count, np.float32)
    near = np.flatnonzero(mesh.positions[:, 1] < float(points[:, 1].max()) + FADE * height)
    kept[near] = np.minimum(_distance_to(points, mesh.positions[near]) / (FADE * height), 1.0)
    return Hem(kept, np.asarray((kept < 1.0)[triangles].any(axis=1) & own))


def _distance_to(points: Float32, positions: Float32) -> Float32:
    """From each position (n, 3) to the nearest of the points, (n,)."""
    points = points[:: max(len(points) // _MOST_RIM_POINTS, 1)]
    nearest = np.full(len(positions), np.inf, np.float32)
    for point in points:
        away = positions - point
        np.minimum(nearest, np.einsum("ni,ni->n", away, away), out=nearest)
    return np.asarray(np.sqrt(nearest), np.float32)


def _open_edges(triangles: Int32, below: Bool, vertex_count: int) -> Int32:
    """Edges (E, 2) of one triangle only, of those that touch a vertex `below` the line."""
    pairs = [triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]
    edges = np.concatenate(pairs).astype(np.int64)
    edges = edges[below[edges].any(axis=1)]
    edges.sort(axis=1)
    keys, count = np.unique(edges[:, 0] * vertex_count + edges[:, 1], return_counts=True)
    lonely = keys[count == 1]
    return np.stack([lonely // vertex_count, lonely % vertex_count], axis=1).astype(np.int32)
