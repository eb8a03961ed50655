"""Gradients of triangles, and deformation transfer against a plain dense one."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit.gradients import carried_motion, edge_matrix, edges_of, frames, heights
from facemorph.fit.transferring import Transfer
from tests.fit.faces import other, sheet_rig, turned


def test_the_edge_matrix_makes_edges_of_positions():
    rig = sheet_rig(1)
    points, triangles = rig.neutral.positions.astype(np.float64), rig.triangles
    by_matrix = (edge_matrix(triangles, len(points)) @ points).reshape(2, -1, 3)
    np.testing.assert_allclose(by_matrix.transpose(2, 0, 1), edges_of(points, triangles), atol=1e-14)
    np.testing.assert_array_equal(by_matrix[0], points[triangles[:, 2]] - points[triangles[:, 0]])


def test_a_frames_third_column_is_the_normal_over_the_root_of_its_length():
    edges = np.random.default_rng(1).normal(size=(3, 2, 5))
    for t, frame in enumerate(frames(edges).transpose(2, 0, 1)):
        normal = np.cross(edges[:, 0, t], edges[:, 1, t])
        np.testing.assert_allclose(frame[:, :2], edges[..., t])
        np.testing.assert_allclose(frame[:, 2], normal / np.sqrt(np.linalg.norm(normal)))


def test_a_shape_that_turns_the_whole_face_turns_the_targets_edges():
    rig = sheet_rig(1)
    points, target = rig.neutral.positions.astype(np.float64), other(rig.neutral.positions.astype(np.float64))
    turn = turned(35.0)
    deltas = (points @ turn.T - points)[None].astype(np.float32)
    motion = carried_motion(points, deltas, target, rig.triangles)
    base = edges_of(target, rig.triangles)
    expected = np.einsum("ij,jet->iet", turn - np.eye(3), base)
    np.testing.assert_allclose(motion.edges[0], expected, atol=1e-5)
    np.testing.assert_allclose(motion.change[0], np.linalg.norm(turn - np.eye(3)), rtol=1e-4)


def test_triangles_that_no_vertex_of_moves_have_no_motion_at_all():
    rig = sheet_rig(3)
    motion = carried_motion(
        rig.neutral.positions.astype(np.float64), rig.deltas, rig.neutral.positions * 1.1, rig.triangles
    )
    still = ~rig.deltas.any(axis=2)[:, rig.triangles].any(axis=2)
    assert still.any() and not still.all()
    assert (motion.change[still] == 0.0).all()
    assert (motion.edges.transpose(0, 3, 1, 2)[still] == 0.0).all()


def test_heights_tell_slivers_and_points_from_triangles():
    corners = np.array(
        [[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0), (1, 0, 0), (0.5, 1e-6, 0)], [(1, 1, 1)] * 3], float
    )
    found = heights(edges_of(corners.reshape(-1, 3), np.arange(9).reshape(3, 3)))
    np.testing.assert_allclose(found, [0.5, 1e-6, 0.0], atol=1e-9)


def test_slivers_keep_the_templates_own_offsets_and_stay_finite():
    rig = sheet_rig(2)
    points = rig.neutral.positions.astype(np.float64)
    thin = int(np.flatnonzero(rig.deltas[0].any(axis=1)[rig.triangles].all(axis=1))[0])
    a, b, c = rig.triangles[thin]
    points[c] = (points[a] + points[b]) / 2 + 1e-6
    target = other(points)
    motion = carried_motion(points, rig.deltas, target, rig.triangles)
    assert np.isfinite(motion.edges).all()
    own = edges_of(rig.deltas[0].astype(np.float64), rig.triangles)[..., thin]
    np.testing.assert_allclose(motion.edges[0, ..., thin], own, atol=1e-7)
    assert motion.change[0, thin] == 0.0


def test_transfer_equals_a_dense_one_written_down_plainly():
    rig = sheet_rig(2, 6, 7)
    neutral = other(rig.neutral.positions.astype(np.float64))
    way = Transfer(rig, neutral)
    for k in range(2):
        expected = _dense_transfer(rig, k, way.neutral, way.anchoring.still)
        np.testing.assert_allclose(way.offsets[..., k], expected, atol=2e-7 * rig.neutral.diagonal)


def _dense_transfer(rig: Rig, k: int, target: np.ndarray, still: np.ndarray) -> np.ndarray:
    """Sumner and Popovic (2004), triangle by triangle, as one dense least squares."""
    rest = rig.neutral.positions.astype(np.float64)
    moved = rest + rig.deltas[k]
    rows, sides = [], []
    for corners in rig.triangles:
        gradient = _frame(moved[corners]) @ np.linalg.inv(_frame(rest[corners]))
        for to in (2, 1):
            row = np.zeros(len(rest))
            row[corners[to]], row[corners[0]] = 1.0, -1.0
            edge = target[corners[to]] - target[corners[0]]
            rows.append(row)
            sides.append(gradient @ edge - edge)
    for v in np.flatnonzero(still):
        rows.append(np.eye(len(rest))[v])
        sides.append(rig.deltas[k, v])
    return np.linalg.lstsq(np.array(rows), np.array(sides), rcond=None)[0]


def _frame(corners: np.ndarray) -> np.ndarray:
    a, b = corners[2] - corners[0], corners[1] - corners[0]
    normal = np.cross(a, b)
    return np.column_stack([a, b, normal / np.sqrt(np.linalg.norm(normal))])


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_gradients_have_no_unit(scale):
    rig = sheet_rig(1)
    points = rig.neutral.positions.astype(np.float64)
    target = other(points)
    plain = carried_motion(points, rig.deltas, target, rig.triangles)
    scaled = carried_motion(points * scale, rig.deltas * np.float32(scale), target * scale, rig.triangles)
    np.testing.assert_allclose(scaled.change, plain.change, atol=2e-5)
    np.testing.assert_allclose(scaled.edges / scale, plain.edges, atol=2e-5)


def test_a_mesh_of_one_triangle_is_transferred():
    mesh = Mesh.from_triangles(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32))
    rig = Rig.from_arrays(mesh, {"up": mesh.positions + np.float32([[0, 0, 0], [0, 0, 0], [0, 0.2, 0]])})
    way = Transfer(rig, mesh.positions.astype(np.float64))
    np.testing.assert_allclose(way.offsets[..., 0], rig.deltas[0], atol=1e-5)
