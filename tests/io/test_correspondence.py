"""Shapes in another vertex order are recognised and put right; nothing else is taken for that."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.reorder import reorder, same_polygons, vertex_order
from facemorph.errors import CorrespondenceError, OutputError
from facemorph.io import load_rig, read_mesh, repair_folder, write_obj
from facemorph.resources import builtin_faces
from tests.conftest import bumpy_grid
from tests.io.texts import SQUARE, written


def with_uvs(mesh: Mesh) -> Mesh:
    """The grid with a texture coordinate for each vertex."""
    return replace(mesh, uvs=mesh.positions[:, :2].copy(), corner_uvs=mesh.corner_vertices)


def deformed(mesh: Mesh, seed: int, amount: float = 0.02) -> Mesh:
    """Every vertex moved a little."""
    noise = np.random.default_rng(seed).normal(0, amount, mesh.positions.shape)
    return mesh.with_positions((mesh.positions + noise).astype(np.float32))


def shuffled(mesh: Mesh, seed: int) -> tuple[Mesh, np.ndarray]:
    """The same surface with vertices and polygons in another order, and each vertex's new number."""
    rng = np.random.default_rng(seed)
    old = rng.permutation(mesh.vertex_count)
    new = np.empty_like(old)
    new[old] = np.arange(len(old))
    size = int(mesh.polygon_starts[1])
    rows = rng.permutation(mesh.polygon_count)
    corners = new[mesh.corner_vertices].reshape(-1, size)[rows].astype(np.int32)
    uvs = None if mesh.corner_uvs is None else mesh.corner_uvs.reshape(-1, size)[rows]
    turned = np.stack(
        [np.roll(row, k) for row, k in zip(corners, rng.integers(0, size, len(rows)), strict=True)]
    )
    if uvs is not None:
        turned, uvs = corners, uvs.ravel()
    return replace(mesh, positions=mesh.positions[old], corner_vertices=turned.ravel(), corner_uvs=uvs), new


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("uvs", [False, True])
def test_a_shuffled_and_deformed_shape_is_put_back(seed: int, uvs: bool) -> None:
    neutral = with_uvs(bumpy_grid()) if uvs else bumpy_grid()
    shape = deformed(neutral, seed)
    other, new = shuffled(shape, seed)
    unlike = difference(neutral, other)
    assert unlike is not None
    assert unlike.cause == "order"
    assert np.array_equal(vertex_order(neutral, other), new)
    repaired = reorder(neutral, other)
    assert repaired.positions.tobytes() == shape.positions.tobytes()
    assert difference(neutral, repaired) is None


@pytest.mark.parametrize("name", sorted(builtin_faces())[:1])
def test_a_whole_face_is_put_back(name: str) -> None:
    rig = load_rig(name)
    shape = rig.posed({"happy": 1.0})
    other, new = shuffled(shape, 3)
    assert np.array_equal(vertex_order(rig.neutral, other), new)


def test_where_polygons_stand_and_begin_makes_no_difference() -> None:
    neutral = bumpy_grid()
    rows = neutral.corner_vertices.reshape(-1, 4)
    other = replace(neutral, corner_vertices=np.roll(rows[::-1], 1, axis=1).ravel())
    assert same_polygons(neutral, other)
    assert difference(neutral, other) is None


def test_a_symmetric_surface_turned_over_is_not_taken_for_a_shuffled_one() -> None:
    square = Mesh.from_polygons(
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32), np.array([[0, 1, 2, 3]])
    )
    over = replace(square, corner_vertices=square.corner_vertices[::-1].copy())
    for turned in (over, deformed(over, 1)):
        unlike = difference(square, turned)
        assert unlike is not None
        assert unlike.cause == "polygons"
        assert "turned over" in unlike.problem


def test_the_first_other_polygon_is_shown_with_what_both_have() -> None:
    neutral = bumpy_grid()
    corners = neutral.corner_vertices.copy()
    corners[9] = 50
    unlike = difference(neutral, replace(neutral, corner_vertices=corners))
    assert unlike is not None
    assert unlike.problem == "polygon 3 is 3 51 15 14, the neutral's 3 4 15 14."


def test_counts_are_told() -> None:
    unlike = difference(bumpy_grid(9, 11), bumpy_grid(9, 12))
    assert unlike is not None
    assert (unlike.cause, unlike.problem) == ("vertices", "it has 108 vertices, the neutral 99.")


def test_another_surface_cannot_be_put_in_order() -> None:
    neutral = bumpy_grid(4, 4)
    other = replace(neutral, corner_vertices=np.roll(neutral.corner_vertices, 1))
    with pytest.raises(CorrespondenceError, match="face: "):
        reorder(neutral, other, "face")


def test_repaired_copies_load_and_the_folder_is_left_alone(tmp_path: Path) -> None:
    neutral = with_uvs(bumpy_grid())
    shape = deformed(neutral, 1)
    folder = tmp_path / "face"
    write_obj(folder / "neutral.obj", neutral)
    write_obj(folder / "good.obj", shape)
    write_obj(folder / "happy.obj", shuffled(shape, 2)[0])
    before = (folder / "happy.obj").read_bytes()
    with pytest.raises(CorrespondenceError, match="--repair") as refused:
        load_rig(folder)
    assert refused.value.cause == "order"
    out = tmp_path / "out"
    assert [path.name for path in repair_folder(folder, out)] == ["happy.obj"]
    assert (folder / "happy.obj").read_bytes() == before
    assert read_mesh(out / "happy.obj").positions.tobytes() == shape.positions.tobytes()
    assert load_rig([folder / "neutral.obj", folder / "good.obj", out / "happy.obj"]).names == (
        "happy",
        "good",
    )
    with pytest.raises(OutputError, match="overwritten"):
        repair_folder(folder, out)


def test_nothing_is_repaired_where_nothing_is_out_of_order(tmp_path: Path) -> None:
    written(tmp_path, SQUARE, "neutral.obj")
    written(tmp_path, "v 0 0 0\n" + SQUARE, "a.obj")
    assert repair_folder(tmp_path, tmp_path / "out") == ()
    assert not (tmp_path / "out").exists()
