"""Where the lights stand: a portrait's three, following the camera, so that every side is readable."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.camera import Camera

Light = tuple[float, float, float]

# The lights lag behind the camera by so many degrees at most, so that turning it shows the form.
LAG_DEG = 18.0


@dataclass(frozen=True)
class Lights:
    """Intensities (linear RGB) of the lights, and azimuth and elevation in degrees from the camera.

    `catch_from` is where eyes see the key: lower than it is, or the upper lid would hide the highlight.
    """

    key: Light = (1.80, 1.68, 1.54)
    key_from: tuple[float, float] = (-46.0, 38.0)
    fill: Light = (0.22, 0.255, 0.31)
    fill_from: tuple[float, float] = (48.0, 6.0)
    catch_from: tuple[float, float] = (-27.0, 15.0)
    rim: Light = (2.3, 2.4, 2.6)
    rim_from: tuple[float, float] = (150.0, 35.0)
    sky: Light = (0.20, 0.22, 0.26)
    floor: Light = (0.11, 0.088, 0.08)

    def uniforms(self, camera: Camera) -> dict[str, Light]:
        """Values for `shaders/lib/light.glsl` as seen by `camera`; directions in the model's space."""
        return {
            "key_direction": _direction(camera, *self.key_from),
            "key_light": self.key,
            "catch_direction": _direction(camera, *self.catch_from),
            "fill_direction": _direction(camera, *self.fill_from),
            "fill_light": self.fill,
            "rim_direction": _direction(camera, *self.rim_from),
            "rim_light": self.rim,
            "sky_light": self.sky,
            "floor_light": self.floor,
        }


def _direction(camera: Camera, azimuth_deg: float, elevation_deg: float) -> Light:
    """Unit vector towards a light that stands so from the camera."""
    # By the sine the lag is gone at the back again, so a full turn ends where it began.
    lag = LAG_DEG * math.sin(math.radians(camera.azimuth_deg))
    a = math.radians(camera.azimuth_deg - lag + azimuth_deg)
    e = math.radians(camera.elevation_deg * 0.5 + elevation_deg)
    vector: Float64 = np.array([math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e)])
    return float(vector[0]), float(vector[1]), float(vector[2])
