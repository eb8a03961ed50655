"""How much light reaches places inside the mouth: as much as they see of the opening between the lips.

The opening is a polygon along the lips' edge, uniformly bright. What a surface sees of it is Lambert's
formula (Photometria, 1760; Baum, Rushmeier and Winget, Improving Radiosity Solutions Through the Use of
Analytically Determined Form-Factors, SIGGRAPH 1989, eq. 10): 1 / (2 pi) times the sum over the edges of
the angle that an edge subtends, along the normal of the plane through it and the eye. It holds for edges
that are not in one plane too. `shaders/lib/mouth_light.glsl` has the same formulas.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64

APERTURE = 8
DIM, BOUNCE, INTERREFLECTION, PENUMBRA, FRONT = 0.07, 0.42, 0.56, 0.40, 0.12


@dataclass(frozen=True, eq=False)
class Aperture:
    """The opening between the lips.

    edge     (8, 3) places along the lips, from the right corner leftwards along the upper one and back
    centre   (3,) their middle
    normal   (3,) unit, out of the mouth
    size     half the distance between the corners, model units
    """

    edge: Float64
    centre: Float64
    normal: Float64
    size: float

    @classmethod
    def between(cls, edge: Float64, face_forward: Float64) -> Aperture:
        """Of lips (8, 3) in that order; `face_forward` (3,) says where out is when the lips are shut."""
        across = edge[APERTURE // 2] - edge[0]
        size = 0.5 * float(np.linalg.norm(across))
        up = np.cross(face_forward, across)
        normal = np.cross(across, up)
        length = np.linalg.norm(normal)
        unit = normal / length if length > 0.0 else face_forward
        return cls(_parted(edge, up, size), edge.mean(0), unit, size)


def _parted(edge: Float64, up: Float64, size: float) -> Float64:
    """Lips that overlap let no light in, rather than light from behind: both halves meet half way."""
    length = float(np.linalg.norm(up))
    if length == 0.0:
        return edge
    parted, unit = edge.copy(), up / length
    for k in range(1, APERTURE // 2):
        upper, lower = k, APERTURE - k
        overlap = min(float((edge[upper] - edge[lower]) @ unit), 0.0)
        parted[upper] = parted[upper] - 0.5 * overlap * unit
        parted[lower] = parted[lower] + 0.5 * overlap * unit
    return parted


def light_through(aperture: Aperture, positions: Float64, towards_key: Float64) -> tuple[Float64, Float64]:
    """The field (n, 3) at positions (n, 3), its length the share of light that a surface turned towards
    the opening gets; and how well the key's direction (3,) is inside the opening (n,), as a sine."""
    rays = aperture.edge[None] - positions[:, None]
    rays = rays / np.linalg.norm(rays, axis=2, keepdims=True)
    before = np.roll(rays, 1, axis=1)
    edges = np.cross(rays, before)
    sines = np.maximum(np.linalg.norm(edges, axis=2), 1e-6)
    angles = np.arctan2(sines, (before * rays).sum(2))
    field = (edges * (angles / sines)[..., None]).sum(1) / (2.0 * np.pi)
    inside = np.minimum(((edges @ towards_key) / sines).min(1), 1.0)
    return field, inside


def before_lips(aperture: Aperture, positions: Float64) -> Float64:
    """0 behind the lips to 1 before them (n,)."""
    ahead = (positions - aperture.centre) @ aperture.normal / aperture.size
    return _smoothstep(-FRONT, FRONT, ahead)


def mouth_light(aperture: Aperture, positions: Float64, normals: Float64, towards_key: Float64) -> Float64:
    """Shares (n, 2) of the light from all round and of the key that reach places with unit normals (n, 3)."""
    field, inside = light_through(aperture, positions, towards_key)
    opening = np.linalg.norm(field, axis=1)
    facing = np.maximum((field * normals).sum(1), 0.0)
    direct = np.minimum(BOUNCE * opening + (1.0 - BOUNCE) * facing, 1.0)
    around = DIM + (1.0 - DIM) * direct**INTERREFLECTION
    key = _smoothstep(-PENUMBRA, PENUMBRA, inside)
    share = before_lips(aperture, positions)[:, None]
    return np.stack([around, key], -1) * (1.0 - share) + share


def _smoothstep(start: float, end: float, value: Float64) -> Float64:
    t = np.clip((value - start) / (end - start), 0.0, 1.0)
    smooth: Float64 = t * t * (3.0 - 2.0 * t)
    return smooth
