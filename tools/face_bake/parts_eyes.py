"""Eyeballs: a sphere with a cornea, fitted to MakeHuman's helper eyes and turned with them."""

import numpy as np

from .parts import PartGroup, Posed
from .polygons import NONE

# MakeHuman's helper vertices of the left and the right eyeball.
EYE_VERTICES = (np.arange(14598, 14670), np.arange(14670, 14742))
SEGMENTS = 24
RINGS = (7, 14, 20, 25, 29, 35, 45, 58, 75, 95)
CORNEA_EDGE, CORNEA_HEIGHT = 31, 0.045
TEXTURE_EDGE = 145.0
# The helper is a little too large for its lids.
SCALE = 0.985


def _radius(degrees: float) -> float:
    return 1 + CORNEA_HEIGHT * max(1 - (degrees / CORNEA_EDGE) ** 2, 0)


def eye_mesh() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (n, 3) of a unit eye looking along +Z, uv (n, 2), polygons (m, 4).

    The rings are densest over the cornea; the back, never seen, is left open.
    """
    turn = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    around = np.stack([np.cos(turn), np.sin(turn)], -1)
    points, uv = [[[0, 0, _radius(0)]]], [[[0.5, 0.5]]]
    for degrees in RINGS:
        polar = np.radians(degrees)
        ring = np.concatenate([np.sin(polar) * around, np.full((SEGMENTS, 1), np.cos(polar))], 1)
        points.append(_radius(degrees) * ring)
        uv.append(0.5 + 0.5 * degrees / TEXTURE_EDGE * around)
    return np.concatenate(points), np.concatenate(uv), _eye_polygons()


def _eye_polygons() -> np.ndarray:
    here = np.arange(SEGMENTS)
    after = (here + 1) % SEGMENTS
    polygons = [np.stack([np.zeros(SEGMENTS, int), 1 + here, 1 + after, np.full(SEGMENTS, NONE)], -1)]
    for ring in range(len(RINGS) - 1):
        inner, outer = 1 + ring * SEGMENTS, 1 + (ring + 1) * SEGMENTS
        polygons.append(np.stack([inner + here, outer + here, outer + after, inner + after], -1))
    return np.concatenate(polygons)


def fit_sphere(points: np.ndarray) -> tuple[np.ndarray, float]:
    """Least-squares centre and radius."""
    system = np.c_[2 * points, np.ones(len(points))]
    solution = np.linalg.lstsq(system, (points**2).sum(1), rcond=None)[0]
    centre = solution[:3]
    return centre, float(np.sqrt(solution[3] + (centre**2).sum()))


def rotation_between(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Best rotation (3, 3) taking one cloud to the other (Kabsch)."""
    u, _, vt = np.linalg.svd((before - before.mean(0)).T @ (after - after.mean(0)))
    handed = np.sign(np.linalg.det(vt.T @ u.T))
    return vt.T @ np.diag([1, 1, handed]) @ u.T


def eyeball(side: int, shape: np.ndarray, neutral: np.ndarray) -> tuple[np.ndarray, float]:
    """Centre and radius of an eyeball (0 left, 1 right); it moves with its helper but keeps its size."""
    helper = EYE_VERTICES[side]
    centre, radius = fit_sphere(neutral[helper])
    return centre + shape[helper].mean(0) - neutral[helper].mean(0), radius


def place_eye(unit: np.ndarray, side: int, shape: np.ndarray, neutral: np.ndarray) -> np.ndarray:
    """The eye's points in base-mesh space, looking where the helper looks."""
    helper = EYE_VERTICES[side]
    centre, radius = eyeball(side, shape, neutral)
    return centre + (unit * radius * SCALE) @ rotation_between(neutral[helper], shape[helper]).T


class Eye:
    """One eyeball: side 0 is the left, 1 the right."""

    def __init__(self, side: int):
        self._side = side
        self._points, self.uv, polygons = eye_mesh()
        self.groups = [PartGroup(("eye_L", "eye_R")[side], "eye", polygons, polygons)]

    def place(self, posed: Posed) -> np.ndarray:
        return place_eye(self._points, self._side, posed.shape, posed.neutral)


def push_out(points, rest, on_head, shape, neutral) -> np.ndarray:
    """Keep the lids and cheeks (n, 3) outside the eyeballs; vertices never go deeper than at rest.

    The outside of the head keeps a lid's thickness away, or a squint would cut into the eye.
    """
    points = points.copy()
    for side in (0, 1):
        centre, radius = eyeball(side, shape, neutral)
        ray = points - centre
        distance = np.linalg.norm(ray, axis=1)
        limit = np.minimum(np.linalg.norm(rest - centre, axis=1), radius * 1.02 + np.where(on_head, 0.014, 0))
        deep = distance < limit
        points[deep] = centre + ray[deep] * (limit / np.maximum(distance, 1e-9))[deep][:, None]
    return points
