"""A side's tabs: equal cells in as many rows as they need, with a dot on pages that move the face."""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, imgui

from facemorph.ui.panels import Tab
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, cut, tooltip, unit

MOST_IN_ROW = 4
_LEAST_CELL = 74.0


def columns_for(count: int, room: float) -> int:
    """How many of `count` tabs stand in a row of `room` pixels at scale 1."""
    fitting = min(max(int(room // _LEAST_CELL), 1), MOST_IN_ROW)
    return math.ceil(count / math.ceil(count / fitting))


def chosen_tab(tabs: tuple[Tab, ...], title: str) -> Tab:
    """The tab called `title`, or the first."""
    return next((tab for tab in tabs if tab.title == title), tabs[0])


def tab_bar(app: App, tabs: tuple[Tab, ...], title: str) -> str:
    """Draw the tabs; gives the title of the chosen one."""
    room = imgui.get_content_region_avail().x
    columns = columns_for(len(tabs), room / unit())
    start = imgui.get_cursor_screen_pos()
    width, height = room / columns, imgui.get_frame_height() + 2 * unit()
    for place, tab in enumerate(tabs):
        row, column = divmod(place, columns)
        imgui.set_cursor_screen_pos(ImVec2(start.x + column * width, start.y + row * height))
        if _cell(app, tab, width, height, chosen=tab.title == title):
            title = tab.title
    low = start.y + math.ceil(len(tabs) / columns) * height
    line = packed(colours(app).line)
    imgui.get_window_draw_list().add_line((start.x, low), (start.x + room, low), line, unit())
    imgui.set_cursor_screen_pos(ImVec2(start.x, low + 5 * unit()))
    imgui.dummy(ImVec2(0, 0))
    return title


def _cell(app: App, tab: Tab, width: float, height: float, *, chosen: bool) -> bool:
    c, scale = colours(app), unit()
    place = imgui.get_cursor_screen_pos()
    pressed = imgui.invisible_button(f"tab {tab.title}", ImVec2(width, height))
    moves, hovered = tab.moves_face(app), imgui.is_item_hovered()
    tooltip(f"{tab.title} moves the face now" if moves else tab.tip)
    paint, low = imgui.get_window_draw_list(), (place.x + width, place.y + height)
    if chosen or hovered:
        paint.add_rect_filled(place, low, packed(c.field_hovered if hovered else c.field), 5 * scale)
    label = cut(tab.title, width - 8 * scale)
    size = imgui.calc_text_size(label)
    x = place.x + (width - size.x) / 2
    ink = packed(c.text if chosen or hovered else c.dim)
    paint.add_text((x, place.y + (height - size.y) / 2), ink, label)
    if chosen:
        foot = (x, place.y + height - 3 * scale)
        paint.add_rect_filled(foot, (x + size.x, place.y + height - scale), packed(c.accent), scale)
    if moves:
        at = (min(x + size.x + 6 * scale, place.x + width - 4 * scale), place.y + height * 0.32)
        paint.add_circle_filled(at, 3 * scale, packed(c.accent))
    return bool(pressed)
