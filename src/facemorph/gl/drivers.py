"""Numbers about a face in its pose that its shaders ask for: how far the mouth is open, which wrinkles show.

A driver is made for a rig, or not where the rig lacks what it needs; its uniforms are asked for once a
frame, and only when the face moved. A new one is added to `drivers_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from facemorph.core.arrays import Float32, Float64
from facemorph.core.rig import Rig
from facemorph.gl.eyes import eyes_of
from facemorph.gl.mouth_driver import MouthOpening
from facemorph.gl.wrinkles import wrinkles_of


class Driver(Protocol):
    """One effect's numbers, by uniform."""

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        """For the coefficients (K,) of the rig's shapes, and offsets (V, 3) on top of what they give."""


def drivers_of(rig: Rig) -> tuple[Driver, ...]:
    """Those that the rig has all that they need for."""
    makers: tuple[Callable[[Rig], Driver | None], ...] = (eyes_of, MouthOpening, wrinkles_of)
    return tuple(driver for driver in (make(rig) for make in makers) if driver is not None)


def uniforms_of(
    drivers: Sequence[Driver], coefficients: Float64, offsets: Float32 | None
) -> dict[str, object]:
    """What all of them say."""
    return {
        name: value for driver in drivers for name, value in driver.uniforms(coefficients, offsets).items()
    }
