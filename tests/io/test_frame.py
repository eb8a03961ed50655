"""A frame in a face.toml says what pictures of the face show; what is none is told with its place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facemorph.core.camera import Camera
from facemorph.errors import FaceFolderError
from facemorph.io import load_rig
from facemorph.io.face_toml import unknown_keys
from tests.io.texts import SQUARE, written

LOW, HIGH = "low = [0.25, 0.5, -1]\n", "high = [0.75, 1, 1]\n"


def face(folder: Path, frame: str) -> Path:
    """The square from 0 to 1 in x and y, with this table."""
    written(folder, SQUARE, "neutral.obj")
    written(folder, frame, "face.toml")
    return folder


def test_a_face_without_a_frame_is_seen_whole(tmp_path: Path) -> None:
    rig = load_rig(face(tmp_path, "name = 'Square'\n"))
    assert rig.info.frame is None
    np.testing.assert_array_equal(rig.frame, rig.neutral.bounds)
    assert Camera.of_face(rig, "left", 1.5) == Camera.framing(rig.neutral.bounds, "left", 1.5)


def test_a_frame_is_what_the_camera_shows_as_far_as_there_is_mesh(tmp_path: Path) -> None:
    rig = load_rig(face(tmp_path, f"[frame]\n{LOW}{HIGH}"))
    assert rig.info.frame == ((0.25, 0.5, -1.0), (0.75, 1.0, 1.0))
    np.testing.assert_array_equal(rig.frame, [[0.25, 0.5, 0.0], [0.75, 1.0, 0.0]])
    camera, whole = Camera.of_face(rig), Camera.framing(rig.neutral.bounds)
    assert camera.target == (0.5, 0.75, 0.0)
    assert camera.distance < whole.distance
    # What lies outside the frame is drawn all the same: the depth range is the whole face's.
    assert camera.scene_radius == whole.scene_radius


@pytest.mark.parametrize(
    ("frame", "told"),
    [
        ("frame = 3\n", "frame must be a table"),
        ("[[frame]]\n" + LOW + HIGH, "frame must be a table"),
        ("[frame]\n" + LOW, "three numbers in high"),
        ("[frame]\nlow = [0, 0]\n" + HIGH, "three numbers in low: x, y, z; there are 2"),
        ("[frame]\nlow = [0, 0, 0, 0]\n" + HIGH, "3 at most"),
        ("[frame]\nlow = [0, nan, 0]\n" + HIGH, "array of numbers"),
        ("[frame]\nlow = [0, 0, -inf]\n" + HIGH, "array of numbers"),
        ("[frame]\nlow = 'chin'\n" + HIGH, "must be an array"),
        ("[frame]\nlow = [1, 0, 0]\n" + HIGH, "below that of its high"),
        ("[frame]\nlow = [0, 20, -1]\nhigh = [1, 30, 1]\n", "shows nothing of the neutral"),
    ],
)
def test_what_is_no_frame_is_told(tmp_path: Path, frame: str, told: str) -> None:
    with pytest.raises(FaceFolderError, match=told):
        load_rig(face(tmp_path, frame))


def test_a_misspelt_corner_is_told(tmp_path: Path) -> None:
    folder = face(tmp_path, f"[frame]\n{LOW}{HIGH}lowest = 3\nunit = 'cm'\n")
    told = list(unknown_keys(folder))
    assert "'lowest' in [frame]" in told[0] and "Did you mean 'low'?" in told[0]
    assert "put it above the first [frame]" in told[1]
