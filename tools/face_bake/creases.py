"""Where a shape folds the skin over itself or crushes it: what shows as ragged pale lines."""

import numpy as np

# Neighbouring triangles fold when their normals are further apart than 120 degrees, where they were less
# than 90 apart at rest.
FOLDED, OPEN = -0.5, 0.0


def neighbours(triangles: np.ndarray) -> np.ndarray:
    """Pairs of triangles (p, 2) that share an edge."""
    edges = np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((owner, edges[:, 1], edges[:, 0]))
    same = (edges[order][1:] == edges[order][:-1]).all(1)
    return np.stack([owner[order][:-1][same], owner[order][1:][same]], -1)


def _normals(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    return normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)


class Creases:
    """Compares shapes with a neutral (n, 3) over triangles (t, 3)."""

    def __init__(self, neutral: np.ndarray, triangles: np.ndarray):
        self._triangles, self._pairs = triangles, neighbours(triangles)
        self._open = self._bend(neutral) > OPEN

    def folds(self, points: np.ndarray) -> int:
        """How many pairs of neighbouring triangles a shape (n, 3) folds onto each other."""
        return int((self._open & (self._bend(points) < FOLDED)).sum())

    def _bend(self, points: np.ndarray) -> np.ndarray:
        """Cosine (p,) between the normals of neighbours."""
        normal = _normals(points, self._triangles)
        return (normal[self._pairs[:, 0]] * normal[self._pairs[:, 1]]).sum(1)
