"""Names in the rows of the pages: whole where there is room, else cut where they say least."""

from __future__ import annotations

from dataclasses import replace

import pytest
from imgui_bundle import imgui

from facemorph.core.rig import Rig
from facemorph.ui import widgets
from facemorph.ui.settings import Settings
from facemorph.ui.widgets import cut
from tests.ui.harness import Offscreen, ball_rig

LONG = {
    "sad": "Disgusted",
    "AU1": "Lip corner depressor",
    "AU2": "Lower lip depressor",
    "jawOpen": "Mouth corner stretched, right",
    "mouthSmileLeft": "Lips together on an open jaw",
}


def labelled(words: dict[str, str]) -> Rig:
    """A ball whose shapes have these labels."""
    ball = ball_rig()
    return replace(ball, shapes=tuple(replace(s, label=words.get(s.name, s.label)) for s in ball.shapes))


@pytest.fixture
def shortened(monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Each label that was cut, and what was left of it."""
    found: dict[str, str] = {}

    def seen(text: str, room: float) -> str:
        shown = cut(text, room)
        if shown != text:
            found[text] = shown
        return shown

    monkeypatch.setattr(widgets, "cut", seen)
    return found


@pytest.mark.parametrize(
    ("size", "scale"), [((1280, 800), 1.0), ((1920, 1080), 1.0), ((2560, 1600), 2.0), ((1920, 1200), 1.5)]
)
def test_the_longest_names_of_the_usual_sets_are_whole(
    opengl: None, shortened: dict[str, str], size: tuple[int, int], scale: float
) -> None:
    with Offscreen(labelled(LONG), size, scale=scale) as window:
        for page, chosen in (("Shapes", "FACS"), ("FACS", "FACS"), ("FACS", "ARKit")):
            window.app.settings.right_page, window.app.pages.set = page, chosen
            window.frames(3)
            assert shortened == {}, (page, chosen)


def test_a_slider_stays_long_enough_to_be_dragged_beside_any_name(
    opengl: None, shortened: dict[str, str]
) -> None:
    long = "Mundwinkel nach außen gezogen und angehoben, rechts"
    with Offscreen(labelled({"AU1": long, "jawOpen": long}), settings=Settings(right_page="FACS")) as window:
        window.frames(3)
        assert window.app.controls.facs == {}
        # The slider of the first unit ends left of its number.
        window.drag((1120, 299), (1185, 299))
        assert window.app.controls.facs[1].left > 0.5
    assert shortened[long].startswith("Mundwinkel") and shortened[long].endswith("…rechts")


def test_what_tells_names_apart_is_kept(opengl: None) -> None:
    with Offscreen() as window:
        window.io.add_mouse_pos_event(0, 0)
        imgui.backends.opengl3_new_frame()
        imgui.new_frame()
        room = imgui.calc_text_size("Mouth corner stret").x
        shown = [
            cut(text, room)
            for text in (
                "Mouth corner stretched, right",
                "Mouth corner depressor",
                "scan_of_a_smile_000123",
                "Shape 12",
                "/home/me/my faces/neutral.obj",
            )
        ]
        imgui.end_frame()
    assert shown[0].startswith("Mouth cor") and shown[0].endswith("…right")
    assert shown[1].startswith("Mouth corner d") and shown[1].endswith("…")
    assert shown[2].startswith("scan_of_") and shown[2].endswith("123")
    assert shown[3] == "Shape 12"
    assert shown[4].endswith(".obj")
