"""Smooth displacement fields on the cage: thin-plate interpolation of given moves, and softening of others.

Both work on the bending energy of a displacement field d over the base head, d^T (L^T M^-1 L) d with the
cotangent Laplacian L and the vertices' areas M (Botsch & Sorkine 2008, "On linear variational surface
deformation methods", eq. 14), so the skin between what is held bends as evenly as it can.
"""

from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import factorized

from .cage import Cage
from .subdivide import compact, triangulate

# Thin triangles would pull with unbounded weights, or push.
WEIGHT_RANGE = (0.05, 20.0)
# Smallest area of a vertex as a share of the mean: the lips' innermost rings are very dense.
LEAST_AREA = 0.02


class CageSurface:
    """Displacements of base-mesh vertices (19158, 3) seen on the used vertices of the cage (n, 3)."""

    def __init__(self, cage: Cage, points: np.ndarray):
        self.used, faces = compact(cage.faces)
        self.points = points[self.used]
        self._total = len(points)
        self._triangles = triangulate(faces)
        self._laplacian, self._area = self._cotangents()

    @cached_property
    def bending(self) -> sp.csc_matrix:
        """Sparse (n, n): the bending energy's Hessian."""
        return (self._laplacian.T @ sp.diags(1 / self._area) @ self._laplacian).tocsc()

    def index_of(self, vertices) -> np.ndarray:
        """Places among the used vertices of base-mesh vertices that the cage uses."""
        return np.searchsorted(self.used, vertices)

    def interpolated(self, held: np.ndarray, moves: np.ndarray) -> np.ndarray:
        """Field (19158, 3) that moves the used vertices `held` by `moves` and bends least elsewhere."""
        free = np.ones(len(self.used), bool)
        free[held] = False
        field = np.zeros_like(self.points)
        field[held] = moves
        pull = self.bending[free][:, ~free] @ field[~free]
        solve = factorized(self.bending[free][:, free].tocsc())
        field[free] = -np.stack([solve(column) for column in pull.T], -1)
        return self._spread(field)

    def softener(self, length: np.ndarray):
        """A function that smooths fields (19158, 3) over a length (n,) in decimetres at each used vertex."""
        shortest = length[length > 0].min()
        loyal = np.where(length > 0, (shortest / np.maximum(length, shortest)) ** 4, 1e6)
        weight = sp.diags(loyal * self._area)
        solve = factorized((weight + shortest**4 * self.bending).tocsc())

        def soften(field: np.ndarray) -> np.ndarray:
            own = weight @ field[self.used]
            result = field.copy()
            result[self.used] = np.stack([solve(column) for column in own.T], -1)
            return result

        return soften

    def _spread(self, field: np.ndarray) -> np.ndarray:
        whole = np.zeros((self._total, 3))
        whole[self.used] = field
        return whole

    def _cotangents(self) -> tuple[sp.csr_matrix, np.ndarray]:
        n, corners = len(self.points), self.points[self._triangles]
        rows, cols, values = [], [], []
        for i in range(3):
            a, b = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
            sine = np.maximum(np.linalg.norm(np.cross(a, b), axis=1), 1e-12)
            weight = np.clip(0.5 * (a * b).sum(1) / sine, *WEIGHT_RANGE)
            u, v = self._triangles[:, (i + 1) % 3], self._triangles[:, (i + 2) % 3]
            rows += [u, v]
            cols += [v, u]
            values += [weight, weight]
        links = sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), (n, n))
        laplacian = sp.diags(np.asarray(links.sum(1)).ravel()) - links
        a, b, c = (corners[:, i] for i in range(3))
        double = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        area = np.bincount(self._triangles.ravel(), np.repeat(double / 6, 3), n)
        return laplacian.tocsr(), np.maximum(area, LEAST_AREA * area.mean())
