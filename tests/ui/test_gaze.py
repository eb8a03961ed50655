"""The gaze pad, and correctives switched off and on, by fed events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.correctives import Corrective
from facemorph.core.pose import Pose
from facemorph.core.rig import Shape
from facemorph.ui import actions, gaze
from facemorph.ui.commands import commands
from tests.ui.harness import Offscreen, ball_rig

# The pad is the first thing of the list where a face has the gaze's units alone.
PAD = (982, 352)


@pytest.fixture
def window(opengl: None) -> Iterator[Offscreen]:
    with Offscreen(ball_rig(facs=("AU61", "AU62", "AU63", "AU64"))) as screen:
        actions.show_page(screen.app, "FACS")
        screen.frames(3)
        yield screen


def test_a_drag_on_the_pad_turns_the_eyes_and_is_one_step_of_undo(window: Offscreen) -> None:
    window.drag(PAD, (PAD[0] + 30, PAD[1] - 16))
    x, y = gaze.place(window.app)
    assert x > 0.2
    assert y > 0.2
    assert set(window.app.controls.facs) == {61, 63}
    window.key("Z", ctrl=True)
    assert window.app.controls.facs == {}


def test_opposite_units_are_never_on_together_and_ahead_is_at_rest(window: Offscreen) -> None:
    for place, numbers in (((0.5, -0.4), {61, 64}), ((-3.0, 0.2), {62, 63}), ((0.0, 0.0), set())):
        gaze.look(window.app, *place)
        assert set(window.app.controls.facs) == numbers
    gaze.look(window.app, -3.0, 0.0)
    assert gaze.place(window.app) == (-1.0, 0.0)


def test_correctives_can_be_switched_off_and_the_step_undone(opengl: None) -> None:
    rig = ball_rig(facs=("AU1", "AU2"))
    shapes = (*rig.shapes, Shape("both", "Both", "corrective"))
    deltas = np.concatenate([rig.deltas, rig.deltas[-1:] * np.float32(0.5)])
    rig = replace(rig, shapes=shapes, deltas=deltas, correctives=(Corrective("both", ("AU1", "AU2")),))
    with Offscreen(rig) as screen:
        app = screen.app
        app.pose = Pose.of({"AU1": 1.0, "AU2": 1.0})
        screen.frames(3)
        command = next(c for c in commands(app) if c.title == "Correctives")
        assert command.enabled(app)
        assert command.checked is not None
        assert command.checked(app)
        bent = app.scene().positions(app.rig)
        command.run(app)
        screen.frames(2)
        straight = app.scene().positions(app.rig)
        assert not np.allclose(bent, straight)
        assert np.allclose(screen.session.renderer.positions(), straight, atol=1e-5)
        assert app.history.undo_words == "correctives off"
        screen.key("Z", ctrl=True)
        screen.frames(2)
        assert np.array_equal(app.scene().positions(app.rig), bent)
