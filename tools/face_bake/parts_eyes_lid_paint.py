"""The lids' colours: a wet pink edge, a dark line where the lashes grow, a thin-skinned upper lid."""

import numpy as np

from .paintkit import mix, smoothstep, tint
from .people import Look

# Factors on the skin's colour.
WET, LASH_LINE = (1.0, 0.72, 0.68), (0.30, 0.24, 0.22)
# The edge of the upper lid, which faces down.
SHADED = (0.60, 0.47, 0.44)
# Least light on the edge, which moves out of the shade, and on the upper lid, which a blink unfolds.
EDGE_LIGHT, LID_LIGHT = 0.78, 0.76


def paint_lids(colour: np.ndarray, wet: np.ndarray, upper: np.ndarray, lower: np.ndarray, look: Look):
    """Over skin colours (p, 3); `wet` (p,) 0..1 on the lids' edges, distances (p,) to both lash lines."""
    # The upper lid's edge lies in the shade of its lashes.
    below = smoothstep(-0.03, 0.03, upper - lower)
    colour = tint(colour, 0.8 * smoothstep(0.15, 0.75, wet) * (1 - below), SHADED)
    wet = wet * below
    dry = np.clip(1 - 1.2 * wet, 0, 1)
    strength = 0.70 if look.feminine else 0.45
    colour = tint(colour, strength * dry * smoothstep(0.024, 0.004, upper), LASH_LINE)
    colour = tint(colour, 0.30 * strength * dry * smoothstep(0.014, 0.002, lower), LASH_LINE)
    # Under thin skin blood shows; dark skin less, as on lips.
    pale = np.array(look.skin, np.float32) * np.array(WET, np.float32)
    pink = np.array(look.lips, np.float32)
    return mix(colour, 0.62 * pale + 0.38 * pink, 0.85 * smoothstep(0.25, 0.85, wet))


def lid_light(light: np.ndarray, wet: np.ndarray, upper: np.ndarray, lower: np.ndarray) -> np.ndarray:
    """The baked light (p,), no less than what lids have when they move."""
    lid = LID_LIGHT * smoothstep(0.17, 0.08, upper)
    edge = EDGE_LIGHT * smoothstep(-0.03, 0.03, upper - lower) * smoothstep(0.1, 0.7, wet)
    return np.maximum(light, np.maximum(lid, edge))
