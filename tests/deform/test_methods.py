"""Laws of sided units, people, regions, and of adding methods up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.correctives import Corrective, Hat
from facemorph.core.facs import Sides
from facemorph.core.motion import Contribution, total
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, Shape
from facemorph.deform.people import People, PeopleMix, bilinear
from facemorph.deform.regions import RegionControl, RegionSet, painted, rotation
from facemorph.deform.sides import SidedUnits, left_weights
from facemorph.errors import CorrespondenceError, DeformError, UnknownNameError
from tests.conftest import bumpy_grid

UNIT = st.floats(0, 1)


@pytest.fixture
def facs_rig(small_rig):
    shapes = tuple(Shape(name, name, "facs") for name in ("AU1", "AU12", "AU15"))
    return replace(small_rig, shapes=shapes)


@pytest.fixture
def other(small_rig):
    rng = np.random.default_rng(3)
    mesh = small_rig.neutral.with_positions(small_rig.neutral.positions * np.float32(1.1) + np.float32(0.2))
    deltas = small_rig.deltas + rng.normal(scale=0.02, size=small_rig.deltas.shape).astype(np.float32)
    return Rig(mesh, small_rig.shapes, deltas)


def test_equal_sides_are_the_unit_itself(facs_rig):
    assert SidedUnits(facs_rig)({12: Sides.both(0.7)}).offsets is None
    assert SidedUnits(facs_rig)({12: Sides.both(0.7)}).weights == {"AU12": 0.7}


def test_left_and_right_together_are_the_whole_unit(facs_rig):
    units = SidedUnits(facs_rig)
    left, right = units({12: Sides(0.8, 0.0)}), units({12: Sides(0.0, 0.8)})
    both = (left + right).positions(facs_rig, Pose())
    np.testing.assert_allclose(both, facs_rig.positions({"AU12": 0.8}), atol=1e-6)


def test_a_left_unit_moves_the_far_left_wholly_and_the_far_right_not_at_all(facs_rig):
    moved = SidedUnits(facs_rig)({12: Sides(1.0, 0.0)}).positions(facs_rig, Pose())
    whole = facs_rig.positions({"AU12": 1.0})
    x = facs_rig.neutral.positions[:, 0]
    np.testing.assert_allclose(moved[x > 1], whole[x > 1], atol=1e-6)
    np.testing.assert_allclose(moved[x < -1], facs_rig.neutral.positions[x < -1], atol=1e-6)


def test_the_border_between_the_sides_is_smooth_and_symmetric(facs_rig):
    weights, x = left_weights(facs_rig), facs_rig.neutral.positions[:, 0]
    assert weights[np.abs(x) < 1e-6] == pytest.approx(0.5)
    order = np.argsort(x)
    assert (np.diff(weights[order]) >= -1e-6).all()


def test_units_add_up_in_any_order(facs_rig):
    units = SidedUnits(facs_rig)
    parts = [units({1: Sides(0.3, 0.9)}), units({12: Sides.both(0.5)}), units({15: Sides(1.0, 0.2)})]
    expected = units({1: Sides(0.3, 0.9), 12: Sides.both(0.5), 15: Sides(1.0, 0.2)}).positions(
        facs_rig, Pose()
    )
    for order in (parts, parts[::-1], [parts[1], parts[0], parts[2]]):
        np.testing.assert_allclose(total(order).positions(facs_rig, Pose()), expected, atol=1e-6)


def test_contributions_add_to_the_pose_and_leave_no_trace_when_they_cancel(facs_rig):
    pose = Pose.of({"AU1": 0.5})
    added = (Contribution({"AU1": 0.25}) + Contribution({"AU1": -0.25, "AU12": 0.0})).added_to(pose)
    assert added.weights == {"AU1": 0.5}


@pytest.mark.parametrize("s", [0.0, 1.0])
@pytest.mark.parametrize("t", [0.0, 1.0])
def test_bilinear_at_the_four_corners_gives_the_four_meshes(small_rig, other, s, t):
    pose = Pose.between("happy", "sad", t)
    mix = PeopleMix({"one": 1.0}, "two", s)
    shown = _shown(small_rig, other, mix, pose)
    np.testing.assert_allclose(shown, (other if s else small_rig).positions(pose), atol=2e-6)


@given(s=UNIT, t=UNIT)
def test_people_and_pose_together_are_2_10(s, t):
    one, two = _pair()
    frames = [[rig.positions({name: 1.0}) for name in ("happy", "sad")] for rig in (one, two)]
    shown = _shown(one, two, PeopleMix({"one": 1.0}, "two", s), Pose.between("happy", "sad", t))
    np.testing.assert_allclose(shown, bilinear(frames, s, t), atol=5e-6)


def _pair():
    mesh = bumpy_grid()
    rng = np.random.default_rng(2)
    rigs = []
    for scale in (1.0, 1.2):
        base = mesh.with_positions(mesh.positions * np.float32(scale))
        moved = rng.normal(scale=0.2, size=(2, *mesh.positions.shape)).astype(np.float32)
        rigs.append(
            Rig.from_arrays(
                base, {n: base.positions + d for n, d in zip(("happy", "sad"), moved, strict=True)}
            )
        )
    return rigs


def _shown(one, two, mix, pose):
    offsets = People({"one": one, "two": two}).offsets(mix.weights(), pose.coefficients(one.names))
    return Contribution(offsets=offsets).positions(one, pose)


@given(s=UNIT)
def test_choosing_a_new_person_does_not_move_the_face(s):
    mix = PeopleMix({"ada": 0.25, "ben": 0.75}, "mei", s)
    before, after = mix.weights(), mix.rebased("kofi").weights()
    assert before.keys() == after.keys()
    assert all(after[name] == pytest.approx(weight, abs=1e-12) for name, weight in before.items())
    assert sum(after.values()) == pytest.approx(1.0, abs=1e-12)
    assert mix.rebased("kofi").at(1.0).weights() == {"kofi": 1.0}


def test_people_of_another_topology_are_refused(small_rig):
    with pytest.raises(CorrespondenceError, match="vertices"):
        People({"one": small_rig, "two": Rig.from_arrays(bumpy_grid(5, 5), {})})


def regions_of(rig):
    x = rig.neutral.positions[:, 0]
    left = np.clip(x / 2 + 0.5, 0, 1).astype(np.float32)
    return RegionSet(rig, ("left", "right"), np.stack([left, 1 - left]))


@given(t=UNIT, curve=st.sampled_from(["linear", "cosine"]))
def test_regions_with_equal_t_are_the_global_morph(t, curve):
    rig, _ = _pair()
    pose = Pose.between("happy", "sad", t, curve)
    control = RegionControl(pose.source, pose.target, t, curve)
    offsets = regions_of(rig)({"left": control, "right": control})
    np.testing.assert_allclose(rig.neutral.positions + offsets, rig.positions(pose), atol=2e-6)


def test_a_region_moves_nothing_outside_of_it(small_rig):
    regions = regions_of(small_rig)
    offsets = regions({"left": RegionControl(target={"happy": 1.0}, t=1.0, turn_deg=(10, 20, 30), size=1.4)})
    assert not offsets[regions.weights[0] == 0].any()
    assert offsets.any()


def test_turn_size_and_shift_are_about_the_pivot(small_rig):
    whole = RegionSet(small_rig, ("all",), np.ones((1, small_rig.neutral.vertex_count), np.float32))
    pivot = (1.0, 2.0, 3.0)
    control = RegionControl(turn_deg=(0, 0, 90), size=2.0, shift=(5, 0, 0), pivot=pivot)
    moved = small_rig.neutral.positions + whole({"all": control})
    x, y, z = (small_rig.neutral.positions - pivot).T
    np.testing.assert_allclose(moved, np.stack([-2 * y, 2 * x, 2 * z], 1) + pivot + (5, 0, 0), atol=1e-5)
    np.testing.assert_allclose(rotation((10, 20, 30)) @ rotation((10, 20, 30)).T, np.eye(3), atol=1e-12)


@given(st.integers(0, 2), st.lists(st.floats(-1, 1), min_size=12, max_size=12))
def test_painting_keeps_every_sum_within_one(region, brush):
    rng = np.random.default_rng(0)
    weights = rng.dirichlet(np.ones(4), 12).T[:3].astype(np.float32)
    result = painted(weights, region, np.array(brush, np.float32))
    assert (result >= 0).all()
    assert result.sum(axis=0).max() <= 1.0 + 1e-5
    np.testing.assert_allclose(result[region], np.clip(weights[region] + np.float32(brush), 0, 1), atol=1e-6)


def test_unknown_regions_and_shapes_and_faces_without_regions_are_refused(small_rig):
    regions = regions_of(small_rig)
    with pytest.raises(UnknownNameError, match="left, right"):
        regions({"ear": RegionControl()})
    with pytest.raises(UnknownNameError, match="happy"):
        regions({"left": RegionControl(target={"hapy": 1.0}, t=1.0)})
    with pytest.raises(DeformError, match="no regions"):
        RegionSet.of(small_rig)
    with pytest.raises(DeformError, match="at most 1"):
        RegionSet(small_rig, ("a", "b"), np.ones((2, small_rig.neutral.vertex_count), np.float32))


def test_a_person_without_correctives_mixes_with_one_who_has_them(small_rig, other):
    first = small_rig.names[0]
    mended = replace(
        small_rig,
        shapes=(*small_rig.shapes, Shape("mend", "Mend", "corrective")),
        deltas=np.concatenate([small_rig.deltas, small_rig.deltas[-1:] * np.float32(0.3)]),
        correctives=(Corrective("mend", hats=(Hat(first),)),),
    )
    weights, pose = {"own": 0.4, "other": 0.6}, Pose.of({first: 0.5})
    offsets = People({"own": mended, "other": other}).offsets(weights, mended.coefficients(pose))
    wanted = 0.4 * mended.positions(pose) + 0.6 * other.positions(pose)
    np.testing.assert_allclose(mended.positions(pose) + offsets, wanted, atol=1e-5)
