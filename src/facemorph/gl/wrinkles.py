"""The driver of wrinkles: what each of a rig's wrinkles counts in a pose, for `shaders/lib/wrinkles.glsl`."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.rig import Rig
from facemorph.core.wrinkles import MOST_WRINKLES, SETS, WrinkleWeights

COUNT = "wrinkle_count"


class WrinkleDriver:
    """Made for a rig that has wrinkles; those of weight 0 are not sent."""

    def __init__(self, rig: Rig) -> None:
        self._weights = WrinkleWeights(rig.names, rig.wrinkles)
        self._areas = np.array([wrinkle.area for wrinkle in rig.wrinkles], np.float32)
        self._soft = np.array([wrinkle.soft for wrinkle in rig.wrinkles], np.float32)
        self._sets = np.array([SETS.index(wrinkle.set) for wrinkle in rig.wrinkles])

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        """Areas and weights of those that show, in the rig's order."""
        weights = self._weights(coefficients)
        shown = np.flatnonzero(weights > 0.0)
        areas, by_set = (np.zeros((MOST_WRINKLES, 4), np.float32) for _ in range(2))
        areas[: len(shown)] = self._areas[shown]
        by_set[np.arange(len(shown)), self._sets[shown]] = weights[shown]
        by_set[: len(shown), 3] = self._soft[shown]
        return {
            COUNT: len(shown),
            "wrinkle_areas": areas.tobytes(),
            "wrinkle_weights": by_set.tobytes(),
        }


def wrinkles_of(rig: Rig) -> WrinkleDriver | None:
    """The driver, or None for a rig without wrinkles."""
    return WrinkleDriver(rig) if rig.wrinkles else None
