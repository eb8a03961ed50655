"""Eyelashes: tapered hairs on MakeHuman's helper strips, linear in the helper's vertices."""

import numpy as np

from .parts import PartGroup, Posed
from .parts_eyes import EYE_VERTICES
from .polygons import NONE, padded, shifted
from .source import BaseMesh
from .strips import catmull_rom, grid_of

UPPER_HAIRS, LOWER_HAIRS = 46, 30
# Fractions of a hair's length where it is two vertices wide; it ends in a single one.
LEVELS = (0.0, 0.5)
UPPER_STRIP, LOWER_STRIP = 2, 1
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
        self.polygons = self._polygons(self.count // CORNERS_PER_HAIR)

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
    def _polygons(hairs: int) -> np.ndarray:
        """A quad and a tip a hair, (m, 4)."""
        first = CORNERS_PER_HAIR * np.arange(hairs)[:, None, None]
        hair = padded([[0, 1, 3, 2], [2, 3, 4]])
        return np.where(hair == NONE, NONE, first + hair).reshape(-1, 4)

    def place(self, shape: np.ndarray) -> np.ndarray:
        """Points (n, 3) in base-mesh space."""
        return self._weights @ shape[self._grid].reshape(-1, 3)


class LashesPart:
    """The lashes of both eyes: left upper, left lower, right upper, right lower."""

    uv = np.array([[0.5, 0.5]])

    def __init__(self, rows: list[Lashes]):
        self.rows = rows
        firsts = np.cumsum([0, *(row.count for row in rows)])
        polygons = [shifted(row.polygons, first) for row, first in zip(rows, firsts, strict=False)]
        self.groups = [PartGroup.of_one_uv("lashes", "lash", np.concatenate(polygons))]

    @classmethod
    def of(cls, base: BaseMesh) -> "LashesPart":
        rng = np.random.default_rng(3)
        centres = {side: base.points[ids].mean(0) for side, ids in zip("lr", EYE_VERTICES, strict=True)}
        strips = [(side, strip) for side in "lr" for strip in (UPPER_STRIP, LOWER_STRIP)]
        return cls(
            [
                Lashes(
                    base.faces[f"helper-{side}-eyelashes-{strip}"],
                    base.points,
                    centres[side],
                    strip == UPPER_STRIP,
                    rng,
                )
                for side, strip in strips
            ]
        )

    def place(self, posed: Posed) -> np.ndarray:
        return np.concatenate([row.place(posed.shape) for row in self.rows])
