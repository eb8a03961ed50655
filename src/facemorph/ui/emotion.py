"""What the Emotion page does to the state: the cursor, the poles, and a path recorded and played back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.emotion import PAPER_POLES, Pole, emotion_weights, on_disc, spread_poles
from facemorph.core.emotion_path import Recorder
from facemorph.core.rig import EXPRESSION, Rig, Shape
from facemorph.deform.controls import EmotionControl
from facemorph.errors import FacemorphError, OptionError
from facemorph.ui.actions import tell_error
from facemorph.ui.handles import MADE
from facemorph.ui.history import Snapshot
from facemorph.ui.state import App

LEAST_POLES, MOST_POLES, USUAL_POLES = 3, 24, 8
# Wider apart, the sum of two poles' directions that reaches the circle between them grows without bound.
WIDEST_GAP_DEG = 150.0
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


def playable(app: App) -> bool:
    """There is a path to run along."""
    return usable(app) and app.pages.emotion.path is not None


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


def toggle_record(app: App) -> None:
    """Begin to record, or take what was recorded in place of the path before."""
    page = app.pages.emotion
    if page.recorder is None:
        page.player.stop()
        page.recorder = Recorder()
        return
    path, page.recorder = page.recorder.path(), None
    if path is None:
        app.messages.tell("Nothing was recorded: the cursor was not dragged.")
        return
    page.path, page.played = path, 1.0


def toggle_play(app: App) -> None:
    """Run the cursor along the path, on from where it was left, or halt it."""
    page = app.pages.emotion
    if page.player.playing:
        page.player.stop()
    elif page.path is not None and playable(app):
        if page.recorder is not None:
            toggle_record(app)
        page.player.duration_secs = page.path.duration_secs
        page.player.start(page.played if page.played < 1.0 else 0.0)
        _follow(app)


def toggle_loop(app: App) -> None:
    """Run along the path once, or there and back."""
    player = app.pages.emotion.player
    player.loop = not player.loop


def clear_path(app: App) -> None:
    """Forget the path; the cursor stays."""
    page = app.pages.emotion
    page.player.stop()
    page.path, page.played = None, 0.0


def advance(app: App, elapsed_secs: float) -> None:
    """The cursor of a path that plays, so many seconds later. This is no step of undo."""
    page = app.pages.emotion
    if not page.player.playing or page.path is None:
        return
    if not usable(app):
        page.player.stop()
        return
    page.played = page.player.advanced(elapsed_secs * page.speed)
    _follow(app)


def _follow(app: App) -> None:
    page = app.pages.emotion
    assert page.path is not None
    put(app, *page.path.at(page.played * page.path.duration_secs))
    emotion = app.controls.emotion

    def moved(snapshot: Snapshot) -> Snapshot:
        return replace(snapshot, controls=replace(snapshot.controls, emotion=emotion))

    app.history.carry(moved)


def take_sample(app: App, now_secs: float) -> None:
    """Take down where the cursor is, if that is recorded; a recorder that is full stops."""
    page = app.pages.emotion
    if page.recorder is None:
        return
    control = app.controls.emotion
    page.recorder.take(now_secs, control.x, control.y, held=page.grab == "cursor")
    if page.recorder.full:
        toggle_record(app)
        app.messages.tell("The recording is full and has stopped. Play and Save keep what there is.")


def save_path(app: App, path: Path) -> None:
    """Keep the recorded path in a file."""
    from facemorph.io.emotion_file import write_emotion_path

    recorded = app.pages.emotion.path
    if recorded is None:
        return
    path = path if path.suffix.lower() == ".json" else path.with_name(path.name + ".json")
    try:
        write_emotion_path(path, recorded, poles_of(app) or PAPER_POLES)
    except FacemorphError as error:
        tell_error(app, "The path was not saved", error)
        return
    app.messages.tell(f"Saved {path}")


def open_path(app: App, path: Path) -> None:
    """Take the path kept in a file, with its poles where the face has them; else the present ones stay."""
    from facemorph.io.emotion_file import read_emotion_path

    try:
        recorded, poles = read_emotion_path(path)
    except FacemorphError as error:
        tell_error(app, "The path was not opened", error)
        return
    clear_path(app)
    app.pages.emotion.path, app.pages.emotion.recorder = recorded, None
    known = {shape.name for shape in choices(app.rig)} if app.rig else set()
    missing = [pole.name for pole in poles if pole.name not in known]
    if not missing:
        set_poles(app, poles)
    elif app.rig is not None:
        app.messages.tell(
            f"The path is kept, its poles are not: this face has no expression {missing[0]!r}. "
            "It plays among the poles that there are."
        )
