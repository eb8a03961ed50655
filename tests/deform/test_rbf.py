"""Radial basis functions against scipy, and the laws they must hold."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import RBFInterpolator

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.deform.control_points import control_vertices, rebuilding_vertices
from facemorph.deform.rbf import KERNELS, RbfField, checked_kernel
from facemorph.deform.rebuild import rebuilt
from facemorph.errors import DeformError, OptionError
from facemorph.io import load_rig

RNG = np.random.default_rng(5)
POINTS = RNG.normal(size=(40, 3)) * (7, 10, 8) + (0, 160, 3)
SURFACE = (RNG.normal(size=(3000, 3)) * (7, 10, 8) + (0, 160, 3)).astype(np.float32)
MOVES = RNG.normal(size=(40, 3))
SCIPY = {"r": "linear", "r3": "cubic", "r5": "quintic", "multiquadric": "multiquadric"}


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_field_equals_scipys(kernel):
    field = RbfField(POINTS, SURFACE, kernel, c=2.0 if kernel == "multiquadric" else None)
    centre, scale = POINTS.mean(axis=0), np.sqrt(((POINTS - POINTS.mean(axis=0)) ** 2).sum(axis=1).mean())
    degree = 2 if kernel == "r5" else 1
    if kernel == "r5":
        # scipy insists on a quadratic part for r^5; (2.13) has an affine one, so it is solved densely here.
        expected = _dense((POINTS - centre) / scale, (SURFACE - centre) / scale, lambda r: r**5)
    else:
        epsilon = {"epsilon": scale / 2.0} if kernel == "multiquadric" else {}
        expected = RBFInterpolator(
            (POINTS - centre) / scale, MOVES, kernel=SCIPY[kernel], degree=degree, **epsilon
        )((SURFACE - centre) / scale)
    np.testing.assert_allclose(field(MOVES), expected, atol=1e-6 * np.abs(expected).max())


def _dense(points, surface, kernel):
    def rows(p):
        return np.c_[kernel(np.linalg.norm(p[:, None] - points[None], axis=2)), np.ones(len(p)), p]

    system = np.r_[rows(points), np.c_[rows(points)[:, len(points) :].T, np.zeros((4, 4))]]
    return rows(surface) @ np.linalg.solve(system, np.r_[MOVES, np.zeros((4, 3))])


@pytest.mark.parametrize("kernel", KERNELS)
def test_control_points_are_reproduced(kernel):
    field = RbfField(POINTS, POINTS.astype(np.float32), kernel)
    np.testing.assert_allclose(field(MOVES), MOVES, atol=2e-5)


@pytest.mark.parametrize("kernel", KERNELS)
def test_affine_motions_are_reproduced_everywhere(kernel):
    matrix, shift = RNG.normal(size=(3, 3)) * 0.1, np.array([1.0, -2.0, 0.5])
    field = RbfField(POINTS, SURFACE, kernel, exactly=True)
    expected = SURFACE.astype(np.float64) @ matrix.T + shift
    np.testing.assert_allclose(field(POINTS @ matrix.T + shift), expected, atol=1e-10 * np.ptp(POINTS))


def test_a_drag_is_linear_and_scaling_the_face_scales_the_field():
    field = RbfField(POINTS, SURFACE)
    np.testing.assert_allclose(field(2 * MOVES), 2 * field(MOVES), rtol=1e-5, atol=1e-5)
    large = RbfField(POINTS * 1000, SURFACE * 1000)
    np.testing.assert_allclose(large(MOVES * 1000), 1000 * field(MOVES), rtol=1e-3, atol=2e-2)


def test_without_displacement_nothing_moves():
    assert not RbfField(POINTS, SURFACE)(np.zeros((40, 3))).any()


def test_coincident_flat_and_too_few_points_are_refused_by_name():
    with pytest.raises(DeformError, match="points 3 and 41 are at one place"):
        RbfField(np.r_[POINTS, POINTS[2:3]], SURFACE)
    with pytest.raises(DeformError, match="one plane"):
        RbfField(POINTS * (1, 1, 0), SURFACE)
    with pytest.raises(DeformError, match="at least 4"):
        RbfField(POINTS[:3], SURFACE)
    with pytest.raises(DeformError, match="finite"):
        RbfField(np.full((5, 3), np.nan), SURFACE)
    with pytest.raises(OptionError, match="multiquadric"):
        checked_kernel("gauss")
    with pytest.raises(OptionError, match="length"):
        RbfField(POINTS, SURFACE, "multiquadric", c=-1.0)


def test_a_system_that_cannot_be_solved_is_refused_and_never_answered_wrongly():
    near = np.r_[POINTS, POINTS[:1] + 2e-5]
    with pytest.raises(DeformError, match="cannot be solved"):
        RbfField(near, SURFACE, "r5")


@pytest.fixture
def bump_rig(small_rig):
    moved = small_rig.neutral.positions.copy()
    moved[:, 2] += np.exp(-(moved[:, 0] ** 2 + moved[:, 1] ** 2))
    return Rig.from_arrays(small_rig.neutral, {"bump": moved})


def test_more_points_rebuild_a_target_better_and_all_points_rebuild_it_exactly(bump_rig):
    source, target = bump_rig.positions({}), bump_rig.positions({"bump": 1.0})
    errors = [
        rebuilt(bump_rig, source, target, control_vertices(bump_rig, n)).rms_percent for n in (8, 24, 60, 99)
    ]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4


def test_control_vertices_are_different_places_and_no_more_than_there_are(bump_rig):
    vertices = control_vertices(bump_rig, 40)
    assert len(set(vertices.tolist())) == 40
    one_place = Rig.from_arrays(Mesh.from_triangles(np.zeros((9, 3)), np.array([[0, 1, 2]])), {})
    with pytest.raises(DeformError, match="only 1"):
        control_vertices(one_place, 5)


def errors_of(rig, vertices, kernel, c=None):
    source, target = rig.positions({}), rig.positions({"bump": 1.0})
    field = RbfField(source[vertices].astype(np.float64), source, kernel, c, exactly=True)
    away = field((target - source)[vertices].astype(np.float64)) - (target - source)
    return float((away**2).sum())


@pytest.mark.parametrize(("kernel", "c"), [("r", None), ("r3", None), ("r5", None), ("multiquadric", 0.5)])
def test_the_next_point_is_the_one_that_leaves_the_least_error(bump_rig, kernel, c):
    source, target = bump_rig.positions({}), bump_rig.positions({"bump": 1.0})
    chosen = rebuilding_vertices(bump_rig, source, target, 10, kernel, c).tolist()
    assert chosen[:6] == control_vertices(bump_rig, 6).tolist()
    for held in range(6, 10):
        others = [v for v in range(bump_rig.neutral.vertex_count) if v not in chosen[:held]]
        errors = [errors_of(bump_rig, [*chosen[:held], v], kernel, c) for v in others]
        assert errors_of(bump_rig, chosen[: held + 1], kernel, c) == pytest.approx(min(errors), rel=1e-3)


@pytest.mark.parametrize("kernel", KERNELS)
def test_chosen_points_are_as_many_as_asked_for_all_different_and_always_the_same(bump_rig, kernel):
    source, target = bump_rig.positions({}), bump_rig.positions({"bump": 1.0})
    for count in (4, 7, 40, 99):
        chosen = rebuilding_vertices(bump_rig, source, target, count, kernel)
        assert len(set(chosen.tolist())) == count
        assert np.array_equal(chosen, rebuilding_vertices(bump_rig, source, target, count, kernel))
    with pytest.raises(DeformError, match="only 99"):
        rebuilding_vertices(bump_rig, source, target, 100, kernel)


@pytest.mark.parametrize(("kernel", "c"), [("r", None), ("r5", None), ("multiquadric", 0.5)])
def test_fewer_points_are_the_first_of_more(bump_rig, kernel, c):
    source, target = bump_rig.positions({}), bump_rig.positions({"bump": 1.0})
    most = rebuilding_vertices(bump_rig, source, target, 60, kernel, c)
    for count in (8, 20, 41):
        assert np.array_equal(rebuilding_vertices(bump_rig, source, target, count, kernel, c), most[:count])


def test_where_nothing_moves_or_the_face_is_flat_the_points_cover_it(bump_rig):
    source = bump_rig.positions({})
    assert np.array_equal(rebuilding_vertices(bump_rig, source, source, 20), control_vertices(bump_rig, 20))
    flat = bump_rig.neutral.with_positions(source * np.float32([1, 1, 0]))
    rig = Rig.from_arrays(flat, {"bump": bump_rig.positions({"bump": 1.0})})
    chosen = rebuilding_vertices(rig, rig.positions({}), rig.positions({"bump": 1.0}), 20)
    assert np.array_equal(chosen, control_vertices(rig, 20))


def test_points_chosen_by_the_error_open_closed_lips():
    """Points that cover a face alike nearly coincide on closed lips, and cannot part them."""
    rig = load_rig("ada")
    source, target = rig.positions({}), rig.positions({"surprised": 1.0})
    covering = rebuilt(rig, source, target, control_vertices(rig, 40)).rms_percent
    chosen = rebuilt(rig, source, target, rebuilding_vertices(rig, source, target, 40)).rms_percent
    assert chosen < 1.0
    assert chosen < 0.85 * covering
