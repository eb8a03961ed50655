"""The shown surface on the screen: where its vertices are drawn, what lies under the pointer."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.normals import vertex_normals
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.core.triangles import Triangles, triangulated
from facemorph.gl.picking import Pick, pick
from facemorph.ui.state import App, Viewport


@dataclass(frozen=True, eq=False)
class Surface:
    """What of a rig does not change with its pose: triangles, and the unit normals (V, 3) at rest."""

    rig: Rig
    triangles: Triangles
    normals: Float32


def surface_of(rig: Rig) -> Surface:
    """A rig's surface; kept by whoever needs it every frame."""
    return Surface(rig, triangulated(rig.neutral), vertex_normals(rig.neutral.positions, rig.triangles))


def shown_places(app: App, vertices: list[int], scene: Scene | None = None) -> Float64:
    """Where vertices (n,) of the shown face, or of another scene, are; (n, 3) model units."""
    assert app.face is not None
    rig, scene, at = app.face.rig, scene or app.scene(), np.asarray(vertices, np.int64)
    places = rig.neutral.positions[at].astype(np.float64)
    coefficients = rig.coefficients(scene.pose)
    for k in np.flatnonzero(coefficients):
        places += coefficients[k] * rig.deltas[k][at]
    return places if scene.offsets is None else places + scene.offsets[at]


def projected(app: App, points: Float64, view: Viewport | None = None) -> tuple[Float64, Float64]:
    """Places in the window (n, 2) of points (n, 3), and units of the window in a model unit there, (n,).

    view   the one of the face's views that is meant; None takes the first
    """
    view, camera = view or app.views()[0], app.camera
    right, up, back = camera.axes()
    from_eye = points - camera.position()
    depth = np.maximum(-(from_eye @ back), 1e-6)
    scale = view.height / 2.0 / (math.tan(math.radians(camera.field_deg) / 2.0) * depth)
    x = view.x + view.width / 2.0 + from_eye @ right * scale
    y = view.y + view.height / 2.0 - from_eye @ up * scale
    return np.stack([x, y], axis=1), scale


def faces_away(app: App, surface: Surface, vertices: list[int], points: Float64) -> list[bool]:
    """Whether the surface at each vertex (its normal at rest) looks away from the camera."""
    normals = surface.normals[vertices].astype(np.float64)
    return [bool(away) for away in ((app.camera.position() - points) * normals).sum(axis=1) < 0.0]


def picked(app: App, surface: Surface, x: float, y: float) -> Pick | None:
    """What of the shown face lies at a place of the window."""
    view = app.view_at(x, y)
    if not view.contains(x, y):
        return None
    assert app.face is not None
    split = app.on_face.split
    scene = split.right if split is not None and view == app.views()[1] else app.scene()
    positions = scene.positions(app.face.rig)
    return pick(positions, surface.triangles, app.camera, view.size, *view.pixel(x, y))


def on_view_plane(app: App, point: Float64, x: float, y: float) -> Float64:
    """Where the sight line through a place meets the plane through `point` that faces the camera."""
    origin, along = app.camera.ray(*app.viewport.centred(x, y))
    back = app.camera.axes()[2]
    reach = float((point - origin) @ back) / float(along @ back)
    place: Float64 = origin + along * reach
    return place


def on_axis(app: App, point: Float64, axis: Float64, x: float, y: float) -> float:
    """How far along `axis` (unit) from `point` the sight line through a place comes nearest to that line.

    0 where one looks along the axis: the pointer cannot say how far.
    """
    origin, along = app.camera.ray(*app.viewport.centred(x, y))
    between, cosine = point - origin, float(axis @ along)
    sine_squared = 1.0 - cosine * cosine
    if sine_squared < 1e-3:
        return 0.0
    return (cosine * float(between @ along) - float(between @ axis)) / sine_squared
