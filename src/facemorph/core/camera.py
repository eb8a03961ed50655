"""An orbiting camera: where it looks, from which side, how far; right-handed, Y up, the face along +Z."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.errors import OptionError

if TYPE_CHECKING:
    from facemorph.core.rig import Rig

# Azimuth turns the camera round the face towards its left (+X), elevation lifts it; degrees.
DIRECTIONS: dict[str, tuple[float, float]] = {
    "front": (0.0, 0.0),
    "three-quarter": (35.0, 4.0),
    "left": (90.0, 0.0),
    "right": (-90.0, 0.0),
}


@dataclass(frozen=True)
class Camera:
    """Target and distance in model units; azimuth, elevation and the vertical field of view in degrees."""

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    azimuth_deg: float = 0.0
    elevation_deg: float = 0.0
    distance: float = 1.0
    field_deg: float = 24.0
    scene_radius: float = 1.0

    @classmethod
    def framing(cls, bounds: Float32, direction: str = "front", aspect: float = 1.0) -> Camera:
        """A camera that sees the whole box `bounds` (2, 3) from a named direction or "AZIMUTH,ELEVATION"."""
        azimuth, elevation = direction_angles(direction)
        low, high = bounds.astype(np.float64)
        size = np.maximum(high - low, 0.0)
        radius = max(float(np.linalg.norm(size)) / 2.0, 1e-6)
        x, y, z = (float(value) for value in (low + high) / 2.0)
        camera = cls((x, y, z), azimuth, elevation, 1.0, scene_radius=radius)
        return replace(camera, distance=camera._distance_to_see(size, aspect))

    @classmethod
    def of_face(cls, rig: Rig, direction: str = "front", aspect: float = 1.0) -> Camera:
        """The usual view of a face: its frame (`Rig.frame`), with room to look at all of it."""
        camera = cls.framing(rig.frame, direction, aspect)
        return replace(camera, scene_radius=cls.framing(rig.neutral.bounds).scene_radius)

    def _distance_to_see(self, size: Float64, aspect: float) -> float:
        """The nearest distance from which a centred box of `size` fits, with a small margin."""
        right, up, back = self.axes()
        half_up = float(np.abs(up) @ size) / 2.0
        half_right = float(np.abs(right) @ size) / 2.0
        depth = float(np.abs(back) @ size) / 2.0
        slope = math.tan(math.radians(self.field_deg) / 2.0)
        reach = max(half_up, half_right / max(aspect, 1e-3))
        # The front of a head is smaller than its box, so half of the depth is room enough.
        return max(reach * 1.06 / slope + depth * 0.5, self.scene_radius * 0.2)

    def axes(self) -> tuple[Float64, Float64, Float64]:
        """Unit vectors right, up and back (towards the camera) in the model's space, each (3,)."""
        a, e = math.radians(self.azimuth_deg), math.radians(self.elevation_deg)
        back = np.array([math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e)])
        right = np.array([math.cos(a), 0.0, -math.sin(a)])
        return right, np.cross(back, right), back

    def position(self) -> Float64:
        """Where the camera stands, (3,)."""
        return np.asarray(self.target) + self.axes()[2] * self.distance

    def view_from_model(self) -> Float64:
        """(4, 4) matrix; model coordinates to the camera's, for column vectors."""
        matrix = np.eye(4)
        matrix[:3, :3] = np.stack(self.axes())
        matrix[:3, 3] = -matrix[:3, :3] @ self.position()
        return matrix

    def clip_from_view(self, aspect: float) -> Float64:
        """(4, 4) perspective matrix for pictures `aspect` times as wide as high."""
        reach = self.scene_radius * 4.0 + self.distance
        near = max(self.distance - self.scene_radius * 2.0, reach * 1e-3)
        slope = 1.0 / math.tan(math.radians(self.field_deg) / 2.0)
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[1, 1] = slope / aspect, slope
        matrix[2, 2], matrix[2, 3] = (reach + near) / (near - reach), 2.0 * reach * near / (near - reach)
        matrix[3, 2] = -1.0
        return matrix

    def clip_from_model(self, aspect: float) -> Float64:
        """(4, 4) product of the two above."""
        return self.clip_from_view(aspect) @ self.view_from_model()

    def orbited(self, azimuth_deg: float, elevation_deg: float) -> Camera:
        """Turned by so many degrees; the elevation stops short of the poles."""
        elevation = float(np.clip(self.elevation_deg + elevation_deg, -89.0, 89.0))
        azimuth = (self.azimuth_deg + azimuth_deg + 180.0) % 360.0 - 180.0
        return replace(self, azimuth_deg=azimuth, elevation_deg=elevation)

    def panned(self, right: float, up: float) -> Camera:
        """Moved sideways by fractions of the picture's height; the face follows the pointer."""
        height = 2.0 * self.distance * math.tan(math.radians(self.field_deg) / 2.0)
        right_axis, up_axis, _ = self.axes()
        return self.aimed(np.asarray(self.target) + (right_axis * right + up_axis * up) * height)

    def aimed(self, target: Float64) -> Camera:
        """The same view with another pivot (3,)."""
        x, y, z = (float(value) for value in target)
        return replace(self, target=(x, y, z))

    def zoomed(self, factor: float, x: float = 0.0, y: float = 0.0) -> Camera:
        """`factor` times nearer, keeping what lies under the pointer there.

        x, y are the pointer's place in the picture in units of half its height, from the centre, y up.
        """
        distance = float(np.clip(self.distance / factor, self.scene_radius * 0.02, self.scene_radius * 50.0))
        shift = (self.distance - distance) * math.tan(math.radians(self.field_deg) / 2.0)
        right_axis, up_axis, _ = self.axes()
        moved = self.aimed(np.asarray(self.target) + (right_axis * x + up_axis * y) * shift)
        return replace(moved, distance=distance)

    def pivoted(self, point: Float64) -> Camera:
        """Turns about `point` (3,) from now on; the point comes to the middle, the distance stays its own."""
        distance = float(np.linalg.norm(self.position() - point))
        return replace(self.aimed(point), distance=max(distance, self.scene_radius * 0.02))

    def ray(self, x: float, y: float) -> tuple[Float64, Float64]:
        """Origin (3,) and unit direction (3,) of the sight line through a place given as in `zoomed`."""
        slope = math.tan(math.radians(self.field_deg) / 2.0)
        right, up, back = self.axes()
        direction = right * (x * slope) + up * (y * slope) - back
        return self.position(), direction / np.linalg.norm(direction)


def direction_angles(direction: str) -> tuple[float, float]:
    """Azimuth and elevation in degrees of a direction's name or of "AZIMUTH,ELEVATION"."""
    if direction in DIRECTIONS:
        return DIRECTIONS[direction]
    parts = direction.split(",")
    try:
        azimuth, elevation = (float(part) for part in parts)
    except ValueError:
        names = ", ".join(DIRECTIONS)
        raise OptionError(
            f"a camera is one of {names}, or AZIMUTH,ELEVATION in degrees; not {direction!r}."
        ) from None
    if not (math.isfinite(azimuth) and -90.0 < elevation < 90.0):
        raise OptionError(f"a camera's elevation lies between -90 and 90 degrees; {direction!r} does not.")
    return azimuth, elevation
