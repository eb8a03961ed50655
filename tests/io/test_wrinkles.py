"""Wrinkles in a face.toml become a rig's; what is none is told with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from facemorph.core.wrinkles import Wrinkle
from facemorph.errors import FaceFolderError
from facemorph.io import load_rig
from facemorph.io.face_toml import unknown_keys
from tests.io.texts import SQUARE, written

HEAD = 'name = "frown"\nset = "green"\narea = [0.4, 0.7, 0.6, 0.8]\n'


def face(folder: Path, wrinkles: str) -> Path:
    """A square that smiles, with these wrinkles."""
    for name in ("neutral", "smile"):
        written(folder, SQUARE, f"{name}.obj")
    written(folder, '[[expressions]]\nname = "smile"\nfile = "smile.obj"\n' + wrinkles, "face.toml")
    return folder


def test_wrinkles_are_read(tmp_path: Path) -> None:
    more = "soft = 0.1\nrest = 0.25\nshapes = { smile = 1, AU4 = 0.5 }\n"
    rig = load_rig(face(tmp_path, f"[[wrinkles]]\n{HEAD}[[wrinkles]]\n{HEAD}{more}"))
    area = (0.4, 0.7, 0.6, 0.8)
    assert rig.wrinkles == (
        Wrinkle("frown", "green", area),
        Wrinkle("frown", "green", area, 0.1, 0.25, {"smile": 1.0, "AU4": 0.5}),
    )


@pytest.mark.parametrize(
    ("wrinkle", "told"),
    [
        ('set = "red"\narea = [0, 0, 1, 1]', "name is missing"),
        ('name = "w"\narea = [0, 0, 1, 1]', "set is missing"),
        ('name = "w"\nset = "red"', "needs four numbers"),
        ('name = "w"\nset = "red"\narea = [0, 0, 1]', "there are 3"),
        ('name = "w"\nset = "red"\narea = [0, 0, 1, 1, 1]', "4 at most"),
        ('name = "w"\nset = "red"\narea = [0, 0, inf, 1]', "array of numbers"),
        ('name = "w"\nset = "alpha"\narea = [0, 0, 1, 1]', "there are red, green, blue"),
        ('name = "w"\nset = "red"\narea = [1, 0, 0, 1]', "must grow"),
        (HEAD + 'soft = "wide"', "soft must be a number"),
        (HEAD + "soft = nan", "soft must be a number"),
        (HEAD + "soft = -1", "wider than 0"),
        (HEAD + "rest = true", "rest must be a number"),
        (HEAD + "rest = 1" + "0" * 400, "rest must be a number"),
        (HEAD + 'shapes = ["smile"]', "must be a table of numbers"),
        (HEAD + 'shapes = { smile = "much" }', "shapes.smile must be a number"),
        (HEAD + "shapes = { smile = inf }", "shapes.smile must be a number"),
    ],
)
def test_what_is_no_wrinkle_is_told(tmp_path: Path, wrinkle: str, told: str) -> None:
    with pytest.raises(FaceFolderError, match=told):
        load_rig(face(tmp_path, f"[[wrinkles]]\n{wrinkle}\n"))


def test_there_is_a_most_number_of_them(tmp_path: Path) -> None:
    with pytest.raises(FaceFolderError, match="more than 32 wrinkles"):
        load_rig(face(tmp_path, f"[[wrinkles]]\n{HEAD}" * 33))


def test_keys_that_mean_nothing_are_told(tmp_path: Path) -> None:
    (told,) = unknown_keys(face(tmp_path, f"[[wrinkles]]\n{HEAD}areas = [1]\n"))
    assert "'areas' in [[wrinkles]]" in told and "'area'" in told
