"""Every input that no face can be made of is refused, and the message names it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.errors import CorrespondenceError, FitError, UnknownNameError
from facemorph.fit import example_based, transfer
from facemorph.fit.report import fit_report
from facemorph.fit.starting import explained
from facemorph.fit.transferring import Transfer
from tests.conftest import bumpy_grid
from tests.fit.faces import sheet_rig


@pytest.fixture(scope="module")
def rig():
    return sheet_rig(2, 6, 7)


@pytest.fixture(scope="module")
def neutral(rig):
    return rig.neutral.positions.astype(np.float64)


@pytest.fixture(scope="module")
def smile(rig, neutral):
    return neutral + rig.deltas[0]


def test_meshes_of_another_topology_are_refused_and_registration_is_named(rig, smile):
    stranger = bumpy_grid(7, 9)
    with pytest.raises(CorrespondenceError, match=r"the neutral.*the template.*facemorph register"):
        transfer(rig, stranger)
    with pytest.raises(CorrespondenceError, match=r"grin.*facemorph register"):
        example_based(rig, rig.neutral, {"grin": stranger})


def test_meshes_with_other_polygons_over_as_many_vertices_are_refused(rig, neutral):
    flipped = Mesh.from_triangles(rig.neutral.positions, rig.triangles[:, ::-1].copy())
    with pytest.raises(CorrespondenceError, match="the neutral"):
        transfer(rig, flipped)


@pytest.mark.parametrize("shape", [(5, 3), (42, 2), (42,)])
def test_arrays_of_another_size_are_refused(rig, smile, shape):
    with pytest.raises(CorrespondenceError, match=r"the neutral.*positions are"):
        transfer(rig, np.zeros(shape))
    with pytest.raises(CorrespondenceError, match="example 2"):
        example_based(rig, rig.neutral, [smile, np.zeros(shape)])


@pytest.mark.parametrize("strange", [np.nan, np.inf, -np.inf])
def test_positions_that_are_no_numbers_are_named_by_their_vertex(rig, neutral, smile, strange):
    broken = smile.copy()
    broken[10, 1] = strange
    with pytest.raises(FitError, match=r"the neutral: vertex 11 .*no finite number"):
        transfer(rig, broken)
    with pytest.raises(FitError, match=r"frown: vertex 11 "):
        example_based(rig, neutral, {"smile": smile, "frown": broken})


def test_degenerate_triangles_are_counted_and_the_first_is_named(rig, neutral):
    broken = neutral.copy()
    a, b, c = rig.triangles[0]
    broken[c] = broken[a]
    with pytest.raises(FitError, match=rf"the neutral: \d+ of {len(rig.triangles)} triangles are degenerate.*"
                       rf"vertices {a + 1} {b + 1} {c + 1}"):  # fmt: skip
        transfer(rig, broken)
    flat = replace(rig, neutral=rig.neutral.with_positions(broken.astype(np.float32)))
    with pytest.raises(FitError, match=r"the template: .*degenerate"):
        transfer(flat, neutral)


def test_a_neutral_that_is_one_point_is_refused(rig, neutral):
    with pytest.raises(FitError, match="degenerate"):
        transfer(rig, np.ones_like(neutral))


@pytest.mark.parametrize("way", [example_based, fit_report])
def test_an_example_equal_to_the_neutral_is_refused(rig, neutral, smile, way):
    with pytest.raises(FitError, match=r"copy: it is equal to the neutral"):
        way(rig, neutral, {"smile": smile, "copy": neutral + 1e-9})


def test_unknown_shapes_are_refused_with_the_nearest(rig, neutral, smile):
    with pytest.raises(UnknownNameError, match=r"smlie.*smile"):
        example_based(rig, neutral, [smile], [{"smlie": 0.5}])
    with pytest.raises(UnknownNameError, match=r"smlie.*smile"):
        example_based(rig, neutral, [smile], shapes=["smlie"])
    with pytest.raises(UnknownNameError, match="smlie"):
        explained(Transfer(rig, neutral), {"a": smile}, ["smlie"])


def test_weights_for_shapes_that_may_not_explain_are_refused(rig, neutral, smile):
    with pytest.raises(UnknownNameError, match="frown"):
        example_based(rig, neutral, [smile], [{"frown": 0.5}], shapes=["smile"])


@pytest.mark.parametrize("value", [-0.1, 1.01, float("nan"), float("inf")])
def test_weights_outside_0_to_1_are_refused(rig, neutral, smile, value):
    with pytest.raises(FitError, match=r"a weight lies between 0 and 1; smile ="):
        example_based(rig, neutral, [smile], [{"smile": value}])


@pytest.mark.parametrize("rows", [[], [{}, {}]])
def test_as_many_sets_of_weights_as_examples_are_wanted(rig, neutral, smile, rows):
    with pytest.raises(FitError, match=rf"{len(rows)} sets of weights were given for 1 examples"):
        example_based(rig, neutral, [smile], rows)


def test_too_many_examples_are_refused(rig, neutral):
    with pytest.raises(FitError, match="at most 64 examples are taken, not 65"):
        example_based(rig, neutral, [neutral + k for k in range(1, 66)])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"iterations": 0}, "at least one iteration, not 0"),
        ({"iterations": -3}, "not -3"),
        ({"alpha": (0.0, 0.1)}, "numbers above 0; 0 to 0.1"),
        ({"alpha": (0.5, -0.1)}, "above 0"),
        ({"lambda_": (100.0, 0.0)}, "above 0"),
        ({"lambda_": (float("nan"), 1.0)}, "above 0"),
        ({"alpha": (float("inf"), 0.1)}, "above 0"),
        ({"schedule": "cubic"}, "geometric or linear, not 'cubic'"),
    ],
)
def test_schedules_that_are_none_are_refused_even_without_examples(rig, neutral, smile, options, message):
    for examples in ({}, {"smile": smile}):
        with pytest.raises(FitError, match=message):
            example_based(rig, neutral, examples, **options)


def test_a_report_without_examples_is_refused(rig, neutral):
    with pytest.raises(FitError, match="there are none"):
        fit_report(rig, neutral, {})


@pytest.mark.parametrize(("times", "words"), [(10.0, "times as large"), (0.01, "times as small")])
def test_an_example_in_another_unit_is_told_by_its_size(rig, neutral, smile, times, words):
    with pytest.raises(FitError, match=rf"grin: .*{words}.*same unit"):
        example_based(rig, neutral, {"grin": smile * times})


def test_weights_may_be_given_by_the_examples_names(rig, neutral, smile):
    frown = neutral + rig.deltas[1]
    first, second = rig.names[:2]
    in_order = example_based(
        rig, neutral, {"grin": smile, "scowl": frown}, [{first: 0.9}, {second: 0.8}], iterations=2
    )
    by_name = example_based(
        rig,
        neutral,
        {"grin": smile, "scowl": frown},
        {"scowl": {second: 0.8}, "grin": {first: 0.9}},
        iterations=2,
    )
    assert by_name.weights == in_order.weights
    with pytest.raises(UnknownNameError, match="example"):
        example_based(rig, neutral, {"grin": smile}, {"gin": {first: 0.9}})
    with pytest.raises(FitError, match="scowl has none"):
        example_based(rig, neutral, {"grin": smile, "scowl": frown}, {"grin": {first: 0.9}})
