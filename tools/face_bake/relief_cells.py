"""Cells in space: how near the nearest and the second nearest of scattered points are."""

import numpy as np

_CHUNK = 200_000


def cells_where(where: np.ndarray, points: np.ndarray, size: float, seed: int):
    """`cells` at the places where `where` (p,) is above 0; far away from all points elsewhere."""
    found = [np.full(len(points), fill, np.float32) for fill in (9.0, 9.0, 1.0)]
    chosen = where > 0
    for whole, part in zip(found, cells(points[chosen], size, seed), strict=True):
        whole[chosen] = part
    return found


def cells(points: np.ndarray, size: float, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distances (p,) from places (p, 3) to the nearest and second nearest point, in cells (Worley 1996).

    Space is divided into cubes of `size` with one point in each; the third result is a number of the
    nearest point's own, 0..1.
    """
    rng = np.random.default_rng(seed)
    side = 64
    scattered = rng.random((side, side, side, 3), np.float32)
    nearest = np.empty(len(points), np.float32)
    second = np.empty(len(points), np.float32)
    number = np.empty(len(points), np.float32)
    for start in range(0, len(points), _CHUNK):
        places = (points[start : start + _CHUNK] / size).astype(np.float32)
        cube = np.floor(places).astype(np.int32)
        within = places - cube
        first = np.full(len(places), 9.0, np.float32)
        then = first.copy()
        of_first = np.zeros(len(places), np.float32)
        for offset in np.ndindex(3, 3, 3):
            step = np.array(offset, np.int32) - 1
            x, y, z = ((cube + step) % side).T
            away = scattered[x, y, z] + step - within
            distance = np.einsum("pi,pi->p", away, away)
            then = np.minimum(then, np.maximum(first, distance))
            of_first = np.where(distance < first, (scattered[x, y, z] * 1000).sum(1) % 1, of_first)
            first = np.minimum(first, distance)
        nearest[start : start + _CHUNK] = np.sqrt(first)
        second[start : start + _CHUNK] = np.sqrt(then)
        number[start : start + _CHUNK] = of_first
    return nearest, second, number
