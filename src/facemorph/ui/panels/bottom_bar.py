"""The bottom bar: from, play, loop, duration, the slider, to, and how it eases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from facemorph.core.morph import CURVES
from facemorph.core.pose import NEUTRAL, State, state_of
from facemorph.ui import actions, fonts
from facemorph.ui.layout import Layout
from facemorph.ui.playback import LONGEST_SECS, SHORTEST_SECS
from facemorph.ui.state import App
from facemorph.ui.widgets import cut, icon_button, slim_slider, tooltip, typed_number, unit
from facemorph.ui.words import NEUTRAL_LABEL, state_words

_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_bring_to_front_on_focus
    | imgui.WindowFlags_.no_scroll_with_mouse
)
SLIDER = "morph"


def draw(app: App, layout: Layout) -> None:
    """The bottom bar."""
    imgui.set_next_window_pos((0, layout.height - layout.bottom))
    imgui.set_next_window_size((layout.width, layout.bottom))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(14 * unit(), 10 * unit()))
    imgui.begin("##bottom", None, _FLAGS)
    # Where a page shows another face, the slider would move what nobody sees.
    imgui.begin_disabled(not app.expressions or app.on_face.stage is not None)
    _row(app)
    imgui.end_disabled()
    imgui.end()
    imgui.pop_style_var()


def _row(app: App) -> None:
    room, scale = imgui.get_content_region_avail().x, unit()
    gap = imgui.get_style().item_spacing.x
    list_width = max(min(170 * scale, room * 0.15), 74 * scale)
    curve_width = max(min(104 * scale, room * 0.12), 80 * scale)
    number, seconds = 50 * scale, 54 * scale
    words = imgui.calc_text_size("From").x + imgui.calc_text_size("To").x
    buttons = 2 * imgui.get_frame_height()
    fixed = 2 * list_width + curve_width + number + seconds + words + buttons + 6 * gap + 17 * scale
    _expression_list(app, "From", app.pose.source, list_width, actions.start_from, _FROM_TIP)
    imgui.same_line(0, gap + 4 * scale)
    _playing(app, seconds)
    imgui.same_line()
    _slider(app, max(room - fixed, 60 * scale), number)
    imgui.same_line(0, gap + 4 * scale)
    _expression_list(app, "To", app.pose.target, list_width, actions.choose_expression, _TO_TIP)
    imgui.same_line()
    _curve(app, curve_width)


_FROM_TIP = (
    "Where the slider starts. Choosing an expression puts the present face here, "
    "so that nothing jumps (2.11)."
)
_TO_TIP = "Where the slider goes. The present face becomes the start, so that nothing jumps (2.11)."


def _expression_list(
    app: App, word: str, state: State, width: float, choose: Callable[[App, str], None], tip: str
) -> None:
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(word)
    imgui.same_line()
    rig = app.rig
    shown = state_words(rig, state) if rig else NEUTRAL_LABEL
    room = width - imgui.get_frame_height() - 2 * imgui.get_style().frame_padding.x
    imgui.set_next_item_width(width)
    if imgui.begin_combo(f"##{word}", cut(shown, room), imgui.ComboFlags_.height_large):
        _choices(app, state, choose)
        imgui.end_combo()
    elif rig:
        tooltip(f"{shown}\n{tip}")


def _choices(app: App, state: State, choose: Callable[[App, str], None]) -> None:
    names = [(NEUTRAL, NEUTRAL_LABEL), *((shape.name, shape.label) for shape in app.expressions)]
    mixture = not any(state == state_of(name) for name, _ in names)
    if mixture and app.rig is not None:
        imgui.selectable(f"Present face ({state_words(app.rig, state)})", True)
        imgui.separator()
    for name, label in names:
        imgui.push_id(name)
        if imgui.selectable(cut(label, 360 * unit()), state == state_of(name))[0]:
            choose(app, name)
        imgui.pop_id()


def _playing(app: App, width: float) -> None:
    playing = app.playback.playing
    icon = fonts.PAUSE if playing else fonts.PLAY
    if icon_button(
        app, icon, "play", "Pause (Space)" if playing else "Play from the start to the goal (Space)"
    ):
        actions.toggle_play(app)
    imgui.same_line(0, 2 * unit())
    tip = "Loop (L): there and back again, so that the face never jumps"
    if icon_button(app, fonts.LOOP, "loop", tip, lit=app.settings.loop):
        actions.toggle_loop(app)
    imgui.same_line(0, 4 * unit())
    imgui.set_next_item_width(width)
    changed, secs = imgui.drag_float(
        "##secs", app.settings.duration_secs, 0.02, SHORTEST_SECS, LONGEST_SECS, "%.1f s"
    )
    tooltip("How long one way takes, in seconds. Drag sideways, or double-click to type.")
    if changed:
        secs = min(max(secs, SHORTEST_SECS), LONGEST_SECS)
        app.settings.duration_secs = app.playback.duration_secs = secs


def _slider(app: App, width: float, number_width: float) -> None:
    t = slim_slider(app, SLIDER, app.pose.t, 0.0, 1.0, width)
    if not imgui.is_item_active():
        tooltip(
            "From the source at 0 to the goal at 1: P(t) = (1 - t) P0 + t P1 (2.5).\n"
            "Left and Right move it, Home and End put it to its ends."
        )
    imgui.same_line(0, 2 * unit())
    t = typed_number(app, SLIDER, t, 0.0, 1.0, number_width)
    if t != app.pose.t:
        app.playback.stop()
        app.pose = replace(app.pose, t=t)
        app.settings.hint_seen = True


def _curve(app: App, width: float) -> None:
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##curve", app.pose.curve.capitalize()):
        for curve in CURVES:
            if imgui.selectable(curve.capitalize(), app.pose.curve == curve)[0]:
                actions.set_curve(app, curve)
        imgui.end_combo()
    else:
        tooltip(
            "How the face moves along the slider.\nLinear: at even speed (2.5).\n"
            "Cosine: starts and ends gently, t' = (1 - cos(pi t)) / 2 (2.1, after Parke 1972)."
        )
