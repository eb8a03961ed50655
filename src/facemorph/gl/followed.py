"""A few vertices of a rig, followed on the CPU wherever the rest is morphed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32
from facemorph.core.rig import Rig


class Followed:
    """A few vertices of a rig, morphed without the others: p_v = n_v + sum_k c_k delta_kv + offset_v."""

    def __init__(self, rig: Rig, vertices: Sequence[int] | Int32) -> None:
        self._vertices = np.asarray(vertices, np.int32)
        self._rest = rig.neutral.positions[self._vertices].astype(np.float64)
        self._moves = np.array([delta[self._vertices] for delta in rig.deltas], np.float64).reshape(
            len(rig.deltas), *self._rest.shape
        )

    def __call__(self, coefficients: Float64, offsets: Float32 | None) -> Float64:
        """Their positions (n, 3), model units."""
        moved: Float64 = self._rest + np.tensordot(coefficients, self._moves, 1)
        return moved if offsets is None else moved + offsets[self._vertices]
