"""The two side panels: a frame with an edge to pull, and the pages that share it."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui import actions
from facemorph.ui.layout import LEAST_SIDE_WIDTH, Layout
from facemorph.ui.panels import Tab, left_tabs, right_tabs
from facemorph.ui.panels.tabs import chosen_tab, tab_bar
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, unit

_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_scroll_with_mouse
)
_BEHIND = _FLAGS | imgui.WindowFlags_.no_bring_to_front_on_focus
_EDGE = 6.0


def draw(app: App, layout: Layout) -> None:
    """Both sides, where they are open."""
    if layout.left:
        moved = _edge(app, "##left edge", layout.left, layout)
        _side(app, "##left", 0.0, layout.left, layout, left_tabs())
        app.settings.left_width = _clamped(app.settings.left_width, moved, layout)
    if layout.right:
        moved = _edge(app, "##right edge", layout.width - layout.right, layout)
        _side(app, "##right", layout.width - layout.right, layout.right, layout, right_tabs())
        app.settings.right_width = _clamped(app.settings.right_width, -moved, layout)


def _clamped(width: float, moved: float, layout: Layout) -> float:
    if not moved:
        return width
    most = max(layout.width / unit() * 0.45, LEAST_SIDE_WIDTH)
    return min(max(width + moved / unit(), LEAST_SIDE_WIDTH), most)


def _side(app: App, name: str, x: float, width: float, layout: Layout, tabs: tuple[Tab, ...]) -> None:
    imgui.set_next_window_pos((x, layout.menu))
    imgui.set_next_window_size((width, layout.middle_height))
    imgui.begin(name, None, _BEHIND)
    if len(tabs) == 1:
        tabs[0].draw(app)
    else:
        chosen = chosen_tab(tabs, app.settings.right_page)
        title = tab_bar(app, tabs, chosen.title)
        if title != chosen.title:
            actions.show_page(app, title)
            chosen = chosen_tab(tabs, title)
        imgui.push_id(chosen.title)
        chosen.draw(app)
        imgui.pop_id()
    imgui.end()


def _edge(app: App, name: str, x: float, layout: Layout) -> float:
    """The edge between a side and the face; gives how far it was pulled just now."""
    wide = _EDGE * unit()
    imgui.set_next_window_pos((x - wide / 2, layout.menu))
    imgui.set_next_window_size((wide, layout.middle_height))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(0, 0))
    imgui.begin(name, None, _FLAGS | imgui.WindowFlags_.no_background)
    imgui.invisible_button("pull", ImVec2(wide, layout.middle_height))
    live = imgui.is_item_hovered() or imgui.is_item_active()
    moved = imgui.get_io().mouse_delta.x if imgui.is_item_active() else 0.0
    if live:
        imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew)
        middle = x - unit()
        imgui.get_window_draw_list().add_rect_filled(
            (middle, layout.menu),
            (middle + 2 * unit(), layout.menu + layout.middle_height),
            packed(colours(app).accent),
        )
    imgui.end()
    imgui.pop_style_var()
    return float(moved)
