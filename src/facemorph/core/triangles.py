"""Polygons into triangles, with the way back: which polygon and which corners each triangle came from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int32, Int64, distinct
from facemorph.core.mesh import Mesh

_CUT_BUDGET = 2e7
"""Most work for cutting a mesh's concave polygons, in cubes of their corners; what is beyond stays fans.

A polygon of 250 corners, or a thousand of 25, take a third of a second.
"""


@dataclass(frozen=True, eq=False)
class Triangles:
    """T triangles of a mesh's polygons.

    corners   (T, 3) int32, indices into the mesh's corner arrays
    polygon   (T,) int32, the polygon each triangle is part of
    vertices  (T, 3) int32, indices into the mesh's positions
    """

    corners: Int32
    polygon: Int32
    vertices: Int32


def triangulated(mesh: Mesh) -> Triangles:
    """Triangles of `mesh` in the polygons' order; concave polygons are cut inside their outline.

    Polygons of fewer than three corners give none.
    """
    starts = mesh.polygon_starts.astype(np.int64)
    sizes = np.diff(starts)
    fans = np.maximum(sizes - 2, 0)
    polygon = np.repeat(np.arange(len(sizes)), fans)
    nth = np.arange(len(polygon)) - np.repeat(np.cumsum(fans) - fans, fans)
    first = starts[polygon]
    corners = np.stack([first, first + nth + 1, first + nth + 2], axis=1)
    _cut_concave(mesh, corners, starts, sizes, np.cumsum(fans) - fans)
    corners32 = corners.astype(np.int32)
    return Triangles(corners32, polygon.astype(np.int32), mesh.corner_vertices[corners32])


def _cut_concave(mesh: Mesh, corners: Int64, starts: Int64, sizes: Int64, offsets: Int64) -> None:
    """Replace the fans of concave polygons in `corners`, in place."""
    concave = np.flatnonzero(_concave(mesh, starts, sizes))
    smallest_first = concave[np.argsort(sizes[concave], kind="stable")]
    work = np.cumsum(sizes[smallest_first].astype(np.float64) ** 3)
    for p in smallest_first[work <= _CUT_BUDGET]:
        size, start = int(sizes[p]), int(starts[p])
        outline = mesh.positions[mesh.corner_vertices[start : start + size]].astype(np.float64)
        cut = _ear_clipped(_projected(outline))
        corners[offsets[p] : offsets[p] + size - 2] = np.asarray(cut) + start


def _concave(mesh: Mesh, starts: Int64, sizes: Int64) -> Bool:
    """Polygons with a corner that turns against the polygon's own normal, (P,) bool."""
    result = np.zeros(len(sizes), bool)
    for size in distinct(sizes[sizes > 3]):
        chosen = np.flatnonzero(sizes == size)
        ring = mesh.corner_vertices[starts[chosen][:, None] + np.arange(size)]
        points = mesh.positions[ring].astype(np.float64)
        points /= max(float(np.abs(points).max()), 1e-30)
        before = points - np.roll(points, 1, axis=1)
        after = np.roll(points, -1, axis=1) - points
        normal = np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1)
        turn = np.einsum("pci,pi->pc", np.cross(before, after), normal)
        result[chosen] = (turn < -1e-9 * np.abs(turn).max(axis=1, keepdims=True)).any(axis=1)
    return result


def _projected(outline: Float64) -> Float64:
    """The outline (n, 3) seen along its own normal, counter-clockwise, (n, 2)."""
    centred = outline - outline.mean(axis=0)
    centred /= max(float(np.abs(centred).max()), 1e-30)
    normal = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    u, v = (axis + 1) % 3, (axis + 2) % 3
    flat: Float64 = centred[:, [u, v]]
    if normal[axis] < 0:
        flat[:, 1] *= -1.0
    return flat


def _ear_clipped(points: Float64) -> list[tuple[int, int, int]]:
    """Triangles of a simple polygon (n, 2) by ear clipping; a tangled one falls back to a fan."""
    ring = list(range(len(points)))
    triangles: list[tuple[int, int, int]] = []
    while len(ring) > 3:
        ear = next((i for i in range(len(ring)) if _is_ear(points, ring, i)), 1)
        triangles.append((ring[ear - 1], ring[ear], ring[(ear + 1) % len(ring)]))
        del ring[ear]
    triangles.append((ring[0], ring[1], ring[2]))
    return triangles


def _is_ear(points: Float64, ring: list[int], i: int) -> bool:
    a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
    if _cross(points[a], points[b], points[c]) <= 0:
        return False
    others = [k for k in ring if k not in (a, b, c)]
    return not any(_inside(points[k], points[a], points[b], points[c]) for k in others)


def _inside(p: Float64, a: Float64, b: Float64, c: Float64) -> bool:
    return _cross(a, b, p) >= 0 and _cross(b, c, p) >= 0 and _cross(c, a, p) >= 0


def _cross(a: Float64, b: Float64, c: Float64) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
