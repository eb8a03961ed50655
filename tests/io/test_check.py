"""A check names what is wrong with a face folder, and is quiet about a good one."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.errors import FaceFolderError
from facemorph.io import check_folder, write_obj
from facemorph.io.report import Report
from facemorph.resources import builtin_faces
from tests.conftest import bumpy_grid
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
