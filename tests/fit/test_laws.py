"""The laws of fitting: what must come out whatever the face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit import example_based, transfer
from facemorph.fit.problem import FitProblem
from facemorph.fit.transferring import Transfer
from tests.fit.faces import joined, mixed, named, octahedron, rig_of, sheet_rig, styled, turned

WEIGHTS = np.array([[1.0, 0.3, 0.0, 0.0], [0.0, 0.8, 0.5, 0.0], [0.4, 0.0, 0.9, 0.0]])


@pytest.fixture(scope="module")
def case():
    rig = sheet_rig(4)
    neutral, offsets = styled(rig)
    return rig, neutral, mixed(neutral, offsets, WEIGHTS), offsets


def _problem(case) -> FitProblem:
    rig, neutral, examples, _ = case
    return FitProblem(Transfer(rig, neutral), list(examples.values()), rig.names, hold_still=False)


def test_weights_all_0_are_deformation_transfer(case):
    problem = _problem(case)
    problem.fit_shapes(np.zeros_like(WEIGHTS), 0.1)
    np.testing.assert_array_equal(problem.planes, problem.way.planes)


@pytest.mark.parametrize("alpha", [1e9, 1e12])
def test_a_very_large_alpha_is_deformation_transfer(case, alpha):
    problem = _problem(case)
    problem.fit_shapes(WEIGHTS, alpha)
    assert np.abs(problem.planes - problem.way.planes).max() <= 1e-9 * problem.diagonal


def test_no_examples_are_deformation_transfer(case):
    rig, neutral, _, _ = case
    alone, zero = transfer(rig, neutral), example_based(rig, neutral, {})
    np.testing.assert_array_equal(alone.rig.deltas, zero.rig.deltas)
    assert zero.examples == zero.history == () and zero.residuals.shape == (0, len(neutral))
    assert alone.rig.names == rig.names


def test_the_template_as_its_own_target_gives_the_templates_shapes():
    mesh, places = joined(sheet_rig(1, 9, 10).neutral, octahedron((0, 0, -1.5), 0.3))
    rig = _with_parts(mesh, places)
    for surface in (rig.neutral, rig.neutral.positions.astype(np.float64)):
        result = transfer(rig, surface)
        assert np.abs(result.rig.deltas - rig.deltas).max() <= 1e-5 * rig.neutral.diagonal


def _with_parts(mesh, places) -> Rig:
    skin = sheet_rig(3, 9, 10).deltas
    offsets = np.zeros((3, mesh.vertex_count, 3))
    offsets[:, : skin.shape[1]] = skin
    offsets[1, places[0]] = (0.0, -0.4, 0.1)
    return rig_of(mesh, offsets)


def test_a_template_fitted_to_its_own_faces_keeps_its_shapes_and_finds_the_weights():
    rig = sheet_rig(4)
    faces = mixed(rig.neutral.positions.astype(np.float64), rig.deltas.astype(np.float64), WEIGHTS)
    result = example_based(rig, rig.neutral, faces, named(rig, WEIGHTS))
    assert np.abs(result.rig.deltas - rig.deltas).max() <= 1e-5 * rig.neutral.diagonal
    for found, given in zip(result.weights, named(rig, WEIGHTS), strict=True):
        for name in rig.names:
            assert found.get(name, 0.0) == pytest.approx(given.get(name, 0.0), abs=1e-4)


@pytest.mark.parametrize("weight", [1.0, 0.4])
def test_one_shape_and_one_example_with_alpha_to_0_give_the_examples_offsets_over_the_weight(case, weight):
    rig, neutral, _, offsets = case
    one = replace(rig, shapes=rig.shapes[:1], deltas=rig.deltas[:1])
    example = neutral + 0.8 * offsets[0]
    result = example_based(
        one, neutral, [example], [{rig.names[0]: weight}],
        alpha=(1e-9, 1e-9), lambda_=(1e6, 1e6), iterations=1, hold_still=False,
    )  # fmt: skip
    expected = 0.8 * offsets[0] / weight
    assert np.abs(result.rig.deltas[0] - expected).max() <= 1e-5 * rig.neutral.diagonal
    assert result.examples[0].rms_percent < 1e-3


@pytest.mark.parametrize("scale", [0.01, 1.0, 30.0])
def test_scaling_moving_and_turning_the_target_does_that_to_the_result(case, scale):
    rig, neutral, examples, _ = case
    turn, shift = scale * turned(40.0, 2) @ turned(-25.0), np.array([5.0, -3.0, 100.0]) * scale
    plain = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    moved = example_based(
        rig,
        neutral @ turn.T + shift,
        {name: face @ turn.T + shift for name, face in examples.items()},
        named(rig, WEIGHTS),
    )
    size = plain.rig.neutral.diagonal * scale
    assert np.abs(moved.rig.deltas - plain.rig.deltas @ turn.T).max() <= 1e-5 * size
    for a, b in zip(plain.examples, moved.examples, strict=True):
        assert a.rms * scale == pytest.approx(b.rms, rel=1e-2, abs=1e-6 * size)
        assert dict(a.weights) == pytest.approx(dict(b.weights), abs=1e-4)


def test_an_example_that_nods_is_put_back_by_what_never_moves(case):
    rig, neutral, examples, _ = case
    turn = turned(3.0)
    nodding = {name: face @ turn.T + 0.2 for name, face in examples.items()}
    plain = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    held = example_based(rig, neutral, nodding, named(rig, WEIGHTS))
    loose = example_based(rig, neutral, nodding, named(rig, WEIGHTS), hold_still=False)
    assert np.abs(held.rig.deltas - plain.rig.deltas).max() <= 1e-5 * rig.neutral.diagonal
    assert loose.examples[0].rms_percent > 10.0 * held.examples[0].rms_percent


def test_permuting_the_vertices_permutes_the_result(case):
    rig, neutral, examples, _ = case
    order = np.random.default_rng(8).permutation(len(neutral))
    place = np.argsort(order)
    mesh = Mesh.from_triangles(rig.neutral.positions[order], place[rig.triangles].astype(np.int32))
    shuffled = replace(rig, neutral=mesh, deltas=rig.deltas[:, order])
    plain = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    other = example_based(
        shuffled, neutral[order], {n: face[order] for n, face in examples.items()}, named(rig, WEIGHTS)
    )
    assert np.abs(other.rig.deltas - plain.rig.deltas[:, order]).max() <= 1e-5 * rig.neutral.diagonal


def test_the_order_of_shapes_and_of_examples_changes_nothing(case):
    rig, neutral, examples, _ = case
    plain = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    shapes, rows = [2, 0, 3, 1], [2, 0, 1]
    other = example_based(
        replace(rig, shapes=tuple(rig.shapes[k] for k in shapes), deltas=rig.deltas[shapes]),
        neutral,
        {name: examples[name] for name in np.array(list(examples))[rows]},
        [named(rig, WEIGHTS)[j] for j in rows],
    )
    assert np.abs(other.rig.deltas - plain.rig.deltas[shapes]).max() <= 1e-5 * rig.neutral.diagonal


def test_shapes_that_no_example_uses_stay_transferred(case):
    rig, neutral, examples, _ = case
    result = example_based(rig, neutral, examples, named(rig, WEIGHTS), lambda_=(1e6, 1e6))
    plain = transfer(rig, neutral)
    np.testing.assert_array_equal(result.rig.deltas[3], plain.rig.deltas[3])
    assert np.abs(result.rig.deltas[0] - plain.rig.deltas[0]).max() > 1e-3


def test_what_is_left_of_an_example_is_the_example_less_the_rig(case):
    rig, neutral, examples, _ = case
    result = example_based(rig, neutral, examples, hold_still=False)
    assert result.residuals.shape == (3, len(neutral))
    for one, face in zip(result.examples, examples.values(), strict=True):
        made = result.rig.positions(one.weights)
        np.testing.assert_allclose(made + one.offsets, face, atol=2e-6 * rig.neutral.diagonal)
        assert one.rms == pytest.approx(float(np.sqrt((one.distances**2).mean())))
        assert one.largest_percent == pytest.approx(
            100.0 * one.largest / result.rig.neutral.diagonal, rel=1e-4
        )
    errors = [one.rms_percent for one in result.examples]
    assert result.history[-1].rms_percent == pytest.approx(
        float(np.sqrt(np.mean(np.square(errors)))), rel=1e-3
    )


def test_the_fit_learns_the_persons_own_shapes(case):
    rig, neutral, examples, offsets = case
    fitted = example_based(rig, neutral, examples, named(rig, WEIGHTS))
    plain = transfer(rig, neutral)
    for k in range(3):
        far, near = (np.linalg.norm(one.rig.deltas[k] - offsets[k]) for one in (plain, fitted))
        assert near < 0.9 * far
    assert fitted.history[-1].rms_percent < 0.4 * fitted.history[0].rms_percent
    assert [turn.alpha for turn in fitted.history] == sorted((t.alpha for t in fitted.history), reverse=True)
    assert (fitted.history[0].alpha, fitted.history[-1].alpha) == pytest.approx((0.5, 0.1))
    assert (fitted.history[0].lambda_, fitted.history[-1].lambda_) == pytest.approx((100.0, 10.0))


def test_a_linear_schedule_ends_where_the_geometric_one_does(case):
    rig, neutral, examples, _ = case
    falling, straight = (
        example_based(rig, neutral, examples, named(rig, WEIGHTS), schedule=schedule)
        for schedule in ("geometric", "linear")
    )
    assert straight.history[4].alpha == pytest.approx(0.5 - 4 * 0.4 / 9)
    assert straight.history[-1].rms_percent == pytest.approx(falling.history[-1].rms_percent, rel=0.2)


def test_four_geometric_iterations_reach_what_ten_reach(case):
    rig, neutral, examples, _ = case
    ten, four = (
        example_based(rig, neutral, examples, named(rig, WEIGHTS), iterations=count).history[-1].rms_percent
        for count in (10, 4)
    )
    assert four <= 1.25 * ten


def test_estimated_weights_explain_as_well_as_true_ones(case):
    rig, neutral, examples, _ = case
    given, guessed = (
        example_based(rig, neutral, examples, weights).history[-1].rms_percent
        for weights in (named(rig, WEIGHTS), None)
    )
    assert guessed <= 1.1 * given


@pytest.mark.parametrize("noise", [0.05, 0.15])
def test_noise_in_the_starting_weights_changes_little(case, noise):
    rig, neutral, examples, _ = case
    draw = np.random.default_rng(2)
    off = np.where(WEIGHTS > 0.0, np.clip(WEIGHTS + draw.normal(0.0, noise, WEIGHTS.shape), 0.0, 1.0), 0.0)
    exact, noisy = (
        example_based(rig, neutral, examples, named(rig, w)).history[-1].rms_percent for w in (WEIGHTS, off)
    )
    assert noisy <= 1.5 * exact


def test_only_the_shapes_named_explain_examples(case):
    rig, neutral, examples, _ = case
    result = example_based(rig, neutral, examples, shapes=rig.names[:2])
    assert {name for weights in result.weights for name in weights} <= set(rig.names[:2])
    np.testing.assert_array_equal(result.rig.deltas[2:], transfer(rig, neutral).rig.deltas[2:])


def test_each_iteration_is_told_before_the_progress(case):
    rig, neutral, examples, _ = case
    told = []
    result = example_based(
        rig, neutral, examples, iterations=3,
        each=lambda one: told.append(one), progress=lambda share, doing: told.append(doing),
    )  # fmt: skip
    turns = [k for k, one in enumerate(told) if not isinstance(one, str)]
    assert tuple(told[k] for k in turns) == result.history
    assert all(told[k + 1].startswith(f"iteration {n} of 3") for n, k in enumerate(turns, start=1))


def test_a_mesh_with_looks_of_its_own_is_kept_and_arrays_get_the_templates(case):
    rig, neutral, _, _ = case
    by_array = transfer(rig, neutral).rig.neutral
    np.testing.assert_array_equal(by_array.polygon_starts, rig.neutral.polygon_starts)
    np.testing.assert_array_equal(by_array.positions, neutral.astype(np.float32))
