"""The lining of lips, cheeks and throat: the lips' red grows wetter and deeper inwards, from lips that
are in their own shade where they meet."""

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from .paintkit import mix, smoothstep, tint
from .people import Look

if TYPE_CHECKING:
    from .skin import Canvas

# No shade of the closed mouth is baked in: how much light comes in depends on how far it is open.
LINING_LIGHT = 0.9
INNER_LIP, CHEEK = np.array([0.70, 0.33, 0.33], np.float32), np.array([0.58, 0.24, 0.23], np.float32)
# Decimetres from the lips' rim: where the lips' own colour ends, and where the cheek's begins.
LIP_FADES, CHEEK_BEGINS = (0.0, 0.05), (0.02, 0.16)
# What is left of the lips' colour at their rim, which curls in, and in their corners, where shade is soft.
RIM_SHADE, RIM_REACH, RIM_BAND = np.array([0.76, 0.60, 0.60], np.float32), 0.055, 0.02
CORNER_SHADE = np.array([0.82, 0.71, 0.69], np.float32)
# A corner on the base head: |x|, y; and how far its shade reaches along both.
CORNER, CORNER_REACH, CORNER_FRONT = (0.262, 6.602), (0.034, 0.022), 1.30


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
    colour = _shaded_lips(colour, canvas)
    return mix(colour, lining * (1 + 0.07 * mottling[:, None]), canvas.mouth)


def _shaded_lips(colour: np.ndarray, canvas: "Canvas") -> np.ndarray:
    """Colours (p, 3) darker and redder towards the lips' rim and in their corners."""
    return tint(tint(colour, rim_of(canvas), RIM_SHADE), corners_of(canvas), CORNER_SHADE)


def rim_of(canvas: "Canvas") -> np.ndarray:
    """How near the rim, behind where they meet, a place of the lips is (p,): 1 on it, 0 where they show."""
    rim, inside = np.zeros(len(canvas.points), np.float32), canvas.mouth > 0
    near = np.flatnonzero((canvas.lips > 0.05) & ~inside)
    if not inside.any() or not len(near):
        return rim
    lips = canvas.points[near]
    lining = canvas.points[inside]
    edge = lining[cKDTree(lips[:: max(len(lips) // 4000, 1)]).query(lining)[0] < RIM_BAND]
    rim[near] = 1 - smoothstep(0.0, RIM_REACH, cKDTree(edge).query(lips)[0])
    return rim


def corners_of(canvas: "Canvas") -> np.ndarray:
    """How near a corner of the mouth a place of the skin is (p,), softly from 1 to 0."""
    x, y, z = canvas.points.T
    aside, up = (np.abs(x) - CORNER[0]) / CORNER_REACH[0], (y - CORNER[1]) / CORNER_REACH[1]
    return np.exp(-(aside**2) - up**2) * (z > CORNER_FRONT) * (canvas.mouth == 0)
