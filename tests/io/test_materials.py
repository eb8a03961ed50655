"""Materials are read as far as they can be, and nothing outside the mesh's folder is touched."""

from __future__ import annotations

from pathlib import Path

import pytest

from facemorph.io import read_mesh, write_obj
from facemorph.io.mtl import read_libraries
from tests.io.texts import SQUARE, written

MESH = "mtllib face.mtl\nusemtl skin\n" + SQUARE


def texture_of(folder: Path, line: str) -> Path | None:
    written(folder, f"newmtl skin\n{line}\n", "face.mtl")
    return read_mesh(written(folder, MESH)).materials["skin"].texture


def test_colours_and_opacity_are_read_and_kept_in_range(tmp_path: Path) -> None:
    written(
        tmp_path,
        "newmtl other\nKd 1 1 1\nnewmtl skin\r\n Kd 0.5 2 -1\nKs .25\nNs 96\nTr 0.25\nKd x\n",
        "face.mtl",
    )
    skin = read_mesh(written(tmp_path, MESH)).materials["skin"]
    assert (skin.diffuse, skin.specular, skin.shininess, skin.opacity) == ((0.5, 1, 0), (0.25,) * 3, 96, 0.75)


@pytest.mark.parametrize(
    "line",
    [
        "map_Kd a b.png",
        "map_Kd -s 1 1 1 -o 0 0 a b.png",
        "map_kd\ta b.png",
        "map_Kd -clamp on -mm 0 1 a b.png",
        "map_Kd ./a b.png",
    ],
)
def test_a_texture_is_found_after_its_options(tmp_path: Path, line: str) -> None:
    (tmp_path / "a b.png").write_bytes(b"x")
    texture = texture_of(tmp_path, line)
    assert texture is not None
    assert texture.resolve() == (tmp_path / "a b.png").resolve()


def test_a_texture_in_a_folder_below_is_found_with_either_slash(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "a.png").write_bytes(b"x")
    for name in ("maps/a.png", "maps\\a.png"):
        assert texture_of(tmp_path, f"map_Kd {name}") is not None


def test_no_path_leaves_the_folder(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    folder.mkdir()
    outside = tmp_path / "secret.png"
    outside.write_bytes(b"x")
    (folder / "link.png").symlink_to(outside)
    for name in (
        "../secret.png",
        str(outside),
        "link.png",
        "..\\secret.png",
        "C:\\secret.png",
        "a\0b",
        "x" * 5000,
    ):
        assert texture_of(folder, f"map_Kd {name}") is None, name
    written(tmp_path, "newmtl skin\n", "outside.mtl")
    assert read_mesh(written(folder, MESH.replace("face.mtl", "../outside.mtl"))).materials == {}


def test_a_missing_material_file_does_not_stop_a_mesh_and_is_told(tmp_path: Path) -> None:
    path = written(tmp_path, MESH)
    mesh = read_mesh(path)
    assert mesh.materials == {}
    assert mesh.materials_used is not None
    assert mesh.materials_used.names == ("skin",)
    assert mesh.notes == (f"{path}: the material file 'face.mtl' is not in the mesh's folder.",)
    assert "face.mtl" in read_libraries(path, ["face.mtl"]).problems[0]


def test_several_material_files_on_one_line_are_read(tmp_path: Path) -> None:
    written(tmp_path, "newmtl skin\nKd 1 0 0\n", "a.mtl")
    written(tmp_path, "newmtl skin\nKd 0 0 0\nnewmtl eye\n", "b.mtl")
    path = written(tmp_path, "mtllib a.mtl b.mtl\nusemtl skin\n" + SQUARE + "usemtl eye\nf 1 2 3\n")
    materials = read_mesh(path).materials
    assert set(materials) == {"skin", "eye"}
    assert materials["skin"].diffuse == (1, 0, 0)


def test_rubbish_is_no_material(tmp_path: Path) -> None:
    (tmp_path / "face.mtl").write_bytes(
        b"\xff\0newmtl\nKd 1 1 1\nnewmtl \n\nmap_Kd\nNs nan\nnewmtl skin\nNs nan\nd inf\n"
    )
    skin = read_mesh(written(tmp_path, MESH)).materials["skin"]
    assert (skin.shininess, skin.opacity) == (10.0, 1.0)


@pytest.mark.parametrize("name", ["gone.png", "../outside.png"])
def test_a_texture_that_is_not_there_is_told_and_its_material_knows(tmp_path: Path, name: str) -> None:
    written(tmp_path, f"newmtl skin\nKd 1 1 1\nmap_Kd {name}\n", "face.mtl")
    mesh = read_mesh(written(tmp_path, MESH))
    assert mesh.materials["skin"].texture is None
    assert mesh.materials["skin"].texture_lost
    assert len(mesh.notes) == 1
    assert name in mesh.notes[0]


@pytest.mark.parametrize(
    ("line", "field", "height"),
    [
        ("map_Bump a b.png", "bump", None),
        ("map_bump -bm 0.25 a b.png", "bump", 0.25),
        ("bump -o 0 0 -bm 2 -clamp on a b.png", "bump", 2.0),
        ("norm a b.png", "bump", None),
        ("map_Bump -bm nan a b.png", "bump", None),
        ("map_Bump -bm 1e300 a b.png", "bump", 1e6),
        ("map_wrinkles -bm 0.1 a b.png", "wrinkles", 0.1),
        ("map_Pr a b.png", "roughness", None),
    ],
)
def test_further_maps_are_read_with_their_height(
    tmp_path: Path, line: str, field: str, height: float | None
) -> None:
    (tmp_path / "a b.png").write_bytes(b"x")
    written(tmp_path, f"newmtl skin\n{line}\n", "face.mtl")
    skin = read_mesh(written(tmp_path, MESH)).materials["skin"]
    assert getattr(skin, field) == tmp_path / "a b.png" == skin.pictures[0]
    assert skin.texture is None and not skin.texture_lost
    assert {"bump": skin.bump_height, "wrinkles": skin.wrinkle_height}.get(field) == height


@pytest.mark.parametrize("key", ["map_Bump", "bump", "norm", "map_Pr", "map_wrinkles"])
@pytest.mark.parametrize("name", ["../secret.png", "link.png", "/etc/passwd", "gone.png", "C:\\x.png"])
def test_no_further_map_leaves_the_folder(tmp_path: Path, key: str, name: str) -> None:
    folder = tmp_path / "face"
    folder.mkdir()
    (tmp_path / "secret.png").write_bytes(b"x")
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    written(folder, f"newmtl skin\n{key} -bm 1 {name}\n", "face.mtl")
    library = read_libraries(written(folder, MESH), ["face.mtl"])
    assert library.materials["skin"].pictures == ()
    assert "not in the mesh's folder" in library.problems[0]


def test_further_maps_go_with_an_export(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    folder.mkdir()
    for name in ("a.png", "b.png", "c.png"):
        (folder / name).write_bytes(name.encode())
    written(folder, "newmtl skin\nmap_Bump -bm 0.5 a.png\nmap_Pr b.png\nmap_wrinkles c.png\n", "face.mtl")
    write_obj(tmp_path / "out" / "face.obj", read_mesh(written(folder, MESH)))
    skin = read_mesh(tmp_path / "out" / "face.obj").materials["skin"]
    assert [path.read_bytes() for path in skin.pictures] == [b"a.png", b"b.png", b"c.png"]
    assert (skin.bump_height, skin.wrinkle_height) == (0.5, None)
