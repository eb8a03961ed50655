"""Weights of rigs whose correctives follow from them, against scipy's minimum of the same cost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

from facemorph.core.correctives import CORRECTIVE, Corrective, Hat
from facemorph.core.rig import Rig
from facemorph.fit import example_based, transfer
from facemorph.fit.explaining import Explaining
from tests.fit.faces import NAMES, mixed, sheet_rig, styled

RULES = (
    Corrective("sneer", hats=(Hat("smile"),)),
    Corrective("pout", product=("puff",), hats=(Hat("frown", 0.0, 0.3, 4.0),)),
)


@pytest.fixture(scope="module")
def rig() -> Rig:
    """Four shapes; a fifth that the first switches on half way, a sixth on the second and third together."""
    plain = sheet_rig(6)
    shapes = tuple(replace(shape, set=CORRECTIVE) if k > 3 else shape for k, shape in enumerate(plain.shapes))
    return replace(plain, shapes=shapes, correctives=RULES)


def _planes(rig: Rig) -> np.ndarray:
    return rig.deltas.astype(np.float64).transpose(0, 2, 1)


def _rows(rig: Rig, weights: np.ndarray) -> list[dict[str, float]]:
    names = [shape.name for shape in rig.controls]
    return [dict(zip(names, row.tolist(), strict=True)) for row in weights]


@pytest.mark.parametrize("seed", range(6))
def test_the_minimum_is_scipys_from_the_same_start(rig, seed):
    draw = np.random.default_rng(seed)
    explaining = Explaining(rig, NAMES[:4])
    planes, near = _planes(rig), draw.uniform(0.0, 1.0, (1, 4))
    true = np.where(draw.random(4) < 0.3, 0.0, draw.uniform(0.0, 1.0, 4))[None]
    moves = np.tensordot(explaining.coefficients(true), planes, 1) + draw.normal(0.0, 0.02, planes[:1].shape)
    stiffness = 0.05
    pull = stiffness * (planes[:4] ** 2).sum() / 4

    def cost(x: np.ndarray) -> float:
        left = moves - np.tensordot(explaining.coefficients(x[None]), planes, 1)
        return float((left**2).sum() + pull * ((x - near[0]) ** 2).sum())

    found = explaining.weights(planes, moves, near, stiffness)[0]
    truth = minimize(cost, near[0], bounds=[(0.0, 1.0)] * 4, tol=1e-12)
    assert found.min() >= 0.0 and found.max() <= 1.0
    assert cost(found) <= truth.fun * (1.0 + 1e-6)


@pytest.mark.parametrize("strength", [0.5, 1.0, 8.0])
def test_step_b_never_ends_above_where_it_began(rig, strength):
    draw = np.random.default_rng(3)
    explaining = Explaining(rig, NAMES[:4])
    planes = _planes(rig).copy()
    planes[4:] *= strength
    near, moves = draw.uniform(0.0, 1.0, (5, 4)), draw.normal(0.0, 0.2, (5, *planes.shape[1:]))
    found = explaining.weights(planes, moves, near, 0.0)
    for x, begun, move in zip(found, near, moves, strict=True):
        before, after = (
            ((move - np.tensordot(explaining.coefficients(w[None])[0], planes, 1)) ** 2).sum()
            for w in (begun, x)
        )
        assert after <= before


def test_a_persons_own_weights_are_found_again_with_what_they_switch_on(rig):
    weights = np.array([[0.5, 0.6, 0.7, 0.0], [0.0, 0.9, 0.3, 0.4]])
    faces = [rig.positions(row) for row in _rows(rig, weights)]
    result = example_based(rig, rig.neutral, faces)
    for row, found in zip(_rows(rig, weights), result.weights, strict=True):
        for name, value in row.items():
            assert found.get(name, 0.0) == pytest.approx(value, abs=0.02)
    assert result.history[-1].rms_percent < 0.01


def test_the_error_falls_with_every_iteration(rig):
    neutral, offsets = styled(rig)
    weights = np.array([[0.6, 0.0, 0.8, 0.0], [0.0, 0.9, 0.5, 0.4], [1.0, 0.3, 0.0, 0.0]])
    coefficients = Explaining(rig, NAMES[:4]).coefficients(weights)
    result = example_based(rig, neutral, mixed(neutral, offsets, coefficients))
    errors = [turn.rms_percent for turn in result.history]
    assert (np.diff(errors) < 0.0).all()
    for one, face in zip(result.examples, mixed(neutral, offsets, coefficients).values(), strict=True):
        made = result.rig.positions(one.weights)
        np.testing.assert_allclose(made + one.offsets, face, atol=1e-5 * rig.neutral.diagonal)
    # Half way to an example, other correctives are on: that too is nearer than plain transfer is.
    plain = transfer(rig, neutral).rig
    half = {name: value / 2.0 for name, value in _rows(rig, weights)[1].items()}
    truth = neutral + np.tensordot(rig.coefficients(half), offsets, 1)
    far, near = (np.linalg.norm(one.positions(half) - truth) for one in (plain, result.rig))
    assert near < 0.8 * far


def test_correctives_at_rest_count_for_nothing(rig):
    weights = np.array([[0.5, 0.6, 0.7, 0.0]])
    linear = rig.linear()
    explaining = Explaining(linear, NAMES[:4])
    np.testing.assert_array_equal(explaining.coefficients(weights)[:, 4:], [[0.0, 0.0]])
    planes = _planes(linear)
    moves = np.tensordot(explaining.coefficients(weights), planes, 1)
    np.testing.assert_allclose(explaining.weights(planes, moves, 0 * weights, 0.0), weights, atol=1e-8)


def test_a_corrective_whose_driver_may_not_explain_stays_silent(rig):
    explaining = Explaining(rig, ("smile", "puff"))
    assert not explaining.coefficients(np.array([[0.0, 1.0]]))[0, 5]
    planes = _planes(rig)
    moves = np.tensordot(explaining.coefficients(np.array([[0.4, 0.7]])), planes, 1)
    found = explaining.weights(planes, moves, np.array([[0.3, 0.5]]), 0.0)
    np.testing.assert_allclose(found, [[0.4, 0.7]], atol=1e-4)
