"""The menu bar, made from the table of commands; at its right end what is open."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.ui.command import Command
from facemorph.ui.commands import MENUS, commands
from facemorph.ui.layout import Layout
from facemorph.ui.state import App
from facemorph.ui.widgets import cut, tooltip, unit

# Submenus hang in their menu before the commands of a group.
_SUBMENUS: dict[str, dict[int, tuple[str, ...]]] = {
    "File": {1: ("Open recent", "Built-in faces")},
    "Expression": {1: ("FACS units", "Emotion map", "People", "Handles", "Regions")},
    "View": {3: ("Lights", "Smooth surface"), 4: ("Page",)},
}


def draw(app: App, layout: Layout) -> None:
    """The menu bar."""
    if not imgui.begin_main_menu_bar():
        return
    table = commands(app)
    for menu in MENUS:
        if imgui.begin_menu(menu):
            _menu(app, menu, table)
            imgui.end_menu()
    _face_facts(app)
    imgui.end_main_menu_bar()


def _menu(app: App, menu: str, table: tuple[Command, ...]) -> None:
    entries = [command for command in table if command.menu == menu]
    group = entries[0].group if entries else 0
    submenus = dict(_SUBMENUS.get(menu, {}))
    for place, command in enumerate(entries):
        for before in [before for before in submenus if command.group >= before]:
            _submenus(app, menu, submenus.pop(before), table)
        if command.group != group:
            imgui.separator()
            group = command.group
        # Names of shapes come from files: they may be alike.
        imgui.push_id(place)
        _entry(app, command)
        imgui.pop_id()
    if not entries:
        imgui.text_disabled("Open a face first")


def _submenus(app: App, menu: str, titles: tuple[str, ...], table: tuple[Command, ...]) -> None:
    for title in titles:
        entries = [command for command in table if command.menu == f"{menu}/{title}"]
        if imgui.begin_menu(title, bool(entries)):
            for place, command in enumerate(entries):
                if place and command.group != entries[place - 1].group:
                    imgui.separator()
                imgui.push_id(place)
                _entry(app, command)
                imgui.pop_id()
            imgui.end_menu()


def _entry(app: App, command: Command) -> None:
    keys = command.keys[0].shown if command.keys else ""
    checked = command.checked(app) if command.checked else False
    title = cut(command.full_title(app), 420 * unit())
    pressed, _ = imgui.menu_item(title, keys, checked, command.enabled(app))
    tooltip(command.help)
    if pressed:
        command.run(app)


def _face_facts(app: App) -> None:
    if app.face is None:
        return
    count = f"{app.face.rig.neutral.vertex_count:,} vertices"
    spare = imgui.get_content_region_avail().x - imgui.calc_text_size(f"  ·  {count}").x - 24 * unit()
    if spare < 40 * unit():
        return
    text = f"{cut(app.face.title, min(spare, 320 * unit()))}  ·  {count}"
    imgui.set_cursor_pos_x(imgui.get_window_width() - imgui.calc_text_size(text).x - 14 * unit())
    imgui.text_disabled(text)
