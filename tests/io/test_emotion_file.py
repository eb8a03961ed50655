"""Files of paths over the emotion map: what was written is read again, and anything else is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from facemorph.core.emotion import PAPER_POLES, Pole
from facemorph.core.emotion_path import EmotionPath
from facemorph.errors import ControlsFileError, OutputError
from facemorph.io.emotion_file import FORMAT, read_emotion_path, write_emotion_path

PATH = EmotionPath(((0.0, 0.0, 0.0), (0.25, 0.125, -0.5), (2.5, -1.0, 0.75)))


def content(**changed: Any) -> dict[str, Any]:
    poles = [{"name": pole.name, "angle_deg": pole.angle_deg} for pole in PAPER_POLES]
    return {"format": FORMAT, "poles": poles, "samples": [[0, 0, 0], [1, 0.5, 0.5]], **changed}


def test_what_is_kept_is_read_again(tmp_path: Path) -> None:
    poles = (Pole("glücklich", 90.0), Pole("b", 330.5), Pole("c", 210.0))
    write_emotion_path(tmp_path / "a.json", PATH, poles)
    assert read_emotion_path(tmp_path / "a.json") == (PATH, poles)


def test_writing_replaces_the_whole_file_or_nothing(tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    file.write_text("before")
    write_emotion_path(file, PATH, PAPER_POLES)
    assert read_emotion_path(file)[0] == PATH
    assert list(tmp_path.iterdir()) == [file]
    with pytest.raises(OutputError):
        write_emotion_path(tmp_path, PATH, PAPER_POLES)


def test_a_file_that_is_well_is_read(tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    file.write_text(json.dumps(content()))
    assert read_emotion_path(file) == (EmotionPath(((0.0, 0.0, 0.0), (1.0, 0.5, 0.5))), PAPER_POLES)


POLE = {"name": "happy", "angle_deg": 90.0}


@pytest.mark.parametrize(
    "text",
    [
        "", "no json", "[]", "null", "{}", '"facemorph emotion path 1"', "[" * 100_000,
        json.dumps(content(format="facemorph emotion path 2")),
        json.dumps(content(poles=None)),
        json.dumps(content(poles=[])),
        json.dumps(content(poles=[POLE, POLE, POLE])),
        json.dumps(content(poles=[POLE] * 400)),
        json.dumps(content(poles=[1, 2, 3])),
        json.dumps(content(poles=[{"name": "", "angle_deg": 0}, POLE, POLE])),
        json.dumps(content(poles=[{"name": "x" * 5000, "angle_deg": 0}, POLE, POLE])),
        json.dumps(content(poles=[{"name": "a", "angle_deg": "0"}, POLE, POLE])),
        json.dumps(content(poles=[{"name": "a", "angle_deg": True}, POLE, POLE])),
        json.dumps(content(poles=[{"name": "a", "angle_deg": 10**400}, POLE, POLE])),
        json.dumps(content(samples=None)),
        json.dumps(content(samples=[])),
        json.dumps(content(samples=[[0, 0, 0]])),
        json.dumps(content(samples=[[0, 0, 0], [1, 0]])),
        json.dumps(content(samples=[[0, 0, 0], [1, 0, "0"]])),
        json.dumps(content(samples=[[0, 0, 0], [1, 0, None]])),
        json.dumps(content(samples=[[0, 0, 0], [1, 0, 10**400]])),
        json.dumps(content(samples=[[0, 0, 0], [1, float("nan"), 0]])),
        json.dumps(content(samples=[[0, 0, 0], [float("inf"), 0, 0]])),
        json.dumps(content(samples=[[0, 0, 0], [1, 2, 0]])),
        json.dumps(content(samples=[[0, 0, 0], [100, 0, 0]])),
        json.dumps(content(samples=[[0, 0, 0], [2, 0, 0], [1, 0, 0]])),
        json.dumps(content(samples=[[0, 0, 0]] * 20_001)),
    ],
)  # fmt: skip
def test_what_is_no_path_is_refused_in_one_line_that_names_the_file(tmp_path: Path, text: str) -> None:
    file = tmp_path / "bad.json"
    file.write_text(text)
    with pytest.raises(ControlsFileError) as caught:
        read_emotion_path(file)
    assert "bad.json" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 600


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "missing.json"):
        with pytest.raises(ControlsFileError, match="recorded path"):
            read_emotion_path(path)


def test_a_file_too_large_is_not_read(tmp_path: Path) -> None:
    file = tmp_path / "large.json"
    with file.open("wb") as handle:
        handle.truncate(64 << 20)
    with pytest.raises(ControlsFileError, match="4 MB"):
        read_emotion_path(file)
