"""The pieces of the bake that fill the mouth: teeth on an arch, gums round them, a tongue between them."""

from __future__ import annotations

import sys
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from tests.conftest import ROOT

TOOLS = ROOT / "tools"
if not (TOOLS / "face_bake").is_dir():
    pytest.skip("the bake's tools are not beside these tests", allow_module_level=True)
sys.path.insert(0, str(TOOLS))

from face_bake import mouth_fit  # noqa: E402
from face_bake.dentition import ToothPlace, crowns, placed  # noqa: E402
from face_bake.mouth_fit import CLEARANCE, LOWER_HELPER, Arch, MouthFit  # noqa: E402
from face_bake.mouth_paint import RIM_REACH, corners_of, rim_of  # noqa: E402
from face_bake.mouth_room import _softly  # noqa: E402
from face_bake.parts_gums import gum_columns  # noqa: E402
from face_bake.parts_teeth import Teeth  # noqa: E402
from face_bake.parts_tongue import FULLY_OUT, HELPER_TIP, TONGUE_TIP, Tongue  # noqa: E402
from face_bake.polygons import triangles_of  # noqa: E402

UPPER = Arch(0.27, 0.44, (1.9, 2.4), 1.40, 6.30)
LOWER = mouth_fit._inside(UPPER)
MILLIMETRE = 0.01


def posed(shape: np.ndarray, neutral: np.ndarray) -> SimpleNamespace:
    """Somebody with the arches above, in a shape of the body."""
    fit = MouthFit.__new__(MouthFit)
    fit.upper, fit.lower, fit._helper = UPPER, LOWER, neutral[LOWER_HELPER]
    body = SimpleNamespace(mouth=fit, person=SimpleNamespace(id="somebody"))
    return SimpleNamespace(body=body, shape=shape, neutral=neutral)


@pytest.fixture
def neutral() -> np.ndarray:
    """A body of which only the helpers of teeth and tongue matter."""
    points = np.zeros((19158, 3))
    points[LOWER_HELPER] = np.random.default_rng(1).normal((0, 6.3, 1.2), 0.1, (len(LOWER_HELPER), 3))
    points[HELPER_TIP] = [0, 6.3, 1.25]
    return points


def volume(points: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6)


def surface_of(tooth: ToothPlace, steps: int = 8) -> np.ndarray:
    """Places all over a crown."""
    corners = tooth.world(tooth.crown.points)[triangles_of(tooth.crown.polygons())]
    shares = [[i, j, steps - i - j] for i in range(steps + 1) for j in range(steps + 1 - i)]
    return np.einsum("sk,tkd->tsd", np.array(shares) / steps, corners).reshape(-1, 3)


@pytest.mark.parametrize("arch", [UPPER, LOWER])
def test_the_distance_from_an_arch_is_how_far_one_went_from_it(arch: Arch):
    places, outs = arch.at(np.linspace(-0.7, 0.7, 41))
    for far in (-0.03, 0.0, 0.05):
        at = places + far * outs
        points = np.stack([at[:, 0], np.full(len(at), 5.0), at[:, 1]], -1)
        distance, out = arch.distance(points)
        assert distance == pytest.approx(far, abs=1e-3)
        assert (out[:, [0, 2]] * outs).sum(1) == pytest.approx(1.0, abs=0.02)


def test_the_fitted_arch_is_as_roomy_as_its_walls_let_it_be():
    turn = np.linspace(0, np.pi, 121)
    heights = np.linspace(-0.12, 0.12, 25)
    around = np.stack([0.30 * np.cos(turn), 1.0 + 0.45 * np.sin(turn)], -1)
    behind = np.stack([np.repeat([-0.30, 0.30], 20), np.tile(np.linspace(0.5, 1.0, 20), 2)], -1)
    flat = np.concatenate([around, behind])
    wall = np.array([[x, 6.3 + h, z] for h in heights for x, z in flat])
    arch = mouth_fit._fitted(wall, 6.3)
    distance = arch.distance(wall)[0]
    assert distance.min() > 0.85 * CLEARANCE
    assert arch.half_width > 0.24
    assert arch.front == pytest.approx(1.45 - CLEARANCE, abs=0.005)


@pytest.mark.parametrize("upper", [True, False])
def test_each_tooth_is_closed_and_faces_outwards(upper: bool, neutral: np.ndarray):
    teeth = Teeth(upper)
    points, triangles = teeth.place(posed(neutral, neutral)), triangles_of(teeth.groups[0].polygons)
    first = 0
    for crown in crowns(upper):
        count = len(crown.points)
        own = triangles[(triangles[:, 0] >= first) & (triangles[:, 0] < first + count)]
        # The root's end, under the gum, stays open: a fan closes it.
        around = np.arange(len(crown.around)) + first
        edges = own[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        borders = {tuple(e) for e in edges.tolist()} - {tuple(e[::-1]) for e in edges.tolist()}
        assert {v for edge in borders for v in edge} == set(around.tolist())
        fan = np.array([[b, a, first] for a, b in sorted(borders)])
        own = np.concatenate([own, fan])
        size = volume(points - points[first], own)
        assert 50 * MILLIMETRE**3 < size < 1000 * MILLIMETRE**3
        first += count


@pytest.mark.parametrize(("arch", "upper"), [(UPPER, True), (LOWER, False)])
def test_gums_face_the_lips_in_front_and_the_tongue_behind(arch: Arch, upper: bool, neutral: np.ndarray):
    teeth = Teeth(upper)
    points, polygons = teeth.place(posed(neutral, neutral)), teeth.groups[1].polygons
    strips = polygons[: 6 * (gum_columns() - 1)].reshape(6, -1, 4)
    for row, way in ((0, 1), (1, 1), (2, 1), (5, -1)):
        corners = points[strips[row]]
        normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        _, out = arch.distance(corners.mean(1))
        assert way * (normals * out).sum(1).mean() > 0


@pytest.mark.parametrize(("arch", "upper"), [(UPPER, True), (LOWER, False)])
def test_neighbours_touch_or_nearly(arch: Arch, upper: bool):
    surfaces = [surface_of(tooth) for tooth in placed(arch, "somebody", upper)]
    for one, other in pairwise(surfaces):
        assert cKDTree(one).query(other)[0].min() < 0.7 * MILLIMETRE


def test_the_upper_incisors_pass_before_the_lower_ones_and_no_crown_cuts_another(neutral: np.ndarray):
    upper, lower = (Teeth(up).place(posed(neutral, neutral)) for up in (True, False))
    front = [points[: 14 * 72][np.abs(points[: 14 * 72, 0]) < 0.06] for points in (upper, lower)]
    overbite = front[1][:, 1].max() - front[0][:, 1].min()
    assert 1.0 * MILLIMETRE < overbite < 3.5 * MILLIMETRE
    assert front[0][:, 2].max() > front[1][:, 2].max() + 1.0 * MILLIMETRE


def test_lower_teeth_turn_with_the_jaw_and_never_stretch(neutral: np.ndarray):
    turn = Rotation.from_euler("x", 25, degrees=True).as_matrix()
    opened = neutral.copy()
    opened[LOWER_HELPER] = neutral[LOWER_HELPER] @ turn.T + [0, -0.4, 0.1]
    lower, upper = Teeth(upper=False), Teeth(upper=True)
    before, after = lower.place(posed(neutral, neutral)), lower.place(posed(opened, neutral))
    np.testing.assert_allclose(after, before @ turn.T + [0, -0.4, 0.1], atol=1e-9)
    np.testing.assert_array_equal(upper.place(posed(opened, neutral)), upper.place(posed(neutral, neutral)))


def test_a_helper_that_is_squeezed_squeezes_no_tooth(neutral: np.ndarray):
    squeezed = neutral.copy()
    middle = neutral[LOWER_HELPER].mean(0)
    squeezed[LOWER_HELPER] = middle + (neutral[LOWER_HELPER] - middle) * [0.8, 1.1, 0.9]
    lower = Teeth(upper=False)
    before, after = lower.place(posed(neutral, neutral)), lower.place(posed(squeezed, neutral))
    steps = [np.linalg.norm(np.diff(points, axis=0), axis=1) for points in (before, after)]
    np.testing.assert_allclose(*steps, atol=1e-9)


def test_everybody_has_teeth_of_their_own_and_always_the_same():
    one, again, other = (placed(UPPER, name, True) for name in ("ada", "ada", "ben"))
    assert all((a.origin == b.origin).all() for a, b in zip(one, again, strict=True))
    assert any((a.origin != b.origin).any() for a, b in zip(one, other, strict=True))


def test_the_tongue_lies_behind_the_lower_teeth_and_comes_out_over_them(neutral: np.ndarray):
    tongue, out = Tongue(), neutral.copy()
    out[HELPER_TIP] += [0, 0, FULLY_OUT]
    rest, shown = (tongue.place(posed(shape, neutral)) for shape in (neutral, out))
    assert rest[:, 2].max() < LOWER.front - 0.05
    assert rest[TONGUE_TIP, 1] < LOWER.edge
    assert shown[TONGUE_TIP, 2] > LOWER.front + 0.15
    over = np.abs(shown[:, 2] - LOWER.front) < 0.04
    assert shown[over, 1].min() > LOWER.edge - 1.0 * MILLIMETRE
    assert volume(rest - rest[TONGUE_TIP], triangles_of(tongue.groups[0].polygons)) > 0


def test_lips_are_shaded_towards_their_rim_and_in_both_corners_alike():
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(-0.4, 0.4, 161), np.linspace(6.3, 6.9, 121)))
    points = np.stack([x, y, np.full(len(x), 1.41)], -1)
    mouth = (np.abs(y - 6.6) < 0.02) & (np.abs(x) < 0.2)
    lips = (np.abs(y - 6.6) < 0.15) & (np.abs(x) < 0.25) & ~mouth
    canvas = SimpleNamespace(points=points, mouth=mouth.astype(float), lips=lips.astype(float))
    rim, corners = rim_of(canvas), corners_of(canvas)
    assert not rim[~lips].any() and not corners[mouth].any()
    above = np.flatnonzero(lips & (np.abs(x) < 1e-6) & (y > 6.6))
    assert (np.diff(rim[above[np.argsort(y[above])]]) <= 0).all()
    assert rim[above].max() > 0.9 and not rim[lips & (y > 6.62 + RIM_REACH + 0.01)].any()
    middle, aside = points[np.argmax(corners * (x > 0))], points[np.argmax(corners * (x < 0))]
    np.testing.assert_allclose(middle * [-1, 1, 1], aside, atol=1e-9)


def test_what_is_laid_down_softly_keeps_its_order_and_stays_above():
    laid = _softly(np.linspace(-0.1, 0.1, 200), 0.006)
    assert (np.diff(laid) > 0).all()
    assert (laid >= np.maximum(np.linspace(-0.1, 0.1, 200), 0)).all()
    assert laid[-1] == pytest.approx(0.1, abs=1e-6)
