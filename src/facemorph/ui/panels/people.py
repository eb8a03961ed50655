"""The People page: whom the face is mixed with, between which expressions, and the pad of (2.10)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from imgui_bundle import ImVec2, imgui

from facemorph.core.morph import CURVES, checked_curve
from facemorph.core.pose import State
from facemorph.core.rig import plain_label
from facemorph.deform.controls import PeopleControl
from facemorph.ui import actions, people
from facemorph.ui.methods import OWN
from facemorph.ui.panels import people_pad
from facemorph.ui.panels.rows import method_head, pointed_at, quiet_words
from facemorph.ui.panels.value_rows import Value, button_row, choice, value_row
from facemorph.ui.regions import state_name
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.thumbnails import SIZE
from facemorph.ui.widgets import colours, cut, row_label, switch, tooltip, unit
from facemorph.ui.words import percent

_MOST_IN_ROW, _LEAST_TILE, _MOST_TILE = 6, 46.0, 84.0
_NARROW = 260.0  # below this what stands side by side goes under each other
_S_TIP = "s: from the person on the left to the one on the right, P = s1 (...) + s2 (...), s1 = 1 - s (2.10)"
_T_TIP = "t: from the expression below to the one above, in whoever is shown, t1 = 1 - t (2.10)"
_FROM_TIP = "The expression at t = 0. Choosing one here moves the face where t is less than 1."
_TO_TIP = "The expression at t = 1. What is shown becomes the start and t is 0 again: no jump (2.11)-(2.12)."
_CHOOSE_TIP = "Click: what is shown becomes the source, {name} the goal, and s is 0 again: no jump (2.11)."
_SKIN_TIP = (
    "The colours of skin and eyes blend along s too: colour = (1 - s) source + s target, "
    "each looked up at its own place of the texture (2.1.2)"
)
_CURVE_TIP = "How t eases: linear (2.5) or cosine (2.1)"
_START_TIP = "From {name} again, s is 0; the expression stays"


@dataclass(frozen=True)
class _Tile:
    """A person who can be chosen: what they are called in a mixture, and what a click does."""

    name: str
    label: str
    choose: Callable[[], None]
    picture: str = ""


def moves_face(app: App) -> bool:
    """Whether this layer changes what is drawn."""
    return app.controls.on("people") and people.moves(app)


def draw(app: App) -> None:
    """The page's contents."""
    method_head(
        app,
        "people",
        "People",
        usable=app.rig is not None,
        at_rest=app.controls.people == PeopleControl(),
        reset=people.reset,
        tip="The face itself without expression, and nobody to mix it with",
    )
    if app.rig is None:
        quiet_words("No face is open.")
        return
    imgui.begin_child("people page", ImVec2(0, 0))
    _tiles(app)
    _buttons(app)
    _way(app)
    people_pad.draw(app)
    _places(app)
    _manner(app)
    _lacking(app)
    imgui.end_child()


def _people(app: App) -> list[_Tile]:
    """The face itself, the built-in people, and who was chosen from files."""
    face = app.face
    assert face is not None
    listed = [
        _Tile(
            OWN if face.builtin and face.source == (name,) else plain_label(name),
            plain_label(name),
            partial(people.ask_builtin, app, name),
            name,
        )
        for name in app.builtins
    ]
    if all(tile.name != OWN for tile in listed):
        listed.insert(0, _Tile(OWN, face.title, partial(people.choose, app, OWN)))
    files = app.pages.people.files.items()
    return listed + [
        _Tile(name, name, partial(people.ask_files, app, paths))
        for paths, name in files
        if paths != face.source
    ]


def _tiles(app: App) -> None:
    room, gap, scale = imgui.get_content_region_avail().x, 6 * unit(), unit()
    columns = min(max(int((room + gap) // (_LEAST_TILE * scale + gap)), 1), _MOST_IN_ROW)
    width = min((room - gap * (columns - 1)) / columns, _MOST_TILE * scale)
    for place, tile in enumerate(_people(app)):
        if place % columns:
            imgui.same_line(0, gap)
        imgui.push_id(place)
        _tile(app, tile, width)
        imgui.pop_id()


def _tile(app: App, tile: _Tile, width: float) -> None:
    c, scale, place = colours(app), unit(), imgui.get_cursor_screen_pos()
    picture = width * SIZE[1] / SIZE[0]
    pressed = imgui.invisible_button("person", ImVec2(width, picture + imgui.get_font_size() + 8 * scale))
    hovered, share = imgui.is_item_hovered(), people.shares(app).get(tile.name, 0.0)
    mix = app.controls.people.mix
    goal = mix is not None and mix.target == tile.name
    asked = people.loading(app) == tile.label
    part = f"{percent(share)} of the face shown. " if share else ""
    tooltip(
        f"{tile.label}\nOpening…" if asked else f"{tile.label}\n{part}{_CHOOSE_TIP.format(name=tile.label)}"
    )
    paint, low = imgui.get_window_draw_list(), (place.x + width, place.y + picture)
    paint.add_rect_filled(place, low, packed(c.field_hovered if hovered else c.field), 5 * scale)
    texture = app.face_pictures.get(tile.picture)
    if texture:
        white = packed((1, 1, 1, 1))
        paint.add_image_rounded(imgui.ImTextureRef(texture), place, low, (0, 0), (1, 1), white, 5 * scale)
    else:
        letter = tile.label[:1].upper()
        size = imgui.calc_text_size(letter)
        at = (place.x + (width - size.x) / 2, place.y + (picture - size.y) / 2)
        paint.add_text(at, packed(c.dim), letter)
    if share > 0.0:
        # The bar under a picture is the person's share of the face.
        top, foot = low[1] + 3 * scale, low[1] + 6 * scale
        end = place.x + width * min(share, 1.0)
        paint.add_rect_filled((place.x, top), (end, foot), packed(c.accent), scale)
    if goal or hovered or asked:
        paint.add_rect(place, low, packed(c.accent if goal or asked else c.dim), 5 * scale, 2 * scale)
    label = cut("Opening…" if asked else tile.label, width)
    size = imgui.calc_text_size(label)
    ink = packed(c.text if goal or hovered or share else c.dim)
    paint.add_text((place.x + (width - size.x) / 2, low[1] + 7 * scale), ink, label)
    if pressed:
        tile.choose()


_ANOTHER, _SWAP, _START = "Another face…", "Swap", "Start again"
_ANOTHER_TIP = "Somebody from a folder or file of yours; the faces must have one topology"
_SWAP_TIP = "Both people change places; the face stays as it is"


def _buttons(app: App) -> None:
    buttons = (
        (_ANOTHER, _ANOTHER_TIP, True),
        (_SWAP, _SWAP_TIP, people.can_swap(app)),
        (_START, _START_TIP.format(name=people.called(app, OWN)), people.can_start_again(app)),
    )
    pressed = button_row(app, buttons)
    if pressed == _SWAP:
        people.swap(app)
    elif pressed == _START:
        people.start_again(app)
    elif pressed and app.native_dialogs:
        # The desktop's dialogs choose either folders or files.
        imgui.open_popup("another face")
    elif pressed:
        actions.ask_for(app, "person")
    if imgui.begin_popup("another face"):
        if imgui.menu_item_simple("A folder…"):
            actions.ask_for(app, "person folder")
        if imgui.menu_item_simple("Files…"):
            actions.ask_for(app, "person")
        imgui.end_popup()


def _way(app: App) -> None:
    """From and to which expression, in a line."""
    room, gap = _halves(10 * unit())
    kept = people.control(app)
    _expression(app, "From", kept.source, room, people.choose_source, _FROM_TIP)
    _beside(gap)
    _expression(app, "To", kept.target, room, people.choose_target, _TO_TIP)


def _narrow() -> bool:
    return bool(imgui.get_content_region_avail().x < _NARROW * unit())


def _halves(gap: float) -> tuple[float, float]:
    """How wide each of two things is that share a line, and the gap between; no gap where they cannot."""
    room = float(imgui.get_content_region_avail().x)
    return (room, 0.0) if _narrow() else ((room - gap) / 2, gap)


def _beside(gap: float) -> None:
    if gap:
        imgui.same_line(0, gap)


def _expression(
    app: App, word: str, state: State, room: float, choose: Callable[[App, str], None], tip: str
) -> None:
    words, chosen = people.expressions(app), state_name(state)
    label = imgui.calc_text_size(word).x + 8 * unit()
    row_label(app, word, label, tip, bright=False)
    imgui.same_line(0, 0)
    shown = people.expression_words(app, state)
    arrow = imgui.get_frame_height() + 2 * imgui.get_style().frame_padding.x
    if chosen not in words:
        words = {chosen: cut(shown, room - label - arrow), **words}
    new = choice(app, f"people {word}", chosen, words, f"{shown}\n{tip}", room - label)
    if new != chosen:
        choose(app, new)


def _places(app: App) -> None:
    """s and t as sliders and numbers."""
    kept = people.control(app)
    imgui.begin_disabled(kept.mix is None)
    s = value_row(app, Value("people s", "s, person", kept.mix.s if kept.mix else 0.0, 0.0, 1.0, _S_TIP))
    imgui.end_disabled()
    place, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    t = value_row(app, Value("people t", "t, expression", kept.t, 0.0, 1.0, _T_TIP))
    if pointed_at(place, room):
        names = dict.fromkeys([*kept.source, *kept.target])
        app.methods.hovered = {n: kept.target.get(n, 0.0) - kept.source.get(n, 0.0) for n in names}
    people.put(app, s, t)


def _manner(app: App) -> None:
    """How t eases, and whether colours are mixed too."""
    kept, (room, gap) = app.controls.people, _halves(16 * unit())
    label, wide = imgui.calc_text_size("Curve").x + 8 * unit(), imgui.get_frame_height() * 1.1
    row_label(app, "Curve", label, _CURVE_TIP, bright=False)
    imgui.same_line(0, 0)
    curves: dict[str, str] = {curve: curve.capitalize() for curve in CURVES}
    curve = choice(app, "people curve", kept.curve, curves, _CURVE_TIP, room - label)
    _beside(gap)
    row_label(app, "Skin too", room - wide - 8 * unit(), _SKIN_TIP, bright=kept.skins)
    imgui.same_line(0, 8 * unit())
    skins = switch(app, "skins", kept.skins)
    tooltip(_SKIN_TIP)
    if curve != kept.curve:
        people.set_curve(app, checked_curve(curve))
    if skins != kept.skins:
        people.toggle_skins(app)


def _lacking(app: App) -> None:
    """Which expressions cannot be chosen, and why."""
    by_person: dict[str, list[str]] = {}
    rig = app.rig
    for name, person in people.lacked(app).items():
        by_person.setdefault(person, []).append(rig.shape(name).label if rig else name)
    for person, labels in by_person.items():
        more = f" and {len(labels) - 3} more" if len(labels) > 3 else ""
        quiet_words(f"{person} has no {', '.join(labels[:3])}{more}: left out of the lists above.")
