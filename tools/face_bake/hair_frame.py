"""The base head as hair sees it: directions around the skull, how far its surface is, and a person's own.

Hair is laid out once around MakeHuman's base head and then carried to a person, because hairlines and
heads then agree with the skin's picture, which is painted in the base head's space too.
"""

from functools import cached_property

import numpy as np
import trimesh
from scipy.ndimage import gaussian_filter, map_coordinates
from scipy.spatial import cKDTree

from .subdivide import vertex_normals

# Inside the skull; the scalp is star-shaped as seen from here. Decimetres.
CENTRE = np.array([0.0, 7.55, 0.5])
# Skin whose surface carries hair or keeps it away: everything above the collar bones.
LOWEST = 5.4
TENT_AZIMUTHS, TENT_HEIGHTS = np.arange(0.0, 360.0, 4.0), np.arange(5.7, 8.0, 0.04)
# Hair within this distance of the base head, dm, keeps it from a person's.
NEAR = 0.16
# and none comes nearer to the skin.
ABOVE_SKIN = 0.010
TENT_SLOPE, OFF_EARS = 0.30, 0.030


def direction(azimuth, elevation) -> np.ndarray:
    """Unit vectors (..., 3); degrees, azimuth 0 is the front and 90 the head's left."""
    a, e = np.radians(azimuth), np.radians(elevation)
    return np.stack(np.broadcast_arrays(np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)), -1)


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def slerp(start: np.ndarray, end: np.ndarray, t) -> np.ndarray:
    """Unit vectors (..., 3) on the great circle between unit vectors."""
    angle = np.arccos(np.clip((start * end).sum(-1, keepdims=True), -1, 1))
    t = np.asarray(t)[..., None]
    sine = np.maximum(np.sin(angle), 1e-6)
    return unit(np.sin((1 - t) * angle) / sine * start + np.sin(t * angle) / sine * end)


class Skull:
    """The base head's outside; with or without its ears."""

    def __init__(self, points: np.ndarray, quads: np.ndarray, ears: np.ndarray):
        """points: (n, 3) of the base head's fine skin; quads: (m, 4) of its outside; ears: (n,) bool."""
        self.points, self.quads = points, quads
        triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], 1).reshape(-1, 3)
        self.triangles = triangles[(points[triangles][:, :, 1] > LOWEST).all(1)]
        bare = self.triangles[~ears[self.triangles].any(1)]
        self._whole = trimesh.Trimesh(points, self.triangles, process=False)
        self._bare = trimesh.Trimesh(points, bare, process=False)
        self.bare = np.unique(bare)
        self.bare_triangles = bare
        self.normals = vertex_normals(points, bare)

    def radius(self, directions: np.ndarray) -> np.ndarray:
        """Distance (...) from the centre to the head without ears along unit vectors (..., 3)."""
        flat = directions.reshape(-1, 3)
        return self._cast(self._bare, np.tile(CENTRE, (len(flat), 1)), flat).reshape(directions.shape[:-1])

    @cached_property
    def _tent(self) -> np.ndarray:
        """Distance (A, H) from the upright axis that hair over ears and jaw keeps: their girth as a gentle
        hill, since hair spans what sticks out."""
        azimuth, height = np.meshgrid(TENT_AZIMUTHS, TENT_HEIGHTS, indexing="ij")
        flat = direction(azimuth, 0.0 * azimuth).reshape(-1, 3)
        origins = np.stack([0 * height, height, 0 * height + CENTRE[2]], -1).reshape(-1, 3)
        girth = self._cast(self._whole, origins, flat).reshape(azimuth.shape)
        turn = np.abs((TENT_AZIMUTHS[:, None] - TENT_AZIMUTHS + 180) % 360 - 180) * np.radians(1)
        fall = np.abs(TENT_HEIGHTS[:, None] - TENT_HEIGHTS)
        hill = (girth[None] - TENT_SLOPE * turn[..., None]).max(1)
        hill = (hill[:, None] - TENT_SLOPE * fall[None]).max(2)
        return gaussian_filter(hill, (2, 4), mode=("wrap", "nearest")) + OFF_EARS

    def tent(self, azimuth: np.ndarray, height: np.ndarray) -> np.ndarray:
        """The tent (...) at degrees and heights on the base head."""
        i = np.asarray(azimuth) % 360 / TENT_AZIMUTHS[1]
        low, high = TENT_HEIGHTS[[0, -1]]
        j = (np.clip(height, low, high) - low) / (TENT_HEIGHTS[1] - low)
        return map_coordinates(self._tent, [i, j], order=1, mode="grid-wrap")

    @staticmethod
    def _cast(mesh: trimesh.Trimesh, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        """The farthest hit (n,) of each ray; the mean where a hole lets a ray through."""
        places, which, _ = mesh.ray.intersects_location(origins, directions, multiple_hits=True)
        farthest = np.full(len(origins), -np.inf)
        np.maximum.at(farthest, which, np.linalg.norm(places - origins[which], axis=1))
        hit = np.isfinite(farthest)
        return np.where(hit, farthest, farthest[hit].mean() if hit.any() else 0.0)


class Fitting:
    """Carries points around the base head to the same places around a person's head."""

    NEIGHBOURS = 60
    SOFTNESS = 0.12

    def __init__(self, skull: Skull, rest: np.ndarray):
        """rest: (n, 3), the person's fine skin."""
        used = skull.bare
        self._base, self._rest = skull.points[used], rest[used]
        self._base_normals = skull.normals[used]
        self._rest_normals = vertex_normals(rest, skull.bare_triangles)[used]
        self._base_tree, self._rest_tree = cKDTree(self._base), cKDTree(self._rest)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Points (..., 3); whatever lies close to the base head keeps its clearance."""
        flat = points.reshape(-1, 3)
        distance, index = self._base_tree.query(flat, k=self.NEIGHBOURS)
        weight = np.exp(-(((distance - distance[:, :1]) / self.SOFTNESS) ** 2))
        shift = (self._rest - self._base)[index]
        moved = flat + (weight[..., None] * shift).sum(1) / weight.sum(1)[:, None]
        wanted = _clearance(flat, self._base_tree, self._base, self._base_normals)[0]
        wanted = np.maximum(wanted, ABOVE_SKIN)
        for _ in range(3):
            found, normal = _clearance(moved, self._rest_tree, self._rest, self._rest_normals)
            # Hair that stands off keeps its own shape; what lies on the skin keeps its distance from it.
            share = np.clip((NEAR - wanted) / (0.5 * NEAR), 0, 1)
            moved = moved + ((wanted - found) * share)[:, None] * normal
        return moved.reshape(points.shape)


def _clearance(points, tree: cKDTree, surface, normals) -> tuple[np.ndarray, np.ndarray]:
    """Signed distance (n,) from a surface, smoothed over its nearest vertices, and the normals (n, 3)."""
    distance, index = tree.query(points, k=4)
    weight = 1 / (distance + 1e-3) ** 2
    weight /= weight.sum(1, keepdims=True)
    normal = unit((weight[..., None] * normals[index]).sum(1))
    foot = (weight[..., None] * surface[index]).sum(1)
    return ((points - foot) * normal).sum(1), normal
