"""A check names what is wrong with a face folder, and is quiet about a good one."""

from __future__ import annotations

import json
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.core.arrays import Float32
from facemorph.core.correctives import Corrective
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig, Shape
from facemorph.errors import FaceFolderError, UnknownNameError
from facemorph.io import check_folder, load_rig, write_face, write_obj
from facemorph.io.check_axes import _ways, turn_between
from facemorph.io.report import Report
from facemorph.resources import builtin_faces
from tests.conftest import bumpy_grid
from tests.io.test_faces import npz
from tests.io.texts import SQUARE, written


@pytest.fixture
def grid() -> Mesh:
    """A finer curved sheet."""
    return bumpy_grid(24, 30)


def bump(mesh: Mesh, height: float = 0.3) -> np.ndarray:
    """A smooth offset (V, 3) in the middle of the sheet."""
    x, y = mesh.positions[:, 0], mesh.positions[:, 1]
    offset = np.zeros_like(mesh.positions)
    offset[:, 2] = height * np.exp(-(x**2 + y**2) / 0.5)
    return offset


def report_on(folder: Path, neutral: Mesh, **shapes: Mesh | np.ndarray) -> Report:
    """The report on a folder with these meshes, or positions (V, 3), beside a good shape."""
    write_obj(folder / "neutral.obj", neutral)
    write_obj(folder / "good.obj", neutral.with_positions(neutral.positions + bump(neutral)))
    for name, shape in shapes.items():
        write_obj(folder / f"{name}.obj", shape if isinstance(shape, Mesh) else neutral.with_positions(shape))
    return check_folder(folder)


def kinds(report: Report) -> list[tuple[str, str, str]]:
    return [(finding.level, finding.file, finding.kind) for finding in report.findings]


def test_a_good_folder_is_well(tmp_path: Path, grid: Mesh) -> None:
    report = report_on(tmp_path, grid)
    assert report.findings == ()
    assert report.ok
    assert report.shapes == ("good",)
    assert report.lines() == [f"{tmp_path}: 1 shape on 720 vertices, 667 polygons; all is well."]


@pytest.mark.parametrize("name", sorted(builtin_faces()))
def test_the_built_in_faces_are_well(name: str) -> None:
    assert check_folder(builtin_faces()[name]).findings == ()


def test_one_bad_file_does_not_hide_the_others(tmp_path: Path, grid: Mesh) -> None:
    written(tmp_path, SQUARE.replace("1 1 0", "1 one 0"), "bad.obj")
    written(tmp_path, SQUARE.replace("1 1 0", "1 nan 0"), "nan.obj")
    written(tmp_path, b"\0\0", "binary.ply")
    written(tmp_path, SQUARE, "other.obj")
    report = report_on(tmp_path, grid, still=grid)
    assert kinds(report) == [
        ("error", "bad.obj", "unreadable"),
        ("error", "binary.ply", "unreadable"),
        ("error", "nan.obj", "not-finite"),
        ("error", "other.obj", "vertices"),
        ("warning", "still.obj", "empty"),
    ]
    assert not report.ok
    assert report.shapes == ("good", "still")
    assert "line 3" in report.findings[0].message
    assert len(report.lines()) == 6
    assert all("\n" not in line for line in report.lines())


def test_the_report_is_plain_json(tmp_path: Path, grid: Mesh) -> None:
    report = report_on(tmp_path, grid, still=grid)
    back = json.loads(json.dumps(report.as_dict()))
    assert back["ok"] is True
    assert back["shapes"] == ["good", "still"]
    assert back["findings"][0]["kind"] == "empty"


def test_faults_of_the_neutral_are_found(tmp_path: Path, grid: Mesh) -> None:
    corners = grid.corner_vertices.copy()
    corners[40:44] = corners[40:44][::-1]
    corners[80:84] = [100, 101, 100, 101]
    positions = np.concatenate([grid.positions, np.array([[0, 0, 1]], np.float32)])
    bad = replace(grid, positions=positions, corner_vertices=corners)
    found = {finding.kind: finding.message for finding in report_on(tmp_path, bad).findings}
    assert set(found) == {"stray-vertices", "degenerate", "winding"}
    assert "1 vertex belongs to no polygon: 721" in found["stray-vertices"]
    assert "21" in found["degenerate"]
    assert "11" in found["winding"]


def test_faults_of_shapes_are_found(tmp_path: Path, grid: Mesh) -> None:
    good = grid.positions + bump(grid)
    stray = good.copy()
    stray[300] += [0.0, 0.0, 2.0]
    folded = grid.positions.copy()
    middle = np.flatnonzero((np.abs(grid.positions[:, 0]) < 0.6) & (np.abs(grid.positions[:, 1]) < 0.6))
    folded[middle, 0] *= -1.0
    report = report_on(
        tmp_path,
        grid,
        twin=good,
        stray=stray,
        folded=folded,
        large=good * 100,
        shifted=good + np.float32(3),
        order=grid,
    )
    found = {file: kind for _, file, kind in kinds(report)}
    assert found == {
        "twin.obj": "duplicate", "stray.obj": "stray-movement", "folded.obj": "folded", "large.obj": "scale",
        "shifted.obj": "moved", "order.obj": "empty",
    }  # fmt: skip
    messages = {finding.file: finding.message for finding in report.findings}
    assert "301" in messages["stray.obj"]
    assert "100 times" in messages["large.obj"]
    assert not report.ok


def test_a_shape_in_another_order_is_named_as_such(tmp_path: Path, grid: Mesh) -> None:
    new = np.random.default_rng(0).permutation(grid.vertex_count)
    positions = np.empty_like(grid.positions)
    positions[new] = grid.positions + bump(grid)
    shuffled = replace(grid, positions=positions, corner_vertices=new[grid.corner_vertices].astype(np.int32))
    report = report_on(tmp_path, grid, shuffled=shuffled)
    assert kinds(report) == [("error", "shuffled.obj", "order")]
    assert "--repair" in report.findings[0].message


def test_missing_textures_are_named(tmp_path: Path) -> None:
    written(tmp_path, "newmtl skin\nmap_Kd gone.png\n", "face.mtl")
    written(tmp_path, "mtllib face.mtl gone.mtl\nusemtl skin\n" + SQUARE, "neutral.obj")
    report = check_folder(tmp_path)
    assert kinds(report) == [("warning", "neutral.obj", "texture")] * 2
    assert report.ok
    assert any("gone.png" in finding.message for finding in report.findings)
    assert any("gone.mtl" in finding.message for finding in report.findings)


def test_a_folder_without_a_neutral_is_told_and_its_meshes_are_read(tmp_path: Path) -> None:
    written(tmp_path, SQUARE, "a.obj")
    written(tmp_path, "v 0 0 x", "b.obj")
    report = check_folder(tmp_path)
    assert [finding.kind for finding in report.findings] == ["folder", "unreadable"]
    assert not report.ok


def test_a_bad_neutral_does_not_hide_bad_shapes(tmp_path: Path) -> None:
    written(tmp_path, "v 0 0 x", "neutral.obj")
    written(tmp_path, "v 0 0 y", "a.obj")
    assert [finding.file for finding in check_folder(tmp_path).findings] == ["neutral.obj", "a.obj"]


def test_what_is_no_folder_of_meshes_is_refused(tmp_path: Path) -> None:
    for path, words in (
        (tmp_path, "no mesh"),
        (tmp_path / "gone", "not exist"),
        (written(tmp_path, "", "f"), "is a file"),
    ):
        with pytest.raises(FaceFolderError, match=words):
            check_folder(path)


def messages(report: Report, kind: str) -> list[str]:
    return [
        f"{finding.level} {finding.file}: {finding.message}"
        for finding in report.findings
        if finding.kind == kind
    ]


def square_face(folder: Path, toml: str) -> Path:
    written(folder, SQUARE, "neutral.obj")
    written(folder, SQUARE.replace("v 0 0 0", "v 0 0 1"), "up.obj")
    written(folder, toml, "face.toml")
    return folder


UP = "[[expressions]]\nname = 'up'\nfile = 'up.obj'\n"


@pytest.mark.parametrize(
    ("toml", "words"),
    [
        (UP + "[[landmarks]]\nname = 'nose'\nvertex = 99999\n", "vertex 99999"),
        (UP + "[[landmarks]]\nname = 'nose'\nvertex = 'a'\n", "whole number"),
        ("unit = 'furlong'\n" + UP, "mm, cm, m, in"),
        ("name = 3\n" + UP, "must be a text"),
        ("shapes = 'more.npz'\n" + UP, "'up'"),
        (UP + "label = 3\n", "must be a text"),
        (UP + UP, "name of its own"),
        ("expressions = 3", "array of tables"),
    ],
)
def test_what_loading_refuses_is_an_error(tmp_path: Path, toml: str, words: str) -> None:
    square_face(tmp_path, toml)
    np.savez(tmp_path / "more.npz", **npz(names=np.array(["AU1", "up"])))
    with pytest.raises(FaceFolderError, match=words):
        load_rig(tmp_path)
    report = check_folder(tmp_path)
    assert not report.ok
    errors = [finding for finding in report.findings if finding.level == "error"]
    assert [(finding.file, finding.kind) for finding in errors] == [("face.toml", "folder")]
    assert words in errors[0].message


def test_a_description_is_examined_although_the_neutral_cannot_be_read(tmp_path: Path) -> None:
    square_face(tmp_path, "unit = 'furlong'\n" + UP)
    written(tmp_path, "v x", "neutral.obj")
    assert [f.file for f in check_folder(tmp_path).findings] == ["neutral.obj", "face.toml"]


def test_a_wrong_description_of_meshes_below_is_told_as_such(tmp_path: Path) -> None:
    written(tmp_path, "neutral = 'sub/neutral.obj'", "face.toml")
    assert [f.message for f in check_folder(tmp_path).findings] == [
        "neutral names 'sub/neutral.obj', which is no file in the folder."
    ]


def test_meshes_that_a_description_leaves_out_and_keys_that_mean_nothing_are_told(tmp_path: Path) -> None:
    square_face(tmp_path, "license = 'CC0'\n" + UP + "lable = 'Up'\nunit = 'cm'\n")
    written(tmp_path, SQUARE, "left.obj")
    report = check_folder(tmp_path)
    assert report.ok
    keys = messages(report, "key")
    assert len(keys) == 3
    assert "'license'" in keys[0]
    assert "Did you mean 'licence'?" in keys[0]
    assert "'lable' in [[expressions]]" in keys[1]
    assert "Did you mean 'label'?" in keys[1]
    assert "put it above the first [[expressions]]" in keys[2]
    assert [line.split(":")[0] for line in messages(report, "unlisted")] == ["warning left.obj"]


def test_a_misspelt_list_of_expressions_is_told_and_the_meshes_are_checked(tmp_path: Path) -> None:
    report = check_folder(square_face(tmp_path, UP.replace("expressions", "expresions")))
    assert "Did you mean 'expressions'?" in messages(report, "key")[0]
    assert report.shapes == ("up",)
    assert not messages(report, "unlisted")


def test_a_lone_mesh_taken_for_the_neutral_is_told(tmp_path: Path) -> None:
    written(tmp_path, SQUARE, "head.obj")
    assert kinds(check_folder(tmp_path)) == [("warning", "head.obj", "neutral")]
    (tmp_path / "head.obj").rename(tmp_path / "happy.obj")
    assert kinds(check_folder(tmp_path)) == [("error", tmp_path.name, "folder")]


def picture(kind: str) -> bytes:
    """A noisy picture, which no coder makes small."""
    pixels = np.random.default_rng(0).integers(0, 256, (64, 64, 3), np.uint8)
    file = BytesIO()
    Image.fromarray(pixels).save(file, format=kind)
    return file.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.png", b"", "empty"),
        ("a.jpg", picture("JPEG")[:1500], "truncated"),
        ("a.png", picture("PNG")[:1500], "cannot be read"),
        ("a.png", picture("PNG").replace(b"IDAT", b"IDAX"), "cannot be read"),
        ("a.png", b"no picture", "no picture"),
    ],
)
def test_textures_that_cannot_be_read_are_told_by_name(
    tmp_path: Path, name: str, content: bytes, words: str
) -> None:
    written(tmp_path, f"newmtl skin\nmap_Kd {name}\nnewmtl eye\nmap_Kd good.png\n", "face.mtl")
    written(tmp_path, "mtllib face.mtl\nusemtl skin\n" + SQUARE, "neutral.obj")
    written(tmp_path, content, name)
    written(tmp_path, picture("PNG"), "good.png")
    report = check_folder(tmp_path)
    assert kinds(report) == [("warning", name, "texture")]
    assert words in report.findings[0].message
    assert "'skin'" in report.findings[0].message


def test_morph_targets_that_are_not_read_are_told(shared_data: Path) -> None:
    report = check_folder(shared_data / "gltf" / "SimpleMorph")
    assert "2 morph targets are not read" in messages(report, "left-out")[0]


def test_one_vertex_far_away_is_a_stray_one_and_no_other_size(tmp_path: Path, grid: Mesh) -> None:
    stray = grid.positions + bump(grid)
    stray[619] = 900.0
    report = report_on(tmp_path, grid, stray=stray)
    assert kinds(report) == [("warning", "stray.obj", "stray-movement")]
    assert (
        "1 vertex moves far away from all neighbours: 620 (counted from 1, as in an OBJ" in report.lines()[0]
    )


@pytest.mark.parametrize(
    ("turn", "words"),
    [
        ([[-1, 0, 0], [0, 1, 0], [0, 0, 1]], "is mirrored in x"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "is mirrored in z"),
        ([[-1, 0, 0], [0, -1, 0], [0, 0, 1]], "is upside down"),
        ([[1, 0, 0], [0, -1, 0], [0, 0, -1]], "is upside down"),
        ([[-1, 0, 0], [0, -1, 0], [0, 0, -1]], "is mirrored through the origin"),
        ([[1, 0, 0], [0, 0, 1], [0, -1, 0]], "the neutral's x, y, z are its x, -z, y"),
    ],
)
def test_a_shape_in_other_axes_is_told_as_such(tmp_path: Path, grid: Mesh, turn, words: str) -> None:
    shape = (grid.positions + bump(grid)) @ np.array(turn, np.float32).T + np.float32(0.1)
    shape[5] = 900.0
    report = report_on(tmp_path, grid, other=shape)
    assert kinds(report) == [("error", "other.obj", "turned")]
    assert words in report.findings[0].message


def test_axes_told_are_those_that_put_a_shape_right(grid: Mesh) -> None:
    rng = np.random.default_rng(3)
    told = set()
    for order, signs in _ways():
        places = np.empty_like(grid.positions, np.float64)
        places[:, order] = (grid.positions + rng.normal(scale=0.01, size=grid.positions.shape)) * signs
        told.add(turn_between(grid.positions.astype(np.float64), places))
    assert len(told) == 48
    assert None in told


def test_many_numbers_do_not_run_together(tmp_path: Path) -> None:
    fine = bumpy_grid(60, 60)
    positions = np.concatenate([fine.positions, np.zeros((7, 3), np.float32)])
    report = report_on(tmp_path, replace(fine, positions=positions))
    found = messages(report, "stray-vertices")[0]
    assert (
        "3601, 3602, 3603, 3604, 3605 and 2 more (counted from 1, as in an OBJ; face.toml counts from 0)"
        in found
    )


def test_a_built_in_face_is_checked_by_its_name() -> None:
    if "ada" not in builtin_faces():
        pytest.skip("the built-in faces are not there")
    report = check_folder("ada")
    assert report.ok
    assert "happy" in report.shapes
    with pytest.raises(UnknownNameError, match="ada"):
        check_folder("adaa")


def test_the_hint_names_the_folder_itself(tmp_path: Path, grid: Mesh) -> None:
    new = np.random.default_rng(0).permutation(grid.vertex_count)
    positions = np.empty_like(grid.positions)
    positions[new] = grid.positions
    folder = tmp_path / "my face"
    folder.mkdir()
    shuffled = replace(grid, positions=positions, corner_vertices=new[grid.corner_vertices].astype(np.int32))
    report = report_on(folder, grid, shuffled=shuffled)
    assert f"facemorph check '{folder}' --repair OUT" in messages(report, "order")[0]


def test_a_corrective_is_judged_on_the_shapes_that_switch_it_on(tmp_path: Path) -> None:
    across, up = np.meshgrid(np.arange(9.0), np.arange(9.0), indexing="ij")
    points = np.stack([across, up, np.zeros_like(across)], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = (np.arange(8)[:, None] * 9 + np.arange(8)).ravel()
    quads = np.stack([corner, corner + 9, corner + 10, corner + 1], axis=1).astype(np.int32)
    inner = np.zeros((9, 9, 1), np.float32)
    inner[3:6, 4] = 1.0
    far = (inner * np.array([0.0, 2.6, 0.0], np.float32)).reshape(-1, 3)
    # It goes back what its driver went too far, and by itself it would fold the other way.
    shapes = (Shape("move", "Move"), Shape("mend", "Mend", "corrective"))
    rules = (Corrective("mend", ("move",)),)

    def told(mend: Float32, name: str) -> list[str]:
        rig = Rig(Mesh.from_polygons(points, quads), shapes, np.stack([far, mend]), correctives=rules)
        findings = check_folder(write_face(rig, tmp_path / name)).findings
        return [finding.message for finding in findings if "mend" in finding.message]

    assert told(-far * np.float32(0.98), "mended") == []
    assert any("turned over" in message for message in told(far, "worse"))
