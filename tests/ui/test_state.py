"""Undo, settings, messages, jobs, playing, words: what the window knows, without drawing anything."""

from __future__ import annotations

import itertools
import json
import os
import sys
import threading
import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from facemorph.core.morph import eased
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import FaceFolderError, JobCancelledError
from facemorph.ui import actions, files
from facemorph.ui.chord import Chord
from facemorph.ui.commands import commands
from facemorph.ui.history import MOST_FACES, MOST_STEPS, History
from facemorph.ui.jobs import Jobs
from facemorph.ui.messages import NEWS_SECS, Messages
from facemorph.ui.paths import completed, entries, expanded
from facemorph.ui.playback import Playback
from facemorph.ui.purposes import PURPOSES
from facemorph.ui.settings import Settings, config_folder, load_settings, save_settings
from facemorph.ui.state import App, Face, Viewport, first_pose
from facemorph.ui.theme import DARK, LIGHT, contrast
from facemorph.ui.thumbnails import cache_folder
from facemorph.ui.words import state_words


@pytest.fixture
def app(rig: Rig) -> App:
    state = App()
    state.show(Face(rig, ("ball",)))
    state.history.settle(state.snapshot(), busy=False)
    return state


def settle(app: App, *, busy: bool = False) -> None:
    app.history.settle(app.snapshot(), busy=busy)


def test_choosing_an_expression_moves_nothing(app: App) -> None:
    app.pose = replace(app.pose, t=0.6)
    before = app.face.rig.positions(app.pose)
    actions.choose_expression(app, "angry")
    assert app.pose.t == 0.0
    assert app.pose.target == {"angry": 1.0}
    assert abs(app.face.rig.positions(app.pose) - before).max() < 1e-5


def test_the_source_set_by_hand_leaves_the_slider(app: App) -> None:
    actions.set_slider(app, 0.5)
    actions.start_from(app, "sad")
    assert app.pose.source == {"sad": 1.0}
    assert app.pose.t == 0.5


def test_a_mixture_is_named_in_plain_words(app: App) -> None:
    app.pose = replace(app.pose, t=0.62, curve="linear")
    actions.choose_expression(app, "angry")
    assert state_words(app.face.rig, app.pose.source) == "Happy 62 %"
    assert state_words(app.face.rig, {}) == "Neutral"
    assert state_words(app.face.rig, {"a": 0.5, "b": 0.4, "c": 0.3}).endswith("1 more")


def test_a_drag_is_one_step_of_undo(app: App) -> None:
    for t in (0.1, 0.2, 0.3):
        app.pose = replace(app.pose, t=t)
        settle(app, busy=True)
    settle(app)
    actions.undo(app)
    assert app.pose.t == 0.0
    actions.redo(app)
    assert app.pose.t == 0.3
    assert app.history.undo_words == "slider to 0.30"


def test_a_new_step_after_undo_forgets_what_was_undone(app: App) -> None:
    actions.set_weight(app, "AU1", 0.5)
    settle(app)
    actions.undo(app)
    actions.set_weight(app, "AU2", 0.5)
    settle(app)
    assert app.history.redo_words == ""
    assert app.history.undo_words == "AU2"


def test_undo_brings_back_the_face_before(app: App, rig: Rig) -> None:
    first = app.face
    actions.set_weight(app, "AU1", 0.5)
    settle(app)
    app.show(Face(rig, ("another",)))
    settle(app)
    actions.undo(app)
    assert app.face is first
    assert app.pose.weights == {"AU1": 0.5}


def test_undo_holds_few_faces_and_not_endless_steps(rig: Rig) -> None:
    app, history = App(), History()
    for place in range(MOST_FACES + 4):
        app.show(Face(rig, (str(place),)))
        history.settle(app.snapshot(), busy=False)
    assert len({id(snapshot.face) for snapshot, _ in history._past}) <= MOST_FACES
    for place in range(MOST_STEPS + 50):
        app.pose = replace(app.pose, t=place / 1000)
        history.settle(app.snapshot(), busy=False)
    assert len(history._past) == MOST_STEPS


def test_shapes_switched_off_are_out_of_the_face_and_not_forgotten(app: App) -> None:
    actions.set_weight(app, "jawOpen", 0.8)
    actions.toggle_shapes(app)
    assert app.shown_pose.weights == {}
    assert app.pose.weights == {"jawOpen": 0.8}
    actions.toggle_shapes(app)
    assert app.shown_pose.weights == {"jawOpen": 0.8}


def test_a_face_without_expressions_does_not_play(rig: Rig) -> None:
    app = App()
    app.show(Face(Rig(rig.neutral, (), rig.deltas[:0]), ("x",)))
    actions.toggle_play(app)
    assert not app.playback.playing
    assert first_pose(app.face.rig, app.settings).target == {}


def test_playing_runs_once_and_stops_at_the_goal() -> None:
    play = Playback(duration_secs=2.0)
    play.start(0.5)
    assert play.advanced(0.5) == pytest.approx(0.75)
    assert play.advanced(5.0) == 1.0
    assert not play.playing
    play.start(1.0)
    assert play.advanced(0.5) == pytest.approx(0.25)


def test_a_loop_runs_there_and_back_without_a_jump() -> None:
    play = Playback(loop=True, duration_secs=1.0)
    play.start(0.0)
    seen = [play.advanced(0.1) for _ in range(45)]
    assert max(abs(b - a) for a, b in itertools.pairwise(seen)) < 0.1001
    assert max(seen) > 0.99
    assert min(seen[15:]) < 0.01
    play.loop = False
    assert play.phase > 0
    while play.playing:
        last = play.advanced(0.1)
    assert last in (0.0, 1.0)


def test_playing_follows_time_not_frames() -> None:
    few, many = Playback(duration_secs=1.5), Playback(duration_secs=1.5)
    few.start(0.0)
    many.start(0.0)
    coarse = few.advanced(0.9)
    for _ in range(90):
        fine = many.advanced(0.01)
    assert coarse == pytest.approx(fine)
    assert eased(coarse, "cosine") == pytest.approx(eased(fine, "cosine"))


def test_settings_come_back_as_they_were_kept(tmp_path: Path) -> None:
    settings = Settings(window_size=[900, 700], theme="light", recent=[["/a/b"], ["/c", "/d"]], loop=True)
    settings.equal_luminance, settings.luminance, settings.luminance_of = True, 0.31, "picture"
    save_settings(tmp_path, settings)
    assert load_settings(tmp_path) == (settings, "")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "null",
        '{"version": 99}',
        "\x00\xff",
        "[" * 100000,
        '{"version": 1, "window_size": "big"}',
    ],
)
def test_a_broken_settings_file_is_kept_aside_and_the_start_goes_on(tmp_path: Path, text: str) -> None:
    (tmp_path / "settings.json").write_bytes(text.encode("latin-1"))
    settings, problem = load_settings(tmp_path)
    assert settings == Settings()
    assert "settings" in problem
    assert (tmp_path / "settings-broken.json").read_bytes() == text.encode("latin-1")
    assert load_settings(tmp_path) == (Settings(), "")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("window_size", [1, 1]),
        ("window_size", [1e9, 3]),
        ("window_size", [1280.5, 800.25]),
        ("window_size", [True, 800]),
        ("left_width", 10**400),
        ("left_width", -(10**400)),
        ("right_width", float("inf")),
        ("theme", "pink"),
        ("light", "candle"),
        ("equal_luminance", 1),
        ("luminance", 0.9),
        ("luminance_of", "neck"),
        ("recent", [[]]),
        ("recent", [["a"], [3]]),
        ("left_width", float("nan")),
        ("right_width", True),
        ("loop", 1),
        ("duration_secs", -1),
        ("curve", "cubic"),
        ("hint_seen", None),
        ("shut_sections", "all"),
        ("last_folder", 3),
    ],
)
def test_one_unusable_setting_costs_only_itself(tmp_path: Path, name: str, value: object) -> None:
    data = {"version": 1, "maximized": True, name: value}
    (tmp_path / "settings.json").write_text(json.dumps(data))
    settings, problem = load_settings(tmp_path)
    assert settings == Settings(maximized=True)
    assert name in problem


def test_the_newest_file_heads_the_recent_list_once() -> None:
    settings = Settings()
    for name in ("a", "b", "a"):
        settings.remember((name,))
    assert settings.recent == [["a"], ["b"]]
    for place in range(40):
        settings.remember((f"n{place}",))
    assert len(settings.recent) == 12


def test_news_goes_by_itself_and_errors_stay() -> None:
    secs = [0.0]
    messages = Messages(lambda: secs[0])
    messages.tell("saved")
    messages.fail("broken", "details")
    assert messages.next_change_secs() == NEWS_SECS
    secs[0] = NEWS_SECS + 1
    messages.expire()
    assert [m.text for m in messages.shown] == ["broken"]
    assert messages.shown[0].copied == "broken\n\ndetails"
    messages.close(messages.shown[0])
    assert messages.shown == []


def test_the_same_error_twice_is_told_once() -> None:
    messages = Messages()
    messages.fail("broken")
    messages.fail("broken")
    assert len(messages.shown) == 1


def finished(jobs: Jobs) -> None:
    for _ in range(1000):
        jobs.finish()
        if not jobs.running:
            return
        time.sleep(0.005)
    raise AssertionError("a job never ended")


def test_a_job_hands_over_its_result_in_the_windows_thread() -> None:
    woken, got = threading.Event(), []
    jobs = Jobs(woken.set)
    jobs.start(
        "Work",
        lambda progress: threading.get_ident(),
        lambda r: got.append((r, threading.get_ident())),
        got.append,
    )
    assert woken.wait(10)
    assert got == []
    finished(jobs)
    worker, window = got[0]
    assert worker != window == threading.get_ident()


def test_a_cancelled_job_hands_over_nothing() -> None:
    got, began, gate, stopped = [], threading.Event(), threading.Event(), threading.Event()

    def work(progress):
        began.set()
        gate.wait(10)
        try:
            progress(0.5, "half")
        except JobCancelledError:
            stopped.set()
            raise

    jobs = Jobs()
    job = jobs.start("Work", work, got.append, got.append)
    assert began.wait(10)
    job.cancel()
    gate.set()
    finished(jobs)
    assert stopped.is_set()
    assert got == []


def test_a_new_job_takes_the_place_of_its_kind() -> None:
    got, gate = [], threading.Event()
    jobs = Jobs()
    jobs.start("Old", lambda p: gate.wait(10) and "old", got.append, got.append, kind="face")
    jobs.start("New", lambda p: "new", got.append, got.append, kind="face")
    gate.set()
    finished(jobs)
    assert got == ["new"]


def test_an_error_of_ours_is_told_in_its_own_words_and_a_fault_with_its_traceback() -> None:
    app = App()
    actions.tell_error(app, "x was not opened", FaceFolderError("there is no mesh."))
    actions.tell_error(app, "y was not opened", ZeroDivisionError("oh"))
    ours, fault = app.messages.shown
    assert ours.text == "x was not opened. there is no mesh."
    assert "ZeroDivisionError" in fault.copied
    assert fault.error


@pytest.mark.parametrize("colours", [DARK, LIGHT])
@pytest.mark.parametrize("ground", ["panel", "popup", "field", "backdrop"])
@pytest.mark.parametrize("ink", ["text", "dim", "error"])
def test_text_stands_out(colours, ground: str, ink: str) -> None:
    assert contrast(getattr(colours, ink), getattr(colours, ground)) >= 4.5


@pytest.mark.parametrize("colours", [DARK, LIGHT])
def test_the_accent_stands_out(colours) -> None:
    assert contrast(colours.accent, colours.popup) >= 4.5
    assert contrast(colours.on_accent, colours.accent) >= 4.5
    assert contrast(colours.on_accent, colours.accent_bright) >= 4.5
    assert contrast(colours.knob, colours.panel) >= 3.0


def test_contrast_is_that_of_the_standard() -> None:
    assert contrast((0, 0, 0, 1), (1, 1, 1, 1)) == pytest.approx(21.0)
    assert contrast((0x77 / 255,) * 3 + (1,), (1, 1, 1, 1)) == pytest.approx(4.48, abs=0.01)


def test_chords_are_read_and_shown() -> None:
    chord = Chord.parse("Ctrl+Shift+Z")
    assert chord == Chord("Z", ctrl=True, shift=True)
    assert chord.shown in ("Ctrl+Shift+Z", "Cmd+Shift+Z")
    with pytest.raises(ValueError, match="no chord"):
        Chord.parse("Hyper+X")


def test_typing_a_text_keeps_its_own_keys() -> None:
    typed = {
        text: Chord.parse(text).typed for text in ("W", "Space", "Ctrl+Z", "Ctrl+K", "F1", "F", "Ctrl+S")
    }
    assert typed == {
        "W": True, "Space": True, "Ctrl+Z": True, "Ctrl+K": False, "F1": False, "F": True, "Ctrl+S": False,
    }  # fmt: skip


def test_a_typed_path_is_completed_as_far_as_all_agree(tmp_path: Path) -> None:
    for name in ("face_one", "face_two", ".hidden"):
        (tmp_path / name).mkdir()
    (tmp_path / "face.obj").touch()
    (tmp_path / "face.txt").touch()
    found = entries(f"{tmp_path}/fa", (".obj",))
    assert [entry.name for entry in found] == ["face_one", "face_two", "face.obj"]
    assert completed(f"{tmp_path}/fa", found) == f"{tmp_path}/face"
    assert completed(f"{tmp_path}/face_o", entries(f"{tmp_path}/face_o", ())) == f"{tmp_path}/face_one/"
    assert entries(f"{tmp_path}/nowhere/", (".obj",)) == []
    assert [e.name for e in entries(f"{tmp_path}/.h", ())] == [".hidden"]


def test_home_and_quotes_in_a_typed_path() -> None:
    assert expanded("~/x") == Path.home() / "x"
    assert expanded("'/a/../b'") == Path("/b")


@pytest.mark.skipif(sys.platform == "win32", reason="there a home is not looked up among the users")
def test_a_user_without_a_home_has_defaults_and_no_cache(tmp_path: Path, monkeypatch) -> None:
    for name in (*(name for name in os.environ if name.startswith("XDG_")), "HOME"):
        monkeypatch.delenv(name, raising=False)
    for name in ("FACEMORPH_CONFIG_DIR", "FACEMORPH_CACHE_DIR"):
        monkeypatch.delenv(name, raising=False)

    def nobody(number: int) -> None:
        raise KeyError(number)

    monkeypatch.setattr("pwd.getpwuid", nobody)
    monkeypatch.chdir(tmp_path)
    assert config_folder() is None
    assert cache_folder() is None
    assert expanded("~/x") == tmp_path / "x"
    assert expanded("/a/x") == Path("/a/x")


def test_a_viewports_places() -> None:
    view = Viewport(100, 50, 400, 200, 2.0)
    assert view.size == (800, 400)
    assert view.centred(300, 150) == (0.0, 0.0)
    assert view.centred(300, 50) == (0.0, 1.0)
    assert view.pixel(100, 50) == (0.0, 0.0)
    assert view.contains(100, 50)
    assert not view.contains(500, 100)


def test_pose_of_a_fresh_face_is_neutral_with_a_goal(rig: Rig) -> None:
    pose = first_pose(rig, Settings(curve="linear"))
    assert pose == Pose(target={"happy": 1.0}, curve="linear")


def test_every_command_that_asks_for_a_file_finds_what_it_is_asked_for(app: App) -> None:
    asked = [c.action for c in commands(app) if isinstance(c.action, partial)]
    purposes = {action.keywords["purpose"] for action in asked if action.func is actions.ask_for}
    assert purposes and purposes <= PURPOSES.keys()


def test_a_face_is_opened_by_the_description_in_its_folder(
    app: App, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[list[str]] = []
    monkeypatch.setattr(files, "open_source", lambda app, source: opened.append(source))
    PURPOSES["open"].take(app, [tmp_path / "face.toml"])
    PURPOSES["open"].take(app, [tmp_path / "face.obj"])
    PURPOSES["open"].take(app, [tmp_path / "face.toml", tmp_path / "b.obj"])
    assert opened == [
        [str(tmp_path)],
        [str(tmp_path / "face.obj")],
        [str(tmp_path / "face.toml"), str(tmp_path / "b.obj")],
    ]
