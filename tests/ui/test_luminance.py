"""Equal luminance in the window: a still face has it, a moving one keeps its light, a saved one has it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.gl.luminance import mean_luminance
from facemorph.ui import files
from facemorph.ui.commands import commands
from facemorph.ui.panels.palette import ranked
from tests.ui.harness import Offscreen

FACE = (300, 300)
SLIDER = (172, 722)


def shown_luminance(window: Offscreen) -> float:
    """Of the face as drawn last."""
    renderer = window.session.renderer
    pixels = renderer.read()
    found = mean_luminance(pixels, renderer.skin_pixels())  # type: ignore[attr-defined]
    window.session._drawn = ()  # the mask took the picture's place
    return found


def on(window: Offscreen, luminance: float = 0.25) -> None:
    window.app.settings.luminance = luminance
    window.run("Equal luminance")


def test_every_light_gives_the_luminance_that_was_asked_for(window: Offscreen) -> None:
    before = shown_luminance(window)
    assert abs(before / 0.12 - 1.0) > 0.05
    on(window, 0.12)
    for light in ("Flat light", "Window light", "Studio light"):
        window.run(light)
        assert shown_luminance(window) == pytest.approx(0.12, rel=0.01), light
    window.run("Equal luminance")
    assert shown_luminance(window) == pytest.approx(before, rel=1e-6)


def test_the_strip_sets_how_bright_and_takes_it_away(window: Offscreen) -> None:
    on(window)
    window.frames(3)
    window.drag(SLIDER, (SLIDER[0] - 20, SLIDER[1]))
    aimed = window.app.settings.luminance
    assert 0.02 < aimed < 0.2
    assert shown_luminance(window) == pytest.approx(aimed, rel=0.01)
    window.click(SLIDER[0], SLIDER[1], 1)
    assert window.app.settings.luminance == 0.25
    window.click(293, SLIDER[1])
    assert not window.app.settings.equal_luminance


def test_a_turning_face_keeps_its_light_until_it_stands_still(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    on(window)
    window.frames(3)
    drawn: list[tuple[str, float]] = []
    draw = window.session.renderer.draw

    def seen(*args: object, **options: object) -> None:
        if "exactly" not in options:
            drawn.append((str(options["quality"]), args[2].exposure))  # type: ignore[attr-defined]
        draw(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(window.session.renderer, "draw", seen)
    window.drag(FACE, (FACE[0] + 160, FACE[1]))
    window.frames(3)
    moving = {exposure for quality, exposure in drawn if quality == "fast"}
    assert len(moving) == 1
    assert drawn[-1][0] == "full"
    assert shown_luminance(window) == pytest.approx(0.25, rel=0.01)


def test_expressions_keep_the_neutrals_light_or_have_their_own(window: Offscreen) -> None:
    on(window)
    exposures = []
    for each in (False, True):
        window.app.settings.luminance_of = "picture" if each else "face"
        for t in (0.0, 1.0):
            window.app.pose = replace(window.app.pose, t=t)
            window.frames(3)
            exposures.append(window.session._exposing._exposure)
    assert exposures[0] == exposures[1]
    assert exposures[2] == pytest.approx(exposures[0], rel=0.01)
    assert exposures[3] != exposures[2]
    assert shown_luminance(window) == pytest.approx(0.25, rel=0.01)


def test_a_saved_picture_has_it(window: Offscreen, tmp_path: Path) -> None:
    on(window, 0.3)
    files.save_picture(window.app, tmp_path / "stimulus.png")
    window.until(lambda: (tmp_path / "stimulus.png").is_file())
    pixels = np.asarray(Image.open(tmp_path / "stimulus.png").convert("RGBA"))
    where = window.session.renderer.skin_pixels()  # type: ignore[attr-defined]
    assert mean_luminance(pixels, where) == pytest.approx(0.3, rel=0.005)


def test_shadings_without_light_are_left_alone(window: Offscreen) -> None:
    for shading in ("Normals", "Heat map", "Wireframe"):
        window.run(shading)
        window.frames(3)
        before = window.session.renderer.read().copy()
        on(window)
        window.frames(2)
        assert np.array_equal(window.session.renderer.read(), before), shading
        assert window.app.luminance_problem == ""
        window.run("Equal luminance")


def test_where_no_skin_is_to_be_seen_it_is_said_and_a_picture_saved_with_a_warning(
    window: Offscreen, tmp_path: Path
) -> None:
    on(window)
    face = window.app.camera
    window.app.camera = face.panned(5.0, 0.0)
    window.frames(3)
    assert "no skin" in window.app.luminance_problem
    files.save_picture(window.app, tmp_path / "empty.png")
    window.until(lambda: (tmp_path / "empty.png").is_file())
    assert any("empty.png has not the luminance" in message.text for message in window.app.messages.shown)
    window.app.camera = face
    window.frames(3)
    assert window.app.luminance_problem == ""


def test_the_palette_finds_it(window: Offscreen) -> None:
    found = [command.title for command in ranked(commands(window.app), "luminance")]
    assert found[0] == "Equal luminance"
    assert "Equal luminance for each expression" in found


def test_nothing_is_drawn_again_while_nothing_moves(
    window: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    on(window)
    window.move(*FACE)
    window.frames(4)
    monkeypatch.setattr(window.session.renderer, "draw", lambda *args, **options: pytest.fail("drawn"))
    window.frames(3)
    assert window.session.wants_frame_in() is None
