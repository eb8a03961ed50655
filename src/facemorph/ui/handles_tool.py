"""Handles on the face: points drawn over it, set by a click, dragged in the view's plane or along an axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import imgui

from facemorph.core.arrays import Float64
from facemorph.deform.handles import Handle
from facemorph.ui import handles
from facemorph.ui.lab import Grab
from facemorph.ui.on_screen import (
    faces_away,
    on_axis,
    on_view_plane,
    picked,
    projected,
    shown_places,
    surface_of,
)
from facemorph.ui.state import App
from facemorph.ui.theme import Rgba, faded, packed
from facemorph.ui.widgets import colours, unit

_REACH, _RADIUS, _ARROW = 11.0, 5.5, 58.0
_AXIS_INKS: tuple[Rgba, ...] = ((0.93, 0.36, 0.36, 1), (0.42, 0.78, 0.36, 1), (0.38, 0.58, 0.98, 1))
_AXIS_NAMES = ("x", "y", "z", "n")


@dataclass(frozen=True, eq=False)
class _Drawn:
    """The handles as they are on the screen: places (n, 2), points (n, 3), units a model unit (n,)."""

    handles: tuple[Handle, ...]
    points: Float64
    places: Float64
    scale: Float64
    away: list[bool]


class HandlesTool:
    """Takes presses on points and arrows; everything else still turns the face."""

    def press(self, app: App, x: float, y: float, button: int) -> bool:
        """Hold a point or an arrow of the selected one; the right button takes a point away."""
        drawn = _drawn(app)
        if drawn is None:
            return False
        page = app.lab.handles
        if button == 0:
            arrow = _arrow_at(app, drawn, x, y)
            if arrow is not None and page.selected is not None:
                page.grab = _grab(app, drawn, page.selected, arrow, (x, y))
                return True
        hit = _point_at(drawn, x, y)
        if hit is None:
            return False
        if button == 1:
            handles.remove(app, hit)
            return True
        page.selected = hit
        held = handles.handle_at(app, hit)
        page.grab = None if held is None or held.anchor else _grab(app, drawn, hit, None, (x, y))
        return True

    def drag(self, app: App, x: float, y: float) -> None:
        """Move the held point to where the pointer is."""
        grab = app.lab.handles.grab
        if grab is None or (x, y) == grab.start:
            return
        if grab.axis is None:
            by = on_view_plane(app, grab.place, x, y) - on_view_plane(app, grab.place, *grab.start)
        else:
            far = on_axis(app, grab.place, grab.axis, x, y)
            by = (far - on_axis(app, grab.place, grab.axis, *grab.start)) * grab.axis
        handles.move(app, grab.vertex, grab.twin, np.asarray(grab.moved) + by)

    def release(self, app: App) -> None:
        """Let the point go."""
        app.lab.handles.grab = None

    def click(self, app: App, x: float, y: float) -> None:
        """Set a point at the nearest vertex; beside the face nothing is selected any more."""
        surface = app.surface(surface_of)
        hit = picked(app, surface, x, y) if surface is not None else None
        if hit is None:
            app.lab.handles.selected = None
        else:
            handles.place(app, hit.vertex)

    def paint(self, app: App) -> None:
        """All points; anchors are squares, points that look away are dim, the selected one has arrows."""
        drawn, page = _drawn(app), app.lab.handles
        page.hovered = None
        if drawn is None:
            return
        mouse, io = imgui.get_io().mouse_pos, imgui.get_io()
        if not io.want_capture_mouse and not app.drag:
            page.hovered = _point_at(drawn, mouse.x, mouse.y)
        if handles.handle_at(app, page.selected) is None:
            page.selected = None
        for place in np.argsort(-np.asarray(drawn.away, int), kind="stable"):
            _paint_point(app, drawn, int(place))
        _paint_arrows(app, drawn)
        removes = imgui.is_key_pressed(imgui.Key.delete, False)
        if removes and page.selected is not None and not io.want_text_input and not app.drag:
            handles.remove(app, page.selected)


def _drawn(app: App) -> _Drawn | None:
    surface = app.surface(surface_of)
    rows = app.controls.handles.handles
    if surface is None or not rows:
        return None
    vertices = [handle.vertex for handle in rows]
    points = shown_places(app, vertices)
    places, scale = projected(app, points)
    return _Drawn(rows, points, places, scale, faces_away(app, surface, vertices, points))


def _grab(app: App, drawn: _Drawn, vertex: int, arrow: int | None, start: tuple[float, float]) -> Grab:
    place = next(i for i, handle in enumerate(drawn.handles) if handle.vertex == vertex)
    axis = None if arrow is None else _axes(app, vertex)[arrow]
    held = drawn.handles[place]
    return Grab(vertex, handles.twin_of(app, vertex), held.moved, drawn.points[place], axis, start)


def _point_at(drawn: _Drawn, x: float, y: float) -> int | None:
    """The vertex of the point under the pointer: of several the nearest, those in sight first."""
    distances = np.hypot(drawn.places[:, 0] - x, drawn.places[:, 1] - y)
    near = np.flatnonzero(distances <= _REACH * unit())
    if not len(near):
        return None
    best = min(near, key=lambda i: (drawn.away[i], distances[i]))
    return drawn.handles[int(best)].vertex


def _axes(app: App, vertex: int) -> Float64:
    """x, y, z and the surface's normal at rest, (4, 3) unit vectors."""
    surface = app.surface(surface_of)
    assert surface is not None
    return np.vstack([np.eye(3), surface.normals[vertex].astype(np.float64)])


def _arrows(app: App, drawn: _Drawn) -> list[tuple[int, Float64, Float64]]:
    """The selected point's arrows: axis, its start (2,) and end (2,) on the screen; none for an anchor."""
    selected = app.lab.handles.selected
    place = next((i for i, handle in enumerate(drawn.handles) if handle.vertex == selected), None)
    if place is None or selected is None or drawn.handles[place].anchor:
        return []
    length = _ARROW * unit() / drawn.scale[place]
    arrows = []
    for axis, direction in enumerate(_axes(app, selected)):
        long = length * (1.25 if axis == 3 else 1.0)
        end, _ = projected(app, (drawn.points[place] + direction * long)[None])
        # An arrow that points at the viewer could be neither seen nor pulled.
        if np.hypot(*(end[0] - drawn.places[place])) > 14 * unit():
            arrows.append((axis, drawn.places[place], end[0]))
    return arrows


def _arrow_at(app: App, drawn: _Drawn, x: float, y: float) -> int | None:
    for axis, start, end in _arrows(app, drawn):
        along = end - start
        part = float(np.clip((np.array([x, y]) - start) @ along / (along @ along), 0.0, 1.05))
        near = np.hypot(*(start + part * along - (x, y))) <= 7 * unit()
        if near and part * np.hypot(*along) > _REACH * unit():
            return axis
    return None


def _paint_point(app: App, drawn: _Drawn, place: int) -> None:
    c, scale, page = colours(app), unit(), app.lab.handles
    handle, (x, y) = drawn.handles[place], drawn.places[place]
    chosen, near = handle.vertex == page.selected, handle.vertex == page.hovered
    alpha = 0.35 if drawn.away[place] or not app.controls.on("handles") else 1.0
    radius = (_RADIUS + 1.5 * (chosen or near)) * scale
    ink = c.accent_bright if chosen or near else c.accent
    fill, edge = packed(faded(ink, alpha)), packed(faded((0.04, 0.05, 0.06, 1), alpha))
    paint = imgui.get_window_draw_list()
    if handle.anchor:
        low, high = (x - radius, y - radius), (x + radius, y + radius)
        paint.add_rect_filled(low, high, packed(faded((0.98, 0.76, 0.30, 1), alpha)), scale)
        paint.add_rect(low, high, edge, scale, thickness=1.5 * scale)
    else:
        paint.add_circle_filled((x, y), radius, fill)
        paint.add_circle((x, y), radius, edge, thickness=1.5 * scale)
    if chosen:
        paint.add_circle((x, y), radius + 3.5 * scale, packed((1, 1, 1, alpha)), thickness=1.5 * scale)


def _paint_arrows(app: App, drawn: _Drawn) -> None:
    paint, scale, c = imgui.get_window_draw_list(), unit(), colours(app)
    mouse = imgui.get_io().mouse_pos
    under = _arrow_at(app, drawn, mouse.x, mouse.y) if not app.drag else None
    for axis, start, end in _arrows(app, drawn):
        ink = packed(_AXIS_INKS[axis] if axis < 3 else c.accent_bright)
        along = (end - start) / np.hypot(*(end - start))
        across = np.array([-along[1], along[0]])
        thick = (3.5 if axis == under else 2.2) * scale
        first = start + along * (_RADIUS + 4) * scale
        paint.add_line(tuple(first), tuple(end), ink, thick)
        tip = end + along * 8 * scale
        paint.add_triangle_filled(
            tuple(tip), tuple(end + across * 4.5 * scale), tuple(end - across * 4.5 * scale), ink
        )
        size = imgui.calc_text_size(_AXIS_NAMES[axis])
        text = tip + along * 9 * scale
        paint.add_text((text[0] - size.x / 2, text[1] - size.y / 2), ink, _AXIS_NAMES[axis])
