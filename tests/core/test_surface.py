"""Triangles, normals and split vertices against independent truth."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from facemorph.core.mesh import Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.split import split_vertices
from facemorph.core.triangles import triangulated
from facemorph.errors import MeshDataError


def area(points: np.ndarray) -> float:
    return float(
        np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1).sum() / 2
    )


NOTCHED = np.array([[0, 0], [4, 0], [4, 3], [3, 3], [2, 1], [1, 3], [0, 3]], np.float32)
SPIRAL = np.array(
    [[0, 0], [5, 0], [5, 5], [1, 5], [1, 2], [3, 2], [3, 3], [2, 3], [2, 4], [4, 4], [4, 1], [0, 1]]
)


@pytest.mark.parametrize("outline", [NOTCHED, SPIRAL])
@pytest.mark.parametrize("turn", [np.eye(3), np.array([[0, 0, 1], [1, 0, 0], [0, -1, 0]])])
def test_a_concave_polygon_is_cut_inside_its_outline(outline, turn):
    x, y = outline.T
    expected = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    flat = np.c_[outline, np.zeros(len(outline))] @ turn
    for step in range(len(flat)):
        rolled = np.roll(flat, step, axis=0).astype(np.float32)
        mesh = Mesh.from_polygons(rolled, np.arange(len(flat))[None])
        triangles = triangulated(mesh).vertices
        assert len(triangles) == len(flat) - 2
        assert area(rolled[triangles]) == pytest.approx(expected, rel=1e-6)


def test_polygons_keep_their_winding_and_their_corners(small_rig):
    mesh = small_rig.neutral
    triangles = triangulated(mesh)
    assert len(triangles.vertices) == 2 * mesh.polygon_count
    assert np.array_equal(mesh.corner_vertices[triangles.corners], triangles.vertices)
    assert np.array_equal(triangles.polygon, np.repeat(np.arange(mesh.polygon_count), 2))


def test_polygons_of_fewer_than_three_corners_give_no_triangles():
    mesh = Mesh(
        np.zeros((4, 3), np.float32), np.array([0, 1, 3, 6], np.int32), np.array([0, 0, 1, 1, 2, 3], np.int32)
    )
    assert len(triangulated(mesh).vertices) == 1


def test_normals_equal_trimesh_and_a_spheres_own():
    ball = trimesh.creation.icosphere(subdivisions=4)
    normals = vertex_normals(ball.vertices.astype(np.float32), ball.faces.astype(np.int32))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
    assert np.degrees(np.arccos(np.clip((normals * ball.vertices).sum(1), -1, 1))).max() < 0.5
    face = np.cross(
        ball.vertices[ball.faces[:, 1]] - ball.vertices[ball.faces[:, 0]],
        ball.vertices[ball.faces[:, 2]] - ball.vertices[ball.faces[:, 0]],
    )
    sums = np.zeros_like(ball.vertices)
    for corner in range(3):
        np.add.at(sums, ball.faces[:, corner], face)
    np.testing.assert_allclose(normals, sums / np.linalg.norm(sums, axis=1, keepdims=True), atol=1e-6)


@pytest.mark.parametrize("scale", [1e-12, 1e20])
def test_normals_stay_finite_at_any_size(scale):
    ball = trimesh.creation.icosphere(subdivisions=2)
    normals = vertex_normals((ball.vertices * scale).astype(np.float32), ball.faces.astype(np.int32))
    np.testing.assert_allclose(normals, ball.vertices, atol=0.1)


def test_a_vertex_without_area_has_some_unit_normal():
    normals = vertex_normals(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.int32))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)


def test_split_vertices_follow_texture_seams_and_lead_back():
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    mesh = Mesh(
        positions,
        np.array([0, 3, 6], np.int32),
        np.array([0, 1, 2, 0, 2, 3], np.int32),
        uvs=np.array([[0, 0], [1, 0], [1, 1], [0.5, 0.5], [0, 1]], np.float32),
        corner_uvs=np.array([0, 1, 2, 3, 2, 4], np.int32),
    )
    triangles = triangulated(mesh)
    drawn = split_vertices(mesh, triangles)
    assert len(drawn.position_of) == 5
    assert np.array_equal(drawn.position_of[drawn.triangles], triangles.vertices)
    assert np.array_equal(drawn.uvs[drawn.triangles], mesh.uvs[mesh.corner_uvs[triangles.corners]])


def test_a_corner_that_names_no_vertex_is_refused():
    with pytest.raises(MeshDataError, match="there are 3"):
        Mesh.from_triangles(np.zeros((3, 3), np.float32), np.array([[0, 1, 3]]))
    with pytest.raises(MeshDataError, match=r"\(V, 3\)"):
        Mesh.from_triangles(np.zeros((3, 2), np.float32), np.array([[0, 1, 2]]))
