"""What colours skin: melanin and blood, by place, in spots and in veins; and the hairs of a shaven beard."""

import numpy as np

from .paintkit import Noise, mix, smoothstep
from .people import Look
from .relief_cells import cells_where

# What one unit of each takes from sRGB red, green and blue, as exponents (after Tsumura 2003).
MELANIN = np.array([0.30, 0.52, 0.72], np.float32)
BLOOD = np.array([0.03, 0.30, 0.27], np.float32)
# The axis of the head that the way around it is measured about.
AXIS_Z = 0.35
# Freckles, age spots and hairs: how far apart, in decimetres.
FRECKLE, AGE_SPOT, HAIR = 0.034, 0.150, 0.0100


def spot(points, centre, radii) -> np.ndarray:
    """A soft spot (p,), mirrored left and right."""
    mirrored = np.stack([np.abs(points[:, 0]), points[:, 1], points[:, 2]], -1)
    return np.exp(-(((mirrored - np.array(centre)) / np.array(radii)) ** 2).sum(1))


def stained(colour: np.ndarray, melanin: np.ndarray, blood: np.ndarray) -> np.ndarray:
    """Colours (p, 3) with more or less of both, (p,)."""
    return colour * np.exp(-melanin[:, None] * MELANIN - blood[:, None] * BLOOD)


def paleness(look: Look) -> float:
    """1 for skin so fair that blood shows, 0.3 for the darkest."""
    return float(np.clip((look.skin[1] - 0.20) / 0.45, 0.3, 1.0))


def blood_of(points, ears, broad, mottling, look: Look) -> np.ndarray:
    """Blood (p,) under the skin: in cheeks, nose, ears, lids and chin; less in the forehead's middle."""
    total = 0.05 * broad + 0.035 * mottling
    for amount, centre, radii in (
        (0.26 * look.blush, (0.41, 6.96, 1.35), (0.24, 0.19, 0.34)),
        (0.30, (0, 6.93, 1.68), (0.11, 0.11, 0.18)),
        (0.38, (0.145, 6.89, 1.5), (0.055, 0.06, 0.12)),
        (0.30, (0, 6.28, 1.5), (0.15, 0.09, 0.20)),
        (0.30, (0.32, 7.17, 1.40), (0.18, 0.06, 0.15)),
        (0.28, (0.16, 7.27, 1.42), (0.06, 0.07, 0.10)),
        (-0.22, (0, 7.78, 1.5), (0.45, 0.22, 0.4)),
        (-0.20, (0.30, 6.66, 1.4), (0.10, 0.10, 0.2)),
        (-0.18, (0.62, 7.40, 1.0), (0.16, 0.20, 0.3)),
    ):
        total = total + amount * spot(points, centre, radii) * (1 + 0.10 * mottling)
    shells = ears * (np.abs(points[:, 0]) > 0.66)
    return paleness(look) * (total + 0.45 * shells * (0.8 + 0.2 * broad))


def melanin_of(points, mottling, noise: Noise, look: Look, age: float) -> np.ndarray:
    """Melanin (p,) more or less than elsewhere: sun on top, a paler throat, darkness around the eyes."""
    total = 0.035 * mottling + 0.03 * noise(points + 3, 55) + 0.025 * noise(points + 5, 120)
    for amount, centre, radii in (
        (0.05, (0, 7.78, 1.5), (0.5, 0.25, 0.4)),
        (0.07, (0.22, 7.13, 1.40), (0.13, 0.05, 0.12)),
        (0.06, (0.30, 7.42, 1.40), (0.18, 0.06, 0.15)),
        (-0.06, (0.44, 6.80, 1.1), (0.20, 0.20, 0.3)),
    ):
        total = total + (1 + 0.5 * age) * amount * spot(points, centre, radii)
    return total - 0.07 * smoothstep(6.25, 5.95, points[:, 1]) * (points[:, 2] > 0.2)


def veins(colour, points, noise: Noise, look: Look) -> np.ndarray:
    """A hint of blue in winding lines at the temples and below the eyes."""
    bend = points + 0.05 * np.stack([noise(points + k, 9) for k in (20, 21, 22)], -1)
    line = 1 - smoothstep(0.0, 0.20, np.abs(noise(bend, 7.5)))
    where = spot(points, (0.63, 7.50, 0.95), (0.14, 0.22, 0.35)) + 0.6 * spot(
        points, (0.28, 7.13, 1.4), (0.16, 0.05, 0.2)
    )
    amount = 0.55 * paleness(look) * line * np.clip(where, 0, 1)
    hollow = 0.45 * paleness(look) * spot(points, (0.24, 7.155, 1.40), (0.13, 0.045, 0.12))
    return colour * (1 - np.clip(amount + hollow, 0, 1)[:, None] * np.array([0.10, 0.055, 0.015], np.float32))


def freckled(colour, points, noise: Noise, look: Look) -> np.ndarray:
    """Small spots, closest over nose and cheeks, some large, most faint."""
    if not look.freckles:
        return colour
    where = 1.0 * spot(points, (0.24, 7.03, 1.45), (0.30, 0.16, 0.3)) + 0.45 * spot(
        points, (0, 7.10, 1.6), (0.14, 0.22, 0.3)
    )
    where = 1.2 * where + 0.22 * (points[:, 2] > 0.8) + 0.18 * (points[:, 1] < 5.7)
    patchy = np.clip(0.75 + 0.45 * noise(points, 6), 0, 1.3)
    melanin = np.zeros(len(points), np.float32)
    for size, share, seed in ((FRECKLE, 0.75, 41), (0.6 * FRECKLE, 0.9, 42)):
        uneven = points + 0.10 * size * noise(points, 60)[:, None]
        nearest, _, number = cells_where(where > 0.03, uneven, size, seed)
        radius = 0.10 + 0.20 * (number * 7.3 % 1)
        there = number < share * np.clip(where * patchy, 0, 1)
        strength = 0.35 + 0.65 * (number * 31.7 % 1)
        melanin += there * strength * smoothstep(1.25 * radius, 0.45 * radius, nearest)
    return stained(colour, look.freckles * 1.05 * np.clip(melanin, 0, 1.3), np.zeros_like(melanin))


def aged(colour, points, noise: Noise, age: float) -> np.ndarray:
    """Flat brown spots with uneven edges on temples and forehead, and broken veins by the nose."""
    if age < 0.5:
        return colour
    wavy = points + 0.03 * noise(points, 22)[:, None] + 0.012 * noise(points + 4, 60)[:, None]
    where = spot(points, (0.58, 7.45, 1.0), (0.26, 0.40, 0.5)) + 0.8 * spot(
        points, (0.30, 7.88, 1.3), (0.35, 0.22, 0.4)
    )
    nearest, _, number = cells_where(where > 0.02, wavy, AGE_SPOT, 51)
    there = number < 0.50 * np.clip(where, 0, 1)
    radius = 0.12 + 0.22 * (number * 13.1 % 1)
    melanin = there * (0.25 + 0.35 * (number * 5.9 % 1)) * smoothstep(1.15 * radius, 0.75 * radius, nearest)
    broken = smoothstep(0.12, 0.0, np.abs(noise(points + 8, 30))) * smoothstep(0.2, 1.0, noise(points, 12))
    nearby = spot(points, (0.20, 6.93, 1.5), (0.10, 0.10, 0.2)) + 0.5 * spot(
        points, (0.40, 6.98, 1.4), (0.16, 0.12, 0.2)
    )
    return stained(colour, 0.75 * age * melanin, 0.6 * age * broken * np.clip(nearby, 0, 1))


def _beard(points, lips, noise: Noise) -> np.ndarray:
    """How closely hair grows (p,): jaw, chin and upper lip, thinning over the cheeks and down the throat."""
    x, y, z = points.T
    around = np.abs(np.arctan2(x, z - AXIS_Z))
    # The upper edge runs from the sideburn down past the corner of the mouth.
    edge = np.interp(around, [0.0, 0.28, 0.40, 0.75, 1.15, 1.6], [6.50, 6.62, 6.70, 6.78, 6.98, 7.15])
    edge = edge + 0.035 * noise.layered(points, 9, 2)
    jaw = smoothstep(edge + 0.07, edge - 0.13, y) * smoothstep(6.02, 6.38, y + 0.03 * noise(points, 8))
    jaw = jaw * smoothstep(1.75, 1.45, around) * (z > AXIS_Z - 0.2)
    jaw = jaw * (1 - 0.35 * spot(points, (0.20, 6.50, 1.45), (0.09, 0.05, 0.2)))
    lip = smoothstep(6.685, 6.715, y) * smoothstep(6.865, 6.80, y + 0.10 * around)
    lip = lip * smoothstep(0.36, 0.25, around) * (1 - 0.4 * smoothstep(0.035, 0.01, np.abs(x)))
    beside = smoothstep(0.42, 0.30, around) * smoothstep(0.20, 0.27, around) * smoothstep(6.78, 6.68, y)
    beside = beside * smoothstep(6.35, 6.5, y) * 0.8
    return np.clip(np.maximum(np.maximum(jaw, lip), beside), 0, 1) * (1 - np.clip(2.5 * lips, 0, 1))


def shaven(colour, points, lips, ears, noise: Noise, look: Look) -> np.ndarray:
    """Stubble: roots shimmer bluish through the skin, and short hairs point down out of it."""
    if not look.stubble:
        return colour
    beard = _beard(points, lips, noise) * (1 - np.clip(2 * ears, 0, 1))
    depth = look.stubble * beard * (1 + 0.15 * noise(points, 7))
    # Light that comes back from below the skin lacks its warm part where dark roots swallow it.
    colour = colour * (1 - 0.55 * depth[:, None] * np.array([0.42, 0.36, 0.27], np.float32))
    slanted = points * np.array([1.0, 0.50, 1.0], np.float32)
    slanted = slanted + 0.10 * points[:, 1:2] * np.sign(points[:, :1]) * np.array([1.0, 0, 0], np.float32)
    for seed in (61, 62):
        nearest, _, number = cells_where(beard > 0.02, slanted, HAIR, seed)
        grey = np.mean(look.hair) > 0.3
        hair = np.array(look.hair, np.float32) * (0.62 if grey else 0.55)
        hair = np.clip(hair + (0.25 * (number[:, None] * 17.3 % 1) if grey else 0.0), 0, 1)
        seen = smoothstep(0.40, 0.14, nearest) * (number * 3.7 % 1 < 0.25 + 0.75 * beard)
        colour = mix(colour, hair, np.clip(0.54 * look.stubble * smoothstep(0.05, 0.6, beard) * seen, 0, 1))
    return colour
