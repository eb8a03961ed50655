"""A face is loaded from whatever names it, and refused with a reason where it is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.errors import (
    CorrespondenceError,
    FaceFolderError,
    FacemorphError,
    JobCancelledError,
    MeshFileError,
    UnknownNameError,
    UnsupportedFormatError,
)
from facemorph.io import load_rig, read_face_info, write_obj
from facemorph.io import obj_read as obj_read_module
from facemorph.resources import builtin_faces
from tests.conftest import bumpy_grid
from tests.io.texts import SQUARE, written


def moved(text: str = SQUARE) -> str:
    """The square with its first vertex lifted by 1."""
    return text.replace("v 0 0 0", "v 0 0 1", 1)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a neutral and some shapes."""
    written(tmp_path, SQUARE, "neutral.obj")
    for name in ("AU12.obj", "AU2.obj", "sad.obj", "Happy.obj", "zebra.OBJ"):
        written(tmp_path, moved(), name)
    written(tmp_path, "not a mesh", "notes.txt")
    written(tmp_path, "broken", "._happy.obj")
    (tmp_path / "sub.obj").mkdir()
    return tmp_path


def test_a_plain_folder_is_a_neutral_and_shapes_in_a_sensible_order(folder: Path) -> None:
    rig = load_rig(folder)
    assert rig.names == ("Happy", "sad", "AU2", "AU12", "zebra")
    assert rig.info.name == folder.name
    assert rig.deltas[:, 0].tolist() == [[0, 0, 1]] * 5
    assert not rig.deltas[:, 1:].any()


def test_files_may_be_named_with_the_neutral_anywhere_or_first(folder: Path) -> None:
    by_name = load_rig([folder / "Happy.obj", folder / "neutral.obj", str(folder / "sad.obj")])
    assert by_name.names == ("Happy", "sad")
    first = load_rig([folder / "sad.obj", folder / "Happy.obj"])
    assert first.names == ("Happy",)
    assert first.neutral.positions[0].tolist() == [0, 0, 1]


def test_one_mesh_is_a_face_without_shapes(folder: Path) -> None:
    for source in (folder / "sad.obj", [str(folder / "sad.obj")]):
        rig = load_rig(source)
        assert rig.names == ()
        assert rig.deltas.shape == (0, 4, 3)
        assert rig.info.name == "sad"


def test_the_neutral_may_have_its_word_in_a_longer_name(tmp_path: Path) -> None:
    for name in ("ada_neutral.obj", "ada_happy.obj", "neutralised.obj"):
        written(tmp_path, SQUARE, name)
    assert load_rig(tmp_path).names == ("ada_happy", "neutralised")


def same_rig(a: Rig, b: Rig) -> bool:
    """Whether two rigs move alike."""
    return a.names == b.names and a.deltas.tobytes() == b.deltas.tobytes()


UNLIKE_FACES = [
    ("f 1 2 3 4\n", "f 1 2 3 4\n"),
    ("f 1 2 3 4\n", "f 2 3 4 1\n"),
    ("f -4 -3 -2 -1\n", "f 1 2 3 4\n"),
    ("g a\nf 1 2 3\nf 1 3 4\n", "# other hand\nf 3 4 1\n\nf 1 2 3\n"),
    ("vt 0 0\nf 1/1 2/1 3/1 4/1\n", "f 1 2 3 4\n"),
]


@pytest.mark.parametrize(("mine", "theirs"), UNLIKE_FACES)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_polygons_may_be_written_in_another_way(tmp_path: Path, mine: str, theirs: str, end: str) -> None:
    vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    written(tmp_path, vertices + mine, "neutral.obj")
    written(tmp_path, (moved(vertices) + theirs).replace("\n", end), "up.obj")
    assert load_rig(tmp_path).deltas[0].tolist() == [[0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]]


@pytest.mark.parametrize("chunk", [1 << 18, 40, 20, 16, 1])
@pytest.mark.parametrize(
    "text",
    [
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\n",
        "# C:\\faces\\a.max\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\n",
        "v 0 0 1\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 2\r\nf 1 2 3 4\n",
        "\ufeffv 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\n\ufeffv 8 8 8\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 \\\n0\nv 0 1 2\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\n# on \\\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 2\nvt 0 0\nvt 0 1\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 2\x00\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\n\\\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nf 1 2 3\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 x\nf 1 2 3 4\n",
        "v 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0 \\\nf 1 2 3 4\n",
        "vn 0 0\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 1 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "f 1 2 3\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
    ],
)
def test_skipping_equal_faces_does_not_change_what_is_read(
    tmp_path: Path, monkeypatch, text: str, chunk: int
) -> None:
    monkeypatch.setattr("facemorph.io.face_set.CHUNK_BYTES", chunk)
    written(tmp_path, SQUARE, "neutral.obj")
    # The second is read by the faces of the first, where they are not the neutral's own.
    written(tmp_path, text, "a.obj")
    written(tmp_path, text, "b.obj")

    def outcome() -> list[list[list[float]]] | type[Exception]:
        try:
            return load_rig(tmp_path, cache=False).deltas.tolist()
        except FacemorphError as error:
            return type(error)

    quick = outcome()
    monkeypatch.setattr("facemorph.io.face_set.parse_positions", lambda path, data: None)
    whole = outcome()
    # Normals of a shape are of no use to it, so a fault in them is not seen when they are skipped.
    assert quick == whole or (text.startswith("vn") and isinstance(quick, list))


def test_equal_faces_are_not_parsed_again(folder: Path, monkeypatch) -> None:
    parsed = []
    whole = obj_read_module.parse_obj

    def counting(path: Path, data: bytes):
        parsed.append(path.name)
        return whole(path, data)

    monkeypatch.setattr("facemorph.io.face_set.parse_obj", counting)
    load_rig(folder, cache=False)
    assert parsed == ["neutral.obj"]


def test_faces_as_another_shape_writes_them_are_not_parsed_again(tmp_path: Path, monkeypatch) -> None:
    textured = SQUARE.replace("\nf 1 2 3 4", "\nvt 0 0\nf 1/1 2/1 3/1 4/1", 1)
    assert textured != SQUARE
    for name, text in (("neutral.obj", textured), ("a.obj", moved()), ("b.obj", moved()), ("c.obj", moved())):
        written(tmp_path, text, name)
    parsed = []
    whole = obj_read_module.parse_obj
    monkeypatch.setattr(
        "facemorph.io.face_set.parse_obj", lambda path, data: (parsed.append(path.name), whole(path, data))[1]
    )
    rig = load_rig(tmp_path, cache=False)
    assert parsed == ["neutral.obj", "a.obj"]
    assert rig.deltas[:, 0].tolist() == [[0, 0, 1]] * 3


def bad(tmp_path: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        written(tmp_path, text, name)
    return tmp_path


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({}, "holds no mesh"),
        ({"readme.txt": "x"}, "holds no mesh"),
        ({"a.obj": SQUARE, "b.obj": SQUARE}, "none is called neutral"),
        ({"neutral.obj": SQUARE, "neutral.ply": "x"}, "one neutral is needed"),
        ({"my_neutral.obj": SQUARE, "neutral_2.obj": SQUARE}, "one neutral is needed"),
        ({"neutral.obj": SQUARE, "a.obj": SQUARE, "A.stl": "x"}, "Rename one"),
        ({"happy.obj": SQUARE}, "called as an expression"),
        ({"ada_Sad.obj": SQUARE}, "called as an expression"),
    ],
)
def test_folders_that_are_no_face_are_refused_with_the_reason(tmp_path: Path, files, words: str) -> None:
    with pytest.raises(FaceFolderError, match=words):
        load_rig(bad(tmp_path, files))


def test_sources_that_are_nothing_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnknownNameError, match="no built-in face"):
        load_rig("nobody")
    with pytest.raises(FaceFolderError, match="does not exist"):
        load_rig(tmp_path / "gone")
    with pytest.raises(FaceFolderError, match="no file"):
        load_rig([])
    with pytest.raises(FaceFolderError, match="each must be a mesh"):
        load_rig([tmp_path, tmp_path])
    with pytest.raises(UnsupportedFormatError, match=r"\.txt"):
        load_rig(written(tmp_path, "x", "a.txt"))
    with pytest.raises(FacemorphError):
        load_rig("a\0b")


def test_a_bad_shape_is_told_with_its_line(folder: Path) -> None:
    written(folder, SQUARE.replace("v 1 1 0", "v 1 one 0"), "sad.obj")
    with pytest.raises(MeshFileError) as refused:
        load_rig(folder)
    assert (refused.value.path.name, refused.value.line) == ("sad.obj", 3)


@pytest.mark.parametrize(
    ("text", "cause", "words"),
    [
        ("v 9 9 9\n" + SQUARE, "vertices", "5 vertices, the neutral 4"),
        (SQUARE.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4"), "polygons", "2 polygons, the neutral 1"),
        (SQUARE.replace("f 1 2 3 4", "f 1 4 3 2"), "polygons", "turned over"),
    ],
)
def test_shapes_that_do_not_correspond_are_refused_with_the_cause(
    folder, text: str, cause: str, words: str
) -> None:
    written(folder, text, "sad.obj")
    with pytest.raises(CorrespondenceError) as refused:
        load_rig(folder)
    assert refused.value.cause == cause
    assert words in str(refused.value)
    assert "sad.obj" in str(refused.value)


def test_progress_is_told_and_can_stop_the_load(folder: Path) -> None:
    told: list[float] = []
    load_rig(folder, progress=lambda fraction, doing: told.append(fraction))
    assert told == sorted(told)
    assert 0.0 <= told[0] <= told[-1] <= 1.0
    assert len(told) >= 5

    def stop(fraction: float, doing: str) -> None:
        raise JobCancelledError("stopped")

    stopping: Progress = stop
    with pytest.raises(JobCancelledError):
        load_rig(folder, progress=stopping)


TOML = """
name = "Test"
description = "A square."
licence = "CC0-1.0"
unit = "cm"
[[expressions]]
name = "up"
label = "Upwards"
file = "moved.obj"
[[landmarks]]
name = "corner"
vertex = 3
mpeg4 = "8.3"
ibug = 48
"""


def described(folder: Path, toml: str = TOML) -> Path:
    written(folder, SQUARE, "neutral.obj")
    written(folder, moved(), "moved.obj")
    written(folder, toml, "face.toml")
    return folder


def npz(vertices: int = 4, **changes: object) -> dict[str, object]:
    """The arrays of a shapes.npz with two shapes."""
    return {
        "format": np.int32(1),
        "vertices": np.int32(vertices),
        "names": np.array(["AU1", "jawOpen"]),
        "labels": np.array(["Brow", "Jaw"]),
        "sets": np.array(["facs", "arkit"]),
        "starts": np.array([0, 1, 3], np.int32),
        "index": np.array([2, 0, 3], np.uint16),
        "delta": np.array([[0, 100, 0], [1, 2, 3], [-1, 0, 0]], np.int16),
        "scale": np.array([0.01, 0.5], np.float32),
        "region_names": np.array(["brows"]),
        "region_weights": np.array([[255, 0, 7, 1]], np.uint8),
        **changes,
    }


def test_a_face_folder_is_loaded_as_it_describes_itself(tmp_path: Path) -> None:
    described(tmp_path, 'shapes = "shapes.npz"\n' + TOML)
    np.savez_compressed(tmp_path / "shapes.npz", **npz())
    rig = load_rig(tmp_path)
    assert [(s.name, s.label, s.set) for s in rig.shapes] == [
        ("up", "Upwards", "expression"), ("AU1", "Brow", "facs"), ("jawOpen", "Jaw", "arkit")
    ]  # fmt: skip
    assert rig.deltas[1].tolist() == [[0, 0, 0], [0, 0, 0], [0, 1, 0], [0, 0, 0]]
    assert rig.deltas[2].tolist() == [[0.5, 1, 1.5], [0, 0, 0], [0, 0, 0], [-0.5, 0, 0]]
    assert (rig.info.name, rig.info.unit, rig.info.licence) == ("Test", "cm", "CC0-1.0")
    landmark = rig.info.landmarks[0]
    assert (landmark.name, landmark.vertex, landmark.mpeg4, landmark.ibug) == ("corner", 3, "8.3", 48)
    assert rig.regions is not None
    assert rig.regions.weights.tolist() == [[255, 0, 7, 1]]
    assert read_face_info(tmp_path) == rig.info


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("moved.obj", "gone.obj"), "no file in the folder"),
        (("moved.obj", "../neutral.obj"), "no file in the folder"),
        (("vertex = 3", "vertex = 4"), "is vertex 4, .* from 0 here, the last being 3"),
        (("vertex = 3", "vertex = -1"), "vertex -1"),
        (("vertex = 3", "vertex = true"), "whole number"),
        (("vertex = 3", "vertex = 'a'"), "whole number"),
        (('"cm"', '"furlong"'), "mm, cm, m, in, not 'furlong'"),
        (('name = "Test"', "name = 5"), "must be a text"),
        (('name = "up"', ""), "name is missing"),
        (
            ("[[expressions]]", "[[expressions]]\nname = 'up'\nfile = 'moved.obj'\n[[expressions]]"),
            "name of its own",
        ),
        (("[[expressions]]", "expressions = 3\n[[x]]"), "array of tables"),
        (("unit", "unit = = "), "not TOML"),
        (("unit", "x = " + "[" * 5000), "not TOML"),
        (('"A square."', '"' + "x" * 10_000 + '"'), "longer than"),
        (("unit", "#" + "x" * 2_000_000), "larger than"),
    ],
)
def test_a_wrong_description_is_refused_with_the_reason(
    tmp_path: Path, change: tuple[str, str], words: str
) -> None:
    described(tmp_path, TOML.replace(*change, 1))
    with pytest.raises(FaceFolderError, match=words) as refused:
        load_rig(tmp_path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"format": np.int32(2)}, "format 2"),
        ({"vertices": np.int32(5)}, "5 vertices"),
        ({"index": np.array([2, 0, 4])}, "outside"),
        ({"index": np.array([2, 0, -1])}, "outside"),
        ({"starts": np.array([0, 3, 2])}, "starts"),
        ({"starts": np.array([0, 1])}, "starts"),
        ({"delta": np.zeros((3, 3))}, "delta"),
        ({"delta": np.zeros((3, 3), np.int64)}, "int16"),
        ({"scale": np.array([np.nan, 1], np.float32)}, "finite"),
        ({"names": np.array(["AU1", "AU1"])}, "AU1"),
        ({"names": np.array(["AU1", "up"])}, "up"),
        ({"labels": np.array(["one"])}, "1 labels"),
        ({"names": np.array([{}, {}], object)}, "names"),
        ({"region_weights": np.full((1, 4), 3.0)}, "region_weights"),
        ({"region_names": np.array(["a", "b"]), "region_weights": np.full((2, 4), 200, np.uint8)}, "255"),
    ],
)
def test_wrong_shapes_are_refused_with_the_reason(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    described(tmp_path, 'shapes = "shapes.npz"\n' + TOML)
    np.savez(tmp_path / "shapes.npz", **npz(**changes))
    with pytest.raises(FaceFolderError, match=words):
        load_rig(tmp_path)


def test_a_file_of_shapes_that_claims_more_than_it_holds_is_refused_without_unpacking(tmp_path: Path) -> None:
    described(tmp_path, 'shapes = "shapes.npz"\n' + TOML)
    bomb = np.broadcast_to(np.int16(0), (200_000_000, 3))
    header = tmp_path / "delta.npy"
    with header.open("wb") as file:
        np.lib.format.write_array_header_1_0(
            file, {"descr": "<i2", "fortran_order": False, "shape": bomb.shape}
        )
    import zipfile

    arrays = {name: value for name, value in npz().items() if name != "delta"}
    np.savez(tmp_path / "shapes.npz", **arrays)
    with zipfile.ZipFile(tmp_path / "shapes.npz", "a", zipfile.ZIP_DEFLATED) as archive:
        archive.write(header, "delta.npy")
    with pytest.raises(FaceFolderError, match="claims"):
        load_rig(tmp_path)


@pytest.mark.parametrize("cut", [0, 10, 200, 900])
def test_a_cut_file_of_shapes_is_refused(tmp_path: Path, cut: int) -> None:
    described(tmp_path, 'shapes = "shapes.npz"\n' + TOML)
    np.savez(tmp_path / "shapes.npz", **npz())
    data = (tmp_path / "shapes.npz").read_bytes()
    (tmp_path / "shapes.npz").write_bytes(data[:cut])
    with pytest.raises(FaceFolderError):
        load_rig(tmp_path)


@pytest.mark.parametrize("name", sorted(builtin_faces()))
def test_built_in_faces_load_by_name(name: str) -> None:
    rig = load_rig(name)
    assert rig.names[:6] == ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
    assert rig.info.unit == "cm"


def test_a_set_of_another_format_loads(tmp_path: Path) -> None:
    import trimesh

    grid: Mesh = bumpy_grid()
    rig = Rig.from_arrays(grid, {"up": grid.positions + np.float32(0.5)})
    for suffix in ("ply", "off"):
        folder = tmp_path / suffix
        folder.mkdir()
        for name, positions in (("neutral", grid.positions), ("up", rig.positions({"up": 1.0}))):
            trimesh.Trimesh(positions, rig.triangles, process=False).export(folder / f"{name}.{suffix}")
        loaded = load_rig(folder)
        np.testing.assert_allclose(loaded.deltas, rig.deltas, atol=1e-6)
        assert loaded.neutral.corner_vertices.tolist() == rig.triangles.ravel().tolist()
    write_obj(tmp_path / "x.obj", grid)
    with pytest.raises(CorrespondenceError):
        load_rig([tmp_path / "x.obj", tmp_path / "ply" / "up.ply"])


@pytest.mark.parametrize(
    "entries", ["", "expressions = []\n", "[[expresions]]\nname = 'up'\nfile = 'up.obj'\n"]
)
def test_a_description_without_expressions_takes_the_folders_meshes(tmp_path: Path, entries: str) -> None:
    bad(tmp_path, {"neutral.obj": SQUARE, "AU12.obj": moved(), "AU2.obj": moved(), "happy.obj": moved()})
    written(tmp_path, f"name = 'Test'\nunit = 'MM'\n{entries}", "face.toml")
    rig = load_rig(tmp_path)
    assert rig.names == ("happy", "AU2", "AU12")
    assert (rig.info.name, rig.info.unit, rig.shapes[0].label) == ("Test", "mm", "Happy")


def test_a_description_may_name_the_neutral_and_nothing_else(tmp_path: Path) -> None:
    bad(tmp_path, {"base.obj": SQUARE, "up.obj": moved()})
    written(tmp_path, "neutral = './base.obj'\n", "face.toml")
    assert load_rig(tmp_path).names == ("up",)
    written(tmp_path, "name = 'x'\n", "face.toml")
    with pytest.raises(FaceFolderError, match="none is called neutral"):
        load_rig(tmp_path)
    (tmp_path / "base.obj").rename(tmp_path / "my_neutral.obj")
    assert load_rig(tmp_path).names == ("up",)


def test_expressions_that_are_there_are_all_there_is(tmp_path: Path) -> None:
    described(tmp_path)
    written(tmp_path, moved(), "other.obj")
    assert load_rig(tmp_path).names == ("up",)


def test_a_lone_mesh_of_no_telling_name_is_a_face(tmp_path: Path) -> None:
    assert load_rig(bad(tmp_path, {"unhappy_head.obj": SQUARE})).names == ()
    assert load_rig(written(tmp_path, SQUARE, "happy.obj")).info.name == "happy"


def test_several_words_are_files_and_a_built_in_face_among_them_is_told(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    name = next(iter(builtin_faces()), None)
    if name is None:
        pytest.skip("the built-in faces are not there")
    for source in ([name, name], [str(written(tmp_path, SQUARE)), name]):
        with pytest.raises(
            FaceFolderError, match=f"{name} is a built-in face, and several words mean mesh files"
        ):
            load_rig(source)


def test_a_refusal_for_its_order_says_what_to_type_even_for_a_folder_with_blanks(tmp_path: Path) -> None:
    folder = tmp_path / "my face"
    folder.mkdir()
    written(folder, "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 3 0\nf 1 2 3 4\nf 4 3 5\n", "neutral.obj")
    written(folder, "v 1 3 1\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 2 3 4 5\nf 5 4 1\n", "up.obj")
    with pytest.raises(CorrespondenceError, match=f"facemorph check '{folder}' --repair OUT"):
        load_rig(folder)
