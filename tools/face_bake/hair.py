"""Short hair: where it grows, how far it lifts the scalp and how it is painted."""

import numpy as np

from .finemesh import FineMesh
from .paintkit import Noise, Plane, smoothstep
from .people import Look

# The hair line seen from the side: z (forward) and y (up) in decimetres on the base head.
HAIR_LINE = [
    (1.36, 8.03),
    (1.30, 7.95),
    (1.18, 7.86),
    (1.08, 7.70),
    (1.03, 7.52),
    (0.98, 7.40),
    (0.86, 7.30),
    (0.80, 7.15),
    (0.77, 6.98),
    (0.68, 6.97),
    (0.66, 7.22),
    (0.60, 7.40),
    (0.48, 7.42),
    (0.36, 7.36),
    (0.30, 7.2),
    (0.27, 6.95),
    (0.20, 6.78),
    (0.0, 6.66),
    (-0.3, 6.6),
    (-0.6, 6.6),
    (-0.6, 8.8),
    (1.4, 8.8),
]
LENGTHS = {"buzz": 0.018, "short": 0.085, "back": 0.055}
TOP_EXTRA = {"buzz": 0.4, "short": 0.75, "back": 0.4}


def _feminine(z: float, y: float) -> tuple[float, float]:
    """No sideburns, and a slightly higher forehead."""
    if y > 7.3 or z < 0.6:
        return (z - 0.03 if z > 0.9 else z), y
    return z, max(y, 7.16)


def hair_mask(points: np.ndarray, noise: Noise, look: Look) -> np.ndarray:
    """1 where hair grows on the base head's points (n, 3), with a ragged edge."""
    outline = [_feminine(z, y) for z, y in HAIR_LINE] if look.feminine else HAIR_LINE
    sample = Plane(-0.8, 1.6, 6.2, 8.9, 200, blur=0.02).polygon(outline).sampler()
    z = points[:, 2] + 0.012 * noise.layered(points, 9)
    y = points[:, 1] + 0.016 * noise.layered(points + 5, 9)
    return sample(z, y)


def scalp_lift(fine: FineMesh, base_points: np.ndarray, look: Look) -> np.ndarray:
    """How far (n,) the hair raises each fine vertex along its normal, in decimetres."""
    points, noise = fine.operator @ base_points, Noise(11)
    mask = hair_mask(points, noise, look)
    averaging = fine.averaging()
    for _ in range(3):
        mask = 0.5 * mask + 0.5 * (averaging @ mask)
    x, y, z = points.T
    ear = (np.abs(x) > 0.70) & (z > 0.34) & (z < 0.68) & (y < 7.40)
    mask = np.where(ear, 0, mask)
    style = look.hair_style
    lift = LENGTHS[style] * (0.45 + TOP_EXTRA[style] * smoothstep(7.5, 8.3, y)) * smoothstep(0.15, 1.0, mask)
    if style == "short":
        lift = lift * (1 + 0.22 * noise(points * [5, 3, 5], 1))
    return lift


def _strands(points, turn, noise: Noise, style: str) -> np.ndarray:
    """Light and dark strands (n,), stretched the way the style is combed."""
    x, y, z = points.T
    if style == "buzz":
        return 0.9 * noise(points, 95) + 0.5 * noise(points, 40)
    if style == "back":
        broad = noise(np.stack([x * 34 + 0.5 * noise(points, 2), y * 2.0, z * 2.0], -1), 1)
        fine = noise(np.stack([(x * 0.8 + y * 0.5 * np.sign(x)) * 75, y * 3, z * 3], -1), 1)
        return 0.8 * broad + 0.8 * fine
    broad = noise(np.stack([turn * 26 + 0.6 * noise(points, 3), np.hypot(x, z) * 2, y * 2.2], -1), 1)
    return broad + 0.6 * noise(np.stack([turn * 60, y * 5, z * 3], -1), 1)


def paint_hair(colour, points, ears, noise: Noise, look: Look) -> np.ndarray:
    """Hair over the skin colours (n, 3); `ears` (n,) stay bare."""
    mask = hair_mask(points, noise, look) * (1 - np.clip(ears * 3, 0, 1))
    x, y, z = points.T
    turn = np.arctan2(x, z - 0.35)
    frayed = noise(np.stack([turn * 40, y * 7, z * 7], -1), 1) * (mask > 0.02) * (mask < 0.9)
    amount = (np.clip(mask * 1.25 + 0.22 * frayed, 0, 1) * look.hair_strength)[:, None]
    strands = _strands(points, turn, noise, look.hair_style)
    hair = np.clip(np.array(look.hair, np.float32) * (1 + 0.30 * strands[:, None]), 0, 1)
    return colour * (1 - amount) + hair * amount
