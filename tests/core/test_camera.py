"""The orbiting camera: what it sees, and that moves do what they say."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.camera import DIRECTIONS, Camera, direction_angles
from facemorph.core.picture import checked_shading, picture_size
from facemorph.errors import OptionError

BOX = np.array([[-3, -8, -4], [5, 9, 6]], np.float32)


def projected(camera: Camera, points: np.ndarray, aspect: float = 1.0) -> np.ndarray:
    homogeneous = np.c_[np.atleast_2d(points), np.ones(len(np.atleast_2d(points)))]
    clip = homogeneous @ camera.clip_from_model(aspect).T
    return clip[:, :3] / clip[:, 3:]


def corners(box: np.ndarray) -> np.ndarray:
    return np.stack(np.meshgrid(*box.T, indexing="ij"), -1).reshape(-1, 3)


@pytest.mark.parametrize("direction", [*DIRECTIONS, "120,-40"])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 1.6])
def test_framing_sees_the_middle_of_every_side(direction, aspect):
    camera = Camera.framing(BOX, direction, aspect)
    middles = [
        (BOX[0] + BOX[1]) / 2 + np.eye(3)[a] * s * (BOX[1] - BOX[0])[a] / 2 for a in range(3) for s in (-1, 1)
    ]
    assert np.abs(projected(camera, np.array(middles), aspect)).max() < 1.0


def test_the_front_camera_stands_before_the_face_with_up_up_and_its_left_at_the_right():
    camera = Camera.framing(BOX)
    assert camera.position()[2] > BOX[1, 2]
    up, left = (
        projected(camera, np.add(camera.target, [0, 1, 0])),
        projected(camera, np.add(camera.target, [1, 0, 0])),
    )
    assert up[0, 1] > 0 and left[0, 0] > 0


def test_left_shows_the_faces_own_left_side():
    assert Camera.framing(BOX, "left").position()[0] > BOX[1, 0]


@given(st.floats(-179, 179), st.floats(-80, 80))
def test_axes_are_orthonormal_and_right_handed(azimuth, elevation):
    right, up, back = Camera(azimuth_deg=azimuth, elevation_deg=elevation).axes()
    np.testing.assert_allclose(
        np.stack([right, up, back]) @ np.stack([right, up, back]).T, np.eye(3), atol=1e-12
    )
    np.testing.assert_allclose(np.cross(right, up), back, atol=1e-12)


@given(st.floats(0.5, 2.0), st.floats(-0.9, 0.9), st.floats(-0.9, 0.9))
def test_zooming_keeps_what_lies_under_the_pointer(factor, x, y):
    camera = Camera.framing(BOX, "three-quarter")
    origin, direction = camera.ray(x, y)
    back = camera.axes()[2]
    point = origin + direction * (camera.distance / -(direction @ back))
    np.testing.assert_allclose(projected(camera, point)[0, :2], [x, y], atol=1e-9)
    np.testing.assert_allclose(projected(camera.zoomed(factor, x, y), point)[0, :2], [x, y], atol=1e-9)


def test_panning_by_a_tenth_moves_the_picture_by_a_tenth_of_its_height():
    camera = Camera.framing(BOX)
    moved = projected(camera.panned(0.1, 0.0), np.array(camera.target))
    np.testing.assert_allclose(moved[0, :2], [-0.2, 0.0], atol=1e-9)


def test_orbiting_keeps_the_distance_and_stops_short_of_the_poles():
    camera = Camera.framing(BOX).orbited(30, 500)
    assert camera.elevation_deg == 89.0
    assert np.linalg.norm(camera.position() - camera.target) == pytest.approx(camera.distance)


def test_a_pivot_on_the_surface_becomes_the_middle():
    camera = Camera.framing(BOX).pivoted(np.array([1.0, 2.0, 6.0]))
    np.testing.assert_allclose(projected(camera, np.array([1.0, 2.0, 6.0]))[0, :2], [0, 0], atol=1e-9)


def test_a_single_point_can_be_framed():
    assert np.isfinite(Camera.framing(np.zeros((2, 3), np.float32)).clip_from_model(1.0)).all()


@pytest.mark.parametrize("text", ["behind", "1,2,3", "nan,0", "10,95", ""])
def test_a_camera_that_is_none_is_refused(text):
    with pytest.raises(OptionError):
        direction_angles(text)


@pytest.mark.parametrize("text", ["big", "0x10", "10x", "99999x10", "-5x5", "1280"])
def test_a_size_that_is_none_is_refused(text):
    with pytest.raises(OptionError):
        picture_size(text)
    assert picture_size("1280x800") == (1280, 800)


def test_an_unknown_shading_is_refused_with_the_choices():
    with pytest.raises(OptionError, match="skin, clay"):
        checked_shading("toon")
