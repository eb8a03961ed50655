"""The methods on the command line: the same options mean the same in `render` and in `export`."""

from __future__ import annotations

import json

import numpy as np
import pytest
from PIL import Image

import facemorph
from facemorph.api import rebuild, save_expressions
from facemorph.cli import main
from facemorph.core.facs import Sides
from facemorph.core.pose import Pose
from facemorph.core.scene import Scene
from facemorph.deform.controls import BoundControls, Controls, EmotionControl
from facemorph.deform.handles import Handle, HandleSet
from facemorph.deform.people import bilinear
from facemorph.deform.sides import SidedUnits
from facemorph.errors import DeformError
from facemorph.io import read_mesh, write_handles


@pytest.fixture(scope="module")
def ada():
    return facemorph.load("ada")


def exported(tmp_path, *arguments):
    out = tmp_path / "out.obj"
    assert main(["export", *arguments, "-o", str(out)]) == 0
    return read_mesh(out).positions


def refused(capsys, *arguments) -> str:
    assert main(list(arguments)) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_units_are_added_by_number(ada, tmp_path):
    positions = exported(tmp_path, "ada", "--au", "12=0.8", "--au", "6=0.5")
    np.testing.assert_allclose(positions, ada.positions({"AU12": 0.8, "AU6": 0.5}), atol=1e-5)


def test_units_are_read_as_a_formula_and_by_side(ada, tmp_path):
    positions = exported(tmp_path, "ada", "--au", "AU1+4", "--au", "L12=0.4")
    expected = SidedUnits(ada)({1: Sides.both(1), 4: Sides.both(1), 12: Sides(0.4, 0.0)})
    np.testing.assert_allclose(positions, expected.positions(ada, Pose()), atol=1e-5)


def test_the_emotion_maps_place_is_the_papers_mixture(ada, tmp_path):
    positions = exported(tmp_path, "ada", "--emotion", "-0.3,0.4")
    np.testing.assert_allclose(positions, ada.positions({"afraid": 0.3, "happy": 0.4}), atol=1e-5)


def test_bilinear_is_2_10_between_the_four_key_frames(ada, tmp_path):
    ben = facemorph.load("ben")
    frames = [[rig.positions({name: 1.0}) for name in ("happy", "angry")] for rig in (ada, ben)]
    for s, t in ((0, 0), (1, 0), (0, 1), (1, 1), (0.3, 0.7)):
        arguments = ["--bilinear", "ada,ben", "happy,angry", "--s", str(s), "--t", str(t)]
        plain = exported(tmp_path, *arguments, "--linear")
        np.testing.assert_allclose(plain, bilinear(frames, s, t), atol=2e-5)


def test_everything_adds_up(ada, tmp_path):
    arguments = ["--to", "sad", "--t", "0.5", "--set", "jawOpen=0.2", "--au", "2=0.3", "--emotion", "0,0.25"]
    expected = ada.positions({"sad": 0.5, "jawOpen": 0.2, "AU2": 0.3, "happy": 0.25})
    np.testing.assert_allclose(exported(tmp_path, "ada", *arguments), expected, atol=1e-5)


def test_a_picture_between_two_people_takes_its_colours_from_both(tmp_path):
    means = []
    for s in ("0", "0.5", "1"):
        out = tmp_path / f"{s}.png"
        pair = ["--bilinear", "ada,kofi", "neutral,neutral", "--s", s]
        assert main(["render", *pair, "--size", "160x160", "-o", str(out)]) == 0
        means.append(np.asarray(Image.open(out))[70:100, 70:90, :3].mean())
    assert means[0] > means[1] > means[2]


def test_rbf_tells_its_error_and_more_points_make_it_smaller(capsys, tmp_path):
    errors = []
    for count in ("20", "120"):
        arguments = ["rbf", "ada", "--from", "neutral", "--to", "happy", "--points", count, "--kernel", "r"]
        assert main([*arguments, "--json"]) == 0
        facts = json.loads(capsys.readouterr().out)
        assert facts["points"] == int(count)
        errors.append(facts["rms_percent"])
    assert errors[1] < errors[0] < 5
    out = tmp_path / "rebuilt.obj"
    assert main(["rbf", "ada", "--to", "happy", "-o", str(out)]) == 0
    assert "rms error" in capsys.readouterr().out
    assert read_mesh(out).vertex_count == facemorph.load("ada").neutral.vertex_count


def test_rbf_takes_its_points_from_a_file(ada, capsys, tmp_path):
    path = tmp_path / "points.json"
    write_handles(path, HandleSet(tuple(Handle(v) for v in range(0, 8000, 200))), ada)
    assert main(["rbf", "ada", "--to", "sad", "--points", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["points"] == 40


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["export", "ada", "--au", "99=1", "-o", "x.obj"], "99"),
        (["export", "ada", "--au", "12=much", "-o", "x.obj"], "much"),
        (["export", "ada", "--au", "smile", "-o", "x.obj"], "AU1+4+15"),
        (["export", "ada", "--emotion", "0.5", "-o", "x.obj"], "X,Y"),
        (["export", "ada", "--emotion", "0.5,up", "-o", "x.obj"], "up"),
        (["export", "--bilinear", "ada", "happy,sad", "-o", "x.obj"], "ada,ben"),
        (["export", "--bilinear", "ada,nobody", "happy,sad", "-o", "x.obj"], "nobody"),
        (["export", "--bilinear", "ada,ben", "happy,grin", "-o", "x.obj"], "grin"),
        (["export", "--bilinear", "ada,ben", "happy,sad", "--s", "half", "-o", "x.obj"], "half"),
        (["export", "ada", "--bilinear", "ada,ben", "happy,sad", "-o", "x.obj"], "leave out FACE"),
        (["export", "ada", "--s", "0.5", "-o", "x.obj"], "--bilinear"),
        (["export", "-o", "x.obj"], "no face was named"),
        (["rbf", "ada", "--to", "happy", "--kernel", "gauss"], "multiquadric"),
        (["rbf", "ada", "--to", "happy", "--points", "3"], "4 to 2000"),
        (["rbf", "ada", "--to", "happy", "--points", "points.csv"], "points.csv"),
        (["rbf", "ada", "--to", "grin"], "grin"),
    ],
)
def test_a_mistake_is_one_line_and_status_2(capsys, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert said in refused(capsys, *arguments)


def test_two_people_of_different_topology_are_refused_with_the_cause(capsys, tmp_path):
    (tmp_path / "neutral.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "happy.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
    pair = ["--bilinear", f"ada,{tmp_path}", "happy,happy", "--s", "0.5"]
    line = refused(capsys, "export", *pair, "-o", str(tmp_path / "x.obj"))
    assert "vertices" in line
    assert "one topology" in line


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ('"vertices": ', '"vertices": 9'),
        ('"vertex": 0', '"vertex": 99999'),
        ('"format": "facemorph handles 1"', '"format": "other"'),
        ('"kernel": "r"', '"kernel": "gauss"'),
        ('"vertex": 200', '"vertex": 0'),
        ("{", "["),
    ],
)
def test_a_damaged_file_of_points_is_refused(ada, capsys, tmp_path, change, said):
    path = tmp_path / "points.json"
    write_handles(path, HandleSet(tuple(Handle(v) for v in range(0, 2000, 200))), ada)
    path.write_text(path.read_text().replace(change, said, 1))
    assert "points" in refused(capsys, "rbf", "ada", "--to", "sad", "--points", str(path))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["render", "ada", "--sheet", "--to", "happy", "-o", "x.png"], "--sheet"),
        (["render", "ada", "--sheet", "--au", "12=1", "-o", "x.png"], "--sheet"),
        (["rbf", "ada", "--to", "happy", "--c", "5"], "multiquadric"),
        (["rbf", "ada", "--to", "happy", "--points", "/dev/zero"], "/dev/zero"),
        (["export", "ada", "--to", "happy", "--t", "1e30", "-o", "x.obj"], "100"),
        (["export", "ada", "--emotion", "2,0", "-o", "x.obj"], "-1 to 1"),
        (["export", "ada", "--au", "12(1e30)", "-o", "x.obj"], "100"),
    ],
)
def test_options_that_would_do_nothing_or_harm_are_refused(capsys, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    assert said in refused(capsys, *arguments)


def test_a_small_negative_number_is_no_option(ada, tmp_path):
    positions = exported(tmp_path, "ada", "--to", "happy", "--t", "-1e-1")
    np.testing.assert_allclose(positions, ada.positions({"happy": -0.1}), atol=1e-5)


def test_names_of_shapes_stay_in_the_folder_of_pictures(tmp_path):
    mesh = facemorph.load("ada").neutral
    rig = facemorph.Rig.from_arrays(mesh, {"../escaped": mesh.positions + 1, "..": mesh.positions + 2})
    paths = save_expressions(rig, tmp_path / "out", size=(32, 32))
    assert {path.parent for path in paths} == {tmp_path / "out"}
    assert len({path.name for path in paths}) == len(paths) == 4


def test_a_tiny_heat_map_goes_without_a_legend(tmp_path):
    out = tmp_path / "x.png"
    assert main(["render", "ada", "--to", "happy", "--shading", "heat", "--size", "8x8", "-o", str(out)]) == 0
    assert Image.open(out).size == (8, 8)


def test_a_face_of_another_topology_is_refused_by_name_before_its_expressions(capsys, tmp_path):
    cube = tmp_path / "cube.obj"
    cube.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    line = refused(capsys, "export", "--bilinear", f"ada,{cube}", "happy,sad", "-o", str(tmp_path / "x.obj"))
    assert f"{cube}: it has 3 vertices" in line
    assert "one topology" in line
    assert not (tmp_path / "x.obj").exists()


def test_what_the_second_person_lacks_is_said_with_what_they_have(ada, capsys, tmp_path):
    from facemorph.io import write_obj

    write_obj(tmp_path / "neutral.obj", ada.neutral)
    write_obj(tmp_path / "happy.obj", ada.posed({"happy": 1.0}))
    pair = ["--bilinear", f"ada,{tmp_path}", "neutral,happy", "--s", "0.5", "-o", str(tmp_path / "x.obj")]
    line = refused(capsys, "export", *pair, "--au", "12")
    assert f"no shape of {tmp_path} is called 'AU12'. There are: neutral, happy." in line


def test_points_off_the_face_are_refused_by_the_library(ada):
    with pytest.raises(DeformError, match="no vertex 99999; the face has 0 to"):
        rebuild(ada, "neutral", "happy", np.array([5, 99999, 9, 100]))


def test_the_librarys_methods_mean_what_the_options_mean(ada, tmp_path):
    controls = Controls(facs={12: Sides.both(0.8)}, emotion=EmotionControl(0.3, 0.6))
    scene = Scene.moved(Pose(), BoundControls(ada)(Pose(), controls))
    facemorph.export(ada, scene, tmp_path / "library.obj")
    expected = exported(tmp_path, "ada", "--au", "12=0.8", "--emotion", "0.3,0.6")
    np.testing.assert_array_equal(read_mesh(tmp_path / "library.obj").positions, expected)
