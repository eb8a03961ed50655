"""What is written is what was there: reading it again gives the same arrays, and its looks come along."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.errors import MeshDataError, OutputError
from facemorph.io import load_rig, read_mesh, write_obj
from facemorph.io.obj_read import parse_obj
from facemorph.io.obj_write import _decimal_texts
from tests.conftest import bumpy_grid
from tests.io.texts import assert_same_mesh, odd_obj, written


@pytest.mark.parametrize("seed", range(60))
def test_reading_what_was_written_gives_the_same_mesh(tmp_path: Path, seed: int) -> None:
    mesh = parse_obj(Path("x.obj"), odd_obj(seed)[0].encode()).mesh
    write_obj(tmp_path / "again.obj", mesh)
    assert_same_mesh(read_mesh(tmp_path / "again.obj"), mesh)


@given(
    arrays(
        np.float32, st.integers(1, 30), elements=st.floats(width=32, allow_nan=False, allow_infinity=False)
    )
)
def test_every_number_comes_back_bit_for_bit(numbers: np.ndarray) -> None:
    back = np.array([float(text) for text in _decimal_texts(numbers)]).astype(np.float32)
    assert back.tobytes() == numbers.tobytes()


def test_numbers_are_as_short_as_they_can_be() -> None:
    assert _decimal_texts(np.array([0.1, 1, -2.5, 12.345678], np.float32)) == [
        "0.1",
        "1.0",
        "-2.5",
        "12.345678",
    ]


def test_colours_labels_and_names_with_blanks_come_back(tmp_path: Path) -> None:
    grid = bumpy_grid(3, 4)
    mesh = replace(
        grid,
        colours=np.linspace(0, 1, 36, dtype=np.float32).reshape(12, 3),
        groups=Labels(("left eye", "#2"), np.array([0, 0, -1, 1, 1, 0], np.int32)),
        objects=Labels(("голова",), np.zeros(6, np.int32)),
    )
    write_obj(tmp_path / "a.obj", mesh)
    assert_same_mesh(read_mesh(tmp_path / "a.obj"), mesh)


def test_names_cannot_break_the_file(tmp_path: Path) -> None:
    mesh = replace(bumpy_grid(2, 2), groups=Labels(("a\nf 1 1 1\\",), np.zeros(1, np.int32)))
    write_obj(tmp_path / "a.obj", mesh)
    again = read_mesh(tmp_path / "a.obj")
    assert again.polygon_count == 1
    assert again.groups is not None
    assert again.groups.names == ("a_f 1 1 1_",)


def test_given_normals_take_the_place_of_the_meshs_own(tmp_path: Path) -> None:
    grid = bumpy_grid(3, 3)
    mesh = replace(
        grid, normals=np.array([[1, 0, 0]], np.float32), corner_normals=np.zeros_like(grid.corner_vertices)
    )
    normals = np.tile(np.array([[0, 0, 1]], np.float32), (9, 1))
    write_obj(tmp_path / "a.obj", mesh, normals)
    again = read_mesh(tmp_path / "a.obj")
    assert again.normals.tolist() == normals.tolist()
    assert again.corner_normals is not None
    assert again.corner_normals.tolist() == mesh.corner_vertices.tolist()
    with pytest.raises(MeshDataError, match="normals"):
        write_obj(tmp_path / "b.obj", mesh, normals[:-1])


def textured(folder: Path, content: bytes = b"picture") -> Mesh:
    """A mesh with a material whose texture lies in `folder`."""
    folder.mkdir(exist_ok=True)
    (folder / "my skin.png").write_bytes(content)
    material = Material("skin", (0.5, 0.25, 1.0), (0.1, 0.1, 0.1), 32.0, 0.75, folder / "my skin.png")
    return replace(
        bumpy_grid(2, 3),
        materials_used=Labels(("skin",), np.zeros(2, np.int32)),
        materials={"skin": material},
    )


def test_materials_and_textures_come_along(tmp_path: Path) -> None:
    mesh = textured(tmp_path / "face")
    paths = write_obj(tmp_path / "out" / "a.obj", mesh)
    assert sorted(path.name for path in paths) == ["a.mtl", "a.obj", "my skin.png"]
    again = read_mesh(tmp_path / "out" / "a.obj").materials["skin"]
    assert again == replace(mesh.materials["skin"], texture=tmp_path / "out" / "my skin.png")
    assert again.texture is not None
    assert again.texture.read_bytes() == b"picture"


def test_files_of_others_are_left_alone(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "my skin.png").write_bytes(b"another picture")
    (out / "a.mtl").write_bytes(b"newmtl other\n")
    mesh = textured(tmp_path / "face")
    first = write_obj(out / "a.obj", mesh)
    assert (out / "my skin.png").read_bytes() == b"another picture"
    assert (out / "a.mtl").read_bytes() == b"newmtl other\n"
    texture = read_mesh(out / "a.obj").materials["skin"].texture
    assert texture is not None
    assert texture.read_bytes() == b"picture"
    # Written again, the same files are used: nothing piles up.
    assert write_obj(out / "a.obj", mesh) == first[:1]


def test_exporting_beside_the_source_copies_nothing(tmp_path: Path) -> None:
    mesh = textured(tmp_path / "face")
    paths = write_obj(tmp_path / "face" / "a.obj", mesh)
    assert sorted(path.name for path in paths) == ["a.mtl", "a.obj"]


def test_a_failed_write_leaves_what_was_there(tmp_path: Path) -> None:
    goal = written(tmp_path, "old", "a.obj")
    broken = replace(bumpy_grid(2, 2), groups=Labels((), np.array([5], np.int32)))
    with pytest.raises(IndexError):
        write_obj(goal, broken)
    assert goal.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["a.obj"]


def test_where_nothing_can_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    for goal in (tmp_path, tmp_path / "file" / "a.obj"):
        with pytest.raises(OutputError):
            write_obj(goal, bumpy_grid(2, 2))


def test_an_exported_pose_loads_as_a_shape_of_its_face(tmp_path: Path, small_rig) -> None:
    write_obj(tmp_path / "neutral.obj", small_rig.neutral)
    write_obj(tmp_path / "grin.obj", small_rig.posed({"happy": 0.5}), small_rig.normals({"happy": 0.5}))
    rig = load_rig(tmp_path)
    assert rig.names == ("grin",)
    np.testing.assert_allclose(rig.deltas[0], small_rig.deltas[0] * 0.5, atol=1e-6)


def everything_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.mark.parametrize("goal", ["d.obj", "file/d.obj", "d.obj/deep/new.obj/../.."])
def test_where_a_mesh_cannot_be_written_nothing_at_all_is_left(tmp_path: Path, goal: str) -> None:
    mesh = textured(tmp_path / "face")
    out = tmp_path / "out"
    (out / "d.obj").mkdir(parents=True)
    (out / "file").write_text("x")
    before = everything_in(tmp_path)
    with pytest.raises(OutputError, match=r"d\.obj"):
        write_obj(out / goal, mesh)
    assert everything_in(tmp_path) == before


def test_a_write_that_breaks_off_leaves_no_companions_and_no_new_folders(tmp_path: Path) -> None:
    mesh = replace(textured(tmp_path / "face"), groups=Labels((), np.array([5, 5], np.int32)))
    before = everything_in(tmp_path)
    with pytest.raises(IndexError):
        write_obj(tmp_path / "new" / "folder" / "a.obj", mesh)
    assert everything_in(tmp_path) == before


def test_a_rename_that_fails_takes_the_companions_back(tmp_path: Path, monkeypatch) -> None:
    mesh = textured(tmp_path / "face")
    before = everything_in(tmp_path)
    rename = Path.replace

    def failing(self: Path, target: Path) -> Path:
        if target.suffix == ".obj":
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "replace", failing)
    with pytest.raises(OutputError, match=r"out/a\.obj could not be written: no space"):
        write_obj(tmp_path / "out" / "a.obj", mesh)
    assert everything_in(tmp_path) == before


def test_two_textures_of_one_name_both_come_along(tmp_path: Path) -> None:
    mesh = textured(tmp_path / "face")
    other = textured(tmp_path / "face" / "more", b"another").materials["skin"]
    both = {**mesh.materials, "eye": replace(other, name="eye")}
    mesh = replace(mesh, materials=both, materials_used=Labels(("skin", "eye"), np.array([0, 1], np.int32)))
    write_obj(tmp_path / "out" / "a.obj", mesh)
    again = read_mesh(tmp_path / "out" / "a.obj").materials
    contents = [again[name].texture.read_bytes() for name in ("skin", "eye")]  # type: ignore[union-attr]
    assert contents == [b"picture", b"another"]
