"""Eyelashes: tapered hairs on MakeHuman's helper strips, linear in the helper's vertices."""

import numpy as np

from .strips import catmull_rom, grid_of

UPPER_HAIRS, LOWER_HAIRS = 46, 30
# Fractions of a hair's length where it is two vertices wide; it ends in a single one.
LEVELS = (0.0, 0.5)
CORNERS_PER_HAIR = 2 * len(LEVELS) + 1


class Lashes:
    """One strip of lashes; `lid` is the helper's row of vertices on the lid."""

    def __init__(self, quads, points, eye_centre, upper: bool, rng: np.random.Generator):
        grid = grid_of(quads)
        reach = np.linalg.norm(points[grid] - eye_centre, axis=-1).mean(1)
        if reach[0] > reach[-1]:
            grid = grid[::-1]
        self.lid, self.upper, self._grid = grid[0], upper, grid
        self._weights = self._operator(rng)
        self.count = len(self._weights)
        self.triangles = self._triangles(self.count // CORNERS_PER_HAIR)

    def _operator(self, rng) -> np.ndarray:
        """Weights (vertices, grid size): per hair a pair of vertices for each level, then the tip."""
        rows, columns = self._grid.shape
        count = UPPER_HAIRS if self.upper else LOWER_HAIRS
        place = np.linspace(0.4, columns - 1.4, count) + rng.uniform(-0.06, 0.06, count)
        along = place / (columns - 1)
        length = (1.15 if self.upper else 0.70) * rng.uniform(0.8, 1.0, count)
        length = length * (0.55 + 0.45 * np.sin(np.pi * along**0.9)) * (rows - 1)
        lean = ((along - 0.5) * 0.5 + rng.uniform(-0.08, 0.08, count)) * length / (rows - 1)
        width = 0.075 if self.upper else 0.045
        spots = [(level, side * width * (1 - level) ** 0.8) for level in LEVELS for side in (-1, 1)]
        parts = []
        for level, aside in [*spots, (1.0, 0.0)]:
            across = catmull_rom(columns, np.clip(place + lean * level + aside, 0, columns - 1))
            outwards = catmull_rom(rows, level * length)
            parts.append(np.einsum("ni,nj->nij", outwards, across).reshape(count, -1))
        return np.stack(parts, 1).reshape(count * CORNERS_PER_HAIR, -1)

    @staticmethod
    def _triangles(hairs: int) -> np.ndarray:
        first = CORNERS_PER_HAIR * np.arange(hairs)[:, None]
        hair = np.array([0, 1, 3, 0, 3, 2, 2, 3, 4])
        return (first + hair).reshape(-1, 3)

    def place(self, shape: np.ndarray) -> np.ndarray:
        """Points (n, 3) in base-mesh space."""
        return self._weights @ shape[self._grid].reshape(-1, 3)
