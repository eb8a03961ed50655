"""Eyebrows, drawn hair by hair along a curve on the base head's front."""

import numpy as np

from .paintkit import Plane
from .people import Look

HAIRS = 520
# x and y of the brow's middle line from the nose outwards, how much of the arch each point takes,
# and how much of the lowering (or raising) of the inner end.
CURVE = np.array(
    [(0.090, 7.452), (0.16, 7.464), (0.25, 7.474), (0.34, 7.486), (0.43, 7.484), (0.50, 7.460), (0.56, 7.428)]
)
ARCH = np.array([0, 0, 0.4, 1, 1, 0.5, 0])
INNER = np.array([1, 0.7, 0.3, 0, 0, 0, 0])
HALF_WIDTH = ([0, 0.12, 0.5, 0.75, 1], [0.020, 0.027, 0.024, 0.017, 0.006])
# Hairs stand up near the nose and lie along the brow further out.
LEAN = ([0, 0.15, 0.5, 1], [75, 48, 22, 4])


class BrowCurve:
    """The middle line of one brow, by a parameter 0 (inner end) to 1."""

    def __init__(self, look: Look):
        rise = look.brow_arch * ARCH + look.brow_inner * INNER
        self._points = CURVE + np.stack([np.zeros(len(CURVE)), rise], -1)
        self._thickness = look.brow_thickness

    def at(self, u) -> tuple[np.ndarray, np.ndarray]:
        steps = np.linspace(0, 1, len(CURVE))
        return np.interp(u, steps, self._points[:, 0]), np.interp(u, steps, self._points[:, 1])

    def direction(self, u: float) -> tuple[float, float]:
        (x0, y0), (x1, y1) = self.at(max(u - 0.02, 0)), self.at(min(u + 0.02, 1))
        length = np.hypot(x1 - x0, y1 - y0)
        return (x1 - x0) / length, (y1 - y0) / length

    def half_width(self, u) -> np.ndarray:
        return np.interp(u, *HALF_WIDTH) * self._thickness


def _hair(curve: BrowCurve, rng: np.random.Generator) -> tuple[list, int]:
    """Three points of one hair, and its grey."""
    u = rng.uniform(0, 1) ** 0.92
    (x, y), (tx, ty) = curve.at(u), curve.direction(u)
    across = np.clip(rng.normal(0, 0.48), -1, 1)
    width = curve.half_width(u)
    x, y = x - ty * width * across, y + tx * width * across
    lean = np.interp(u, *LEAN) * (1 - 0.35 * max(across, 0)) - (18 if across > 0.3 and u > 0.35 else 0)
    c, s = np.cos(np.radians(lean)), np.sin(np.radians(lean))
    dx, dy = tx * c - ty * s, tx * s + ty * c
    length = rng.uniform(0.022, 0.042) * (1 if u < 0.8 else 0.75)
    middle = (x + dx * length * 0.55, y + dy * length * 0.55)
    end = (x + dx * length + tx * length * 0.25, y + dy * length - 0.004)
    return [(x, y), middle, end], int(rng.uniform(130, 255))


def brow_samplers(look: Look, rng: np.random.Generator):
    """Two functions of (|x|, y): the hairs, and the soft shadow under them."""
    curve = BrowCurve(look)
    hairs = Plane(0, 0.7, 7.3, 7.7, 1400, blur=0.0012)
    for _ in range(HAIRS):
        points, grey = _hair(curve, rng)
        hairs.line(points, grey, width=3)
    u = np.linspace(0, 1, 50)
    (x, y), half = curve.at(u), curve.half_width(u) * 0.85
    outline = np.concatenate([np.c_[x, y + half], np.c_[x, y - half][::-1]])
    shadow = Plane(0, 0.7, 7.3, 7.7, 700, blur=0.007).polygon(outline)
    return hairs.sampler(), shadow.sampler()


def paint_brows(colour, points, look: Look, rng: np.random.Generator) -> np.ndarray:
    """Brows over the skin colours (n, 3)."""
    hairs, shadow = brow_samplers(look, rng)
    across, up, front = np.abs(points[:, 0]), points[:, 1], points[:, 2] > 0.95
    brow = np.array(look.brow, np.float32)
    soft = (np.clip(shadow(across, up) * 0.38, 0, 1) * front)[:, None]
    colour = colour * (1 - soft) + colour * (brow * 0.6 + 0.25) * soft
    sharp = (np.clip(hairs(across, up) * 0.9, 0, 1) * front)[:, None]
    return colour * (1 - sharp) + brow * sharp
