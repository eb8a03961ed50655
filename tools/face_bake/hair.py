"""The scalp under the hair: where hair grows on the skin, and how its roots are painted."""

import numpy as np

from .hair_cuts import STYLES
from .hair_frame import CENTRE
from .hair_styles import Style
from .paintkit import Noise, mix, smoothstep
from .people import Look
from .relief_cells import cells_where

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
    amount = _closeness(points, style, look, noise) * (1 - np.clip(ears * 3, 0, 1))
    turn = np.arctan2(points[:, 0], points[:, 2] - CENTRE[2])
    strands = noise(np.stack([turn * 70, points[:, 1] * 9, points[:, 2] * 9], -1), 1)
    tone = 0.66 + 0.36 * max(look.hair) + 0.12 * strands + 0.10 * noise(points, 11)
    hair = np.clip(np.array(look.hair, np.float32) * tone[:, None], 0, 1)
    # Where few hairs grow they are seen one by one, and their roots shade the skin between them.
    shade = style.scalp * (0.22 * amount + 0.78 * smoothstep(0.35, 1.0, amount))
    colour = mix(colour, hair, shade)
    for seed in (71, 72, 73):
        colour = mix(colour, hair, _single_hairs(points, turn, amount, seed))
    return colour


def _closeness(points, style: Style, look: Look, noise: Noise) -> np.ndarray:
    """How closely hair grows (n,), 0..1: no hairline is a line, it wanders and frays."""
    # A hairline that runs upright, as beside a sideburn, is no harder than a level one.
    level = [growth(_turned(points, by), look) for by in np.radians(EDGE_TURNS)]
    soft = np.interp(_turn(points), *zip(*style.soft, strict=True))
    uneven = 0.16 * noise.layered(points, 5, 2) + 0.10 * noise(points, 30)
    return smoothstep(-0.45, 1.0, np.mean(level, axis=0) / soft + uneven)


def _single_hairs(points, turn, amount, seed: int) -> np.ndarray:
    """How much of the skin (n,) short hairs cover where they are few; they lie up and down the head."""
    across, along = 0.0044, 0.024
    places = np.stack([turn * 0.9, points[:, 1] * across / along, points[:, 2] * across / along], -1)
    # Each layer's hairs slant another way.
    places[:, 0] += (seed % 3 - 1) * 0.22 * points[:, 1]
    there = (amount > 0.01) & (amount < 0.97)
    nearest, _, number = cells_where(there, places.astype(np.float32), across, seed)
    grows = number * 3.7 % 1 < 0.06 + 0.62 * amount
    strength = (0.22 + 0.40 * (number * 17.3 % 1)) * (0.55 + 0.45 * amount)
    few = smoothstep(0.0, 0.30, amount) * smoothstep(0.97, 0.75, amount)
    return strength * smoothstep(0.46, 0.18, nearest) * grows * few
