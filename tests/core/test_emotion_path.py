"""A path over the emotion map: taken down with its times, and found again at each of them."""

from __future__ import annotations

import math

import pytest

from facemorph.core.emotion_path import LONGEST_SECS, MOST_SAMPLES, EmotionPath, Recorder, thinned
from facemorph.errors import OptionError


def recorded(*steps: tuple[float, float, float, bool]) -> Recorder:
    recorder = Recorder()
    for now, x, y, held in steps:
        recorder.take(now, x, y, held=held)
    return recorder


def test_a_path_is_where_it_was_sampled_and_even_in_between() -> None:
    path = EmotionPath(((0.0, 0.0, 0.0), (1.0, 0.5, -0.25), (3.0, -0.5, 1.0)))
    for secs, x, y in path.samples:
        assert path.at(secs) == (x, y)
    assert path.at(0.5) == pytest.approx((0.25, -0.125))
    assert path.at(2.0) == pytest.approx((0.0, 0.375))
    assert path.at(-1.0) == (0.0, 0.0)
    assert path.at(99.0) == (-0.5, 1.0)
    assert path.duration_secs == 3.0


def test_the_recorder_keeps_the_clocks_times_from_the_first_press() -> None:
    recorder = recorded(
        (100.0, 0.9, 0.9, False), (107.0, 0.1, 0.0, True), (107.5, 0.2, 0.1, True), (109.0, 0.4, 0.3, True)
    )
    path = recorder.path()
    assert path is not None
    assert path.samples == ((0.0, 0.1, 0.0), (0.5, 0.2, 0.1), (2.0, 0.4, 0.3))


def test_standing_still_is_kept_in_time_by_two_samples() -> None:
    steps = [(0.0, 0.0, 0.0, True)] + [(k / 60, 0.5, 0.5, True) for k in range(1, 600)]
    recorder = recorded(*steps, (10.0, 1.0, 0.0, True))
    assert len(recorder.samples) == 4
    path = recorder.path()
    assert path is not None
    assert path.at(5.0) == (0.5, 0.5)
    assert path.at(599 / 60) == (0.5, 0.5)
    assert path.at(10.0) == (1.0, 0.0)


def test_time_between_two_drags_counts_and_time_after_the_last_does_not() -> None:
    recorder = recorded(
        (0.0, 0.0, 0.0, True), (1.0, 0.5, 0.0, True), (1.1, 0.5, 0.0, False), (4.0, 0.5, 0.0, False),
        (4.1, 0.0, 0.5, True), (5.0, 0.0, 1.0, True), (6.0, 0.0, 1.0, True), (20.0, 0.0, 1.0, False),
    )  # fmt: skip
    path = recorder.path()
    assert path is not None
    assert path.at(4.0) == (0.5, 0.0)
    assert path.at(4.1) == (0.0, 0.5)
    assert path.duration_secs == 6.0


def test_a_hand_that_only_lets_go_adds_nothing() -> None:
    recorder = recorded((0.0, 0.0, 0.0, True), (1.0, 0.5, 0.0, True), (9.0, 0.5, 0.0, False))
    path = recorder.path()
    assert path is not None
    assert path.samples == ((0.0, 0.0, 0.0), (1.0, 0.5, 0.0))


def test_nothing_moved_is_no_path() -> None:
    assert Recorder().path() is None
    assert recorded((0.0, 0.3, 0.3, True), (5.0, 0.3, 0.3, True)).path() is None
    assert recorded((0.0, 0.3, 0.3, False), (5.0, 0.4, 0.3, False)).path() is None


def test_a_recording_ends_at_its_longest() -> None:
    recorder = recorded((0.0, 0.0, 0.0, True), (LONGEST_SECS + 5.0, 0.5, 0.0, True))
    assert recorder.full
    recorder.take(LONGEST_SECS + 9.0, 1.0, 0.0, held=True)
    path = recorder.path()
    assert path is not None
    assert path.duration_secs == LONGEST_SECS
    assert path.at(LONGEST_SECS) == (0.5, 0.0)
    many = recorded(*((k * 1e-4, math.sin(k), 0.0, True) for k in range(MOST_SAMPLES + 5)))
    assert many.full
    assert many.path() is not None


def test_a_clock_that_goes_back_does_no_harm() -> None:
    recorder = recorded((5.0, 0.0, 0.0, True), (6.0, 0.5, 0.0, True), (2.0, 0.7, 0.0, True))
    path = recorder.path()
    assert path is not None
    assert path.duration_secs == 1.0


@pytest.mark.parametrize(
    "samples",
    [
        (),
        ((0.0, 0.0, 0.0),),
        ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        ((0.5, 0.0, 0.0), (1.0, 1.0, 0.0)),
        ((0.0, 0.0, 0.0), (2.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
        ((0.0, 0.0, 0.0), (61.0, 1.0, 0.0)),
        ((0.0, 0.0, 0.0), (1.0, 1.5, 0.0)),
        ((0.0, 0.0, 0.0), (math.nan, 1.0, 0.0)),
        ((0.0, math.nan, 0.0), (1.0, 1.0, 0.0)),
    ],
)
def test_what_is_no_path_is_refused(samples: tuple[tuple[float, float, float], ...]) -> None:
    with pytest.raises(OptionError):
        EmotionPath(samples)


def test_a_long_path_is_drawn_through_few_places_with_both_ends() -> None:
    samples = [(k / 100, k / 6000, -k / 6000) for k in range(6001)]
    places = thinned(samples)
    assert len(places) <= 402
    assert places[0] == (0.0, 0.0)
    assert places[-1] == (1.0, -1.0)
    assert thinned(samples[:3]) == ((0.0, 0.0), samples[1][1:], samples[2][1:], samples[2][1:])
