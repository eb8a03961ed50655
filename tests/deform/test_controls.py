"""All methods together: they add up, can be switched off, and what did not change is not made again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.emotion import spread_poles
from facemorph.core.facs import Sides
from facemorph.core.motion import total
from facemorph.core.pose import Pose, state_of
from facemorph.core.rig import Regions, Shape
from facemorph.deform.controls import METHODS, BoundControls, Controls, EmotionControl, PeopleControl
from facemorph.deform.handles import Handle, HandleSet, mirrored
from facemorph.deform.people import PeopleMix
from facemorph.deform.regions import RegionControl
from facemorph.errors import DeformError, UnknownNameError

POLES = spread_poles(("happy", "sad", "AU12"))


@pytest.fixture
def rig(small_rig):
    shapes = (Shape("happy", "Happy"), Shape("sad", "Sad"), Shape("AU12", "Lip corner puller", "facs"))
    count = small_rig.neutral.vertex_count
    weights = np.zeros((2, count), np.uint8)
    weights[0, : count // 2], weights[1, count // 2 :] = 255, 200
    return replace(small_rig, shapes=shapes, regions=Regions(("mouth", "brows"), weights))


@pytest.fixture
def controls():
    return Controls(
        facs={12: Sides(0.5, 0.1)},
        emotion=EmotionControl(0.3, 0.4, POLES),
        people=PeopleControl(None, {}, state_of("sad"), 0.25),
        handles=HandleSet((Handle(3, (0.1, 0.0, 0.2)), Handle(60, anchor=True))),
        regions={"mouth": RegionControl(target={"happy": 1.0}, t=0.5, size=1.1)},
    )


def test_every_methods_contribution_adds_up(rig, controls):
    bound = BoundControls(rig)
    alone = [bound(Pose(), replace(controls, off=frozenset(METHODS) - {method})) for method in METHODS]
    together = bound(Pose(), controls)
    expected = total(alone)
    np.testing.assert_allclose(together.positions(rig, Pose()), expected.positions(rig, Pose()), atol=1e-5)


def test_switched_off_a_method_moves_nothing_and_keeps_its_settings(rig, controls):
    off = replace(controls, off=frozenset(METHODS))
    assert np.array_equal(BoundControls(rig)(Pose(), off).positions(rig, Pose()), rig.neutral.positions)
    assert replace(off, off=frozenset()) == controls


def test_what_did_not_change_is_not_made_again(rig, controls):
    bound = BoundControls(rig)
    first = bound(Pose(), replace(controls, off=frozenset(METHODS) - {"handles"}))
    again = bound(Pose.of({"happy": 0.5}), replace(controls, off=frozenset(METHODS) - {"handles"}))
    assert first.offsets is again.offsets


def test_a_mixture_of_people_wears_what_the_other_methods_make(rig, controls):
    larger = rig.neutral.with_positions(rig.neutral.positions * np.float32(1.3))
    other = replace(rig, neutral=larger, deltas=rig.deltas[:, ::-1].copy())
    plain = replace(controls, handles=HandleSet(), regions={})
    mixed = replace(plain, people=replace(plain.people, mix=PeopleMix({"me": 1.0}, "you", 1.0)))
    pose = Pose.of({"happy": 0.2})
    shown = BoundControls(rig, "me", {"you": other})(pose, mixed).positions(rig, pose)
    expected = BoundControls(other)(pose, plain).positions(other, pose)
    np.testing.assert_allclose(shown, expected, atol=1e-5)


def test_a_dragged_handle_goes_where_it_is_dragged_and_anchors_hold(rig):
    handles = HandleSet((Handle(3, (0.1, 0.0, 0.2)), Handle(60, (9.0, 9.0, 9.0), anchor=True), Handle(90)))
    moved = BoundControls(rig)(Pose(), Controls(handles=handles)).offsets
    np.testing.assert_allclose(moved[3], [0.1, 0.0, 0.2], atol=1e-4)
    np.testing.assert_allclose(moved[[60, 90]], 0.0, atol=1e-4)
    assert BoundControls(rig)(Pose(), Controls(handles=handles.at_rest())).offsets is None


def test_handles_are_edited_without_losing_their_order():
    handles = HandleSet((Handle(1), Handle(2), Handle(3)))
    assert handles.moved(2, (1.0, 0.0, 0.0)).vertices() == (1, 2, 3)
    assert handles.without(2).vertices() == (1, 3)
    assert handles.with_handle(Handle(1, anchor=True)).vertices() == (2, 3, 1)


def test_the_mirror_image_of_a_vertex_is_on_the_other_side(rig):
    x = rig.neutral.positions[:, 0]
    left = int(np.argmax(x))
    image = mirrored(rig, left, 0.0)
    assert x[image] == pytest.approx(-x[left], abs=1e-5)
    assert mirrored(rig, image, 0.0) in np.flatnonzero(np.isclose(x, x[left]))


def test_handles_off_the_face_and_unknown_people_are_refused(rig):
    with pytest.raises(DeformError, match="vertex 5000"):
        BoundControls(rig)(Pose(), Controls(handles=HandleSet((Handle(5000, (1.0, 0.0, 0.0)),))))
    lost = Controls(people=PeopleControl(PeopleMix({"me": 1.0}, "nobody", 0.5)))
    with pytest.raises(UnknownNameError, match="nobody"):
        BoundControls(rig, "me")(Pose(), lost)


@pytest.mark.parametrize(
    "lacking",
    [
        Controls(emotion=EmotionControl(0.0, -0.5)),
        Controls(facs={27: Sides.both(0.5)}),
        Controls(people=PeopleControl(None, {}, state_of("angry"), 0.5)),
        Controls(regions={"mouth": RegionControl(target={"angry": 1.0}, t=0.5)}),
    ],
    ids=("emotion", "facs", "people", "regions"),
)
def test_a_method_that_asks_for_a_shape_the_face_lacks_is_refused(rig, lacking):
    with pytest.raises(UnknownNameError, match=r"no shape is called '(angry|AU27)'.*AU12"):
        BoundControls(rig)(Pose(), lacking)
    everything_off = replace(lacking, off=frozenset(METHODS))
    assert not BoundControls(rig)(Pose(), everything_off).weights
