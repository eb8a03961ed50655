"""Eyes as their shader sees them: where each ball is, where it looks, and where its lids' edges run.

Eyes are known by their layout: groups eye_L and eye_R, each with the pupil in the middle of its picture
and rings around it whose radius in the picture is 0.27 at the limbus. Where a face's eyes are laid out
otherwise, or it has none, the shader gets `eyes_known` false and draws plain balls.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int64, distinct
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.gl.followed import Followed

GROUPS = ("eye_L", "eye_R")
SKIN = "skin"
# As shaders/eye.frag has it.
LIMBUS_IN_PICTURE = 0.27
_PICTURE_TOLERANCE = 2e-3
# Distance of the limbus's plane from the middle of the ball, in radii of the limbus (23.5 degrees).
LIMBUS_AHEAD = 2.2998
BALL_RADIUS = 2.5078
# Lids are looked for this far around the line of sight, so near the ball, in its radii, and so often.
_AROUND, _NEAREST, _FARTHEST, _STATIONS = 0.95, 1.012, 1.13, 13
_FEWEST = 5


@dataclass(frozen=True)
class _Eye:
    """Vertices of one eye: right, top, left and bottom of its limbus; the upper and the lower lid's edge."""

    limbus: Int64
    upper: Int64
    lower: Int64


class Eyes:
    """The driver of both eyes. `eyes_of` makes it."""

    def __init__(self, rig: Rig, eyes: tuple[_Eye, _Eye]) -> None:
        self._eyes = eyes
        self._followed = Followed(rig, np.concatenate([np.concatenate(_parts(eye)) for eye in eyes]))
        self._radius = [
            float(np.linalg.norm(rest[0] - rest[2])) / 2.0 * BALL_RADIUS
            for rest in (rig.neutral.positions[eye.limbus].astype(np.float64) for eye in eyes)
        ]

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        """See `shaders/eye.frag`."""
        points = self._followed(coefficients, offsets)
        found: dict[str, list[object]] = {}
        first = 0
        for eye, radius in zip(self._eyes, self._radius, strict=True):
            ends = np.cumsum([len(part) for part in _parts(eye)]) + first
            limbus, upper, lower, _ = np.split(points[first:], ends - first)
            for name, value in _uniforms_of_eye(limbus, upper, lower, radius).items():
                found.setdefault(name, []).append(value)
            first = int(ends[-1])
        return {"eyes_known": True, **found}


class NoEyes:
    """What the shader is told of a face without such eyes."""

    def uniforms(self, coefficients: Float64, offsets: Float32 | None) -> Mapping[str, object]:
        return {"eyes_known": False}


def eyes_of(rig: Rig) -> Eyes | NoEyes:
    """The driver for a rig's eyes."""
    eyes = [_eye(rig.neutral, name) for name in GROUPS]
    if eyes[0] is None or eyes[1] is None:
        return NoEyes()
    return Eyes(rig, (eyes[0], eyes[1]))


def _parts(eye: _Eye) -> tuple[Int64, Int64, Int64]:
    return eye.limbus, eye.upper, eye.lower


def _uniforms_of_eye(limbus: Float64, upper: Float64, lower: Float64, radius: float) -> dict[str, object]:
    """For the morphed limbus (4, 3) and lids (n, 3) of one eye."""
    right, up = _unit(limbus[0] - limbus[2]), _unit(limbus[1] - limbus[3])
    forward = _unit(np.cross(right, up))
    centre = limbus.mean(0) - forward * (radius / BALL_RADIUS * LIMBUS_AHEAD)
    above, below = ((lid - centre) / radius for lid in (upper, lower))
    low = max(above[:, 0].min(), below[:, 0].min())
    high = min(above[:, 0].max(), below[:, 0].max())
    return {
        "eye_centre": tuple(centre.tolist()),
        "eye_right": tuple(right.tolist()),
        "eye_up": tuple(np.cross(forward, right).tolist()),
        "eye_forward": tuple(forward.tolist()),
        "eye_radius": radius,
        "upper_lid": _cubic(above),
        "lower_lid": _cubic(below),
        "lid_span": (float(low), float(high)),
    }


def _unit(vector: Float64) -> Float64:
    return vector / max(float(np.linalg.norm(vector)), 1e-12)


def _cubic(points: Float64) -> tuple[float, ...]:
    """Coefficients, constant first, of y over x for points (n, 3)."""
    powers = points[:, :1] ** np.arange(4)
    return tuple(np.linalg.lstsq(powers, points[:, 1], rcond=None)[0].tolist())


def _eye(mesh: Mesh, group: str) -> _Eye | None:
    """An eye of the layout, with lids around it; None where there is none."""
    corners, of_skin = _corners(mesh, group), _corners(mesh, SKIN)
    if mesh.corner_uvs is None or not len(corners) or not len(of_skin):
        return None
    corners = corners[mesh.corner_uvs[corners] >= 0]
    if not len(corners):
        return None
    skin = distinct(mesh.corner_vertices[of_skin])
    place = mesh.uvs[mesh.corner_uvs[corners]].astype(np.float64) - 0.5
    vertices = mesh.corner_vertices[corners]
    found = []
    for aim in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        distance = np.linalg.norm(place - LIMBUS_IN_PICTURE * np.array(aim), axis=1)
        if distance.min() > _PICTURE_TOLERANCE:
            return None
        found.append(int(vertices[distance.argmin()]))
    limbus = np.array(found, np.int64)
    lids = _lids(mesh.positions[skin].astype(np.float64), mesh.positions[limbus].astype(np.float64))
    if lids is None:
        return None
    return _Eye(limbus, skin[lids[0]].astype(np.int64), skin[lids[1]].astype(np.int64))


def _corners(mesh: Mesh, group: str) -> Int64:
    """The corners of a group's polygons."""
    if mesh.groups is None or group not in mesh.groups.names:
        return np.zeros(0, np.int64)
    inside = mesh.groups.index == mesh.groups.names.index(group)
    return np.flatnonzero(np.repeat(inside, np.diff(mesh.polygon_starts)))


def _lids(skin: Float64, limbus: Float64) -> tuple[Int64, Int64] | None:
    """Indices into the skin (n, 3) along the edges of the upper and the lower lid."""
    radius = float(np.linalg.norm(limbus[0] - limbus[2])) / 2.0 * BALL_RADIUS
    forward = _unit(np.cross(limbus[0] - limbus[2], limbus[1] - limbus[3]))
    centre = limbus.mean(0) - forward * (radius / BALL_RADIUS * LIMBUS_AHEAD)
    off = (skin - centre) / max(radius, 1e-12)
    distance = np.linalg.norm(off, axis=1)
    near = (distance > _NEAREST) & (distance < _FARTHEST) & (off @ forward > 0.2) & (abs(off[:, 0]) < _AROUND)
    station = np.floor((off[:, 0] / _AROUND + 1.0) / 2.0 * _STATIONS)
    edges: list[list[int]] = [[], []]
    for k in range(_STATIONS):
        for edge, sign in zip(edges, (1.0, -1.0), strict=True):
            here = np.flatnonzero(near & (station == k) & (off[:, 1] * sign > 0.0))
            if len(here):
                edge.append(int(here[np.argmin(off[here, 1] * sign)]))
    if min(len(edge) for edge in edges) < _FEWEST:
        return None
    return np.array(edges[0], np.int64), np.array(edges[1], np.int64)
