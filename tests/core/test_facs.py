"""FACS units as text, prototypes, and the emotion map's rule."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.emotion import PAPER_POLES, Pole, emotion_weights, on_disc, spread_poles
from facemorph.core.facs import PROTOTYPES, TABLE_2_1, Sides, known_unit, parsed_units, prototype, units_text
from facemorph.errors import OptionError, PoseError, UnknownNameError

UNITS = (1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 16, 17, 20, 23, 26, 43)
WEIGHT = st.floats(-2, 2).filter(lambda w: w != 0)


def test_the_thesis_own_prototypes():
    assert PROTOTYPES["happy"] == (6, 12)
    assert PROTOTYPES["sad"] == (1, 4, 15, 23)
    assert PROTOTYPES["afraid"] == (1, 2, 4, 5, 20, 26)
    assert len(TABLE_2_1) == 15
    assert set(prototype("sad", (1, 4, 15))) == {1, 4, 15}


def test_units_are_written_as_facs_writes_them():
    assert units_text({15: Sides.both(1), 1: Sides.both(1), 4: Sides.both(1)}) == "AU1+4+15"
    assert units_text({12: Sides(0.4, 0.0)}) == "AUL12(0.4)"
    assert units_text({}) == ""


@given(st.dictionaries(st.sampled_from(UNITS), st.builds(Sides, WEIGHT, WEIGHT), max_size=6))
def test_text_leads_back_to_the_same_units(units):
    again = parsed_units(units_text(units), UNITS)
    assert again.keys() == units.keys()
    for number, sides in units.items():
        assert again[number].left == pytest.approx(sides.left, rel=1e-11)
        assert again[number].right == pytest.approx(sides.right, rel=1e-11)


def test_letters_and_prefixes_are_understood():
    units = parsed_units("AU1 + 4C + au12(0.5) + L6E", UNITS)
    assert units == {1: Sides.both(1), 4: Sides.both(0.6), 12: Sides.both(0.5), 6: Sides(1.0, 0.0)}
    assert known_unit("AU04", UNITS) == 4


@pytest.mark.parametrize("text", ["AU", "smile", "AU1++4", "12(much)", "12(nan)", "1+4;15", "1" * 3000])
def test_text_that_is_no_units_is_refused(text):
    with pytest.raises((OptionError, PoseError, UnknownNameError)):
        parsed_units(text, UNITS)


def test_a_unit_the_face_lacks_is_named_with_those_it_has():
    with pytest.raises(UnknownNameError, match=r"'99'.*1, 2, 4"):
        parsed_units("AU1+99", UNITS)


@pytest.mark.parametrize("x", np.linspace(-1, 1, 21))
@pytest.mark.parametrize("y", np.linspace(-1, 1, 21))
def test_the_maps_weights_are_the_papers_rule_exactly(x, y):
    rule = {"sad": max(x, 0), "afraid": max(-x, 0), "happy": max(y, 0), "angry": max(-y, 0)}
    assert emotion_weights(float(x), float(y)) == {
        name: weight for name, weight in rule.items() if weight > 0
    }


@given(st.integers(3, 12), st.floats(-1, 1), st.floats(-1, 1))
def test_with_any_poles_the_weights_lead_back_to_the_cursor(count, x, y):
    poles = spread_poles([f"e{k}" for k in range(count)])
    weights = emotion_weights(x, y, poles)
    assert len(weights) <= 2
    angle = {pole.name: math.radians(pole.angle_deg) for pole in poles}
    back = [sum(w * f(angle[n]) for n, w in weights.items()) for f in (math.cos, math.sin)]
    np.testing.assert_allclose(back, (x, y), atol=1e-9)


@given(st.floats(-9, 9), st.floats(-9, 9))
def test_a_round_pad_keeps_the_direction_and_never_leaves_the_disc(x, y):
    cx, cy = on_disc(x, y)
    assert math.hypot(cx, cy) <= 1 + 1e-12
    assert cx * y == pytest.approx(cy * x, abs=1e-9)


def test_at_a_pole_its_expression_stands_alone_and_in_the_middle_none():
    for pole in spread_poles(("a", "b", "c", "d", "e")):
        angle = math.radians(pole.angle_deg)
        weights = emotion_weights(math.cos(angle), math.sin(angle), spread_poles(("a", "b", "c", "d", "e")))
        assert weights[pole.name] == pytest.approx(1.0)
        assert sum(weights.values()) == pytest.approx(1.0, abs=1e-9)
    assert emotion_weights(0, 0) == {}


@pytest.mark.parametrize(
    "poles",
    [(), PAPER_POLES[:2], (Pole("a", 0), Pole("b", 10), Pole("c", 20)), (Pole("a", 0),) * 3],
)
def test_poles_that_span_no_disc_are_refused(poles):
    with pytest.raises(OptionError, match="at least 3"):
        emotion_weights(0.5, 0.5, poles)
    with pytest.raises(OptionError, match="two numbers"):
        emotion_weights(float("nan"), 0.0)


def test_a_formula_is_put_on_top_of_what_is_there_side_by_side():
    present = parsed_units("L12(0.4)", UNITS)
    assert parsed_units("R12", UNITS, present) == {12: Sides(0.4, 1.0)}


def test_weights_out_of_sight_are_refused():
    with pytest.raises(PoseError, match="100"):
        parsed_units("12(1e30)", UNITS)
