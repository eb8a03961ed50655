"""The fast numpy blend gives the reference's positions, whichever way it sums."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.blend import Blend
from facemorph.core.morph import morphed_positions
from facemorph.core.rig import Rig
from tests.gl.heads import many_shapes


def error(rig: Rig, positions: np.ndarray, coefficients: np.ndarray) -> float:
    """Largest distance from the reference in fractions of the diagonal."""
    wanted = morphed_positions(rig.neutral.positions, rig.deltas, coefficients)
    return float(np.linalg.norm(positions - wanted, axis=1).max()) / rig.neutral.diagonal


@pytest.mark.parametrize("block", [6, 60, 3 << 11])
def test_any_mixture_of_active_shapes_is_the_references(monkeypatch, block: int) -> None:
    monkeypatch.setattr("facemorph.core.blend._BLOCK", block)
    rig = many_shapes(30)
    blend = Blend(rig.neutral.positions, rig.deltas)
    random = np.random.default_rng(1)
    for share in (0.0, 0.05, 0.3, 0.7, 1.0):
        coefficients = random.normal(size=30) * (random.random(30) < share)
        assert error(rig, blend(coefficients), coefficients) < 1e-6


def test_long_dragging_of_one_shape_among_many_does_not_drift() -> None:
    rig = many_shapes(30)
    blend = Blend(rig.neutral.positions, rig.deltas)
    random = np.random.default_rng(2)
    coefficients = random.normal(size=30)
    for step in range(3000):
        coefficients[random.integers(30)] = random.normal() * 2.0
        positions = blend(coefficients)
        if step % 100 == 99:
            assert error(rig, positions, coefficients) < 1e-6
    assert blend.by_change > 5 * blend.fully, "one slider of many is meant to be summed by change"
    assert blend.fully > 1, "3,000 changes are more than float32 bears without a sum in full"


def test_an_exact_sum_does_not_depend_on_what_was_asked_before() -> None:
    rig = many_shapes(12)
    used, fresh = (Blend(rig.neutral.positions, rig.deltas) for _ in range(2))
    coefficients = np.linspace(-0.5, 1.5, 12)
    for k in range(12):
        moved = coefficients.copy()
        moved[k] += 0.1
        used(moved)
    assert np.array_equal(used(coefficients, exactly=True), fresh(coefficients, exactly=True))


def test_back_at_neutral_the_face_is_neutral_to_the_bit() -> None:
    rig = many_shapes(8)
    blend = Blend(rig.neutral.positions, rig.deltas)
    blend(np.full(8, 0.37))
    blend(np.eye(8)[3])
    assert np.array_equal(blend(np.zeros(8)), rig.neutral.positions)


@pytest.mark.parametrize("share", [0.1, 0.9])
def test_shapes_that_move_a_part_are_summed_where_they_move(monkeypatch, share: float) -> None:
    monkeypatch.setattr("facemorph.core.blend._BLOCK", 33)
    rig = many_shapes(9)
    random = np.random.default_rng(3)
    deltas = random.normal(size=rig.deltas.shape).astype(np.float32)
    count = deltas.shape[1]
    for delta in deltas:
        delta[np.roll(np.arange(count) >= share * count, random.integers(count))] = 0.0
    deltas[4] = 0.0
    blend = Blend(rig.neutral.positions, deltas)
    for coefficients in (np.ones(9), random.normal(size=9), np.arange(9) % 2.0, -np.eye(9)[8], np.eye(9)[4]):
        wanted = morphed_positions(rig.neutral.positions, deltas, coefficients)
        assert np.abs(blend(coefficients, exactly=True) - wanted).max() < 2e-6 * np.abs(wanted).max()


def test_inactive_shapes_are_not_even_looked_at() -> None:
    rig = many_shapes(6)
    deltas = rig.deltas.copy()
    deltas[[0, 2, 5]] = np.nan
    coefficients = np.array([0.0, 0.5, 0.0, -0.5, 1.0, 0.0])
    assert np.isfinite(Blend(rig.neutral.positions, deltas)(coefficients)).all()
