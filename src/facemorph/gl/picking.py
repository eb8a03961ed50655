"""What lies under a pixel: the sight line against the morphed triangles, in numpy; nothing is read back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int64
from facemorph.core.camera import Camera
from facemorph.core.triangles import Triangles


@dataclass(frozen=True)
class Pick:
    """A place on the surface.

    point      (3,) in model units; `distance` from the camera to it
    vertex     the nearest vertex of the polygon hit
    polygon    index of the polygon; `triangle` of the triangle
    weights    barycentric weights of the triangle's corners, together 1
    """

    point: tuple[float, float, float]
    distance: float
    vertex: int
    polygon: int
    triangle: int
    weights: tuple[float, float, float]


def pick(
    positions: Float32, triangles: Triangles, camera: Camera, size: tuple[int, int], x: float, y: float
) -> Pick | None:
    """The nearest place of the surface with positions (V, 3) at pixel (x, y), or None beside the face.

    x runs from 0 at the left to the picture's width, y from 0 at the top to its height.
    """
    width, height = size
    origin, along = camera.ray((2.0 * x - width) / height, (height - 2.0 * y) / height)
    from_eye = positions.astype(np.float64) - origin
    hit = _crossed(from_eye, triangles, along)
    if not len(hit):
        return None
    corners = from_eye[triangles.vertices[hit]]
    weights, distance = _met(corners, along)
    ahead = np.flatnonzero(distance > 0.0)
    if not len(ahead):
        return None
    first = ahead[np.argmin(distance[ahead])]
    point = weights[first] @ corners[first]
    nearest = int(np.argmin(((corners[first] - point) ** 2).sum(axis=1)))
    triangle = int(hit[first])
    px, py, pz = (float(value) for value in point + origin)
    a, b, c = (float(value) for value in weights[first])
    return Pick(
        (px, py, pz),
        float(distance[first]),
        int(triangles.vertices[triangle, nearest]),
        int(triangles.polygon[triangle]),
        triangle,
        (a, b, c),
    )


def _crossed(from_eye: Float64, triangles: Triangles, along: Float64) -> Int64:
    """Triangles that the line through the eye along `along` passes through.

    Seen along the line a triangle holds it when the line's foot is on one side of all three edges; the
    edge functions need no division, so triangles at any depth, also behind the eye, are told rightly.
    """
    side = np.cross(along, [0.0, 1.0, 0.0] if abs(along[1]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    u, w = from_eye @ side, from_eye @ np.cross(side, along)
    a, b, c = (np.ascontiguousarray(triangles.vertices[:, i]) for i in range(3))
    ua, ub, uc = u[a], u[b], u[c]
    # Most triangles lie wholly to one side: those are told by two comparisons.
    near = np.flatnonzero(
        (np.minimum(np.minimum(ua, ub), uc) <= 0) & (np.maximum(np.maximum(ua, ub), uc) >= 0)
    )
    ua, ub, uc = ua[near], ub[near], uc[near]
    wa, wb, wc = w[a[near]], w[b[near]], w[c[near]]
    ab, bc, ca = ua * wb - ub * wa, ub * wc - uc * wb, uc * wa - ua * wc
    one_side = ((ab >= 0) & (bc >= 0) & (ca >= 0)) | ((ab <= 0) & (bc <= 0) & (ca <= 0))
    crossed: Int64 = near[one_side & (ab + bc + ca != 0)].astype(np.int64)
    return crossed


def _met(corners: Float64, along: Float64) -> tuple[Float64, Float64]:
    """Barycentric weights (n, 3) and distances (n,) where the line meets triangles (n, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    volumes = np.stack([np.cross(b, c) @ along, np.cross(c, a) @ along, np.cross(a, b) @ along], axis=1)
    weights = volumes / volumes.sum(axis=1, keepdims=True)
    return weights, np.einsum("ni,nij->nj", weights, corners) @ along
