"""The scalp under the hair: where hair grows on the skin, and how its roots are painted."""

import numpy as np

from .hair_cuts import STYLES
from .hair_frame import CENTRE
from .paintkit import Noise, smoothstep
from .people import Look

EDGE_TURNS = (-6, -3, 0, 3, 6)


def _turn(points: np.ndarray) -> np.ndarray:
    """Degrees (n,) from the front, either way."""
    return np.abs(np.degrees(np.arctan2(points[:, 0], points[:, 2] - CENTRE[2])))


def _turned(points: np.ndarray, by: float) -> np.ndarray:
    """Points (n, 3) carried around the head, radians."""
    x, z = points[:, 0], points[:, 2] - CENTRE[2]
    cosine, sine = np.cos(by), np.sin(by)
    return np.stack([x * cosine + z * sine, points[:, 1], z * cosine - x * sine + CENTRE[2]], -1)


def growth(points: np.ndarray, look: Look) -> np.ndarray:
    """How far inside the hairline (n,) points of the base head lie, in degrees around the skull."""
    away = points - CENTRE
    azimuth = _turn(points)
    elevation = np.degrees(np.arctan2(away[:, 1], np.hypot(away[:, 0], away[:, 2])))
    return elevation - np.interp(azimuth, *zip(*STYLES[look.hair_style].hairline, strict=True))


def paint_hair(colour, points, ears, noise: Noise, look: Look) -> np.ndarray:
    """Roots over the skin colours (n, 3): single hairs at the hairline, closer further in; no `ears` (n,)."""
    style = STYLES[look.hair_style]
    # A hairline that runs upright, as beside a sideburn, is no harder than a level one.
    turn = np.radians(EDGE_TURNS)
    level = [growth(_turned(points, by), look) for by in turn]
    inside = np.mean(level, axis=0) + 1.6 * noise.layered(points, 7, 3)
    soft = np.interp(_turn(points), *zip(*style.soft, strict=True))
    amount = smoothstep(-0.4 * soft, soft, inside)
    x, y, z = points.T
    turn = np.arctan2(x, z - CENTRE[2])
    strands = noise(np.stack([turn * 70, y * 9, z * 9], -1), 1)
    speckle = noise(points + 3, 150)
    ragged = 0.55 * strands + 0.45 * speckle
    # Where few hairs grow they are seen one by one, and shade the skin between them.
    single = smoothstep(0.9 - 1.6 * amount, 1.5 - 1.6 * amount, ragged)
    cover = style.scalp * np.clip(amount * (0.72 * amount + 0.28 + 0.5 * single * (1 - amount)), 0, 1)
    cover = (cover * (1 - np.clip(ears * 3, 0, 1)))[:, None]
    hair = np.clip(
        np.array(look.hair, np.float32) * (0.62 + 0.40 * max(look.hair) + 0.12 * strands[:, None]), 0, 1
    )
    return colour * (1 - cover) + hair * cover
