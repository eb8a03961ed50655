"""A page in the middle of the window, with a title and a way out: Escape, its cross, or a click beside it."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui import fonts
from facemorph.ui.layout import Layout
from facemorph.ui.state import App
from facemorph.ui.widgets import icon_button, right_edge, unit

_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.always_auto_resize
)


def begin_page(app: App, title: str, width: float, layout: Layout, *, top: float | None = None) -> bool:
    """Begin a modal page of a width; False when the user has just left it. `end_page` must follow."""
    width = min(width, layout.width - 32 * unit())
    if not imgui.is_popup_open(title):
        imgui.open_popup(title)
    y = layout.height / 2 if top is None else top
    imgui.set_next_window_pos((layout.width / 2, y), 0, (0.5, 0.5 if top is None else 0.0))
    most = layout.height - 32 * unit() - (top or 0.0)
    imgui.set_next_window_size_constraints((width, 0), (width, most))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(20 * unit(), 16 * unit()))
    imgui.push_style_var(imgui.StyleVar_.popup_rounding, 8 * unit())
    imgui.begin_popup_modal(title, None, _FLAGS)
    imgui.pop_style_var(2)
    side = imgui.get_frame_height()
    imgui.push_font(None, 22.0)
    imgui.text_unformatted(title)
    imgui.pop_font()
    imgui.same_line(right_edge() - side)
    left = icon_button(app, fonts.CLOSE, "leave page", "Close (Esc)")
    imgui.dummy(ImVec2(0, 2 * unit()))
    left = left or imgui.is_key_pressed(imgui.Key.escape, False) or _clicked_beside()
    if left:
        imgui.close_current_popup()
    return not left


def end_page() -> None:
    """End what `begin_page` began."""
    imgui.end_popup()


def _clicked_beside() -> bool:
    place, size, mouse = imgui.get_window_pos(), imgui.get_window_size(), imgui.get_mouse_pos()
    inside = place.x <= mouse.x <= place.x + size.x and place.y <= mouse.y <= place.y + size.y
    return imgui.is_mouse_clicked(0) and not inside and not imgui.is_window_appearing()
