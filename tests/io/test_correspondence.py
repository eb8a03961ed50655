"""Shapes in another vertex order are recognised and put right; nothing else is taken for that."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.core.correctives import Corrective
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Labels, Mesh
from facemorph.core.reorder import reorder, same_polygons, vertex_order
from facemorph.core.triangles import triangulated
from facemorph.core.wrinkles import Wrinkle
from facemorph.errors import CorrespondenceError, MeshFileError, OutputError
from facemorph.io import check_folder, load_rig, read_mesh, repair_folder, write_obj
from facemorph.resources import builtin_faces
from tests.conftest import bumpy_grid
from tests.io.test_faces import npz
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
    starts, sizes = mesh.polygon_starts[:-1], np.diff(mesh.polygon_starts)
    rows = rng.permutation(mesh.polygon_count)
    turns = np.zeros(len(rows), int) if mesh.corner_uvs is not None else rng.integers(0, 4, len(rows))
    taken = np.concatenate(
        [starts[row] + np.roll(np.arange(sizes[row]), k) for row, k in zip(rows, turns, strict=True)]
    )
    return (
        replace(
            mesh,
            positions=mesh.positions[old],
            polygon_starts=np.concatenate([[0], np.cumsum(sizes[rows])]).astype(np.int32),
            corner_vertices=new[mesh.corner_vertices[taken]].astype(np.int32),
            corner_uvs=None if mesh.corner_uvs is None else mesh.corner_uvs[taken],
        ),
        new,
    )


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
    out.mkdir()
    repair = repair_folder(folder, out)
    assert (repair.reordered, sorted(repair.copied)) == (["happy.obj"], ["good.obj", "neutral.obj"])
    assert repair.lines() == [f"wrote {out}: happy.obj put in the neutral's order, 2 files copied."]
    assert (folder / "happy.obj").read_bytes() == before
    assert read_mesh(out / "happy.obj").positions.tobytes() == shape.positions.tobytes()
    assert load_rig(out).names == ("happy", "good")
    kept = (out / "happy.obj").read_bytes()
    for taken in (out, folder, out / "happy.obj"):
        with pytest.raises(OutputError, match="overwritten"):
            repair_folder(folder, taken)
    assert (out / "happy.obj").read_bytes() == kept


def test_nothing_is_written_where_nothing_is_to_be_repaired(tmp_path: Path) -> None:
    face = tmp_path / "face"
    face.mkdir()
    written(face, SQUARE, "neutral.obj")
    written(face, SQUARE.replace("1 1 0", "1 1 1"), "a.obj")
    repair = repair_folder(face, tmp_path / "out")
    assert not repair.needed
    assert "nothing to repair" in repair.lines()[0]
    assert [path.name for path in tmp_path.iterdir()] == ["face"]


def a_whole_face(folder: Path) -> Mesh:
    """A described face in two folders with looks and shapes.npz; happy in another order, two broken."""
    neutral = with_uvs(bumpy_grid())
    neutral = replace(neutral, materials_used=Labels(("skin",), np.zeros(neutral.polygon_count, np.int32)))
    shape = deformed(neutral, 1)
    for name, mesh in (("neutral", neutral), ("good", shape), ("happy", shuffled(shape, 2)[0])):
        write_obj(folder / "meshes" / f"{name}.obj", mesh)
        path = folder / "meshes" / f"{name}.obj"
        path.write_text("mtllib my looks.mtl\n" + path.read_text())
    (folder / "meshes" / "maps").mkdir()
    Image.new("RGB", (2, 2)).save(folder / "meshes" / "maps" / "skin.png")
    written(folder / "meshes", "newmtl skin\nmap_Kd maps/skin.png\n", "my looks.mtl")
    written(folder, "v 0 0 x\n", "broken.obj")
    written(folder, SQUARE, "other.obj")
    written(folder, "no face of this", "notes.txt")
    np.savez(folder / "more.npz", **npz(neutral.vertex_count, region_weights=np.zeros((1, 99), np.uint8)))
    entries = {
        "happy": "meshes/happy.obj",
        "sad": "broken.obj",
        "good": "meshes/good.obj",
        "angry": "other.obj",
    }
    text = 'name = "A \\"B\\" \\u007f"\nunit = "cm"\nneutral = "meshes/neutral.obj"\nshapes = "more.npz"\n'
    for name, file in entries.items():
        text += f"[[expressions]]\nname = '{name}'\nlabel = '{name}!'\nfile = '{file}'\n"
    text += "[[landmarks]]\nname = 'nose'\nvertex = 3\nmpeg4 = '9.3'\n"
    text += "[[wrinkles]]\nname = 'w'\nset = 'red'\narea = [0, 0.5, 1, 1]\nshapes = { happy = 0.5 }\n"
    text += "[[correctives]]\nshape = 'AU1'\nproduct = ['happy', 'jawOpen']\n"
    written(folder, text + "[frame]\nlow = [0, 0, -1]\nhigh = [2, 1.5, 1]\n", "face.toml")
    return shape


def files_in(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_a_repaired_face_opens_with_all_that_belongs_to_it_and_without_what_is_broken(tmp_path: Path) -> None:
    folder, out = tmp_path / "face", tmp_path / "deep" / "out"
    shape = a_whole_face(folder)
    before = files_in(folder)
    repair = repair_folder(folder, out)
    assert files_in(folder) == before
    assert repair.refused == ""
    assert repair.reordered == ["happy.obj"]
    assert [name for name, _ in repair.left_out] == ["broken.obj", "other.obj"]
    assert "line 1" in repair.left_out[0][1]
    assert set(files_in(out)) == {
        "face.toml", "more.npz", "meshes/neutral.obj", "meshes/good.obj", "meshes/happy.obj",
        "meshes/my looks.mtl", "meshes/maps/skin.png",
    }  # fmt: skip
    rig = load_rig(out)
    assert rig.names == ("happy", "good", "AU1", "jawOpen")
    assert [s.label for s in rig.shapes[:2]] == ["happy!", "good!"]
    assert (rig.info.name, rig.info.unit, rig.info.landmarks[0].mpeg4) == ('A "B" \x7f', "cm", "9.3")
    assert rig.info.frame == ((0.0, 0.0, -1.0), (2.0, 1.5, 1.0))
    assert rig.wrinkles == (Wrinkle("w", "red", (0.0, 0.5, 1.0, 1.0), shapes={"happy": 0.5}),)
    assert rig.correctives == (Corrective("AU1", ("happy", "jawOpen")),)
    assert rig.neutral.materials["skin"].texture == out / "meshes" / "maps" / "skin.png"
    np.testing.assert_allclose(rig.posed({"happy": 1.0}).positions, shape.positions, atol=1e-6)
    assert read_mesh(out / "meshes" / "happy.obj").materials["skin"].texture is not None
    assert check_folder(out).ok
    assert sorted(p.name for p in tmp_path.iterdir()) == ["deep", "face"]


def test_a_description_that_stays_true_is_copied_as_it_is(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    a_whole_face(folder)
    text = "# mine\nneutral = 'meshes/neutral.obj'\n[[expressions]]\nname = 'h'\nfile = 'meshes/happy.obj'\n"
    written(folder, text, "face.toml")
    repair_folder(folder, tmp_path / "out")
    assert (tmp_path / "out" / "face.toml").read_text() == text
    assert load_rig(tmp_path / "out").names == ("h",)


def test_a_shape_of_another_format_is_repaired_as_an_obj(tmp_path: Path) -> None:
    import trimesh

    folder, mesh = tmp_path / "face", bumpy_grid()
    triangles = triangulated(mesh).vertices
    new = np.random.default_rng(1).permutation(mesh.vertex_count)
    places = np.empty_like(mesh.positions)
    places[new] = mesh.positions
    folder.mkdir()
    trimesh.Trimesh(mesh.positions, triangles, process=False).export(folder / "neutral.ply")
    trimesh.Trimesh(places, new[triangles], process=False).export(folder / "up.ply")
    written(folder, "[[expressions]]\nname = 'up'\nfile = 'up.ply'\n", "face.toml")
    written(folder, "neutral = 'neutral.ply'\n" + (folder / "face.toml").read_text(), "face.toml")
    repair = repair_folder(folder, tmp_path / "out")
    assert (repair.reordered, repair.refused) == (["up.obj"], "")
    np.testing.assert_allclose(load_rig(tmp_path / "out").deltas, 0.0, atol=1e-6)


def test_a_repair_that_fails_leaves_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    a_whole_face(folder)
    written(folder / "meshes", "v x", "neutral.obj")
    with pytest.raises(MeshFileError, match=r"neutral\.obj:1"):
        repair_folder(folder, tmp_path / "new" / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["face"]


def test_a_copy_that_does_not_open_yet_is_told(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    a_whole_face(folder)
    toml = (folder / "face.toml").read_text()
    written(folder, toml.replace("vertex = 3", "vertex = 999"), "face.toml")
    assert "does not open yet" in repair_folder(folder, tmp_path / "out").lines()[-1]
