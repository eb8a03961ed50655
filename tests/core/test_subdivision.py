"""Catmull-Clark: laws of the operator, known answers, and another operator built face by face."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import lil_array

from facemorph.core import subdivision
from facemorph.core.mesh import Labels, Mesh
from facemorph.core.refinement import Refinement
from facemorph.core.rig import Rig
from facemorph.core.subdivision import step_of
from facemorph.errors import OptionError
from tests.conftest import bumpy_grid


def mesh_of(positions: np.ndarray, polygons: list[list[int]], **more: object) -> Mesh:
    """A mesh of polygons of any sizes."""
    starts = np.cumsum([0, *map(len, polygons)]).astype(np.int32)
    corners = np.array([v for polygon in polygons for v in polygon], np.int32)
    return Mesh(np.asarray(positions, np.float32), starts, corners, **more)  # type: ignore[arg-type]


def cube() -> Mesh:
    """The corners of [-1, 1]^3."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return mesh_of(corners, sides)


def prism() -> Mesh:
    """Two pentagons, four quads and, in place of the fifth, two triangles: closed, of mixed polygons."""
    angle = np.arange(5) / 5 * 2 * np.pi
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(5)], 1)
    sides = [[k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5] for k in range(4)]
    polygons = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], *sides, [4, 0, 5], [4, 5, 9]]
    return mesh_of(np.concatenate([ring, ring + np.array([0.2, 0, 1.5])]), polygons)


def awkward() -> Mesh:
    """Three sheets on one edge, two fans on one vertex, a line, a vertex alone, a corner named twice."""
    rng = np.random.default_rng(3)
    polygons = [
        [0, 1, 2, 3],
        [0, 1, 4, 5],
        [1, 0, 6, 7],
        [7, 8, 9],
        [7, 10, 11],
        [2, 2, 12],
        [3, 13],
        [13, 14, 15, 16],
    ]
    return mesh_of(rng.normal(size=(19, 3)), polygons)


MESHES = {"cube": cube(), "prism": prism(), "sheet": bumpy_grid(5, 6), "awkward": awkward()}
meshes = pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES.keys())
levels = pytest.mark.parametrize("level", [1, 2])


def polygons_of(mesh: Mesh) -> list[list[int]]:
    return [list(map(int, part)) for part in np.split(mesh.corner_vertices, mesh.polygon_starts[1:-1])]


def another_operator(mesh: Mesh) -> np.ndarray:
    """The rules read off the papers with dictionaries and sparse rows; rows in `step_of`'s order."""
    faces = [face for face in polygons_of(mesh) if len(face) >= 3]
    sides: dict[tuple[int, int], list[int]] = defaultdict(list)
    for f, face in enumerate(faces):
        for a, b in zip(face, [*face[1:], face[0]], strict=True):
            sides[min(a, b), max(a, b)].append(f)
    edges = sorted(sides)
    count = mesh.vertex_count
    rows = lil_array((count + len(edges) + len(faces), count))
    face_rows = lil_array((len(faces), count))
    for f, face in enumerate(faces):
        for v in face:
            face_rows[f, v] += 1.0 / len(face)
    crease = {edge for edge in edges if len(sides[edge]) != 2 or edge[0] == edge[1]}
    for e, (a, b) in enumerate(edges):
        if (a, b) in crease:
            rows[count + e, a] += 0.5
            rows[count + e, b] += 0.5
        else:
            mean = face_rows[[sides[a, b][0]]] + face_rows[[sides[a, b][1]]]
            rows[count + e] = (mean * 0.25).toarray()[0]
            rows[count + e, a] += 0.25
            rows[count + e, b] += 0.25
    rows[count + len(edges) :] = face_rows.toarray()
    for v in range(count):
        mine = [edge for edge in edges if v in edge and edge[0] != edge[1]]
        corners = [f for f, face in enumerate(faces) for w in face if w == v]
        sharp = [edge for edge in mine if edge in crease]
        others = [sum(edge) - v for edge in mine]
        n = len(mine)
        if not sharp and n >= 2 and n == len(corners):
            # As Catmull and Clark have it: Q / n + 2 R / n + (n - 3) S / n.
            for f in corners:
                rows[v] = rows[[v]].toarray()[0] + face_rows[[f]].toarray()[0] / n**2
            for w in others:
                rows[v, w] += 2.0 / n * 0.5 / n
                rows[v, v] += 2.0 / n * 0.5 / n
            rows[v, v] += (n - 3.0) / n
        elif len(sharp) == 2 and len(corners) >= 2:
            rows[v, v] = 0.75
            for edge in sharp:
                rows[v, sum(edge) - v] += 0.125
        else:
            rows[v, v] = 1.0
    return rows.toarray()


def matrix(mesh: Mesh, level: int = 1) -> np.ndarray:
    """The operator as a dense matrix."""
    return Refinement.of(mesh, level).apply(np.eye(mesh.vertex_count))


@meshes
def test_the_operator_is_that_of_the_papers(mesh: Mesh) -> None:
    assert np.allclose(matrix(mesh), another_operator(mesh), atol=1e-12)


@meshes
def test_level_two_is_level_one_twice(mesh: Mesh) -> None:
    once = Refinement.of(mesh, 1)
    twice = another_operator(once.fine) @ another_operator(mesh)
    assert np.allclose(matrix(mesh, 2), twice, atol=1e-12)


@meshes
@levels
def test_every_point_is_a_mean_of_the_files(mesh: Mesh, level: int) -> None:
    """Weights are none below 0 and together 1: affine maps commute, and nothing leaves the convex hull."""
    rows = matrix(mesh, level)
    assert rows.min() >= 0.0
    assert np.allclose(rows.sum(axis=1), 1.0, atol=1e-12)


def test_a_cube_becomes_what_is_known() -> None:
    fine = Refinement.of(cube(), 1).fine.positions
    # 5/9 of a corner (n = 3), an edge's point at 3/4 of its middle, faces' points in the faces.
    assert np.allclose(np.abs(fine[:8]), 5.0 / 9.0)
    assert np.allclose(np.sort(np.abs(fine[8:20]), axis=1), [0.0, 0.75, 0.75])
    assert np.allclose(np.sort(np.abs(fine[20:]), axis=1), [0.0, 0.0, 1.0])


def test_a_cubes_corner_goes_to_the_limit_of_halstead_and_others() -> None:
    """(n^2 S + 4 sum of neighbours + sum across) / (n (n + 5)), SIGGRAPH 1993, for quads."""
    mesh = Refinement.of(cube(), 1).fine
    for _ in range(6):
        mesh = Refinement.of(mesh, 1).fine
    quads = Refinement.of(cube(), 1).fine
    ring = [face for face in polygons_of(quads) if 0 in face]
    at = [face.index(0) for face in ring]
    across = quads.positions[[face[(k + 2) % 4] for face, k in zip(ring, at, strict=True)]].sum(0)
    beside = quads.positions[[face[(k + 1) % 4] for face, k in zip(ring, at, strict=True)]].sum(0)
    limit = (9.0 * quads.positions[0] + 4.0 * beside + across) / 24.0
    assert np.allclose(mesh.positions[0], limit, atol=1e-3)


def edges_of(mesh: Mesh) -> set[frozenset[int]]:
    faces = [face for face in polygons_of(mesh) if len(face) >= 3]
    return {frozenset(edge) for face in faces for edge in zip(face, [*face[1:], face[0]], strict=True)}


def euler(mesh: Mesh) -> int:
    return mesh.vertex_count - len(edges_of(mesh)) + mesh.polygon_count


@meshes
def test_there_is_a_point_for_each_vertex_edge_and_face_and_a_quad_for_each_corner(mesh: Mesh) -> None:
    faces = [face for face in polygons_of(mesh) if len(face) >= 3]
    finer = Refinement.of(mesh, 1).fine
    assert finer.vertex_count == mesh.vertex_count + len(edges_of(mesh)) + len(faces)
    assert finer.polygon_count == sum(map(len, faces))


@pytest.mark.parametrize("name", ["cube", "prism", "sheet"])
@levels
def test_the_euler_characteristic_stays(name: str, level: int) -> None:
    assert euler(Refinement.of(MESHES[name], level).fine) == euler(MESHES[name])


@levels
def test_borders_depend_on_borders_alone(level: int) -> None:
    """Two sheets sewn to the same border meet after it is refined, whatever is inside; corners stay."""
    mesh = bumpy_grid(5, 6)
    on_border = np.zeros((5, 6), bool)
    on_border[[0, -1]] = on_border[:, [0, -1]] = True
    rows = matrix(mesh, level)
    fine = Refinement.of(mesh, level).fine
    count = defaultdict(int)
    for face in polygons_of(fine):
        for a, b in zip(face, [*face[1:], face[0]], strict=True):
            count[min(a, b), max(a, b)] += 1
    border = sorted({v for edge, number in count.items() if number == 1 for v in edge})
    assert len(border) == 18 * 2**level
    assert np.all(rows[border][:, ~on_border.ravel()] == 0.0)
    corners = [0, 5, 24, 29]
    assert np.array_equal(fine.positions[corners], mesh.positions[corners])


def test_a_crease_between_corners_is_a_cubic_b_spline() -> None:
    rows = matrix(bumpy_grid(5, 6))
    assert dict(zip(*np.unique(rows[2], return_counts=True), strict=True)) == {0.0: 27, 0.125: 2, 0.75: 1}


@given(st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3), st.sampled_from([1, 2]))
@settings(max_examples=20, deadline=None)
def test_refining_and_morphing_commute(weights: list[float], level: int) -> None:
    mesh = bumpy_grid(5, 6)
    deltas = np.random.default_rng(1).normal(size=(3, mesh.vertex_count, 3)).astype(np.float32)
    rig = Rig.from_arrays(mesh, {f"s{k}": mesh.positions + delta for k, delta in enumerate(deltas)})
    refined = Refinement.of(mesh, level)
    pose = {f"s{k}": weight for k, weight in enumerate(weights)}
    there = refined.apply(rig.positions(pose))
    back = refined.fine.positions + sum(
        c * refined.apply(d) for c, d in zip(weights, rig.deltas, strict=True)
    )
    assert np.allclose(there, back, atol=2e-5)


@levels
def test_affine_maps_commute(level: int) -> None:
    mesh = prism()
    turn, move = np.random.default_rng(2).normal(size=(3, 3)), np.array([3.0, -1.0, 20.0])
    refined = Refinement.of(mesh, level)
    positions = mesh.positions.astype(np.float64)
    assert np.allclose(refined.apply(positions @ turn + move), refined.apply(positions) @ turn + move)


@levels
def test_parts_of_a_polygon_keep_its_labels_and_its_way_round(level: int) -> None:
    mesh = prism()
    labels = Labels(("floor", "wall"), np.array([0, -1, 1, 1, 1, 1, 1, 1], np.int32))
    mesh = Mesh(mesh.positions, mesh.polygon_starts, mesh.corner_vertices, groups=labels)
    fine = Refinement.of(mesh, level).fine
    assert fine.groups is not None
    each = np.array([5, 5, 4, 4, 4, 4, 3, 3]) * 4 ** (level - 1)
    assert np.array_equal(fine.groups.index, np.repeat(labels.index, each))
    a, b, c, d = (fine.positions[fine.corner_vertices[k::4]].astype(np.float64) for k in range(4))
    assert np.einsum("qi,qi->", a, np.cross(b - a, d - a) + np.cross(d - c, b - c)) > 0.0


@levels
def test_texture_coordinates_stay_apart_at_seams_and_bend_nowhere(level: int) -> None:
    """Two quads on one edge with a picture each, one of them laid out by (u, v) = (3 x, 3 y + 10)."""
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
    uvs = np.array([[0, 10], [3, 10], [3, 13], [0, 13], [50, 50], [60, 50], [60, 60], [50, 60]], np.float32)
    corner_uvs = np.arange(8, dtype=np.int32)
    mesh = mesh_of(positions, [[0, 1, 2, 3], [1, 4, 5, 2]], uvs=uvs, corner_uvs=corner_uvs)
    fine = Refinement.of(mesh, level).fine
    assert fine.corner_uvs is not None
    each = 4**level
    there = fine.uvs[fine.corner_uvs[: 4 * each]]
    places, number = np.unique(np.round(there, 4), axis=0, return_counts=True)
    steps = np.arange(2**level + 1) * 3.0 / 2**level
    assert np.array_equal(places, [[u, v + 10.0] for u in steps for v in steps])
    assert number.sum() == 4 * each
    assert fine.uvs[fine.corner_uvs[4 * each :]].min() >= 50.0


def test_a_corner_without_coordinates_gives_none_to_what_it_touches() -> None:
    mesh = mesh_of(
        np.eye(4)[:, :3], [[0, 1, 2], [0, 2, 3]],
        uvs=np.zeros((3, 2), np.float32), corner_uvs=np.array([0, 1, 2, 0, -1, 1], np.int32),
    )  # fmt: skip
    fine = Refinement.of(mesh, 1).fine
    assert fine.corner_uvs is not None
    assert (fine.corner_uvs[:12] >= 0).all()
    assert (fine.corner_uvs[12:].reshape(-1, 4) >= 0).sum(axis=1).tolist() == [2, 0, 2]


@levels
def test_the_files_edges_are_known_among_the_others(level: int) -> None:
    refined = Refinement.of(cube(), level)
    fine = refined.fine
    following = np.arange(len(fine.corner_vertices)).reshape(-1, 4)[:, [1, 2, 3, 0]].ravel()
    pairs = np.stack([fine.corner_vertices, fine.corner_vertices[following]], 1)
    own = {tuple(sorted(pair)) for pair in pairs[refined.on_edge].tolist()}
    assert len(own) == 12 * 2**level
    weights = refined.apply(np.eye(8))
    middle = refined.apply(np.eye(8)).argsort(axis=1)[:, -2:]
    edges = {tuple(sorted(e)) for f in polygons_of(cube()) for e in zip(f, [*f[1:], f[0]], strict=True)}
    # An edge's own points lean most on its two ends.
    near = {tuple(sorted(middle[v].tolist())) for pair in own for v in pair if v >= 8}
    assert near <= edges
    assert weights.shape == (fine.vertex_count, 8)


def test_another_mesh_of_the_polygons_is_refined_alike_and_shares_what_it_can() -> None:
    mesh = bumpy_grid(4, 4)
    uvs = mesh.positions[:, :2].copy()
    mesh = Mesh(mesh.positions, mesh.polygon_starts, mesh.corner_vertices, uvs, mesh.corner_vertices)
    moved = mesh.with_positions(mesh.positions * np.float32(2.0))
    refined = Refinement.of(mesh, 2)
    assert np.allclose(refined.finer(moved).positions, refined.fine.positions * 2.0)
    assert refined.finer(moved).uvs is refined.fine.uvs
    assert refined.finer(mesh) is refined.fine


def test_level_zero_is_the_mesh_itself() -> None:
    mesh = cube()
    refined = Refinement.of(mesh, 0)
    assert refined.fine is mesh
    assert refined.apply(mesh.positions) is mesh.positions


def test_too_fine_a_mesh_is_refused_before_it_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subdivision, "MOST_VERTICES", 90)
    with pytest.raises(OptionError, match="at most 90 vertices; this level of this mesh has 98"):
        Refinement.of(cube(), 2)
    with pytest.raises(OptionError, match="0 to 2 levels, not 3"):
        Refinement.of(cube(), 3)


def test_a_vertex_of_many_neighbours_and_an_empty_mesh_are_nothing_special() -> None:
    angle = np.arange(100) / 100 * 2 * np.pi
    rim = np.stack([np.cos(angle), np.sin(angle), np.zeros(100)], 1)
    hub, foot = np.array([[0.0, 0.0, 1.0]]), np.array([[0.0, 0.0, -1.0]])
    fans = [[k, (k + 1) % 100, 100] for k in range(100)] + [[(k + 1) % 100, k, 101] for k in range(100)]
    mesh = mesh_of(np.concatenate([rim, hub, foot]), fans)
    assert np.allclose(matrix(mesh), another_operator(mesh), atol=1e-12)
    empty = Mesh(np.zeros((3, 3), np.float32), np.zeros(1, np.int32), np.zeros(0, np.int32))
    assert step_of(empty).vertex_count == 3
    assert Refinement.of(empty, 2).fine.polygon_count == 0
