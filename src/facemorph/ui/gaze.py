"""Where the eyes look: the units 61 to 64 as one place, which the lids follow."""

from __future__ import annotations

from facemorph.core.facs import Sides
from facemorph.ui import units
from facemorph.ui.state import App

# The person's left, which stands on the right of a face seen from the front; then right, up, down.
LEFT, RIGHT, UP, DOWN = GAZE_UNITS = (61, 62, 63, 64)


def available(app: App) -> bool:
    """The present face's eyes can look everywhere."""
    return set(GAZE_UNITS) <= set(units.available(app))


def place(app: App) -> tuple[float, float]:
    """(x, y) from -1 to 1: x to the person's left, y up; (0, 0) is straight ahead."""
    weights = {number: sides.weight for number, sides in app.controls.facs.items()}
    x = weights.get(LEFT, 0.0) - weights.get(RIGHT, 0.0)
    return x, weights.get(UP, 0.0) - weights.get(DOWN, 0.0)


def look(app: App, x: float, y: float) -> None:
    """Look to a place of the pad, kept from -1 to 1."""
    x, y = (min(max(value, -1.0), 1.0) for value in (x, y))
    wanted = {LEFT: max(x, 0.0), RIGHT: max(-x, 0.0), UP: max(y, 0.0), DOWN: max(-y, 0.0)}
    units.set_units(app, {**app.controls.facs, **{n: Sides.both(weight) for n, weight in wanted.items()}})
