"""Crowns of single teeth in a frame of their own: which way they bulge, taper and end.

Millimetres. Across: +1 is the side away from the midline; out: towards lip or cheek, 0 at the crown's
furthest point; up the crown: 0 at the neck, 1 at the biting edge. Widths, lengths and depths are the
averages of Wheeler's Dental Anatomy, a little shortened where gums cover the neck.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .polygons import NONE


@dataclass(frozen=True)
class ToothKind:
    """width, length, depth: of the crown; cusp: how far the edge falls off from its tip; lean: degrees
    that the crown leans outwards; lift: its edge above the plane of the bite; ahead: how far it stands out
    of the arch."""

    width: float
    length: float
    depth: float
    cusp: float
    lean: float
    lift: float = 0.0
    ahead: float = 0.0


# Half an arch from the middle outwards: two incisors, canine, two premolars, two molars.
UPPER = (
    ToothKind(8.5, 10.2, 6.6, 0.00, 9, 0.0),
    ToothKind(6.7, 8.9, 5.8, 0.03, 9, 0.6, -0.25),
    ToothKind(7.7, 9.9, 7.4, 0.17, 5, 0.0, 0.30),
    ToothKind(7.0, 8.3, 8.6, 0.15, 2, 0.4),
    ToothKind(6.8, 7.8, 8.8, 0.12, 0, 0.7),
    ToothKind(10.0, 7.2, 10.6, 0.10, 0, 0.8),
    ToothKind(9.2, 6.8, 10.4, 0.10, 0, 1.0),
)
LOWER = (
    ToothKind(5.3, 8.6, 5.6, 0.00, 4, 0.0),
    ToothKind(5.9, 8.8, 5.8, 0.01, 4, 0.1),
    ToothKind(6.9, 9.9, 7.2, 0.13, 2, 0.0),
    ToothKind(7.0, 8.3, 7.8, 0.15, 0, 0.5),
    ToothKind(7.1, 7.8, 8.2, 0.12, 0, 0.8),
    ToothKind(11.0, 7.2, 10.2, 0.10, 0, 0.9),
    ToothKind(10.4, 6.8, 10.0, 0.10, 0, 1.0),
)
FRONT_TEETH = 3
# From this width on a back tooth has two cusps on each side.
MOLAR_WIDTH = 9.0
# Across the crown, once around: along the front from the inner to the outer side, then back behind it.
FRONT_AROUND = np.array([-1, -0.82, -0.42, 0, 0.42, 0.82, 1, 0.7, 0.35, 0, -0.35, -0.7])
BACK_AROUND = np.array([-1, -0.62, -0.2, 0.2, 0.62, 1, 0.6, 0.2, -0.2, -0.6])
FRONT_COLUMNS, BACK_COLUMNS = 7, 6
# Heights of the rings; the first lies under the gum. A back tooth's last ring is the dip between its cusps.
FRONT_HEIGHTS = np.array([-0.12, 0.18, 0.48, 0.76, 0.94, 1.0])
BACK_HEIGHTS = np.array([-0.12, 0.32, 0.72, 0.97, 0.80])


def _curve(at: np.ndarray, *places: tuple[float, float]) -> np.ndarray:
    """Straight between (height, value) pairs: rings are few, smoothness comes from their normals."""
    return np.interp(at, *np.array(places).T)


class Crown:
    """One kind of tooth: `points` (n, 3) as across, up, out in millimetres with the edge at up = 0."""

    def __init__(self, kind: ToothKind, front: bool):
        self._kind, self._front = kind, front
        self.around = FRONT_AROUND if front else BACK_AROUND
        self.columns = FRONT_COLUMNS if front else BACK_COLUMNS
        self._rings = FRONT_HEIGHTS if front else BACK_HEIGHTS
        heights = np.repeat(self._rings, len(self.around))
        across = np.tile(self.around, len(self._rings))
        ahead = np.tile(np.arange(len(self.around)) < self.columns, len(self._rings))
        dip = (np.arange(len(heights)) >= len(heights) - len(self.around)) & (not front)
        self._foremost = 0.0
        points = self.at(across, heights, ahead, dip)
        self._foremost = float(points[:, 2].max())
        self.points = points - [0, 0, self._foremost]

    @property
    def uv(self) -> np.ndarray:
        """Once around and up the crown (k, 2), 0..1; a ring has one more than it has points."""
        n = len(self.around) + 1
        turn = np.tile(np.arange(n) / (n - 1), len(self._rings))
        up = (self._rings - self._rings[0]) / (1 - self._rings[0])
        return np.stack([turn, np.repeat(up, n)], -1)

    def at(self, across, heights, ahead, dip=False) -> np.ndarray:
        """Points (n, 3) on the surface; ahead: on the front rather than behind."""
        kind = self._kind
        narrowing = np.where(dip, 0.55, 1.0)
        half = 0.5 * kind.width * self._half_width(heights, across) * narrowing
        out = self._depth(across, heights, ahead, narrowing)
        up = (heights - 1) * kind.length - kind.length * self._fall(across, heights, ahead, dip)
        out = out - np.tan(np.radians(kind.lean)) * (1 - heights) * kind.length
        return np.stack([across * half, up, out - self._foremost], -1)

    def _half_width(self, heights, across) -> np.ndarray:
        """Narrow at the neck, widest at the contact; corners of the edge rounder on the outer side."""
        if not self._front:
            return _curve(heights, (-0.12, 0.80), (0.32, 0.95), (0.72, 1.0), (0.97, 0.86))
        corner = np.where(across > 0, 0.82, 0.89)
        widths = _curve(heights, (-0.12, 0.88), (0.18, 0.95), (0.48, 0.99), (0.76, 1.0), (0.94, 0.955))
        return np.where(heights > 0.95, corner, widths)

    def _depth(self, across, heights, ahead, narrowing) -> np.ndarray:
        depth = self._kind.depth
        if self._front:
            front = _curve(
                heights, (-0.12, -0.6), (0.18, -0.05), (0.48, 0.0), (0.76, -0.25), (0.94, -0.6), (1, -0.95)
            )
            back = -depth * _curve(
                heights, (-0.12, 1), (0.18, 1.0), (0.48, 0.80), (0.76, 0.50), (0.94, 0.36), (1, 0.27)
            )
        else:
            front = _curve(heights, (-0.12, -0.7), (0.32, 0.0), (0.72, -0.5), (0.97, -1.9))
            back = -depth * _curve(heights, (-0.12, 0.96), (0.32, 1.0), (0.72, 0.96), (0.97, 0.82))
        side = front + (back - front) * np.where(self._front, 0.40, 0.5)
        middle = 0.5 * (front + back)
        front_edge = side + (front - side) * (1 - np.abs(across) ** 2.8) ** 0.5
        back_edge = side + (back - side) * (1 - np.abs(across) ** 2.2) ** 0.6
        return middle + (np.where(ahead, front_edge, back_edge) - middle) * narrowing

    def _fall(self, across, heights, ahead, dip) -> np.ndarray:
        """How much lower than its tip the biting edge is, as a share of the length."""
        kind, near_edge = self._kind, np.clip(heights, 0, 1) ** 4
        aside = np.abs(across)
        if self._front:
            return near_edge * (0.035 * aside**6 + kind.cusp * aside**1.3)
        if kind.width > MOLAR_WIDTH:
            cusps = kind.cusp * np.cos(np.pi * np.clip(aside / 1.24, 0, 1)) ** 2
        else:
            cusps = kind.cusp * aside**1.3
        return np.where(dip, 0.5 * cusps, near_edge * (cusps + np.where(ahead, 0.0, 0.08)))

    def polygons(self) -> np.ndarray:
        """Quads (m, 4) around the crown and a strip that closes its edge."""
        n = len(self.around)
        return self._rows(n, (np.arange(n) + 1) % n)

    def uv_polygons(self) -> np.ndarray:
        """The same polygons over `uv`."""
        n = len(self.around)
        return self._rows(n + 1, np.arange(n) + 1)

    def _rows(self, stride: int, after: np.ndarray) -> np.ndarray:
        here = np.arange(len(self.around))
        below = np.arange(len(self._rings) - 1)[:, None] * stride
        above = below + stride
        quads = np.stack([below + here, below + after, above + after, above + here], -1).reshape(-1, 4)
        return np.concatenate([quads, self._lid(int(above.max()))])

    def _lid(self, first: int) -> np.ndarray:
        n, columns = len(self.around), self.columns
        pairs = [(first + k, first + n - k) for k in range(1, columns - 1)]
        ends = [[first, *pairs[0], NONE], [pairs[-1][0], first + columns - 1, pairs[-1][1], NONE]]
        strip = [[a, c, d, b] for (a, b), (c, d) in pairwise(pairs)]
        return np.array([*ends, *strip])
