"""The whole interface, once a frame: reads the state, draws, assigns back; no window, no OpenGL."""

from __future__ import annotations

from facemorph.ui import viewport_input
from facemorph.ui.hotkeys import run_hotkeys
from facemorph.ui.layout import laid_out
from facemorph.ui.panels import parts
from facemorph.ui.state import App


def draw_ui(app: App) -> None:
    """Draw everything but the face and take in mouse and keys; between `imgui.new_frame` and `render`."""
    layout = laid_out(app)
    run_hotkeys(app)
    for part in parts():
        part(app, layout)
    viewport_input.handle(app)
