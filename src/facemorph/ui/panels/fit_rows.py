"""What the page Fit is made of: the row of steps, rows for meshes, the one bright button."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from facemorph.ui import fonts
from facemorph.ui.fit_plan import Piece
from facemorph.ui.panels.messages import breakable
from facemorph.ui.state import App
from facemorph.ui.theme import Rgba, packed
from facemorph.ui.widgets import colours, cut, icon_button, tooltip, unit

_TITLE = 22.0


@dataclass(frozen=True)
class Step:
    """One of the steps: its title, what came of it, whether it is done and can be opened, what it is for."""

    title: str
    summary: str
    done: bool
    usable: bool
    tip: str


@dataclass(frozen=True)
class Way:
    """What leads on from a step: the words on its button, none for no button, and what a press does."""

    words: str
    tip: str
    usable: bool
    go: Callable[[], None]
    calm: bool = False


def stepper(app: App, steps: Sequence[Step], opened: int) -> int:
    """The steps in a row, numbered, and under them the title of the one that is open; gives that."""
    c, scale = colours(app), unit()
    place, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    cell, radius = room / len(steps), 10.0 * scale
    height = 2 * radius
    middle = place.y + radius
    first, last = place.x + cell / 2, place.x + room - cell / 2
    imgui.get_window_draw_list().add_line((first, middle), (last, middle), packed(c.line), 2 * scale)
    for number, step in enumerate(steps):
        imgui.set_cursor_screen_pos((place.x + number * cell, place.y))
        imgui.begin_disabled(not step.usable)
        if imgui.invisible_button(f"step {number}", ImVec2(cell, height)):
            opened = number
        imgui.end_disabled()
        hovered = imgui.is_item_hovered(imgui.HoveredFlags_.allow_when_disabled)
        facts = f": {step.summary}" if step.summary else ""
        if hovered:
            imgui.set_tooltip(f"{number + 1}. {step.title}{facts}\n{step.tip}")
        x = place.x + (number + 0.5) * cell
        _number(app, step, number, (x, middle), radius, opened=number == opened, hovered=hovered)
    imgui.set_cursor_screen_pos((place.x, place.y + height + 6 * scale))
    imgui.push_font(None, _TITLE)
    imgui.text_unformatted(steps[opened].title)
    imgui.pop_font()
    return opened


def _number(
    app: App, step: Step, number: int, at: tuple[float, float], radius: float, *, opened: bool, hovered: bool
) -> None:
    c, paint = colours(app), imgui.get_window_draw_list()
    paint.add_circle_filled(at, radius + 3 * unit(), packed(c.panel))
    if step.done and not opened:
        paint.add_circle_filled(at, radius, packed(c.accent))
        tick(*at, radius, c.on_accent)
        return
    if opened:
        paint.add_circle_filled(at, radius, packed(c.accent_bright))
    elif hovered and step.usable:
        paint.add_circle_filled(at, radius, packed(c.field_hovered))
    ink = c.on_accent if opened else c.text if step.usable else c.dim
    if not opened:
        paint.add_circle(at, radius, packed(c.dim if step.usable else c.line), thickness=1.5 * unit())
    text = str(number + 1)
    size = imgui.calc_text_size(text)
    paint.add_text((at[0] - size.x / 2, at[1] - size.y / 2), packed(ink), text)


def tick(x: float, y: float, size: float, ink: Rgba) -> None:
    """A check mark around a place."""
    paint, thick = imgui.get_window_draw_list(), max(size * 0.2, 1.0)
    bend = (x - size * 0.12, y + size * 0.36)
    paint.add_line((x - size * 0.45, y + size * 0.02), bend, packed(ink), thick)
    paint.add_line(bend, (x + size * 0.48, y - size * 0.36), packed(ink), thick)


def wrapped_text(text: str, ink: Rgba | None = None) -> None:
    """Words in as many lines as they need."""
    imgui.push_text_wrap_pos(0.0)
    if ink is not None:
        imgui.push_style_color(imgui.Col_.text, ink)
    imgui.text_unformatted(text)
    if ink is not None:
        imgui.pop_style_color()
    imgui.pop_text_wrap_pos()


def bright_button(app: App, words: str, tip: str, *, usable: bool = True, width: float = -1.0) -> bool:
    """The button that leads on."""
    if not usable:
        imgui.begin_disabled()
        imgui.button(words, ImVec2(width, 0))
        imgui.end_disabled()
        tooltip(tip)
        return False
    c = colours(app)
    imgui.push_style_color(imgui.Col_.button, c.accent)
    imgui.push_style_color(imgui.Col_.button_hovered, c.accent_bright)
    imgui.push_style_color(imgui.Col_.button_active, c.accent_bright)
    imgui.push_style_color(imgui.Col_.text, c.on_accent)
    pressed = imgui.button(words, ImVec2(width, 0))
    imgui.pop_style_color(4)
    tooltip(tip)
    return bool(pressed)


def piece_row(app: App, piece: Piece, *, selected: bool, selectable: bool, brief: bool = False) -> str:
    """A mesh with what was found, where `brief` only if it does not fit; gives "select", "remove" or ""."""
    c, scale = colours(app), unit()
    side, room = imgui.get_frame_height(), imgui.get_content_region_avail().x
    place, asked = imgui.get_cursor_screen_pos(), ""
    width = room - side - 4 * scale
    pressed = imgui.invisible_button(f"piece {piece.key}", ImVec2(width, side))
    hovered = imgui.is_item_hovered()
    tooltip(f"{breakable(str(piece.path))}\n{piece.finding.words}")
    paint = imgui.get_window_draw_list()
    if (selected or hovered) and selectable:
        ground = c.field if selected else c.field_hovered
        paint.add_rect_filled(place, (place.x + width, place.y + side), packed(ground), 5 * scale)
    _standing(app, piece, place.x + 13 * scale, place.y + side / 2)
    text_y = place.y + (side - imgui.get_font_size()) / 2
    left = 28 * scale
    paint.add_text((place.x + left, text_y), packed(c.text), cut(piece.name, width - left - 4 * scale))
    imgui.same_line(0, 4 * scale)
    if icon_button(app, fonts.CLOSE, f"take out {piece.key}", "Take it out; the file stays where it is"):
        asked = "remove"
    if brief and piece.fitted is not None and not selected:
        return asked or ("select" if pressed and selectable else "")
    imgui.indent(left)
    bad = piece.finding.standing == "unusable"
    words = piece.finding.words or "Comparing it with the template…"
    wrapped_text(words, c.error if bad else c.dim)
    imgui.unindent(left)
    return asked or ("select" if pressed and selectable else "")


def _standing(app: App, piece: Piece, x: float, y: float) -> None:
    """A tick where it fits, a mark where something is to be done."""
    c, scale, paint = colours(app), unit(), imgui.get_window_draw_list()
    if piece.fitted is not None:
        tick(x, y, 10 * scale, c.accent)
        return
    if piece.finding.standing == "checking":
        paint.add_circle((x, y), 4 * scale, packed(c.dim), thickness=1.5 * scale)
        return
    ink = c.error if piece.finding.standing == "unusable" else c.text
    size = imgui.calc_text_size("!")
    paint.add_circle((x, y), 8 * scale, packed(ink), thickness=1.4 * scale)
    paint.add_text((x - size.x / 2, y - size.y / 2), packed(ink), "!")
