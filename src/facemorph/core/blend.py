"""`Blend`: `core.morph.morphed_positions` fast enough to follow a dragged slider.

Two ways to the same sum. In full: one weighted sum over the active shapes (einsum, which unlike a
matrix product starts no BLAS threads; with one core busy those cost ten times). By change: when few
coefficients moved since the last call, their deltas are added, scaled, to the sum that is there.
Rounding errors of the second way pile up; a bound on them is kept, and before it reaches
`DRIFT` of the face's diagonal the sum is made in full again.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64

DRIFT = 0.5e-6
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

    def _add_changes(self, coefficients: Float64, changed: np.ndarray[tuple[int], np.dtype[np.intp]]) -> bool:
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
        self._sum.fill(0.0)
        active = np.flatnonzero(coefficients)
        weights = coefficients.astype(np.float32)
        for run in np.split(active, np.flatnonzero(np.diff(active) != 1) + 1):
            if len(run) == 1:
                self._add(int(run[0]), float(coefficients[run[0]]))
            elif len(run):
                rows = slice(int(run[0]), int(run[-1]) + 1)
                np.einsum("k,kj->j", weights[rows], self._rows[rows], out=self._scaled)
                np.add(self._sum, self._scaled, out=self._sum)
        # A sum in full is the yardstick; only what is added to it later counts as drift.
        self._reach = float(np.abs(self._sum).max()) if len(self._sum) else 0.0
        self._error = 0.0
        self.fully += 1

    def _add(self, k: int, weight: float) -> None:
        np.multiply(self._rows[k], np.float32(weight), out=self._scaled)
        np.add(self._sum, self._scaled, out=self._sum)

    def _largest_of(self, k: int) -> float:
        if k not in self._largest:
            row = self._rows[k]
            self._largest[k] = max(float(row.max()), -float(row.min())) if len(row) else 0.0
        return self._largest[k]
