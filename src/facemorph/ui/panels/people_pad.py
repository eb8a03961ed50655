"""The square pad of the People page: s to the right, t upwards, a face in each corner (2.10)."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui import people
from facemorph.ui.state import App
from facemorph.ui.theme import faded, packed
from facemorph.ui.widgets import colours, cut, tooltip, unit

_LARGEST, _LEAST_WITH_PICTURES = 300.0, 120.0
_PICTURE, _GAP, _INSET = 68.0, 8.0, 12.0
_NOBODY = ("Choose the other", "person above")


def draw(app: App) -> None:
    """The pad with its corners' words and pictures, as wide as there is room."""
    scale, room = unit(), imgui.get_content_region_avail().x
    column = (_PICTURE + _GAP) * scale
    pictured = room - 2 * column >= _LEAST_WITH_PICTURES * scale
    side = min(room - 2 * column if pictured else room, _LARGEST * scale)
    start = imgui.get_cursor_screen_pos()
    left = start.x + (room - side) / 2
    edge = column if pictured else 0.0
    _corner_words(app, left - edge, side + 2 * edge, start.y, t=1)
    top = start.y + 2 * imgui.get_font_size() + 6 * scale
    if pictured:
        _pictures(app, left - edge, left + side + _GAP * scale, top, side)
    imgui.set_cursor_screen_pos(ImVec2(left, top))
    _square(app, side)
    low = top + side + 6 * scale
    _corner_words(app, left - edge, side + 2 * edge, low, t=0)
    imgui.set_cursor_screen_pos(ImVec2(start.x, low + 2 * imgui.get_font_size() + 8 * scale))
    imgui.dummy(ImVec2(0, 0))


def _square(app: App, side: float) -> None:
    """The square itself; the hand on it sets s and t."""
    place, inset, kept = imgui.get_cursor_screen_pos(), _INSET * unit(), people.control(app)
    both = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
    imgui.invisible_button("pad", ImVec2(side, side), both)
    span = max(side - 2 * inset, 1.0)
    if imgui.is_item_clicked(1):
        people.put(app, 0.0, 0.0)
    elif imgui.is_item_active() and imgui.is_mouse_down(0):
        mouse = imgui.get_mouse_pos()
        s, t = (mouse.x - place.x - inset) / span, (place.y + side - inset - mouse.y) / span
        people.put(app, s, t)
    elif not imgui.is_item_active():
        tooltip("Drag: s to the right goes from person to person, t upwards from expression to expression "
                "(2.10). A right-click leads back to the corner below left.")  # fmt: skip
    kept = people.control(app)
    _paint(app, place, side, inset, kept.mix.s if kept.mix else None, kept.t)


def _paint(app: App, place: ImVec2, side: float, inset: float, s: float | None, t: float) -> None:
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    paint.add_rect_filled(place, (place.x + side, place.y + side), packed(c.field), 6 * scale)
    low_x, low_y, span = place.x + inset, place.y + side - inset, side - 2 * inset
    for quarter in range(5):
        along = span * quarter / 4
        line = packed(faded(c.track, 1.0 if quarter in (0, 4) else 0.5))
        if s is not None or quarter == 0:
            paint.add_line((low_x + along, low_y), (low_x + along, low_y - span), line, scale)
        if s is not None:
            paint.add_line((low_x, low_y - along), (low_x + span, low_y - along), line, scale)
    accent = c.accent if app.controls.on("people") else c.dim
    if s is None:
        for line, text in enumerate(_NOBODY):
            words, high = cut(text, span - 24 * scale), imgui.get_font_size()
            x = place.x + (side - imgui.calc_text_size(words).x) / 2
            paint.add_text((x, place.y + side / 2 + (line - 1) * high), packed(c.dim), words)
    x, y = low_x + span * (s or 0.0), low_y - span * t
    if s is not None:
        guide = packed(faded(accent, 0.45))
        paint.add_line((x, low_y), (x, low_y - span), guide, scale)
        paint.add_line((low_x, y), (low_x + span, y), guide, scale)
    held = imgui.is_item_active()
    radius = (9.0 if held else 7.5) * scale
    paint.add_circle_filled((x, y), radius, packed(c.accent_bright if held else accent), 32)
    paint.add_circle((x, y), radius, packed(c.panel), 32, 2.0 * scale)


def _corner_words(app: App, left: float, width: float, y: float, *, t: int) -> None:
    """Who and in which expression, for both corners of a side of the square."""
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    room = (width - 12 * scale) / 2
    nobody = app.controls.people.mix is None
    for s in (0, 1):
        lines = ("Nobody yet", "") if s and nobody else people.corner_words(app, s, t)
        for place, line in enumerate(lines):
            shown = cut(line, room)
            x = left + width - imgui.calc_text_size(shown).x if s else left
            at = (x, y + place * imgui.get_font_size())
            ink = c.dim if place or (s and nobody) else c.text
            paint.add_text(at, packed(ink), shown)
        _words_tip(lines, left + s * (width - room), y, room)


def _words_tip(lines: tuple[str, str], x: float, y: float, room: float) -> None:
    """What was cut off stands in a tooltip."""
    before = imgui.get_cursor_screen_pos()
    imgui.set_cursor_screen_pos(ImVec2(x, y))
    imgui.dummy(ImVec2(room, 2 * imgui.get_font_size()))
    tooltip(", ".join(line for line in lines if line))
    imgui.set_cursor_screen_pos(before)


def _pictures(app: App, left: float, right: float, top: float, side: float) -> None:
    """The four corners' faces beside the square."""
    c, scale, paint, page = colours(app), unit(), imgui.get_window_draw_list(), app.pages.people
    size, white = _PICTURE * scale, packed((1, 1, 1, 1))
    page.wanted = people.picture_keys(app)
    for (s, t), key in page.wanted.items():
        x, y = right if s else left, top if t else top + side - size
        low = (x + size, y + size)
        paint.add_rect_filled((x, y), low, packed(c.field), 6 * scale)
        texture = page.pictures.get(key)
        if texture:
            picture = imgui.ImTextureRef(texture)
            paint.add_image_rounded(picture, (x, y), low, (0, 0), (1, 1), white, 6 * scale)
