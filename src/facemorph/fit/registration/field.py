"""A smooth field through the displacements of a few points: biharmonic, level far away.

    F(p) = c + sum_i a_i |p - x_i|,  sum_i a_i = 0                (thesis, 2.13, without its linear terms)

The similarity has taken what is linear already; a linear term fitted to landmarks of a face alone, all in
front, would carry the back of the head away. Unlike `deform.rbf.RbfField` it takes points in one plane.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.deform.rbf import distances, spread
from facemorph.errors import FitError

_CHUNK_ROWS = 2048


class SmoothField:
    """Bound to points (n, 3), at least one, all apart, and how far each moves, (n, 3).

    `loose` lets the field miss moves that neighbours contradict, such as those of two lips that part: about
    moves of points nearer to each other than `loose` times their spread are averaged.
    """

    def __init__(self, points: Float64, moves: Float64, loose: float = 0.0) -> None:
        """Raises `FitError` where two points are at one place."""
        self._centre, self._scale = points.mean(axis=0), spread(points) or 1.0
        self._points = (points - self._centre) / self._scale
        n = len(points)
        system = np.zeros((n + 1, n + 1))
        # -r is the kernel that is positive on sums without a mean, so it is -loose that makes moves softer.
        system[:n, :n] = distances(self._points, self._points) - loose * np.eye(n)
        system[:n, n] = system[n, :n] = 1.0
        try:
            solved = np.linalg.solve(system, np.concatenate([moves, np.zeros((1, 3))]))
        except np.linalg.LinAlgError as error:
            raise FitError("two landmarks are at one place; move one or take it away.") from error
        self._weights, self._level = solved[:n], solved[n]

    def __call__(self, points: Float64) -> Float64:
        """How far points (N, 3) move, (N, 3)."""
        moves = np.empty(points.shape)
        for start in range(0, len(points), _CHUNK_ROWS):
            some = slice(start, start + _CHUNK_ROWS)
            local = (points[some] - self._centre) / self._scale
            moves[some] = distances(local, self._points) @ self._weights + self._level
        return moves
