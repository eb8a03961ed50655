"""The rating study's cameras: the face fills the picture, wherever a rig says that its face is."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.arrays import Float64
from facemorph.core.camera import Camera
from facemorph.core.mesh import Mesh
from facemorph.core.rig import FaceInfo, Landmark, Rig
from tests.gl.heads import head_rig

sys.path.insert(0, str(Path(__file__).parent.parent / "tools"))

import rating_framing

VIEWS = ("front", "three-quarter", "-35,10")
ASPECT = 400 / 440


def places(camera: Camera, points: Float64) -> Float64:
    """Where points (n, 3) lie in the picture (n, 2), each side from -1 to 1."""
    there = np.column_stack([points, np.ones(len(points))]) @ camera.clip_from_model(ASPECT).T
    return there[:, :2] / there[:, 3:]


def marked(rig: Rig) -> Rig:
    """The rig with jaw and brows of the 68 points at a few of its vertices."""
    front = np.flatnonzero(rig.neutral.positions[:, 2] > 0)
    numbers = [*rating_framing.JAW, *rating_framing.BROWS]
    by_height = front[np.argsort(rig.neutral.positions[front, 1])]
    middle = by_height[len(by_height) // 4 : 3 * len(by_height) // 4]
    chosen = middle[np.linspace(0, len(middle) - 1, len(numbers)).astype(int)]
    chosen[rating_framing.CHIN], chosen[0] = chosen[0], chosen[rating_framing.CHIN]
    marks = tuple(Landmark(f"p{n}", int(v), ibug=n) for n, v in zip(numbers, chosen, strict=True))
    return replace(rig, info=FaceInfo("marked", landmarks=marks))


@pytest.fixture
def rig() -> Rig:
    return head_rig(rows=24, columns=32)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("prepared", [marked, lambda rig: rig], ids=["landmarks", "what moves"])
def test_the_face_is_in_the_middle_and_fills_the_picture(rig: Rig, view: str, prepared) -> None:
    rig = prepared(rig)
    points = rating_framing.face_points(rig, rig.names)
    seen = places(rating_framing.face_camera(rig, points, view, ASPECT), points)
    assert np.abs(seen).max() < 1.0
    assert np.abs(seen).max() > 0.9, "one side nearly touches the picture's edge"
    np.testing.assert_allclose(seen.max(0) + seen.min(0), 0, atol=0.15)


def test_landmarks_stay_in_the_picture_in_every_expression_with_forehead_above_the_brows(rig: Rig) -> None:
    rig = marked(rig)
    points = rating_framing.face_points(rig, rig.names)
    held = [mark.vertex for mark in rig.info.landmarks]
    for positions in (rig.neutral.positions, *(rig.neutral.positions + delta for delta in rig.deltas)):
        assert positions[held, 1].min() >= points[:, 1].min() - 1e-6
    brows = [mark.vertex for mark in rig.info.landmarks if mark.ibug in rating_framing.BROWS]
    assert points[:, 1].max() > rig.neutral.positions[brows, 1].max() + 0.1 * np.ptp(points[:, 1])


def test_a_body_below_a_face_that_moves_is_left_out(rig: Rig) -> None:
    """A rest of many vertices that no emotion moves, far below, changes nothing."""
    points = rating_framing.face_points(rig, rig.names)
    body = rig.neutral.positions - np.array([0, 40, 0], np.float32)
    mesh = Mesh.from_triangles(np.concatenate([rig.neutral.positions, body]), rig.triangles)
    whole = Rig(mesh, rig.shapes, np.concatenate([rig.deltas, np.zeros_like(rig.deltas)], axis=1))
    np.testing.assert_array_equal(rating_framing.face_points(whole, rig.names), points)


@pytest.mark.parametrize("emotions", [(), ("neutral",)])
def test_a_face_that_nothing_moves_is_shown_whole(rig: Rig, emotions: tuple[str, ...]) -> None:
    np.testing.assert_allclose(rating_framing.face_points(rig, emotions), rig.neutral.positions)
