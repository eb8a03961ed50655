"""What no shape explains is told, and may join the rig as a shape."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.errors import FitError, UnknownNameError
from facemorph.fit import Example, FitResult, example_based, unexplained, with_residual
from tests.fit.faces import mixed, named, sheet_rig, styled

WEIGHTS = np.array([[1.0, 0.0], [0.3, 0.8]])


@pytest.fixture(scope="module")
def fitted():
    """A rig of two shapes fitted to a face of them and to one with a bulge that neither makes."""
    rig = sheet_rig(2)
    neutral, offsets = styled(rig)
    faces = mixed(neutral, offsets, WEIGHTS)
    bulge = np.exp(-4.0 * ((neutral[:, :2] - (1.2, -0.8)) ** 2).sum(axis=1))
    faces["face 1"] = faces["face 1"] + bulge[:, None] * (0.0, 0.0, 0.4)
    return example_based(rig, neutral, faces, named(rig, WEIGHTS), hold_still=False), faces


def test_only_the_example_that_shapes_cannot_make_is_reported(fitted):
    result, _ = fitted
    worst = [one.worst_percent for one in result.examples]
    assert worst[1] > 2.0 * worst[0]
    between = (worst[0] + worst[1]) / 2
    assert [one.name for one in unexplained(result, between)] == ["face 1"]
    assert len(unexplained(result, worst[0] / 2)) == 2
    assert unexplained(result, 2.0 * worst[1]) == ()


def test_the_residual_as_a_shape_meets_its_example_exactly(fitted):
    result, faces = fitted
    more = with_residual(result, "face 1", " bulge ")
    assert more.rig.names == (*result.rig.names, "bulge")
    assert more.rig.shape("bulge").label == "Bulge"
    met = more.examples[1]
    assert met.weights["bulge"] == 1.0 and met.largest == 0.0
    still = faces["face 1"]
    np.testing.assert_allclose(more.rig.positions(met.weights), still, atol=2e-6 * more.rig.neutral.diagonal)
    assert more.examples[0] is result.examples[0]
    assert unexplained(more, result.examples[0].worst_percent * 1.01) == ()
    assert result.rig.names == sheet_rig(2).names


def test_the_bulge_is_where_the_residual_is(fitted):
    result, _ = fitted
    bulge = with_residual(result, "face 1", "bulge").rig.deltas[-1]
    at = result.rig.neutral.positions[np.argmax(np.linalg.norm(bulge, axis=1)), :2]
    assert np.linalg.norm(at - (1.2, -0.8)) < 0.5


def test_names_that_are_taken_or_empty_or_unknown_are_refused(fitted):
    result, _ = fitted
    for name in ("", "  ", "smile", "neutral"):
        with pytest.raises(FitError, match="a name of its own"):
            with_residual(result, "face 1", name)
    with pytest.raises(UnknownNameError, match="face 2"):
        with_residual(result, "face 2", "bulge")
    for threshold in (0.0, -1.0, float("nan")):
        with pytest.raises(FitError, match="above 0 %"):
            unexplained(result, threshold)


def test_a_few_stray_vertices_do_not_make_an_example_unexplained():
    offsets = np.zeros((1000, 3), np.float32)
    offsets[0, 0] = 50.0
    one = Example("stray", {}, offsets, 100.0)
    assert one.largest_percent == 50.0 and one.worst_percent == 0.0
    offsets[:5, 0] = 1.0
    assert one.worst_percent == pytest.approx(1.0)
    assert unexplained(FitResult(sheet_rig(1), (one,))) == (one,)
