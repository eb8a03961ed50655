"""The heat map's numbers and its legend: round, in a unit people know, never out of the picture."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.lengths import displacements
from facemorph.core.picture import Look
from facemorph.core.rig import Rig
from facemorph.gl import Offscreen, heat_legend, with_legend
from facemorph.gl.heat import heat_end, nice_above, ramp


@pytest.mark.parametrize(
    ("value", "nice"), [(1.0, 1.0), (1.01, 1.5), (2.3, 3.0), (9.2, 10.0), (0.0123, 0.015), (451.0, 500.0)]
)
def test_the_end_is_a_round_number_not_below(value: float, nice: float) -> None:
    assert nice_above(value) == pytest.approx(nice)


def test_the_end_is_round_in_the_unit_that_is_shown() -> None:
    assert heat_end(0.37, "cm", 20.0) == pytest.approx(0.4)
    assert heat_end(0.00131, "m", 0.2) == pytest.approx(0.0015)
    assert heat_end(1.7, "", 20.0) == pytest.approx(2.0)


def test_a_face_at_rest_has_a_legend_too() -> None:
    assert 0.0 < heat_end(0.0, "cm", 20.0) <= 0.5
    assert heat_end(0.0, "", 0.0) > 0.0


@pytest.mark.parametrize(
    ("unit", "shown", "last"),
    [("cm", "mm", "15"), ("mm", "mm", "1.5"), ("m", "mm", "1500"), ("", "model units", "1.5")],
)
def test_lengths_are_told_in_millimetres_where_the_unit_is_known(unit: str, shown: str, last: str) -> None:
    legend = heat_legend(1.5, unit)
    assert legend.unit == shown
    assert legend.ticks[0] == (0.0, "0")
    assert legend.ticks[-1] == (pytest.approx(1.0), last)


@pytest.mark.parametrize("high", [1e-6, 0.003, 0.08, 1.0, 1.5, 3.0, 7.77, 60.0, 8000.0, 3e7])
def test_ticks_are_few_ordered_and_true(high: float) -> None:
    ticks = heat_legend(high, "").ticks
    assert 3 <= len(ticks) <= 7
    places = [place for place, _ in ticks]
    assert places == sorted(places)
    for place, text in ticks:
        assert float(text) == pytest.approx(place * high, rel=5e-3, abs=high * 1e-9)


def test_the_ramp_goes_from_quiet_blue_to_red_without_jumps() -> None:
    colours = ramp(256).astype(int)
    assert np.argmax(colours[0]) == 2
    assert np.argmax(colours[-1]) == 0
    assert np.abs(np.diff(colours, axis=0)).max() <= 6
    assert len(np.unique(colours, axis=0)) > 200


def test_displacement_is_the_length_of_the_move() -> None:
    neutral = np.zeros((2, 3), np.float32)
    moved = np.array([[3.0, 4.0, 0.0], [0.0, 0.0, -2.0]], np.float32)
    assert displacements(moved, neutral).tolist() == [5.0, 2.0]


@pytest.mark.parametrize("size", [(200, 200), (200, 900), (900, 200), (320, 240), (1280, 800), (4000, 3000)])
@pytest.mark.parametrize(("high", "unit"), [(1.5, "cm"), (123456.0, ""), (0.000012, "")])
def test_the_legend_stays_inside_and_is_legible(size: tuple[int, int], high: float, unit: str) -> None:
    blank = np.zeros((size[1], size[0], 4), np.uint8)
    blank[..., 3] = 255
    drawn = with_legend(blank, heat_legend(high, unit))
    assert drawn.shape == blank.shape
    changed = np.any(drawn != blank, axis=2)
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    assert rows[0] > 0
    assert rows[-1] < size[1] - 1
    assert columns[0] > 0
    assert columns[-1] < size[0] - 1
    covered = changed.mean()
    assert covered < 0.3 if min(size) > 200 else covered < 0.4, "it leaves the face its place"
    # Ink of the words: nearly white pixels right of the bar, at least a few rows high.
    ink = (drawn[..., :3].min(axis=2) > 190).any(axis=1).sum()
    assert ink >= 14


def test_pictures_smaller_than_a_legend_stay_whole() -> None:
    blank = np.full((24, 30, 4), 255, np.uint8)
    assert with_legend(blank, heat_legend(1.0, "cm")).shape == (24, 30, 4)


def test_only_heat_maps_have_a_legend(screen: Offscreen, head: Rig) -> None:
    for shading in ("skin", "heat", "clay"):
        screen.render(head, {"smile": 1.0}, size=(200, 200), look=Look(shading=shading))
        assert (screen.renderer.legend is not None) == (shading == "heat")


def test_the_legend_ends_where_the_look_says_or_above_the_poses_largest(screen: Offscreen, head: Rig) -> None:
    screen.render(head, {"smile": 1.0}, size=(64, 64), look=Look(shading="heat", heat_max=0.7))
    assert screen.renderer.legend is not None
    assert screen.renderer.legend.high == 0.7
    screen.render(head, {"smile": 1.0}, size=(64, 64), look=Look(shading="heat"))
    largest = float(displacements(head.positions({"smile": 1.0}), head.neutral.positions).max())
    assert largest <= screen.renderer.legend.high <= 1.6 * largest
