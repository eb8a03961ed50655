"""FACS units with a weight for each side of the face: every delta split smoothly at the face's midline."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.facs import Sides
from facemorph.core.motion import Contribution
from facemorph.core.rig import Rig
from facemorph.errors import UnknownNameError

# Half the width of the border between the sides, in parts of the face's half width.
BORDER = 0.12
_MIDLINE_IBUG = (8, 27, 28, 29, 30, 33, 51, 57, 62, 66)


class SidedUnits:
    """The FACS units of one rig: bind once, call for every change of a slider."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._index = {shape.name: k for k, shape in enumerate(rig.shapes)}

    @cached_property
    def _lean(self) -> Float32:
        """How much of a delta belongs to the left beyond one half, (V, 1): 1/2 far left, -1/2 right."""
        return (left_weights(self._rig) - np.float32(0.5))[:, None]

    def __call__(self, units: Mapping[int, Sides]) -> Contribution:
        """The mean of both sides as a weight, and what the sides differ by as offsets.

        delta (l w_L + r (1 - w_L)) = delta (l + r) / 2 + delta (l - r) (w_L - 1/2)
        """
        weights = {f"AU{number}": sides.weight for number, sides in units.items() if sides.weight != 0.0}
        uneven = [(number, sides) for number, sides in units.items() if sides.left != sides.right]
        if not uneven:
            return Contribution(weights)
        offsets = np.zeros_like(self._rig.neutral.positions)
        for number, sides in uneven:
            if f"AU{number}" not in self._index:
                raise UnknownNameError("FACS unit", f"AU{number}", self._index)
            delta = self._rig.deltas[self._index[f"AU{number}"]]
            offsets += delta * (self._lean * np.float32(sides.left - sides.right))
        return Contribution(weights, offsets)


def left_weights(rig: Rig) -> Float32:
    """How much each vertex belongs to the person's left (+X), (V,) float32: 1/2 on the midline, smooth."""
    x = rig.neutral.positions[:, 0].astype(np.float64)
    middle = midline(rig)
    half_width = max(float(np.abs(x - middle).max()), 1e-9)
    t = np.clip((x - middle) / (2.0 * BORDER * half_width) + 0.5, 0.0, 1.0)
    return (t * t * (3.0 - 2.0 * t)).astype(np.float32)


def midline(rig: Rig) -> float:
    """The x of the face's own midline: its landmarks on it, or the middle of its box."""
    marked = [mark.vertex for mark in rig.info.landmarks if mark.ibug in _MIDLINE_IBUG]
    if marked:
        return float(np.median(rig.neutral.positions[marked, 0]))
    return float(rig.neutral.bounds[:, 0].astype(np.float64).mean())
