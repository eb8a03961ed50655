"""The smooth surface in the window: made beside it, kept to its face, chosen by what frames take."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest

from facemorph.core import subdivision
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.gl.describe import Graphics
from facemorph.gl.form import Form
from facemorph.ui import smoothing
from facemorph.ui.settings import Settings, load_settings, save_settings
from facemorph.ui.smoothing import MOST_AUTOMATIC, ROOM_SECS, TOO_LONG_SECS, Automatic, vertices_after
from facemorph.ui.state import Face
from tests.ui.harness import Offscreen, ball_rig

CARD = Graphics("3.3", "A card", "Somebody", False, "shader", 2048, 16384, 4)


def drawn_level(window: Offscreen) -> int:
    surface = window.session.renderer.surface
    assert surface is not None
    return surface.form.level


def face_pixels(window: Offscreen) -> np.ndarray:
    return window.session.renderer.read()


class Slow:
    """In place of `Form.of`: the work waits until it is let go."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.go, self.made, self._of = threading.Event(), [], Form.of
        monkeypatch.setattr(smoothing.Form, "of", self)

    def __call__(self, mesh, level=0, progress: Progress = lambda *_: None, ahead=None) -> Form:
        if level:
            assert self.go.wait(20.0)
            assert threading.current_thread() is not threading.main_thread()
        self.made.append((mesh, level))
        return self._of(mesh, level, progress, ahead)


def test_a_level_is_made_beside_the_window_and_then_shown(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow, app = Slow(monkeypatch), window.app
    plain = face_pixels(window)
    window.run("Smooth surface, level 1")
    window.frames(4)
    assert app.jobs.of_kind("smooth") is not None
    assert drawn_level(window) == 0
    assert np.array_equal(face_pixels(window), plain)
    slow.go.set()
    window.until(lambda: drawn_level(window) == 1)
    assert len(slow.made) == 1
    assert app.settings.smooth_surface == "1"
    assert (face_pixels(window) != plain).any()
    window.run("Smooth surface, level 2")
    window.until(lambda: drawn_level(window) == 2)
    window.run("Smooth surface off")
    assert drawn_level(window) == 0
    assert app.form is None
    assert np.array_equal(face_pixels(window), plain)


def test_another_face_starts_plain_and_is_then_smoothed_too(window: Offscreen) -> None:
    app = window.app
    window.run("Smooth surface, level 1")
    window.until(lambda: drawn_level(window) == 1)
    other = ball_rig(name="Other", rings=10)
    app.arriving = Face(other, ("Other",), builtin=True)
    window.frame()
    assert drawn_level(window) == 0
    window.until(lambda: drawn_level(window) == 1)
    assert app.form is not None
    assert app.form.of_file is other.neutral
    # The same head with a shape more needs nothing new.
    form = app.form
    app.face = replace(app.face, rig=Rig(other.neutral, other.shapes[:2], other.deltas[:2]))
    window.frame()
    assert drawn_level(window) == 1
    assert app.form is form


def test_what_is_being_made_for_a_face_that_is_gone_is_stopped(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow, app = Slow(monkeypatch), window.app
    window.run("Smooth surface, level 2")
    first = app.jobs.of_kind("smooth")
    other = ball_rig(name="Other", rings=10)
    app.arriving = Face(other, ("Other",), builtin=True)
    window.frames(2)
    assert first is not None
    assert first.cancelled
    slow.go.set()
    window.until(lambda: drawn_level(window) == 2)
    assert app.form is not None
    assert app.form.of_file is other.neutral


def test_work_that_was_stopped_is_not_begun_again_until_it_is_asked_for(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow, app = Slow(monkeypatch), window.app
    window.run("Smooth surface, level 1")
    job = app.jobs.of_kind("smooth")
    assert job is not None
    job.cancel()
    slow.go.set()
    window.until(lambda: not app.jobs.running)
    window.frames(3)
    assert not app.jobs.running
    assert drawn_level(window) == 0
    window.run("Smooth surface off")
    window.run("Smooth surface, level 1")
    window.until(lambda: drawn_level(window) == 1)


def test_a_face_too_large_for_a_level_is_told_and_stays(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subdivision, "MOST_VERTICES", 20_000)
    app = window.app
    window.run("Smooth surface, level 2")
    window.until(lambda: bool(app.messages.shown))
    assert "at most 20,000 vertices" in app.messages.shown[-1].text
    assert drawn_level(window) == 0
    window.frames(5)
    assert len(app.messages.shown) == 1
    assert not app.jobs.running


def test_the_choice_is_kept(tmp_path) -> None:
    save_settings(tmp_path, Settings(smooth_surface="2"))
    assert load_settings(tmp_path)[0].smooth_surface == "2"
    save_settings(tmp_path, Settings(smooth_surface="3"))
    kept, problem = load_settings(tmp_path)
    assert kept.smooth_surface == "auto"
    assert "smooth_surface" in problem


def judged(automatic: Automatic, rig: Rig, shown: int, secs: list[float], graphics: Graphics = CARD) -> int:
    level = 0
    for value in secs:
        level = automatic.judge(rig.neutral, graphics, shown, value)
    return level


def frames(secs: float) -> list[float]:
    """So many frames of nearly the same time."""
    return [secs * (1.0 + 1e-6 * k) for k in range(20)]


def test_automatic_smooths_where_frames_leave_room(rig: Rig) -> None:
    growth = vertices_after(rig.neutral) / rig.neutral.vertex_count
    assert judged(Automatic(), rig, 0, frames(0.98 * ROOM_SECS / growth)) == 1
    assert judged(Automatic(), rig, 0, frames(1.02 * ROOM_SECS / growth)) == 0
    assert judged(Automatic(), rig, 0, frames(1e-4)[:4]) == 0, "a few frames say nothing yet"
    assert judged(Automatic(), rig, 0, [1e-4] * 50) == 0, "one frame asked about often is one frame"
    assert judged(Automatic(), rig, 0, frames(1e-4), replace(CARD, software=True)) == 0


def test_automatic_goes_back_for_good_where_frames_then_take_too_long(rig: Rig) -> None:
    automatic = Automatic()
    assert judged(automatic, rig, 0, frames(1e-4)) == 1
    assert judged(automatic, rig, 1, frames(0.9 * TOO_LONG_SECS)) == 1
    assert judged(automatic, rig, 1, [5.0]) == 1, "one long frame is no reason"
    assert judged(automatic, rig, 1, frames(1.1 * TOO_LONG_SECS)) == 0
    assert judged(automatic, rig, 0, frames(1e-4)) == 0
    other = ball_rig(rings=10)
    assert judged(automatic, other, 0, frames(1e-4)) == 1, "another face is judged anew"


def test_automatic_leaves_large_faces_alone() -> None:
    large = ball_rig(("happy",), (), (), rings=170)
    assert vertices_after(large.neutral) > MOST_AUTOMATIC
    assert judged(Automatic(), large, 0, frames(1e-6)) == 0


def test_the_window_is_automatic_and_plain_where_opengl_runs_on_the_cpu(window: Offscreen) -> None:
    assert window.app.settings.smooth_surface == "auto"
    if not window.app.graphics.software:
        pytest.skip("a graphics card draws here")
    window.frames(10)
    assert drawn_level(window) == 0
    assert not window.app.jobs.running
