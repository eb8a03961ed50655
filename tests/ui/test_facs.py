"""The FACS page: sliders, sides, prototypes and units as text, driven by fed events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from imgui_bundle import imgui

from facemorph.core.facs import PROTOTYPES, Sides, units_text
from facemorph.core.pose import Pose
from facemorph.deform.handles import Handle, HandleSet
from facemorph.deform.sides import SidedUnits
from facemorph.ui import actions, handles, units
from facemorph.ui.commands import commands
from tests.ui.harness import Offscreen, ball_rig

WEIGHT = st.floats(-1, 2).filter(lambda weight: abs(weight) > 0.01)
FIRST_SLIDER = (1105, 299)
TAB_FACS = (1091, 54)


@pytest.fixture
def window(opengl: None) -> Iterator[Offscreen]:
    rig = ball_rig(facs=("AU1", "AU2", "AU4", "AU6", "AU12", "AU15"))
    with Offscreen(rig) as screen:
        screen.click(*TAB_FACS)
        yield screen


def test_a_click_on_a_tab_shows_its_page_and_is_remembered(window: Offscreen) -> None:
    assert window.app.settings.right_page == "FACS"


def test_a_units_slider_moves_the_face_and_a_drag_is_one_step_of_undo(window: Offscreen) -> None:
    window.drag(FIRST_SLIDER, (FIRST_SLIDER[0] + 40, FIRST_SLIDER[1]))
    ((number, sides),) = window.app.controls.facs.items()
    assert number == 1
    assert sides.left == sides.right > 0.1
    rig = window.app.rig
    assert rig is not None
    shown = window.app.scene().positions(rig)
    np.testing.assert_allclose(shown, rig.positions({"AU1": sides.left}), atol=1e-5)
    window.key("Z", ctrl=True)
    assert window.app.controls.facs == {}


def test_a_prototype_sets_its_units_in_place_of_others(window: Offscreen) -> None:
    units.set_unit(window.app, 2, Sides.both(0.5))
    units.set_prototype(window.app, "happy")
    assert window.app.controls.facs == {6: Sides.both(1.0), 12: Sides.both(1.0)}


def test_what_is_copied_can_be_pasted_again(window: Offscreen) -> None:
    made = {1: Sides.both(0.4), 12: Sides(1.0, 0.25)}
    units.set_units(window.app, made)
    units.copy_units(window.app)
    assert imgui.get_clipboard_text() == "AU1(0.4)+L12+R12(0.25)"
    units.reset_units(window.app)
    units.paste_units(window.app)
    assert window.app.controls.facs == made


def positions(window: Offscreen) -> np.ndarray:
    return window.app.scene().positions(window.app.rig)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=20, deadline=None)
@given(
    page=st.dictionaries(st.sampled_from((1, 2, 12)), st.builds(Sides, WEIGHT, WEIGHT)),
    shapes=st.dictionaries(st.sampled_from(("AU2", "AU12", "AU15")), WEIGHT),
)
def test_a_face_made_of_units_alone_comes_back_from_its_text(
    window: Offscreen, page: dict[int, Sides], shapes: dict[str, float]
) -> None:
    app = window.app
    units.set_units(app, page)
    app.pose = Pose(target=app.pose.target, weights=shapes)
    before, text = positions(window), units_text(units.shown_units(app))
    assert units.beside_units(app) == ""
    actions.reset_face(app)
    assert np.array_equal(positions(window), app.rig.neutral.positions)
    units.set_text(app, text)
    np.testing.assert_allclose(positions(window), before, atol=2e-5)


def test_a_unit_set_on_both_pages_is_copied_once(window: Offscreen) -> None:
    app = window.app
    units.set_units(app, {12: Sides(0.5, 0.25)})
    app.pose = Pose.of({"AU12": 0.25, "AU4": 1.0, "AU6": 1e-5})
    units.copy_units(app)
    assert imgui.get_clipboard_text() == "AU4+L12(0.75)+R12(0.5)"
    assert app.messages.shown[-1].text == "Copied AU4+L12(0.75)+R12(0.5)"


def test_what_no_unit_says_is_told_and_not_dropped_in_silence(window: Offscreen) -> None:
    app = window.app
    app.pose = replace(Pose.between("neutral", "happy", 0.4), weights={"AU4": 1.0, "jawOpen": 0.2})
    handles.change(app, HandleSet(tuple(Handle(v, (0.0, 0.0, v / 900)) for v in (100, 300, 500, 900))))
    units.copy_units(app)
    assert imgui.get_clipboard_text() == "AU4"
    assert app.messages.shown[-1].text == (
        "Copied AU4. No unit says the rest: Happy 40 %, JawOpen 20 %, handles."
    )
    assert "Happy 40 %, JawOpen 20 %, handles" in units.copy_help(app)
    app.controls = replace(app.controls, off=frozenset({"handles"}))
    assert units.beside_units(app) == "Happy 40 %, JawOpen 20 %"


def test_what_is_switched_off_makes_up_no_part_of_the_face(window: Offscreen) -> None:
    app = window.app
    units.set_units(app, {12: Sides.both(1.0)})
    app.pose = Pose.of({"AU4": 1.0})
    app.shapes_on = False
    assert units_text(units.shown_units(app)) == "AU12"
    app.shapes_on = True
    actions.toggle_method(app, "facs")
    assert units_text(units.shown_units(app)) == "AU4"


def test_a_face_without_units_leaves_the_clipboard_and_says_why(window: Offscreen) -> None:
    imgui.set_clipboard_text("kept")
    window.app.pose = Pose.between("neutral", "happy", 1.0)
    units.copy_units(window.app)
    assert imgui.get_clipboard_text() == "kept"
    assert window.app.messages.shown[-1].text == (
        "The face is made of no FACS units. No unit says the rest: Happy."
    )


def test_text_that_is_no_units_changes_nothing_and_says_why(window: Offscreen) -> None:
    units.set_unit(window.app, 1, Sides.both(0.5))
    units.set_text(window.app, "AU1+smile")
    window.frames(2)
    assert window.app.controls.facs == {1: Sides.both(0.5)}
    assert "smile" in window.app.messages.shown[-1].text


def test_balance_and_weight_lead_to_the_sides_and_back() -> None:
    for sides in (Sides(0.8, 0.8), Sides(0.8, 0.2), Sides(0.0, 0.5), Sides(-0.4, -0.1)):
        weight, balance = units.split(sides)
        again = units.joined(weight, balance)
        assert (again.left, again.right) == pytest.approx((sides.left, sides.right))


def test_one_side_alone_moves_that_side(window: Offscreen) -> None:
    units.set_unit(window.app, 12, Sides(1.0, 0.0))
    rig = window.app.rig
    assert rig is not None
    expected = SidedUnits(rig)({12: Sides(1.0, 0.0)}).positions(rig, Pose())
    np.testing.assert_allclose(window.app.scene().positions(rig), expected - 0, atol=1e-4)


def test_switched_off_the_page_moves_nothing_and_keeps_its_units(window: Offscreen) -> None:
    units.set_unit(window.app, 12, Sides.both(1.0))
    window.click(980, 124)
    rig = window.app.rig
    assert rig is not None
    np.testing.assert_array_equal(window.app.scene().positions(rig), rig.neutral.positions)
    assert window.app.controls.facs == {12: Sides.both(1.0)}


def test_a_hovered_slider_lights_up_what_it_moves(window: Offscreen) -> None:
    window.move(*FIRST_SLIDER)
    window.frames(2)
    assert window.app.scene().glow is not None
    window.move(450, 300)
    window.frames(2)
    assert window.app.scene().glow is None


def test_resetting_the_face_puts_the_methods_to_rest_too(window: Offscreen) -> None:
    units.set_unit(window.app, 12, Sides.both(1.0))
    window.run("Reset face")
    assert window.app.controls.facs == {}


def test_every_prototype_and_the_text_have_commands(window: Offscreen) -> None:
    app = window.app
    window.run("FACS: happy")
    assert app.controls.facs == {6: Sides.both(1.0), 12: Sides.both(1.0)}
    window.run("FACS: copy units")
    window.run("FACS: reset")
    assert app.controls.facs == {}
    window.run("FACS: paste units")
    assert app.controls.facs == {6: Sides.both(1.0), 12: Sides.both(1.0)}
    titles = {command.title for command in commands(app)}
    assert {f"FACS: {emotion}" for emotion in PROTOTYPES} <= titles


def test_a_prototype_of_which_the_face_has_nothing_cannot_be_run(opengl: None) -> None:
    with Offscreen(ball_rig(facs=("AU12",))) as window:
        able = {
            c.title for c in commands(window.app) if c.title.startswith("FACS: ") and c.enabled(window.app)
        }
        assert able == {"FACS: happy", "FACS: copy units", "FACS: paste units"}
