"""Regions on the face: the brush that paints them, and the mark of the open region's pivot."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from facemorph.ui import regions
from facemorph.ui.on_face import OnlyPaints
from facemorph.ui.on_screen import picked, projected, surface_of
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, unit

# The brush is set down again after this part of its radius.
_STEP = 0.25


class BrushTool(OnlyPaints):
    """The left button paints the chosen region; beside the face it still turns it."""

    def press(self, app: App, x: float, y: float, button: int) -> bool:
        """Begin a stroke where the face is hit."""
        return button == 0 and not imgui.get_io().key_shift and _dab(app, x, y, begins=True)

    def drag(self, app: App, x: float, y: float) -> None:
        """Go on with the stroke."""
        page = app.lab.regions
        if page.stroke is None or page.last_dab is None:
            return
        far = np.hypot(x - page.last_dab[0], y - page.last_dab[1])
        if far >= max(_STEP * _radius_units(app), 1.0):
            _dab(app, x, y, begins=False)

    def release(self, app: App) -> None:
        """The stroke is done: one step of undo."""
        if app.rig is not None:
            regions.end_stroke(app, app.rig)

    def paint(self, app: App) -> None:
        """The brush's edge round the pointer."""
        mouse, io = imgui.get_io().mouse_pos, imgui.get_io()
        if io.want_capture_mouse or not app.viewport.contains(mouse.x, mouse.y):
            return
        ink = colours(app).error if app.lab.regions.takes else (1.0, 1.0, 1.0, 0.9)
        paint, radius = imgui.get_window_draw_list(), _radius_units(app)
        paint.add_circle(mouse, radius, packed((0.0, 0.0, 0.0, 0.6)), thickness=3 * unit())
        paint.add_circle(mouse, radius, packed(ink), thickness=1.5 * unit())


class PivotMark(OnlyPaints):
    """Shows where the open region turns about; the mouse turns the face as ever."""

    def paint(self, app: App) -> None:
        """A ring with a cross at the pivot."""
        present, name = regions.region_set(app), app.lab.regions.opened
        if app.rig is None or present is None or name not in present.names:
            return
        kept = regions.control(app, app.rig, name)
        pivot = present.middle(name) if kept.pivot is None else np.asarray(kept.pivot)
        (x, y), paint, scale = projected(app, pivot[None])[0][0], imgui.get_window_draw_list(), unit()
        for ink, thick in (((0.0, 0.0, 0.0, 0.6), 3.5), ((1.0, 1.0, 1.0, 0.95), 1.6)):
            paint.add_circle((x, y), 6 * scale, packed(ink), thickness=thick * scale)
            for dx, dy in ((1, 0), (0, 1)):
                start, end = (
                    (x - 11 * dx * scale, y - 11 * dy * scale),
                    (x + 11 * dx * scale, y + 11 * dy * scale),
                )
                paint.add_line(start, end, packed(ink), thick * scale)


def _radius_units(app: App) -> float:
    """The brush's radius on the screen, in the middle of the view."""
    _, scale = projected(app, np.asarray(app.camera.target)[None])
    return float(app.lab.regions.radius * scale[0])


def _dab(app: App, x: float, y: float, *, begins: bool) -> bool:
    surface = app.surface(surface_of)
    hit = picked(app, surface, x, y) if surface is not None else None
    if hit is None or app.rig is None:
        return False
    if begins:
        regions.begin_stroke(app, app.rig)
    regions.dab(app, app.rig, app.scene().positions(app.rig), np.asarray(hit.point))
    app.lab.regions.last_dab = (x, y)
    return True
