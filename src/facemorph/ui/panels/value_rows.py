"""Rows of a page that set a number with a unit, a choice out of a list, or yes and no."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from imgui_bundle import imgui

from facemorph.core.pose import NEUTRAL
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.ui.state import App
from facemorph.ui.widgets import (
    columns_of,
    right_edge,
    row_label,
    slim_slider,
    switch,
    tooltip,
    typed_number,
    unit,
)
from facemorph.ui.words import NEUTRAL_LABEL

_LABEL, _NUMBER = 0.34, 54.0


@dataclass(frozen=True)
class Value:
    """A number between `low` and `high`; `rest` is where a right-click puts it."""

    key: str
    label: str
    value: float
    low: float
    high: float
    tip: str = ""
    rest: float = 0.0
    decimals: int = 2


def value_row(app: App, row: Value) -> float:
    """Draw it; gives the number that it leaves."""
    scale, room = unit(), imgui.get_content_region_avail().x
    low, high = min(row.low, row.value), max(row.high, row.value)
    label, number = max(room * _LABEL, 60 * scale), _NUMBER * scale
    row_label(app, row.label, label, row.tip, bright=row.value != row.rest)
    imgui.same_line(0, 0)
    new = slim_slider(app, row.key, row.value, low, high, room - label - number, rest=row.rest)
    imgui.same_line(0, 0)
    return typed_number(app, row.key, new, row.low, row.high, number, row.decimals)


def switch_row(app: App, label: str, value: bool, tip: str) -> bool:
    """A word with a switch at the right end."""
    wide = imgui.get_frame_height() * 1.1
    row_label(app, label, imgui.get_content_region_avail().x - wide - 8 * unit(), tip)
    imgui.same_line(right_edge() - wide)
    new = switch(app, label, value)
    tooltip(tip)
    return new


def choice(app: App, key: str, chosen: str, choices: Mapping[str, str], tip: str, width: float = 0.0) -> str:
    """A list to choose one of: name -> words. Gives the chosen name."""
    width = width or imgui.get_content_region_avail().x
    imgui.set_next_item_width(width)
    # Where there is little room the words need it more than the arrow.
    narrow = imgui.ComboFlags_.no_arrow_button if width < 84 * unit() else 0
    flags = imgui.ComboFlags_.height_large | narrow
    opened = imgui.begin_combo(f"##{key}", choices.get(chosen, chosen), flags)
    if not opened:
        tooltip(tip)
        return chosen
    for name, words in choices.items():
        if imgui.selectable(words, name == chosen)[0]:
            chosen = name
    imgui.end_combo()
    return chosen


def choice_row(app: App, key: str, label: str, chosen: str, choices: Mapping[str, str], tip: str) -> str:
    """A list with a word before it."""
    room = imgui.get_content_region_avail().x * _LABEL
    row_label(app, label, room, tip)
    imgui.same_line(0, 0)
    return choice(app, key, chosen, choices, tip)


def expression_words(rig: Rig) -> dict[str, str]:
    """The face's expressions by name, neutral first."""
    return {NEUTRAL: NEUTRAL_LABEL, **{shape.name: shape.label for shape in rig.shapes_in(EXPRESSION)}}


def unit_words(rig: Rig) -> str:
    """The unit that the face's lengths are in."""
    return rig.info.unit or "model units"


def button_row(app: App, buttons: tuple[tuple[str, str, bool], ...]) -> str:
    """Buttons of equal width: words, tooltip, whether they can be pressed. Gives the one that was.

    Where the words have too little room, they stand in more rows.
    """
    gap, pressed = 5 * unit(), ""
    columns, width = columns_of([words for words, _, _ in buttons], gap)
    for place, (words, tip, usable) in enumerate(buttons):
        if place % columns:
            imgui.same_line(0, gap)
        imgui.begin_disabled(not usable)
        if imgui.button(words, (width, 0)):
            pressed = words
        imgui.end_disabled()
        tooltip(tip)
    return pressed
