"""F1: every key, made from the table of commands, and what the mouse does."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui.command import Command
from facemorph.ui.commands import MENUS, commands
from facemorph.ui.layout import Layout
from facemorph.ui.panels.frame import begin_page, end_page
from facemorph.ui.state import App
from facemorph.ui.widgets import colours, cut, unit

MOUSE = (
    ("Turn the face", "Left drag"),
    ("Move it", "Middle drag, or Shift + left drag"),
    ("Nearer, farther", "Wheel"),
    ("Turn about a point", "Double-click on the face"),
    ("Set a point (page Handles)", "Click on the face"),
    ("Take a point away", "Right-click on it, or Delete"),
    ("Type a value", "Double-click on a slider"),
    ("Reset a slider", "Right-click on it"),
    ("Open", "Drop a folder or files on the window"),
)
_ELSEWHERE = "Slider"


def draw(app: App, layout: Layout) -> None:
    """The page of keys, where it is open."""
    if not app.keys_open:
        return
    app.keys_open = begin_page(app, "Keys and mouse", 780 * unit(), layout)
    room = imgui.get_content_region_avail().x
    if imgui.begin_table("keys", 2, imgui.TableFlags_.sizing_stretch_same, ImVec2(room, 0)):
        sections = [*_sections(app), ("Mouse", list(MOUSE))]
        half = sum(len(rows) + 2 for _, rows in sections) / 2
        imgui.table_next_column()
        used, second = 0, False
        for title, rows in sections:
            used += len(rows) + 2
            if used > half + 2 and not second:
                imgui.table_next_column()
                second = True
            _section(app, title, rows)
        imgui.end_table()
    end_page()


def _sections(app: App) -> list[tuple[str, list[tuple[str, str]]]]:
    table = [command for command in commands(app) if command.keys]
    sections = []
    for menu in MENUS:
        rows = [_line(command) for command in table if command.menu == menu]
        if rows:
            sections.append((menu, rows))
        if menu == "Expression":
            sections.append((_ELSEWHERE, [_line(command) for command in table if not command.menu]))
    return sections


def _line(command: Command) -> tuple[str, str]:
    return command.title.rstrip("…"), " or ".join(chord.shown for chord in command.keys)


def _section(app: App, title: str, rows: list[tuple[str, str]]) -> None:
    scale = unit()
    imgui.push_style_color(imgui.Col_.text, colours(app).accent)
    imgui.text_unformatted(title)
    imgui.pop_style_color()
    room = imgui.get_content_region_avail().x - 18 * scale
    start = imgui.get_cursor_pos_x()
    for what, keys in rows:
        wide = imgui.calc_text_size(keys).x
        imgui.text_unformatted(cut(what, room - wide - 12 * scale))
        imgui.same_line()
        imgui.set_cursor_pos_x(start + room - wide)
        imgui.text_disabled(keys)
    imgui.dummy(ImVec2(0, 6 * scale))
