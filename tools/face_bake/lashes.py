"""Eyelashes: a fringe on each lid along MakeHuman's helper strips, its hairs in the picture's opacity.

The strips follow the lids in every shape. Their tips are bent away from the eye along the strip's own
normal, so that lashes curl when the eye is open and point down and outwards when it is shut.
"""

import numpy as np

from .parts import PartGroup, Posed
from .parts_eyes import EYE_VERTICES
from .polygons import shifted
from .source import BaseMesh
from .strips import catmull_rom, grid_of

UPPER_STRIP, LOWER_STRIP = 2, 1
# Vertices along the lid and outwards.
COLUMNS, LEVELS = 17, 4
# How far the tips bend, as a share of the fringe's length.
UPPER_CURL, LOWER_CURL = 0.34, 0.12


class Lashes:
    """One fringe; `lid` is the helper's row of vertices on the lid, from the inner corner outwards."""

    def __init__(self, quads, points, eye_centre, upper: bool):
        grid = grid_of(quads)
        reach = np.linalg.norm(points[grid] - eye_centre, axis=-1).mean(1)
        if reach[0] > reach[-1]:
            grid = grid[::-1]
        if abs(points[grid[0, 0], 0]) > abs(points[grid[0, -1], 0]):
            grid = grid[:, ::-1]
        self.lid, self.upper, self._grid = grid[0], upper, grid
        rows, columns = grid.shape
        self._across = catmull_rom(columns, np.linspace(0, columns - 1, COLUMNS))
        # Only the helper's nearer half: its far end curls already, which would add to the curl here.
        self._outwards = catmull_rom(rows, np.array([0.0, 0.5]) * (rows - 1))
        self.count = COLUMNS * LEVELS
        self._side = 1.0
        up = self._bend(*self._root_and_out(points))[:, 1].mean()
        self._side = 1.0 if (up > 0) == upper else -1.0

    @property
    def polygons(self) -> np.ndarray:
        index = np.arange(self.count).reshape(LEVELS, COLUMNS)
        corners = [index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]]
        return np.stack(corners, -1).reshape(-1, 4)

    def place(self, shape: np.ndarray, length: float) -> np.ndarray:
        """Points (n, 3) in base-mesh space; length: of the helper's."""
        root, out = self._root_and_out(shape)
        curl = UPPER_CURL if self.upper else LOWER_CURL
        s = np.linspace(0, 1, LEVELS)[:, None, None]
        points = root + length * (out * s * (1 - 0.25 * curl * s) + curl * self._bend(root, out) * s**2)
        return points.reshape(-1, 3)

    def _root_and_out(self, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points on the lid, and from there to the fringe's end without its curl, (COLUMNS, 3) each."""
        near, far = np.einsum("lr,ca,rax->lcx", self._outwards, self._across, shape[self._grid])
        return near, 2 * (far - near)

    def _bend(self, root: np.ndarray, out: np.ndarray) -> np.ndarray:
        """Away from the other lid, across the fringe, as long as the fringe."""
        normal = self._side * np.cross(np.gradient(root, axis=0), out)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        return normal / np.maximum(length, 1e-12) * np.linalg.norm(out, axis=1, keepdims=True)


class LashesPart:
    """The lashes of both eyes: left upper, left lower, right upper, right lower."""

    def __init__(self, rows: list[Lashes]):
        self.rows = rows
        firsts = np.cumsum([0, *(row.count for row in rows)])
        polygons = [shifted(row.polygons, first) for row, first in zip(rows, firsts, strict=False)]
        uvs = [_uv(row.upper) for row in rows]
        polygons = np.concatenate(polygons)
        self.groups = [PartGroup("lashes", "lash", polygons, polygons)]
        self.uv = np.concatenate(uvs)

    @classmethod
    def of(cls, base: BaseMesh) -> "LashesPart":
        centres = {side: base.points[ids].mean(0) for side, ids in zip("lr", EYE_VERTICES, strict=True)}
        strips = [(side, strip) for side in "lr" for strip in (UPPER_STRIP, LOWER_STRIP)]
        return cls(
            [
                Lashes(
                    base.faces[f"helper-{side}-eyelashes-{strip}"],
                    base.points,
                    centres[side],
                    strip == UPPER_STRIP,
                )
                for side, strip in strips
            ]
        )

    def place(self, posed: Posed) -> np.ndarray:
        length = posed.body.person.look.lash_length
        return np.concatenate([row.place(posed.shape, length) for row in self.rows])


def _uv(upper: bool) -> np.ndarray:
    """The upper half of the picture is the upper fringe; roots at the top of each half."""
    top, bottom = (0.99, 0.51) if upper else (0.49, 0.01)
    v, u = np.meshgrid(np.linspace(top, bottom, LEVELS), np.linspace(0.01, 0.99, COLUMNS), indexing="ij")
    return np.stack([u, v], -1).reshape(-1, 2)
