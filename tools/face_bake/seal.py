"""Close the slit that MakeHuman's neutral leaves between the lips."""

import numpy as np
from scipy.spatial import cKDTree

from .cage import HEAD, MOUTH, Cage, undirected_edges

OVERLAP = 0.010
REACH = 0.11
SMOOTHING_STEPS = 60


class LipSeal:
    """Both lips' rims meet half way; the skin around follows smoothly."""

    def __init__(self, cage: Cage, points: np.ndarray):
        self._edges = undirected_edges(cage.faces)
        self._used = np.unique(cage.faces)
        rim = np.intersect1d(cage.faces[cage.island == HEAD], cage.faces[cage.island == MOUTH])
        self.corners = rim[np.argmin(points[rim, 0])], rim[np.argmax(points[rim, 0])]
        walks = walk_loop(self._edges, rim, *self.corners)
        self.upper, self.lower = sorted(walks, key=lambda walk: -points[walk, 1].mean())

    def close(self, points: np.ndarray) -> np.ndarray:
        """A copy of (19158, 3) points with the lips closed along the whole rim."""
        up, low = self.upper, self.lower
        lift = np.zeros(len(points))
        floor = np.interp(points[up, 0], points[low, 0], points[low, 1])
        lift[up] = -np.maximum(points[up, 1] - floor + OVERLAP, 0) * 0.5
        roof = np.interp(points[low, 0], points[up, 0], points[up, 1])
        lift[low] = np.maximum(roof - points[low, 1] + OVERLAP, 0) * 0.5
        closed = points.copy()
        closed[:, 1] += self._spread(lift, points)
        return closed

    def _spread(self, lift: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Relax the lift of the rim over the vertices near it."""
        rim = np.concatenate([self.upper, self.lower])
        free = np.zeros(len(points), bool)
        free[self._used] = cKDTree(points[rim]).query(points[self._used])[0] < REACH
        free[rim] = False
        here = np.concatenate([self._edges[:, 0], self._edges[:, 1]])
        there = np.concatenate([self._edges[:, 1], self._edges[:, 0]])
        count = np.maximum(np.bincount(here, minlength=len(points)), 1)
        for _ in range(SMOOTHING_STEPS):
            mean = np.bincount(here, lift[there], minlength=len(points)) / count
            lift[free] = mean[free]
        return lift


def walk_loop(edges: np.ndarray, rim: np.ndarray, start: int, end: int) -> list[np.ndarray]:
    """The two paths of rim vertices from one mouth corner to the other, without the corners."""
    members = set(rim.tolist())
    neighbours = {}
    for a, b in edges.tolist():
        if a in members and b in members:
            neighbours.setdefault(a, []).append(b)
            neighbours.setdefault(b, []).append(a)
    paths = []
    for step in neighbours[start]:
        path = [start, step]
        while path[-1] != end:
            path.append(next(v for v in neighbours[path[-1]] if v != path[-2]))
        paths.append(np.array(path[1:-1]))
    return paths
