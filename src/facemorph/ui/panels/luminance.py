"""Over the face, at the lower left: how bright its skin is made, while equal luminance is on."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.core.picture import LEAST_LUMINANCE, LUMINANCE, MOST_LUMINANCE
from facemorph.gl.luminance import LIT
from facemorph.ui import actions, fonts
from facemorph.ui.layout import Layout
from facemorph.ui.state import App
from facemorph.ui.theme import faded
from facemorph.ui.widgets import colours, icon_button, row_label, slim_slider, typed_number, unit

TITLE = "Skin luminance"
_TIP = (
    "The mean luminance of the skin, as a part of white's: CIE 1931 Y of the picture on an sRGB screen. "
    "All faces are lit until they have it: within three percent here, exactly in saved pictures. "
    "Drag, double-click to type, right-click for the usual one"
)
_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.no_bring_to_front_on_focus
    | imgui.WindowFlags_.always_auto_resize
)
_SLIDER, _NUMBER, _MARGIN = 96.0, 48.0, 14.0
_BUTTONS = 370.0  # at most so wide are those for view and shading


def draw(app: App, layout: Layout) -> None:
    """The strip, where it has something to say."""
    view, scale = app.views()[0], unit()
    if app.face is None or not app.settings.equal_luminance or app.shown_look.shading not in LIT:
        return
    label = imgui.calc_text_size(TITLE).x + 10 * scale
    width = label + (_SLIDER + _NUMBER) * scale + imgui.get_frame_height()
    if width + 2 * _MARGIN * scale > view.width or view.height < 200 * scale:
        return
    _begin(app, view.x + _MARGIN * scale, view.y + view.height - 12 * scale - _lift(app, width))
    row_label(app, TITLE, label, _TIP)
    imgui.same_line(0, 0)
    luminance, low, high = app.settings.luminance, LEAST_LUMINANCE, MOST_LUMINANCE
    key = "skin luminance"
    new = slim_slider(app, key, luminance, low, high, _SLIDER * scale, rest=LUMINANCE)
    imgui.same_line(0, 0)
    new = typed_number(app, key, new, low, high, _NUMBER * scale)
    if new != luminance:
        actions.set_luminance(app, new)
    imgui.same_line(0, 0)
    if icon_button(app, fonts.CLOSE, "no equal luminance", "Light the face as it comes"):
        actions.toggle_equal_luminance(app)
    if app.luminance_problem:
        imgui.push_text_wrap_pos(width)
        imgui.push_style_color(imgui.Col_.text, colours(app).error)
        imgui.text_unformatted(app.luminance_problem[:1].upper() + app.luminance_problem[1:])
        imgui.pop_style_color()
        imgui.pop_text_wrap_pos()
    imgui.end()


def _lift(app: App, width: float) -> float:
    """How much higher it stands to clear the buttons at the right, where there is no room beside them."""
    room = app.viewport.width - (_BUTTONS + 3 * _MARGIN) * unit()
    return 0.0 if width <= room else 2 * imgui.get_frame_height() + 14 * unit()


def _begin(app: App, x: float, y: float) -> None:
    imgui.set_next_window_pos((x, y), 0, (0.0, 1.0))
    imgui.push_style_color(imgui.Col_.window_bg, faded(colours(app).panel, 0.86))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(10 * unit(), 4 * unit()))
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 6 * unit())
    imgui.begin("##luminance", None, _FLAGS)
    imgui.pop_style_var(2)
    imgui.pop_style_color()
