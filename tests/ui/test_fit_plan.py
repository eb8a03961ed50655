"""The plan of a person's blendshapes: what meshes are found to be, what undo says, what is asked for."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.rig import Landmark, Rig
from facemorph.errors import CorrespondenceError
from facemorph.fit.units import unit_of
from facemorph.ui.fit_landmarks import FEWEST, PLENTY, asked_for, enough_words, next_mark
from facemorph.ui.fit_names import shapes_named
from facemorph.ui.fit_plan import FitPlan, Piece, examined, in_order, new_piece, plan_words
from facemorph.ui.state import Face
from tests.ui.fit_case import EXAMPLES, head_rig, person_rig, scanned, shuffled


@pytest.fixture(scope="module")
def template() -> Rig:
    return head_rig()


@pytest.fixture(scope="module")
def person(template: Rig) -> Rig:
    return person_rig(template)


def piece_of(mesh, name: str = "piece", key: int = 1) -> Piece:
    return new_piece(name, Path(f"/somewhere/{name}.obj"), mesh, key=key)


def test_a_mesh_of_the_template_fits_as_it_is(template: Rig, person: Rig) -> None:
    found = examined(template, piece_of(person.neutral), neutral=True)
    assert found.finding.standing == "fits"
    assert found.fitted is person.neutral
    assert f"{template.neutral.vertex_count:,} vertices" in found.finding.words


def test_another_order_is_told_and_put_right(template: Rig, person: Rig) -> None:
    found = examined(template, piece_of(shuffled(person.neutral)), neutral=True)
    assert (found.finding.standing, found.fitted) == ("order", None)
    ordered = in_order(template.neutral, found, None)
    assert ordered.finding.standing == "fits"
    assert np.array_equal(ordered.fitted.positions, person.neutral.positions)
    assert ordered.shown is ordered.fitted


def test_examples_written_as_the_neutral_take_its_order(template: Rig, person: Rig) -> None:
    # A guide whose order is some other permutation: the example must follow it, not search its own.
    neutral = in_order(template.neutral, piece_of(shuffled(person.neutral)), None)
    other = replace(neutral, order=neutral.order[::-1].copy())
    smile = piece_of(shuffled(person.posed(EXAMPLES["smile"])), "smile")
    found = in_order(neutral.fitted, smile, other)
    assert np.array_equal(found.order, other.order)
    right = in_order(neutral.fitted, smile, neutral)
    assert right.fitted.positions == pytest.approx(person.positions(EXAMPLES["smile"]), abs=1e-6)


def test_no_order_is_found_for_another_surface(template: Rig, person: Rig) -> None:
    with pytest.raises(CorrespondenceError, match="no order"):
        in_order(template.neutral, piece_of(scanned(person.neutral)), None)


def test_another_mesh_is_told_with_both_counts(template: Rig, person: Rig) -> None:
    scan = scanned(person.neutral)
    found = examined(template, piece_of(scan), neutral=True)
    assert (found.finding.standing, found.fitted) == ("other", None)
    assert f"{scan.vertex_count:,}" in found.finding.words
    assert f"{template.neutral.vertex_count:,}" in found.finding.words


def test_a_neutral_with_flat_triangles_cannot_be_used_but_an_example_can(template: Rig, person: Rig) -> None:
    points = person.neutral.positions.copy()
    points[1] = points[0]
    flat = person.neutral.with_positions(points)
    assert examined(template, piece_of(flat), neutral=True).finding.standing == "unusable"
    assert examined(template, piece_of(flat), neutral=False).finding.standing == "fits"


def test_a_number_that_is_none_is_named(template: Rig, person: Rig) -> None:
    points = person.neutral.positions.copy()
    points[7, 1] = np.nan
    found = examined(template, piece_of(person.neutral.with_positions(points)), neutral=False)
    assert found.finding.standing == "unusable"
    assert "vertex 8" in found.finding.words


def test_a_plan_is_ready_when_all_pieces_fit(template: Rig, person: Rig) -> None:
    face = Face(template, ("t",))
    neutral = examined(template, piece_of(person.neutral), neutral=True)
    scan = examined(template, piece_of(scanned(person.neutral), "scan"), neutral=False)
    plan = FitPlan(face, neutral)
    assert plan.ready
    assert not replace(plan, examples=(scan,)).ready
    assert not replace(plan, neutral=None).ready
    assert replace(plan, without=frozenset({"facs", "arkit"})).used == ("happy", "sad")


def test_another_template_asks_for_everything_again(template: Rig, person: Rig) -> None:
    neutral = examined(template, piece_of(person.neutral), neutral=True)
    example = replace(
        examined(template, piece_of(person.neutral, "e"), neutral=False), weights={"happy": 1.0}
    )
    plan = FitPlan(Face(template, ("t",)), neutral, (example,), frozenset({"facs"}))
    other = plan.on(Face(head_rig("Other", 5), ("o",)))
    assert [piece.finding.standing for piece in other.pieces] == ["checking", "checking"]
    assert [piece.fitted for piece in other.pieces] == [None, None]
    assert other.examples[0].weights == {}
    assert other.without == frozenset()
    assert [piece.key for piece in other.pieces] == [piece.key for piece in plan.pieces]
    same = plan.on(Face(replace(template, corrected=False), ("again",)))
    assert same.neutral is neutral


def test_names_stay_apart(template: Rig) -> None:
    plan = FitPlan(examples=(piece_of(template.neutral, "smile"),))
    assert plan.named("smile") == "smile (2)"
    assert plan.named("shout") == "shout"


def test_undo_says_what_it_takes_back(template: Rig) -> None:
    smile, shout = piece_of(template.neutral, "smile"), piece_of(template.neutral, "shout", 2)
    empty = FitPlan()
    one, both = replace(empty, examples=(smile,)), replace(empty, examples=(smile, shout))
    assert plan_words(empty, one) == "add smile"
    assert plan_words(empty, both) == "add 2 meshes"
    assert plan_words(both, one) == "take out shout"
    assert plan_words(one, one.put(replace(smile, weights={"happy": 0.5}))) == "starting weights of smile"
    assert plan_words(one, replace(one, iterations=4)) == "settings of the fit"
    assert plan_words(empty, FitPlan(Face(template, ("t",)))) == "template Template"


def test_easy_landmarks_are_asked_for_first_and_none_inside_the_mouth(template: Rig) -> None:
    marks = (
        Landmark("jaw", 0, ibug=0),
        Landmark("lid", 1, ibug=37),
        Landmark("tongue tip", 2, mpeg4="6.1"),
        Landmark("eye", 3, ibug=36),
        Landmark("teeth", 4, mpeg4="9.10"),
        Landmark("nose tip", 5, ibug=30, mpeg4="9.3"),
    )
    rig = replace(template, info=replace(template.info, landmarks=marks))
    assert [mark.name for mark in asked_for(rig)] == ["eye", "nose tip", "jaw", "lid"]
    assert next_mark(rig, [3], {"nose tip"}).name == "jaw"
    assert next_mark(rig, [0, 1, 3, 5], ()) is None


@pytest.mark.parametrize(
    ("name", "named"),
    [
        ("happy", ("happy",)),
        ("Happy_02", ("happy",)),
        ("AU12", ("AU12",)),
        ("AU1+AU12", ("AU1", "AU12")),
        ("au1 jawOpen (3)", ("AU1", "jawOpen")),
        ("jaw_open", ("jawOpen",)),
        ("happy face", ()),
        ("smile", ()),
        ("12", ()),
        ("", ()),
    ],
)
def test_the_shapes_that_an_example_is_called_by(template: Rig, name: str, named: tuple[str, ...]) -> None:
    assert shapes_named(name, template.controls) == named


def test_how_many_points_are_enough_is_said() -> None:
    assert "4 more points" in enough_words(0)
    assert "1 more point " in enough_words(FEWEST - 1)
    assert "enough to try" in enough_words(FEWEST)
    assert "plenty" in enough_words(PLENTY)


@pytest.mark.parametrize(
    ("template_unit", "scale", "unit"),
    [
        ("cm", 1.0, "cm"),
        ("cm", 0.1, "mm"),
        ("cm", 0.11, "mm"),
        ("mm", 1000.0, "m"),
        ("cm", 5.0, ""),
        ("", 1.0, ""),
    ],
)
def test_the_unit_of_a_scan_follows_from_its_size(template_unit: str, scale: float, unit: str) -> None:
    assert unit_of(template_unit, scale) == unit
