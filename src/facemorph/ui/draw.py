"""The whole interface, once a frame: reads the state, draws, assigns back; no window, no OpenGL."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.ui import viewport_input
from facemorph.ui.hotkeys import run_hotkeys
from facemorph.ui.layout import laid_out
from facemorph.ui.panels import parts
from facemorph.ui.state import App


def draw_ui(app: App) -> None:
    """Draw everything but the face and take in mouse and keys; between `imgui.new_frame` and `render`."""
    # Asked before the parts, each of which may use the key to shut itself.
    free = not (imgui.is_popup_open("", imgui.PopupFlags_.any_popup) or imgui.get_io().want_text_input)
    layout = laid_out(app)
    app.methods.hovered = {}
    app.pages.emotion.wanted = ()
    app.pages.people.wanted = {}
    run_hotkeys(app)
    for part in parts():
        part(app, layout)
    viewport_input.handle(app)
    if free and app.messages.shown and imgui.is_key_pressed(imgui.Key.escape, False):
        app.messages.close(app.messages.shown[-1])
    _escape()


def _escape() -> None:
    """Escape shuts an open menu or list; pages and text fields see to it themselves."""
    page = imgui.internal.get_top_most_popup_modal() is not None
    opened = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
    typing = imgui.get_io().want_text_input
    if opened and not page and not typing and imgui.is_key_pressed(imgui.Key.escape, False):
        imgui.internal.close_popup_to_level(0, True)
