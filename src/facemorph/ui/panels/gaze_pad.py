"""A small pad for the gaze on the FACS page: an eye's view of where the eyes look."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui import gaze
from facemorph.ui.state import App
from facemorph.ui.theme import faded, packed
from facemorph.ui.widgets import colours, tooltip, unit

_WIDTH, _HEIGHT = 132.0, 84.0
_TIP = (
    "Drag: where the eyes look, as you see the face from the front; the lids follow. "
    "It sets the units 61 to 64. A right-click looks straight ahead."
)


def draw(app: App) -> None:
    """The pad, and in words where the eyes look."""
    scale, start = unit(), imgui.get_cursor_screen_pos()
    room = imgui.get_content_region_avail().x
    width, height = min(_WIDTH * scale, room), _HEIGHT * scale
    both = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
    imgui.invisible_button("gaze", ImVec2(width, height), both)
    if imgui.is_item_clicked(1):
        gaze.look(app, 0.0, 0.0)
    elif imgui.is_item_active() and imgui.is_mouse_down(0):
        mouse = imgui.get_mouse_pos()
        inset = 10 * scale
        x = 2.0 * (mouse.x - start.x - inset) / (width - 2 * inset) - 1.0
        y = 1.0 - 2.0 * (mouse.y - start.y - inset) / (height - 2 * inset)
        gaze.look(app, x, y)
    elif not imgui.is_item_active():
        tooltip(_TIP)
    _paint(app, start, width, height, held=imgui.is_item_active())
    if room - width >= 120 * scale:
        imgui.same_line(0, 12 * scale)
        imgui.begin_group()
        x, y = gaze.place(app)
        for words in _words(x, y):
            imgui.text_disabled(words)
        imgui.end_group()


def _words(x: float, y: float) -> tuple[str, ...]:
    across = f"{'left' if x > 0 else 'right'} {abs(x):.2f}" if x else ""
    along = f"{'up' if y > 0 else 'down'} {abs(y):.2f}" if y else ""
    return tuple(words for words in (across, along) if words) or ("straight ahead",)


def _paint(app: App, start: ImVec2, width: float, height: float, *, held: bool) -> None:
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    paint.add_rect_filled(start, (start.x + width, start.y + height), packed(c.field), 6 * scale)
    middle = (start.x + width / 2, start.y + height / 2)
    line = packed(faded(c.track, 0.7))
    inset = 10 * scale
    paint.add_line((start.x + inset, middle[1]), (start.x + width - inset, middle[1]), line, scale)
    paint.add_line((middle[0], start.y + inset), (middle[0], start.y + height - inset), line, scale)
    x, y = gaze.place(app)
    x, y = min(max(x, -1.0), 1.0), min(max(y, -1.0), 1.0)
    at = (middle[0] + x * (width / 2 - inset), middle[1] - y * (height / 2 - inset))
    accent = c.accent if app.controls.on("facs") else c.dim
    paint.add_circle_filled(
        at, (8.5 if held else 7.0) * scale, packed(c.accent_bright if held else accent), 32
    )
    paint.add_circle_filled(at, 3.0 * scale, packed(c.panel), 20)
