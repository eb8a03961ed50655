"""The built-in faces: six people of one topology, complete, within their size."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest

import facemorph
from facemorph.core.correspondence import difference
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.core.triangles import triangulated
from facemorph.io import read_mesh
from facemorph.resources import builtin_faces, data_folder
from tests.conftest import ROOT

PEOPLE = ("ada", "ben", "kofi", "mei", "omar", "zola")
EXPRESSIONS = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
GROUPS = {"skin", "mouth", "eye_L", "eye_R", "teeth_upper", "teeth_lower", "tongue", "lashes", "brows"}
UNITS = (1, 2, 4, 5, 6, 7, 9, 10, *range(12, 31), 34, 38, 43, 61, 62, 63, 64)


@pytest.fixture(scope="module")
def rigs() -> dict[str, Rig]:
    return {name: facemorph.load(name) for name in PEOPLE}


def tail(path: Path) -> str:
    """Digest of a file after its vertices: texture coordinates and faces."""
    content = path.read_bytes()
    return hashlib.sha256(content[content.index(b"\n", content.rindex(b"\nv ") + 1) :]).hexdigest()


def test_there_are_six_people():
    assert tuple(builtin_faces()) == PEOPLE


def test_all_people_and_expressions_have_one_topology():
    files = [path for folder in builtin_faces().values() for path in folder.glob("*.obj")]
    neutrals = {tail(path) for path in files if path.stem == "neutral"}
    shapes = {tail(path) for path in files if path.stem != "neutral"}
    assert len(neutrals) == len(shapes) == 1
    rig = facemorph.load("ada")
    for name in PEOPLE:
        shape = read_mesh(builtin_faces()[name] / "happy.obj")
        assert difference(rig.neutral, shape) is None, "the polygons are the same"


@pytest.mark.parametrize("name", PEOPLE)
def test_every_person_has_the_expressions_the_units_and_the_arkit_shapes(rigs, name):
    rig = rigs[name]
    assert tuple(shape.name for shape in rig.shapes_in(EXPRESSION)) == EXPRESSIONS
    assert [shape.name for shape in rig.shapes_in("facs")] == [f"AU{number}" for number in UNITS]
    arkit = {shape.name for shape in rig.shapes_in("arkit")}
    assert len(arkit) == 52
    assert {"jawOpen", "mouthSmileLeft", "eyeBlinkRight", "tongueOut", "browInnerUp", "cheekPuff"} <= arkit
    assert rig.neutral.groups is not None
    assert set(rig.neutral.groups.names) >= GROUPS
    assert {rule.shape for rule in rig.correctives} == {s.name for s in rig.shapes_in("corrective")}
    assert rig.info.licence == "CC0-1.0"
    assert rig.info.unit == "cm"


@pytest.mark.parametrize("name", PEOPLE)
def test_a_face_is_in_centimetres_y_up_looking_along_z(rigs, name):
    rig = rigs[name]
    low, high = rig.neutral.bounds
    assert 20 < (high - low)[1] < 45
    landmarks = {mark.ibug: rig.neutral.positions[mark.vertex] for mark in rig.info.landmarks}
    nose, chin, between_eyes = landmarks[30], landmarks[8], (landmarks[39] + landmarks[42]) / 2
    assert nose[2] > max(landmarks[36][2], landmarks[45][2], landmarks[0][2])
    assert chin[1] < nose[1] < between_eyes[1]
    assert landmarks[45][0] > 0 > landmarks[36][0], "the person's own left is +X"


@pytest.mark.parametrize("name", PEOPLE)
def test_the_68_usual_landmarks_are_all_there_and_mirror_each_other(rigs, name):
    marks = {mark.ibug: mark for mark in rigs[name].info.landmarks if mark.ibug is not None}
    assert sorted(marks) == list(range(68))
    positions = np.array([rigs[name].neutral.positions[marks[i].vertex] for i in range(68)])
    pairs = [(i, 16 - i) for i in range(8)] + [(17 + i, 26 - i) for i in range(5)]
    pairs += [(36, 45), (39, 42), (48, 54), (50, 52), (31, 35)]
    for right, left in pairs:
        np.testing.assert_allclose(positions[right] * [-1, 1, 1], positions[left], atol=0.3)
    assert any(mark.mpeg4 for mark in marks.values())


@pytest.mark.parametrize("name", PEOPLE)
def test_every_shape_moves_something_and_nothing_flies_away(rigs, name):
    moved = np.linalg.norm(rigs[name].deltas, axis=2).max(axis=1)
    assert moved[: len(rigs[name].controls)].min() > 0.02, "correctives come last"
    assert moved.max() < 8.0


def test_smiling_lifts_the_mouth_corners_and_opening_the_jaw_lowers_the_chin(rigs):
    for rig in rigs.values():
        marks = {mark.ibug: mark.vertex for mark in rig.info.landmarks}
        by_name = dict(zip(rig.names, rig.deltas, strict=True))
        assert by_name["happy"][[marks[48], marks[54]], 1].min() > 0.2
        assert by_name["sad"][[marks[48], marks[54]], 1].max() < -0.1
        assert by_name["jawOpen"][marks[8], 1] < -1.0
        assert by_name["surprised"][[marks[19], marks[24]], 1].min() > 0.2
        assert by_name["angry"][[marks[21], marks[22]], 1].max() < -0.2


def test_the_neutral_is_symmetric_enough_to_read_as_neutral(rigs):
    for rig in rigs.values():
        marks = {mark.ibug: mark.vertex for mark in rig.info.landmarks}
        brow = rig.neutral.positions[[marks[17], marks[19], marks[21]], 1]
        assert abs(brow[2] - brow[0]) < 0.9, "a worried neutral: the inner brow far above the outer"


@pytest.mark.parametrize("name", PEOPLE)
def test_regions_are_soft_and_never_sum_to_more_than_one(rigs, name):
    regions = rigs[name].regions
    assert regions is not None
    assert regions.names == ("brows", "eyes", "nose", "cheeks", "mouth", "jaw")
    total = regions.weights.astype(int).sum(axis=0)
    assert total.max() == 255
    partial = (regions.weights > 0) & (regions.weights < 255)
    assert partial.any(axis=1).all()


@pytest.mark.parametrize("name", PEOPLE)
def test_no_triangle_of_the_neutral_is_degenerate(rigs, name):
    mesh = rigs[name].neutral
    corners = mesh.positions[triangulated(mesh).vertices]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert np.mean(areas < 1e-7) < 0.002


def test_the_faces_stay_within_60_megabytes():
    faces = data_folder("faces")
    assert faces == ROOT / "assets" / "faces"
    assert sum(path.stat().st_size for path in faces.rglob("*") if path.is_file()) < 60e6


@pytest.mark.parametrize("name", PEOPLE)
def test_the_frame_shows_hair_and_chin_and_leaves_out_where_the_bust_ends(rigs, name):
    rig = rigs[name]
    if rig.info.frame is None:
        pytest.skip("these faces were made before they had frames")
    (_, low, _), (_, high, _) = rig.frame
    bottom, top = rig.neutral.bounds[:, 1]
    chin = min(rig.neutral.positions[landmark.vertex][1] for landmark in rig.info.landmarks)
    assert high == top
    assert bottom < low < chin - 1.0
