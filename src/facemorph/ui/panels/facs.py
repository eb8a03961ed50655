"""The FACS page: a slider a unit, balance between the sides, prototypes, units as text; ARKit's set too."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.core.facs import PROTOTYPES, TABLE_2_1, Sides, prototype, units_text
from facemorph.core.rig import Rig, plain_label
from facemorph.ui import actions, fonts, gaze, units
from facemorph.ui.panels import gaze_pad
from facemorph.ui.panels.rows import Head, Row, divider, head, method_head, quiet_words, weight_row, widest_of
from facemorph.ui.panels.shapes import shape_row
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import (
    colours,
    columns_of,
    icon_button,
    row_label,
    slim_slider,
    tab_chips,
    tooltip,
    typed_number,
    unit,
)
from facemorph.ui.words import label_of

SETS = (
    ("FACS", "Action units of the Facial Action Coding System (table 2.1 and others)"),
    ("ARKit", "The 52 shapes that face capture on a phone gives; the same sliders as in Shapes"),
)
ARKIT = "arkit"


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.controls.on("facs") and bool(app.controls.facs)


def draw(app: App) -> None:
    """The page's contents."""
    arkit = app.pages.set == "ARKit"
    _arkit_head(app) if arkit else _facs_head(app)
    app.pages.set = tab_chips(app, SETS, app.pages.set)
    if app.rig is None:
        quiet_words("No face is open.")
    elif arkit:
        _arkit(app, app.rig)
    elif not units.available(app):
        quiet_words("This face has no FACS units. The built-in faces have them: File > Built-in faces.")
    else:
        _units(app, app.rig)


def _facs_head(app: App) -> None:
    method_head(
        app,
        "facs",
        "FACS",
        usable=units.has_units(app),
        at_rest=not app.controls.facs,
        reset=units.reset_units,
        tip="Every unit at rest; the other pages stay",
    )


def _arkit_head(app: App) -> None:
    names = _arkit_weights(app)
    line = Head(
        "ARKit",
        app.shapes_on,
        app.rig is not None and bool(app.rig.shapes_in(ARKIT)),
        bool(names),
        "Take what Shapes and ARKit add out of the face, and put it back",
        "Takes out the ARKit shapes; the others stay",
        wide=True,
    )
    toggled, cleared = head(app, line)
    if toggled:
        actions.toggle_shapes(app)
    if cleared:
        for name in names:
            actions.set_weight(app, name, 0.0)


def _arkit_weights(app: App) -> list[str]:
    shapes = app.rig.shapes_in(ARKIT) if app.rig else ()
    return [shape.name for shape in shapes if shape.name in app.pose.weights]


def _arkit(app: App, rig: Rig) -> None:
    shapes = rig.shapes_in(ARKIT)
    if not shapes:
        quiet_words("This face has no ARKit shapes. The built-in faces have them: File > Built-in faces.")
        return
    imgui.begin_child("arkit", ImVec2(0, 0))
    widest = widest_of(shape.label for shape in shapes)
    for shape in shapes:
        shape_row(app, shape, shape.name, widest)
    imgui.end_child()


def _units(app: App, rig: Rig) -> None:
    _prototypes(app)
    _text(app)
    imgui.begin_child("units", ImVec2(0, 0))
    numbers = units.available(app)
    widest = widest_of(label_of(rig, f"AU{number}") for number in numbers)
    first_other = next((n for n in numbers if n not in TABLE_2_1), None)
    for number in numbers:
        if number == first_other and number != numbers[0]:
            divider(app, "Other units")
        if number == gaze.LEFT and gaze.available(app):
            divider(app, "Gaze")
            gaze_pad.draw(app)
        _unit(app, rig, number, widest)
    imgui.end_child()


def _prototypes(app: App) -> None:
    gap = 5 * unit()
    columns, width = columns_of([plain_label(emotion) for emotion in PROTOTYPES], gap, most=3)
    for place, emotion in enumerate(PROTOTYPES):
        if place % columns:
            imgui.same_line(0, gap)
        meant = prototype(emotion, units.available(app))
        lit = bool(meant) and app.controls.facs == meant
        c = colours(app)
        imgui.push_style_color(imgui.Col_.button, c.accent if lit else c.field)
        imgui.push_style_color(imgui.Col_.button_hovered, c.accent_bright if lit else c.field_hovered)
        imgui.push_style_color(imgui.Col_.text, c.on_accent if lit else c.text)
        imgui.begin_disabled(not meant)
        if imgui.button(plain_label(emotion), ImVec2(width, 0)):
            units.set_prototype(app, emotion)
        imgui.end_disabled()
        imgui.pop_style_color(3)
        tooltip(f"{units_text(meant)} (2.1.2)" if meant else "This face has none of its units")


def _text(app: App) -> None:
    """The units as text: it can be typed over, copied and pasted."""
    side, gap = imgui.get_frame_height(), 4 * unit()
    imgui.set_next_item_width(imgui.get_content_region_avail().x - 2 * (side + gap))
    shown = units_text(app.controls.facs)
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    entered, text = imgui.input_text_with_hint("##units", "Units, such as AU1+4+15", shown, flags)
    if not imgui.is_item_active():
        tooltip(
            "This page's units as FACS writes them; type and press Enter. 12 is the whole unit, 12C or "
            "12(0.6) a part of it, L12 and R12 one side of the face."
        )
    if entered and text.strip() != shown:
        units.set_text(app, text)
    imgui.same_line(0, gap)
    if icon_button(app, fonts.COPY, "copy", ""):
        units.copy_units(app)
    if imgui.is_item_hovered():
        tooltip(units.copy_help(app))
    imgui.same_line(0, gap)
    if icon_button(
        app,
        fonts.PASTE,
        "paste",
        "Paste units onto this page, in place of those that it has",
    ):
        units.paste_units(app)


def _unit(app: App, rig: Rig, number: int, widest: float) -> None:
    sides = app.controls.facs.get(number, Sides.both(0.0))
    weight, balance = units.split(sides)
    balance = balance if weight else app.pages.balances.get(number, 0.0)
    name, gap, button = f"AU{number}", 2 * unit(), 30 * unit()
    label = label_of(rig, name)
    row = Row(name, label, weight, f"{name}, {label.lower()}", str(number), {name: 1.0}, button + gap, widest)
    new = weight_row(app, row)
    imgui.same_line(0, gap)
    if _sides_button(app, number, button, uneven=balance != 0.0):
        app.pages.unit_open = 0 if app.pages.unit_open == number else number
    new_balance = _balance(app, number, balance) if app.pages.unit_open == number else balance
    if (new, new_balance) != (weight, balance):
        app.pages.balances[number] = new_balance
        units.set_unit(app, number, units.joined(new, new_balance))


def _sides_button(app: App, number: int, width: float, *, uneven: bool) -> bool:
    c, place, height = colours(app), imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    pressed = imgui.invisible_button(f"sides {number}", ImVec2(width, height))
    lit = app.pages.unit_open == number
    paint = imgui.get_window_draw_list()
    if imgui.is_item_hovered() or lit:
        ground = packed(c.field_hovered if imgui.is_item_hovered() else c.field)
        paint.add_rect_filled(place, (place.x + width, place.y + height), ground, 5 * unit())
    size = imgui.calc_text_size("R|L")
    ink = c.accent if uneven else c.text if lit else c.dim
    paint.add_text((place.x + (width - size.x) / 2, place.y + (height - size.y) / 2), packed(ink), "R|L")
    tooltip("Balance between the two sides of the face")
    return bool(pressed)


_BALANCE_TIP = (
    "R and L are the person's own right and left, as you see them from the front.\n"
    "In the middle both sides move alike; at an end one side moves alone. "
    "The border at the midline is smooth."
)


def _balance(app: App, number: int, balance: float) -> float:
    """The slider between the sides, under the unit it belongs to."""
    scale, room = unit(), imgui.get_content_region_avail().x
    key, end = f"balance {number}", 16 * scale
    imgui.indent(32 * scale)
    row_label(app, "Balance", 74 * scale, _BALANCE_TIP, bright=False)
    imgui.same_line(0, 0)
    row_label(app, "R", end, _BALANCE_TIP, bright=balance < 0.0)
    imgui.same_line(0, 0)
    low, high = min(-1.0, balance), max(1.0, balance)
    new = slim_slider(app, key, balance, low, high, room - (74 + 32 + 48 + 36) * scale - 2 * end)
    imgui.same_line(0, 6 * scale)
    row_label(app, "L", end - 6 * scale, _BALANCE_TIP, bright=balance > 0.0)
    imgui.same_line(0, 0)
    new = typed_number(app, key, new, low, high, 48 * scale)
    imgui.unindent(32 * scale)
    return 0.0 if abs(new) < 0.02 else new
