"""The lining of lips, cheeks and throat: the lips' red grows wetter and deeper inwards."""

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from .paintkit import mix, smoothstep
from .people import Look

if TYPE_CHECKING:
    from .skin import Canvas

# No shade of the closed mouth is baked in: how much light comes in depends on how far it is open.
LINING_LIGHT = 0.9
INNER_LIP, CHEEK = np.array([0.70, 0.33, 0.33], np.float32), np.array([0.58, 0.24, 0.23], np.float32)
# Decimetres from the lips' rim: where the lips' own colour ends, and where the cheek's begins.
LIP_FADES, CHEEK_BEGINS = (0.0, 0.05), (0.02, 0.16)


def paint_lining(colour: np.ndarray, canvas: "Canvas", mottling: np.ndarray, look: Look) -> np.ndarray:
    """The colours (p, 3) with those inside the mouth replaced."""
    inside = canvas.mouth > 0
    if not inside.any():
        return colour
    rim = canvas.points[(canvas.lips > 0.2) & ~inside]
    depth = np.zeros(len(colour), np.float32)
    depth[inside] = cKDTree(rim[:: max(len(rim) // 4000, 1)]).query(canvas.points[inside])[0]
    lips = np.array(look.lips, np.float32)
    inner = 0.5 * (INNER_LIP + np.minimum(lips * [1.0, 0.9, 0.9], INNER_LIP))
    lining = mix(inner + 0 * colour, CHEEK, smoothstep(*CHEEK_BEGINS, depth))
    lining = mix(lining, lips, 1 - smoothstep(*LIP_FADES, depth))
    return mix(colour, lining * (1 + 0.07 * mottling[:, None]), canvas.mouth)
