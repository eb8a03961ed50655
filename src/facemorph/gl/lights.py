"""A rig of lights: what stands where around a face; it follows the camera, so every side is readable."""

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

    key_softness  how wide the key is: 0 a small lamp, 1 a wall of light whose shade has no edge
    catch_from    where eyes see the key: lower than it is, or the upper lid would hide the highlight
    backdrop      how much depth the backdrop has: 0 plain, without any shadow, to 1
    lag_deg       of the lights behind the camera
    """

    key: Light
    key_from: tuple[float, float]
    fill: Light
    fill_from: tuple[float, float]
    catch_from: tuple[float, float]
    rim: Light
    rim_from: tuple[float, float]
    sky: Light
    floor: Light
    key_softness: float = 0.0
    backdrop: float = 1.0
    lag_deg: float = LAG_DEG

    def uniforms(self, camera: Camera, exposure: float = 1.0) -> dict[str, object]:
        """Values for `shaders/lib/light.glsl` as seen by `camera`; directions in the model's space."""
        colours = {
            "key_light": self.key,
            "fill_light": self.fill,
            "rim_light": self.rim,
            "sky_light": self.sky,
            "floor_light": self.floor,
        }
        return {
            "key_direction": self._direction(camera, *self.key_from),
            "catch_direction": self._direction(camera, *self.catch_from),
            "fill_direction": self._direction(camera, *self.fill_from),
            "rim_direction": self._direction(camera, *self.rim_from),
            "key_softness": self.key_softness,
            **{name: tuple(part * exposure for part in colour) for name, colour in colours.items()},
        }

    def _direction(self, camera: Camera, azimuth_deg: float, elevation_deg: float) -> Light:
        """Unit vector towards a light that stands so from the camera."""
        # By the sine the lag is gone at the back again, so a full turn ends where it began.
        lag = self.lag_deg * math.sin(math.radians(camera.azimuth_deg))
        a = math.radians(camera.azimuth_deg - lag + azimuth_deg)
        e = math.radians(camera.elevation_deg * 0.5 + elevation_deg)
        vector: Float64 = np.array([math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e)])
        return float(vector[0]), float(vector[1]), float(vector[2])
