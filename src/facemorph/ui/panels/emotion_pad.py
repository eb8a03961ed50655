"""The round pad of the emotion map: poles with pictures of the face, the cursor, and what the hand does."""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from facemorph.core.emotion import Pole
from facemorph.core.emotion_path import thinned
from facemorph.core.rig import Rig
from facemorph.ui import emotion, emotion_poles
from facemorph.ui.emotion_page import Pad
from facemorph.ui.state import App
from facemorph.ui.theme import Colours, Rgba, faded, packed
from facemorph.ui.widgets import colours, cut, tooltip, unit
from facemorph.ui.words import NEUTRAL_LABEL, label_of

_PICTURE, _LEAST_PICTURE, _MOST_PICTURE = 0.172, 24.0, 76.0
_CROWD = 8  # more poles than these have smaller words
_SNAP, _REACH, _CLICK = 6.0, 6.0, 4.0
_LEFT, _RIGHT = 0, 1


@dataclass(frozen=True)
class _Seat:
    """A pole as it is drawn: where its picture is and how large, its words, its weight."""

    pole: Pole
    x: float
    y: float
    size: float
    label: str
    weight: float

    def holds(self, x: float, y: float) -> bool:
        """Whether a place lies on the picture."""
        return math.hypot(x - self.x, y - self.y) <= self.size / 2.0


def draw(app: App, rig: Rig, side: float) -> None:
    """The pad, `side` wide and high, at ImGui's cursor."""
    page, place = app.pages.emotion, imgui.get_cursor_screen_pos()
    seats, pad = _laid_out(app, rig, place, side)
    page.pad = pad
    both = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
    imgui.invisible_button("pad", ImVec2(side, side), both)
    hovered = _hand(app, seats, pad)
    paint = imgui.get_window_draw_list()
    paint.push_clip_rect(place, (place.x + side, place.y + side), True)
    _paint_disc(app, seats, pad)
    _paint_path(app, pad)
    _paint_sum(app, seats, pad)
    for seat in seats:
        _paint_picture(app, rig, seat, near=seat is hovered)
    _paint_words(app, seats, place, side, hovered)
    _paint_cursor(app, pad)
    paint.pop_clip_rect()


def _laid_out(app: App, rig: Rig, place: ImVec2, side: float) -> tuple[list[_Seat], Pad]:
    scale, poles = unit(), emotion.poles_of(app)
    weights = emotion.weights(app)
    size = min(max(side * _PICTURE, _LEAST_PICTURE * scale), _MOST_PICTURE * scale)
    # The words stand on the outer rims of the pictures, which touch the circle.
    reach = side / 2.0 - size / 2.0 - 14.0 * scale
    pad = Pad(place.x + side / 2.0, place.y + side / 2.0, max(reach - size / 2.0 + 3.0 * scale, 1.0))
    nearest = 2.0 * reach * math.sin(math.radians(min(emotion_poles.gaps(poles)) / 2.0))
    size = min(size, max(nearest * 0.95, 12.0 * scale))
    seats = []
    for pole in poles:
        angle = math.radians(pole.angle_deg)
        x, y = pad.x + reach * math.cos(angle), pad.y - reach * math.sin(angle)
        seats.append(_Seat(pole, x, y, size, label_of(rig, pole.name), weights[pole.name]))
    return seats, pad


def _hand(app: App, seats: list[_Seat], pad: Pad) -> _Seat | None:
    """What the mouse does to cursor and poles; gives the pole that it is on."""
    page, mouse = app.pages.emotion, imgui.get_mouse_pos()
    under = next((seat for seat in seats if seat.holds(mouse.x, mouse.y)), None)
    over = imgui.is_item_hovered()
    if over and imgui.is_mouse_double_clicked(_LEFT) and under is None:
        emotion.to_neutral(app)
        page.grab = ""
    elif over and imgui.is_mouse_clicked(_LEFT):
        _pressed(app, under, pad, mouse)
    if imgui.is_item_clicked(_RIGHT):
        emotion.to_neutral(app)
    if page.grab:
        _dragged(app, pad, mouse)
    if not (imgui.is_item_active() and imgui.is_mouse_down(_LEFT)):
        if page.grab == "pole" and not page.pole_moved:
            emotion.to_pole(app, page.pole)
        page.grab = ""
    if page.grab:
        return next((seat for seat in seats if page.grab == "pole" and seat.pole.name == page.pole), None)
    if not over:
        return None
    if under is not None:
        imgui.set_mouse_cursor(imgui.MouseCursor_.hand)
        tooltip(f"{under.label}\nClick for this expression alone; drag it to another place on the circle")
        app.methods.hovered = {under.pole.name: 1.0}
    return under


def _pressed(app: App, under: _Seat | None, pad: Pad, mouse: ImVec2) -> None:
    page = app.pages.emotion
    page.pressed_at, page.pole_moved = (mouse.x, mouse.y), False
    if under is not None:
        page.grab, page.pole = "pole", under.pole.name
    elif math.hypot(mouse.x - pad.x, mouse.y - pad.y) <= pad.radius + _REACH * unit():
        page.grab = "cursor"


def _dragged(app: App, pad: Pad, mouse: ImVec2) -> None:
    page = app.pages.emotion
    x, y = pad.on_map(mouse.x, mouse.y)
    if page.grab == "cursor":
        near = math.hypot(x, y) * pad.radius <= _SNAP * unit()
        emotion.drag_to(app, *((0.0, 0.0) if near else (x, y)))
        return
    far = math.hypot(mouse.x - page.pressed_at[0], mouse.y - page.pressed_at[1]) > _CLICK * unit()
    page.pole_moved = page.pole_moved or far
    if page.pole_moved:
        emotion_poles.move_pole(app, page.pole, math.degrees(math.atan2(y, x)))


def _accent(app: App, c: Colours) -> Rgba:
    return c.accent if app.controls.on("emotion") else c.dim


def _paint_disc(app: App, seats: list[_Seat], pad: Pad) -> None:
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    middle, line = (pad.x, pad.y), packed(c.track)
    paint.add_circle_filled(middle, pad.radius, packed(c.field), 96)
    ring = emotion.clockwise([seat.pole for seat in seats])
    weights = {seat.pole.name: seat.weight for seat in seats}
    for first, second in zip(ring, [*ring[1:], ring[0]], strict=True):
        if weights[first.name] > 0.0 and weights[second.name] > 0.0:
            turn = (first.angle_deg - second.angle_deg) % 360.0
            start = -math.radians(first.angle_deg)
            paint.path_line_to(middle)
            paint.path_arc_to(middle, pad.radius, start, start + math.radians(turn), 48)
            paint.path_fill_convex(packed(faded(_accent(app, c), 0.14)))
    paint.add_circle(middle, pad.radius / 2.0, packed(faded(c.track, 0.6)), 96, scale)
    for seat in seats:
        angle = math.radians(seat.pole.angle_deg)
        paint.add_line(middle, pad.place(math.cos(angle), math.sin(angle)), line, scale)
    paint.add_circle(middle, pad.radius, line, 96, 1.5 * scale)
    size = imgui.calc_text_size(NEUTRAL_LABEL)
    paint.add_circle_filled(middle, 3.0 * scale, packed(c.dim))
    ink = packed(faded(c.dim, 0.9 if emotion.at_rest(app) else 0.5))
    paint.add_text((pad.x - size.x / 2.0, pad.y + 12.0 * scale), ink, NEUTRAL_LABEL)


def _paint_path(app: App, pad: Pad) -> None:
    page, c = app.pages.emotion, colours(app)
    recording = page.recorder is not None and page.recorder.started
    places: tuple[tuple[float, float], ...] = ()
    if page.recorder is not None and recording:
        places = thinned(page.recorder.samples)
    elif page.path is not None:
        places = page.path.outline
    if len(places) < 2:
        return
    ink = packed(faded(c.error, 0.75) if recording else faded(c.text, 0.32))
    paint = imgui.get_window_draw_list()
    for x, y in places:
        paint.path_line_to(pad.place(x, y))
    paint.path_stroke(ink, thickness=2.0 * unit())


def _paint_sum(app: App, seats: list[_Seat], pad: Pad) -> None:
    """The cursor as the sum of its poles' directions: two arrows' lengths are the weights."""
    control, c, scale = app.controls.emotion, colours(app), unit()
    paint, cursor = imgui.get_window_draw_list(), pad.place(control.x, control.y)
    for seat in seats:
        if seat.weight > 0.0:
            angle = math.radians(seat.pole.angle_deg)
            end = pad.place(seat.weight * math.cos(angle), seat.weight * math.sin(angle))
            paint.add_line((pad.x, pad.y), end, packed(_accent(app, c)), 2.5 * scale)
            paint.add_line(end, cursor, packed(faded(_accent(app, c), 0.55)), scale)


def _paint_picture(app: App, rig: Rig, seat: _Seat, *, near: bool) -> None:
    page, c, scale, paint = app.pages.emotion, colours(app), unit(), imgui.get_window_draw_list()
    half = seat.size / 2.0
    texture = page.pictures.get(seat.pole.name) if page.pictured is rig.neutral else None
    paint.add_circle_filled((seat.x, seat.y), half, packed(c.field_hovered), 48)
    if texture is not None:
        low, high = (seat.x - half, seat.y - half), (seat.x + half, seat.y + half)
        reference = imgui.ImTextureRef(texture)
        paint.add_image_rounded(reference, low, high, (0, 0), (1, 1), packed((1, 1, 1, 1)), half)
    weight = min(seat.weight, 1.0)
    ink = _accent(app, c) if weight or near else c.track
    paint.add_circle((seat.x, seat.y), half, packed(ink), 48, (1.5 + 2.0 * weight) * scale)


def _paint_words(app: App, seats: list[_Seat], place: ImVec2, side: float, near: _Seat | None) -> None:
    """The poles' words on the outer rims of their pictures. Where all have no room the weighty come first."""
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    imgui.push_font(None, 15.0 if len(seats) <= _CROWD else 13.0)
    high, taken = imgui.get_font_size() + 2.0 * scale, list[tuple[float, float, float]]()
    for seat in sorted(seats, key=lambda seat: (seat is not near, -seat.weight)):
        text = cut(seat.label, 160.0 * scale)
        wide = imgui.calc_text_size(text).x + 10.0 * scale
        upper = math.sin(math.radians(seat.pole.angle_deg)) > 0.3
        x = min(max(seat.x, place.x + wide / 2.0), place.x + side - wide / 2.0)
        # Hair may be covered, the mouth may not.
        y = seat.y - seat.size / 2.0 if upper else seat.y + seat.size / 2.0 + 5.0 * scale
        if any(abs(x - u) < (wide + w) / 2.0 and abs(y - v) < high for u, v, w in taken):
            continue
        taken.append((x, y, wide))
        lit = seat.weight > 0.0 and app.controls.on("emotion")
        low, corner = (x - wide / 2.0, y - high / 2.0), (x + wide / 2.0, y + high / 2.0)
        paint.add_rect_filled(low, corner, packed(c.accent if lit else faded(c.popup, 0.94)), high / 2.0)
        if not lit:
            paint.add_rect(low, corner, packed(c.line), high / 2.0, thickness=scale)
        at = (low[0] + 5.0 * scale, y - imgui.get_font_size() / 2.0)
        paint.add_text(at, packed(c.on_accent if lit else c.text), text)
    imgui.pop_font()


def _paint_cursor(app: App, pad: Pad) -> None:
    control, c, scale, page = app.controls.emotion, colours(app), unit(), app.pages.emotion
    paint, at = imgui.get_window_draw_list(), pad.place(control.x, control.y)
    held = page.grab == "cursor"
    ink = c.error if page.recorder is not None else _accent(app, c)
    paint.add_circle_filled(at, (9.0 if held else 7.5) * scale, packed(ink), 32)
    paint.add_circle(at, (9.0 if held else 7.5) * scale, packed(c.panel), 32, 2.0 * scale)
