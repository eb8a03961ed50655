"""`Blend`: `core.morph.morphed_positions` fast enough to follow a dragged slider.

Two ways to the same sum. In full: one weighted sum over the active shapes (einsum, which unlike a
matrix product starts no BLAS threads; with one core busy those cost ten times). It goes block by block
of the vertices, leaving out the shapes that move nothing in a block, where that saves enough: a shape
moves a part of a face, and a large face's deltas come from memory. By change: when few
coefficients moved since the last call, their deltas are added, scaled, to the sum that is there.
Rounding errors of the second way pile up; a bound on them is kept, and before it reaches
`DRIFT` of the face's diagonal the sum is made in full again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float32, Float64

DRIFT = 0.5e-6
_BLOCK = 3 << 11  # numbers of 2,048 vertices; smaller ones cost more in calls than they save
_SPARSE = 0.5  # a row picked out is copied before it is added, which costs about as much again
_Places = NDArray[np.intp]
_ROUNDING = float(np.finfo(np.float32).eps)


class Blend:
    """positions = neutral + sum_k c_k delta_k for one neutral (V, 3) and deltas (K, V, 3), both float32.

    The deltas are used in place, not copied. `fully` counts sums made in full, `by_change` the others.
    """

    def __init__(self, neutral: Float32, deltas: Float32) -> None:
        self._neutral = np.ascontiguousarray(neutral, np.float32).reshape(-1)
        self._rows = deltas.reshape(len(deltas), self._neutral.size)
        self._sum = np.zeros_like(self._neutral)
        self._scaled = np.empty_like(self._neutral)
        self._positions = self._neutral.copy()
        self._coefficients = np.zeros(len(self._rows))
        self._starts = np.arange(0, self._neutral.size, _BLOCK)
        self._moves = np.zeros((len(self._rows), len(self._starts)), bool)
        self._looked_at = np.zeros(len(self._rows), bool)
        self._largest: dict[int, float] = {}
        self._reach = 0.0
        self._error = 0.0
        span = np.ptp(neutral, axis=0) if len(neutral) else np.zeros(3)
        self._tolerance = DRIFT * float(np.linalg.norm(span.astype(np.float64)))
        self.fully = 0
        self.by_change = 0

    def __call__(self, coefficients: Float64, *, exactly: bool = False) -> Float32:
        """Positions (V, 3) for coefficients (K,), in an array that the next call changes.

        `exactly` sums in full, so that the result does not depend on what was asked before.
        """
        changed = np.flatnonzero(coefficients != self._coefficients)
        if exactly or not self._add_changes(coefficients, changed):
            self._sum_in_full(coefficients)
        self._coefficients[:] = coefficients
        np.add(self._neutral, self._sum, out=self._positions)
        return self._positions.reshape(-1, 3)

    def _add_changes(self, coefficients: Float64, changed: _Places) -> bool:
        """Bring the sum up to date by adding what changed; False where that is dearer or too inexact."""
        active = int(np.count_nonzero(coefficients))
        # With nothing active the sum in full costs nothing and leaves no residue.
        if active == 0 or len(changed) > max(active // 3, 1):
            return False
        steps = [(int(k), float(coefficients[k] - self._coefficients[k])) for k in changed]
        reach, error = self._reach, self._error
        for k, step in steps:
            moved = abs(step) * self._largest_of(k)
            reach += moved
            error += _ROUNDING * (moved + reach)
        if not error <= self._tolerance:
            return False
        for k, step in steps:
            self._add(k, step)
        self._reach, self._error = reach, error
        self.by_change += 1
        return True

    def _sum_in_full(self, coefficients: Float64) -> None:
        active = np.flatnonzero(coefficients)
        weights = coefficients.astype(np.float32)
        moving = self._moving(active)
        if moving.size and (moving.mean() <= _SPARSE or not _gapless(active)):
            for block, start in enumerate(self._starts):
                self._sum_block(slice(start, start + _BLOCK), active[moving[:, block]], weights)
        else:
            self._sum_block(slice(None), active, weights)
        # A sum in full is the yardstick; only what is added to it later counts as drift.
        self._reach = _largest(self._sum)
        self._error = 0.0
        self.fully += 1

    def _sum_block(self, block: slice, shapes: _Places, weights: Float32) -> None:
        """Put the weighted sum of some shapes into one block of the sum."""
        total = self._sum[block]
        if not len(shapes):
            total.fill(0.0)
            return
        chosen = slice(int(shapes[0]), int(shapes[-1]) + 1) if _gapless(shapes) else shapes
        rows = self._rows[chosen, block]
        np.einsum("k,kj->j", weights[shapes], rows, out=total)

    def _moving(self, active: _Places) -> NDArray[np.bool_]:
        """Which of the active shapes move anything in which block, (A, B)."""
        for k in active[~self._looked_at[active]]:
            np.logical_or.reduceat(self._rows[k] != 0.0, self._starts, out=self._moves[k])
            self._looked_at[k] = True
        return self._moves[active]

    def _add(self, k: int, weight: float) -> None:
        np.multiply(self._rows[k], np.float32(weight), out=self._scaled)
        np.add(self._sum, self._scaled, out=self._sum)

    def _largest_of(self, k: int) -> float:
        if k not in self._largest:
            self._largest[k] = _largest(self._rows[k])
        return self._largest[k]


def _gapless(shapes: _Places) -> bool:
    """Whether shapes stand one after the other."""
    return len(shapes) > 0 and int(shapes[-1]) - int(shapes[0]) == len(shapes) - 1


def _largest(values: Float32) -> float:
    """The largest size among values; 0 where there are none."""
    return max(float(values.max()), -float(values.min())) if len(values) else 0.0
