"""Tells shaders where the opening between the lips is; `shaders/lib/mouth_light.glsl` asks."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.mouth_light import APERTURE, Aperture
from facemorph.core.rig import Rig
from facemorph.gl.followed import Followed

# The inner edge of the lips in the 68-point markup: right corner, upper lip, left corner, lower lip.
INNER_LIPS = range(60, 60 + APERTURE)
FORWARD = np.array([0.0, 0.0, 1.0])


class MouthOpening:
    """Follows the inner edge of the lips; says that nothing is known of it where a face lacks them."""

    def __init__(self, rig: Rig) -> None:
        vertices = {mark.ibug: mark.vertex for mark in rig.info.landmarks if mark.ibug is not None}
        known = all(number in vertices for number in INNER_LIPS)
        self._lips = Followed(rig, [vertices[number] for number in INNER_LIPS]) if known else None

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        if self._lips is None:
            return {"aperture_size": 0.0}
        aperture = Aperture.between(self._lips(coefficients, offsets), FORWARD)
        return {
            "aperture": aperture.edge.astype(np.float32).tobytes(),
            "aperture_centre": tuple(aperture.centre.tolist()),
            "aperture_normal": tuple(aperture.normal.tolist()),
            "aperture_size": aperture.size,
        }
