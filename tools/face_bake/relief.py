"""Paint the skin's fine relief as heights, and how rough it is: where it is oily it shines."""

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_edt

from .hair import growth
from .mouth_paint import corners_of, rim_of
from .paintkit import Noise, smoothstep
from .people import Look
from .raster import Raster
from .relief_cells import cells

# Centimetres from black to white in the relief, of a young skin and what age adds.
YOUNG, AGEING = 0.048, 0.016
MIDDLE = 150
# Decimetres: the net of fine lines that skin is divided by, and the pores.
NET, PORE = 0.0095, 0.0150
PLAIN = 0.54
ROUGHNESS_SIDE = 512


def relief_height(age: float) -> float:
    """Centimetres from black to white."""
    return YOUNG + AGEING * age


def _spot(points, centre, radii) -> np.ndarray:
    """A soft spot (p,), mirrored left and right."""
    mirrored = np.stack([np.abs(points[:, 0]), points[:, 1], points[:, 2]], -1)
    return np.exp(-(((mirrored - np.array(centre)) / np.array(radii)) ** 2).sum(1))


def _porous(points: np.ndarray) -> np.ndarray:
    """Where pores are large: the nose and beside it, the chin, between the brows."""
    return np.clip(
        1.0 * _spot(points, (0, 6.95, 1.6), (0.16, 0.20, 0.3))
        + 0.9 * _spot(points, (0.28, 6.98, 1.45), (0.18, 0.16, 0.3))
        + 0.5 * _spot(points, (0, 6.28, 1.5), (0.20, 0.13, 0.3))
        + 0.5 * _spot(points, (0, 7.55, 1.5), (0.25, 0.16, 0.3)),
        0,
        1,
    )


class ReliefPainter:
    """Paints relief at pixels with `canvas`; what all people share is worked out once."""

    def __init__(self, canvas, raster: Raster):
        self._canvas, self._raster = canvas, raster
        points = canvas.points
        noise = Noise(31)
        nearest, second, _ = cells(points, NET, seed=5)
        self._net = 1 - smoothstep(0.0, 0.30, second - nearest)
        nearest, *_ = cells(points, PORE, seed=9)
        self._pores = 1 - smoothstep(0.10, 0.42, nearest)
        self._swell = 0.6 * noise(points, 42) + 0.4 * noise(points + 3, 85)
        self._uneven = noise.layered(points + 11, 40, 2)
        # Crêpe below the eyes and at their corners: finer lines, all one way.
        x, y, z = points.T
        lines = noise(np.stack([x * 14, y * 105, z * 14], -1), 1)
        self._crepe = smoothstep(0.2, 1.4, lines)
        creases = noise(np.stack([x * 84 + 0.8 * np.sin(25 * y), y * 7, z * 7], -1), 1)
        self._lip_creases = 1 - smoothstep(0.0, 0.55, np.abs(creases))
        self._porous = _porous(points)

    def relief(self, age: float) -> Image.Image:
        """Heights in grey; light is high."""
        canvas, points = self._canvas, self._canvas.points
        lips = np.clip(canvas.lips, 0, 1)
        skin = 1 - lips
        pores = (0.24 + 0.95 * self._porous) * (0.75 + 0.45 * age)
        below_eyes = _spot(points, (0.38, 7.16, 1.35), (0.22, 0.09, 0.3))
        below_eyes = np.clip(below_eyes + _spot(points, (0.60, 7.25, 1.1), (0.12, 0.14, 0.3)), 0, 1)
        height = 0.15 * self._swell + 0.05 * self._uneven - 0.17 * self._net * (0.8 + 0.4 * age)
        height -= 0.50 * self._pores * pores
        height -= (0.06 + 0.30 * age) * self._crepe * below_eyes
        height = height * skin - 0.40 * self._lip_creases * lips
        height *= np.where(canvas.mouth > 0, 0.0, 1.0)
        levels = np.clip(MIDDLE + 127 * height, 0, 255)
        return Image.fromarray(self._raster_grey(levels, MIDDLE))

    def roughness(self, light: np.ndarray, look: Look) -> Image.Image:
        """0 a mirror, 1 no highlight; `light` (p,) is the occlusion of the neutral."""
        points, canvas = self._canvas.points, self._canvas
        noise = Noise(32)
        rough = PLAIN + 0.010 * noise.layered(points, 9, 3) + 0.015 * self._uneven + 0.02 * self._swell
        rough = rough + 0.06 * self._pores * self._porous
        for change, centre, radii in (
            (-0.14, (0, 7.00, 1.6), (0.12, 0.26, 0.4)),
            (-0.06, (0, 7.70, 1.5), (0.34, 0.20, 0.4)),
            (-0.03, (0.40, 7.02, 1.4), (0.16, 0.12, 0.3)),
            (-0.05, (0, 6.28, 1.5), (0.14, 0.10, 0.3)),
            (-0.04, (0.32, 7.36, 1.4), (0.14, 0.06, 0.2)),
            (0.07, (0.60, 6.75, 0.9), (0.22, 0.35, 0.5)),
        ):
            rough = rough + change * _spot(points, centre, radii)
        rough = rough + 0.10 * smoothstep(6.20, 5.90, points[:, 1])
        rough = rough + 0.10 * look.stubble * smoothstep(6.95, 6.75, points[:, 1])
        rough = rough * (1 - canvas.lips) + (0.38 + 0.06 * self._lip_creases) * canvas.lips
        # What the neutral hides, and what hair grows from, does not shine.
        hidden = np.maximum(smoothstep(0.55, 0.25, light), 0.9 * (growth(points, look) > 0.3))
        # Light from behind would shine along the line where lips meet.
        hidden = np.maximum(hidden, np.maximum(rim_of(canvas), corners_of(canvas)))
        rough = rough + (1 - rough) * hidden
        grey = self._raster_grey(np.clip(rough, 0, 1) * 255, 255 * PLAIN)
        side = min(ROUGHNESS_SIDE, self._raster.size)
        return Image.fromarray(grey).resize((side, side), Image.Resampling.BOX)

    def _raster_grey(self, levels: np.ndarray, empty: float) -> np.ndarray:
        """(size, size) bytes; empty pixels take the nearest level."""
        image = np.full((self._raster.size,) * 2, round(empty), np.uint8)
        image[self._raster.covered] = np.round(levels).astype(np.uint8)
        nearest = distance_transform_edt(~self._raster.covered, return_distances=False, return_indices=True)
        return image[tuple(nearest)]
