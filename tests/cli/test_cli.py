"""The command line: what it prints, writes and refuses."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

import facemorph
from facemorph.cli import main
from facemorph.cli.parser import VERBS, parsed
from facemorph.io import read_mesh, write_obj
from facemorph.resources import builtin_faces

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def folder(tmp_path):
    """A face of one triangle: neutral, and a smile that lifts its top."""
    (tmp_path / "neutral.obj").write_text(TRIANGLE)
    (tmp_path / "smile.obj").write_text(TRIANGLE.replace("0 1 0", "0 2 0"))
    return tmp_path


def refused(capsys, *arguments) -> str:
    """The one line that a refused command leaves on standard error."""
    assert main([str(argument) for argument in arguments]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("facemorph: ")
    return lines[0]


@pytest.mark.parametrize("arguments", [[], ["ada"], ["some/folder", "--set", "happy=1"]])
def test_without_a_verb_the_window_opens(arguments):
    assert parsed(arguments).verb is parsed(["view"]).verb


def test_faces_are_listed_a_line_each_with_the_name_first(capsys):
    assert main(["faces"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(builtin_faces())


def test_info_tells_what_a_folder_holds(capsys, folder):
    assert main(["info", str(folder), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["vertices"], facts["polygons"], facts["triangles"], facts["uvs"]) == (3, 1, 1, 0)
    assert facts["shapes"] == ["smile"]
    assert facts["diagonal"] == pytest.approx(2**0.5)
    assert {"groups", "materials"} <= facts.keys()


def test_info_works_on_one_mesh_file_and_in_plain_words(capsys, folder):
    assert main(["info", str(folder / "smile.obj")]) == 0
    assert "vertices" in capsys.readouterr().out


def test_export_writes_the_pose_in_the_files_own_order(capsys, folder, tmp_path):
    out = tmp_path / "out.obj"
    assert main(["export", str(folder), "--to", "smile", "--t", "0.25", "-o", str(out)]) == 0
    assert capsys.readouterr().out.strip() == str(out)
    mesh = read_mesh(out)
    np.testing.assert_array_equal(mesh.positions, [[0, 0, 0], [1, 0, 0], [0, 1.25, 0]])
    np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 3)


def test_export_eases_and_adds_weights(folder, tmp_path):
    out = tmp_path / "out.obj"
    arguments = ["--to", "smile", "--t", "0.25", "--curve", "cosine", "--set", "smile=-1.5"]
    assert main(["export", str(folder), *arguments, "-o", str(out)]) == 0
    expected = 1 + (0.5 - 0.5 * np.cos(np.pi / 4)) - 1.5
    assert read_mesh(out).positions[2, 1] == pytest.approx(expected, abs=1e-6)


def test_to_alone_goes_all_the_way_and_from_alone_stays(folder, tmp_path):
    for option in ("--to", "--from"):
        assert main(["export", str(folder), option, "smile", "-o", str(tmp_path / "x.obj")]) == 0
        assert read_mesh(tmp_path / "x.obj").positions[2, 1] == 2.0


def test_render_writes_a_picture_of_the_asked_size_and_the_same_one_again(folder, tmp_path):
    one, two = tmp_path / "one.png", tmp_path / "two.png"
    for path in (one, two):
        arguments = ["--set", "smile=0.5", "--size", "200x120", "--shading", "clay"]
        assert main(["render", str(folder), *arguments, "-o", str(path)]) == 0
    assert Image.open(one).size == (200, 120)
    assert one.read_bytes() == two.read_bytes()


def test_the_light_and_the_luminance_are_seen_in_the_picture(folder, tmp_path):
    def drawn(*options: str) -> np.ndarray:
        out = tmp_path / "out.png"
        assert main(["render", str(folder), "--size", "100x100", *options, "-o", str(out)]) == 0
        with Image.open(out) as picture:
            return np.asarray(picture)

    studio, flat = drawn(), drawn("--light", "flat")
    assert flat[2, 2].tolist() == [128, 128, 128, 255]
    assert not np.array_equal(studio, flat)
    bright = drawn("--light", "flat", "--equal-luminance", "0.6").astype(int)
    dim = drawn("--light", "flat", "--equal-luminance", "0.1").astype(int)
    assert bright[2, 2].tolist() == dim[2, 2].tolist(), "the backdrop has its own"
    assert bright.sum() > dim.sum() * 1.1


def test_a_transparent_background_leaves_the_corners_clear(folder, tmp_path):
    out = tmp_path / "x.png"
    assert (
        main(["render", str(folder), "--size", "100x100", "--background", "transparent", "-o", str(out)]) == 0
    )
    pixels = np.asarray(Image.open(out))
    assert pixels[0, -1, 3] == 0
    assert pixels[..., 3].max() == 255


def test_a_sheet_has_a_tile_for_neutral_and_each_expression(folder, tmp_path):
    out = tmp_path / "sheet.png"
    assert main(["render", str(folder), "--sheet", "--size", "120x100", "-o", str(out)]) == 0
    width, height = Image.open(out).size
    assert width >= 240
    assert height >= 100


def test_check_tells_a_sound_folder_from_a_broken_one(capsys, folder):
    assert main(["check", str(folder)]) == 0
    (folder / "frown.obj").write_text(TRIANGLE.replace("f ", "v 5 5 5\nf "))
    assert main(["check", str(folder), "--json"]) == 1
    captured = capsys.readouterr().out
    assert "frown" in captured


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["info", "nobody"], "nobody"),
        (["info", "adda"], "ada"),
        (["render", "FOLDER", "-o", "x.jpg"], ".png"),
        (["render", "FOLDER"], "-o"),
        (["render", "FOLDER", "--to", "smil", "-o", "x.png"], "smile"),
        (["render", "FOLDER", "--t", "half", "-o", "x.png"], "half"),
        (["render", "FOLDER", "--t", "nan", "-o", "x.png"], "nan"),
        (["render", "FOLDER", "--t", "0.5", "-o", "x.png"], "--to"),
        (["render", "FOLDER", "--set", "smile=1e30", "-o", "x.png"], "100"),
        (["rendr", "FOLDER"], "Did you mean 'render'"),
        (["render", "FOLDER", "--set", "smile", "-o", "x.png"], "NAME=VALUE"),
        (["render", "FOLDER", "--set", "smile=much", "-o", "x.png"], "much"),
        (["render", "FOLDER", "--curve", "bounce", "-o", "x.png"], "cosine"),
        (["render", "FOLDER", "--camera", "behind", "-o", "x.png"], "three-quarter"),
        (["render", "FOLDER", "--size", "huge", "-o", "x.png"], "1280x800"),
        (["render", "FOLDER", "--shading", "toon", "-o", "x.png"], "clay"),
        (["render", "FOLDER", "--background", "red", "-o", "x.png"], "RRGGBB"),
        (["render", "FOLDER", "--light", "candle", "-o", "x.png"], "studio, window, flat"),
        (["render", "FOLDER", "--equal-luminance", "bright", "-o", "x.png"], "'bright'"),
        (["render", "FOLDER", "--equal-luminance", "1.5", "-o", "x.png"], "0.02 to 0.7"),
        (["render", "FOLDER", "--equal-luminance", "--shading", "heat", "-o", "x.png"], "knows no light"),
        (["render", "FOLDER", "--per-picture", "-o", "x.png"], "--equal-luminance"),
        (["render", "FOLDER", "-o", "neutral.obj/x.png"], "neutral.obj"),
        (["export", "FOLDER", "-o", "x.ply"], ".obj"),
        (["check", "no/such/folder"], "no/such/folder"),
        (["faces", "--loud"], "--help"),
    ],
)
def test_a_mistake_is_one_line_and_status_2(capsys, monkeypatch, folder, arguments, said):
    monkeypatch.chdir(folder)
    assert said in refused(capsys, *(str(folder) if a == "FOLDER" else a for a in arguments))


def test_a_broken_mesh_is_refused_with_file_and_line(capsys, folder):
    (folder / "smile.obj").write_text(TRIANGLE.replace("f 1 2 3", "f 1 2 9"))
    assert "smile.obj:4" in refused(capsys, "info", folder)


def test_a_refused_export_leaves_the_old_file_as_it_was(capsys, folder, tmp_path):
    out = tmp_path / "kept.obj"
    out.write_text("precious")
    refused(capsys, "export", folder, "--to", "nothing", "-o", out)
    assert out.read_text() == "precious"


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_explains_itself(capsys, verb):
    with pytest.raises(SystemExit) as leaving:
        main([verb, "--help"])
    assert leaving.value.code == 0
    assert "usage: facemorph" in capsys.readouterr().out


def test_doctor_says_what_works(capsys):
    assert main(["doctor"]) == 0
    out = capsys.readouterr().out
    assert facemorph.__version__ in out
    assert "OpenGL" in out


def test_the_module_runs_as_a_program_and_its_output_can_be_cut_short():
    command = f"{sys.executable} -m facemorph faces | head -n 1"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("ada")
    assert done.stderr == ""


def test_without_a_display_the_main_job_runs_off_screen(capsys, folder, tmp_path):
    environment = "env -u DISPLAY -u WAYLAND_DISPLAY"
    out = tmp_path / "pictures"
    command = f"{environment} {sys.executable} -m facemorph view {folder} --without-display {out}"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=True)
    assert sorted(p.name for p in out.iterdir()) == ["neutral-to-smile.png", "neutral.png", "smile.png"]
    assert len(done.stderr.splitlines()) == 1
    assert done.stdout.splitlines()[0].endswith("neutral.png")


def test_the_library_loads_poses_draws_and_writes(folder, tmp_path):
    rig = facemorph.load(folder)
    pose = facemorph.Pose.between("neutral", "smile", t=0.5)
    pixels = facemorph.render(rig, pose, size=(90, 60))
    assert pixels.shape == (60, 90, 4)
    assert pixels.dtype == np.uint8
    path = facemorph.save_picture(tmp_path / "x.png", pixels)
    assert np.array_equal(np.asarray(Image.open(path).convert("RGBA")), pixels)
    write_obj(tmp_path / "copy.obj", rig.posed({"smile": 1.0}))
    assert facemorph.load([folder / "neutral.obj", tmp_path / "copy.obj"]).names == ("copy",)


def test_a_camera_may_look_from_a_negative_azimuth(folder, tmp_path):
    out = tmp_path / "x.png"
    assert main(["render", str(folder), "--camera", "-30,-5", "--size", "40x40", "-o", str(out)]) == 0
    assert out.is_file()


def test_check_takes_a_built_in_name(capsys):
    assert main(["check", "ada"]) == 0
    assert "all is well" in capsys.readouterr().out


def test_what_a_picture_lacks_is_told_beside_it(capsys, folder, tmp_path):
    (folder / "neutral.obj").write_text("mtllib gone.mtl face.mtl\nusemtl skin\n" + TRIANGLE)
    (folder / "face.mtl").write_text("newmtl skin\nKd 1 1 1\nmap_Kd skin.jpg\n")
    (folder / "skin.jpg").write_bytes(b"")
    for more in ([], ["--sheet"]):
        out = tmp_path / "x.png"
        assert main(["render", str(folder), "--size", "80x60", *more, "-o", str(out)]) == 0
        captured = capsys.readouterr()
        assert captured.out.split() == [str(out)]
        assert ["gone.mtl" in line or "skin.jpg" in line for line in captured.err.splitlines()] == [
            True,
            True,
        ]
    assert main(["info", str(folder)]) == 0
    assert "gone.mtl" in capsys.readouterr().out


def test_several_built_in_faces_are_refused_with_the_reason(capsys, tmp_path):
    assert "Name a built-in face alone" in refused(capsys, "render", "ada", "ben", "-o", tmp_path / "x.png")


def test_a_repair_is_told_and_its_face_opens(capsys, folder, tmp_path):
    quad = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 3 0\nf 1 2 3 4\nf 4 3 5\n"
    (folder / "neutral.obj").write_text(quad)
    (folder / "smile.obj").write_text("v 1 3 1\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 2 3 4 5\nf 5 4 1\n")
    (folder / "bad.obj").write_text("v x")
    out = tmp_path / "out"
    assert main(["check", str(folder), "--repair", str(out)]) == 1
    told = capsys.readouterr().err.splitlines()
    assert "smile.obj put in the neutral's order" in told[0]
    assert told[1].startswith("left out bad.obj: line 1")
    assert facemorph.load(out).deltas[0].tolist() == [[0, 0, 0]] * 4 + [[0, 0, 1]]
