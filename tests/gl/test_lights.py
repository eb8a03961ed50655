"""Rigs of lights and what is behind the face: each is itself and the same every time."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from facemorph.core.camera import Camera
from facemorph.core.picture import DUSK, LIGHT_RIGS, MID_GREY, LightRig, Look, checked_light
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import UnknownNameError
from facemorph.gl import Offscreen, Renderer
from facemorph.gl.backdrop import shadow_box, shadow_uniforms
from facemorph.gl.light_rigs import RIGS

SIZE = (160, 200)
PAPER = (0.87, 0.88, 0.90, 1.0)
CLEAR = (0.0, 0.0, 0.0, 0.0)


def picture(
    screen: Offscreen, rig: Rig, light: LightRig, camera: str = "front", **look: object
) -> np.ndarray:
    return screen.render(rig, size=SIZE, camera=camera, look=Look(light=light, **look)).astype(int)  # type: ignore[arg-type]


def test_every_light_is_another_and_the_same_every_time(screen: Offscreen, head: Rig) -> None:
    pictures = {light: picture(screen, head, light, background=PAPER) for light in LIGHT_RIGS}
    for one, other in combinations(LIGHT_RIGS, 2):
        assert np.abs(pictures[one] - pictures[other]).max() > 20, f"{one} is {other}"
    for light in LIGHT_RIGS:
        assert np.array_equal(pictures[light], picture(screen, head, light, background=PAPER))


def test_every_name_has_its_rig() -> None:
    assert set(RIGS) == set(LIGHT_RIGS)


def test_an_unknown_light_is_told_with_the_choices() -> None:
    with pytest.raises(UnknownNameError, match=r"no light is called 'windw'.*Did you mean 'window'.*flat"):
        checked_light("windw")


def test_flat_light_has_no_side(screen: Offscreen, head: Rig) -> None:
    sides = {}
    for light in ("flat", "window"):
        shown = picture(screen, head, light, shading="clay")  # type: ignore[arg-type]
        sides[light] = np.abs(shown - shown[:, ::-1])[..., :3].mean()
    assert sides["flat"] < 1.0
    assert sides["window"] > 10.0 * sides["flat"]


@pytest.mark.parametrize("azimuth", [40.0, -40.0])
def test_flat_light_follows_the_camera(azimuth: float) -> None:
    flat = RIGS["flat"].uniforms(Camera(azimuth_deg=azimuth))
    x, _, z = flat["key_direction"]  # type: ignore[misc]
    assert np.degrees(np.arctan2(x, z)) == pytest.approx(azimuth)


def test_exposure_is_a_factor_on_every_light() -> None:
    for rig in RIGS.values():
        once, twice = (rig.uniforms(Camera(), exposure) for exposure in (1.0, 2.0))
        for name, value in once.items():
            expected = np.multiply(value, 2.0) if name.endswith("_light") else value
            assert twice[name] == pytest.approx(expected), name


def test_behind_flat_light_is_plain_mid_grey_and_behind_others_what_they_ask_for(
    screen: Offscreen, head: Rig
) -> None:
    assert Look().backdrop == DUSK
    assert Look(light="flat").backdrop == MID_GREY
    assert Look(light="flat", background=PAPER).backdrop == PAPER
    shown = picture(screen, head, "flat")
    beside = np.r_[shown[:, :6].reshape(-1, 4), shown[:3].reshape(-1, 4), shown[-3:].reshape(-1, 4)]
    assert (beside == [128, 128, 128, 255]).all()


@pytest.mark.parametrize("background", [PAPER, DUSK, (0.5, 0.3, 0.2, 1.0)])
def test_a_shadow_lies_under_the_bust_and_nowhere_above(
    screen: Offscreen, head: Rig, background: tuple[float, float, float, float]
) -> None:
    camera = Camera.framing(head.neutral.bounds, "front", 1.0)
    away = replace(camera, distance=camera.distance * 1.6)
    elsewhere = replace(away, target=(0.0, 1000.0, 0.0))
    look = Look(background=background)
    shown, empty = (
        screen.render(head, size=(200, 200), camera=view, look=look)[..., :3].astype(int).sum(axis=-1)
        for view in (away, elsewhere)
    )
    taken = empty - shown
    lowest = away.clip_from_model(1.0) @ [0.0, head.neutral.bounds[0, 1], 0.0, 1.0]
    ground = round(100 - 100 * lowest[1] / lowest[3])
    assert taken[ground + 4, 100] > 0.05 * empty[ground + 4, 100], "it is darker under the bust"
    assert taken[ground + 4, 100] >= taken[ground + 4, 60] >= 0, "and less so to its side"
    assert not taken[:40].any(), "nothing lies above the head"
    assert not taken[:, :10].any()


@pytest.mark.parametrize("quality", ["full", "fast"])
def test_a_transparent_backdrop_has_no_shadow(renderer: Renderer, head: Rig, quality: str) -> None:
    camera = Camera.framing(head.neutral.bounds, "front", 1.0)
    away = replace(camera, distance=camera.distance * 2.0)
    renderer.draw(Pose(), away, Look(background=CLEAR), (120, 120), quality=quality)  # type: ignore[arg-type]
    pixels = renderer.read()
    empty = pixels[..., 3] == 0
    assert empty.mean() > 0.5
    assert not pixels[empty].any()
    assert empty[-10:].all() and empty[:, :10].all()


def test_both_qualities_lay_the_same_shadow(renderer: Renderer, head: Rig) -> None:
    camera = Camera.framing(head.neutral.bounds, "three-quarter", 1.0)
    away = replace(camera, distance=camera.distance * 1.5)
    shown = []
    for quality in ("full", "fast", "full"):
        renderer.draw(Pose(), away, Look(background=PAPER), (120, 120), quality=quality)  # type: ignore[arg-type]
        shown.append(renderer.read().astype(int))
    assert np.array_equal(shown[0], shown[2])
    assert (np.abs(shown[0] - shown[1]).max(axis=-1) <= 1).mean() > 0.9
    assert np.abs(shown[0][-15:] - shown[1][-15:]).max() <= 1


def test_the_shadows_box_holds_all_of_it() -> None:
    bounds = np.array([[-8.0, -12.0, -6.0], [8.0, 10.0, 7.0]], np.float32)
    for azimuth, elevation in ((0.0, 0.0), (50.0, 20.0), (180.0, -15.0), (90.0, 70.0)):
        camera = Camera.framing(bounds, f"{azimuth},{elevation}", 1.5)
        told = shadow_uniforms(bounds, camera, (300, 200), 0.5)
        box = shadow_box({**told, "background": PAPER}, (300, 200))
        assert box is not None
        a, b, c = told["shadow_shape"]  # type: ignore[misc]
        centre = told["shadow_centre"]
        y, x = np.mgrid[:200, :300] + 0.5
        dx, dy = x - centre[0], y - centre[1]  # type: ignore[index]
        inside = a * dx * dx + 2.0 * b * dx * dy + c * dy * dy < 1.0
        assert inside.any()
        inside[box[1] : box[1] + box[3], box[0] : box[0] + box[2]] = False
        assert not inside.any()


def test_faces_without_width_have_no_shadow() -> None:
    flat = np.zeros((2, 3), np.float32)
    told = shadow_uniforms(flat, Camera(), (10, 10), 0.5)
    assert told["shadow_strength"] == 0.0
    assert shadow_box({**told, "background": PAPER}, (10, 10)) is None
