"""Paths of the emotion map's cursor: recorded, played back, kept in a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from facemorph.core.emotion import PAPER_POLES
from facemorph.core.emotion_path import Recorder
from facemorph.errors import FacemorphError
from facemorph.ui import files
from facemorph.ui.actions import tell_error
from facemorph.ui.emotion import choices, poles_of, put, usable
from facemorph.ui.emotion_poles import set_poles
from facemorph.ui.history import Snapshot
from facemorph.ui.paths import suffixed
from facemorph.ui.state import App


def playable(app: App) -> bool:
    """There is a path to run along."""
    return usable(app) and app.pages.emotion.path is not None


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
    poles = poles_of(app) or PAPER_POLES
    files.keep(
        app,
        suffixed(path, ".json"),
        "The path was not saved",
        lambda goal: write_emotion_path(goal, recorded, poles),
    )


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
