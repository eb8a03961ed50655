"""The few widgets that ImGui lacks: a slim slider, a switch, a row's label cut to its room, a chip."""

from __future__ import annotations

import math
from collections.abc import Sequence

from imgui_bundle import ImVec2, imgui

from facemorph.ui.state import App
from facemorph.ui.theme import FONT_PIXELS, THEMES, Colours, faded, packed

_SHORT_WORD = 6
_CONFIRM = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all


def colours(app: App) -> Colours:
    """The present theme's colours."""
    return THEMES[app.settings.theme]


def unit() -> float:
    """One pixel at scale 1, in the interface's units."""
    return imgui.get_font_size() / FONT_PIXELS


def right_edge() -> float:
    """Where the line that the cursor stands on ends, as `same_line` takes it."""
    return float(imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x)


def slim_slider(
    app: App, name: str, value: float, low: float, high: float, width: float, *, rest: float = 0.0
) -> float:
    """A slider from `low` to `high`, `width` wide; gives the value it leaves.

    A drag moves it, a right-click puts it to `rest`, a double-click opens the number beside it for
    typing (`app.typing` is then `name`).
    """
    place, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    inset = height * 0.36
    both = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
    imgui.invisible_button(name, ImVec2(max(width, 1.0), height), both)
    left, right = place.x + inset, place.x + width - inset
    if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0):
        app.type_into(name)
    elif imgui.is_item_active() and imgui.is_mouse_down(0) and _moved_or_pressed():
        along = (imgui.get_mouse_pos().x - left) / max(right - left, 1.0)
        value = low + min(max(along, 0.0), 1.0) * (high - low)
    if imgui.is_item_clicked(1):
        value = rest
    _paint_slider(colours(app), place, width, (value - low) / (high - low), (rest - low) / (high - low))
    return value


def _moved_or_pressed() -> bool:
    # The second press of a double-click must not move the knob under the pointer once more.
    return imgui.is_mouse_clicked(0) or imgui.is_mouse_dragging(0, 1.0)


def _paint_slider(c: Colours, place: ImVec2, width: float, at: float, rest: float) -> None:
    paint, height = imgui.get_window_draw_list(), imgui.get_frame_height()
    inset, thick, middle = height * 0.36, max(height * 0.14, 2.0), place.y + height / 2.0
    left, right = place.x + inset, place.x + width - inset
    knob_x = left + (right - left) * min(max(at, 0.0), 1.0)
    rest_x = left + (right - left) * min(max(rest, 0.0), 1.0)
    live = imgui.is_item_active() or imgui.is_item_hovered()
    round_ends = thick / 2.0
    paint.add_rect_filled(
        (left, middle - thick / 2), (right, middle + thick / 2), packed(c.track), round_ends
    )
    start, end = sorted((rest_x, knob_x))
    if end - start > 0.5:
        paint.add_rect_filled(
            (start, middle - thick / 2), (end, middle + thick / 2), packed(c.accent), round_ends
        )
    moved = abs(knob_x - rest_x) > 0.5
    radius = height * (0.30 if live else 0.26)
    fill = c.accent_bright if imgui.is_item_active() else c.accent if moved else c.dim
    paint.add_circle_filled((knob_x, middle), radius, packed(fill))


def typed_number(
    app: App, name: str, value: float, low: float, high: float, width: float, decimals: int = 2
) -> float:
    """The number beside a slider: a click opens it for typing, Enter or leaving it takes it."""
    c = colours(app)
    if app.typing == name:
        return _number_field(app, name, value, low, high, width, decimals)
    place, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    if imgui.invisible_button(f"{name}##number", ImVec2(width, height)):
        app.type_into(name)
    paint = imgui.get_window_draw_list()
    text = f"{value:.{decimals}f}"
    if imgui.is_item_hovered():
        paint.add_rect_filled(place, (place.x + width, place.y + height), packed(c.field), 5 * unit())
        imgui.set_mouse_cursor(imgui.MouseCursor_.text_input)
        imgui.set_item_tooltip("Click to type a number")
    size = imgui.calc_text_size(text)
    ink = c.text if abs(value) > 0.0049 else c.dim
    right = place.x + width - 6 * unit()
    paint.add_text((right - size.x, place.y + (height - size.y) / 2), packed(ink), text)
    return value


def _number_field(
    app: App, name: str, value: float, low: float, high: float, width: float, decimals: int
) -> float:
    imgui.set_next_item_width(width)
    if app.typing_fresh:
        imgui.set_keyboard_focus_here()
    entered, text = imgui.input_text(f"##{name}typed", f"{value:.{decimals}f}", _CONFIRM)
    left = imgui.is_item_deactivated() and not app.typing_fresh
    edited = imgui.is_item_deactivated_after_edit()
    app.typing_fresh = app.typing_fresh and not imgui.is_item_active()
    if not (entered or left):
        return value
    app.typing = ""
    return _number(text, value, low, high) if entered or edited else value


def _number(text: str, fallback: float, low: float, high: float) -> float:
    try:
        number = float(text.replace(",", "."))
    except ValueError:
        return fallback
    return min(max(number, low), high) if number == number else fallback


def switch(app: App, name: str, on: bool) -> bool:
    """A sliding switch; gives its state."""
    c = colours(app)
    place, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    tall, wide = height * 0.62, height * 1.1
    if imgui.invisible_button(name, ImVec2(wide, height)):
        on = not on
    paint, top = imgui.get_window_draw_list(), place.y + (height - tall) / 2
    ground = c.accent if on else c.track
    paint.add_rect_filled((place.x, top), (place.x + wide, top + tall), packed(ground), tall / 2)
    knob_x = place.x + (wide - tall / 2 if on else tall / 2)
    paint.add_circle_filled((knob_x, top + tall / 2), tall * 0.36, packed(c.on_accent if on else c.text))
    return on


def cut(text: str, room: float) -> str:
    """`text`, with an ellipsis in it where it is wider than `room`.

    What tells names apart stays: a short last word ("right"), or the end of what is no plain words.
    """
    if imgui.calc_text_size(text).x <= room:
        return text
    low, high = 0, len(text)
    while low < high:
        middle = (low + high + 1) // 2
        if imgui.calc_text_size(_shortened(text, middle)).x <= room:
            low = middle
        else:
            high = middle - 1
    return _shortened(text, low)


def _shortened(text: str, letters: int) -> str:
    tail = _tail(text, letters)
    return f"{text[: letters - tail].rstrip()}…{text[len(text) - tail :].lstrip() if tail else ''}"


def _tail(text: str, letters: int) -> int:
    """How much of the end of `text` stays where `letters` of it do."""
    words = text.split()
    if len(words) < 2 or not all(word.strip(",").isalpha() for word in words):
        # A path, a file, a number: their ends tell them apart.
        return letters // 3
    last = len(words[-1])
    return last if last <= min(_SHORT_WORD, letters // 2) else 0


def row_label(app: App, text: str, width: float, tip: str = "", *, bright: bool = True) -> None:
    """A text in a row of widgets, cut to `width`; what was cut off stands in its tooltip."""
    c = colours(app)
    place, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    imgui.dummy(ImVec2(max(width, 1.0), height))
    shown = cut(text, width)
    tips = [part for part in (text if shown != text else "", tip) if part]
    if tips:
        tooltip("\n".join(tips))
    size = imgui.calc_text_size(shown)
    ink = packed(c.text if bright else c.dim)
    imgui.get_window_draw_list().add_text((place.x, place.y + (height - size.y) / 2), ink, shown)


def tooltip(text: str) -> None:
    """A tooltip of the last item, in lines of readable length."""
    if text and imgui.begin_item_tooltip():
        imgui.push_text_wrap_pos(imgui.get_font_size() * 24)
        imgui.text_unformatted(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def icon_button(app: App, icon: str, name: str, tip: str, *, lit: bool = False) -> bool:
    """A square button with a symbol; `lit` shows that it is on."""
    c, side = colours(app), imgui.get_frame_height()
    place = imgui.get_cursor_screen_pos()
    pressed = imgui.invisible_button(name, ImVec2(side, side))
    paint = imgui.get_window_draw_list()
    if imgui.is_item_hovered() or lit:
        ground = faded(c.accent, 0.28) if lit else c.field_hovered
        paint.add_rect_filled(place, (place.x + side, place.y + side), packed(ground), 5 * unit())
    size = imgui.calc_text_size(icon)
    ink = packed(c.accent if lit else c.text)
    paint.add_text((place.x + (side - size.x) / 2, place.y + (side - size.y) / 2), ink, icon)
    tooltip(tip)
    return bool(pressed)


def chip(app: App, text: str, tip: str, *, lit: bool = False) -> bool:
    """A small button over the face; `lit` shows that it is chosen."""
    c = colours(app)
    if lit:
        imgui.push_style_color(imgui.Col_.button, c.accent)
        imgui.push_style_color(imgui.Col_.button_hovered, c.accent_bright)
        imgui.push_style_color(imgui.Col_.text, c.on_accent)
    else:
        imgui.push_style_color(imgui.Col_.button, faded(c.panel, 0.78))
        imgui.push_style_color(imgui.Col_.button_hovered, c.field_hovered)
        imgui.push_style_color(imgui.Col_.text, c.text)
    pressed = imgui.button(text)
    imgui.pop_style_color(3)
    tooltip(tip)
    return bool(pressed)


def chip_width(text: str) -> float:
    """How wide `chip` draws a text."""
    return float(imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x)


def columns_of(words: Sequence[str], gap: float, most: int = 6) -> tuple[int, float]:
    """In how many columns of equal width buttons with these words fit, and how wide each of them is."""
    room = imgui.get_content_region_avail().x
    widest = max(chip_width(word) for word in words)
    fitting = min(max(int((room + gap) // (widest + gap)), 1), len(words), most)
    columns = math.ceil(len(words) / math.ceil(len(words) / fitting))
    return columns, (room - gap * (columns - 1)) / columns


def tab_chips(app: App, choices: tuple[tuple[str, str], ...], chosen: str) -> str:
    """A few words side by side of which one holds, each with its tooltip; gives the one that does.

    Where the words have too little room, they stand in more rows.
    """
    c, gap = colours(app), 2 * unit()
    columns, width = columns_of([word for word, _ in choices], gap)
    for place, (word, tip) in enumerate(choices):
        if place % columns:
            imgui.same_line(0, gap)
        lit = word == chosen
        imgui.push_style_color(imgui.Col_.button, c.field_hovered if lit else faded(c.field, 0.4))
        imgui.push_style_color(imgui.Col_.text, c.text if lit else c.dim)
        if imgui.button(f"{word}##choice", ImVec2(width, 0)):
            chosen = word
        imgui.pop_style_color(2)
        tooltip(tip)
    return chosen
