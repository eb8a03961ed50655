"""Keys to commands, by the table."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.ui.chord import Chord
from facemorph.ui.commands import commands
from facemorph.ui.state import App

_NAMES = {
    "Left": imgui.Key.left_arrow,
    "Right": imgui.Key.right_arrow,
    "Space": imgui.Key.space,
    "Home": imgui.Key.home,
    "End": imgui.Key.end,
    "Tab": imgui.Key.tab,
}
_KEYPAD = {str(digit): getattr(imgui.Key, f"keypad{digit}") for digit in range(10)}


def imgui_key(name: str) -> imgui.Key:
    """ImGui's key for a name as `Chord` has it."""
    if name in _NAMES:
        return _NAMES[name]
    return getattr(imgui.Key, f"_{name}" if name.isdigit() else name.lower())  # type: ignore[no-any-return]


def run_hotkeys(app: App) -> None:
    """Run the command whose keys were just pressed; a page on show and a text being typed keep theirs."""
    if app.chooser.purpose or app.about_open or app.palette.open:
        return
    io = imgui.get_io()
    for command in commands(app):
        for chord in command.keys:
            if not _pressed(chord, repeats=command.repeats):
                continue
            if io.want_text_input and chord.typed:
                continue
            if app.keys_open and chord.key != "F1":
                continue
            command.run(app)
            return


def _pressed(chord: Chord, *, repeats: bool) -> bool:
    if _held() != (chord.ctrl, chord.shift, chord.alt):
        return False
    if imgui.is_key_pressed(imgui_key(chord.key), repeats):
        return True
    return chord.key in _KEYPAD and imgui.is_key_pressed(_KEYPAD[chord.key], repeats)


def _held() -> tuple[bool, bool, bool]:
    """Ctrl, Shift and Alt, as they were when the key went down: let go within the same frame, they count."""
    io, key = imgui.get_io(), imgui.Key
    held = (
        (io.key_ctrl, key.left_ctrl, key.right_ctrl),
        (io.key_shift, key.left_shift, key.right_shift),
        (io.key_alt, key.left_alt, key.right_alt),
    )
    ctrl, shift, alt = (
        down or imgui.is_key_released(left) or imgui.is_key_released(right) for down, left, right in held
    )
    return ctrl, shift, alt


def nudging() -> bool:
    """Whether a key that moves the slider is held: its steps are one step of undo."""
    return any(imgui.is_key_down(_NAMES[name]) for name in ("Left", "Right"))
