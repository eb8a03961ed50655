"""Asking for a file: the desktop's own dialog where there is one, else a path with completion."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from imgui_bundle import ImVec2, imgui

from facemorph.ui import dialogs, fonts
from facemorph.ui.layout import Layout
from facemorph.ui.panels.frame import begin_page, end_page
from facemorph.ui.paths import Entry, completed, entries, expanded, folder_of, home, suffixed
from facemorph.ui.purposes import PURPOSES, Purpose
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, cut, icon_button, right_edge, unit


def draw(app: App, layout: Layout) -> None:
    """The file chooser, where something is asked for."""
    state = app.chooser
    if not state.purpose:
        return
    # With a path, "fresh" only wants the keyboard for its field.
    if state.fresh and not state.path:
        _begin(app)
    if state.dialog is not None:
        _poll(app, state.dialog)
        return
    if not begin_page(app, _purpose(app).title, 640 * unit(), layout):
        state.purpose = ""
    else:
        _page(app)
    end_page()


def _begin(app: App) -> None:
    state = app.chooser
    state.path, state.replacing, state.listed = str(_start(app)), "", None
    if app.native_dialogs:
        state.fresh = False
        state.dialog = dialogs.NativeDialog(_purpose(app), Path(state.path))


def _start(app: App) -> Path | str:
    folder = Path(app.settings.last_folder)
    if not app.settings.last_folder or not folder.is_dir():
        folder = home()
    if not _purpose(app).saving:
        return f"{folder}{os.sep}"
    suffix = _purpose(app).suffixes[0]
    called = _purpose(app).called
    title = called(app) if called else app.face.title if app.face else ""
    name = "".join(letter if letter.isalnum() or letter in " -_" else "_" for letter in title)
    return folder / f"{name.strip() or 'face'}{suffix}"


def _poll(app: App, dialog: dialogs.NativeDialog) -> None:
    answer = dialog.answer()
    if answer is None:
        return
    state = app.chooser
    state.dialog = None
    purpose = _purpose(app)
    if answer and purpose.saving:
        written = _written(purpose, Path(answer[0]))
        if written != Path(answer[0]) and written.exists():
            # The desktop asked about the name without its suffix only.
            state.path = state.replacing = str(written)
            state.fresh = True
            return
    state.purpose = ""
    if answer:
        _take(app, purpose, [Path(part) for part in answer])


def _page(app: App) -> None:
    state = app.chooser
    imgui.push_text_wrap_pos(0.0)
    imgui.text_disabled(_purpose(app).help)
    imgui.pop_text_wrap_pos()
    found = _completions(app)
    entered = _field(app, found)
    _list(app, found)
    purpose = _purpose(app)
    word = "Save" if purpose.saving else "Open"
    goal = expanded(state.path)
    again = state.replacing == str(goal)
    word = "Replace it" if again else word
    width = imgui.calc_text_size(word).x + 4 * imgui.get_style().frame_padding.x
    imgui.align_text_to_frame_padding()
    taken = _is_for_folder(app) and goal.is_dir() and not state.path.endswith(os.sep)
    note = f"{goal.name} is there already." if again or taken else ""
    imgui.text_unformatted(cut(note, imgui.get_content_region_avail().x - width - 12 * unit()))
    imgui.same_line(right_edge() - width)
    imgui.begin_disabled(not _usable(purpose, goal))
    pressed = imgui.button(word, ImVec2(width, 0))
    imgui.end_disabled()
    if (pressed or entered) and _usable(purpose, goal):
        _chosen(app, goal)


def _completions(app: App) -> list[Entry]:
    """What completes the typed path; the folder is read again only when the path changes."""
    state = app.chooser
    if state.listed is None or state.listed[0] != state.path:
        state.listed = (state.path, entries(state.path, _purpose(app).suffixes))
    return state.listed[1]


def _usable(purpose: Purpose, goal: Path) -> bool:
    if purpose.saving:
        return goal.parent.is_dir() and not goal.is_dir()
    return goal.is_dir() if purpose.ask == "folder" else goal.exists()


def _chosen(app: App, goal: Path) -> None:
    state = app.chooser
    purpose = _purpose(app)
    if purpose.saving and state.replacing != str(goal):
        written = _written(purpose, goal)
        if written.exists():
            state.path = state.replacing = str(written)
            return
    state.purpose = ""
    imgui.close_current_popup()
    _take(app, purpose, [goal])


def _written(purpose: Purpose, goal: Path) -> Path:
    return suffixed(goal, purpose.suffixes[0])


def _take(app: App, purpose: Purpose, paths: list[Path]) -> None:
    app.settings.last_folder = str(paths[0].parent)
    purpose.take(app, paths)


def _purpose(app: App) -> Purpose:
    return PURPOSES[app.chooser.purpose]


def _field(app: App, found: list[Entry]) -> bool:
    state = app.chooser
    if icon_button(app, fonts.UP, "up", "The folder above"):
        parent = folder_of(state.path).parent
        state.path, state.fresh = _with_name(app, parent), True
    imgui.same_line(0, 4 * unit())
    imgui.set_next_item_width(imgui.get_content_region_avail().x)
    if state.fresh:
        imgui.set_keyboard_focus_here()
        state.fresh = False
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.callback_completion
    flags |= imgui.InputTextFlags_.callback_always

    def complete(data: imgui.InputTextCallbackData) -> int:
        if data.event_flag == imgui.InputTextFlags_.callback_always:
            if data.event_activated:
                # Taking the keyboard marks the whole path, and the first letter would wipe it out.
                data.clear_selection()
                data.cursor_pos = data.buf_text_len
            return 0
        typed: Any = data.buf  # the binding gives text where its stub says a character
        longer = completed(typed, found)
        if longer != typed:
            data.delete_chars(0, data.buf_text_len)
            data.insert_chars(0, longer)
        return 0

    entered, path = imgui.input_text("##path", state.path, flags, complete)
    state.path = path
    return bool(entered)


def _with_name(app: App, folder: Path) -> str:
    if not _purpose(app).saving:
        return f"{folder}{os.sep}" if str(folder) != os.sep else os.sep
    return str(folder / expanded(app.chooser.path).name)


def _list(app: App, found: list[Entry]) -> None:
    imgui.push_style_color(imgui.Col_.child_bg, colours(app).field)
    imgui.begin_child("entries", ImVec2(0, 300 * unit()), imgui.ChildFlags_.always_use_window_padding)
    imgui.pop_style_color()
    if not found:
        imgui.text_disabled(_nothing_found(app))
    clipper = imgui.ListClipper()
    clipper.begin(len(found))
    while clipper.step():
        for place in range(clipper.display_start, clipper.display_end):
            _entry(app, found[place], place)
    imgui.end_child()


def _nothing_found(app: App) -> str:
    if not folder_of(app.chooser.path).is_dir():
        return "No such folder."
    if not _purpose(app).saving:
        return "No file here begins like that."
    return f"A new {'folder' if _is_for_folder(app) else 'file'} of this name."


def _is_for_folder(app: App) -> bool:
    """Whether a new folder is wanted."""
    purpose = _purpose(app)
    return purpose.saving and not purpose.suffixes[0]


def _entry(app: App, entry: Entry, place: int) -> None:
    state, c = app.chooser, colours(app)
    icon = fonts.FOLDER if entry.is_folder else fonts.FILE
    imgui.push_id(place)
    at = imgui.get_cursor_screen_pos()
    indent = 26 * unit()
    label = cut(entry.name, imgui.get_content_region_avail().x - indent)
    pressed = imgui.selectable("##entry", expanded(state.path) == Path(entry.path))[0]
    paint = imgui.get_window_draw_list()
    paint.add_text(at, packed(c.accent if entry.is_folder else c.dim), icon)
    paint.add_text((at.x + indent, at.y), packed(c.text), label)
    imgui.pop_id()
    if not pressed:
        return
    saving_into = entry.is_folder and _purpose(app).saving
    state.path = str(Path(entry.path) / expanded(state.path).name) if saving_into else entry.path
    state.fresh = True
