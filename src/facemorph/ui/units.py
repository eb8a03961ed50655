"""What the FACS page does to the state: units by number, prototypes, units as text."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from facemorph.core.facs import Sides, parsed_units, prototype, units_of, units_text
from facemorph.errors import FacemorphError
from facemorph.ui import actions
from facemorph.ui.state import App

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


def copy_units(app: App) -> None:
    """The units as text, on the clipboard."""
    text = units_text(app.controls.facs)
    imgui.set_clipboard_text(text)
    app.messages.tell(f"Copied {text}")


def paste_units(app: App) -> None:
    """Units from the clipboard's text."""
    text = (imgui.get_clipboard_text() or "").strip()
    if not text:
        app.messages.tell("The clipboard holds no text. Copy units first, such as AU1+4+15.")
        return
    set_text(app, text)
