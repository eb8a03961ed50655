"""Handles on the face, driven by fed mouse events: set, dragged, mirrored, held, kept, saved, rebuilt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.deform.handles import Handle, HandleSet
from facemorph.deform.rebuild import rebuilt
from facemorph.ui import actions, handles, rebuilding
from facemorph.ui.on_screen import on_axis, on_view_plane, projected, shown_places
from tests.ui.harness import Offscreen

FACE = (450, 380)


@pytest.fixture
def page(window: Offscreen) -> Offscreen:
    """The window with the page Handles on show and mirroring off."""
    actions.show_page(window.app, "Handles")
    window.app.lab.handles.mirror = False
    window.frames(3)
    return window


def on_screen(window: Offscreen, vertex: int) -> tuple[float, float]:
    places, _ = projected(window.app, shown_places(window.app, [vertex]))
    return float(places[0, 0]), float(places[0, 1])


def test_a_click_sets_a_point_at_the_nearest_vertex_and_moves_nothing(page: Offscreen) -> None:
    before = page.app.camera
    page.click(*FACE)
    (handle,) = page.app.controls.handles.handles
    assert np.hypot(*np.subtract(on_screen(page, handle.vertex), FACE)) < 40
    assert handle == Handle(handle.vertex)
    assert page.app.lab.handles.selected == handle.vertex
    assert page.app.camera == before
    page.key("Z", ctrl=True)
    assert page.app.controls.handles.handles == ()


def test_the_mouse_turns_the_face_where_it_hits_no_point(page: Offscreen) -> None:
    azimuth = page.app.camera.azimuth_deg
    page.drag(FACE, (FACE[0] + 100, FACE[1]))
    assert page.app.camera.azimuth_deg != azimuth
    assert page.app.controls.handles.handles == ()


def test_a_dragged_point_stays_under_the_pointer_and_is_one_step_of_undo(page: Offscreen) -> None:
    page.click(*FACE)
    (handle,) = page.app.controls.handles.handles
    start = on_screen(page, handle.vertex)
    page.drag(start, (start[0] + 40, start[1] - 30))
    moved = page.app.controls.handles.handles[0].moved
    assert moved[0] > 0.2
    assert moved[1] > 0.2
    assert on_screen(page, handle.vertex) == pytest.approx((start[0] + 40, start[1] - 30), abs=0.5)
    page.key("Z", ctrl=True)
    assert page.app.controls.handles.handles == (handle,)
    page.key("Z", ctrl=True, shift=True)
    assert page.app.controls.handles.handles[0].moved == moved


def test_an_arrow_moves_along_its_axis_alone(page: Offscreen) -> None:
    page.click(*FACE)
    start = on_screen(page, page.app.controls.handles.handles[0].vertex)
    page.drag((start[0] + 40, start[1]), (start[0] + 80, start[1] + 30))
    x, y, z = page.app.controls.handles.handles[0].moved
    assert x > 0.2
    assert (y, z) == (0.0, 0.0)


def test_a_twin_is_set_and_moves_in_the_mirror(page: Offscreen) -> None:
    page.app.lab.handles.mirror = True
    page.click(FACE[0] + 90, FACE[1])
    first, second = page.app.controls.handles.handles
    positions = page.app.rig.neutral.positions
    assert positions[first.vertex] * (-1, 1, 1) == pytest.approx(positions[second.vertex], abs=0.5)
    start = on_screen(page, first.vertex)
    page.drag(start, (start[0] + 30, start[1] + 20))
    (a, b, c), other = (h.moved for h in page.app.controls.handles.handles)
    assert other == (-a, b, c)
    page.click(*on_screen(page, first.vertex), 1)
    assert page.app.controls.handles.handles == ()


def test_an_anchor_cannot_be_dragged_and_delete_takes_it_away(page: Offscreen) -> None:
    page.app.lab.handles.sets = "Set anchors"
    page.click(*FACE)
    (anchor,) = page.app.controls.handles.handles
    assert anchor.anchor
    start = on_screen(page, anchor.vertex)
    page.drag(start, (start[0] + 50, start[1]))
    assert page.app.controls.handles.handles == (anchor,)
    page.io.add_key_event(handles_key(), True)
    page.frame()
    page.io.add_key_event(handles_key(), False)
    page.frame()
    assert page.app.controls.handles.handles == ()


def handles_key() -> object:
    from imgui_bundle import imgui

    return imgui.Key.delete


def test_a_new_point_keeps_the_face_as_it_is(page: Offscreen) -> None:
    page.click(*FACE)
    vertex = page.app.controls.handles.handles[0].vertex
    handles.move(page.app, vertex, None, np.array([0.0, 1.0, 0.5]))
    page.frame()
    near = int(
        np.argsort(
            np.linalg.norm(page.app.rig.neutral.positions - page.app.rig.neutral.positions[vertex], axis=1)
        )[30]
    )
    before = page.app.scene().offsets[near].copy()
    handles.place(page.app, near)
    page.frame()
    assert page.app.scene().offsets[near] == pytest.approx(before, abs=1e-4)
    assert np.abs(before).max() > 0.1


def test_a_singular_set_of_points_is_told_and_nothing_is_lost(page: Offscreen) -> None:
    app = page.app
    # The ball's pole is many vertices at one place.
    points = HandleSet((Handle(0, (0.0, 1.0, 0.0)), Handle(1), Handle(600)))
    app.controls = replace(app.controls, handles=points)
    page.frames(2)
    assert "handles" in app.controls.off
    assert "at one place" in app.messages.shown[-1].text
    assert app.controls.handles is points
    # Setting one by hand is refused in the first place.
    app.controls = replace(app.controls, handles=HandleSet((Handle(0),)), off=frozenset())
    handles.place(app, 1)
    assert app.controls.handles.handles == (Handle(0),)


def test_what_the_points_do_is_kept_as_a_shape(page: Offscreen) -> None:
    app = page.app
    page.click(*FACE)
    vertex = app.controls.handles.handles[0].vertex
    handles.move(app, vertex, None, np.array([0.3, 0.5, 1.0]))
    page.frame()
    before, camera = app.scene().positions(app.rig), app.camera
    handles.keep_as_shape(app, "Wide  nose")
    page.frames(2)
    assert app.rig.shapes[-1].label == "Wide nose"
    assert app.rig.shapes[-1].set == "made"
    assert handles.at_rest(app)
    assert app.scene().positions(app.rig) == pytest.approx(before, abs=1e-4)
    page.key("Z", ctrl=True)
    assert "Wide_nose" not in app.rig.names
    assert app.controls.handles.handles[0].moved == (0.3, 0.5, 1.0)
    assert app.camera == camera


def test_points_are_saved_and_opened_through_the_chooser(page: Offscreen, tmp_path: Path) -> None:
    app = page.app
    page.click(*FACE)
    handles.move(app, app.controls.handles.handles[0].vertex, None, np.array([0.0, 0.0, 1.0]))
    kept = app.controls.handles
    app.settings.last_folder = str(tmp_path)
    actions.ask_for(app, "save points")
    page.frames(3)
    page.key("enter")
    (saved,) = tmp_path.glob("*.json")
    handles.clear(app)
    handles.load(app, saved)
    assert app.controls.handles == kept
    saved.write_text("{}")
    handles.load(app, saved)
    assert app.controls.handles == kept
    assert "no file of points" in app.messages.shown[-1].text


def test_the_face_shows_the_rebuilt_expression_and_its_error(page: Offscreen, rig: Rig) -> None:
    app = page.app
    rebuild = app.lab.rebuild
    rebuild.on, rebuild.target, rebuild.count = True, "sad", 20
    page.until(lambda: rebuild.result is not None)
    page.frames(2)
    true = rig.positions(Pose.of({"sad": 1.0}))
    again = rebuilt(rig, rig.neutral.positions, true, np.array(rebuild.vertices, np.int32))
    assert app.scene().positions(rig) == pytest.approx(again.positions, abs=1e-4)
    assert app.scene().reference == pytest.approx(true)
    assert rebuild.result.rms_percent == pytest.approx(again.rms_percent)
    assert app.legend is not None
    actions.show_page(app, "Shapes")
    page.frames(3)
    assert app.scene().reference is None
    assert app.legend is None


def test_more_points_rebuild_better_whatever_the_kernel(rig: Rig) -> None:
    done: list[float] = []
    result = rebuilding.swept(
        rig, rig.neutral.positions, rig.positions({"happy": 1.0}), None, lambda part, words: done.append(part)
    )
    assert done == sorted(done)
    for errors in result.errors.values():
        assert errors[-1] < 0.5 * errors[0]


def test_the_sweep_is_drawn_with_its_plots(page: Offscreen) -> None:
    rebuild = page.app.lab.rebuild
    rebuild.on = True
    page.frames(2)
    rebuilding.sweep(page.app, page.app.rig)
    page.until(lambda: rebuild.sweep is not None)
    before = page.pixels_now().copy()
    rebuild.swept = ()
    page.frames(2)
    assert np.abs(page.pixels_now().astype(int) - before)[400:740, 920:].max() > 40


def test_a_place_on_the_view_plane_is_seen_where_the_pointer_is(page: Offscreen) -> None:
    app = page.app
    app.camera = app.camera.orbited(25.0, 10.0)
    point = np.array([1.0, 2.0, 7.0])
    there = on_view_plane(app, point, 500.0, 300.0)
    assert projected(app, there[None])[0][0] == pytest.approx([500.0, 300.0])
    assert (there - point) @ app.camera.axes()[2] == pytest.approx(0.0, abs=1e-9)
    axis = np.array([0.0, 1.0, 0.0])
    seen = projected(app, (point + 1.7 * axis)[None])[0][0]
    assert on_axis(app, point, axis, *seen) == pytest.approx(1.7)


def test_the_pages_switches_and_kernels_are_hit_by_the_mouse(page: Offscreen) -> None:
    app = page.app
    app.lab.handles.mirror = False
    assert click_down(page, lambda: app.lab.handles.mirror)
    assert app.lab.handles.sets == "Set anchors"
    low = click_down(page, lambda: app.controls.handles.kernel == "multiquadric")
    # Below the kernels stands the switch that lets c be set by hand.
    page.click(1246, low + 35)
    assert app.controls.handles.c is not None
    assert app.controls.handles.c > 0.0


def click_down(page: Offscreen, happened: Callable[[], bool]) -> int:
    """Click down the page's right side until something has happened; gives where."""
    for y in range(112, 400, 10):
        page.click(1246, y)
        page.frames(2)
        if happened():
            return y
    raise AssertionError("nothing there does it")


def test_while_an_expression_is_rebuilt_the_mouse_turns_the_face_and_sets_nothing(page: Offscreen) -> None:
    rebuild = page.app.lab.rebuild
    rebuild.on = True
    page.until(lambda: rebuild.result is not None)
    azimuth = page.app.camera.azimuth_deg
    page.click(*FACE)
    page.drag(FACE, (FACE[0] + 60, FACE[1]))
    assert page.app.controls.handles.handles == ()
    assert page.app.camera.azimuth_deg != azimuth


def test_a_target_that_does_not_move_is_no_mystery(page: Offscreen) -> None:
    rebuild = page.app.lab.rebuild
    rebuild.on, rebuild.target = True, "happy"
    rebuild.source = "happy"
    page.until(lambda: rebuild.result is not None)
    page.frames(2)
    assert rebuild.result.max_percent == pytest.approx(0.0, abs=1e-6)


def test_commands_put_points_to_rest_and_take_them_away(page: Offscreen) -> None:
    app = page.app
    page.click(*FACE)
    vertex = app.controls.handles.handles[0].vertex
    handles.move(app, vertex, None, np.array([0.0, 1.0, 0.0]))
    page.run("Handles: reset")
    assert app.controls.handles.handles == (Handle(vertex),)
    page.run("Handles: clear")
    assert app.controls.handles.handles == ()


def test_points_that_cannot_be_written_are_told_and_stay(window: Offscreen, tmp_path: Path) -> None:
    app = window.app
    handles.change(app, HandleSet((Handle(0),)))
    (tmp_path / "taken").write_text("a file, no folder")
    handles.save(app, tmp_path / "taken" / "points.json")
    assert any("The points were not saved" in message.text for message in app.messages.shown)
    assert app.controls.handles.handles == (Handle(0),)
