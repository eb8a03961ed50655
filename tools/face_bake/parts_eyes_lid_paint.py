"""The lids' colours: a wet pink lower edge, a dark upper one where the lashes grow, thin skin above."""

import numpy as np

from .paintkit import mix, smoothstep, tint
from .people import Look

# Factors on the skin's colour.
WET, LASH_LINE = (0.97, 0.70, 0.66), (0.30, 0.22, 0.20)
# Least light on the lower edge, which moves out of the shade, and on the upper lid, which a blink unfolds.
EDGE_LIGHT, LID_LIGHT = 0.66, 0.76


def paint_lids(colour: np.ndarray, edge: np.ndarray, upper: np.ndarray, lower: np.ndarray, look: Look):
    """Over skin (p, 3); `edge` (p,) 0..1 between ball and lashes, distances (p,) to both lash lines."""
    below = smoothstep(-0.03, 0.03, upper - lower)
    strength = 0.86 if look.feminine else 0.74
    # The upper edge faces down, into the shade of its lashes: it is what outlines an eye.
    line = np.maximum(smoothstep(0.026, 0.006, upper), smoothstep(0.08, 0.60, edge) * (1 - below))
    colour = tint(colour, strength * line, LASH_LINE)
    wet = smoothstep(0.50, 0.95, edge) * below
    colour = tint(colour, 0.45 * strength * smoothstep(0.016, 0.003, lower) * (1 - wet), LASH_LINE)
    # Under thin skin blood shows; on dark skin less, as on lips.
    pale = np.array(look.skin, np.float32) * np.array(WET, np.float32)
    return mix(colour, 0.62 * pale + 0.38 * np.array(look.lips, np.float32), 0.85 * wet)


def lid_light(light: np.ndarray, edge: np.ndarray, upper: np.ndarray, lower: np.ndarray) -> np.ndarray:
    """The baked light (p,), no less than what lids have when they move."""
    lid = LID_LIGHT * smoothstep(0.17, 0.08, upper)
    wet = EDGE_LIGHT * smoothstep(-0.03, 0.03, upper - lower) * smoothstep(0.4, 0.9, edge)
    return np.maximum(light, np.maximum(lid, wet))
