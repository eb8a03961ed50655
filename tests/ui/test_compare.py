"""The comparison: paths of a vertex, and the face seen twice."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.facs import Sides
from facemorph.core.pose import Pose
from facemorph.core.progress import silent
from facemorph.core.rig import Rig
from facemorph.deform.controls import BoundControls, Controls, PeopleControl
from facemorph.deform.handles import Handle, HandleSet
from facemorph.ui import actions, comparing, files, plots
from tests.ui.harness import Offscreen

FACE = (450, 380)


@pytest.fixture
def page(window: Offscreen) -> Offscreen:
    actions.show_page(window.app, "Compare")
    window.frames(3)
    return window


def moving_vertex(rig: Rig, name: str) -> int:
    return int(np.argmax(np.linalg.norm(rig.deltas[rig.names.index(name)], axis=1)))


def test_linear_has_one_speed_and_cosine_that_of_its_formula(rig: Rig) -> None:
    vertex = moving_vertex(rig, "happy")
    pose = Pose.between("neutral", "happy", 0.2, "cosine")
    made = comparing.paths(rig, vertex, pose, Controls(), BoundControls(rig), silent)
    whole = float(np.linalg.norm(rig.deltas[rig.names.index("happy"), vertex]))
    assert made.value["Linear"] == pytest.approx(whole * made.t, abs=1e-5)
    assert made.speed["Linear"] == pytest.approx(whole, rel=1e-5)
    assert made.acceleration["Linear"] == pytest.approx(0.0, abs=1e-3)
    assert made.value["Cosine"] == pytest.approx(whole * (1 - np.cos(np.pi * made.t)) / 2, abs=1e-5)
    assert made.speed["Cosine"] == pytest.approx(
        whole * math.pi / 2 * np.sin(np.pi * made.t), abs=whole * 5e-3
    )
    inner = slice(3, -3)
    expected = whole * math.pi**2 / 2 * np.cos(np.pi * made.t)
    assert made.acceleration["Cosine"][inner] == pytest.approx(expected[inner], abs=whole * 0.05)
    for kind in (made.value, made.speed):
        assert kind["Present"] == pytest.approx(kind["Cosine"], abs=1e-5)


def test_a_click_chooses_the_vertex_and_its_path_follows_the_controls(page: Offscreen, rig: Rig) -> None:
    app = page.app
    app.pose = replace(app.pose, target={"happy": 1.0})
    page.frames(2)
    steps = app.history.undo_words
    page.click(*FACE)
    assert app.history.undo_words == steps
    compare = app.lab.compare
    page.until(lambda: compare.paths is not None)
    vertex = compare.vertex
    delta = rig.deltas[rig.names.index("happy"), vertex]
    assert compare.paths.value["Linear"][-1] == pytest.approx(np.linalg.norm(delta), abs=1e-5)
    first = compare.paths
    app.pose = replace(app.pose, target={"sad": 1.0})
    page.until(lambda: compare.paths is not first)
    delta = rig.deltas[rig.names.index("sad"), vertex]
    assert compare.paths.value["Linear"][-1] == pytest.approx(np.linalg.norm(delta), abs=1e-5)
    before = page.pixels_now().copy()
    compare.vertex = None
    page.frames(2)
    assert np.abs(page.pixels_now().astype(int) - before)[300:740, 920:].max() > 40


def test_the_split_view_shows_both_curves_and_their_difference(page: Offscreen, rig: Rig) -> None:
    app = page.app
    app.pose = Pose.between("neutral", "happy", 0.25, "cosine")
    app.lab.compare.split = True
    page.frames(4)
    left, right = app.lab.compare.scenes
    full = rig.deltas[rig.names.index("happy")]
    assert left.positions(rig) == pytest.approx(rig.neutral.positions + 0.25 * full, abs=1e-5)
    e = (1 - math.cos(math.pi * 0.25)) / 2
    assert right.positions(rig) == pytest.approx(rig.neutral.positions + e * full, abs=1e-5)
    assert app.lab.compare.difference[0] == pytest.approx(
        (0.25 - e) * np.linalg.norm(full, axis=1).max(), rel=1e-4
    )
    assert app.second_legend is not None
    assert app.second_legend.title == "Difference"
    assert app.legend is None
    view = app.viewport
    middle = int(view.x + view.width / 2)
    pixels = page.pixels_now().astype(int)
    two = [pixels[150:600, start : start + 400] for start in (int(view.x) + 20, middle + 20)]
    assert np.abs(two[0] - two[1]).max() > 60


def test_the_cameras_of_both_views_are_one(page: Offscreen) -> None:
    app = page.app
    app.pose = Pose.between("neutral", "happy", 0.25)
    app.lab.compare.split, app.lab.compare.heat = True, False
    app.lab.compare.right = app.lab.compare.left = "Linear"
    page.frames(4)
    for _ in range(2):
        view = app.viewport
        half = int(view.width // 2)
        pixels = page.pixels_now().astype(int)
        start = int(view.x)
        strip = slice(120, 560)
        left, right = (
            pixels[strip, start + 8 : start + half - 8],
            pixels[strip, start + half + 8 : start + 2 * half - 8],
        )
        assert np.abs(left - right).mean() < 1.0
        page.drag((700, 300), (760, 320))
        page.move(1100, 780)
        page.frames(3)
    assert app.camera.azimuth_deg != 0.0


def test_the_wheel_zooms_to_the_pointer_in_the_right_view_too(page: Offscreen) -> None:
    app = page.app
    app.lab.compare.split = True
    page.frames(4)
    right = app.views()[1]
    at = (right.x + right.width / 2, right.y + right.height / 2)
    target = app.camera.target
    page.move(*at)
    page.wheel(3)
    assert app.camera.target == pytest.approx(target)


def test_a_layer_is_compared_with_its_absence(page: Offscreen, rig: Rig) -> None:
    app = page.app
    app.controls = replace(app.controls, handles=HandleSet((Handle(500, (0.0, 0.0, 1.0)),)))
    choices = comparing.methods_now(app, rig)
    assert "Without handles" in choices
    app.lab.compare.split, app.lab.compare.left, app.lab.compare.right = True, "Present", "Without handles"
    page.frames(3)
    left, right = app.lab.compare.scenes
    assert right.positions(rig) == pytest.approx(rig.positions(app.pose))
    assert app.lab.compare.difference[0] == pytest.approx(1.0, abs=0.05)
    actions.show_page(app, "Shapes")
    page.frames(3)
    assert len(app.views()) == 1
    assert app.scene().positions(rig) == pytest.approx(left.positions(rig))


def test_the_rebuild_beside_the_true_way_meets_it_at_the_start(page: Offscreen, rig: Rig) -> None:
    app = page.app
    app.pose = Pose.between("neutral", "sad", 0.0)
    app.lab.compare.split, app.lab.compare.right = True, "RBF rebuild"
    page.frames(3)
    assert app.lab.compare.difference[0] == pytest.approx(0.0, abs=1e-5)
    app.pose = replace(app.pose, t=1.0)
    page.frames(3)
    most, _ = app.lab.compare.difference
    assert 0.0 < most < 0.5 * np.linalg.norm(rig.deltas[rig.names.index("sad")], axis=1).max()


def test_a_saved_picture_holds_both_views(page: Offscreen, tmp_path: Path) -> None:
    from PIL import Image

    app = page.app
    app.pose = Pose.between("neutral", "happy", 0.25)
    app.lab.compare.split = True
    page.frames(4)
    path = tmp_path / "both.png"
    files.save_picture(app, path)
    page.until(path.exists)
    page.until(lambda: not app.jobs.running)
    assert Image.open(path).size == (2 * app.views()[0].size[0], app.views()[0].size[1])


def test_the_split_view_is_switched_on_by_the_mouse_and_the_face_put_in_sight(page: Offscreen) -> None:
    app = page.app
    distance = app.camera.distance
    for y in range(100, 200, 8):
        page.click(1246, y)
        page.frames(2)
        if app.lab.compare.split:
            break
    assert len(app.views()) == 2
    assert app.camera.distance > distance


def test_a_weight_on_its_way_by_all_three_methods_is_that_of_their_formulas(rig: Rig) -> None:
    pose = replace(Pose.between("neutral", "happy", 0.9, "cosine"), weights={"happy": 0.25})
    made = comparing.weight_paths(rig, "happy", pose, Controls(), BoundControls(rig), silent)
    eased = (1 - np.cos(np.pi * made.t)) / 2
    assert made.value["Present"] == pytest.approx(0.25 + eased)
    assert made.value["Cosine"] == pytest.approx(0.25 + eased)
    assert made.value["Linear"] == pytest.approx(0.25 + made.t)
    assert made.speed["Linear"] == pytest.approx(1.0)
    assert made.speed["Cosine"] == pytest.approx(math.pi / 2 * np.sin(np.pi * made.t), abs=2e-3)
    assert made.acceleration["Linear"] == pytest.approx(0.0, abs=1e-9)
    inner = slice(3, -3)
    expected = math.pi**2 / 2 * np.cos(np.pi * made.t)
    assert made.acceleration["Cosine"][inner] == pytest.approx(expected[inner], abs=0.05)


def test_a_weight_that_falls_has_a_speed_below_nought(rig: Rig) -> None:
    pose = Pose.between("happy", "sad", 0.0)
    made = comparing.weight_paths(rig, "happy", pose, Controls(), BoundControls(rig), silent)
    assert made.value["Linear"] == pytest.approx(1.0 - made.t)
    assert made.speed["Linear"] == pytest.approx(-1.0)


def test_the_weight_counts_what_every_page_adds(rig: Rig) -> None:
    controls = Controls(facs={12: Sides(0.5, 0.3)}, people=PeopleControl(None, {}, {"AU12": 1.0}, 0.7))
    made = comparing.weight_paths(rig, "AU12", Pose.of({"AU12": 0.1}), controls, BoundControls(rig), silent)
    assert made.value["Present"] == pytest.approx(0.5 + made.t)


def test_the_page_follows_a_weight_that_is_chosen(page: Offscreen, rig: Rig) -> None:
    app, compare = page.app, page.app.lab.compare
    app.pose = Pose.between("neutral", "sad", 0.5, "cosine")
    page.frames(2)
    for y in range(170, 300, 8):
        page.click(1190, y)
        page.frames(2)
        if compare.follows == "A weight":
            break
    page.until(lambda: compare.paths is not None)
    assert compare.shape == "sad"
    assert compare.paths.value["Linear"] == pytest.approx(compare.paths.t)
    before = page.pixels_now().copy()
    first = compare.paths
    app.controls = replace(app.controls, facs={12: Sides.both(0.4)})
    compare.shape = "AU12"
    page.until(lambda: compare.paths is not first)
    page.frames(2)
    assert compare.paths.value["Present"] == pytest.approx(0.4)
    assert np.abs(page.pixels_now().astype(int) - before)[300:740, 920:].max() > 40
    assert set(comparing.shapes_now(app, rig)) >= {"happy", "sad", "AU12"}
    assert "AU1" not in comparing.shapes_now(app, rig)
    app.controls = replace(app.controls, facs={})
    page.frames(2)
    assert compare.shape == "sad"


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize("values", [[1.0, 2.0, 5.0], [3.0, 3.0, 3.0], [0.001, np.nan, 0.1], [np.nan] * 3])
def test_no_line_reaches_the_legend_or_leaves_the_plot(values: list[float], logarithmic: bool) -> None:
    t = np.arange(3.0)
    low, high = plots._limits((plots.Line("a", t, np.array(values)),), 0.25, logarithmic=logarithmic)
    scale = np.log10 if logarithmic else np.asarray
    height = [(scale(v) - scale(low)) / (scale(high) - scale(low)) for v in values if np.isfinite(v)]
    assert low < high
    assert all(0.0 < part < 0.75 for part in height)
