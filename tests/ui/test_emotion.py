"""The Emotion page, driven by fed mouse events: the cursor, the poles and their pictures, paths."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.emotion import PAPER_POLES, Pole, emotion_weights, on_disc, spread_poles
from facemorph.core.emotion_path import LONGEST_SECS, EmotionPath
from facemorph.core.facs import Sides
from facemorph.core.rig import Rig, Shape
from facemorph.ui import actions, emotion, emotion_paths, emotion_poles, units
from facemorph.ui.emotion_page import EmotionPage, Pad
from facemorph.ui.settings import Settings
from facemorph.ui.state import Face
from tests.ui.harness import Offscreen, ball_rig

FACE = (450, 380)


def page_of(window: Offscreen) -> EmotionPage:
    return window.app.pages.emotion


def pad_of(window: Offscreen) -> Pad:
    pad = page_of(window).pad
    assert pad is not None
    return pad


def cursor(window: Offscreen) -> tuple[float, float]:
    return window.app.controls.emotion.x, window.app.controls.emotion.y


def on_pole(window: Offscreen, name: str) -> tuple[float, float]:
    """A place of the window on a pole's picture."""
    (pole,) = (p for p in emotion.poles_of(window.app) if p.name == name)
    pad, angle = pad_of(window), math.radians(pole.angle_deg)
    away = pad.radius + 20.0
    return pad.x + away * math.cos(angle), pad.y - away * math.sin(angle)


def pictures_done(window: Offscreen) -> bool:
    return not window.session.poles.busy(window.app)


def opened(rig: Rig) -> Offscreen:
    return Offscreen(rig, settings=Settings(right_page="Emotion"))


def asleep(window: Offscreen) -> bool:
    """Whether nothing wants a frame: messages may still be waiting to go."""
    window.frames(2)
    return window.session.wants_frame_in() != 0.0


@pytest.fixture
def window(opengl: None, rig: Rig) -> Iterator[Offscreen]:
    with opened(rig) as screen:
        screen.until(lambda: pictures_done(screen))
        screen.frames(2)
        yield screen


def test_a_drag_moves_the_cursor_and_the_face_by_the_papers_rule(window: Offscreen) -> None:
    pad, rig = pad_of(window), window.app.rig
    assert rig is not None
    for x, y in ((0.5, 0.25), (-0.3, 0.6), (-0.5, -0.5), (0.7, -0.1), (0.0, 0.8)):
        window.frames(30)  # soon after the drag before, a press would be a double-click's second
        window.drag((pad.x + 3.0, pad.y - 25.0), pad.place(x, y))
        assert cursor(window) == pytest.approx((x, y), abs=1.0 / pad.radius)
        cx, cy = cursor(window)
        weights = {"sad": max(cx, 0), "afraid": max(-cx, 0), "happy": max(cy, 0), "angry": max(-cy, 0)}
        expected = {name: weight for name, weight in weights.items() if weight > 0.0}
        assert emotion_weights(cx, cy) == pytest.approx(expected)
        np.testing.assert_allclose(window.app.scene().positions(rig), rig.positions(expected), atol=1e-4)
        assert window.app.shown_state() == pytest.approx(expected)


def test_the_face_follows_while_the_hand_moves(window: Offscreen) -> None:
    pad = pad_of(window)
    before = window.pixels_now().copy()
    window.move(*pad.place(0.2, 0.2))
    window.press()
    window.move(*pad.place(0.3, 0.9))
    assert cursor(window) == pytest.approx((0.3, 0.9), abs=0.02)
    assert np.abs(window.pixels_now().astype(int) - before)[100:600, 100:800].max() > 20
    window.release()


def test_a_hand_beyond_the_circle_leads_along_it(window: Offscreen) -> None:
    pad = pad_of(window)
    window.drag(pad.place(0.2, 0.2), pad.place(1.6, 0.8))
    assert cursor(window) == pytest.approx(on_disc(1.6, 0.8), abs=0.02)
    assert math.hypot(*cursor(window)) == pytest.approx(1.0)


def test_a_drag_is_one_step_of_undo(window: Offscreen) -> None:
    pad = pad_of(window)
    window.drag(pad.place(0.2, 0.2), pad.place(0.6, 0.3), steps=12)
    there = cursor(window)
    window.key("Z", ctrl=True)
    assert cursor(window) == (0.0, 0.0)
    window.key("Z", ctrl=True, shift=True)
    assert cursor(window) == there


@pytest.mark.parametrize("how", ["double-click", "right-click", "reset", "snap", "command"])
def test_ways_back_to_neutral(window: Offscreen, how: str) -> None:
    pad = pad_of(window)
    window.drag(pad.place(0.2, 0.2), pad.place(0.6, 0.3))
    assert cursor(window) != (0.0, 0.0)
    if how == "double-click":
        window.double_click(*pad.place(-0.4, 0.3))
    elif how == "right-click":
        window.click(*pad.place(-0.4, 0.3), button=1)
    elif how == "reset":
        window.click(1240, 125)
    elif how == "snap":
        window.drag(pad.place(0.6, 0.3), (pad.x + 3, pad.y - 2))
    else:
        window.run("Emotion: to neutral")
    assert cursor(window) == (0.0, 0.0)
    rig = window.app.rig
    assert rig is not None
    np.testing.assert_array_equal(window.app.scene().positions(rig), rig.neutral.positions)


def test_x_and_y_are_typed_and_kept_within_the_command_lines_limits(window: Offscreen) -> None:
    for name, typed, expected in (
        ("emotion x", "0.25", (0.25, 0.0)),
        ("emotion y", "-0,5", (0.25, -0.5)),
        ("emotion x", "7", (1.0, -0.5)),
        ("emotion y", "-9", (1.0, -1.0)),
        ("emotion x", "none", (1.0, -1.0)),
    ):
        window.app.type_into(name)
        window.frames(2)
        window.type(typed)
        window.key("enter")
        assert cursor(window) == expected, typed
    # Beyond the circle the rule goes on as it is.
    assert emotion.weights(window.app) == {"happy": 0.0, "sad": 1.0, "angry": 1.0, "afraid": 0.0}


def test_a_number_below_the_pad_is_clicked_and_typed(window: Offscreen) -> None:
    pad = pad_of(window)
    row = pad.y + 192.0
    window.click(975, row)
    window.frames(2)
    assert window.app.typing == "emotion x"
    window.type("0.5")
    window.key("enter")
    assert cursor(window) == (0.5, 0.0)


def test_a_click_on_a_pole_shows_that_expression_alone(window: Offscreen) -> None:
    for name in ("happy", "afraid", "angry", "sad"):
        window.click(*on_pole(window, name))
        assert window.app.shown_state() == pytest.approx({name: 1.0})
    assert emotion.poles_of(window.app) == PAPER_POLES


def test_a_pole_is_dragged_round_the_circle_and_back_by_undo(window: Offscreen) -> None:
    pad = pad_of(window)
    angle = math.radians(62.0)
    goal = (pad.x + 1.3 * pad.radius * math.cos(angle), pad.y - 1.3 * pad.radius * math.sin(angle))
    window.drag(on_pole(window, "happy"), goal)
    poles = {pole.name: pole.angle_deg for pole in emotion.poles_of(window.app)}
    assert poles == {"sad": 0.0, "happy": 60.0, "afraid": 180.0, "angry": 270.0}
    assert cursor(window) == (0.0, 0.0)
    window.drag(pad.place(0.2, 0.2), pad.place(0.5, 0.5))
    x, y = cursor(window)
    expected = emotion_weights(x, y, emotion.poles_of(window.app))
    assert window.app.shown_state() == pytest.approx(expected)
    window.key("Z", ctrl=True)
    window.key("Z", ctrl=True)
    assert emotion.poles_of(window.app) == PAPER_POLES


def test_a_pole_does_not_come_to_stand_where_the_map_would_break(window: Offscreen) -> None:
    app = window.app
    emotion_poles.move_pole(app, "happy", 2.0)
    emotion_poles.move_pole(app, "happy", 20.0)  # leaves 160 degrees to afraid
    assert emotion.poles_of(app) == PAPER_POLES
    emotion_poles.move_pole(app, "happy", 35.0)
    assert app.controls.emotion.poles[1] == Pole("happy", 35.0)


def test_more_poles_come_into_the_widest_gaps_and_go_again(window: Offscreen) -> None:
    app = window.app
    emotion_poles.toggle_pole(app, "surprised")
    emotion_poles.toggle_pole(app, "disgusted")
    poles = {pole.name: pole.angle_deg for pole in app.controls.emotion.poles}
    assert poles == {
        "happy": 90.0, "surprised": 45.0, "sad": 0.0, "disgusted": 315.0, "angry": 270.0, "afraid": 180.0
    }  # fmt: skip
    emotion_poles.spread_evenly(app)
    names = ["happy", "surprised", "sad", "disgusted", "angry", "afraid"]
    assert app.controls.emotion.poles == spread_poles(names)
    emotion_poles.to_usual_poles(app)
    assert app.controls.emotion.poles == PAPER_POLES
    emotion_poles.stand_everywhere(app)
    assert len(app.controls.emotion.poles) == 6
    window.frames(3)


def test_three_poles_are_the_fewest_and_always_make_a_map(window: Offscreen) -> None:
    app = window.app
    for name in ("sad", "happy", "afraid", "angry"):
        emotion_poles.toggle_pole(app, name)
        window.frames(2)
    # Without sad half a circle would be empty, so the rest is spread; nothing goes after that.
    assert app.controls.emotion.poles == spread_poles(["happy", "angry", "afraid"])
    assert app.messages.shown == []
    assert "emotion" not in app.controls.off


def test_a_button_puts_an_expression_on_the_circle_as_one_step(window: Offscreen) -> None:
    window.move(1090, 600)
    for _ in range(6):
        window.wheel(-5)
    window.frames(3)
    for y in range(740, 600, -5):
        window.click(960, y)
        names = {pole.name for pole in emotion.poles_of(window.app)}
        if names == {"happy", "sad", "angry", "afraid", "surprised"}:
            break
        emotion_poles.to_usual_poles(window.app)
        window.frames(2)
    else:
        raise AssertionError("no button there puts Surprised on the circle")
    window.key("Z", ctrl=True)
    assert emotion.poles_of(window.app) == PAPER_POLES


def test_a_face_without_the_papers_poles_has_its_own_round_the_circle(opengl: None) -> None:
    names = ("joy", "grief", "rage", "fear", "awe")
    with opened(ball_rig(names)) as window:
        assert emotion.poles_of(window.app) == spread_poles(names)
        pad = pad_of(window)
        window.drag(pad.place(0.2, 0.2), pad.place(0.1, 0.9))
        expected = emotion_weights(*cursor(window), spread_poles(names))
        assert window.app.shown_state() == pytest.approx(expected)
        assert set(expected) == {"joy", "grief"}
        assert "emotion" not in window.app.controls.off


def test_of_many_expressions_the_first_stand_round_the_circle(opengl: None) -> None:
    names = tuple(f"look {k} with a rather long name" for k in range(30))
    with opened(ball_rig(names, rings=6)) as window:
        assert len(emotion.poles_of(window.app)) == emotion.USUAL_POLES
        emotion_poles.stand_everywhere(window.app)
        window.frames(3)
        assert len(emotion.poles_of(window.app)) == emotion_poles.MOST_POLES
        emotion_poles.toggle_pole(window.app, names[-1])
        assert len(emotion.poles_of(window.app)) == emotion_poles.MOST_POLES


@pytest.mark.parametrize("names", [(), ("happy",), ("happy", "sad")])
def test_with_fewer_than_three_expressions_the_page_says_so(opengl: None, names: tuple[str, ...]) -> None:
    with opened(ball_rig(names, rings=6)) as window:
        assert page_of(window).pad is None
        for title in ("Emotion: to neutral", "Emotion: record or stop", "Emotion: play or pause"):
            window.run(title)
        emotion_poles.stand_everywhere(window.app)
        emotion.put(window.app, 0.5, 0.5)
        window.frames(3)
        assert page_of(window).recorder is None
        assert window.app.shown_state() == {}


def test_a_shape_made_from_handles_can_stand_round_the_circle(opengl: None) -> None:
    rig = ball_rig(("happy", "sad"), rings=6)
    made = replace(rig, shapes=(*rig.shapes[:2], *(Shape(s.name, s.label, "made") for s in rig.shapes[2:])))
    with opened(made) as window:
        assert len(emotion.poles_of(window.app)) == len(rig.shapes)


def test_no_face_is_no_fault(opengl: None) -> None:
    with Offscreen(settings=Settings(right_page="Emotion")) as window:
        window.run("Emotion: record or stop")
        window.frames(2)
        assert page_of(window).recorder is None


def test_every_pole_gets_a_picture_of_this_face_one_a_frame(opengl: None, rig: Rig) -> None:
    with opened(rig) as window:
        counts = []
        for _ in range(12):
            counts.append(len(page_of(window).pictures))
            window.frame()
        assert np.diff(counts).max() <= 1
        assert set(page_of(window).pictures) == {pole.name for pole in PAPER_POLES}
        assert len(set(page_of(window).pictures.values())) == 4
        emotion_poles.toggle_pole(window.app, "surprised")
        window.until(lambda: pictures_done(window))
        assert "surprised" in page_of(window).pictures


def test_pictures_are_of_the_face_that_is_open(window: Offscreen, opengl: None) -> None:
    first = page_of(window).pictured
    shown = pixels_of(window, "happy")
    other = ball_rig(name="Other", rings=16)
    other = replace(other, deltas=np.ascontiguousarray(other.deltas[::-1]))
    window.app.arriving = Face(other, ("other",))
    window.until(lambda: page_of(window).pictured is other.neutral and pictures_done(window))
    window.frames(2)
    assert np.abs(pixels_of(window, "happy") - shown).max() > 20
    window.key("Z", ctrl=True)
    window.until(lambda: page_of(window).pictured is first and pictures_done(window))
    window.frames(2)
    assert np.abs(pixels_of(window, "happy") - shown).max() <= 2


def pixels_of(window: Offscreen, name: str) -> np.ndarray:
    x, y = (round(value) for value in on_pole(window, name))
    return window.pixels_now()[y - 12 : y + 12, x - 12 : x + 12].astype(int)


def test_drawing_pictures_leaves_the_face_as_it_was(opengl: None, rig: Rig) -> None:
    with opened(rig) as window:
        window.until(lambda: pictures_done(window))
        window.frames(2)
        with_pictures = window.pixels_now()[60:700, 20:880].copy()
        actions.show_page(window.app, "Shapes")
        window.frames(3)
        np.testing.assert_array_equal(window.pixels_now()[60:700, 20:880], with_pictures)


def test_the_window_sleeps_on_the_page(window: Offscreen) -> None:
    assert asleep(window)
    pad = pad_of(window)
    window.drag(pad.place(0.2, 0.2), pad.place(0.5, 0.5))
    assert asleep(window)


def record(window: Offscreen, places: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Record a drag through places of the map, a frame each; gives where the cursor was."""
    emotion_paths.toggle_record(window.app)
    window.frames(2)
    pad, there = pad_of(window), []
    window.move(*pad.place(*places[0]))
    window.press()
    there.append(cursor(window))
    for place in places[1:]:
        window.move(*pad.place(*place))
        there.append(cursor(window))
    window.release()
    window.frames(20)
    emotion_paths.toggle_record(window.app)
    window.frames(2)
    return there


WAY = [(0.3 + 0.6 * math.cos(k / 6), 0.5 * math.sin(k / 5)) for k in range(40)]


def test_a_recorded_drag_plays_back_in_its_own_time(window: Offscreen) -> None:
    there = record(window, WAY)
    path = page_of(window).path
    assert path is not None
    step = window.io.delta_time
    assert path.duration_secs == pytest.approx((len(WAY) - 1) * step)
    for k, place in enumerate(there):
        assert path.at(k * step) == pytest.approx(place, abs=1e-9)
    emotion.to_neutral(window.app)
    window.frames(2)
    window.run("Emotion: play or pause")
    seen = [cursor(window)]
    while page_of(window).player.playing:
        window.frame()
        seen.append(cursor(window))
    # `run` draws two frames after the command; the first shows the path's first step.
    for k, place in enumerate(seen[:-1]):
        assert place == pytest.approx(path.at((k + 2) * step), abs=1e-6)
    assert cursor(window) == pytest.approx(there[-1])
    expected = emotion_weights(*cursor(window))
    assert window.app.shown_state() == pytest.approx(expected)


def test_recording_is_one_step_of_undo_and_playing_none(window: Offscreen) -> None:
    record(window, WAY)
    emotion.to_neutral(window.app)
    window.frames(2)
    words, steps = window.app.history.undo_words, len(window.app.history._past)
    emotion_paths.toggle_play(window.app)
    window.frames(10)
    units.set_unit(window.app, 1, Sides.both(0.5))
    window.frames(80)
    assert not page_of(window).player.playing
    end = cursor(window)
    assert end != (0.0, 0.0)
    assert len(window.app.history._past) == steps + 1
    window.key("Z", ctrl=True)
    assert window.app.controls.facs == {}
    assert window.app.history.undo_words == words
    window.key("Z", ctrl=True)
    window.key("Z", ctrl=True)
    assert cursor(window) == (0.0, 0.0)


def test_the_window_is_awake_while_it_records_or_plays_and_only_then(window: Offscreen) -> None:
    emotion_paths.toggle_record(window.app)
    assert asleep(window)  # nothing runs before the first press
    pad = pad_of(window)
    window.move(*pad.place(0.2, 0.1))
    window.press()
    window.move(*pad.place(0.6, 0.1))
    assert window.session.wants_frame_in() == 0.0
    window.release()
    assert window.session.wants_frame_in() == 0.0
    emotion_paths.toggle_record(window.app)
    assert asleep(window)
    emotion_paths.toggle_play(window.app)
    assert window.session.wants_frame_in() == 0.0
    window.frames(60)
    assert asleep(window)


def test_speed_and_loop(window: Offscreen) -> None:
    page = page_of(window)
    page.path = EmotionPath(((0.0, 0.0, 0.5), (1.0, 1.0, 0.5)))
    page.speed = 2.0
    emotion_paths.toggle_play(window.app)
    window.frames(15)
    assert cursor(window) == pytest.approx((0.5, 0.5))
    emotion_paths.toggle_loop(window.app)
    window.frames(20)
    # There and back: 35 frames at double speed are 70/60 of the way.
    assert cursor(window) == pytest.approx((1.0 - 10 / 60, 0.5))
    assert page.player.playing
    emotion_paths.toggle_play(window.app)
    window.frames(5)
    assert cursor(window) == pytest.approx((1.0 - 10 / 60, 0.5))


def test_a_hand_on_the_pad_ends_the_playing(window: Offscreen) -> None:
    page_of(window).path = EmotionPath(((0.0, 0.0, 0.5), (9.0, 1.0, 0.5)))
    emotion_paths.toggle_play(window.app)
    window.frames(3)
    pad = pad_of(window)
    window.drag(pad.place(-0.2, -0.2), pad.place(-0.5, -0.5))
    assert not page_of(window).player.playing
    assert cursor(window) == pytest.approx((-0.5, -0.5), abs=0.02)


@pytest.mark.parametrize("how", ["undo", "reset", "open"])
def test_undo_reset_and_another_face_end_the_playing(window: Offscreen, how: str) -> None:
    app = window.app
    emotion.put(app, 0.5, 0.5)
    window.frames(2)
    page_of(window).path = EmotionPath(((0.0, 0.0, 0.5), (9.0, 1.0, 0.5)))
    emotion_paths.toggle_play(app)
    window.frames(3)
    if how == "open":
        app.arriving = Face(ball_rig(name="Other", rings=8), ("other",))
        window.frames(3)
    else:
        window.run("Undo" if how == "undo" else "Reset face")
    assert not page_of(window).player.playing
    assert cursor(window) == (0.0, 0.0)
    assert page_of(window).path is not None


def test_a_full_recording_stops_itself_and_says_so(window: Offscreen) -> None:
    emotion_paths.toggle_record(window.app)
    pad = pad_of(window)
    window.drag(pad.place(0.2, 0.1), pad.place(0.6, 0.1))
    window.clock.secs += LONGEST_SECS
    window.frames(2)
    assert page_of(window).recorder is None
    assert page_of(window).path is not None
    assert "full" in window.app.messages.shown[-1].text


def test_recording_nothing_keeps_the_path_before(window: Offscreen) -> None:
    record(window, WAY)
    path = page_of(window).path
    emotion_paths.toggle_record(window.app)
    window.frames(3)
    emotion_paths.toggle_record(window.app)
    assert page_of(window).path is path
    assert "Nothing was recorded" in window.app.messages.shown[-1].text


def test_buttons_record_play_and_clear(window: Offscreen) -> None:
    pad = pad_of(window)
    row = next(y for y in range(600, 700, 5) if recording_begins(window, y))
    window.drag(pad.place(0.2, 0.1), pad.place(0.6, 0.4))
    window.click(960, row)
    assert page_of(window).path is not None
    window.click(1034, row)
    assert page_of(window).player.playing
    window.click(960, row + 35)
    assert page_of(window).path is None
    assert not page_of(window).player.playing


def recording_begins(window: Offscreen, y: float) -> bool:
    window.click(960, y)
    return page_of(window).recorder is not None


def test_a_path_is_saved_and_opened_through_the_chooser(window: Offscreen, tmp_path: Path) -> None:
    app = window.app
    record(window, WAY)
    emotion_poles.toggle_pole(app, "surprised")
    window.frames(2)
    path, poles = page_of(window).path, emotion.poles_of(app)
    assert path is not None
    app.settings.last_folder = str(tmp_path)
    actions.ask_for(app, "save path")
    window.frames(3)
    window.key("enter")
    (saved,) = tmp_path.glob("*.json")
    emotion_paths.clear_path(app)
    emotion_poles.to_usual_poles(app)
    actions.ask_for(app, "open path")
    window.frames(3)
    window.type(saved.name)
    window.key("enter")
    window.frames(2)
    again = page_of(window).path
    assert again is not None
    np.testing.assert_allclose(again.samples, path.samples, atol=1e-6)
    assert emotion.poles_of(app) == poles


def test_a_file_that_is_no_path_changes_nothing_and_says_why(window: Offscreen, tmp_path: Path) -> None:
    record(window, WAY)
    path = page_of(window).path
    for text in ("{}", "[[[", '{"format": "facemorph emotion path 1", "poles": [], "samples": []}'):
        (tmp_path / "bad.json").write_text(text)
        emotion_paths.open_path(window.app, tmp_path / "bad.json")
        window.frames(2)
        assert page_of(window).path is path
        assert "bad.json" in window.app.messages.shown[-1].text


def test_a_path_among_poles_that_the_face_lacks_plays_among_its_own(opengl: None, tmp_path: Path) -> None:
    from facemorph.io.emotion_file import write_emotion_path

    recorded = EmotionPath(((0.0, 0.0, 0.5), (1.0, 1.0, 0.5)))
    write_emotion_path(tmp_path / "a.json", recorded, PAPER_POLES)
    names = ("joy", "grief", "rage")
    with opened(ball_rig(names, rings=8)) as window:
        emotion_paths.open_path(window.app, tmp_path / "a.json")
        window.frames(2)
        assert page_of(window).path == recorded
        assert emotion.poles_of(window.app) == spread_poles(names)
        assert "'sad'" in window.app.messages.shown[-1].text
        emotion_paths.toggle_play(window.app)
        window.frames(70)
        assert cursor(window) == pytest.approx((1.0, 0.5))


def test_switched_off_the_map_moves_nothing(window: Offscreen) -> None:
    emotion.put(window.app, 0.5, 0.5)
    window.frames(2)
    window.click(995, 125)
    assert "emotion" in window.app.controls.off
    rig = window.app.rig
    assert rig is not None
    np.testing.assert_array_equal(window.app.scene().positions(rig), rig.neutral.positions)
    assert cursor(window) == (0.5, 0.5)


def test_every_page_has_a_command_that_opens_it(window: Offscreen) -> None:
    from facemorph.ui.panels import right_tabs

    for tab in right_tabs():
        window.app.panels_hidden = True
        window.run(tab.title)
        assert window.app.settings.right_page == tab.title
        assert not window.app.panels_hidden


def test_turning_the_face_while_the_page_is_on_show_moves_no_cursor(window: Offscreen) -> None:
    azimuth = window.app.camera.azimuth_deg
    window.drag(FACE, (FACE[0] + 60, FACE[1]))
    assert window.app.camera.azimuth_deg != azimuth
    assert cursor(window) == (0.0, 0.0)


def test_poles_that_the_face_lacks_switch_the_page_off_with_a_message(window: Offscreen) -> None:
    app = window.app
    lost = replace(app.controls.emotion, y=1.0, poles=spread_poles(("grin", "sad", "angry")))
    app.controls = replace(app.controls, emotion=lost, facs={12: Sides.both(0.5)})
    window.frames(2)
    assert app.controls.off == {"emotion"}
    assert "Emotion is switched off. no shape is called 'grin'" in app.messages.shown[-1].text
    assert app.shown_state() == {"AU12": 0.5}
