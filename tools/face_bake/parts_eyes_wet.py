"""The line of tears between each lower lid and its eyeball."""

import numpy as np

from .cage import Cage
from .parts import PartGroup, Posed
from .parts_eyes_rings import LidRings
from .polygons import shifted
from .source import BaseMesh
from .strips import catmull_rom

# Points along a lower lid for each of its columns of vertices, and the film's width in decimetres.
FINER, WIDTH = 2, 0.0042
# Across the film: on the ball, in the hollow, on the lid; along the ball and along the lid, in widths.
ACROSS = ((1.0, 0.0), (0.26, 0.24), (0.0, 0.85))
# Just above what it lies on.
LIFT = 0.0004


class Tears:
    """A concave strip along each lower lid, in the corner between lid and ball, whatever these do."""

    uv = np.array([[0.5, 0.5]])

    def __init__(self, cage: Cage, rings: LidRings, base: BaseMesh):
        self._columns = [self._lower(cage, rings, base, side) for side in (0, 1)]
        strips, first = [], 0
        for columns in self._columns:
            long = FINER * (len(columns) - 1) + 1
            strips.append(shifted(_strip(long, len(ACROSS)), first))
            first += long * len(ACROSS)
        self.groups = [PartGroup.of_one_uv("tears", "tear", np.concatenate(strips))]

    @staticmethod
    def _lower(cage: Cage, rings: LidRings, base: BaseMesh, side: int) -> np.ndarray:
        """Fine vertices (n, RINGS) of the lower lid's columns, left to right."""
        columns = rings.columns[side]
        rim = base.points[columns[:, 0]]
        lower = columns[rim[:, 1] < rim[:, 1].mean()]
        # Not into the very corners, where it would turn back on itself.
        lower = lower[np.argsort(base.points[lower[:, 0], 0])][1:-1]
        return np.searchsorted(np.unique(cage.faces), lower)

    def place(self, posed: Posed) -> np.ndarray:
        return np.concatenate([self._film(posed, side) for side in (0, 1)])

    def _film(self, posed: Posed, side: int) -> np.ndarray:
        """One strip's points, (n, 3), those across it together."""
        eyes = posed.body.eyes
        centre = eyes.placed(side, posed.shape)[0]
        contact, outwards = self._contact(posed, side)
        finer = catmull_rom(len(contact), np.linspace(0, len(contact) - 1, FINER * (len(contact) - 1) + 1))
        contact, outwards = finer @ contact, _unit(finer @ outwards)
        normal, along = _unit(contact - centre), np.gradient(contact, axis=0)
        # Up the ball, away from the lid.
        upwards = _unit(np.cross(normal, along))
        upwards *= np.sign(upwards[:, 1:2])
        place = np.linspace(-1, 1, len(contact))[:, None]
        width = WIDTH * (0.25 + 0.75 * np.sqrt(np.maximum(1 - place**4, 0)))
        rows = [contact + width * (up * upwards + out * outwards) for up, out in ACROSS]
        rows = [row + LIFT * (normal + upwards) for row in rows]
        distance, surface = eyes.surface(side, rows[0], posed.shape)
        rows[0] = centre + (rows[0] - centre) * ((surface + LIFT) / distance)[:, None]
        return np.stack(rows, 1).reshape(-1, 3)

    def _contact(self, posed: Posed, side: int) -> tuple[np.ndarray, np.ndarray]:
        """Where each column of the lid leaves the ball (n, 3), and its direction there."""
        columns = self._columns[side]
        points = posed.skin[columns]
        distance, surface = posed.body.eyes.surface(side, points.reshape(-1, 3), posed.shape)
        above = (distance - surface).reshape(columns.shape)
        last = np.clip((above > 0).argmax(1), 1, None)
        rows = np.arange(len(columns))
        low, high = above[rows, last - 1], above[rows, last]
        share = np.clip(-low / np.maximum(high - low, 1e-9), 0, 1)[:, None]
        start, end = points[rows, last - 1], points[rows, last]
        return start + share * (end - start), _unit(end - start)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def _strip(long: int, wide: int) -> np.ndarray:
    """Quads of a grid whose rows of `wide` vertices follow each other; the first row is above."""
    row, column = (a.ravel() for a in np.mgrid[: long - 1, : wide - 1])
    first = row * wide + column
    return np.stack([first, first + 1, first + 1 + wide, first + wide], -1)
