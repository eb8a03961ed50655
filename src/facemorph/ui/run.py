"""From the command to the open window and back: start, loop, end."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.pose import Pose
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError
from facemorph.resources import builtin_faces
from facemorph.ui import dialogs, files, fit_files, window
from facemorph.ui.jobs import Jobs
from facemorph.ui.session import Session
from facemorph.ui.settings import Settings, config_folder, load_settings, save_settings
from facemorph.ui.state import App, Face, first_pose
from facemorph.ui.thumbnails import Thumbnails

Source = str | Path | Sequence[str | Path] | None


def run_window(
    source: Source, weights: Mapping[str, float], *, platform: str = "", frames: int | None = None
) -> int:
    """Open the window, run its loop (for `frames` frames in tests), keep the settings; the exit status."""
    folder = config_folder()
    settings, problem = load_settings(folder) if folder else (Settings(), "")
    app = App(settings=settings, jobs=Jobs(), builtins=tuple(builtin_faces()))
    if problem:
        app.messages.fail(problem)
    first = FirstFace(app, source, weights)
    screen = None
    try:
        screen = window.Window(_size(settings.window_size), maximized=settings.maximized, platform=platform)
        app.jobs.wake = window.wake
        app.native_dialogs = platform != "null" and dialogs.available()
        session = new_session(app, screen)
        try:
            _loop(app, session, screen, frames)
        finally:
            _remember(app, screen, folder)
            session.close()
    finally:
        app.jobs.close()
        if screen is not None:
            screen.close()
    if first.error is not None:
        raise first.error
    return 0


def new_session(app: App, screen: window.Window) -> Session:
    """A session that draws with the window's context."""
    from facemorph.gl import Renderer

    return Session(app, Renderer(screen.ctx), Thumbnails(screen.ctx))


class FirstFace:
    """The face to start with, read while the window is still being made.

    Unlike a face opened later, a first one that cannot be read ends the program with its error: there
    is no face to go on with, and whoever typed the command reads the answer beside it.
    """

    def __init__(self, app: App, source: Source, weights: Mapping[str, float]) -> None:
        self.error: FacemorphError | None = None
        self._weights = dict(weights)
        paths, builtin = _paths(source, app.builtins)
        if not paths:
            return

        def work(progress: Progress) -> Rig:
            return files.load(paths, progress, builtin=builtin)

        def done(rig: Rig) -> None:
            try:
                Pose.of(self._weights).coefficients(rig.names)
            except FacemorphError as error:
                self._fail(app, error)
                return
            app.arriving = Face(rig, paths, builtin)
            app.arriving_pose = replace(first_pose(rig, app.settings), weights=self._weights)

        def failed(error: BaseException) -> None:
            if not isinstance(error, FacemorphError):
                raise error
            self._fail(app, error)

        app.jobs.start(f"Opening {Path(paths[0]).name or paths[0]}", work, done, failed, kind="face")

    def _fail(self, app: App, error: FacemorphError) -> None:
        self.error = error
        app.quit = True


def _loop(app: App, session: Session, screen: window.Window, frames: int | None) -> None:
    awake, count, title, visible = window.Awake(), 0, "", False
    while not (app.quit or screen.wants_to_close()) and (frames is None or count < frames):
        if screen.minimized:
            # Nobody sees a frame; work that ends in the meantime may still end the program.
            screen.wait(None)
            app.jobs.finish()
            awake.happened()
            continue
        screen.frame(session.frame, app)
        count += 1
        if not visible and (app.face is not None or app.jobs.shown() or not app.jobs.running):
            screen.show()
            visible = True
        wanted = f"{app.face.title} – facemorph" if app.face else window.TITLE
        if wanted != title:
            screen.title(wanted)
            title = wanted
        if screen.wait(awake.wait_secs(session.wants_frame_in())) or window.hand_is_on():
            awake.happened()
        open_dropped(app, screen.dropped)


def open_dropped(app: App, dropped: list[str]) -> None:
    """Open what was dropped on the window: a folder, a file, or a neutral with its shapes."""
    if dropped:
        paths = [str(Path(path)) for path in dropped]
        dropped.clear()
        if not fit_files.take_dropped(app, paths):
            files.open_source(app, paths)


def _paths(source: Source, builtins: tuple[str, ...]) -> tuple[tuple[str, ...], bool]:
    """What to open (nothing where there is nothing), and whether it is a built-in's name."""
    if source is None:
        return builtins[:1], True
    if isinstance(source, str | Path):
        if str(source) in builtins and not isinstance(source, Path):
            return (str(source),), True
        return (_whole_path(source),), False
    return tuple(_whole_path(part) for part in source), False


def _whole_path(path: str | Path) -> str:
    """A path that still means the same face when the next start is in another folder.

    What is not there stays as it was typed: the error then speaks of that.
    """
    return str(Path(path).absolute()) if Path(path).exists() else str(path)


def _size(size: list[int]) -> tuple[int, int]:
    return size[0], size[1]


def _remember(app: App, screen: window.Window, folder: Path | None) -> None:
    app.settings.maximized = screen.maximized
    if not (screen.maximized or screen.minimized):
        app.settings.window_size = list(screen.size)
    if folder is None:
        return
    # The window is going: there is nobody left to tell, and the next start takes the defaults.
    with contextlib.suppress(FacemorphError):
        save_settings(folder, app.settings)
