"""Ctrl+K: find any command by its name."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui.command import Command
from facemorph.ui.commands import commands
from facemorph.ui.layout import Layout
from facemorph.ui.state import App
from facemorph.ui.theme import faded, packed
from facemorph.ui.widgets import colours, cut, unit

_SHOWN = 12
_FLAGS = (
    imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.always_auto_resize
)  # fmt: skip
_NAME = "##find a command"


def draw(app: App, layout: Layout) -> None:
    """The palette, where it is open."""
    state = app.palette
    if not state.open:
        return
    width = min(560 * unit(), layout.width - 32 * unit())
    imgui.set_next_window_pos((layout.width / 2, layout.menu + 36 * unit()), 0, (0.5, 0.0))
    imgui.set_next_window_size_constraints((width, 0), (width, layout.height))
    if state.fresh:
        imgui.open_popup(_NAME)
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(10 * unit(), 10 * unit()))
    shown = imgui.begin_popup(_NAME, _FLAGS)
    imgui.pop_style_var()
    if not shown:
        state.open = False
        return
    chosen = _contents(app)
    if chosen is not None or imgui.is_key_pressed(imgui.Key.escape, False):
        imgui.close_current_popup()
        state.open = False
    imgui.end_popup()
    if chosen is not None:
        chosen.run(app)


def _contents(app: App) -> Command | None:
    state = app.palette
    if state.fresh:
        imgui.set_keyboard_focus_here()
        state.fresh = False
    imgui.set_next_item_width(-1)
    changed, state.words = imgui.input_text_with_hint("##words", "What do you want to do?", state.words)
    if changed:
        state.marked = 0
    matches = [command for command in ranked(commands(app), state.words) if command.enabled(app)]
    if not matches:
        imgui.text_disabled("No command has these words.")
        return None
    step = imgui.is_key_pressed(imgui.Key.down_arrow) - imgui.is_key_pressed(imgui.Key.up_arrow)
    state.marked = (state.marked + step) % len(matches)
    if imgui.is_key_pressed(imgui.Key.enter, False) or imgui.is_key_pressed(imgui.Key.keypad_enter, False):
        return matches[state.marked]
    first = max(0, state.marked - _SHOWN + 1)
    for place, command in enumerate(matches[first : first + _SHOWN], start=first):
        if _entry(app, command, place):
            return command
    return None


def _entry(app: App, command: Command, place: int) -> bool:
    c, scale = colours(app), unit()
    at, width, height = (
        imgui.get_cursor_screen_pos(),
        imgui.get_content_region_avail().x,
        imgui.get_frame_height(),
    )
    pressed = imgui.invisible_button(f"entry {place}", ImVec2(width, height))
    if imgui.is_item_hovered() and (imgui.get_io().mouse_delta.x or imgui.get_io().mouse_delta.y):
        app.palette.marked = place
    paint = imgui.get_window_draw_list()
    if place == app.palette.marked:
        paint.add_rect_filled(at, (at.x + width, at.y + height), packed(faded(c.accent, 0.28)), 5 * scale)
    keys = command.keys[0].shown if command.keys else ""
    y, wide = at.y + (height - imgui.get_font_size()) / 2, imgui.calc_text_size(keys).x
    where = command.menu.replace("/", " > ")
    left = at.x + 8 * scale
    title = cut(command.full_title(app), width * 0.62)
    paint.add_text((left, y), packed(c.text), title)
    after = left + imgui.calc_text_size(title).x + 10 * scale
    paint.add_text((after, y), packed(c.dim), cut(where, max(at.x + width - wide - 24 * scale - after, 1.0)))
    paint.add_text((at.x + width - wide - 8 * scale, y), packed(c.dim), keys)
    return bool(pressed)


def ranked(table: tuple[Command, ...], words: str) -> list[Command]:
    """Commands that hold every word, those whose title starts with it first, then in the menus' order."""
    wanted = words.casefold().split()
    found: list[tuple[int, int, Command]] = []
    for place, command in enumerate(table):
        title = command.title.casefold()
        text = f"{title} {command.menu.casefold()} {command.help.casefold()}"
        if not all(word in text for word in wanted):
            continue
        in_title = all(word in title for word in wanted)
        begins = bool(wanted) and any(part.startswith(wanted[0]) for part in title.split())
        found.append(
            (
                0 if title.startswith(words.casefold()) else 1 if begins else 2 if in_title else 3,
                place,
                command,
            )
        )
    return [command for _, _, command in sorted(found, key=lambda entry: entry[:2])]
