"""Which expressions stand round the emotion map, and where on the circle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from facemorph.core.emotion import Pole, spread_poles
from facemorph.core.rig import Rig
from facemorph.ui.emotion import LEAST_POLES, choices, clockwise, fits, poles_of, usual_poles
from facemorph.ui.state import App

MOST_POLES = 24
# Wider apart, the sum of two poles' directions that reaches the circle between them grows without bound.
WIDEST_GAP_DEG = 150.0


def set_poles(app: App, poles: Sequence[Pole]) -> None:
    """Other poles round the circle; the cursor stays. Poles that make no map are not taken."""
    if fits(poles):
        app.controls = replace(app.controls, emotion=replace(app.controls.emotion, poles=tuple(poles)))


def to_usual_poles(app: App) -> None:
    """The paper's poles again, or the first expressions of a face without them."""
    if app.rig is not None:
        set_poles(app, usual_poles(app.rig))


def most_poles(rig: Rig) -> int:
    """How many of the face's expressions can stand round the circle."""
    return min(len(choices(rig)), MOST_POLES)


def evenly_spread(app: App) -> bool:
    """Whether the poles stand as `spread_evenly` puts them."""
    poles = clockwise(poles_of(app))
    return poles == spread_poles([pole.name for pole in poles])


def spread_evenly(app: App) -> None:
    """The same poles in their order, evenly apart."""
    set_poles(app, spread_poles([pole.name for pole in clockwise(poles_of(app))]))


def stand_everywhere(app: App) -> None:
    """Every expression of the face, evenly apart."""
    if app.rig is not None:
        set_poles(app, spread_poles([shape.name for shape in choices(app.rig)][:MOST_POLES]))


def toggle_pole(app: App, name: str) -> None:
    """An expression into the widest gap of the circle, or out of it; the others keep their places.

    Where taking it out leaves a gap too wide, the rest is spread evenly.
    """
    poles = clockwise(poles_of(app))
    if any(pole.name == name for pole in poles):
        rest = [pole for pole in poles if pole.name != name]
        if len(rest) >= LEAST_POLES:
            set_poles(app, rest if _gaps_fit(rest) else spread_poles([pole.name for pole in rest]))
    elif len(poles) < MOST_POLES:
        set_poles(app, [*poles, Pole(name, _middle_of_widest_gap(poles))])


def move_pole(app: App, name: str, angle_deg: float) -> None:
    """A pole to another place on the circle, to whole degrees; where it does not fit, it stays."""
    poles = poles_of(app)
    moved = [Pole(p.name, _snapped(angle_deg)) if p.name == name else p for p in poles]
    if moved != list(poles) and _gaps_fit(moved):
        set_poles(app, moved)


def _snapped(angle_deg: float) -> float:
    near = round(angle_deg / 15.0) * 15.0
    return (near if abs(angle_deg - near) <= 2.5 else float(round(angle_deg))) % 360.0


def _gaps_fit(poles: Sequence[Pole]) -> bool:
    between = gaps(poles)
    return min(between) >= min(12.0, 180.0 / len(poles)) and max(between) <= WIDEST_GAP_DEG


def gaps(poles: Sequence[Pole]) -> list[float]:
    """From each pole to the next, clockwise from the top, degrees."""
    ring = clockwise(poles)
    return [(a.angle_deg - b.angle_deg) % 360.0 for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)]


def _middle_of_widest_gap(poles: Sequence[Pole]) -> float:
    ring, between = clockwise(poles), gaps(poles)
    # Gaps that were halved alike differ by rounding only.
    widest = next(place for place, gap in enumerate(between) if gap > max(between) - 1e-6)
    return (ring[widest].angle_deg - between[widest] / 2.0) % 360.0
