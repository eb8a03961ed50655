"""Faces of any colour come out equally luminous, by a measure that is worked out here once more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.mesh import Material
from facemorph.core.picture import LUMINANCE, LightRig, Look, checked_luminance
from facemorph.core.rig import FaceInfo, Rig
from facemorph.errors import OptionError
from facemorph.gl import Offscreen
from facemorph.gl.luminance import mean_luminance, solved

PROMISED = 0.005
SIZE = (180, 220)
SKINS = {"pale": (0.75, 0.58, 0.50), "brown": (0.30, 0.17, 0.11), "dark": (0.055, 0.030, 0.020)}
CAMERA = "front"


def person(
    head: Rig, skin: tuple[float, float, float], eye: tuple[float, float, float] = (0.7, 0.7, 0.7)
) -> Rig:
    materials = {"skin": Material("skin", skin), "eye": Material("eye", eye)}
    return Rig(replace(head.neutral, materials=materials), head.shapes, head.deltas, FaceInfo("Someone"))


def luminance(pixels: np.ndarray, where: np.ndarray) -> float:
    """CIE Y of sRGB, after IEC 61966-2-1, a pixel at a time."""
    total = 0.0
    for red, green, blue, _ in pixels[where] / 255.0:
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (red, green, blue)]
        total += 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    return total / int(where.sum())


def where_skin(screen: Offscreen, head: Rig, pose: dict[str, float], camera: str) -> np.ndarray:
    """By colour: under flat light the head is red where it is skin, blue where it is eyes."""
    marked = person(head, (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    look = Look(light="flat", background=(0.0, 1.0, 0.0, 1.0))
    shown = screen.render(marked, pose, size=SIZE, camera=camera, look=look).astype(int)
    return (shown[..., 1] < 90) & (shown[..., 0] > 2 * shown[..., 2]) & (shown[..., 0] > 60)


@pytest.mark.parametrize("light", ["flat", "studio"])
def test_dark_and_pale_faces_have_the_luminance_that_was_asked_for(
    screen: Offscreen, head: Rig, light: LightRig
) -> None:
    for target in (LUMINANCE, 0.15):
        for skin in SKINS.values():
            look = Look(light=light, luminance=target)
            pixels = screen.render(person(head, skin), size=SIZE, camera=CAMERA, look=look)
            where = screen.renderer.skin_pixels()
            assert luminance(pixels, where) == pytest.approx(target, rel=PROMISED)


def test_without_it_dark_faces_are_darker(screen: Offscreen, head: Rig) -> None:
    found = []
    for name in ("pale", "dark"):
        pixels = screen.render(person(head, SKINS[name]), size=SIZE, look=Look(light="flat"))
        found.append(luminance(pixels, screen.renderer.skin_pixels()))
    assert found[1] < 0.5 * found[0]


def test_what_is_measured_is_the_skin(screen: Offscreen, head: Rig) -> None:
    for camera in ("front", "three-quarter"):
        screen.render(head, {"jaw": 1.0}, size=SIZE, camera=camera)
        told = screen.renderer.skin_pixels()
        seen = where_skin(screen, head, {"jaw": 1.0}, camera)
        assert told.mean() > 0.2
        assert (told & ~seen).sum() < 0.01 * told.sum(), "nothing but skin"
        assert told.sum() > 0.85 * seen.sum(), "all of it but edges and the fading end"


def test_a_face_keeps_its_exposure_and_a_picture_its_luminance(screen: Offscreen, head: Rig) -> None:
    someone = person(head, SKINS["brown"])
    alone = Look(light="studio", luminance=LUMINANCE, luminance_of="picture")
    together = replace(alone, luminance_of="face")
    # Far over what is natural, so that the pictures differ clearly.
    pose = {"jaw": 4.0, "brows": 3.0}
    shown = screen.render(someone, pose, size=SIZE, look=alone)
    where = screen.renderer.skin_pixels()
    assert luminance(shown, where) == pytest.approx(LUMINANCE, rel=PROMISED)
    kept = screen.render(someone, pose, size=SIZE, look=together)
    assert abs(luminance(kept, where) / LUMINANCE - 1.0) > PROMISED
    neutral = screen.render(someone, size=SIZE, look=together)
    assert luminance(neutral, screen.renderer.skin_pixels()) == pytest.approx(LUMINANCE, rel=PROMISED)


def test_the_backdrop_and_what_was_drawn_before_change_nothing(screen: Offscreen, head: Rig) -> None:
    someone = person(head, SKINS["brown"])
    look = Look(light="flat", luminance=0.2)
    first = screen.render(someone, {"smile": 1.0}, size=SIZE, look=look)
    screen.render(someone, {"jaw": 1.0}, size=(64, 64), look=Look())
    assert np.array_equal(first, screen.render(someone, {"smile": 1.0}, size=SIZE, look=look))
    with_paper = replace(look, background=(1.0, 1.0, 1.0, 1.0))
    inside = screen.render(someone, {"smile": 1.0}, size=SIZE, look=with_paper)
    where = screen.renderer.skin_pixels()
    assert np.array_equal(inside[where], first[where])


@pytest.mark.parametrize("shading", ["heat", "normals", "wire"])
def test_shadings_without_light_refuse(screen: Offscreen, head: Rig, shading: str) -> None:
    with pytest.raises(OptionError, match=f"skin and clay; {shading}"):
        screen.render(head, size=SIZE, look=Look(shading=shading, luminance=0.2))  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [0.0, -1.0, 1.0, float("nan"), float("inf")])
def test_no_face_has_such_a_luminance(value: float) -> None:
    with pytest.raises(OptionError, match=r"0\.02 to 0\.7"):
        checked_luminance(value)


def test_a_face_that_cannot_be_made_as_light_says_so(screen: Offscreen, head: Rig) -> None:
    with pytest.raises(OptionError, match=r"cannot bring this face to a luminance of 0\.7"):
        screen.render(person(head, (0.0005, 0.0, 0.0)), size=SIZE, look=Look(light="flat", luminance=0.7))


@pytest.mark.parametrize("power", [0.5, 0.8, 1.0])
@pytest.mark.parametrize("target", [0.05, 0.25, 0.6])
def test_any_rising_curve_is_solved(power: float, target: float) -> None:
    def curve(exposure: float) -> float:
        return exposure**power / (1.0 + exposure**power)

    exposure, _ = solved(curve, target, 1.0)
    assert curve(exposure) == pytest.approx(target, rel=0.001)


@pytest.mark.parametrize("target", [0.05, 0.1, 0.25])
def test_skin_of_one_colour_comes_as_near_as_eight_bits_can(target: float) -> None:
    def stored(luminance: float) -> float:
        return 255.0 * (1.055 * luminance ** (1.0 / 2.4) - 0.055)

    def shown(exposure: float) -> float:
        level = round(stored(min(0.3 * exposure, 1.0)))
        return float(((level / 255.0 + 0.055) / 1.055) ** 2.4)

    exposure, _ = solved(shown, target, 1.0)
    assert abs(stored(shown(exposure)) - stored(target)) <= 0.51


def test_a_picture_without_skin_is_refused() -> None:
    with pytest.raises(OptionError, match="no skin"):
        solved(lambda exposure: float("nan"), 0.25, 1.0)


def test_the_mean_is_of_the_chosen_pixels_alone() -> None:
    pixels = np.zeros((2, 2, 4), np.uint8)
    pixels[0] = 255
    assert mean_luminance(pixels, np.array([[True, True], [False, False]])) == pytest.approx(1.0)
    assert mean_luminance(pixels, np.ones((2, 2), bool)) == pytest.approx(0.5)
    pixels[1, 1] = (0, 188, 0, 255)
    assert mean_luminance(pixels, np.array([[False, False], [False, True]])) == pytest.approx(
        0.7152 * 0.5029, rel=1e-3
    )
