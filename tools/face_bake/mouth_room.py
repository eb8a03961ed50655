"""Keep lips and cheeks out of teeth and tongue, and their lining on the teeth."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from .cage import MOUTH
from .finemesh import FineMesh
from .mouth_fit import Arch, MouthFit
from .paintkit import smoothstep
from .parts_tongue import Tongue
from .seal import LipSeal

# How near the lining of lips and cheeks comes to the teeth, how much less near the skin, and how softly.
NEAR, LIP_THICKNESS, SOFTNESS = 0.006, 0.011, 0.006
# Over the biting edge: where teeth begin to push, and where gums end.
EDGE, GUMS_END = (-0.030, -0.008), (0.16, 0.11)
THICKNESS_RINGS = 3
# Deeper inside the lower arch than this lies the floor of the mouth.
FLOOR = -0.035
# How far from the teeth the lining lies at most; from how many edges behind the lips' rim; where up and down.
LINING, CLINGING, CLINGING_HEIGHTS, CLINGING_STEPS = 0.016, (0.5, 5.0), ((-0.07, 0.0), (0.20, 0.12)), 6
# Lips on a tongue: how near, how softly, and where to the sides they close again.
ON_TONGUE, TONGUE_SOFTNESS, TONGUE_SIDES = 0.002, 0.007, (0.24, 0.12)


def _softly(excess: np.ndarray, softness: float) -> np.ndarray:
    """max(excess, 0) without its corner; keeps the order of what it lays down."""
    return softness * np.logaddexp(0, excess / softness)


def _from_rim(fine: FineMesh, seal: LipSeal, averaging: sp.csr_matrix) -> tuple[np.ndarray, np.ndarray]:
    """True (n,) for what is nearer, along the skin, to the upper lip's rim than to the lower one's; and
    how many edges (n,) the nearer one is away."""
    of_base = {int(vertex): k for k, vertex in enumerate(fine.base_vertices)}
    steps = [
        dijkstra(averaging, indices=[of_base[int(vertex)] for vertex in rim], unweighted=True, min_only=True)
        for rim in (seal.upper, seal.lower)
    ]
    return steps[0] < steps[1], np.minimum(*steps)


class MouthRoom:
    """One person's: built once at rest, asked for every shape."""

    def __init__(self, fine: FineMesh, seal: LipSeal, rest: np.ndarray, fit: MouthFit):
        """rest: this person's fine skin (n, 3)."""
        self._fit, self._tongue = fit, Tongue()
        arch, averaging = fit.upper, fine.averaging()
        below = (rest[:, 1] < arch.edge) & (fit.lower.distance(rest)[0] > FLOOR)
        outside = (arch.distance(rest)[0] > -0.004) | below
        beside = (rest[:, 2] > arch.front - 0.55) & (np.abs(rest[:, 1] - arch.edge) < 0.26)
        self._near = np.flatnonzero(outside & beside)
        skin = fine.on_head.astype(float)
        for _ in range(THICKNESS_RINGS):
            skin = np.minimum(skin, averaging @ skin)
        self._room = (NEAR + LIP_THICKNESS * skin)[self._near]
        upper, steps = _from_rim(fine, seal, averaging)
        self._upper = upper[self._near]
        # Nobody sees from outside how thick a cheek is.
        inside = np.isin(self._near, fine.quads[fine.island == MOUTH]) & ~fine.on_head[self._near]
        self._clings = smoothstep(*CLINGING, steps[self._near]) * inside
        self._averaging = averaging[self._near][:, self._near]

    def clear(self, points: np.ndarray, shape: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        """A copy of fine skin (n, 3) that nothing in the mouth pierces."""
        fit = self._fit
        rotation, offset = fit.jaw(shape)
        near = points[self._near]
        near = near + self._onto_teeth(near, rotation, offset)
        near = near + self._off_teeth(fit.upper, near, 1.0)
        in_jaw = (near - offset) @ rotation
        in_jaw = in_jaw + self._off_teeth(fit.lower, in_jaw, -1.0)
        in_jaw = in_jaw + self._off_tongue(in_jaw, shape, neutral)
        cleared = points.copy()
        cleared[self._near] = in_jaw @ rotation.T + offset
        return cleared

    def _onto_teeth(self, near: np.ndarray, rotation: np.ndarray, offset: np.ndarray) -> np.ndarray:
        """Moves (k, 3) of the lining towards both arches, smoothed over its surface."""
        in_jaw = (near - offset) @ rotation
        total, weights = np.zeros_like(near), np.zeros(len(near))
        for arch, places, up, turn in (
            (self._fit.upper, near, 1.0, np.eye(3)),
            (self._fit.lower, in_jaw, -1.0, rotation),
        ):
            distance, out = arch.distance(places)
            height = up * (places[:, 1] - arch.edge_at(places[:, 2]))
            weight = smoothstep(*CLINGING_HEIGHTS[0], height) * smoothstep(*CLINGING_HEIGHTS[1], height)
            weight = weight * smoothstep(arch.front - 0.52, arch.front - 0.40, places[:, 2])
            total -= (weight * _softly(distance - LINING, SOFTNESS))[:, None] * out @ turn.T
            weights += weight
        total /= np.maximum(weights, 1)[:, None]
        for _ in range(CLINGING_STEPS):
            total = 0.5 * self._clings[:, None] * (total + self._averaging @ total)
        return total

    def _off_teeth(self, arch: Arch, near: np.ndarray, up: float) -> np.ndarray:
        """Level moves (k, 3) away from an arch; up: 1 for the upper one, -1 for the lower."""
        distance, out = arch.distance(near)
        height = up * (near[:, 1] - arch.edge_at(near[:, 2]))
        # Deep inside are the throat's walls, not lips.
        beside = smoothstep(*EDGE, height) * smoothstep(*GUMS_END, height) * (distance > -0.2)
        wanted = self._room + _softly(distance - self._room, SOFTNESS)
        return ((wanted - distance) * beside)[:, None] * out

    def _off_tongue(self, near: np.ndarray, shape: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        """Lips part above and below a tongue that is out."""
        moves = np.zeros_like(near)
        z, middle, thick, wide = self._tongue.outline(self._fit, shape, neutral)
        if z[-1] < self._fit.lower.front:
            return moves
        at = near[:, 2]
        height, half = np.interp(at, z, middle), np.interp(at, z, thick)
        aside = np.abs(near[:, 0]) / np.interp(at, z, wide)
        half = half * np.sqrt(np.maximum(1 - aside**2.6, 0))
        beyond = smoothstep(z[-1] + 0.05, z[-1], at) * (at > self._fit.lower.front - 0.05)
        beyond = beyond * smoothstep(*TONGUE_SIDES, np.abs(near[:, 0]))
        above, below = near[:, 1] - height - half, height - half - near[:, 1]
        up, down = (_softly(ON_TONGUE - room, TONGUE_SOFTNESS) for room in (above, below))
        moves[:, 1] = np.where(self._upper, up, -down) * beyond
        return moves
