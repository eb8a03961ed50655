"""Numbers about a face in its pose that its shaders ask for: how far the mouth is open, which wrinkles show.

A driver is made for a rig, or not where the rig lacks what it needs; its uniforms are asked for once a
frame, and only when the face moved. A new one is added to `drivers_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32
from facemorph.core.rig import Rig


class Driver(Protocol):
    """One effect's numbers, by uniform."""

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        """For the coefficients (K,) of the rig's shapes, and offsets (V, 3) on top of what they give."""


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


def drivers_of(rig: Rig) -> tuple[Driver, ...]:
    """Those that the rig has all that they need for."""
    makers: tuple[Callable[[Rig], Driver | None], ...] = ()
    return tuple(driver for driver in (make(rig) for make in makers) if driver is not None)


def uniforms_of(
    drivers: Sequence[Driver], coefficients: Float64, offsets: Float32 | None
) -> dict[str, object]:
    """What all of them say."""
    return {
        name: value for driver in drivers for name, value in driver.uniforms(coefficients, offsets).items()
    }
