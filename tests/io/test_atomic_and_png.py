"""Files appear whole or not at all; pictures come back as they were."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.errors import OutputError
from facemorph.io import write_png
from facemorph.io.atomic import replacing, write_bytes


def test_a_broken_off_write_changes_nothing(tmp_path: Path) -> None:
    goal = tmp_path / "a.txt"
    goal.write_text("old")
    with pytest.raises(UnicodeEncodeError), replacing(goal) as temporary:
        temporary.write_text("half" + chr(0xD800), encoding="utf-8")
    assert goal.read_text() == "old"
    assert list(tmp_path.iterdir()) == [goal]


def test_a_link_is_followed_and_stays(tmp_path: Path) -> None:
    real = tmp_path / "real.txt"
    real.write_text("old")
    link = tmp_path / "link.txt"
    link.symlink_to(real)
    write_bytes(link, b"n", b"ew")
    assert link.is_symlink()
    assert real.read_text() == "new"


@pytest.mark.skipif(os.name == "nt", reason="modes are POSIX")
def test_a_new_file_can_be_read_by_others_as_usual(tmp_path: Path) -> None:
    (tmp_path / "usual").write_text("")
    write_bytes(tmp_path / "new", b"")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "usual").stat().st_mode


@pytest.mark.parametrize("channels", [3, 4])
def test_a_picture_comes_back_as_it_was(tmp_path: Path, channels: int) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (7, 5, channels), np.uint8)
    write_png(tmp_path / "deep" / "a.png", pixels)
    assert np.array_equal(np.asarray(Image.open(tmp_path / "deep" / "a.png")), pixels)


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    for pixels in (
        np.zeros((2, 2), np.uint8),
        np.zeros((2, 2, 4), np.float32),
        np.zeros((0, 2, 4), np.uint8),
    ):
        with pytest.raises(OutputError, match="picture"):
            write_png(tmp_path / "a.png", pixels)
    assert not list(tmp_path.iterdir())
