"""The skin's colours, painted in the base head's space so that one layout fits all six people."""

from dataclasses import dataclass

import numpy as np

from .brows import paint_brows
from .hair import paint_hair
from .mouth_paint import LINING_LIGHT, paint_lining
from .paintkit import Noise, mix, smoothstep, tint
from .parts_eyes_lid_paint import lid_light, paint_lids
from .people import Look
from .skin_tones import aged, blood_of, freckled, melanin_of, paleness, shaven, stained, veins

LIP_LIGHT = 0.68
# A factor on the skin around the lips.
BESIDE_LIPS = (1.04, 1.03, 1.03)
# How deep shade is in the stored colours, by channel.
SHADE = (0.62, 0.86, 0.92)
# and how deep that of hair is, which lies on the skin and not in it.
HAIR_SHADE = (0.80, 0.85, 0.87)


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


def _lips(colour, canvas: Canvas, mottling, noise: Noise, look: Look) -> np.ndarray:
    """Lips with fine upright creases; their border is soft, on dark skin darker than they are."""
    x, y, z = canvas.points.T
    edge, pale = canvas.lips, paleness(look)
    colour = tint(colour, 0.5 * pale * smoothstep(0.0, 0.12, edge) * smoothstep(0.5, 0.15, edge), BESIDE_LIPS)
    creases = noise(np.stack([x * 84 + 0.8 * np.sin(25 * y), y * 7, z * 7], -1), 1)
    fine = noise(np.stack([x * 190, y * 20, z * 20], -1), 1)
    tone = 1 + 0.05 * mottling + 0.07 * np.abs(creases) + 0.03 * fine
    middle = np.abs(y - 6.625 - 0.10 * np.abs(x))
    lips = np.array(look.lips, np.float32) * tone[:, None]
    # Fuller colour towards the middle line, where lips are wet; the upper lip lies in shade and is browner.
    lips = tint(lips, 0.35 * smoothstep(0.065, 0.0, middle), (0.90, 0.80, 0.82))
    upper = smoothstep(6.60, 6.65, y - 0.10 * np.abs(x))
    lips = tint(lips, upper, (0.95, 0.93, 0.93))
    # Melanin gathers at the border of dark lips and leaves the middle of the lower one rosy.
    rim = (1 - pale) / 0.7 * smoothstep(1.0, 0.35, edge)
    lips = tint(lips, 0.5 * rim, (0.74, 0.70, 0.72))
    uneven = edge + 0.06 * fine * (edge > 0.05)
    return mix(colour, lips, smoothstep(0.02, 0.95, uneven) * look.lip_strength)


def paint_skin(
    canvas: Canvas, light: np.ndarray, hair: np.ndarray, look: Look, age: float = 0.0, seed: int = 1
) -> np.ndarray:
    """sRGB colours (p, 3); `light` (p,) is the baked occlusion and `hair` what hair leaves of it; age 0 young
    to 1 old."""
    noise, points = Noise(seed), canvas.points
    broad, mottling = noise.layered(points, 2.5, 3), noise.layered(points + 7, 14, 4)
    colour = np.tile(np.array(look.skin, np.float32), (len(points), 1))
    colour = colour * (1 + 0.02 * broad + 0.012 * noise(points + 3, 150))[:, None]
    melanin = melanin_of(points, mottling, noise, look, age)
    colour = stained(colour, melanin, blood_of(points, canvas.ears, broad, mottling, look))
    colour = veins(colour, points, noise, look)
    colour = aged(colour, points, noise, age)
    colour = freckled(colour, points, noise, look)
    colour = shaven(colour, points, canvas.lips, canvas.ears, noise, look)
    colour = _lips(colour, canvas, mottling, noise, look)
    colour = paint_brows(colour, points, look)
    colour = paint_hair(colour, points, canvas.ears, noise, look)
    colour = paint_lids(colour, canvas.lid_edge, canvas.upper_lid, canvas.lower_lid, look)
    colour = paint_lining(colour, canvas, mottling, look)
    light = lid_light(np.clip(light * 1.12, 0, 1), canvas.lid_edge, canvas.upper_lid, canvas.lower_lid)
    # The neutral's closed mouth is dark on the lips' inner sides; an open one is not.
    light = np.where(canvas.mouth > 0, LINING_LIGHT, np.maximum(light, LIP_LIGHT * canvas.lips))
    # Shade in skin is warm, for red light travels further through it, and fair skin throws light into its
    # own hollows.
    red, green, blue = np.array(SHADE) * (1 - 0.30 * paleness(look))
    colour = colour * np.stack([hair**power for power in HAIR_SHADE], -1)
    return colour * np.stack([light**red, light**green, light**blue], -1)
