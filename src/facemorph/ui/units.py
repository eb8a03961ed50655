"""What the FACS page does to the state: units by number, prototypes, units as text."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from facemorph.core.facs import Sides, parsed_units, prototype, units_of, units_text
from facemorph.errors import FacemorphError
from facemorph.ui import actions, handles, regions
from facemorph.ui.methods import OWN
from facemorph.ui.state import App
from facemorph.ui.words import METHOD_WORDS, state_words

# A weight that moves nothing by as much as a pixel.
NEGLIGIBLE = 1e-3

# Positive is the person's left, which stands on the right of a face seen from the front.
Balance = float


def split(sides: Sides) -> tuple[float, Balance]:
    """The stronger side's weight, and the balance: 0 both alike, 1 the left alone, -1 the right alone."""
    if abs(sides.left) >= abs(sides.right):
        return sides.left, 1.0 - sides.right / sides.left if sides.left else 0.0
    return sides.right, sides.left / sides.right - 1.0


def joined(weight: float, balance: Balance) -> Sides:
    """The sides for a weight and a balance; the inverse of `split`."""
    return Sides(weight * (1.0 + min(balance, 0.0)), weight * (1.0 - max(balance, 0.0)))


def available(app: App) -> tuple[int, ...]:
    """The units of the present face."""
    return units_of(app.rig) if app.rig else ()


def has_units(app: App) -> bool:
    """The face has FACS units."""
    return bool(available(app))


def has_moving_units(app: App) -> bool:
    """Some unit of the FACS page is not at rest."""
    return bool(app.controls.facs)


def set_units(app: App, units: dict[int, Sides]) -> None:
    """All units at once; those at rest are left out."""
    moving = {number: sides for number, sides in units.items() if sides != Sides.both(0.0)}
    app.controls = replace(app.controls, facs=moving)


def set_unit(app: App, number: int, sides: Sides) -> None:
    """One unit; the others stay."""
    set_units(app, {**app.controls.facs, number: sides})


def reset_units(app: App) -> None:
    """Every unit at rest."""
    set_units(app, {})


def set_prototype(app: App, emotion: str) -> None:
    """The units of an emotion, in place of those there are."""
    set_units(app, prototype(emotion, available(app)))


def set_text(app: App, text: str) -> None:
    """Units from text as FACS writes them; a text that is none changes nothing and says why."""
    try:
        units = parsed_units(text, available(app))
    except FacemorphError as error:
        actions.tell_error(app, "The units were not taken over", error)
        return
    set_units(app, units)


def shown_units(app: App) -> dict[int, Sides]:
    """The units that make up the shown face: those of the FACS page, and units set as plain shapes."""
    units = dict(app.controls.facs) if app.controls.on("facs") else {}
    state = _shown_state(app)
    for number in available(app):
        sides = units.get(number, Sides.both(0.0))
        more = state.get(f"AU{number}", 0.0) - sides.weight
        if abs(more) >= NEGLIGIBLE:
            units[number] = Sides(sides.left + more, sides.right + more)
    return {number: sides for number, sides in sorted(units.items()) if sides != Sides.both(0.0)}


def beside_units(app: App) -> str:
    """What of the shown face no unit says, in words: "Happy 40 %, regions"; "" where units say it all."""
    if app.rig is None:
        return ""
    named = {f"AU{number}" for number in available(app)}
    others = {
        name: weight
        for name, weight in _shown_state(app).items()
        if name not in named and abs(weight) >= NEGLIGIBLE
    }
    parts = [state_words(app.rig, others, most=3)] if others else []
    mix = app.controls.people.mix
    moving = {
        "people": mix is not None and any(w for name, w in mix.weights().items() if name != OWN),
        "handles": not handles.at_rest(app),
        "regions": not regions.at_rest(app),
    }
    parts += [METHOD_WORDS[method] for method, moves in moving.items() if moves and app.controls.on(method)]
    return ", ".join(parts)


def _shown_state(app: App) -> dict[str, float]:
    """Shape name -> weight of the face as all pages set it, whatever a page shows in its place."""
    pose = app.methods.scene(app).pose
    state = pose.way_state()
    for name, weight in pose.weights.items():
        state[name] = state.get(name, 0.0) + weight
    return state


def copy_help(app: App) -> str:
    """What copying would put on the clipboard, and what it would leave out."""
    beside = beside_units(app)
    help_text = "Copy the units of the present face as text: this page's and those set on the page Shapes"
    return f"{help_text}.\nNot in the text, for no unit says it: {beside}" if beside else help_text


def copy_units(app: App) -> None:
    """The shown face's units as text, on the clipboard; what they leave out is told."""
    text, beside = units_text(shown_units(app)), beside_units(app)
    left_out = f" No unit says the rest: {beside}." if beside else ""
    if not text:
        app.messages.tell(f"The face is made of no FACS units.{left_out}")
        return
    imgui.set_clipboard_text(text)
    app.messages.tell(f"Copied {text}.{left_out}" if left_out else f"Copied {text}")


def paste_units(app: App) -> None:
    """Units from the clipboard's text."""
    text = (imgui.get_clipboard_text() or "").strip()
    if not text:
        app.messages.tell("The clipboard holds no text. Copy units first, such as AU1+4+15.")
        return
    set_text(app, text)
