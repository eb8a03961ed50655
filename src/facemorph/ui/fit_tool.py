"""The mouse on the page Fit's views: points of the template, and the same points on the scan."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from facemorph.core.arrays import Bool, Float64, Int64
from facemorph.core.mesh import Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.triangles import Triangles, triangulated
from facemorph.fit.align import Similarity
from facemorph.gl.picking import Pick, pick
from facemorph.ui import fit_wrap
from facemorph.ui.fit_landmarks import words_of
from facemorph.ui.fit_plan import Piece
from facemorph.ui.on_face import OnlyPaints
from facemorph.ui.on_screen import projected
from facemorph.ui.split_words import paint_split_words
from facemorph.ui.state import App, Face, Viewport
from facemorph.ui.theme import Rgba, faded, packed
from facemorph.ui.widgets import colours, unit

_REACH, _RADIUS = 11.0, 8.0
# How many vertices around a point tell which way it looks, at least, and of how many one.
_LOOKED_AT, _PART = 12, 250
_MOST_NEAREST = 1000
_INK: Rgba = (0.05, 0.06, 0.07, 0.92)
_DOT: Rgba = (1.0, 0.82, 0.25, 1.0)


class TitlesTool(OnlyPaints):
    """Says what both views show."""

    def paint(self, app: App) -> None:
        """The line between the views, and their titles."""
        paint_split_words(app)


class PointsTool(OnlyPaints):
    """A click left chooses a point of the template, a click right says where it is on the scan.

    Points on the scan are dragged with the left button and taken away with the right one.
    """

    def press(self, app: App, x: float, y: float, button: int) -> bool:
        """Hold a point of the scan, or take it away."""
        piece = fit_wrap.pointed_piece(app)
        number = None if piece is None else _point_at(app, piece, x, y)
        if piece is None or number is None:
            return False
        if button == 1:
            fit_wrap.remove_point(app, piece, number)
            return True
        app.pages.fit.held, app.pages.fit.held_from = number, piece
        return True

    def drag(self, app: App, x: float, y: float) -> None:
        """The held point follows the pointer over the scan."""
        piece, number = fit_wrap.pointed_piece(app), app.pages.fit.held
        if piece is None or number is None or number >= len(piece.pairs):
            return
        place = _on_scan(app, piece, x, y)
        if place is not None and (imgui.get_io().mouse_delta.x or imgui.get_io().mouse_delta.y):
            fit_wrap.move_point(app, piece, number, place)

    def release(self, app: App) -> None:
        """Let the point go."""
        app.pages.fit.held = app.pages.fit.held_from = None

    def click(self, app: App, x: float, y: float) -> None:
        """Choose a point of the template, or say where it is on the scan."""
        piece = fit_wrap.pointed_piece(app)
        if piece is None or app.on_face.split is None:
            return
        if app.views()[1].contains(x, y):
            place = _on_scan(app, piece, x, y)
            if place is not None:
                fit_wrap.point_at(app, piece, place)
            return
        hit = _hit(app, app.shown_face, app.views()[0], x, y)
        if hit is not None:
            fit_wrap.choose_vertex(app, hit.vertex)

    def paint(self, app: App) -> None:
        """Numbered dots on both views, and a ring around what is asked for."""
        paint_split_words(app)
        piece, face, split = fit_wrap.pointed_piece(app), app.shown_face, app.on_face.split
        if piece is None or face is None or split is None:
            return
        left, right = app.views()
        places = face.rig.neutral.positions.astype(np.float64)
        vertices = [pair.vertex for pair in piece.pairs if pair.vertex < len(places)]
        _dots(app, left, places[vertices], _away(app, face, None, places[vertices]))
        if piece.pairs:
            way = fit_wrap.placement(app, piece, face.rig.neutral)
            points = np.array([pair.point for pair in piece.pairs])
            _dots(app, right, way.points(points), _away(app, split.face or face, way, points))
        wanted = fit_wrap.wanted_vertex(app, piece)
        if wanted is None or wanted[0] >= len(places):
            return
        place = places[[wanted[0]]]
        _ring(app, left, place, words_of(wanted[1], wanted[0]))
        if len(piece.pairs) >= 3:
            _ring(app, right, place, "about here?", faint=True)


def _shown_points(app: App, piece: Piece) -> Float64:
    """Where the points of the scan are in the right view, (n, 3)."""
    base = app.shown_face
    if not piece.pairs or base is None:
        return np.zeros((0, 3))
    way = fit_wrap.placement(app, piece, base.rig.neutral)
    return way.points(np.array([pair.point for pair in piece.pairs]))


def _point_at(app: App, piece: Piece, x: float, y: float) -> int | None:
    """The scan's point under the pointer."""
    view = app.views()[-1]
    if app.on_face.split is None or not view.contains(x, y) or not piece.pairs:
        return None
    places, _ = projected(app, _shown_points(app, piece), view)
    gaps = np.hypot(places[:, 0] - x, places[:, 1] - y)
    number = int(np.argmin(gaps))
    return number if gaps[number] <= _REACH * unit() else None


def _on_scan(app: App, piece: Piece, x: float, y: float) -> Float64 | None:
    """The place (3,) of the scan, as its file has it, under the pointer."""
    split, base = app.on_face.split, app.shown_face
    if split is None or base is None:
        return None
    hit = _hit(app, split.face, app.views()[1], x, y)
    if hit is None:
        return None
    way = fit_wrap.placement(app, piece, base.rig.neutral)
    place: Float64 = way.inverse().points(np.array([hit.point]))[0]
    return place


def _hit(app: App, face: Face | None, view: Viewport, x: float, y: float) -> Pick | None:
    if face is None or not view.contains(x, y):
        return None
    split = app.on_face.split
    right = split is not None and face is split.face
    scene = split.right if split is not None and right else app.scene()
    return pick(scene.positions(face.rig), _triangles(app, face), app.camera, view.size, *view.pixel(x, y))


def _triangles(app: App, face: Face) -> Triangles:
    """A face's triangles with their polygons; made once."""
    mesh = face.rig.neutral
    return app.pages.fit.keep(("triangles", mesh), lambda: triangulated(mesh))


def _away(app: App, face: Face, way: Similarity | None, points: Float64) -> Bool:
    """Which points (n, 3) of a surface, as its file has it, lie on the side that looks away from the camera.

    way  where the surface is shown; None for where its file has it
    """
    if not len(points):
        return np.zeros(0, bool)
    mesh, page = face.rig.neutral, app.pages.fit
    normals = page.keep(
        ("normals", mesh), lambda: vertex_normals(mesh.positions, _triangles(app, face).vertices)
    )
    near = np.array([_nearest(app, mesh, point) for point in points])
    shown, seen = points, normals[near].astype(np.float64)
    if way is not None:
        shown, seen = way.points(points), seen @ way.rotation.T
    sight = app.camera.position() - shown
    # In folds, at the corners of eyes and lips, some of the normals look aside.
    return np.asarray(np.einsum("ni,nki->nk", sight, seen).max(axis=1) < 0.0)


def _nearest(app: App, mesh: Mesh, point: Float64) -> Int64:
    """The few vertices of a mesh that are nearest to a point (3,)."""
    held, key = app.pages.fit.nearest, (mesh, point.tobytes())
    if key not in held:
        if len(held) > _MOST_NEAREST:
            held.clear()
        gaps = ((mesh.positions - point) ** 2).sum(axis=1)
        few = min(max(_LOOKED_AT, len(gaps) // _PART), len(gaps) - 1)
        held[key] = np.argpartition(gaps, few)[:few]
    return held[key]


def _dots(app: App, view: Viewport, points: Float64, away: Bool) -> None:
    """Numbered dots; those behind the head small and without their number."""
    if not len(points):
        return
    places, _ = projected(app, points, view)
    paint, scale = imgui.get_window_draw_list(), unit()
    for number, ((x, y), behind) in enumerate(zip(places, away, strict=True), start=1):
        if not view.contains(x, y):
            continue
        if behind:
            paint.add_circle_filled((x, y), 2.0 * scale, packed(faded(_DOT, 0.45)))
            continue
        text = str(number)
        size = imgui.calc_text_size(text)
        paint.add_circle_filled((x, y), 3.0 * scale, packed(_DOT))
        paint.add_circle((x, y), 3.6 * scale, packed(_INK), thickness=1.4 * scale)
        at = (x + 6 * scale, y - size.y - 1 * scale)
        corner = (at[0] + size.x + 3 * scale, at[1] + size.y)
        paint.add_rect_filled((at[0] - 3 * scale, at[1]), corner, packed(_INK), 4 * scale)
        paint.add_text(at, packed(_DOT), text)


def _ring(app: App, view: Viewport, place: Float64, words: str, *, faint: bool = False) -> None:
    (x, y), paint, scale, c = (
        projected(app, place, view)[0][0],
        imgui.get_window_draw_list(),
        unit(),
        colours(app),
    )
    if not view.contains(x, y):
        return
    ink = faded(c.accent_bright, 0.55) if faint else c.accent_bright
    for shade, thick in ((_INK, 4.0), (ink, 2.0)):
        paint.add_circle((x, y), _RADIUS * scale, packed(shade), thickness=thick * scale)
    size = imgui.calc_text_size(words)
    at = (min(x + 14 * scale, view.x + view.width - size.x - 8 * scale), y + 8 * scale)
    low, high = (
        (at[0] - 5 * scale, at[1] - 2 * scale),
        (at[0] + size.x + 5 * scale, at[1] + size.y + 2 * scale),
    )
    paint.add_rect_filled(low, high, packed(faded(c.panel, 0.86)), 5 * scale)
    paint.add_text(at, packed(c.dim if faint else c.text), words)
