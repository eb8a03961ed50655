"""The tongue: a tapering body swept along a line from its root over the floor of the mouth.

It lies inside the lower teeth and goes with the jaw; the root stays with the throat. How far it is
out is read off MakeHuman's helper tongue.
"""

import numpy as np

from .mouth_fit import Arch, MouthFit
from .parts import PartGroup, Posed
from .polygons import NONE
from .strips import catmull_rom

# MakeHuman's helper at the tip, and how far ARKit's tongueOut moves it.
HELPER_TIP = np.array([13478, 13578, 13482, 13582, 13381, 13380, 13481, 13581, 13479, 13579])
FULLY_OUT = 0.27
# Across and above the middle line, once around: the flat upper side first, from right to left.
AROUND_X = np.array([-1, -0.86, -0.58, -0.28, 0, 0.28, 0.58, 0.86, 1, 0.84, 0.45, 0, -0.45, -0.84])
TOP_COLUMNS = 9
RINGS = 15
# The middle line at fractions of its length: up from the lower teeth's edge and forward from their front.
FRACTIONS = np.array([0, 0.25, 0.5, 0.72, 0.88, 1.0])
AT_REST = np.array(
    [[-0.20, -0.64], [-0.115, -0.50], [-0.105, -0.34], [-0.115, -0.225], [-0.118, -0.155], [-0.120, -0.11]]
)
OUT = np.array([[-0.10, -0.64], [0.01, -0.42], [0.012, -0.17], [0.030, 0.02], [0.024, 0.15], [-0.006, 0.235]])
# Half as thick, along the line: at rest and out. The last ring is rounded off into the tip.
THICK = (
    np.array([0.115, 0.115, 0.095, 0.066, 0.048, 0.028]),
    np.array([0.115, 0.10, 0.06, 0.033, 0.029, 0.018]),
)
ROOT_WITH_JAW = 0.7
# Vertices that are landmarks, counted from the tongue's first.
_MIDDLE_RING = 8 * len(AROUND_X)
TONGUE_TIP, TONGUE_CENTRE = RINGS * len(AROUND_X), _MIDDLE_RING + TOP_COLUMNS // 2
TONGUE_RIGHT, TONGUE_LEFT = _MIDDLE_RING, _MIDDLE_RING + TOP_COLUMNS - 1


class Tongue:
    def __init__(self):
        along = 1 - (1 - np.linspace(0, 1, RINGS)) ** 1.35
        self._along = along
        self._weights = catmull_rom(len(FRACTIONS), np.interp(along, FRACTIONS, np.arange(len(FRACTIONS))))
        across = np.tile(0.5 + 0.5 * AROUND_X, RINGS)
        below = np.tile(np.arange(len(AROUND_X)) >= TOP_COLUMNS, RINGS)
        length = np.repeat(along, len(AROUND_X))
        # The upper side fills the picture but for a strip, in which the lower side is.
        u = np.where(below, 0.02 + 0.05 * across, 0.09 + 0.89 * across)
        self.uv = np.concatenate([np.stack([u, 0.02 + 0.94 * length], -1), [[0.535, 0.985]]])
        polygons = self._polygons()
        self.groups = [PartGroup("tongue", "tongue", polygons, polygons)]

    def _polygons(self) -> np.ndarray:
        n = len(AROUND_X)
        here, after = np.arange(n), (np.arange(n) + 1) % n
        rows = [
            np.stack([r * n + here, (r + 1) * n + here, (r + 1) * n + after, r * n + after], -1)
            for r in range(RINGS - 1)
        ]
        last = (RINGS - 1) * n
        tip = np.stack([last + here, np.full(n, RINGS * n), last + after, np.full(n, NONE)], -1)
        return np.concatenate([*rows, tip])

    def place(self, posed: Posed) -> np.ndarray:
        """Points (n, 3) in base-mesh space."""
        fit = posed.body.mouth
        amount = amount_out(fit, posed.shape, posed.neutral)
        points = self._body(fit.lower, amount)
        rotation, offset = fit.jaw(posed.shape)
        with_jaw = points @ rotation.T + offset
        along = np.append(np.repeat(self._along, len(AROUND_X)), 1.0)
        follows = ROOT_WITH_JAW + (1 - ROOT_WITH_JAW) * np.clip(along / 0.5, 0, 1)
        return points + follows[:, None] * (with_jaw - points)

    @staticmethod
    def _line(arch: Arch, amount: float, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The middle line (k, 2) as y, z with the jaw shut, and half the thickness (k,)."""
        line = weights @ (AT_REST + amount * (OUT - AT_REST)) + [arch.edge, arch.front]
        return line, weights @ (THICK[0] + amount * (THICK[1] - THICK[0]))

    def outline(self, fit: MouthFit, shape: np.ndarray, neutral: np.ndarray) -> tuple[np.ndarray, ...]:
        """z (ascending), y, half thickness and half width (k,) of the middle line, in the jaw's frame."""
        amount = amount_out(fit, shape, neutral)
        line, thick = self._line(fit.lower, amount, self._weights)
        return line[:, 1], line[:, 0], thick, self._half_width(fit.lower, line[:, 1], amount)

    def _body(self, arch: Arch, amount: float) -> np.ndarray:
        """Rings along the middle line, and the tip, with the jaw shut."""
        line, thick = self._line(arch, amount, self._weights)
        forward = np.gradient(line, axis=0)
        forward /= np.linalg.norm(forward, axis=1, keepdims=True)
        upward = np.stack([forward[:, 1], -forward[:, 0]], -1)
        across = self._half_width(arch, line[:, 1], amount)[:, None] * AROUND_X
        up = self._profile(self._along) * thick[:, None]
        y, z = (line[:, [k]] + up * upward[:, [k]] for k in (0, 1))
        points = np.stack([across, y, z], -1).reshape(-1, 3)
        return np.concatenate([points, [[0, *(line[-1] + forward[-1] * 0.012)]]])

    def _half_width(self, arch: Arch, z: np.ndarray, amount: float) -> np.ndarray:
        """Within the teeth at rest; out, as wide as a mouth lets it be; round at the tip."""
        room = arch.half_width_at(z) - 0.092
        round_off = np.clip(1 - np.clip((self._along - 0.42) / 0.61, 0, 1) ** 2.5, 0, 1) ** 0.5
        at_rest = np.clip(room - 0.012, 0.05, 0.165) * np.maximum(round_off, 0.2)
        out = 0.155 * round_off
        return at_rest + amount * (out - at_rest)

    @staticmethod
    def _profile(along: np.ndarray) -> np.ndarray:
        """Height (rings, around) over the middle line in half thicknesses, with the groove."""
        x = np.abs(AROUND_X)
        arc = np.sqrt(np.maximum(1 - x**2.6, 0))
        arc[TOP_COLUMNS:] *= -0.9
        groove = np.where(np.arange(len(x)) < TOP_COLUMNS, np.exp(-((x / 0.4) ** 2)), 0)
        deep = np.interp(along, [0, 0.3, 0.8, 1], [0.2, 1, 0.8, 0.2])[:, None]
        return arc - 0.20 * deep * groove


def amount_out(fit: MouthFit, shape: np.ndarray, neutral: np.ndarray) -> float:
    """0 at rest, 1 for ARKit's tongueOut: how far the helper's tip has left the jaw forwards."""
    rotation, offset = fit.jaw(shape)
    tip = (shape[HELPER_TIP] - offset) @ rotation
    moved = (tip - neutral[HELPER_TIP]).mean(0)[2] / FULLY_OUT
    return float(np.clip((moved - 0.03) / 0.97, 0, 1.2))
