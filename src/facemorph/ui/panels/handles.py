"""The Handles page: control points on the face that are dragged, and the field that follows them (RBF)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2, imgui

from facemorph.core.rig import Rig
from facemorph.deform.handles import Handle
from facemorph.ui import actions, handles
from facemorph.ui.handles_tool import HandlesTool
from facemorph.ui.panels import rebuild
from facemorph.ui.panels.kernels import kernel_rows
from facemorph.ui.panels.rows import divider, method_head, quiet_words
from facemorph.ui.panels.value_rows import Value, button_row, switch_row, unit_words, value_row
from facemorph.ui.state import App
from facemorph.ui.widgets import chip_width, tab_chips, tooltip, unit

_SETS = (
    ("Set points", "A click on the face sets a point that can be dragged"),
    ("Set anchors", "A click on the face sets an anchor: it holds its place at rest"),
)
_HELP = (
    "Click on the face to set a point, then drag it; the face follows. The arrows move it along x, y, z and "
    "the surface's normal n. Right-click or Delete takes a point away."
)


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.controls.on("handles") and not handles.at_rest(app)


def draw(app: App) -> None:
    """The page's contents; while it is on show, clicks on the face set points."""
    method_head(
        app,
        "handles",
        "Handles",
        usable=app.rig is not None,
        at_rest=handles.at_rest(app),
        reset=handles.back_to_rest,
        tip="Every point back to where it rests; the points stay",
    )
    if app.rig is None:
        quiet_words("No face is open.")
        return
    imgui.begin_child("handles page", ImVec2(0, 0))
    if not app.lab.rebuild.on:
        app.on_face.tool = HandlesTool()
        _points(app, app.rig)
        divider(app, "Rebuild an expression")
    rebuild.draw(app, app.rig)
    imgui.end_child()


def _points(app: App, rig: Rig) -> None:
    page, rows = app.lab.handles, app.controls.handles.handles
    page.sets = tab_chips(app, _SETS, page.sets)
    page.mirror = switch_row(
        app, "Mirror", page.mirror, "Sets and moves a twin on the other side of the face as well"
    )
    _kernel(app, rig)
    quiet_words(_HELP if not rows else _count_words(rows))
    chosen = handles.handle_at(app, page.selected)
    if chosen is not None:
        _selected(app, rig, chosen)
    pressed = button_row(
        app,
        (
            ("Clear", "Take all points away", bool(rows)),
            ("Open…", "Open points kept in a file", True),
            ("Save…", "Keep the points in a file", bool(rows)),
        ),
    )
    if pressed == "Clear":
        handles.clear(app)
    elif pressed:
        actions.ask_for(app, "open points" if pressed == "Open…" else "save points")
    _keep(app)


def _count_words(rows: tuple[Handle, ...]) -> str:
    anchors = sum(handle.anchor for handle in rows)
    points = len(rows) - anchors
    words = f"{points} point{'s' if points != 1 else ''}"
    return f"{words}, {anchors} anchor{'s' if anchors != 1 else ''}" if anchors else words


def _kernel(app: App, rig: Rig) -> None:
    present = app.controls.handles
    kernel, c = kernel_rows(app, rig, "handles", present.kernel, present.c)
    if (kernel, c) != (present.kernel, present.c):
        handles.change(app, replace(present, kernel=kernel, c=c))


def _selected(app: App, rig: Rig, chosen: Handle) -> None:
    divider(app, f"{'Anchor' if chosen.anchor else 'Point'} at vertex {chosen.vertex:,}")
    tip = "An anchor holds its place at rest: it cannot be dragged"
    anchor = switch_row(app, "Anchor", chosen.anchor, tip)
    if anchor != chosen.anchor:
        handles.set_anchor(app, chosen.vertex, anchor=anchor)
        return
    if not chosen.anchor:
        largest = max(round(rig.neutral.diagonal / 10.0, 1), 1e-3)
        moved = [
            value_row(
                app,
                Value(f"handle {axis}", f"{axis}, {unit_words(rig)}", value, -largest, largest, _MOVED_TIP),
            )
            for axis, value in zip("xyz", chosen.moved, strict=True)
        ]
        if tuple(moved) != chosen.moved:
            handles.move(app, chosen.vertex, handles.twin_of(app, chosen.vertex), np.array(moved))


_MOVED_TIP = "How far the point is moved: u of (2.13)"


def _keep(app: App) -> None:
    page = app.lab.handles
    words = "Keep as shape"
    room, beside = imgui.get_content_region_avail().x, chip_width(words) + 5 * unit()
    narrow = room - beside < 90 * unit()
    imgui.set_next_item_width(room if narrow else room - beside)
    _, page.name = imgui.input_text_with_hint("##shape name", "Name of a new shape", page.name)
    if not narrow:
        imgui.same_line(0, 5 * unit())
    imgui.begin_disabled(handles.at_rest(app))
    if imgui.button(words, ImVec2(room if narrow else 0, 0)):
        handles.keep_as_shape(app, page.name)
    imgui.end_disabled()
    tooltip("Adds what the points do now to the face as a new shape; the points go back to rest")
