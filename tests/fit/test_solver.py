"""What holds vertices in place, and the sparse solve against a dense one."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.triangles import triangulated
from facemorph.fit.gradients import edge_matrix, edges_of
from facemorph.fit.parts import PartMeans, anchoring, connected_parts
from facemorph.fit.solver import VertexSolver
from tests.fit.faces import bumps, joined, octahedron, sheet_rig

DRAW = np.random.default_rng(4)


def _deltas(count: int, still: np.ndarray) -> np.ndarray:
    made = DRAW.normal(size=(2, count, 3)).astype(np.float32)
    made[:, still] = 0.0
    return made


@pytest.mark.parametrize("held", ["border", "nothing", "everything"])
def test_the_sparse_solve_equals_dense_least_squares(held):
    mesh, _ = joined(sheet_rig(1, 5, 6).neutral, octahedron((0, 0, -2), 0.4))
    triangles = triangulated(mesh).vertices
    count = mesh.vertex_count
    still = {
        "border": np.arange(count) < 12,
        "nothing": np.zeros(count, bool),
        "everything": np.ones(count, bool),
    }
    anchors = anchoring(triangles, _deltas(count, still[held]), mesh.diagonal)
    edges, prior = DRAW.normal(size=(2, 3, 2, len(triangles))), DRAW.normal(size=(2, 3, count))
    found = VertexSolver(triangles, anchors).solve(edges, prior)
    pull = np.where(anchors.still, 1.0, np.where(anchors.drifting, 1e-5, 0.0))
    matrix = np.vstack([edge_matrix(triangles, count).toarray(), np.diag(np.sqrt(pull))])
    for k in range(2):
        for c in range(3):
            side = np.concatenate([edges[k, c].ravel(), np.sqrt(pull) * prior[k, c]])
            dense = np.linalg.lstsq(matrix, side, rcond=None)[0]
            np.testing.assert_allclose(found[k, c], dense, atol=1e-6)


def test_edges_in_single_and_double_precision_give_the_same():
    rig = sheet_rig(1)
    anchors = anchoring(rig.triangles, rig.deltas, rig.neutral.diagonal)
    solver = VertexSolver(rig.triangles, anchors)
    edges = DRAW.normal(size=(3, 3, 2, len(rig.triangles))).astype(np.float32)
    prior = np.zeros((3, 3, rig.neutral.vertex_count))
    np.testing.assert_allclose(
        solver.solve(edges, prior), solver.solve(edges.astype(float), prior), atol=1e-4
    )


def test_many_right_sides_at_once_are_the_same_as_one_by_one():
    rig = sheet_rig(1)
    solver = VertexSolver(rig.triangles, anchoring(rig.triangles, rig.deltas, rig.neutral.diagonal))
    edges = DRAW.normal(size=(13, 3, 2, len(rig.triangles)))
    prior = DRAW.normal(size=(13, 3, rig.neutral.vertex_count))
    alone = np.concatenate([solver.solve(edges[[k]], prior[[k]]) for k in range(13)])
    np.testing.assert_allclose(solver.solve(edges, prior), alone, atol=1e-12)
    assert solver.solve(edges[:0], prior[:0]).shape == prior[:0].shape


def test_vertices_without_triangles_stay_where_the_prior_says():
    rig = sheet_rig(1)
    deltas = np.concatenate([rig.deltas, np.zeros((1, 2, 3), np.float32)], axis=1)
    deltas[0, -1] = (1.0, 2.0, 3.0)
    anchors = anchoring(rig.triangles, deltas, 10.0)
    prior = deltas.astype(np.float64).transpose(0, 2, 1)
    found = VertexSolver(rig.triangles, anchors).solve(
        edges_of(deltas[0].astype(float), rig.triangles)[None], prior
    )
    np.testing.assert_allclose(found[0].T, deltas[0], atol=1e-9)


def test_parts_and_what_holds_them():
    mesh, places = joined(sheet_rig(1).neutral, octahedron((0, 0, -2), 0.4), octahedron((0, 0, -4), 0.4))
    eye, tooth = places
    deltas = np.zeros((2, mesh.vertex_count, 3), np.float32)
    deltas[0, :40] = 0.1
    deltas[1, eye] = (0.0, -0.5, 0.0)
    anchors = anchoring(triangulated(mesh).vertices, deltas, mesh.diagonal)
    assert len(anchors.floating) == 3
    np.testing.assert_array_equal(np.flatnonzero(anchors.drifting), np.arange(eye.start, eye.stop))
    assert anchors.still[tooth].all() and not anchors.still[:40].any() and anchors.still[40 : eye.start].all()
    np.testing.assert_array_equal(np.flatnonzero(anchors.main), np.arange(eye.start))


def test_the_skin_is_the_part_that_moves_however_much_hair_there_is():
    hair = sheet_rig(1, 20, 20)
    mesh, places = joined(
        sheet_rig(1).neutral, (hair.neutral.positions + np.array([0, 0, 3]), hair.triangles)
    )
    deltas = np.zeros((1, mesh.vertex_count, 3), np.float32)
    deltas[0, : places[0].start] = bumps(mesh.positions[: places[0].start].astype(float), 1, 3)[0]
    anchors = anchoring(triangulated(mesh).vertices, deltas, mesh.diagonal)
    np.testing.assert_array_equal(np.flatnonzero(anchors.main), np.arange(places[0].start))
    nothing = anchoring(triangulated(mesh).vertices, 0 * deltas, mesh.diagonal)
    assert nothing.main[places[0]].all() and not nothing.main[0]


def test_connected_parts_are_numbered_and_lone_vertices_are_parts():
    parts = connected_parts(np.array([[0, 1, 2], [2, 3, 0], [5, 6, 7]], np.int32), 9)
    assert len(set(parts[:4].tolist())) == 1
    assert len({int(parts[k]) for k in (0, 4, 5, 8)}) == 4
    assert connected_parts(np.zeros((0, 3), np.int32), 3).tolist() == [0, 1, 2]


def test_means_of_parts_are_means():
    part = np.array([2, 0, 2, 2], np.int32)
    rows = DRAW.normal(size=(3, 4))
    found = PartMeans(part, 4)(rows)
    np.testing.assert_allclose(found[:, 2], rows[:, [0, 2, 3]].mean(axis=1))
    np.testing.assert_allclose(found[:, 0], rows[:, 1])
    assert not found[:, [1, 3]].any()
