"""PLY, STL, OFF and glTF keep their vertices' order, and their bad files end in the package's errors."""

from __future__ import annotations

import json
import random
from pathlib import Path

import numpy as np
import pytest
import trimesh

from facemorph.core.mesh import Mesh
from facemorph.core.triangles import triangulated
from facemorph.errors import MeshFileError
from facemorph.io import read_mesh
from facemorph.io.foreign import named_files
from tests.conftest import bumpy_grid

PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 51 0
1 1 0 0 0 0
0 1 0 0 0 0
4 0 1 2 3
"""


@pytest.fixture
def grid() -> Mesh:
    """A sheet with two vertices at one place and one that nothing uses: a careless reader drops them."""
    mesh = bumpy_grid()
    positions = np.concatenate([mesh.positions, mesh.positions[:1], mesh.positions[:1]])
    corners = mesh.corner_vertices.copy()
    corners[corners == 5] = len(mesh.positions)
    return Mesh(positions, mesh.polygon_starts, corners)


def exported(folder: Path, mesh: Mesh, suffix: str) -> Path:
    """The mesh's triangles written by trimesh."""
    surface = trimesh.Trimesh(mesh.positions, triangulated(mesh).vertices, process=False)
    path = folder / f"mesh.{suffix}"
    if suffix == "gltf":
        for name, data in surface.export(file_type="gltf").items():
            (folder / name).write_bytes(data)
        return folder / "model.gltf"
    surface.export(path)
    return path


@pytest.mark.parametrize("suffix", ["ply", "off", "glb", "gltf"])
def test_order_and_number_of_vertices_are_kept(tmp_path: Path, grid: Mesh, suffix: str) -> None:
    mesh = read_mesh(exported(tmp_path, grid, suffix))
    np.testing.assert_allclose(mesh.positions, grid.positions, atol=1e-6)
    assert mesh.corner_vertices.tolist() == triangulated(grid).vertices.ravel().tolist()
    assert np.diff(mesh.polygon_starts).tolist() == [3] * mesh.polygon_count


def test_an_stl_has_three_vertices_a_triangle(tmp_path: Path, grid: Mesh) -> None:
    mesh = read_mesh(exported(tmp_path, grid, "stl"))
    triangles = triangulated(grid).vertices
    np.testing.assert_allclose(mesh.positions, grid.positions[triangles.ravel()], atol=1e-6)


def test_colours_of_a_ply_are_read(tmp_path: Path) -> None:
    (tmp_path / "a.PLY").write_text(PLY)
    mesh = read_mesh(tmp_path / "a.PLY")
    assert mesh.vertex_count == 4
    assert mesh.colours is not None
    np.testing.assert_allclose(mesh.colours[:2], [[1, 0, 0], [0, 0.2, 0]], atol=1e-6)


def test_real_gltf_files_are_read(shared_data: Path) -> None:
    counts = {path.stem: read_mesh(path).vertex_count for path in (shared_data / "gltf").glob("*/*.gltf")}
    assert counts == {"SimpleMorph": 3, "MorphPrimitivesTest": 30, "AnimatedMorphCube": 24}


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.ply", ""),
        ("a.ply", PLY.replace("4 0 1 2 3", "4 0 1 2 9")),
        ("a.ply", PLY.replace("element vertex 4", "element vertex 4000000000000")),
        ("a.ply", PLY.replace("1 1 0 0", "nan 1 0 0")),
        ("a.ply", PLY.replace("1 1 0 0", "1e99 1 0 0")),
        ("a.ply", PLY.split("0 0 0 255")[0]),
        ("a.stl", "solid x\nfacet"),
        ("a.stl", ""),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
        ("a.off", "OFF\n3000000000000 1 0\n0 0 0\n"),
        ("a.glb", "glTF"),
        ("a.gltf", "{"),
        ("a.gltf", "[]"),
        ("a.gltf", "{}"),
        ("a.gltf", "[" * 100_000),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, name: str, content: str) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(MeshFileError) as refused:
        read_mesh(tmp_path / name)
    assert name in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_gltf_cannot_reach_outside_its_folder_or_repeat_without_end(tmp_path: Path, grid: Mesh) -> None:
    folder = tmp_path / "face"
    folder.mkdir()
    path = exported(folder, grid, "gltf")
    scene = json.loads(path.read_text())
    buffer = scene["buffers"][0]["uri"]
    (folder / buffer).rename(tmp_path / buffer)
    (folder / buffer).symlink_to(tmp_path / buffer)
    for uri in (buffer, f"../{buffer}", str(tmp_path / buffer), f"%2e%2e/{buffer}"):
        scene["buffers"][0]["uri"] = uri
        path.write_text(json.dumps(scene))
        with pytest.raises(MeshFileError, match="not in the mesh's folder"):
            read_mesh(path)
    part = next(i for i, node in enumerate(scene["nodes"]) if "mesh" in node)
    crowd = {**scene, "nodes": [{"mesh": scene["nodes"][part]["mesh"]}] * 90_000, "accessors": [
        {**accessor, "count": 100_000} for accessor in scene["accessors"]]}  # fmt: skip
    ring = {**scene, "nodes": [{"children": [1]}, {"children": [0]}]}
    empty = {**scene, "accessors": [{"count": 10**12, "componentType": 5126, "type": "VEC3"}]}
    for bad, words in ((crowd, "vertices"), (ring, "tree"), (empty, "buffer")):
        path.write_text(json.dumps(bad))
        with pytest.raises(MeshFileError, match=words):
            read_mesh(path)


@pytest.mark.parametrize("suffix", ["ply", "stl", "off", "glb"])
def test_mutated_files_raise_nothing_else(tmp_path: Path, suffix: str) -> None:
    rng = random.Random(suffix)
    good = exported(tmp_path, bumpy_grid(3, 4), suffix).read_bytes()
    path = tmp_path / f"bad.{suffix}"
    refused = 0
    for _ in range(150):
        data = bytearray(good)
        for _ in range(rng.randint(1, 4)):
            data[rng.randrange(len(data))] = rng.randrange(256)
        path.write_bytes(data[: rng.randrange(len(data))] if rng.random() < 0.3 else data)
        try:
            assert np.isfinite(read_mesh(path).positions).all()
        except MeshFileError:
            refused += 1
    assert refused


def test_what_moves_a_gltf_and_is_not_read_is_told(tmp_path: Path, grid: Mesh) -> None:
    path = exported(tmp_path, grid, "gltf")
    assert read_mesh(path).notes == ()
    scene = json.loads(path.read_text())
    part = scene["meshes"][0]["primitives"][0]
    part["targets"] = [{"POSITION": part["attributes"]["POSITION"]}] * 3
    scene["skins"] = [{"joints": [0]}]
    path.write_text(json.dumps(scene))
    notes = read_mesh(path).notes
    assert len(notes) == 2
    assert notes[0].startswith(f"{path}: 3 morph targets are not read; export")
    assert "skin" in notes[1]


def test_real_morph_targets_are_told(shared_data: Path) -> None:
    notes = {p.stem: read_mesh(p).notes for p in (shared_data / "gltf").glob("*/*.gltf")}
    assert all("morph target" in note[0] for note in notes.values())
    assert "2 morph targets" in notes["SimpleMorph"][0]


def test_the_files_that_a_gltf_names_are_those_in_its_folder(tmp_path: Path, grid: Mesh) -> None:
    path = exported(tmp_path, grid, "gltf")
    scene = json.loads(path.read_text())
    buffers = [buffer["uri"] for buffer in scene["buffers"]]
    (tmp_path / "a skin.png").write_bytes(b"x")
    images = [{"uri": uri} for uri in ("a%20skin.png", "gone.png", "../outside.png", "data:,x", 3)]
    for some, names in ((images, [*buffers, "a skin.png"]), (None, buffers), ([None, {}], buffers)):
        path.write_text(json.dumps({**scene, "images": some}))
        assert [file.name for file in named_files(path)] == names
    assert named_files(exported(tmp_path, grid, "ply")) == ()
