"""Regions and the brush, driven by fed mouse events."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.rig import Regions, Rig
from facemorph.deform.regions import RegionControl, RegionSet
from facemorph.io import write_regions
from facemorph.ui import actions, regions
from facemorph.ui.state import Face
from tests.ui.harness import Offscreen, ball_rig

FACE = (450, 380)


@pytest.fixture(scope="module")
def parted() -> Rig:
    """The ball with an upper and a lower half that meet softly."""
    ball = ball_rig()
    upper = np.clip(ball.neutral.positions[:, 1] / 6.0 + 0.5, 0.0, 1.0)
    weights = np.round(np.stack([upper, 1.0 - upper]) * 255.0)
    weights[1] = 255.0 - weights[0]
    return replace(ball, regions=Regions(("brows", "jaw"), weights.astype(np.uint8)))


@pytest.fixture
def page(window: Offscreen, parted: Rig) -> Offscreen:
    window.app.arriving = Face(parted, ("ball",), builtin=True)
    window.frames(2)
    actions.show_page(window.app, "Regions")
    window.frames(3)
    return window


def find_row(page: Offscreen, name: str) -> tuple[float, float]:
    """A place on the slider of a region, found by moving over the page until that region lights up."""
    for y in range(90, 700, 8):
        page.move(1100, y)
        page.frames(1)
        lit = page.app.on_face.glow
        if lit is not None and lit is regions.light(page.app, name):
            return 1100.0, y + 12.0
    raise AssertionError(f"no row for {name}")


def test_a_regions_slider_moves_that_region_alone_and_is_one_step(page: Offscreen) -> None:
    app, rig = page.app, page.app.rig
    x, y = find_row(page, "brows")
    page.drag((x, y), (x + 60, y))
    kept = app.controls.regions["brows"]
    assert set(app.controls.regions) == {"brows"}
    assert 0.2 < kept.t < 1.0
    offsets = app.scene().offsets
    share = rig.regions.weights[0].astype(np.float32)[:, None] / 255.0
    delta = rig.deltas[rig.names.index("happy")]
    assert offsets == pytest.approx(share * delta * kept.t, abs=1e-4)
    page.key("Z", ctrl=True)
    assert not app.controls.regions


def test_hovering_a_region_lights_it_up(page: Offscreen) -> None:
    page.move(*find_row(page, "jaw"))
    page.frames(2)
    assert page.app.scene().glow == pytest.approx(page.app.rig.regions.weights[1] / 255.0, abs=1e-6)
    page.move(*FACE)
    page.frames(2)
    assert page.app.scene().glow is None


def test_all_regions_alike_are_the_global_morph(page: Offscreen, parted: Rig) -> None:
    # The first row of the page below the brush's switch is that of all.
    page.drag((1100, find_row(page, "brows")[1] - 78), (1130, find_row(page, "brows")[1] - 78))
    kept = page.app.controls.regions
    assert set(kept) == {"brows", "jaw"}
    t = kept["jaw"].t
    assert t == kept["brows"].t
    assert t > 0.1
    assert page.app.scene().positions(parted) == pytest.approx(parted.positions({"happy": t}), abs=1e-4)


def test_a_region_turns_about_the_pivot_that_is_shown(page: Offscreen) -> None:
    app = page.app
    app.lab.regions.opened = "brows"
    before = page.pixels_now().copy()
    page.frames(3)
    assert np.abs(page.pixels_now().astype(int) - before)[60:700, 100:880].max() > 60
    regions.change(app, {"brows": RegionControl(turn_deg=(0.0, 0.0, 20.0))})
    page.frames(2)
    assert regions.moves(app.controls.regions["brows"])
    assert np.abs(app.scene().offsets).max() > 0.5
    regions.reset_one(app, "brows")
    assert regions.at_rest(app)


def test_a_stroke_paints_both_sides_and_is_one_step_of_undo(page: Offscreen, parted: Rig) -> None:
    app = page.app
    app.lab.regions.painting, app.lab.regions.region = True, "jaw"
    page.frames(3)
    camera = app.camera
    page.drag((FACE[0] + 60, 230), (FACE[0] + 110, 240), steps=10)
    assert app.camera == camera
    painted = app.painted
    assert painted is not None
    gained = painted.weights[1] - parted.regions.weights[1] / 255.0
    x = parted.neutral.positions[:, 0]
    assert gained[x > 0.5].max() > 0.3
    assert gained[x < -0.5].max() == pytest.approx(gained[x > 0.5].max(), abs=0.15)
    assert painted.weights.sum(axis=0).max() <= 1.0 + 1e-5
    page.key("Z", ctrl=True)
    assert app.painted is None
    page.key("Z", ctrl=True, shift=True)
    assert app.painted is painted


def test_the_brush_takes_away_what_it_is_told_to(page: Offscreen, parted: Rig) -> None:
    app = page.app
    app.lab.regions.painting, app.lab.regions.region, app.lab.regions.takes = True, "brows", True
    page.frames(3)
    page.drag((FACE[0], 230), (FACE[0] + 40, 230))
    lost = parted.regions.weights[0] / 255.0 - app.painted.weights[0]
    assert lost.max() > 0.3
    assert lost.min() > -1e-3


def test_a_face_without_regions_gets_painted_ones(window: Offscreen) -> None:
    app = window.app
    actions.show_page(app, "Regions")
    app.lab.regions.painting = True
    window.frames(3)
    assert regions.region_set(app) is None
    window.drag(FACE, (FACE[0] + 40, FACE[1]))
    assert app.painted.names == regions.NAMES
    assert app.painted.weights[0].max() > 0.3
    regions.change(app, {"brows": RegionControl(target={"happy": 1.0}, shift=(0.0, 1.0, 0.0))})
    window.frames(2)
    assert np.abs(app.scene().offsets).max() > 0.2


def test_beside_the_face_the_brush_turns_it(page: Offscreen) -> None:
    page.app.lab.regions.painting = True
    page.frames(3)
    azimuth = page.app.camera.azimuth_deg
    page.drag((60, 700), (160, 700))
    assert page.app.camera.azimuth_deg != azimuth
    assert page.app.painted is None


def chosen_in_chooser(page: Offscreen, purpose: str, path: Path) -> None:
    """Ask for a file and type its path."""
    actions.ask_for(page.app, purpose)
    page.frames(3)
    page.key("A", ctrl=True)
    page.type(str(path))
    page.key("enter")
    page.frames(2)


def test_painted_regions_are_saved_and_opened_through_the_chooser(page: Offscreen, tmp_path: Path) -> None:
    app = page.app
    app.lab.regions.painting, app.lab.regions.region = True, "jaw"
    page.frames(3)
    page.drag((FACE[0] + 60, 230), (FACE[0] + 110, 240), steps=10)
    painted = app.painted.weights.copy()
    chosen_in_chooser(page, "save regions", tmp_path / "mine")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.npz"]
    regions.use(app, None)
    page.frames(2)
    chosen_in_chooser(page, "open regions", tmp_path / "mine.npz")
    assert np.array_equal(app.painted.weights, painted)
    page.key("Z", ctrl=True)
    assert app.painted is None
    page.key("Z", ctrl=True, shift=True)
    assert np.array_equal(app.painted.weights, painted)


def test_saving_regions_over_a_file_asks_first(page: Offscreen, tmp_path: Path) -> None:
    (tmp_path / "mine.npz").write_text("of somebody's")
    chosen_in_chooser(page, "save regions", tmp_path / "mine.npz")
    assert (tmp_path / "mine.npz").read_text() == "of somebody's"
    assert page.app.chooser.replacing == str(tmp_path / "mine.npz")
    page.app.chooser.fresh = True  # as a click into the field
    page.frames(3)
    page.key("enter")
    page.frames(2)
    assert page.app.chooser.purpose == ""
    assert (tmp_path / "mine.npz").read_bytes()[:2] == b"PK"


def test_regions_of_other_names_take_the_place_of_the_faces_own(page: Offscreen, tmp_path: Path) -> None:
    app, rig = page.app, page.app.rig
    whole = np.ones((1, rig.neutral.vertex_count), np.float32)
    write_regions(tmp_path / "head.npz", RegionSet(rig, ("head",), whole), rig)
    regions.change(app, {"brows": RegionControl(target={"happy": 1.0}, t=1.0)})
    page.frames(2)
    regions.load(app, tmp_path / "head.npz")
    page.frames(2)
    assert regions.names(app) == ("head",)
    assert not app.controls.regions
    assert app.controls.on("regions")
    x, y = find_row(page, "head")
    page.drag((x, y), (x + 60, y))
    t = app.controls.regions["head"].t
    assert t > 0.2
    assert app.scene().positions(rig) == pytest.approx(rig.positions({"happy": t}), abs=1e-4)
    page.key("Z", ctrl=True)
    page.key("Z", ctrl=True)
    assert app.controls.regions["brows"].t == 1.0
    assert regions.names(app) == ("brows", "jaw")


def test_a_damaged_file_of_regions_is_told_and_changes_nothing(page: Offscreen, tmp_path: Path) -> None:
    app = page.app
    (tmp_path / "bad.npz").write_text("no")
    regions.change(app, {"brows": RegionControl(shift=(0.0, 1.0, 0.0))})
    before = app.snapshot()
    chosen_in_chooser(page, "open regions", tmp_path / "bad.npz")
    assert "bad.npz" in app.messages.shown[-1].text
    assert app.painted is before.painted
    assert app.controls == before.controls


def test_the_pages_buttons_ask_for_a_file(page: Offscreen) -> None:
    asked = set()
    for y in range(110, 200, 10):
        for x in (1090, 1220):
            page.click(x, y)
            page.frames(2)
            asked.add(page.app.chooser.purpose)
            page.app.chooser.purpose = ""
            page.frames(2)
    assert {"open regions", "save regions"} <= asked


def test_commands_put_regions_to_rest_and_take_the_paint_off(page: Offscreen, parted: Rig) -> None:
    app = page.app
    regions.use(app, RegionSet(parted, ("brows",), np.ones((1, parted.neutral.vertex_count), np.float32)))
    regions.change(app, {"brows": RegionControl(shift=(0.0, 1.0, 0.0))})
    page.run("Regions: reset")
    assert not app.controls.regions
    assert app.painted is not None
    page.run("Regions: unpaint")
    assert app.painted is None
