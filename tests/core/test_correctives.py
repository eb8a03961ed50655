"""Correctives follow from other shapes' weights by the documented rule, and rest at both ends."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.correctives import Activation, Corrective, Hat, hat
from facemorph.core.mesh import Mesh
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, Shape
from facemorph.errors import MeshDataError

NAMES = ("a", "b", "fix")


def rig(*rules: Corrective, deltas: np.ndarray | None = None) -> Rig:
    """A triangle with shapes a and b and a corrective."""
    triangle = Mesh(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32),
        np.array([0, 3], np.int32),
        np.array([0, 1, 2], np.int32),
    )
    if deltas is None:
        deltas = np.random.default_rng(1).normal(size=(3, 3, 3)).astype(np.float32)
    shapes = (Shape("a", "A"), Shape("b", "B"), Shape("fix", "Fix", "corrective"))
    return Rig(triangle, shapes, deltas, correctives=rules)


@given(st.floats(-2, 3))
def test_a_hat_over_0_to_1_is_4_c_times_1_minus_c_and_nothing_outside(c: float) -> None:
    expected = 4.0 * c * (1.0 - c) if 0.0 < c < 1.0 else 0.0
    assert hat(c, 0.0, 0.5, 1.0) == pytest.approx(expected, abs=1e-12)


@given(st.floats(0.05, 0.95))
def test_a_hat_is_1_at_its_peak_and_0_at_its_feet_wherever_the_peak_is(peak: float) -> None:
    assert hat(peak, 0.0, peak, 1.0) == pytest.approx(1.0)
    assert hat(0.0, 0.0, peak, 1.0) == hat(1.0, 0.0, peak, 1.0) == 0.0


@given(st.floats(-1, 2), st.floats(-1, 2))
def test_a_product_is_that_of_the_weights_kept_from_0_to_1(a: float, b: float) -> None:
    after = Activation(NAMES, [Corrective("fix", ("a", "b"))])(np.array([a, b, 0.25]))
    assert after[:2].tolist() == [a, b]
    assert after[2] == pytest.approx(0.25 + min(max(a, 0), 1) * min(max(b, 0), 1))


def test_a_hat_takes_a_chord_onto_the_arc_of_a_rotation() -> None:
    """A vertex turned by 40 degrees about z: the straight way misses the arc, the corrected one does not."""
    angle, start = math.radians(40.0), np.array([0.0, 1.0, 0.0])

    def turned(part: float) -> np.ndarray:
        c, s = math.cos(part * angle), math.sin(part * angle)
        return np.array([-s, c, 0.0])

    deltas = np.zeros((3, 3, 3), np.float32)
    deltas[0, 2] = turned(1.0) - start
    deltas[2, 2] = turned(0.5) - (start + turned(1.0)) / 2.0
    face = rig(Corrective("fix", hats=(Hat("a"),)), deltas=deltas)
    for part in np.linspace(0.0, 1.0, 21):
        straight = face.linear().positions({"a": part})[2]
        bent = face.positions({"a": part})[2]
        assert np.linalg.norm(bent - turned(part)) < 0.004
        assert abs(np.linalg.norm(bent) - 1.0) <= abs(np.linalg.norm(straight) - 1.0) + 1e-6
    assert np.linalg.norm(face.linear().positions({"a": 0.5})[2]) < 0.95


def test_at_both_ends_a_corrected_face_is_the_shape_itself() -> None:
    face = rig(Corrective("fix", hats=(Hat("a"),)))
    for weights in ({}, {"a": 1.0}):
        assert np.array_equal(face.positions(weights), face.linear().positions(weights))


def test_without_correctives_every_face_is_the_plain_sum() -> None:
    face = rig(Corrective("fix", ("a", "b")))
    pose = Pose.of({"a": 0.7, "b": 0.4})
    plain = face.neutral.positions + 0.7 * face.deltas[0] + 0.4 * face.deltas[1]
    assert np.allclose(face.linear().positions(pose), plain, atol=1e-6)
    assert np.allclose(face.positions(pose), plain + 0.28 * face.deltas[2], atol=1e-6)


def test_what_follows_from_others_is_no_control() -> None:
    assert [shape.name for shape in rig(Corrective("fix", ("a",))).controls] == ["a", "b"]


@pytest.mark.parametrize(
    ("rule", "told"),
    [
        (Corrective("fix"), "follows no shape"),
        (Corrective("fix", ("c",)), "'c', which is no shape"),
        (Corrective("other", ("a",)), "'other', which is no shape"),
        (Corrective("fix", ("fix",)), "a corrective itself"),
        (Corrective("fix", hats=(Hat("a", 0.0, 1.0, 1.0),)), "must grow"),
    ],
)
def test_a_rule_that_cannot_be_followed_is_refused(rule: Corrective, told: str) -> None:
    with pytest.raises(MeshDataError, match=told):
        rig(rule)
