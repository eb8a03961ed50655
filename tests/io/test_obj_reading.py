"""OBJ files are read as written, in every form that the format allows."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.errors import FacemorphError, MeshFileError
from facemorph.io import obj_text
from facemorph.io.decimals import PAD, PaddedText, floats, integers
from facemorph.io.obj_read import parse_obj
from facemorph.io.read import read_mesh
from tests.io.texts import SQUARE, assert_says, odd_obj, written

HERE = Path("mesh.obj")


def read(text: str | bytes):
    return parse_obj(HERE, text.encode() if isinstance(text, str) else text).mesh


def test_tricky_files_of_other_projects_give_what_they_must(shared_data: Path) -> None:
    folder = shared_data / "obj"
    with (folder / "expected.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 30
    wrong = []
    for row in rows:
        try:
            mesh = read_mesh(folder / row["file"])
            got = [str(mesh.vertex_count), str(mesh.polygon_count), str(len(mesh.uvs))]
            allowed = row["result"] in ("ok", "either") and got == [
                row["V"],
                row["polygons"],
                row["uv_count"],
            ]
        except MeshFileError as error:
            got = [str(error)]
            allowed = row["result"] in ("error", "either") and row["file"] in str(error)
        if not allowed:
            wrong.append((row["file"], row["result"], got))
    assert not wrong


@pytest.mark.parametrize("seed", range(300))
def test_any_hand_is_read_exactly(seed: int) -> None:
    text, truth = odd_obj(seed)
    assert_says(read(text), truth)


@pytest.mark.parametrize("chunk", [1, 7, 64, 300])
@pytest.mark.parametrize("seed", range(20))
def test_where_the_text_is_cut_into_chunks_does_not_matter(monkeypatch, chunk: int, seed: int) -> None:
    monkeypatch.setattr(obj_text, "CHUNK_BYTES", chunk)
    text, truth = odd_obj(1000 + seed)
    assert_says(read(text), truth)


def _tokens(texts: list[str]) -> tuple[PaddedText, np.ndarray, np.ndarray]:
    joined = b" ".join(text.encode() for text in texts)
    starts = np.cumsum([0] + [len(text.encode()) + 1 for text in texts[:-1]]) + PAD
    ends = starts + [len(text.encode()) for text in texts]
    return PaddedText(b"\n" * PAD + joined + b"\n" * PAD), starts, ends


DECIMALS = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.floats(-1000, 1000).map("{:.6f}".format),
    st.floats(-10, 10).map("{:.15f}".format),
    st.floats(-1e6, 1e6).map("{:+.3e}".format),
    st.integers(-(10**20), 10**20).map(str),
    st.from_regex(r"\A[+-]?[0-9]{0,12}\.[0-9]{1,18}\Z"),
    st.from_regex(r"\A[+-]?[0-9]{1,18}\.\Z"),
)


@given(st.lists(DECIMALS, min_size=1, max_size=20))
def test_numbers_are_what_python_makes_of_them(texts: list[str]) -> None:
    values, bad = floats(*_tokens(texts))
    assert not len(bad)
    assert values.tobytes() == np.array([float(text) for text in texts]).tobytes()


@given(st.lists(st.floats(-1e4, 1e4), min_size=1, max_size=20), st.integers(1, 12))
def test_numbers_of_one_form_are_what_python_makes_of_them(numbers: list[float], decimals: int) -> None:
    texts = [f"{number:.{decimals}f}" for number in numbers]
    values, bad = floats(*_tokens(texts))
    assert not len(bad)
    assert values.tobytes() == np.array([float(text) for text in texts]).tobytes()


@given(st.lists(st.text("0123456789.+-eEnaif_x,/", min_size=1, max_size=12), min_size=1, max_size=12))
def test_what_is_no_number_is_found(texts: list[str]) -> None:
    def plain(text: str) -> bool:
        try:
            float(text)
        except ValueError:
            return False
        return set(text) <= set("0123456789.+-eE")

    _, bad = floats(*_tokens(texts))
    assert bad.tolist() == [i for i, text in enumerate(texts) if not plain(text)]


@given(
    st.lists(st.one_of(st.integers(-(10**17), 10**17).map(str), st.just("007"), st.just("+5")), min_size=1)
)
def test_indices_are_what_python_makes_of_them(texts: list[str]) -> None:
    values, bad = integers(*_tokens(texts))
    assert not len(bad)
    assert values.tolist() == [int(text) for text in texts]


def test_nothing_is_merged_and_quads_stay_quads() -> None:
    mesh = read(SQUARE + "v 0 0 0\nv 0 0 0\n")
    assert mesh.vertex_count == 6
    assert mesh.polygon_starts.tolist() == [0, 4]


def test_a_seam_keeps_one_vertex_with_two_texture_coordinates() -> None:
    mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt .5 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/4 3/3 2/2\n")
    assert mesh.vertex_count == 3
    assert mesh.corner_uvs is not None
    assert mesh.corner_uvs.tolist() == [0, 1, 2, 3, 2, 1]


def test_corners_without_uv_or_normal_have_none() -> None:
    mesh = read(SQUARE.replace("f", "vt 0 0\nvn 0 0 1\nf") + "f 1/1 2 3//1\nf 1/ 2// 3/1/1\n")
    assert mesh.corner_uvs is not None
    assert mesh.corner_uvs.tolist() == [-1] * 4 + [0, -1, -1, -1, -1, 0]
    assert mesh.corner_normals is not None
    assert mesh.corner_normals.tolist() == [-1] * 4 + [-1, -1, 0, -1, -1, 0]


def test_groups_objects_and_materials_hold_until_the_next() -> None:
    mesh = read(SQUARE + "o head\ng skin\nusemtl red\nf 1 2 3\ng\nf 1 2 3\nusemtl\no\ng skin\nf 1 2 3\n")
    assert mesh.groups is not None
    assert mesh.objects is not None
    assert mesh.materials_used is not None
    assert (mesh.groups.names, mesh.groups.index.tolist()) == (("skin",), [-1, 0, -1, 0])
    assert (mesh.objects.names, mesh.objects.index.tolist()) == (("head",), [-1, 0, 0, -1])
    assert (mesh.materials_used.names, mesh.materials_used.index.tolist()) == (("red",), [-1, 0, 0, -1])


def test_a_name_that_no_polygon_uses_is_left_out() -> None:
    mesh = read("g unused\n" + SQUARE.replace("f", "g used\nf") + "g last\n")
    assert mesh.groups is not None
    assert mesh.groups.names == ("used",)


def test_vertices_without_a_colour_among_coloured_ones_are_white() -> None:
    mesh = read("v 0 0 0 1 0 0.5\nv 1 0 0\nv 0 1 0 0 0.25 0 1\nf 1 2 3\n")
    assert mesh.colours is not None
    assert mesh.colours.tolist() == [[1, 0, 0.5], [1, 1, 1], [0, 0.25, 0]]


def test_colours_written_up_to_255_are_scaled() -> None:
    mesh = read("v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n")
    assert mesh.colours is not None
    np.testing.assert_allclose(mesh.colours[0], [1, 0, 0.2], atol=1e-6)


def test_a_weight_does_not_move_a_vertex() -> None:
    mesh = read("v 2 0 0 0.5\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n")
    assert mesh.colours is None
    assert mesh.positions[0].tolist() == [2, 0, 0]


def test_a_comment_with_a_path_does_not_swallow_the_next_line() -> None:
    assert read("# C:\\faces\\\nv 0 0 0\nv 1 0 0 # \\\nv 0 1 0\nf 1 2 3\n").vertex_count == 3


REFUSED = [
    ("v 0 0 0\nv 1 0\n", 2, "v x y z"),
    ("v 0 0 0\nv 1 0 0 0 0\n", 2, "5 numbers"),
    ("v 0 0 0\n\nv 1 0 1,5\n", 3, "point"),
    ("v 0 0 1_0\n", 1, "no number"),
    ("v 0 0 1e39\n", 1, "larger"),
    ("v 0 0 -1.#IND\n", 1, "finite"),
    ("v 0 0 Infinity\n", 1, "finite"),
    ("vt 0 0 0 0\n" + SQUARE, 1, "vt u v"),
    ("vn 0 0\n" + SQUARE, 1, "vn x y z"),
    (SQUARE + "f 1 2\n", 6, "at least 3"),
    (SQUARE + "f\n", 6, "at least 3"),
    (SQUARE + "f 1 2 # 3\n", 6, "at least 3"),
    (SQUARE + "f 1 2 0\n", 6, "begin at 1"),
    (SQUARE + "f 1 2 5\n", 6, "the file has 4"),
    (SQUARE + "f 1/1 2/1 3/1\n", 6, "the file has none"),
    (SQUARE + "f 1 2 -5\n", 6, "counts back"),
    (SQUARE + "f 1 2 3.0\n", 6, "no corner"),
    (SQUARE + "f 1 2 /3\n", 6, "no corner"),
    (SQUARE + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", 8, "no corner"),
    (SQUARE + "f 1 2 99999999999999999999999\n", 6, "the file has 4"),
    (SQUARE + "f 1 2 3 \\\n 9\n", 7, "names vertex 9"),
    (SQUARE + "g " + "x" * 3000 + "\nf 1 2 3\n", 6, "names"),
]


@pytest.mark.parametrize(
    ("text", "line", "words"), REFUSED, ids=[case[2] + f" {i}" for i, case in enumerate(REFUSED)]
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_what_is_wrong_is_told_with_its_line(
    tmp_path: Path, text: str, line: int, words: str, end: str
) -> None:
    path = written(tmp_path, text.replace("\n", end))
    with pytest.raises(MeshFileError) as refused:
        read_mesh(path)
    assert refused.value.line == line
    assert words in str(refused.value)
    assert str(path) in str(refused.value)
    assert "\n" not in str(refused.value)


def test_of_several_wrong_lines_the_first_is_told() -> None:
    with pytest.raises(MeshFileError) as refused:
        read("v 0 0 0\nf 1 0 1\nv 1 one 0\nvt x\n")
    assert refused.value.line == 2


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no vertices"),
        (b"# nothing\n\n", "no vertices"),
        (b"v 0 0 0\n", "no faces"),
        (b"\x89PNG\r\n\x1a\n\0\0", "text"),
        ("v 0 0 0".encode("utf-16"), "UTF-8"),
    ],
)
def test_files_without_a_mesh_are_refused(tmp_path: Path, content: bytes, words: str) -> None:
    with pytest.raises(MeshFileError, match=words):
        read_mesh(written(tmp_path, content))


def test_what_is_no_readable_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "folder.obj").mkdir()
    for name, words in (
        ("folder.obj", "folder"),
        ("gone.obj", "not exist"),
        ("a.xyz", "not read"),
        ("a\0.obj", "a"),
    ):
        with pytest.raises(FacemorphError, match=words):
            read_mesh(tmp_path / name)
