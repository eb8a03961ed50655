"""Laws of the weighted sum and of easing."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.mesh import Mesh
from facemorph.core.morph import checked_curve, eased, mixed_coefficients, morphed_positions
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import MeshDataError, OptionError, PoseError, UnknownNameError

UNIT = st.floats(0, 1)


@pytest.mark.parametrize("curve", ["linear", "cosine"])
def test_easing_begins_at_0_and_ends_at_1(curve):
    assert eased(0.0, curve) == 0.0
    assert eased(1.0, curve) == pytest.approx(1.0, abs=1e-15)


def test_cosine_has_no_speed_at_either_end_and_the_greatest_in_the_middle():
    h = 1e-6
    assert (eased(h, "cosine") - eased(0, "cosine")) / h == pytest.approx(0, abs=1e-5)
    assert (eased(1, "cosine") - eased(1 - h, "cosine")) / h == pytest.approx(0, abs=1e-5)
    assert (eased(0.5 + h, "cosine") - eased(0.5 - h, "cosine")) / (2 * h) == pytest.approx(
        np.pi / 2, abs=1e-5
    )


@given(UNIT, UNIT)
def test_easing_never_turns_back(a, b):
    low, high = sorted((a, b))
    assert eased(low, "cosine") <= eased(high, "cosine") + 1e-15


@given(st.floats(-3, 4))
def test_cosine_is_symmetric_about_the_middle(t):
    assert eased(t, "cosine") + eased(1 - t, "cosine") == pytest.approx(1.0, abs=1e-12)


def test_an_unknown_curve_is_refused_with_the_choices():
    with pytest.raises(OptionError, match="linear, cosine"):
        checked_curve("bounce")


def test_weight_0_is_the_neutral_exactly(small_rig):
    assert np.array_equal(small_rig.positions({"happy": 0.0}), small_rig.neutral.positions)


def test_weight_1_is_the_target(small_rig):
    target = small_rig.neutral.positions + small_rig.deltas[1]
    np.testing.assert_allclose(small_rig.positions({"sad": 1.0}), target, atol=1e-6)


@given(t=UNIT, curve=st.sampled_from(["linear", "cosine"]))
def test_between_two_states_every_vertex_stays_on_the_line(t, curve):
    neutral = np.array([[0, 0, 0], [1, 2, 3]], np.float32)
    deltas = np.array([[[1, 0, 0], [0, 1, 0]], [[0, 0, 2], [4, 0, 0]]], np.float32)
    coefficients = mixed_coefficients(np.array([1.0, 0]), np.array([0, 1.0]), np.zeros(2), t, curve)
    e = eased(t, curve)
    expected = (1 - e) * (neutral + deltas[0]) + e * (neutral + deltas[1])
    np.testing.assert_allclose(morphed_positions(neutral, deltas, coefficients), expected, atol=1e-6)


def test_the_order_of_shapes_does_not_matter(small_rig):
    one = small_rig.positions({"happy": 0.3, "sad": 0.7})
    other = small_rig.positions({"sad": 0.7, "happy": 0.3})
    assert np.array_equal(one, other)


def test_permuting_vertices_permutes_the_result(small_rig):
    order = np.random.default_rng(1).permutation(small_rig.neutral.vertex_count)
    mesh = Mesh.from_triangles(small_rig.neutral.positions[order], np.zeros((0, 3), np.int32))
    permuted = Rig(mesh, small_rig.shapes, np.ascontiguousarray(small_rig.deltas[:, order]))
    pose = {"happy": 0.4, "jawOpen": -0.5}
    assert np.array_equal(permuted.positions(pose), small_rig.positions(pose)[order])


@given(st.floats(-2, 3), st.floats(-2, 3))
def test_weights_outside_0_and_1_extrapolate(a, b):
    neutral = np.zeros((1, 3), np.float32)
    deltas = np.array([[[1, 0, 0]], [[0, 1, 0]]], np.float32)
    np.testing.assert_allclose(morphed_positions(neutral, deltas, np.array([a, b]))[0], [a, b, 0], atol=1e-6)


@given(t=UNIT, curve=st.sampled_from(["linear", "cosine"]), added=st.floats(-1, 2))
def test_rebasing_does_not_move_the_face(t, curve, added):
    names = ("happy", "sad", "angry")
    pose = Pose({"happy": 1.0}, {"sad": 1.0}, t, curve, {"angry": added})
    np.testing.assert_allclose(
        pose.rebased("angry").coefficients(names), pose.coefficients(names), atol=1e-12
    )


def test_rebasing_ends_at_the_new_target():
    pose = Pose.between("happy", "sad", 0.4).rebased("angry")
    assert pose.t == 0.0
    end = Pose(pose.source, pose.target, 1.0, pose.curve)
    np.testing.assert_allclose(end.coefficients(("happy", "sad", "angry")), [0, 0, 1], atol=1e-15)


def test_an_unknown_shape_is_named_with_the_one_that_was_meant(small_rig):
    with pytest.raises(UnknownNameError, match="Did you mean 'happy'"):
        small_rig.positions({"hapy": 1.0})


@pytest.mark.parametrize("weight", [float("nan"), float("inf")])
def test_a_weight_that_is_no_number_is_refused(small_rig, weight):
    with pytest.raises(PoseError, match="happy"):
        small_rig.positions({"happy": weight})
    with pytest.raises(PoseError, match="slider"):
        small_rig.positions(Pose.between("neutral", "happy", weight))


def test_a_rig_refuses_two_shapes_of_one_name_and_deltas_that_do_not_fit(small_rig):
    with pytest.raises(MeshDataError, match="happy"):
        Rig(small_rig.neutral, (small_rig.shapes[0],) * 2, small_rig.deltas[:2])
    with pytest.raises(MeshDataError, match="deltas must be"):
        Rig(small_rig.neutral, small_rig.shapes, small_rig.deltas[:2])
