"""The shapes panel: every shape with a slider, the active ones first, found by typing."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from facemorph.core.rig import Rig, Shape, plain_label
from facemorph.ui import actions, fonts
from facemorph.ui.panels.rows import Head, Row, head, quiet_words, weight_row, widest_of
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, cut, icon_button, tooltip, unit

SET_TITLES = {"expression": "Expressions", "facs": "FACS units", "arkit": "ARKit shapes", "made": "Made here"}
SET_TIPS = {
    "expression": "Whole expressions, added on top of what the slider gives",
    "facs": "Action units of the Facial Action Coding System: single movements that add up to expressions",
    "arkit": "The 52 shapes that face capture on a phone gives",
    "made": "Shapes kept from the page Handles",
}
ACTIVE = "active"


@dataclass(frozen=True)
class _Line:
    """One line of the list: a section's head, or a shape of it; `widest` as `Row` has it."""

    section: str
    title: str = ""
    shape: Shape | None = None
    widest: float = 0.0


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.shapes_on and bool(app.pose.weights)


def draw(app: App) -> None:
    """The panel's contents."""
    _head(app)
    rig = app.rig
    if rig is None or not rig.controls:
        quiet_words("No face is open." if rig is None else "This face has no shapes: nothing to morph to.")
        return
    _search(app)
    imgui.begin_child("shapes", ImVec2(0, 0))
    _refresh_active(app, rig)
    _list(app, _lines(app, rig))
    imgui.end_child()


def _head(app: App) -> None:
    line = Head(
        "Shapes",
        app.shapes_on,
        app.rig is not None and bool(app.rig.controls),
        bool(app.pose.weights),
        "Take these shapes out of the face, and put them back",
        "Takes out every shape added here; the slider along the bottom stays",
        "Reset all",
        wide=True,
    )
    toggled, cleared = head(app, line)
    if toggled:
        actions.toggle_shapes(app)
    if cleared:
        actions.reset_weights(app)


def _search(app: App) -> None:
    has_words = bool(app.shapes.search)
    clear = imgui.get_frame_height() + 4 * unit() if has_words else 0.0
    imgui.set_next_item_width(imgui.get_content_region_avail().x - clear)
    _, app.shapes.search = imgui.input_text_with_hint(
        "##search", f"{fonts.SEARCH}  Find a shape", app.shapes.search
    )
    if has_words:
        imgui.same_line(0, 4 * unit())
        if icon_button(app, fonts.CLOSE, "clear search", "Show all shapes"):
            app.shapes.search = ""


def found(shape: Shape, words: str) -> bool:
    """Whether a shape's name, label or set has every word that is searched."""
    text = f"{shape.name} {shape.label} {SET_TITLES.get(shape.set, shape.set)}".casefold()
    return all(word in text for word in words.casefold().split())


def _refresh_active(app: App, rig: Rig) -> None:
    """List the active shapes first; while the pointer is on the list nothing moves away under it."""
    names = tuple(name for name in rig.names if app.pose.weights.get(name, 0.0) != 0.0)
    on_list = imgui.is_window_hovered(imgui.HoveredFlags_.allow_when_blocked_by_active_item)
    held = imgui.is_any_item_active()
    if (not on_list and not held) or app.shapes.search != app.shapes.listed_search:
        app.shapes.active, app.shapes.listed_search = names, app.shapes.search


def _lines(app: App, rig: Rig) -> list[_Line]:
    words, shut = app.shapes.search, app.settings.shut_sections
    sections: dict[str, list[Shape]] = {}
    by_name = {shape.name: shape for shape in rig.controls}
    active = [by_name[name] for name in app.shapes.active if name in by_name and found(by_name[name], words)]
    if active:
        sections[ACTIVE] = active
    for shape in rig.controls:
        if found(shape, words):
            sections.setdefault(shape.set, []).append(shape)
    lines: list[_Line] = []
    for section, shapes in sections.items():
        title = "Active" if section == ACTIVE else SET_TITLES.get(section, plain_label(section))
        lines.append(_Line(section, f"{title}  {len(shapes)}"))
        if section not in shut or words:
            widest = widest_of(shape.label for shape in shapes)
            lines.extend(_Line(section, shape=shape, widest=widest) for shape in shapes)
    return lines


def _list(app: App, lines: list[_Line]) -> None:
    if not lines:
        imgui.spacing()
        imgui.text_disabled(
            cut(f"No shape has “{app.shapes.search}” in its name.", imgui.get_content_region_avail().x)
        )
        return
    # All lines are equally high, so only those in sight are drawn: hundreds of shapes cost what a dozen do.
    clipper = imgui.ListClipper()
    clipper.begin(len(lines), imgui.get_frame_height() + imgui.get_style().item_spacing.y)
    while clipper.step():
        for place in range(clipper.display_start, clipper.display_end):
            line = lines[place]
            imgui.push_id(f"{line.section}/{line.shape.name if line.shape else ''}")
            if line.shape is None:
                _section(app, line)
            else:
                shape_row(app, line.shape, f"{line.section}/{line.shape.name}", line.widest)
            imgui.pop_id()


def _section(app: App, line: _Line) -> None:
    shut = app.settings.shut_sections
    c, place, width = colours(app), imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    height, scale = imgui.get_frame_height(), unit()
    pressed = imgui.invisible_button("section", ImVec2(width, height))
    paint = imgui.get_window_draw_list()
    if imgui.is_item_hovered():
        paint.add_rect_filled(place, (place.x + width, place.y + height), packed(c.field), 5 * scale)
    tooltip(SET_TIPS.get(line.section, ""))
    _arrow(
        paint,
        place.x + 8 * scale,
        place.y + height / 2,
        4 * scale,
        packed(c.dim),
        down=line.section not in shut,
    )
    text_y = place.y + (height - imgui.get_font_size()) / 2
    paint.add_text((place.x + 20 * scale, text_y), packed(c.dim), cut(line.title, width - 20 * scale))
    if pressed:
        app.settings.shut_sections = (
            [s for s in shut if s != line.section] if line.section in shut else [*shut, line.section]
        )


def _arrow(paint: imgui.ImDrawList, x: float, y: float, size: float, ink: int, *, down: bool) -> None:
    if down:
        paint.add_triangle_filled(
            (x - size, y - size * 0.5), (x + size, y - size * 0.5), (x, y + size * 0.7), ink
        )
    else:
        paint.add_triangle_filled(
            (x - size * 0.5, y - size), (x + size * 0.7, y), (x - size * 0.5, y + size), ink
        )


def shape_row(app: App, shape: Shape, key: str, widest: float) -> None:
    """A shape with the slider for what it adds to the face; `widest` as `Row` has it."""
    weight = app.pose.weights.get(shape.name, 0.0)
    new = weight_row(app, Row(key, shape.label, weight, shape.name, lights={shape.name: 1.0}, widest=widest))
    if new != weight:
        actions.set_weight(app, shape.name, new)
