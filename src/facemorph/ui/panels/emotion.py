"""The Emotion page: the pad, the poles' weights, a path recorded and played, and which poles there are."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.core.emotion import PAPER_POLES
from facemorph.core.rig import Rig
from facemorph.ui import actions, emotion, emotion_paths, emotion_poles, fonts
from facemorph.ui.emotion_page import FASTEST, SLOWEST
from facemorph.ui.panels import emotion_pad
from facemorph.ui.panels.rows import divider, method_head, quiet_words
from facemorph.ui.panels.value_rows import button_row
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import (
    colours,
    cut,
    icon_button,
    right_edge,
    row_label,
    tooltip,
    typed_number,
    unit,
)
from facemorph.ui.words import label_of

_RULE = {
    "sad": "w = max(Cx, 0)",
    "afraid": "w = max(-Cx, 0)",
    "happy": "w = max(Cy, 0)",
    "angry": "w = max(-Cy, 0)",
}
_SUM = "C = w1 d1 + w2 d2: the cursor as a sum of the directions of the two poles that it lies between"
_PLACE_TIP = (
    "The cursor's {axis}, from -1 to 1. Drag on the pad, or click the number to type it; a double-click "
    "or right-click on the pad leads back to neutral. The weights follow from it by the emotion map (2.1.2)."
)
_LARGEST_PAD, _MOST_BARS = 460.0, 8


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.controls.on("emotion") and not emotion.at_rest(app)


def draw(app: App) -> None:
    """The page's contents."""
    method_head(
        app,
        "emotion",
        "Emotion",
        usable=emotion.usable(app),
        at_rest=emotion.at_rest(app),
        reset=emotion.to_neutral,
        tip="The cursor back to neutral; the poles and the path stay",
    )
    if app.rig is None:
        quiet_words("No face is open.")
    elif not emotion.usable(app):
        quiet_words(_too_few(app.rig))
    else:
        _map(app, app.rig)


def _too_few(rig: Rig) -> str:
    count = len(emotion.choices(rig))
    has = f"{count} expression{'s' if count != 1 else ''}" if count else "no expressions"
    return (
        f"This face has {has}; at least {emotion.LEAST_POLES} must stand round the emotion map. Put more "
        "meshes into its folder, make shapes on the page Handles, or open a built-in face: "
        "File > Built-in faces."
    )


def _map(app: App, rig: Rig) -> None:
    # Room for a scroll bar is kept free, so that the pad does not change its size when one comes.
    side = imgui.get_content_region_avail().x - imgui.get_style().scrollbar_size
    side = max(min(side, _LARGEST_PAD * unit()), 1.0)
    imgui.begin_child("emotion page", ImVec2(0, 0))
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + (imgui.get_content_region_avail().x - side) / 2.0)
    known = {shape.name: shape for shape in emotion.choices(rig)}
    app.pages.emotion.wanted = tuple(known[pole.name] for pole in emotion.poles_of(app))
    emotion_pad.draw(app, rig, side)
    _place(app)
    _weights(app, rig)
    divider(app, "Path")
    _path(app)
    divider(app, "Poles")
    _poles(app, rig)
    imgui.end_child()


def _place(app: App) -> None:
    control, scale = app.controls.emotion, unit()
    word, number = 24 * scale, 56 * scale
    row_label(app, "Cx", word, _PLACE_TIP.format(axis="x"))
    imgui.same_line(0, 0)
    x = typed_number(app, "emotion x", control.x, -1.0, 1.0, number)
    imgui.same_line(0, 10 * scale)
    if imgui.get_content_region_avail().x < word + number:
        imgui.new_line()
    row_label(app, "Cy", word, _PLACE_TIP.format(axis="y"))
    imgui.same_line(0, 0)
    y = typed_number(app, "emotion y", control.y, -1.0, 1.0, number)
    if (x, y) != (control.x, control.y):
        emotion.move_to(app, x, y)


def _weights(app: App, rig: Rig) -> None:
    """Each pole's weight as a bar and a number, in two columns; of many poles those that count."""
    weights, gap = emotion.weights(app), 14 * unit()
    if len(weights) > _MOST_BARS:
        # Two of them, also where the cursor is on one pole or on none: the rows below stay in their place.
        shown = sorted(weights, key=lambda name: weights[name] == 0.0)[:2]
        weights = {name: weight for name, weight in weights.items() if name in shown}
    room = imgui.get_content_region_avail().x
    columns = 2 if room >= 260 * unit() else 1
    width = (room - gap) / 2.0 if columns == 2 else room
    paper = emotion.poles_of(app) == PAPER_POLES
    for place, (name, weight) in enumerate(weights.items()):
        if place % columns:
            imgui.same_line(0, gap)
        rule = _RULE[name] if paper else _SUM
        _bar(app, label_of(rig, name), weight, width, f"{rule} (2.1.2)")
        if imgui.is_item_hovered() and not imgui.is_any_item_active():
            app.methods.hovered = {name: 1.0}


def _bar(app: App, label: str, weight: float, width: float, tip: str) -> None:
    c, scale, place = colours(app), unit(), imgui.get_cursor_screen_pos()
    height, size = imgui.get_font_size() + 4 * scale, imgui.get_font_size()
    imgui.dummy(ImVec2(width, height))
    tooltip(f"{label}: {tip}")
    paint, middle = imgui.get_window_draw_list(), place.y + height / 2.0
    number, words = 38 * scale, width * 0.49
    ink = packed(c.text if weight else c.dim)
    paint.add_text((place.x, middle - size / 2.0), ink, cut(label, words - 6 * scale))
    left, right, thick = place.x + words, place.x + width - number, 3.0 * scale
    paint.add_rect_filled((left, middle - thick), (right, middle + thick), packed(c.track), thick)
    if weight:
        accent = c.accent if app.controls.on("emotion") else c.dim
        end = left + max((right - left) * min(weight, 1.0), 2.0 * thick)
        paint.add_rect_filled((left, middle - thick), (end, middle + thick), packed(accent), thick)
    text = f"{weight:.2f}"
    paint.add_text((place.x + width - imgui.calc_text_size(text).x, middle - size / 2.0), ink, text)


def _path(app: App) -> None:
    page, scale, gap = app.pages.emotion, unit(), 5 * unit()
    recording = page.recorder is not None
    words = f"{fonts.STOP}  Stop" if recording else f"{fonts.RECORD}  Record"
    imgui.push_style_color(imgui.Col_.text, colours(app).error if recording else colours(app).text)
    pressed = imgui.button(f"{words}###record", ImVec2(100 * scale, 0))
    imgui.pop_style_color()
    if pressed:
        emotion_paths.toggle_record(app)
    tooltip(
        "Take what was dragged as the path"
        if recording
        else "Takes down where the cursor is dragged, with its times, from the first press to the last"
    )
    imgui.begin_disabled(page.path is None or recording)
    imgui.same_line(0, gap)
    playing = page.player.playing
    tip = "Pause" if playing else "Play the path in its own time"
    if icon_button(app, fonts.PAUSE if playing else fonts.PLAY, "play path", tip):
        emotion_paths.toggle_play(app)
    imgui.end_disabled()
    imgui.same_line(0, 2 * scale)
    if imgui.get_content_region_avail().x < imgui.get_frame_height():
        imgui.new_line()
    tip = "Loop: there and back again, so that the face never jumps"
    if icon_button(app, fonts.LOOP, "loop path", tip, lit=page.player.loop):
        emotion_paths.toggle_loop(app)
    imgui.same_line(0, gap)
    if imgui.get_content_region_avail().x < 54 * scale:
        imgui.new_line()
    imgui.set_next_item_width(54 * scale)
    _, page.speed = imgui.drag_float("##speed", page.speed, 0.01, SLOWEST, FASTEST, "%.2f×", _CLAMPED)
    tooltip("How fast it plays. Drag sideways, or double-click to type.")
    _time(app)
    chosen = button_row(
        app,
        (
            ("Clear", "Forget the path; the cursor stays", page.path is not None and not recording),
            ("Open…", "Open a path kept in a file", not recording),
            ("Save…", "Keep the path in a file", page.path is not None and not recording),
        ),
    )
    if chosen == "Clear":
        emotion_paths.clear_path(app)
    elif chosen:
        actions.ask_for(app, "open path" if chosen == "Open…" else "save path")


_CLAMPED = imgui.SliderFlags_.always_clamp


def _time(app: App) -> None:
    page = app.pages.emotion
    if page.recorder is not None:
        text = f"{page.recorder.secs:.1f} s" if page.recorder.started else "Drag on the pad"
    elif page.path is not None:
        whole = page.path.duration_secs
        text = f"{page.played * whole:.1f} / {whole:.1f} s" if page.player.playing else f"{whole:.1f} s"
    else:
        return
    imgui.same_line()
    room = imgui.get_content_region_avail().x
    text = cut(text, room)
    imgui.set_cursor_pos_x(right_edge() - imgui.calc_text_size(text).x)
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(text)


def _poles(app: App, rig: Rig) -> None:
    """A button for each expression that can stand round the circle, lit where it does."""
    standing = {pole.name for pole in emotion.poles_of(app)}
    gap, room = 5 * unit(), imgui.get_content_region_avail().x
    columns = min(max(int(room // (96 * unit())), 1), 3)
    width = (room - (columns - 1) * gap) / columns
    for place, shape in enumerate(emotion.choices(rig)):
        if place % columns:
            imgui.same_line(0, gap)
        if _pole_button(app, shape.name, shape.label, width, standing):
            emotion_poles.toggle_pole(app, shape.name)
    chosen = button_row(
        app,
        (
            ("Paper's four", _PAPER_TIP, emotion.poles_of(app) != emotion.usual_poles(rig)),
            ("Spread", "The same poles, evenly apart", not emotion_poles.evenly_spread(app)),
            ("All", "Every expression of the face", len(standing) < emotion_poles.most_poles(rig)),
        ),
    )
    if chosen == "Spread":
        emotion_poles.spread_evenly(app)
    elif chosen:
        (emotion_poles.stand_everywhere if chosen == "All" else emotion_poles.to_usual_poles)(app)


_PAPER_TIP = (
    "Happy up, sad right, angry down, afraid left (2.1.2); on a face without these its first expressions"
)


def _pole_button(app: App, name: str, label: str, width: float, standing: set[str]) -> bool:
    c, lit = colours(app), name in standing
    free = len(standing) > emotion.LEAST_POLES if lit else len(standing) < emotion_poles.MOST_POLES
    imgui.push_style_color(imgui.Col_.button, c.field_hovered if lit else c.panel)
    imgui.push_style_color(imgui.Col_.text, c.text if lit else c.dim)
    imgui.begin_disabled(not free)
    room = width - 2 * imgui.get_style().frame_padding.x
    pressed = imgui.button(f"{cut(label, room)}###pole {name}", ImVec2(width, 0))
    imgui.end_disabled()
    imgui.pop_style_color(2)
    if not free:
        limit = f"At least {emotion.LEAST_POLES}" if lit else f"At most {emotion_poles.MOST_POLES}"
        tooltip(f"{label}: {limit.lower()} poles stand round the circle")
    else:
        tooltip(f"{label}: {'takes it from the circle' if lit else 'puts it into the widest gap'}")
    return bool(pressed)
