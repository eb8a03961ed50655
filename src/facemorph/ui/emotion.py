"""What the Emotion page does to the state: the map's cursor among the poles that the face has."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from facemorph.core.emotion import PAPER_POLES, Pole, emotion_weights, on_disc, spread_poles
from facemorph.core.rig import EXPRESSION, Rig, Shape
from facemorph.deform.controls import EmotionControl
from facemorph.errors import OptionError
from facemorph.ui.handles import MADE
from facemorph.ui.state import App

LEAST_POLES, USUAL_POLES = 3, 8
_PAPER_NAMES = tuple(pole.name for pole in PAPER_POLES)


def choices(rig: Rig) -> tuple[Shape, ...]:
    """What can stand round the circle: the face's expressions, and the shapes made from handles."""
    return (*rig.shapes_in(EXPRESSION), *rig.shapes_in(MADE))


def usual_poles(rig: Rig) -> tuple[Pole, ...]:
    """The paper's four where the face has them, else its first expressions; none where it has too few."""
    names = tuple(shape.name for shape in choices(rig))
    if set(_PAPER_NAMES) <= set(names):
        return PAPER_POLES
    return spread_poles(names[:USUAL_POLES]) if len(names) >= LEAST_POLES else ()


def poles_of(app: App) -> tuple[Pole, ...]:
    """The poles round the present face's map: those that were chosen, where the face has them."""
    if app.rig is None:
        return ()
    kept = app.controls.emotion.poles
    known = {shape.name for shape in choices(app.rig)}
    return kept if all(pole.name in known for pole in kept) and fits(kept) else usual_poles(app.rig)


def fits(poles: Sequence[Pole]) -> bool:
    """Whether poles make a map."""
    try:
        emotion_weights(1.0, 0.0, poles)
    except OptionError:
        return False
    return True


def usable(app: App) -> bool:
    """The face has a map."""
    return bool(poles_of(app))


def at_rest(app: App) -> bool:
    """The cursor is in the middle."""
    return app.controls.emotion.x == 0.0 and app.controls.emotion.y == 0.0


def moves(app: App) -> bool:
    """There is something to take back."""
    return usable(app) and not at_rest(app)


def weights(app: App) -> dict[str, float]:
    """Weight of each pole in the order round the circle from the top, clockwise; 0 for most of them."""
    control, poles = app.controls.emotion, poles_of(app)
    moving = emotion_weights(control.x, control.y, poles) if poles else {}
    return {pole.name: moving.get(pole.name, 0.0) for pole in clockwise(poles)}


def clockwise(poles: Sequence[Pole]) -> tuple[Pole, ...]:
    """Poles in their order from the top, clockwise."""
    return tuple(sorted(poles, key=lambda pole: (90.0 - pole.angle_deg) % 360.0))


def put(app: App, x: float, y: float) -> None:
    """The cursor to a place of the map, each of x and y from -1 to 1; nothing on a face without a map."""
    x, y = (min(max(value, -1.0), 1.0) + 0.0 for value in (x, y))
    control = EmotionControl(x, y, poles_of(app))
    if control.poles and control != app.controls.emotion:
        app.controls = replace(app.controls, emotion=control)


def move_to(app: App, x: float, y: float) -> None:
    """The cursor to a place set by hand, which ends the playing."""
    app.pages.emotion.player.stop()
    put(app, x, y)


def drag_to(app: App, x: float, y: float) -> None:
    """The cursor to where the hand is, or to the circle's nearest place."""
    move_to(app, *on_disc(x, y))


def to_pole(app: App, name: str) -> None:
    """The cursor onto a pole: that expression alone."""
    for pole in poles_of(app):
        if pole.name == name:
            angle = math.radians(pole.angle_deg)
            # On the axes neither sine nor cosine is exactly 0.
            move_to(app, round(math.cos(angle), 12), round(math.sin(angle), 12))


def to_neutral(app: App) -> None:
    """The cursor to the middle."""
    move_to(app, 0.0, 0.0)
