"""Which vertices to take as control points: those that cover a face, or rebuild an expression best."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float32, Float64, Int32
from facemorph.core.rig import Rig
from facemorph.deform.rbf import (
    Kernel,
    distances,
    inverted,
    kernel_function,
    nearest_mean,
    spread,
    system_of,
)
from facemorph.errors import DeformError

LANDMARK_SHARE = 0.8
# Points that hold the head before the error chooses: the affine part alone needs four.
_SEEDS = 6
# The error is measured at so many vertices, and so many may be chosen; beyond, a second is not enough.
_MEASURED, _CANDIDATES = 1500, 700
# Points chosen by the error; more than these cover what is left.
_MOST_BY_ERROR = 250
# A candidate whose pivot is smaller than this part of the largest adds nothing but trouble to the solver.
_PIVOT = 1e-5

Indices = NDArray[np.intp]


def control_vertices(rig: Rig, count: int, first: Int32 | None = None) -> Int32:
    """`count` vertices (n,) that cover the face: always the one farthest from those chosen before.

    Landmarks are chosen first, for a part of the count (`LANDMARK_SHARE`), then any vertices; where
    `first` (m,) is given, it is kept and added to. Vertices at one place count once. Raises
    `DeformError` where there are not so many places.
    """
    positions = rig.neutral.positions.astype(np.float64)
    marked = np.zeros(len(positions))
    marked[[mark.vertex for mark in rig.info.landmarks]] = 1.0
    chosen = [int(np.argmax(marked))] if first is None else [int(vertex) for vertex in first]
    away = np.full(len(positions), np.inf)
    for vertex in chosen:
        _come_nearer(away, positions, vertex)
    while len(chosen) < count:
        among_marks = len(chosen) < LANDMARK_SHARE * count and (away * marked).any()
        farthest = int(np.argmax(away * marked if among_marks else away))
        if away[farthest] <= 1e-6 * rig.neutral.diagonal:
            raise DeformError(
                f"the face has only {len(chosen)} different places; {count} points were asked for."
            )
        chosen.append(farthest)
        _come_nearer(away, positions, farthest)
    return np.array(chosen[:count], np.int32)


def _come_nearer(away: Float64, positions: Float64, vertex: int) -> None:
    np.minimum(away, np.linalg.norm(positions - positions[vertex], axis=1), out=away)


def rebuilding_vertices(
    rig: Rig,
    source: Float32,
    target: Float32,
    count: int,
    kernel: Kernel = "r",
    c: float | None = None,
) -> Int32:
    """`count` vertices (n,) from whose motion RBF rebuilds the target (V, 3) from the source (V, 3) well.

    Greedy: after a few that cover the face, always the vertex that lowers the sum of squared errors
    most as one more control point (2.13). Points that cover a closed mouth evenly cannot open it: the
    lips' points nearly coincide, and the error says so. Errors are measured, and points chosen, among a
    part of the vertices. The same input gives the same points. Raises `DeformError` as
    `control_vertices` does.
    """
    seeds = control_vertices(rig, min(count, _SEEDS))
    moved = target.astype(np.float64) - source
    if count <= _SEEDS or not moved.any():
        return control_vertices(rig, count, seeds)
    if kernel == "multiquadric" and c is None:
        # c follows from the points, and they from c: those of the kernel r break the circle.
        c = nearest_mean(source[rebuilding_vertices(rig, source, target, count)].astype(np.float64))
    measured = np.union1d(_evenly(len(source), _MEASURED), seeds)
    candidates = _evenly(len(measured), _CANDIDATES)
    points = source[measured].astype(np.float64)
    points = (points - points.mean(axis=0)) / (scale := spread(points))
    held = np.searchsorted(measured, seeds)
    try:
        greedy = _Greedy(
            points, moved[measured], held, candidates, kernel_function(kernel, (c or 0.0) / scale)
        )
    except DeformError:
        return control_vertices(rig, count, seeds)  # a flat face: RBF itself says what is wrong with it
    chosen = [*held, *greedy.chosen(min(count, _MOST_BY_ERROR) - len(held))]
    return control_vertices(rig, count, measured[chosen].astype(np.int32))


def _evenly(count: int, most: int) -> Indices:
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.intp))


class _Greedy:
    """The errors e (m, 3) at m points with some of them held, and what each further point would change.

    With R(x, y) the residual of the kernel, its part that the held points leave, holding one more point x
    takes R(., x) e(x) / R(x, x) from the errors and R(., x) R(x, .) / R(x, x) from R: bordering of the
    system (2.14), one row and column a step, without ever solving it anew. R itself is kept as it was at
    first, and the columns that were taken from it beside it.
    """

    def __init__(
        self,
        points: Float64,
        moved: Float64,
        held: Indices,
        candidates: Indices,
        kernel_of: Callable[[Float64], Float64],
    ) -> None:
        inverse = inverted(system_of(points[held], kernel_of))
        part = np.c_[kernel_of(distances(points, points[held])), np.ones(len(points)), points]
        weights = part @ inverse
        self._at = candidates
        self._first = kernel_of(distances(points, points[candidates])) - weights @ part[candidates].T
        # R(., x) of every point taken, and R(x, .) / R(x, x) over the candidates.
        self._columns, self._rows = np.empty((0, len(points))), np.empty((0, len(candidates)))
        self._errors = moved - weights[:, : len(held)] @ moved[held]
        self._pivots = self._first[candidates, np.arange(len(candidates))].copy()
        self._squares = (self._first**2).sum(axis=0)
        self._products = self._errors.T @ self._first
        self._free = ~np.isin(candidates, held)
        self._least = float(np.abs(self._pivots).max()) * _PIVOT

    def chosen(self, count: int) -> list[int]:
        """Hold so many more points, the best one first; fewer where the rest would be none of use."""
        taken: list[int] = []
        self._columns = np.empty((count, len(self._first)))
        self._rows = np.empty((count, len(self._at)))
        while len(taken) < count:
            usable = np.flatnonzero(self._free & (np.abs(self._pivots) > self._least))
            if not len(usable):
                break
            best = int(usable[np.argmax(self._gains(usable))])
            self._take(best, len(taken))
            taken.append(int(self._at[best]))
        return taken

    def _gains(self, usable: Indices) -> Float64:
        """By how much the sum of squared errors falls with each of these candidates held, (k,)."""
        step = self._errors[self._at[usable]] / self._pivots[usable, None]
        gains: Float64 = 2.0 * (step.T * self._products[:, usable]).sum(axis=0)
        gains -= (step**2).sum(axis=1) * self._squares[usable]
        return gains

    def _take(self, best: int, place: int) -> None:
        x, pivot = self._at[best], self._pivots[best]
        columns, rows = self._columns[:place], self._rows[:place]
        column = self._first[:, best] - _product(rows[:, best], columns)
        row = (self._first[x] - _product(columns[:, x], rows)) / pivot
        among = _product(column, self._first) - _product(_product(column, columns.T), rows)
        step = self._errors[x] / pivot
        self._errors -= np.outer(column, step)
        self._products -= np.outer(step, among)
        self._products -= np.outer(column @ self._errors, row)
        self._squares += row * (row * (column @ column) - 2.0 * among)
        self._pivots -= row * row * pivot
        self._columns[place], self._rows[place] = column, row
        self._free[best] = False


def _product(vector: Float64, matrix: Float64) -> Float64:
    """v^T M, without BLAS: its threads wait for each other longer than this takes when a core is busy."""
    return np.asarray(np.einsum("i,ij->j", vector, matrix), np.float64)
