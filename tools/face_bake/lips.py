"""The lips as a grid: rings of base-mesh vertices around the mouth, all in the same angular order."""

import numpy as np

from .cage import HEAD, MOUTH, Cage, undirected_edges
from .seal import walk_loop

# The rim lies behind the lips; closed lips meet at CONTACT, the red ends at BORDER.
CONTACT, BORDER, RINGS = 3, 7, 12


class LipGrid:
    """upper, lower: (RINGS, columns) base-mesh vertices from the right corner to the left, corners included.

    `along` of each half: (columns,) -1 at the right corner, 0 in the middle, 1 at the left corner.
    """

    def __init__(self, cage: Cage, points: np.ndarray):
        faces = cage.faces[cage.island == HEAD]
        edges = undirected_edges(faces)
        rim = np.intersect1d(faces, cage.faces[cage.island == MOUTH])
        right, left = int(rim[np.argmin(points[rim, 0])]), int(rim[np.argmax(points[rim, 0])])
        halves = [np.concatenate([[right], walk, [left]]) for walk in walk_loop(edges, rim, right, left)]
        halves.sort(key=lambda half: -points[half, 1].mean())
        self.upper, self.lower = (_outwards(edges, half, rim) for half in halves)
        self.upper_along, self.lower_along = (self._along(half, points) for half in (self.upper, self.lower))

    def rings_of(self, numbers) -> np.ndarray:
        """All vertices of some rings."""
        numbers = list(numbers)
        return np.union1d(self.upper[numbers], self.lower[numbers])

    @staticmethod
    def _along(half: np.ndarray, points: np.ndarray) -> np.ndarray:
        x = points[half[CONTACT], 0]
        return x / np.abs(x[[0, -1]]).max()


def _outwards(edges: np.ndarray, row: np.ndarray, rim: np.ndarray) -> np.ndarray:
    """All rings (RINGS, columns) from a row of the rim: each vertex follows the one edge leading away."""
    both, rows, seen = np.concatenate([edges, edges[:, ::-1]]), [row], set(rim.tolist())
    everyone = rim
    for _ in range(RINGS - 1):
        leaving = both[np.isin(both[:, 0], everyone)]
        after = {a: b for a, b in leaving.tolist() if b not in seen}
        rows.append(np.array([after[vertex] for vertex in rows[-1].tolist()]))
        everyone = np.array(sorted(after.values()))
        seen.update(after.values())
    return np.array(rows)
