"""How much of an eyeball shows between its lids, seen from the front: measured by cutting upright slices.

Used by verify_faces.py and by the tests; numpy alone.
"""

import numpy as np


def slices(triangles: np.ndarray, x: float) -> np.ndarray:
    """Segments (n, 2, 2), each two points (y, z), in which triangles (t, 3, 3) cross the plane at x."""
    beyond = triangles[:, :, 0] > x
    cut = np.isin(beyond.sum(1), (1, 2))
    triangles, beyond = triangles[cut], beyond[cut]
    rows = np.arange(len(triangles))
    odd = np.where(beyond.sum(1) == 1, beyond.argmax(1), (~beyond).argmax(1))
    tip, ends = triangles[rows, odd], []
    for other in (1, 2):
        base = triangles[rows, (odd + other) % 3]
        share = ((x - tip[:, 0]) / (base[:, 0] - tip[:, 0]))[:, None]
        ends.append((tip + share * (base - tip))[:, 1:])
    return np.stack(ends, 1)


def foremost(segments: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """The greatest z (h,) of segments (n, 2, 2) at each of the ascending heights; -inf where none is."""
    depth = np.full(len(heights), -np.inf)
    order = np.sort(segments[:, :, 0], axis=1)
    first, last = np.searchsorted(heights, order[:, 0]), np.searchsorted(heights, order[:, 1])
    for (start, end), i, j in zip(segments, first.tolist(), last.tolist(), strict=True):
        if j > i:
            share = (heights[i:j] - start[0]) / (end[0] - start[0])
            depth[i:j] = np.maximum(depth[i:j], start[1] + share * (end[1] - start[1]))
    return depth


class Opening:
    """An eye and the skin around it; reach, pitch and step in the file's unit (cm).

    skin, ball: triangles (t, 3); neutral: positions (V, 3), of which those near the ball are looked at.
    """

    def __init__(self, skin, ball, neutral, *, reach=1.4, pitch=0.1, step=0.005):
        self._ball = ball
        points = neutral[np.unique(ball)]
        low, high = points.min(0), points.max(0)
        corners = neutral[skin]
        near = ((corners.max(1) > low - reach) & (corners.min(1) < high + reach)).all(1)
        self._skin = skin[near & (corners[..., 2].max(1) > low[2])]
        self.vertices = np.union1d(self._skin, ball)
        # Between the vertices' own columns, which a plane would meet exactly.
        self._columns = np.arange(low[0], high[0], pitch) + 0.31 * pitch
        self._heights = np.arange(low[1], high[1], step) + 0.17 * step
        self._step = step

    def seen(self, positions: np.ndarray) -> np.ndarray:
        """Where (columns, heights) the ball lies in front of the skin."""
        skin, ball = positions[self._skin], positions[self._ball]
        rows = []
        for x in self._columns:
            of_skin, of_ball = (foremost(slices(part, x), self._heights) for part in (skin, ball))
            rows.append(of_ball > of_skin)
        return np.array(rows)

    def height(self, positions: np.ndarray) -> float:
        """The widest gap between the lids, over all columns."""
        return float(self.seen(positions).sum(1).max() * self._step)

    def piercing(self, positions: np.ndarray) -> float:
        """How high the ball shows apart from the opening: what comes through a lid."""
        worst = 0
        for column in self.seen(positions):
            edges = np.flatnonzero(np.diff(np.concatenate([[0], column.astype(int), [0]])))
            runs = np.sort(edges[1::2] - edges[::2])
            worst = max(worst, int(runs[:-1].sum()))
        return worst * self._step
