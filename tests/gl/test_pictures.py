"""Off-screen pictures and contact sheets."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.lengths import lengths
from facemorph.core.picture import Look
from facemorph.core.rig import Rig, Shape
from facemorph.errors import OptionError, UnknownNameError
from facemorph.gl import Legend, Offscreen, render, sheet
from facemorph.gl.labels import fitted, font, text_width
from facemorph.gl.legend import legend_panel


def test_one_picture_needs_one_call(head: Rig) -> None:
    pixels = render(head, {"smile": 1.0}, size=(90, 70), camera="three-quarter")
    assert pixels.shape == (70, 90, 4)
    assert pixels.dtype == np.uint8
    assert pixels.flags.writeable


def test_the_same_arguments_give_the_same_bytes_in_any_order(head: Rig) -> None:
    with Offscreen() as first, Offscreen() as second:
        poses = [{"smile": 0.2 * k, "jaw": 0.1} for k in range(4)]
        one = [first.render(head, pose, size=(60, 60)) for pose in poses]
        other = [second.render(head, pose, size=(60, 60)) for pose in reversed(poses)]
    for a, b in zip(one, reversed(other), strict=True):
        assert np.array_equal(a, b)


def test_directions_and_cameras_are_checked(screen: Offscreen, head: Rig) -> None:
    with pytest.raises(OptionError, match="front"):
        screen.render(head, camera="behind")
    with pytest.raises(OptionError, match="8192"):
        screen.render(head, size=(9000, 10))
    with pytest.raises(UnknownNameError, match="smile"):
        screen.render(head, {"smiel": 1.0})


def test_a_sheet_shows_neutral_and_each_expression_as_rendered_alone(screen: Offscreen, head: Rig) -> None:
    tile = (120, 100)
    pixels = sheet(screen, head, tile=tile)
    columns = pixels.shape[1] // tile[0]
    assert columns == 2
    for name in ("neutral", "smile", "brows", "jaw"):
        state = {} if name == "neutral" else {name: 1.0}
        alone = screen.render(head, state, size=tile)
        assert contains(pixels, alone), name


def contains(sheet_pixels: np.ndarray, tile: np.ndarray) -> bool:
    """Whether the sheet holds the tile, bit for bit."""
    height, width = tile.shape[:2]
    for left in range(0, sheet_pixels.shape[1] - width + 1, width):
        for top in range(sheet_pixels.shape[0] - height + 1):
            if np.array_equal(sheet_pixels[top : top + height, left : left + width], tile):
                return True
    return False


@pytest.mark.parametrize("given", [None, 0.7])
def test_a_sheets_heat_maps_have_one_scale_and_one_legend(
    screen: Offscreen, head: Rig, given: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Legend] = []

    def kept(legend: Legend, width: int, letter: float) -> np.ndarray:
        drawn.append(legend)
        return legend_panel(legend, width, letter)

    monkeypatch.setattr(sys.modules["facemorph.gl.sheet"], "legend_panel", kept)
    tile = (120, 100)
    pixels = sheet(screen, head, tile=tile, look=Look(shading="heat", heat_max=given))
    largest = max(float(lengths(delta).max()) for delta in head.deltas)
    (legend,) = drawn
    assert legend.high == given if given else largest <= legend.high < 1.6 * largest
    shared = Look(shading="heat", heat_max=legend.high)
    for state in ({}, {"smile": 1.0}, {"brows": 1.0}, {"jaw": 1.0}):
        assert contains(pixels, screen.render(head, state, size=tile, look=shared, legend=False)), state
    assert not contains(pixels, screen.render(head, {"smile": 1.0}, size=tile, look=Look(shading="heat")))


def test_tiny_and_unmoving_faces_have_heat_sheets_too(screen: Offscreen, head: Rig) -> None:
    look = Look(shading="heat")
    assert sheet(screen, head, tile=(20, 20), look=look, names=("jaw",)).shape[1] == 40
    still = Rig(head.neutral, head.shapes, np.zeros_like(head.deltas), head.info)
    assert sheet(screen, still, tile=(120, 100), look=look).shape[1] == 240


def test_a_sheet_is_lettered_under_each_tile_and_above(screen: Offscreen, head: Rig) -> None:
    pixels = sheet(screen, head, tile=(160, 120))
    bright = (pixels[..., :3].min(axis=2) > 200).any(axis=1)
    runs = np.flatnonzero(np.diff(np.concatenate([[0], bright.astype(int), [0]])) == 1)
    assert runs[0] < 40, "the face's name comes first"


def test_sheets_take_whole_names_long_labels_and_small_tiles(screen: Offscreen, head: Rig) -> None:
    wordy = Rig(
        head.neutral,
        tuple(Shape(s.name, "A label much longer than any tile is wide " * 3) for s in head.shapes),
        head.deltas,
        replace(head.info, name="A face whose name is longer than the whole sheet is wide " * 4),
    )
    assert sheet(screen, wordy, tile=(40, 40)).shape[1] % 40 == 0
    assert sheet(screen, head, tile=(40, 40), names=("jaw",)).shape[1] == 80
    with pytest.raises(UnknownNameError):
        sheet(screen, head, names=("nobody",))


def test_a_sheet_too_large_is_refused(screen: Offscreen, head: Rig) -> None:
    with pytest.raises(OptionError, match="smaller"):
        sheet(screen, head, tile=(8000, 8000), names=("smile", "brows", "jaw") * 6)


def test_a_transparent_sheet_has_ink_too(screen: Offscreen, head: Rig) -> None:
    pixels = sheet(screen, head, tile=(120, 100), look=Look(background=(0.0, 0.0, 0.0, 0.0)))
    assert pixels[0, 0, 3] == 0
    assert (pixels[:24, :, 3] == 255).any()


def test_words_are_shortened_to_the_room() -> None:
    face = font(16)
    assert fitted("Happy", face, 500) == "Happy"
    short = fitted("A rather long label", face, 60)
    assert short.endswith("…")
    assert text_width(short, face) <= 60
    assert fitted("Happy", face, 1) == ""
