"""How the neighbourhood of each vertex turned, and the triangles that did not turn with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int64
from facemorph.fit.align import diagonal_of
from facemorph.fit.registration.surface import normals_of

_NO_AREA = 1e-7


class Neighbourhoods:
    """The neighbours of each vertex and theirs, of triangles (T, 3) at points (V, 3) before they moved."""

    def __init__(self, before: Float64, triangles: Int64) -> None:
        self.triangles = triangles
        self._before = before - before.mean(axis=0)
        ring = neighbours_of(triangles, len(before))
        self._ring = ring
        self._wide = (ring + ring @ ring).tocsr()
        self._wide.data[:] = 1.0
        self._share = 1.0 / np.maximum(np.diff(self._wide.indptr), 1)[:, None]
        self._mean = self._share * (self._wide @ self._before)
        self._areas = areas_of(before, triangles)
        size = diagonal_of(before)
        self._solid = np.linalg.norm(self._areas, axis=1) > (_NO_AREA * size) ** 2

    def around(self, vertices: Int64) -> Int64:
        """Those vertices and their neighbours, each once."""
        inside = np.zeros(len(self._before), bool)
        inside[vertices.ravel()] = True
        return np.flatnonzero(inside | (self._ring @ inside > 0))

    def rotations(self, after: Float64) -> Float64:
        """The rotation (V, 3, 3) of each neighbourhood, by least squares (Sorkine and Alexa 2007, eq. 5)."""
        after = after - after.mean(axis=0)
        products = (after[:, :, None] * self._before[:, None, :]).reshape(-1, 9)
        mean = self._share * (self._wide @ after)
        summed = (self._share * (self._wide @ products)).reshape(-1, 3, 3)
        left, _, right = np.linalg.svd(summed - mean[:, :, None] * self._mean[:, None, :])
        left[:, :, 2] *= np.where(np.linalg.det(left @ right) < 0.0, -1.0, 1.0)[:, None]
        return np.asarray(left @ right)

    def turned_over(self, after: Float64, rotations: Float64) -> Bool:
        """Triangles (T,) whose normals oppose what their neighbourhood's rotation makes of them."""
        mean = rotations[self.triangles].sum(axis=1)
        turned = np.einsum("tij,tj->ti", mean, self._areas)
        return np.asarray(self._solid & ((turned * areas_of(after, self.triangles)).sum(axis=1) <= 0.0))


def areas_of(points: Float64, triangles: Int64) -> Float64:
    """Area vectors (T, 3): each triangle's normal, as long as twice its area."""
    first = points[triangles[:, 0]]
    return np.asarray(np.cross(points[triangles[:, 1]] - first, points[triangles[:, 2]] - first))


def point_normals(points: Float64, triangles: Int64) -> Float64:
    """Unit normals (V, 3) of points (V, 3) over triangles (T, 3)."""
    return normals_of(triangles, areas_of(points, triangles), len(points))


def only(triangles: Int64, chosen: Bool) -> Int64:
    """Triangles over chosen vertices (V,) alone, as numbered among them."""
    number = np.cumsum(chosen) - 1
    return np.asarray(number[triangles[chosen[triangles].all(axis=1)]])


def neighbours_of(triangles: Int64, vertex_count: int) -> Any:
    """Which vertices share an edge: a sparse (V, V) matrix of ones."""
    from scipy.sparse import coo_matrix

    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ends = ends[ends[:, 0] != ends[:, 1]]
    both = np.concatenate([ends, ends[:, ::-1]])
    matrix = coo_matrix((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(vertex_count,) * 2).tocsr()
    matrix.data[:] = 1.0
    return matrix
