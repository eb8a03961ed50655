"""Similarities between corresponding points."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.fit.align import Similarity, similarity
from tests.fit.faces import turned

DRAW = np.random.default_rng(6)
POINTS = DRAW.normal(size=(20, 3)) * (3, 1, 0.5) + 40.0


@pytest.mark.parametrize("scale", [1e-3, 1.0, 250.0])
def test_a_similarity_is_found_again_and_undone(scale):
    way = Similarity(scale, turned(70.0, 0) @ turned(-160.0, 2), np.array([3.0, -200.0, 8.0]))
    moved = way.points(POINTS)
    found = similarity(POINTS, moved)
    assert found.scale == pytest.approx(scale)
    np.testing.assert_allclose(found.rotation, way.rotation, atol=1e-9)
    np.testing.assert_allclose(found.points(POINTS), moved, rtol=1e-9)
    np.testing.assert_allclose(found.inverse().points(moved), POINTS, rtol=1e-9)
    np.testing.assert_allclose(
        found.offsets(POINTS[1:] - POINTS[:-1]), np.diff(moved, axis=0), atol=1e-8 * scale
    )


def test_it_is_the_nearest_of_its_kind():
    target = POINTS @ turned(20.0).T * 1.3 + DRAW.normal(size=POINTS.shape)

    def far(way: Similarity) -> float:
        return float(((way.points(POINTS) - target) ** 2).sum())

    best = similarity(POINTS, target)
    for axis in range(3):
        for degrees in (-2.0, 2.0):
            turn = best.rotation @ turned(degrees, axis)
            shift = target.mean(axis=0) - best.scale * turn @ POINTS.mean(axis=0)
            assert far(Similarity(best.scale, turn, shift)) > far(best)
    for scale in (0.97, 1.03):
        shift = target.mean(axis=0) - scale * best.scale * best.rotation @ POINTS.mean(axis=0)
        assert far(Similarity(scale * best.scale, best.rotation, shift)) > far(best)


def test_a_rigid_motion_keeps_sizes_and_a_mirror_image_is_not_mirrored():
    assert similarity(POINTS, 3.0 * POINTS, scaled=False).scale == 1.0
    for target in (POINTS * (-1, 1, 1), POINTS * (1, 1, -1), -POINTS):
        assert np.linalg.det(similarity(POINTS, target).rotation) == pytest.approx(1.0)


@pytest.mark.parametrize(
    "points", [POINTS[:1], POINTS[:2], np.ones((5, 3)), np.outer(np.arange(4.0), (1, 2, 3))]
)
def test_points_that_leave_the_turn_open_are_not_turned(points):
    found = similarity(points, points + 2.0)
    np.testing.assert_array_equal(found.rotation, np.eye(3))
    np.testing.assert_allclose(found.points(points), points + 2.0)


def test_flat_points_are_turned_within_space():
    flat = np.c_[DRAW.normal(size=(9, 2)), np.zeros(9)]
    turn = turned(130.0, 0) @ turned(40.0, 2)
    np.testing.assert_allclose(similarity(flat, flat @ turn.T).rotation, turn, atol=1e-12)
