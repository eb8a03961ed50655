"""The skin's colours, painted in the base head's space so that one layout fits all six people."""

from dataclasses import dataclass

import numpy as np

from .brows import paint_brows
from .hair import paint_hair
from .mouth_paint import LINING_LIGHT, paint_lining
from .paintkit import Noise, Plane, mix, smoothstep, tint
from .parts_eyes_lid_paint import lid_light, paint_lids
from .people import Look

RED = (1.02, 0.84, 0.81)
LIP_LIGHT = 0.68


@dataclass(frozen=True)
class Canvas:
    """What lies under each covered pixel: points (p, 3) on the base head; the rest (p,) in 0..1,
    except the distances to the upper and lower lid edges, in decimetres."""

    points: np.ndarray
    lips: np.ndarray
    ears: np.ndarray
    mouth: np.ndarray
    upper_lid: np.ndarray
    lower_lid: np.ndarray
    lid_edge: np.ndarray


def _spot(points, centre, radii) -> np.ndarray:
    """A soft spot (p,), mirrored left and right."""
    mirrored = np.stack([np.abs(points[:, 0]), points[:, 1], points[:, 2]], -1)
    scaled = (mirrored - np.array(centre, np.float32)) / np.array(radii, np.float32)
    return np.exp(-(scaled**2).sum(1))


def _zones(colour, points, mottling, look: Look) -> np.ndarray:
    """Redder and paler places of the face."""
    cheek = 0.50 * look.blush * _spot(points, (0.40, 6.98, 1.28), (0.20, 0.17, 0.3)) * (1 + 0.3 * mottling)
    colour = tint(colour, cheek, RED)
    for amount, centre, radii, factor in (
        (0.65, (0, 6.93, 1.68), (0.12, 0.12, 0.18), RED),
        (0.45, (0.14, 6.9, 1.5), (0.06, 0.07, 0.12), (1, 0.78, 0.74)),
        (0.35, (0, 6.28, 1.5), (0.16, 0.1, 0.2), RED),
        (0.30, (0, 7.75, 1.5), (0.5, 0.25, 0.4), (1.03, 1.0, 0.95)),
        (0.55, (0.24, 7.17, 1.40), (0.14, 0.05, 0.12), (0.86, 0.80, 0.84)),
        (0.60, (0.17, 7.27, 1.42), (0.06, 0.07, 0.1), (0.90, 0.74, 0.72)),
    ):
        colour = tint(colour, amount * _spot(points, centre, radii), factor)
    lid = Plane(0, 0.7, 7.0, 7.7, 400, blur=0.03).ellipse((0.135, 7.435), (0.50, 7.20)).sampler()
    return tint(colour, 0.25 * lid(np.abs(points[:, 0]), points[:, 1]) * (points[:, 2] > 1.1), look.lid)


def _lips(colour, canvas: Canvas, mottling, noise: Noise, look: Look) -> np.ndarray:
    """Lips with fine upright creases."""
    x, y, z = canvas.points.T
    creases = noise(np.stack([x * 55, y * 8, z * 8], -1), 1)
    lips = np.array(look.lips, np.float32) * (1 + 0.05 * mottling + 0.10 * creases)[:, None]
    return mix(colour, lips, canvas.lips * look.lip_strength)


def _freckles(colour, points, noise: Noise, look: Look) -> np.ndarray:
    if not look.freckles:
        return colour
    where = _spot(points, (0.22, 7.02, 1.45), (0.36, 0.2, 0.3)) + 0.25 * (points[:, 2] > 0.9)
    spots = np.clip(noise(points + 1.3, 34) - 1.35, 0, 1) * where
    dark = look.freckles * np.clip(spots * 1.6, 0, 0.55)
    return colour * (1 - dark[:, None] * np.array([0.30, 0.5, 0.62], np.float32))


def _stubble(colour, canvas: Canvas, noise: Noise, look: Look) -> np.ndarray:
    if not look.stubble:
        return colour
    x, y, z = canvas.points.T
    across = np.abs(x)
    jaw = smoothstep(6.86, 6.62, y - 0.30 * smoothstep(0.3, 0.7, across))
    jaw = jaw * smoothstep(5.95, 6.2, y) * smoothstep(0.62, 0.82, z)
    outline = [(-0.5, 6.80), (0.16, 6.80), (0.30, 6.68), (0.33, 6.5), (-0.5, 6.62)]
    moustache = Plane(-0.6, 1, 6, 7.2, 300, blur=0.025).polygon(outline).sampler()(across, y) * (z > 1.2)
    beard = np.clip(np.maximum(jaw, moustache) * (1 - canvas.lips), 0, 1)
    speckle = smoothstep(0.1, 1.2, noise(canvas.points + 9, 330))
    dark = look.stubble * beard * (0.38 + 0.34 * speckle)
    return colour * (1 - dark[:, None] * np.array([0.72, 0.68, 0.58], np.float32))


def paint_skin(canvas: Canvas, light: np.ndarray, look: Look, seed: int = 1) -> np.ndarray:
    """sRGB colours (p, 3); `light` (p,) is the baked occlusion."""
    noise, points = Noise(seed), canvas.points
    broad, mottling = noise.layered(points, 2.5, 3), noise.layered(points + 7, 14, 4)
    grain = 1 + 0.035 * broad + 0.03 * mottling + 0.022 * noise(points + 3, 120)
    colour = np.array(look.skin, np.float32) * grain[:, None]
    colour = _zones(colour, points, mottling, look)
    colour = tint(colour, 0.8 * canvas.ears * (0.6 + 0.4 * broad), (1.03, 0.82, 0.78))
    colour = tint(colour, 0.4 * smoothstep(6.25, 5.9, points[:, 1]), (0.96, 0.93, 0.90))
    colour = _lips(colour, canvas, mottling, noise, look)
    colour = _freckles(colour, points, noise, look)
    colour = _stubble(colour, canvas, noise, look)
    colour = paint_brows(colour, points, look)
    colour = paint_hair(colour, points, canvas.ears, noise, look)
    colour = paint_lids(colour, canvas.lid_edge, canvas.upper_lid, canvas.lower_lid, look)
    colour = paint_lining(colour, canvas, mottling, look)
    light = lid_light(np.clip(light * 1.12, 0, 1), canvas.lid_edge, canvas.upper_lid, canvas.lower_lid)
    # The neutral's closed mouth is dark on the lips' inner sides; an open one is not.
    light = np.where(canvas.mouth > 0, LINING_LIGHT, np.maximum(light, LIP_LIGHT * canvas.lips))
    # Shade in skin is warm: red light travels further through it.
    return colour * np.stack([light**0.75, light**1.05, light**1.10], -1)
