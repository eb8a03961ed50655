"""What the pages of all methods are made of: the head with its switch and reset, and rows with sliders."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from heapq import nlargest

from imgui_bundle import ImVec2, imgui

from facemorph.ui import actions
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import (
    chip_width,
    colours,
    icon_button,
    right_edge,
    row_label,
    slim_slider,
    switch,
    tooltip,
    typed_number,
    unit,
)

WIDE_RANGE, USUAL_RANGE = (-1.0, 2.0), (0.0, 1.0)
WIDE_TIP = (
    "Let weights go below 0 and above 1: exaggerates a shape or runs it backwards; "
    "the face may fold through itself"
)
_NUMBER, _TAG, _LEAST_SLIDER, _USUAL_SLIDER = 46.0, 26.0, 32.0, 76.0


@dataclass(frozen=True)
class Head:
    """The first line of a page. `usable` is false where the face has nothing for it."""

    title: str
    on: bool
    usable: bool
    resettable: bool
    switch_tip: str
    reset_tip: str
    reset: str = "Reset"
    wide: bool = False  # offers weights below 0 and above 1


def head(app: App, line: Head) -> tuple[bool, bool]:
    """Draw it; gives whether the switch and whether the reset were pressed."""
    imgui.align_text_to_frame_padding()
    imgui.text(line.title)
    imgui.begin_disabled(not line.usable)
    right = right_edge()
    imgui.same_line()
    on = switch(app, f"{line.title} on", line.on)
    tooltip(line.switch_tip)
    square = imgui.get_frame_height() + 6 * unit() if line.wide else 0.0
    # Where there is little room, the first word says it too.
    imgui.same_line()
    whole = imgui.get_content_region_avail().x >= chip_width(line.reset) + square
    words = line.reset if whole else line.reset.split()[0]
    width = chip_width(words)
    if line.wide and imgui.get_content_region_avail().x >= width + square:
        imgui.same_line(right - width - square)
        if icon_button(app, "±", "wide", WIDE_TIP, lit=app.settings.wide_weights):
            actions.toggle_wide(app)
    imgui.same_line(right - width)
    imgui.begin_disabled(not line.resettable)
    reset = bool(imgui.button(words))
    tooltip(line.reset_tip)
    imgui.end_disabled()
    imgui.end_disabled()
    return on != line.on, reset


def method_head(
    app: App, method: str, title: str, *, usable: bool, at_rest: bool, reset: Callable[[App], None], tip: str
) -> None:
    """The head of a method's page: its switch takes it out of the sum, its reset clears it alone."""
    what = f"Take {title} out of the face, and put it back"
    line = Head(title, app.controls.on(method), usable, not at_rest, what, tip)
    toggled, cleared = head(app, line)
    if toggled:
        actions.toggle_method(app, method)
    if cleared:
        reset(app)


def quiet_words(text: str) -> None:
    """A few dim words, in as many lines as they need."""
    imgui.spacing()
    imgui.push_text_wrap_pos(0.0)
    imgui.text_disabled(text)
    imgui.pop_text_wrap_pos()


@dataclass(frozen=True)
class Row:
    """A weight with its name: `tag` stands before the name, `lights` is what the face shows when hovered."""

    key: str
    label: str
    weight: float
    tip: str = ""
    tag: str = ""
    lights: Mapping[str, float] = field(default_factory=dict)
    spare: float = 0.0  # room to leave at the right end
    widest: float = 0.0  # of the list's labels, so that none is cut where there is room for all


def weight_row(app: App, row: Row) -> float:
    """A row that sets a weight: drag, double-click to type, right-click to reset. Gives the weight."""
    scale, weight = unit(), row.weight
    low, high = WIDE_RANGE if app.settings.wide_weights else USUAL_RANGE
    low, high = min(low, weight), max(high, weight)
    room = imgui.get_content_region_avail().x - row.spare
    place = imgui.get_cursor_screen_pos()
    number, tag = _NUMBER * scale, _TAG * scale if row.tag else 0.0
    label = _label_width(row, room - number - tag)
    if row.tag and room - number - tag - label < _LEAST_SLIDER * scale:
        # The tag and the tooltip name it still.
        label = 6 * scale
    imgui.indent(6 * scale)
    if row.tag:
        row_label(app, row.tag, tag, row.tip, bright=False)
        imgui.same_line(0, 0)
    tip = f"{row.tip}\nDrag, double-click to type, right-click to reset"
    row_label(app, row.label if label > 6 * scale else "", label - 6 * scale, tip, bright=weight != 0.0)
    reset = imgui.is_item_clicked(1)
    imgui.same_line(0, 4 * scale)
    new = slim_slider(app, row.key, weight, low, high, room - tag - label - number - 6 * scale)
    held = imgui.is_item_active()
    imgui.same_line(0, 0)
    new = typed_number(app, row.key, new, low, high, number)
    imgui.unindent(6 * scale)
    if not held and pointed_at(place, room):
        app.methods.hovered = row.lights
    return 0.0 if reset else new


def _label_width(row: Row, room: float) -> float:
    """What of the room before the number the label takes: a usual part, or more where labels are long."""
    scale = unit()
    usual = max(room * (0.6 if row.tag else 0.5), 60 * scale)
    return max(usual, min(row.widest + 10 * scale, room - _USUAL_SLIDER * scale))


def widest_of(labels: Iterable[str]) -> float:
    """How wide the widest of a list's labels is."""
    # The widest is among those with the most letters: measuring hundreds would take longer than drawing them.
    return max((imgui.calc_text_size(label).x for label in nlargest(8, labels, key=len)), default=0.0)


def pointed_at(place: ImVec2, width: float) -> bool:
    """Whether the pointer is on a row that begins at `place`, and nothing is held."""
    height = imgui.get_frame_height()
    inside = imgui.is_mouse_hovering_rect(place, ImVec2(place.x + width, place.y + height))
    return inside and imgui.is_window_hovered() and not imgui.is_any_item_active()


def divider(app: App, text: str) -> None:
    """A quiet line with a word on it, as high as a row."""
    c, place, width = colours(app), imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    height = imgui.get_frame_height()
    imgui.dummy(ImVec2(width, height))
    paint, size = imgui.get_window_draw_list(), imgui.calc_text_size(text)
    x, middle = place.x + 6 * unit(), place.y + height / 2
    paint.add_text((x, middle - size.y / 2), packed(c.dim), text)
    start = (x + size.x + 10 * unit(), middle)
    paint.add_line(start, (place.x + width, middle), packed(c.line), unit())
