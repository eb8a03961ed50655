"""Step A in closed form and step B with bounds, against dense solves and scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from facemorph.errors import FitError
from facemorph.fit import steps
from facemorph.fit.steps import bounded_minimum, freedom, pulled_shapes, pulls
from tests.fit.weights import fitted_weights

DRAW = np.random.default_rng(11)


def _case(m=3, shapes=5, rows=6, count=17):
    return (
        DRAW.normal(size=(shapes, rows, count)).astype(np.float32),
        DRAW.uniform(0.05, 1.2, (shapes, count)).astype(np.float32),
        DRAW.normal(size=(m, rows, count)).astype(np.float32),
        np.where(DRAW.random((m, shapes)) < 0.6, DRAW.uniform(0.2, 1.0, (m, shapes)), 0.0),
    )


def _made(prior, free, examples, weights, alpha):
    return prior + pulled_shapes(pulls(prior, free, examples, weights, alpha), free, weights)


@pytest.mark.parametrize("alpha", [0.01, 0.1, 3.0])
def test_step_a_equals_the_dense_solve_of_each_triangle(alpha):
    prior, free, examples, weights = _case()
    made = _made(prior, free, examples, weights, alpha)
    for t in range(prior.shape[2]):
        w = np.diag(1.0 / free[:, t].astype(np.float64))
        dense = np.linalg.solve(
            weights.T @ weights + alpha * w, weights.T @ examples[..., t] + alpha * w @ prior[..., t]
        )
        np.testing.assert_allclose(made[..., t], dense, atol=2e-5)


def test_step_a_is_the_same_in_pieces(monkeypatch):
    case = _case(m=4, count=50)
    whole = pulls(*case, 0.1)
    monkeypatch.setattr(steps, "_AT_ONCE", 1)
    monkeypatch.setattr(steps, "_TRIANGLES_AT_ONCE", 7)
    np.testing.assert_array_equal(pulls(*case, 0.1), whole)


def test_step_a_leaves_shapes_that_no_example_uses():
    prior, free, examples, weights = _case()
    weights[:, 2] = 0.0
    np.testing.assert_array_equal(_made(prior, free, examples, weights, 0.1)[2], prior[2])


def test_step_a_with_a_very_large_alpha_is_the_prior():
    prior, free, examples, weights = _case()
    np.testing.assert_allclose(_made(prior, free, examples, weights, 1e12), prior, atol=1e-9)


def test_step_a_meets_the_mean_of_examples_of_the_same_weights_at_any_alpha():
    prior, free, examples, weights = _case(m=6, shapes=2)
    weights[:] = (1.0, 0.5)
    made = _made(prior, free, examples, weights, 1e-12)
    mean = np.broadcast_to(examples.mean(axis=0), examples.shape)
    np.testing.assert_allclose(np.tensordot(weights, made, 1), mean, atol=2e-3)


def test_step_a_with_a_tiny_alpha_meets_examples_that_can_be_met():
    prior, free, examples, weights = _case(m=2, shapes=5)
    weights[:] = DRAW.uniform(0.2, 1.0, weights.shape)
    made = _made(prior, free, examples, weights, 1e-7)
    np.testing.assert_allclose(np.tensordot(weights, made, 1), examples, atol=1e-3)


def test_examples_of_the_same_weights_are_averaged_not_singular():
    prior, free, examples, weights = _case(m=2)
    weights[1] = weights[0]
    mean = np.repeat(examples.mean(axis=0, keepdims=True), 2, axis=0)
    both, one = (_made(prior, free, e, weights, 0.1) for e in (examples, mean))
    np.testing.assert_allclose(both, one, atol=1e-4)


def test_freedom_grows_with_motion_and_its_95th_percentile_is_1():
    change = np.abs(DRAW.normal(0.0, 2.0, (2, 4000))).astype(np.float32)
    free = freedom(change)
    np.testing.assert_allclose(np.percentile(free, 95.0, axis=1), 1.0, rtol=1e-5)
    order = np.argsort(change[0])
    assert (np.diff(free[0, order]) >= 0.0).all()
    raw = ((0.1 + change[0]) / (1.0 + change[0])) ** 2
    np.testing.assert_allclose(free[0] / free[0].max(), raw / raw.max(), rtol=1e-5)


def test_where_a_shape_moves_nothing_it_is_a_tenth_as_free_at_most():
    change = np.zeros((2, 1000), np.float32)
    change[0, :20] = 0.8
    free = freedom(change)
    assert free[0, 20:].max() <= 0.1 + 1e-6
    assert free[1].max() <= 0.1 + 1e-6
    assert freedom(np.zeros((0, 10), np.float32)).shape == (0, 10)


@pytest.mark.parametrize("shapes", [1, 4, 30])
@pytest.mark.parametrize("stiffness", [0.0, 0.3])
def test_step_b_equals_scipys_bounded_least_squares(shapes, stiffness):
    basis = DRAW.normal(size=(shapes, 80)) + DRAW.normal(size=80)
    near = DRAW.uniform(0.0, 1.0, (3, shapes))
    faces = DRAW.uniform(-0.5, 1.5, (3, shapes)) @ basis + 0.1 * DRAW.normal(size=(3, 80))
    found = fitted_weights(basis, faces, near, stiffness)
    assert found.min() >= 0.0 and found.max() <= 1.0
    pull = np.sqrt(stiffness * (basis**2).sum() / shapes)
    for x, face, row in zip(found, faces, near, strict=True):
        matrix = np.vstack([basis.T, pull * np.eye(shapes)])
        truth = lsq_linear(matrix, np.concatenate([face, pull * row]), (0, 1), method="bvls", max_iter=500).x
        np.testing.assert_allclose(x, truth, atol=1e-8)


def test_step_b_meets_the_conditions_of_a_minimum_among_shapes_alike():
    low = DRAW.normal(size=(25, 60)) @ DRAW.normal(size=(60, 90))
    basis = np.vstack([low, low[:5], DRAW.dirichlet(np.ones(25), 10) @ low])
    gram = basis @ basis.T
    side = basis @ (DRAW.uniform(0, 0.7, len(basis)) @ basis + DRAW.normal(size=90))
    x = bounded_minimum(gram, side)
    slope = (gram @ x - side) / np.abs(side).max()
    assert (slope[x <= 0.0] > -1e-7).all()
    assert (slope[x >= 1.0] < 1e-7).all()
    assert np.abs(slope[(x > 0.0) & (x < 1.0)]).max(initial=0.0) < 1e-7


def test_where_the_search_begins_does_not_change_the_minimum():
    basis = DRAW.normal(size=(12, 40))
    gram, side = basis @ basis.T, basis @ DRAW.normal(size=40) * 3
    cold = bounded_minimum(gram, side)
    for _ in range(5):
        np.testing.assert_allclose(
            bounded_minimum(gram, side, begin=DRAW.uniform(-1, 2, 12)), cold, atol=1e-9
        )


def test_a_shape_without_motion_gets_no_weight():
    basis = DRAW.normal(size=(4, 30))
    basis[2] = 0.0
    found = fitted_weights(basis, basis[[0]] + basis[[3]], np.zeros((1, 4)), 0.0)
    np.testing.assert_allclose(found, [[1.0, 0.0, 0.0, 1.0]], atol=1e-8)
    assert not fitted_weights(np.zeros((3, 30)), np.ones((1, 30)), np.zeros((1, 3)), 0.5).any()


def test_a_stiff_step_b_keeps_what_is_given():
    basis = DRAW.normal(size=(4, 30))
    near = DRAW.uniform(0, 1, (2, 4))
    np.testing.assert_allclose(fitted_weights(basis, DRAW.normal(size=(2, 30)), near, 1e9), near, atol=1e-6)


def test_shapes_that_are_no_numbers_are_refused():
    with pytest.raises(FitError, match="no finite numbers"):
        fitted_weights(np.full((2, 9), np.nan), np.ones((1, 9)), np.zeros((1, 2)), 0.1)
