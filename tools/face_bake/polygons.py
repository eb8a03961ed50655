"""Polygons of three or four corners as rows (m, 4); a triangle's last corner is -1."""

import numpy as np

NONE = -1


def padded(polygons) -> np.ndarray:
    """Rows (m, 4) from lists of three or four corners, or from an array (m, 3) or (m, 4)."""
    return np.array([[*polygon, NONE][:4] for polygon in polygons], int)


def shifted(polygons: np.ndarray, first: int) -> np.ndarray:
    """The same polygons over vertices that begin at `first`."""
    return np.where(polygons == NONE, NONE, polygons + first)


def triangles_of(polygons: np.ndarray) -> np.ndarray:
    """Consecutive triangles (t, 3): (a, b, c) and, where there is a fourth corner, (a, c, d)."""
    pairs = np.stack([polygons[:, [0, 1, 2]], polygons[:, [0, 2, 3]]], 1).reshape(-1, 3)
    return pairs[pairs[:, 2] != NONE]


def renumbered(polygons: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Used indices (ascending) and the polygons renumbered into them."""
    used, inverse = np.unique(polygons, return_inverse=True)
    inverse = inverse.reshape(polygons.shape)
    if used[0] != NONE:
        return used, inverse
    return used[1:], inverse - 1
