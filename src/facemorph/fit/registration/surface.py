"""A scan's surface, bound once: nearest places on its triangles, their normals, its borders.

Candidates come from trees over sample points (every triangle's middle, and more on large triangles); the
distance to each candidate's triangle is exact. With normals the tree has six dimensions, position and
scaled normal: the two lips lie on each other but face each other, so in it they are far apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int64
from facemorph.fit.registration.triangle_points import nearest_in_triangles

_CHUNK = 4096
_CANDIDATES = (12, 32, 96)
# Triangles with edges longer than this many times the usual get samples of their own inside.
_LONG = 1.5
_MOST_CUTS = 24
_MOST_EXTRA_SAMPLES = 400_000


@dataclass(frozen=True, eq=False)
class Hits:
    """The nearest places on a scan of N points.

    points     (N, 3), on the scan's surface
    normals    (N, 3), unit, the scan's there
    distances  (N,)
    border     (N,) whether the place lies on an open edge of the scan
    triangles  (N,) which of the surface's triangles it is on, weights (N, 3) where on it
    """

    points: Float64
    normals: Float64
    distances: Float64
    border: Bool
    triangles: Int64
    weights: Float64


class ScanSurface:
    """Triangles (T, 3) over points (V, 3) float64; normals point out of the side they are wound for.

    Triangles without area are left out. `turn` is the length that counts as much as a difference of 1
    between unit normals (a turn by 60 degrees) where the nearest place with a like normal is asked for.
    `outward` is -1 for a scan that is wound inside out.
    """

    def __init__(self, points: Float64, triangles: Int64, turn: float, outward: float = 1.0) -> None:
        self.points, self.turn = points, turn
        first, second, third = (points[triangles[:, corner]] for corner in range(3))
        areas = outward * np.cross(second - first, third - first)
        lengths = np.linalg.norm(areas, axis=1)
        kept = np.flatnonzero(lengths > 0.0)
        self.triangles = triangles[kept]
        self.face_normals = areas[kept] / lengths[kept, None]
        self._welded = welded(points)[self.triangles]
        self._normals = normals_of(self._welded, areas[kept], len(points))
        self._open_edge, self._open_vertex = borders(self._welded, len(points))

    @cached_property
    def _samples(self) -> tuple[Float64, Int64, Float64]:
        """Sample points (S, 3), the triangle of each (S,), and how far what it stands for reaches (S,)."""
        corners = self.points[self.triangles]
        return _samples(corners)

    @cached_property
    def _tree(self) -> Any:
        return _tree_of(self._samples[0])

    @cached_property
    def _turning_tree(self) -> Any:
        places, triangle, _ = self._samples
        normals = self._normals[self._welded].mean(axis=1)
        return _tree_of(np.concatenate([places, self.turn * normals[triangle]], axis=1))

    def nearest(self, points: Float64, *, exact: bool = True) -> Hits:
        """The nearest places of points (N, 3); not `exact`: among the triangles whose samples are nearest."""
        triangle = np.zeros(len(points), np.int64)
        weights = np.zeros((len(points), 3))
        least = np.full(len(points), np.inf)
        _, owner, reach = self._samples
        open_rows: Int64 = np.arange(len(points))
        for count in _CANDIDATES[: None if exact else 1]:
            count = min(count, len(owner))
            unproven = [open_rows[:0]]
            for rows in _chunks(open_rows):
                far, found = self._tree.query(points[rows], k=count)
                far, found = far.reshape(len(rows), -1), found.reshape(len(rows), -1)
                # A triangle nearer than the best has a sample within that distance and its own reach.
                row, place = np.nonzero(far - reach[found] < least[rows, None])
                asked = owner[found[row, place]]
                where, square, _ = self._costs(points[rows[row]], asked)
                better = _least_of_each(row, square)
                done = rows[row[better]]
                nearer = np.sqrt(square[better]) < least[done]
                done, better = done[nearer], better[nearer]
                triangle[done], weights[done], least[done] = (
                    asked[better],
                    where[better],
                    np.sqrt(square[better]),
                )
                unproven.append(rows[(far[:, -1] < least[rows] + reach.max()) & (count < len(owner))])
            open_rows = np.concatenate(unproven)
            if not len(open_rows):
                break
        return self._hits(points, triangle, weights)

    def nearest_alike(self, points: Float64, normals: Float64, candidates: int = 6) -> Hits:
        """The nearest places whose normals turn little from `normals` (N, 3), among so many candidates."""
        triangle = np.zeros(len(points), np.int64)
        weights = np.zeros((len(points), 3))
        owner = self._samples[1]
        count = min(candidates, len(owner))
        for rows in _chunks(np.arange(len(points))):
            asked = np.concatenate([points[rows], self.turn * normals[rows]], axis=1)
            _, found = self._turning_tree.query(asked, k=count)
            candidates_of = owner[found.reshape(-1)]
            row = np.repeat(np.arange(len(rows)), count)
            where, _, cost = self._costs(points[rows[row]], candidates_of, normals[rows[row]])
            best = _least_of_each(row, cost)
            triangle[rows], weights[rows] = candidates_of[best], where[best]
        return self._hits(points, triangle, weights)

    def _costs(
        self, points: Float64, triangles: Int64, normals: Float64 | None = None
    ) -> tuple[Float64, Float64, Float64]:
        """Of points (n, 3), a triangle for each (n,): where on it (n, 3), the squared distance, the cost."""
        corners = self.points[self.triangles[triangles]]
        weights = nearest_in_triangles(points, corners)
        square = ((np.einsum("nc,nci->ni", weights, corners) - points) ** 2).sum(axis=1)
        if normals is None:
            return weights, square, square
        turned = ((self._normals_at(triangles, weights) - normals) ** 2).sum(axis=1)
        return weights, square, square + self.turn**2 * turned

    def _normals_at(self, triangles: Int64, weights: Float64) -> Float64:
        summed = np.einsum("nc,nci->ni", weights, self._normals[self._welded[triangles]])
        return unit(summed)

    def _hits(self, points: Float64, triangles: Int64, weights: Float64) -> Hits:
        found = np.einsum("nc,nci->ni", weights, self.points[self.triangles[triangles]])
        return Hits(
            found,
            self._normals_at(triangles, weights),
            np.linalg.norm(found - points, axis=1),
            self._on_border(triangles, weights),
            triangles,
            weights,
        )

    def _on_border(self, triangles: Int64, weights: Float64) -> Bool:
        # Edge e of a triangle lies opposite to its corner (e + 2) % 3.
        opposite = np.roll(weights, 1, axis=1) < 1e-9
        edge = (self._open_edge[triangles] & opposite).any(axis=1)
        corner = (self._open_vertex[self._welded[triangles]] & (weights > 1.0 - 1e-9)).any(axis=1)
        return np.asarray(edge | corner)


def _least_of_each(row: Int64, cost: Float64) -> Int64:
    """The place of the least cost (n,) of each row; `row` (n,) is sorted."""
    first = np.flatnonzero(np.r_[True, row[1:] != row[:-1]])
    order = np.lexsort((cost, row))
    return np.asarray(order[first])


def unit(vectors: Float64) -> Float64:
    """Vectors (N, 3) at length 1; those of length 0 stay."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(length, 1e-300))


def welded(points: Float64) -> Int64:
    """For each point (V, 3) the first one at the same place, (V,): files often split vertices at seams."""
    order = np.lexsort(points.T)
    ranked = points[order]
    new = np.r_[True, (ranked[1:] != ranked[:-1]).any(axis=1)]
    first = order[np.flatnonzero(new)][np.cumsum(new) - 1]
    result = np.empty(len(points), np.int64)
    result[order] = first
    return result


def normals_of(triangles: Int64, areas: Float64, count: int) -> Float64:
    """Unit normals (V, 3) from the triangles' area vectors (T, 3)."""
    sums = np.stack(
        [sum(np.bincount(triangles[:, c], areas[:, a], minlength=count) for c in range(3)) for a in range(3)],
        axis=1,
    )
    return unit(sums)


def borders(triangles: Int64, count: int) -> tuple[Bool, Bool]:
    """Which edges (T, 3) only one triangle has (edge e runs from corner e to the next), and vertices (V,)."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    keys = ends.min(axis=1) * count + ends.max(axis=1)
    _, place, uses = np.unique(keys, return_inverse=True, return_counts=True)
    alone = uses[place.reshape(-1)] == 1
    vertex = np.zeros(count, bool)
    vertex[ends[alone].ravel()] = True
    return alone.reshape(-1, 3), vertex


def _samples(corners: Float64) -> tuple[Float64, Int64, Float64]:
    """Points (S, 3) on triangles (T, 3, 3), the triangle of each, and the reach of each within its own."""
    longest = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1)
    usual = float(np.median(longest))
    cuts = np.clip(np.ceil(longest / max(_LONG * usual, 1e-300)), 1, _MOST_CUTS).astype(np.int64)
    by_need = np.argsort(-cuts, kind="stable")
    cuts[by_need[np.cumsum(cuts[by_need] ** 2 - 1) > _MOST_EXTRA_SAMPLES]] = 1
    places, owners = [], []
    for n in np.unique(cuts).tolist():
        chosen = np.flatnonzero(cuts == n)
        weights = _middles(n)
        places.append(np.einsum("sc,tci->tsi", weights, corners[chosen]).reshape(-1, 3))
        owners.append(np.repeat(chosen, len(weights)))
    # Within each piece no place is farther from the middle than two thirds of its longest side.
    owner = np.concatenate(owners)
    return np.concatenate(places), owner, (longest / cuts)[owner] * 2.0 / 3.0


def _middles(n: int) -> Float64:
    """The middles of the n * n equal pieces of a triangle, barycentric (n * n, 3)."""
    i, j = np.divmod(np.arange(n * n), n)
    upright = i + j < n
    # The other half of the square of pieces holds those that stand on their tips.
    a = np.where(upright, 3 * i + 1, 3 * (n - 1 - i) + 2)
    b = np.where(upright, 3 * j + 1, 3 * (n - 1 - j) + 2)
    return np.stack([a, b, 3 * n - a - b], axis=1) / (3.0 * n)


def _tree_of(points: Float64) -> Any:
    from scipy.spatial import cKDTree

    return cKDTree(points, balanced_tree=False, compact_nodes=len(points) < 500_000)


def _chunks(rows: Int64) -> list[Int64]:
    return [rows[start : start + _CHUNK] for start in range(0, len(rows), _CHUNK)]
