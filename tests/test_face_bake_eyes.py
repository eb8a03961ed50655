"""Eyes in the bake: balls keep their shape, lids stay outside of them, and gaps are measured rightly."""

from __future__ import annotations

import re
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from facemorph.gl import eyes as driver
from tests.conftest import ROOT

TOOLS = ROOT / "tools"
if not (TOOLS / "face_bake").is_dir():
    pytest.skip("the bake's tools are not beside these tests", allow_module_level=True)
sys.path.insert(0, str(TOOLS))

from eye_gaps import Opening  # noqa: E402
from face_bake import parts_eyes, parts_eyes_ball  # noqa: E402
from face_bake.parts_eyes_ball import EYE_VERTICES, GAZE_DEGREES, LIMBUS, Eyeballs  # noqa: E402
from face_bake.parts_eyes_lids import OVERLAP, BlinkFit, with_lids  # noqa: E402
from face_bake.polygons import triangles_of  # noqa: E402

LOOKS = dict.fromkeys(GAZE_DEGREES, 0.0)


class FixedLook:
    """Look units that find what they were told to find."""

    def __init__(self, **looks: float) -> None:
        self._looks = LOOKS | looks

    def of(self, side: int, offsets: np.ndarray) -> tuple[dict[str, float], np.ndarray]:
        return self._looks, np.zeros(3)


def neutral() -> np.ndarray:
    """A body of nothing but two balls where eyes are."""
    points = np.zeros((19158, 3))
    rng = np.random.default_rng(5)
    for helper, x in zip(EYE_VERTICES, (0.3, -0.3), strict=True):
        aims = rng.standard_normal((len(helper), 3))
        points[helper] = [x, 7.3, 1.2] + 0.15 * aims / np.linalg.norm(aims, axis=1, keepdims=True)
    return points


def test_the_eye_is_a_ball_with_a_cornea_on_it():
    points, uv, polygons = parts_eyes.eye_mesh()
    distance = np.linalg.norm(points, axis=1)
    degrees = np.degrees(np.arccos(points[:, 2] / distance))
    np.testing.assert_allclose(distance[degrees >= LIMBUS - 1e-6], 1.0, atol=1e-9)
    assert 1.04 < distance[0] < 1.08, "the cornea stands out by a twentieth of the radius"
    assert (np.diff(parts_eyes_ball.cornea_height(np.linspace(0, LIMBUS, 50))) < 0).all()
    corners = points[triangles_of(polygons)]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", facing, corners.mean(1)) > 0).all(), "the outside is outside"
    assert 0 <= uv.min() <= uv.max() <= 1


def test_picture_mesh_driver_and_shader_agree_about_the_limbus():
    points, uv, _ = parts_eyes.eye_mesh()
    limbus = np.isclose(np.linalg.norm(points[:, :2], axis=1), np.sin(np.radians(LIMBUS)), atol=1e-6)
    radius = np.linalg.norm(uv[limbus] - 0.5, axis=1)
    np.testing.assert_allclose(radius, driver.LIMBUS_IN_PICTURE, atol=1e-6)
    assert parts_eyes.LIMBUS_IN_PICTURE == driver.LIMBUS_IN_PICTURE
    shader = (ROOT / "shaders" / "eye.frag").read_text(encoding="utf-8")
    assert float(re.search(r"LIMBUS_IN_PICTURE = ([\d.]+)", shader)[1]) == driver.LIMBUS_IN_PICTURE
    np.testing.assert_allclose(driver.BALL_RADIUS, 1 / np.sin(np.radians(LIMBUS)), atol=1e-3)
    np.testing.assert_allclose(driver.LIMBUS_AHEAD, 1 / np.tan(np.radians(LIMBUS)), atol=1e-3)


@pytest.mark.parametrize(
    ("looks", "turned"),
    [
        ({"Out": 1.0}, (25.0, 0.0)),
        ({"In": 0.5}, (-12.5, 0.0)),
        ({"Up": 1.0}, (0.0, 18.0)),
        ({"Down": 1.0}, (0.0, -22.0)),
    ],
)
def test_eyes_turn_about_their_centres_by_what_the_readme_says(looks, turned):
    body = neutral()
    rest_centre, rest = Eyeballs(FixedLook(), body).placed(0, body)
    centre, rotation = Eyeballs(FixedLook(**looks), body).placed(0, body)
    np.testing.assert_array_equal(centre, rest_centre)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    yaw, pitch = (_angles(rotation)[k] - _angles(rest)[k] for k in (0, 1))
    assert (yaw, pitch) == pytest.approx(turned, abs=1e-6)


def _angles(rotation: np.ndarray) -> tuple[float, float]:
    x, y, z = rotation[:, 2]
    return float(np.degrees(np.arctan2(x, z))), float(np.degrees(np.arcsin(y)))


def test_both_eyes_look_at_one_viewer():
    body = neutral()
    balls = Eyeballs(FixedLook(), body)
    lines = [balls.placed(side, body) for side in (0, 1)]
    meet = [
        centre + rotation[:, 2] * (parts_eyes_ball.VIEWER_AWAY / rotation[2, 2]) for centre, rotation in lines
    ]
    np.testing.assert_allclose(meet[0], meet[1], atol=0.05)
    assert abs(meet[0][0]) < 0.05


def test_skin_stays_outside_the_ball_at_the_shape_and_half_way_to_it():
    body = neutral()
    balls = Eyeballs(FixedLook(), body)
    rng = np.random.default_rng(2)
    aims = rng.standard_normal((4000, 3))
    aims /= np.linalg.norm(aims, axis=1, keepdims=True)
    rest = [0.3, 7.3, 1.2] + aims * rng.uniform(0.153, 0.2, (4000, 1))
    pushed = balls.push_out(rest + rng.uniform(-0.06, 0.06, rest.shape), rest, True, body)
    for points in (pushed, (pushed + rest) / 2):
        distance, surface = balls.surface(0, points, body)
        at_rest, below = balls.surface(0, rest, body)
        outside = at_rest > below
        assert (distance - surface)[outside].min() > -1e-9


def test_what_does_not_move_is_not_pushed():
    body = neutral()
    rest = np.array([0.3, 7.3, 1.2]) + np.random.default_rng(3).uniform(-0.2, 0.2, (500, 3))
    np.testing.assert_array_equal(Eyeballs(FixedLook(), body).push_out(rest, rest, True, body), rest)


def test_lids_follow_eyes_that_look_up_or_down():
    assert with_lids({"arkit:eyeLookUpLeft": 0.5})["arkit:eyeWideLeft"] > 0
    assert with_lids({"arkit:eyeLookDown": 1.0})["arkit:eyeBlink"] > 0
    assert with_lids({"arkit:eyeLookInLeft": 1.0}) == {"arkit:eyeLookInLeft": 1.0}


ALONG = np.linspace(-0.12, 0.12, 13)


def lids(opening: float, skew: float) -> tuple[np.ndarray, list[np.ndarray]]:
    """A body with two eyes whose lids are arcs, further apart towards one end by `skew`; columns of both."""
    points, columns = np.zeros((19158, 3)), []
    bow = 1 - (ALONG / 0.14) ** 2
    for side, (x, first) in enumerate(((0.3, 0), (-0.3, 26))):
        towards = ALONG if side == 0 else -ALONG
        upper = np.stack([x + ALONG, 7.3 + opening * bow * (1 + skew * towards), 0 * ALONG + 1.35], -1)
        lower = np.stack([x + ALONG, 7.3 - 0.4 * opening * bow, 0 * ALONG + 1.35], -1)
        points[first : first + 26] = np.concatenate([upper, lower])
        columns.append(np.repeat(np.arange(first, first + 26)[:, None], 3, axis=1))
    return points, columns


@pytest.mark.parametrize(("opening", "skew"), [(0.03, 0.0), (0.05, 2.0), (0.05, -2.0), (0.06, 1.0)])
def test_a_blink_brings_upper_edges_just_past_lower_ones_all_along_whoevers_eyes(opening: float, skew: float):
    base, columns = lids(0.05, 0.0)
    moves = {"eyeBlinkLeft": np.zeros_like(base), "eyeBlinkRight": np.zeros_like(base)}
    for move, first in zip(moves.values(), (0, 26), strict=True):
        move[first : first + 13, 1] = -0.09 * (1 - (ALONG / 0.14) ** 2)
    source = SimpleNamespace(base=SimpleNamespace(points=base), arkit=moves.get)
    start = lids(opening, skew)[0]
    fit = BlinkFit(source, columns)
    closed, half = (start + fit.offsets(np.full(2, weight), start) for weight in (1.0, 0.5))
    for first in (0, 26):
        upper, lower = slice(first, first + 13), slice(first + 13, first + 26)
        past = closed[lower, 1] - closed[upper, 1]
        np.testing.assert_allclose(past[1:-1], OVERLAP, atol=1e-6)
        assert (np.abs(past - OVERLAP) < 0.005).all()
        np.testing.assert_allclose(half[upper], 0.5 * (start[upper] + closed[upper]), atol=1e-9)


def slit(height: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, skin and ball: two sheets before a square ball, so far apart."""
    ball = square(-1, -1, 1, 1, 0.0)
    below, above = square(-2, -2, 2, -height / 2, 0.5), square(-2, height / 2, 2, 2, 0.5)
    quad = np.array([[0, 1, 2], [0, 2, 3]])
    return np.concatenate([ball, below, above]), np.concatenate([quad + 4, quad + 8]), quad


def square(left: float, bottom: float, right: float, top: float, z: float) -> np.ndarray:
    return np.array([[left, bottom, z], [right, bottom, z], [right, top, z], [left, top, z]])


@pytest.mark.parametrize("height", [0.0, 0.1, 0.73])
def test_a_gap_is_as_high_as_it_is(height):
    positions, skin, ball = slit(height)
    opening = Opening(skin, ball, positions, step=0.01)
    assert opening.height(positions) == pytest.approx(height, abs=0.011)
    assert opening.piercing(positions) == 0.0


def test_what_comes_through_a_lid_is_told_from_the_opening():
    positions, skin, ball = slit(0.4)
    through = square(-0.2, 0.5, 0.2, 0.7, 0.6)
    positions, ball = (
        np.concatenate([positions, through]),
        np.concatenate([ball, [[12, 13, 14], [12, 14, 15]]]),
    )
    opening = Opening(skin, ball, positions, step=0.01)
    assert opening.piercing(positions) == pytest.approx(0.2, abs=0.011)
