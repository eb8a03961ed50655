"""Pairs of landmarks kept in a table come back as they were; a table that is none is refused by line."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facemorph.core.landmark_pair import MOST_PAIRS, LandmarkPair
from facemorph.core.rig import FaceInfo, Landmark, Rig
from facemorph.errors import ControlsFileError, OutputError
from facemorph.io import read_pairs, write_pairs
from tests.conftest import bumpy_grid

MARKS = (Landmark("nose tip", 12, ibug=30), Landmark("chin", 40))


@pytest.fixture
def rig() -> Rig:
    return Rig.from_arrays(bumpy_grid(), {}, FaceInfo("sheet", landmarks=MARKS))


def read(rig: Rig, path: Path, text: str | bytes) -> tuple[LandmarkPair, ...]:
    path = path / "pairs.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_pairs(path, rig, bumpy_grid(5, 5))


numbers = st.floats(-1e12, 1e12)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50)
@given(
    rows=st.dictionaries(
        st.integers(0, 98), st.tuples(st.tuples(numbers, numbers, numbers), st.text(max_size=12)), min_size=1
    )
)
def test_what_is_written_is_read_to_the_last_digit(rig: Rig, tmp_path: Path, rows: dict):
    pairs = tuple(LandmarkPair(vertex, point, name) for vertex, (point, name) in rows.items())
    write_pairs(tmp_path / "some.csv", pairs)
    again = read_pairs(tmp_path / "some.csv", rig, bumpy_grid(5, 5))
    assert [(pair.vertex, pair.point) for pair in again] == [(pair.vertex, pair.point) for pair in pairs]
    plain = [pair.name for pair in pairs]
    assert all(new.name == old for new, old in zip(again, plain, strict=True) if old.isalnum())
    assert [path.name for path in tmp_path.iterdir()] == ["some.csv"]


def test_either_side_may_be_given_in_each_of_its_ways(rig: Rig, tmp_path: Path):
    scan = bumpy_grid(5, 5).positions
    place = tuple(float(value) for value in scan[7])
    expected = [(12, place), (40, place)]
    by_vertex = read(rig, tmp_path, "template,scan\n12,7\n40,7\n")
    by_name = read(rig, tmp_path, "scan,name,template\n7,a,nose tip\n\n7,,chin\n")
    by_place = read(
        rig, tmp_path, "\ufeffTemplate, X, Y, Z\r\nibug 30,{0},{1},{2}\r\n40,{0},{1},{2}\r\n".format(*place)
    )
    for pairs in (by_vertex, by_name, by_place):
        assert [(pair.vertex, pair.point) for pair in pairs] == expected
    assert [pair.name for pair in by_name] == ["a", "chin"]
    assert [pair.name for pair in by_place] == ["ibug 30", ""]
    assert [pair.name for pair in by_vertex] == ["", ""]


def test_a_mesh_without_landmarks_takes_vertices_alone(tmp_path: Path):
    path = tmp_path / "pairs.csv"
    path.write_text("template,scan\n3,4\n")
    assert read_pairs(path, bumpy_grid(), bumpy_grid(5, 5))[0].vertex == 3
    path.write_text("template,scan\nchin,4\n")
    with pytest.raises(
        ControlsFileError, match=r"pairs\.csv:2: the template has no landmark called 'chin'; a"
    ):
        read_pairs(path, bumpy_grid(), bumpy_grid(5, 5))


WRONG = [
    ("", r"pairs\.csv is empty"),
    ("\n\n", "is empty"),
    ("template,scan\n", "holds no pairs"),
    ("1,2\n3,4\n", r":1: these columns cannot be read: 1,2\. The first line names"),
    ("template;scan\n1;2\n", ":1: these columns"),
    ("template\n1\n", ":1: these columns"),
    ("template,x,y\n1,2,3\n", ":1: these columns"),
    ("template,template,scan\n1,2,3\n", ":1: these columns"),
    ("template,scan,x,y,z\n1,2,3,4,5\n", ":1: these columns"),
    ("template,scan\n1,2\n3\n", ":3: 2 values were expected, as in line 1, not 1"),
    ("template,scan\n1,2\n\n99,2\n", r":4: `template` must be a vertex from 0 to 98, not '99'"),
    ("template,scan\n1,25\n", r":2: `scan` must be a vertex from 0 to 24, not '25'"),
    ("template,scan\n1,-1\n", "not '-1'"),
    ("template,scan\n1,1.0\n", "not '1.0'"),
    ("template,scan\n1,²\n", "not '²'"),
    ("template,scan\n1," + "9" * 900 + "\n", "from 0 to 24"),
    ("template,scan\n-1,1\n", "no landmark called '-1' among its 2"),
    ("template,scan\nNose,1\n", ":2: the template has no landmark called 'Nose' among its 2; a vertex"),
    ("template,scan\nibug 31,1\n", "no landmark called 'ibug 31'"),
    ("template,scan\n1,1\n1,2\n", ":3: vertex 1 of the template stands in line 2 already"),
    ("template,scan\n12,1\nnose tip,2\n", ":3: vertex 12 of the template stands in line 2"),
    ("template,x,y,z\n1,0,nan,0\n", ":2: `y` must be a number, not 'nan'"),
    ("template,x,y,z\n1,0,0,1e300\n", "`z` must be a number"),
    ("template,x,y,z\n1,1_0,0,0\n", "`x` must be a number, not '1_0'"),
    ("template,x,y,z\n1,,0,0\n", "`x` must be a number, not ''"),
    ('template,scan\n"1,2\n3,4\n', "is no line of a table"),
    ("name,template,scan\n" + "n" * 2000 + ",1,2\n", ":2: a value is too long"),
    ("name,template,scan\n\x1b[2J,1,2\n", "cannot be printed"),
    (b"\xff\xfet\x00e\x00", "not text in UTF-8"),
    (b"PK\x03\x04\x00\x00\xff", "not text in UTF-8"),
    ("template,scan\n" + "1,2\n" * 300_000, "pairs.csv is larger than 1 MB, .* pairs of landmarks take less"),
]


@pytest.mark.parametrize(("text", "words"), WRONG, ids=range(len(WRONG)))
def test_wrong_contents_are_refused_with_the_line(rig: Rig, tmp_path: Path, text: str | bytes, words: str):
    with pytest.raises(ControlsFileError, match=words) as refused:
        read(rig, tmp_path, text)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 400 + len(str(tmp_path))


def test_more_pairs_than_anybody_needs_are_refused(tmp_path: Path):
    big = bumpy_grid(50, 50)
    path = tmp_path / "pairs.csv"
    path.write_text("template,scan\n" + "".join(f"{i},{i}\n" for i in range(MOST_PAIRS + 1)))
    with pytest.raises(ControlsFileError, match=f":{MOST_PAIRS + 2}: at most 2,000 pairs"):
        read_pairs(path, big, big)


def test_what_is_no_file_is_refused_without_waiting_for_it(rig: Rig, tmp_path: Path):
    for name in ("missing.csv", "."):
        with pytest.raises(ControlsFileError, match="a table of landmark pairs"):
            read_pairs(tmp_path / name, rig, bumpy_grid())
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.csv")
        with pytest.raises(ControlsFileError, match="is no file"):
            read_pairs(tmp_path / "pipe.csv", rig, bumpy_grid())


def test_a_table_that_cannot_be_written_leaves_the_old_one(tmp_path: Path):
    path = tmp_path / "some.csv"
    write_pairs(path, [LandmarkPair(1, (0.0, 1.0, 2.0), "a")])
    before = path.read_bytes()
    with pytest.raises(TypeError):
        write_pairs(path, [LandmarkPair(1, (0.0, None, 2.0))])  # type: ignore[arg-type]
    assert path.read_bytes() == before
    with pytest.raises(OutputError):
        write_pairs(tmp_path, [LandmarkPair(1, (0.0, 1.0, 2.0))])
    assert np.array_equal([p.name for p in tmp_path.iterdir()], ["some.csv"])
