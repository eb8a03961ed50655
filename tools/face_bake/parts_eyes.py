"""Eyeballs: a sphere with a cornea, turned about its centre."""

import numpy as np

from .parts import PartGroup, Posed
from .parts_eyes_ball import EYE_VERTICES, LIMBUS, cornea_height, rotation_between
from .polygons import NONE

__all__ = ["EYE_VERTICES", "Eye", "eye_mesh", "rings", "rotation_between"]

SEGMENTS = 32
# Rings of vertices: on the cornea by distance from the axis, the limbus being 1; then by degrees.
CORNEA_RINGS = (0.30, 0.58, 0.82, 1.0)
SCLERA_RINGS = (26.5, 31, 38, 47, 60, 77, 96)
# In the picture the iris has more than its share: this radius of the limbus, and 0.5 for the last ring.
LIMBUS_IN_PICTURE = 0.27


def rings() -> tuple[np.ndarray, np.ndarray]:
    """Degrees from the line of sight, and radius in the picture, of every ring."""
    cornea = np.array(CORNEA_RINGS)
    degrees = np.concatenate([_on_cornea(cornea), SCLERA_RINGS])
    share = (np.array(SCLERA_RINGS) - LIMBUS) / (SCLERA_RINGS[-1] - LIMBUS)
    radius = LIMBUS_IN_PICTURE + (0.5 - LIMBUS_IN_PICTURE) * share
    return degrees, np.concatenate([LIMBUS_IN_PICTURE * cornea, radius])


def _on_cornea(offset: np.ndarray) -> np.ndarray:
    """Degrees at which the cornea is so far from the axis, the limbus being 1."""
    degrees = np.linspace(0, LIMBUS, 400)
    reached = cornea_height(degrees) * np.sin(np.radians(degrees)) / np.sin(np.radians(LIMBUS))
    return np.interp(offset, reached, degrees)


def eye_mesh() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (n, 3) of a unit eye looking along +Z, uv (n, 2), polygons (m, 4).

    The rings are densest over the cornea; the back, never seen, is left open.
    """
    turn = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    around = np.stack([np.cos(turn), np.sin(turn)], -1)
    points, uv = [[[0, 0, float(cornea_height(0.0))]]], [[[0.5, 0.5]]]
    for degrees, radius in zip(*rings(), strict=True):
        polar = np.radians(degrees)
        ring = np.concatenate([np.sin(polar) * around, np.full((SEGMENTS, 1), np.cos(polar))], 1)
        points.append(cornea_height(degrees) * ring)
        uv.append(0.5 + radius * around)
    return *(np.concatenate(rows) for rows in (points, uv)), _eye_polygons()


def _eye_polygons() -> np.ndarray:
    here = np.arange(SEGMENTS)
    after = (here + 1) % SEGMENTS
    polygons = [np.stack([np.zeros(SEGMENTS, int), 1 + here, 1 + after, np.full(SEGMENTS, NONE)], -1)]
    for ring in range(len(CORNEA_RINGS) + len(SCLERA_RINGS) - 1):
        inner, outer = 1 + ring * SEGMENTS, 1 + (ring + 1) * SEGMENTS
        polygons.append(np.stack([inner + here, outer + here, outer + after, inner + after], -1))
    return np.concatenate(polygons)


class Eye:
    """One eyeball: side 0 is the left, 1 the right."""

    def __init__(self, side: int):
        self._side = side
        self._points, self.uv, polygons = eye_mesh()
        self.groups = [PartGroup(("eye_L", "eye_R")[side], "eye", polygons, polygons)]

    def place(self, posed: Posed) -> np.ndarray:
        return posed.body.eyes.points(self._side, self._points, posed.shape)
