"""The Regions page: Parke's parametric face, a way, turn, size and shift for each region; the brush."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from facemorph.core.morph import CURVES, checked_curve
from facemorph.core.pose import state_of
from facemorph.core.rig import Rig, plain_label
from facemorph.deform.regions import RegionControl
from facemorph.ui import actions, regions
from facemorph.ui.panels.rows import method_head, quiet_words
from facemorph.ui.panels.value_rows import (
    Value,
    button_row,
    choice,
    choice_row,
    expression_words,
    switch_row,
    unit_words,
    value_row,
)
from facemorph.ui.regions_tool import BrushTool, PivotMark
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, cut, slim_slider, tab_chips, tooltip, typed_number, unit

_T_TIP = "t of this region alone: P = (1 - t) source + t target (2.5), weighted by the region's soft border"
_FROM_TIP = "Where the region starts: what it adds at t = 0"
_TO_TIP = "Where the region goes: what it adds at t = 1"
_MIXTURE = "Mixture"
_WAY_IN_A_LINE = 210.0


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.controls.on("regions") and not regions.at_rest(app)


def draw(app: App) -> None:
    """The page's contents."""
    method_head(
        app,
        "regions",
        "Regions",
        usable=app.rig is not None,
        at_rest=not app.controls.regions,
        reset=regions.reset,
        tip="Every region at rest; what was painted stays",
    )
    if app.rig is None:
        quiet_words("No face is open.")
        return
    imgui.begin_child("regions page", ImVec2(0, 0))
    _brush(app, app.rig)
    if regions.region_set(app) is None:
        quiet_words("This face has no regions yet: switch the brush on and paint some on it.")
    elif not app.lab.regions.painting:
        _all(app, app.rig)
        for name in regions.names(app):
            imgui.push_id(name)
            _region(app, app.rig, name)
            imgui.pop_id()
    imgui.end_child()


def _all(app: App, rig: Rig) -> None:
    """One row for every region at once; its slider stands at their mean."""
    names = regions.names(app)
    present = {name: regions.control(app, rig, name) for name in names}
    mean = sum(kept.t for kept in present.values()) / max(len(names), 1)
    t = _t_row(app, "All", mean, "Sets every region's t: with all alike this is the global morph (2.5)")
    ways = [_way_of(kept) for kept in present.values()]
    shared = tuple(ways[0][i] if len({way[i] for way in ways}) == 1 else "" for i in range(3))
    chosen = _way_row(app, rig, "All", shared)
    if t == mean and chosen == shared:
        return
    changed = {}
    for name, kept in present.items():
        own = _way_of(kept)
        way = tuple(own[i] if chosen[i] == shared[i] else chosen[i] for i in range(3))
        changed[name] = replace(_on_way(kept, way), t=t if t != mean else kept.t)
    regions.change(app, changed)


def _way_of(kept: RegionControl) -> tuple[str, ...]:
    """Source, target and curve by name; "" for a mixture."""
    return (regions.state_name(kept.source), regions.state_name(kept.target), kept.curve)


def _on_way(kept: RegionControl, way: tuple[str, ...]) -> RegionControl:
    """The region from, to and with the curve of `way`; what is "" there stays."""
    source, target, curve = way
    return replace(
        kept,
        source=state_of(source) if source else kept.source,
        target=state_of(target) if target else kept.target,
        curve=checked_curve(curve) if curve else kept.curve,
    )


def _region(app: App, rig: Rig, name: str) -> None:
    page, kept = app.lab.regions, regions.control(app, rig, name)
    top, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    new = replace(kept, t=_t_row(app, name, kept.t, _T_TIP, opens=True))
    new = _on_way(new, _way_row(app, rig, name, _way_of(new)))
    low = imgui.get_cursor_screen_pos().y
    if page.opened == name:
        new = _rigid_rows(app, rig, name, new)
    over = imgui.is_mouse_hovering_rect(top, ImVec2(top.x + room, low)) and imgui.is_window_hovered()
    if over and not imgui.is_any_item_active() and not page.painting:
        app.on_face.glow = regions.light(app, name)
    if new != kept:
        regions.change(app, {name: new})


def _t_row(app: App, name: str, t: float, tip: str, *, opens: bool = False) -> float:
    """Name, slider, number; a click on the name opens the region."""
    page, scale, room = app.lab.regions, unit(), imgui.get_content_region_avail().x
    label, number = min(92 * scale, max(room * 0.4, 68 * scale)), 48 * scale
    place, height, c = imgui.get_cursor_screen_pos(), imgui.get_frame_height(), colours(app)
    pressed = imgui.invisible_button(f"{name} name", ImVec2(label, height))
    tooltip(f"{tip}\nClick for turn, size and shift" if opens else tip)
    paint = imgui.get_window_draw_list()
    text_y = place.y + (height - imgui.get_font_size()) / 2
    indent = 0.0
    if opens:
        indent = 18 * scale
        mark = "–" if page.opened == name else "+"
        paint.add_text((place.x + 3 * scale, text_y), packed(c.dim), mark)
        if imgui.is_item_hovered():
            corner = (place.x + label, place.y + height)
            paint.add_rect_filled(place, corner, packed(c.field), 5 * scale)
        if pressed:
            page.opened = "" if page.opened == name else name
    ink = c.text if t or not opens else c.dim
    paint.add_text((place.x + indent, text_y), packed(ink), cut(plain_label(name), label - indent))
    imgui.same_line(0, 0)
    new = slim_slider(app, f"region {name}", t, 0.0, 1.0, room - label - number)
    imgui.same_line(0, 0)
    return typed_number(app, f"region {name}", new, 0.0, 1.0, number)


def _way_row(app: App, rig: Rig, name: str, way: tuple[str, ...]) -> tuple[str, ...]:
    """From, to and curve in a line, or each in its own where there is little room; gives what they leave."""
    gap, indent, words = 4 * unit(), 18 * unit(), expression_words(rig)
    curves: dict[str, str] = {curve: curve.capitalize() for curve in CURVES}
    imgui.indent(indent)
    room = imgui.get_content_region_avail().x - 2 * gap
    narrow, chosen = room < _WAY_IN_A_LINE * unit(), []
    for place, (key, choices, tip, share) in enumerate(
        (
            ("from", words, _FROM_TIP, 0.36),
            ("to", words, _TO_TIP, 0.36),
            ("curve", curves, "How t eases: linear (2.5) or cosine (2.1)", 0.28),
        )
    ):
        if place and not narrow:
            imgui.same_line(0, gap)
        shown = choices if way[place] else {**choices, "": _MIXTURE}
        chosen.append(choice(app, f"{name} {key}", way[place], shown, tip, 0.0 if narrow else room * share))
    imgui.unindent(indent)
    return tuple(chosen)


def _rigid_rows(app: App, rig: Rig, name: str, kept: RegionControl) -> RegionControl:
    """Turn, size and shift about the region's pivot, which the face shows."""
    if not app.lab.regions.painting:
        app.on_face.tool = PivotMark()
    far = max(round(rig.neutral.diagonal / 20.0, 1), 1e-3)
    indent = 18 * unit()
    imgui.indent(indent)
    turn = [
        value_row(
            app, Value(f"{name} turn {axis}", f"Turn {axis}, °", value, -45.0, 45.0, _TURN_TIP, decimals=1)
        )
        for axis, value in zip("xyz", kept.turn_deg, strict=True)
    ]
    size = value_row(app, Value(f"{name} size", "Size", kept.size, 0.5, 1.5, "Scale about the pivot", 1.0))
    shift = [
        value_row(
            app,
            Value(f"{name} shift {axis}", f"Shift {axis}, {unit_words(rig)}", value, -far, far, _SHIFT_TIP),
        )
        for axis, value in zip("xyz", kept.shift, strict=True)
    ]
    present = regions.region_set(app)
    if present is not None:
        pivot = present.middle(name) if kept.pivot is None else kept.pivot
        quiet_words("Pivot " + ", ".join(f"{value:.1f}" for value in pivot) + f" {unit_words(rig)}")
    if button_row(app, (("Reset region", "This region at rest", name in app.controls.regions),)):
        regions.reset_one(app, name)
        kept = regions.control(app, rig, name)
        imgui.unindent(indent)
        return kept
    imgui.unindent(indent)
    return replace(
        kept, turn_deg=(turn[0], turn[1], turn[2]), size=size, shift=(shift[0], shift[1], shift[2])
    )


_TURN_TIP = "Turns the region about its pivot, x first, then y, then z (Parke 1974)"
_SHIFT_TIP = "Moves the region (Parke 1974)"
_SIDES = (
    ("Add", "The brush gives the face to the region; the others make room"),
    ("Remove", "The brush takes the face out of the region"),
)


def _brush(app: App, rig: Rig) -> None:
    page = app.lab.regions
    if app.drag != "tool":
        page.stroke = None  # of a brush that was down when the page was left
    tip = "Paint with the left button on the face; beside it the mouse still turns the face"
    page.painting = switch_row(app, "Paint on the face", page.painting, tip)
    names = regions.names(app)
    page.region = page.region if page.region in names else names[0]
    if page.radius <= 0.0:
        page.radius = round(rig.neutral.diagonal / 25.0, 2) or 1.0
    if page.painting:
        words = {name: plain_label(name) for name in names}
        page.region = choice_row(
            app, "painted region", "Region", page.region, words, "Which region is painted"
        )
        page.takes = tab_chips(app, _SIDES, "Remove" if page.takes else "Add") == "Remove"
        largest, usual = round(rig.neutral.diagonal / 8.0, 1) or 1.0, round(rig.neutral.diagonal / 25.0, 2)
        row = Value("radius", f"Radius, {unit_words(rig)}", page.radius, largest / 50, largest, "", usual)
        page.radius = value_row(app, row)
        row = Value("strength", "Strength", page.strength, 0.05, 1.0, "How much one touch gives", 0.5)
        page.strength = value_row(app, row)
        page.mirror = switch_row(
            app, "Mirror brush", page.mirror, "Paints the other side of the face as well"
        )
        app.on_face.tool = BrushTool()
        app.on_face.glow = regions.light(app, page.region)
    _files(app, rig)


def _files(app: App, rig: Rig) -> None:
    own = "The face's own regions again" if rig.regions is not None else "No regions again, as the face came"
    pressed = button_row(
        app,
        (
            ("Unpaint", own, app.painted is not None),
            ("Open…", "Open regions kept in a file", True),
            ("Save…", "Keep the regions in a file", regions.region_set(app) is not None),
        ),
    )
    if pressed == "Unpaint":
        regions.use(app, None)
    elif pressed:
        actions.ask_for(app, "open regions" if pressed == "Open…" else "save regions")
