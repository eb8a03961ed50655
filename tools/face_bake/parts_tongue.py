"""The tongue: MakeHuman's helper, smoothed and laid into the lower arch."""

import numpy as np

from .parts import PartGroup, Posed
from .subdivide import compact, refine_smooth

LOWER_TEETH = np.arange(14992, 15060)
# The helper fills the closed mouth; flatter and lower it leaves room, and it sinks with the jaw.
FLATTEN, DROP, BACK, SINK = 0.72, 0.03, 0.03, 0.22


class Tongue:
    def __init__(self, quads: np.ndarray, points: np.ndarray):
        self._used, faces = compact(quads)
        smooth = refine_smooth(len(self._used), faces)
        self._operator = smooth.operator[: len(self._used)].tocsr()
        self.groups = [PartGroup("tongue", "tongue", faces, faces)]
        flat = points[self._used][:, [0, 2]]
        low, high = flat.min(0), flat.max(0)
        self.uv = 0.02 + 0.96 * (flat - low) / (high - low)

    def place(self, posed: Posed) -> np.ndarray:
        return self.laid(posed.shape, posed.neutral)

    def laid(self, shape: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        """Points (n, 3) of a shape (19158, 3) in base-mesh space."""
        points = self._operator @ shape[self._used]
        floor = points[:, 1].min()
        points[:, 1] = floor + (points[:, 1] - floor) * FLATTEN
        jaw = (shape[LOWER_TEETH] - neutral[LOWER_TEETH]).mean(0)[1]
        return points + np.array([0, -DROP + SINK * min(jaw, 0), -BACK])
