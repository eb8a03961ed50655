"""The cache gives back what was read, by content, and never stands in the way."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.rig import Rig
from facemorph.errors import MeshFileError
from facemorph.io import cache, face_set, load_rig
from facemorph.io.obj_write import write_obj
from tests.conftest import bumpy_grid
from tests.io.texts import assert_same_mesh, written


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of the test's own, that keeps small sets too."""
    monkeypatch.setenv(cache.FOLDER_VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setattr(cache, "_SMALL_BYTES", 0)
    return tmp_path / "cache" / "meshes"


@pytest.fixture
def face(tmp_path: Path) -> Path:
    """A folder with a neutral and two shapes, groups, a material and colours."""
    folder = tmp_path / "face"
    mesh = bumpy_grid()
    write_obj(folder / "neutral.obj", mesh)
    text = (folder / "neutral.obj").read_text().replace("f ", "o head\ng skin\nusemtl red\nf ", 1)
    written(folder, "mtllib face.mtl\n" + text, "neutral.obj")
    written(folder, "newmtl red\nKd 1 0 0\n", "face.mtl")
    for k, name in enumerate(("happy", "sad")):
        write_obj(folder / f"{name}.obj", mesh.with_positions(mesh.positions + np.float32(k + 1)))
    return folder


def unread(*_: object) -> None:
    raise AssertionError("a file was parsed")


def assert_same_rig(a: Rig, b: Rig) -> None:
    assert_same_mesh(a.neutral, b.neutral)
    assert a.neutral.materials == b.neutral.materials
    assert a.shapes == b.shapes
    assert a.deltas.tobytes() == b.deltas.tobytes()


def test_a_set_read_before_is_not_parsed_again_and_is_the_same(face: Path, place: Path, monkeypatch) -> None:
    first = load_rig(face)
    assert len(list(place.iterdir())) == 1
    monkeypatch.setattr(face_set, "_parsed", unread)
    assert_same_rig(load_rig(face), first)
    with pytest.raises(AssertionError):
        load_rig(face, cache=False)


def test_names_and_materials_do_not_come_from_the_cache(face: Path, monkeypatch) -> None:
    load_rig(face)
    monkeypatch.setattr(face_set, "_parsed", unread)
    (face / "sad.obj").rename(face / "tired.obj")
    written(face, "newmtl red\nKd 0 1 0\n", "face.mtl")
    rig = load_rig(face)
    assert rig.names == ("happy", "tired")
    assert rig.neutral.materials["red"].diffuse == (0, 1, 0)


def test_a_changed_file_is_read_anew(face: Path) -> None:
    before = load_rig(face)
    stamp = (face / "sad.obj").stat()
    text = (face / "sad.obj").read_text()
    first = text.split("\n")[1]
    written(
        face,
        text.replace(first, first.replace("0.0", "0.5", 1) if "0.0" in first else "v 7.0 7.0 7.0", 1),
        "sad.obj",
    )
    os.utime(face / "sad.obj", ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
    assert load_rig(face).deltas[1].tobytes() != before.deltas[1].tobytes()


@pytest.mark.parametrize("damage", ["cut", "empty", "flipped", "rubbish", "folder"])
def test_a_damaged_entry_is_read_past_and_replaced(face: Path, place: Path, damage: str) -> None:
    first = load_rig(face)
    entry = next(place.iterdir())
    data = entry.read_bytes()
    half = len(data) // 2
    if damage == "folder":
        entry.unlink()
        entry.mkdir()
    else:
        entry.write_bytes({
            "cut": data[:half], "empty": b"", "rubbish": b"\0" * 500,
            "flipped": data[:half] + bytes([data[half] ^ 255]) + data[half + 1 :],
        }[damage])  # fmt: skip
    assert_same_rig(load_rig(face), first)
    if damage != "folder":
        assert entry.read_bytes() == data


def test_an_entry_of_another_make_is_read_past(face: Path, place: Path) -> None:
    first = load_rig(face)
    entry = next(place.iterdir())
    for change in (
        {"corner_vertices": np.full(10, 99, np.int32)},
        {"positions": np.zeros((3, 2), np.float32)},
        {"deltas": np.zeros((1, 2, 3), np.float32)},
        {"words": np.frombuffer(b"[" * 100_000, np.uint8)},
        {"groups": np.full(1, 5, np.int32)},
        {"corner_uvs": np.zeros(3, np.int32)},
        {"positions": np.array([{}], object)},
    ):
        with np.load(entry) as arrays:
            kept = dict(arrays)
        np.savez(entry, **{**kept, **change})
        assert_same_rig(load_rig(face), first)


def test_a_cache_that_cannot_be_written_stops_nothing(face: Path, tmp_path: Path, monkeypatch) -> None:
    written(tmp_path, "a file", "in_the_way")
    monkeypatch.setenv(cache.FOLDER_VARIABLE, str(tmp_path / "in_the_way"))
    assert load_rig(face).names == ("happy", "sad")


def test_what_is_wrong_is_not_kept(face: Path, place: Path) -> None:
    written(face, "v 0 0 0\n", "sad.obj")
    with pytest.raises(MeshFileError):
        load_rig(face)
    assert not place.exists()


def test_small_sets_are_not_kept(face: Path, place: Path, monkeypatch) -> None:
    monkeypatch.setattr(cache, "_SMALL_BYTES", 1 << 20)
    load_rig(face)
    assert not place.exists()


def test_the_cache_stays_under_its_bound_and_the_oldest_goes(face: Path, place: Path, monkeypatch) -> None:
    load_rig(face)
    first = next(place.iterdir())
    os.utime(first, (1, 1))
    (place / ".facemorph-left").write_bytes(b"x")
    os.utime(place / ".facemorph-left", (1, 1))
    monkeypatch.setattr(cache, "_TOTAL_BYTES", first.stat().st_size * 3 // 2)
    load_rig([face / "neutral.obj", face / "sad.obj"])
    assert not first.exists()
    assert [path.suffix for path in place.iterdir()] == [".npz"]
