"""The jaw swings on its hinge: the source's straight way to an open jaw is bent onto the arc."""

import numpy as np

from .parts_eyes_ball import rotation_between

OPENING = "jawOpen"
# MakeHuman's helper of the lower teeth, which the jaw carries.
LOWER_TEETH = np.arange(14992, 15060)


class Jaw:
    """The rotation that an open jaw is, found from the lower teeth, and how much each vertex takes part.

    neutral, opening: (19158, 3) in base-mesh space; opening is the offset of the jaw fully open.
    """

    def __init__(self, neutral: np.ndarray, opening: np.ndarray):
        before, after = neutral[LOWER_TEETH], (neutral + opening)[LOWER_TEETH]
        turn = rotation_between(before, after)
        self._angle = float(np.arctan2(turn[2, 1] - turn[1, 2], turn[1, 1] + turn[2, 2]))
        self._hinge = self._fixed_point(turn, before.mean(0), after.mean(0))
        self._arm = (neutral - self._hinge)[:, 1:]
        swing = self._swing(1.0)
        length = np.maximum((swing**2).sum(1), 1e-9)
        self._share = np.clip((opening[:, 1:] * swing).sum(1) / length, 0, 1)[:, None]

    @staticmethod
    def _fixed_point(turn, before, after) -> np.ndarray:
        """What stays where it is: the hinge is a line along x through it."""
        move = after - turn @ before
        y, z = np.linalg.solve((np.eye(3) - turn)[1:, 1:], move[1:])
        return np.array([0.0, y, z])

    def _swing(self, part: float) -> np.ndarray:
        """How far (n, 2), in y and z, each vertex moves if it turns by a part of the full angle."""
        c, s = np.cos(part * self._angle), np.sin(part * self._angle)
        return self._arm @ np.array([[c, s], [-s, c]]) - self._arm

    def bend(self, part: float) -> np.ndarray:
        """What leads (19158, 3) from the straight way onto the arc at a part of the opening."""
        bent = np.zeros((len(self._arm), 3))
        bent[:, 1:] = self._share * (self._swing(part) - part * self._swing(1.0))
        return bent
