"""Rows of teeth swept along MakeHuman's helper arches."""

import numpy as np

from .parts import PartGroup, Posed
from .strips import catmull_rom, grid_of

# Half an arch from the middle outwards: relative widths and crown lengths.
UPPER_WIDTHS = np.array([1.0, 0.78, 0.86, 0.82, 0.80, 1.1, 1.05])
LOWER_WIDTHS = np.array([0.66, 0.70, 0.80, 0.84, 0.86, 1.15, 1.1])
CROWNS = np.array([1.0, 0.88, 0.96, 0.86, 0.82, 0.74, 0.70])
# Columns per tooth: the molars are seldom seen.
COLUMNS = (5, 5, 5, 5, 3, 3, 2)
# Rows from the gum over the front and the edge to the back: height on the tooth, how far the back
# rows lie behind, and the row's place in the picture, 0 (gum) to 1.
HEIGHTS = np.array([0, 0.30, 0.38, 0.46, 0.76, 0.90, 1.0, 1.04, 0.4])
BEHIND = {7: 0.01, 8: 0.06}
PICTURE_ROWS = np.array([0, 2, 3, 4, 6, 7, 8, 9, 11]) / 11
GUM_EDGE = 0.38
# MakeHuman's arches are wider than the mouth's corners allow.
ARCH_SCALE = np.array([0.86, 1, 0.93])
ARCH_BACK, UPPER_UP, LOWER_DOWN = 0.022, 0.004, 0.010


def _columns(widths: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Along the arch: place -1..1, place 0..1 within the tooth, and the tooth, one entry a column."""
    edge = np.concatenate([[0], np.cumsum(widths)]) / widths.sum()
    found = {}
    for side in (-1, 1):
        for tooth, count in enumerate(COLUMNS):
            for k in range(count + 1):
                place = side * (edge[tooth] + (edge[tooth + 1] - edge[tooth]) * k / count)
                found.setdefault(round(float(place), 9), (place, k / count, tooth))
    columns = [found[key] for key in sorted(found)]
    return tuple(np.array(values) for values in zip(*columns, strict=True))


class Teeth:
    """One arch; `place` sweeps it for a shape of the base mesh."""

    def __init__(self, quads: np.ndarray, points: np.ndarray, upper: bool):
        grid = grid_of(quads)
        if points[grid[0], 2].max() < points[grid[-1], 2].max():
            grid = grid[::-1]
        if points[grid[0, 0], 0] > points[grid[0, -1], 0]:
            grid = grid[:, ::-1]
        self._grid, self._upper = grid, upper
        along, self._within, self._tooth = _columns(UPPER_WIDTHS if upper else LOWER_WIDTHS)
        steps = np.linalg.norm(np.diff(points[grid[1]], axis=0), axis=1)
        arc = np.concatenate([[0], np.cumsum(steps)]) / steps.sum() * 2 - 1
        self._weights = catmull_rom(grid.shape[1], np.interp(along, arc, np.arange(grid.shape[1])))
        self.uv = np.stack(np.broadcast_arrays((along + 1) / 2, 1 - PICTURE_ROWS[:, None]), -1).reshape(-1, 2)
        polygons = self._polygons(len(along))
        self.groups = [PartGroup("teeth_upper" if upper else "teeth_lower", "teeth", polygons, polygons)]

    def _polygons(self, columns: int) -> np.ndarray:
        i = np.arange(len(HEIGHTS) * columns).reshape(-1, columns)
        quads = np.stack([i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]], -1).reshape(-1, 4)
        return quads if self._upper else quads[:, ::-1]

    def place(self, posed: Posed) -> np.ndarray:
        """Points (rows * columns, 3) in base-mesh space."""
        gum, down, out = self._frame(posed.shape)
        rows = [
            gum + down * height + out * depth for height, depth in (self._row(k) for k in range(len(HEIGHTS)))
        ]
        return np.array(rows).reshape(-1, 3)

    def _frame(self, shape):
        """Per column: the gum line, the vector to the tooth's edge, and the unit direction outwards."""
        arch = shape[self._grid]
        middle = arch[:, [0, -1]].mean((0, 1))
        lift = UPPER_UP if self._upper else -LOWER_DOWN
        arch = middle + (arch - middle) * ARCH_SCALE + np.array([0, lift, -ARCH_BACK])
        gum, edge = self._weights @ arch[0], self._weights @ arch[2]
        tangent = np.gradient(gum, axis=0)
        down = edge - gum
        out = np.cross(tangent, down) * (1 if self._upper else -1)
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        return gum, down, -out if out[len(out) // 2, 2] < 0 else out

    def _row(self, k: int) -> tuple[np.ndarray, np.ndarray]:
        """Height and depth (columns, 1) of row k: scalloped gums, rounded crowns, grooves between."""
        s, crown = self._within[:, None], CROWNS[self._tooth][:, None]
        side = np.abs(2 * s - 1)
        gum_line = GUM_EDGE - 0.07 * (1 - side**2)
        rounded = 1 - side**3.2
        if HEIGHTS[k] <= GUM_EDGE:
            height = HEIGHTS[k] / GUM_EDGE * gum_line
            depth = 0.012 + 0.02 * np.sin(np.pi * HEIGHTS[k] / GUM_EDGE * 0.9) * np.ones_like(s)
        else:
            q = min((HEIGHTS[k] - GUM_EDGE) / (1 - GUM_EDGE), 1.0)
            edge = gum_line + (1 - gum_line) * (crown * 0.5 + 0.5) * (1 - 0.10 * side**3)
            height = gum_line + (edge - gum_line) * q
            depth = (0.012 + 0.022 * np.sin(np.pi * (0.25 + 0.6 * q))) * rounded - 0.012 * (1 - rounded)
        if k in BEHIND:
            depth = -BEHIND[k] * np.ones_like(s)
        return height, depth
