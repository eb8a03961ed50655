"""Skin: wrinkles in GLSL are what numpy says, maps that are missing change nothing, lights adapt to skin."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.mesh import Material
from facemorph.core.picture import LIGHT_RIGS, LightRig, Look
from facemorph.core.rig import Rig
from facemorph.core.wrinkles import SETS, Wrinkle, WrinkleWeights, set_weights
from facemorph.gl import Offscreen, Renderer
from facemorph.gl.bends import bends
from facemorph.gl.exposure import EASING, FAIR, LEAST, MOST, exposed, exposure
from facemorph.gl.programs import Programs
from facemorph.gl.skin_maps import ROUGHNESS_UNIT
from facemorph.gl.wrinkles import WrinkleDriver, wrinkles_of
from facemorph.resources import data_folder

SIZE = (160, 160)
PROBE = """#version 330 core
#include "lib/wrinkles.glsl"
in vec2 place;
out vec3 counted;
void main() {
    counted = set_weights(place);
}
"""
LOBES = """#version 330 core
#include "lib/skin.glsl"
in vec2 asked;
out float found;
void main() {
    found = lobes(asked.x, asked.y);
}
"""
EVERYWHERE = Wrinkle("all over", "green", (-1.0, -1.0, 2.0, 2.0), shapes={"smile": 1.0})


def painted(
    rig: Rig, folder: Path, *wrinkles: Wrinkle, skin: tuple[int, int, int] = (200, 150, 130), **maps: object
) -> Rig:
    """The head with a skin of one colour and these maps."""
    path = folder / f"skin{skin}.png"
    Image.new("RGB", (32, 32), skin).save(path)
    material = replace(Material("skin", (1.0, 1.0, 1.0), texture=path), **maps)  # type: ignore[arg-type]
    mesh = replace(rig.neutral, materials={**rig.neutral.materials, "skin": material})
    return Rig(mesh, rig.shapes, rig.deltas, wrinkles=wrinkles)


def stripes(folder: Path) -> Path:
    """Furrows in every set."""
    rows = 128 + 100 * np.sin(np.arange(256) * 0.8)
    pixels = np.repeat(np.repeat(rows[:, None, None], 256, 1), 3, 2).astype(np.uint8)
    Image.fromarray(pixels).save(folder / "stripes.png")
    return folder / "stripes.png"


def test_glsl_counts_wrinkles_as_numpy_does(ctx: moderngl.Context, head: Rig, folder: Path) -> None:
    rng = np.random.default_rng(5)
    wrinkles = []
    for k in range(14):
        u, v = rng.uniform(0.0, 0.8, 2)
        shapes = {"smile": rng.uniform(-0.5, 1.0), "jaw": rng.uniform(0.0, 1.0)}
        area = (u, v, u + rng.uniform(0.05, 0.4), v + rng.uniform(0.05, 0.4))
        wrinkles.append(
            Wrinkle(str(k), SETS[k % 3], area, rng.uniform(0.01, 0.2), rng.uniform(0, 0.3), shapes)
        )
    rig = Rig(head.neutral, head.shapes, head.deltas, wrinkles=tuple(wrinkles))
    coefficients = rig.coefficients({"smile": 0.7, "jaw": 0.4})
    places = rng.uniform(-0.1, 1.1, (400, 2))

    shutil.copytree(data_folder("shaders") / "lib", folder / "lib")
    (folder / "probe.vert").write_text(PROBE, encoding="utf-8")
    program = Programs(ctx, folder).get("probe.vert", capture=("counted",))
    for name, value in WrinkleDriver(rig).uniforms(coefficients, None).items():
        if isinstance(value, bytes):
            program[name].write(value)
        else:
            program[name].value = value
    source = ctx.buffer(places.astype("f4").tobytes())
    result = ctx.buffer(reserve=400 * 12)
    screen = ctx.simple_framebuffer((4, 4))
    screen.use()
    ctx.vertex_array(program, [(source, "2f", "place")]).transform(result, moderngl.POINTS)
    found = np.frombuffer(result.read(), "f4").reshape(400, 3)
    wanted = set_weights(wrinkles, WrinkleWeights(rig.names, wrinkles)(coefficients), places)
    assert wanted.max() > 0.3
    assert found == pytest.approx(wanted, abs=1e-5)
    for thing in (source, result, screen):
        thing.release()


def test_a_rig_without_wrinkles_has_no_driver(head: Rig) -> None:
    assert wrinkles_of(head) is None


def test_wrinkles_of_weight_0_change_no_pixel_and_others_do(
    screen: Offscreen, head: Rig, folder: Path
) -> None:
    plain = painted(head, folder)
    furrowed = painted(head, folder, EVERYWHERE, wrinkles=stripes(folder), wrinkle_height=0.2)
    for pose, same in (({"jaw": 1.0}, True), ({"smile": -1.0}, True), ({"smile": 1.0}, False)):
        pictures = [screen.render(rig, pose, size=SIZE) for rig in (plain, furrowed)]
        assert np.array_equal(*pictures) == same


def test_wrinkles_show_while_something_moves_too(ctx: moderngl.Context, head: Rig, folder: Path) -> None:
    pictures = []
    for maps in ({}, {"wrinkles": stripes(folder), "wrinkle_height": 0.2}):
        renderer = Renderer(ctx)
        renderer.load(painted(head, folder, EVERYWHERE, **maps))
        camera = Camera.framing(head.neutral.bounds, "front", 1.0)
        renderer.draw({"smile": 1.0}, camera, Look(), SIZE, quality="fast")
        pictures.append(renderer.read().astype(int))
        renderer.release()
    assert np.mean(np.abs(pictures[0] - pictures[1]).max(axis=2) > 3) > 0.1


def test_flat_maps_change_nothing_and_a_relief_does(screen: Offscreen, head: Rig, folder: Path) -> None:
    Image.new("L", (8, 8), 90).save(folder / "flat.png")
    Image.new("RGB", (8, 8), (128, 128, 255)).save(folder / "straight.png")
    plain = screen.render(painted(head, folder), {}, size=SIZE).astype(int)
    flat = screen.render(painted(head, folder, bump=folder / "flat.png"), {}, size=SIZE)
    assert np.array_equal(flat, plain)
    straight = screen.render(painted(head, folder, bump=folder / "straight.png"), {}, size=SIZE)
    assert np.abs(straight - plain).max() <= 1
    rough = screen.render(painted(head, folder, bump=stripes(folder), bump_height=0.2), {}, size=SIZE)
    assert np.mean(np.abs(rough - plain).max(axis=2) > 3) > 0.1


def test_wrinkles_show_over_a_picture_of_normals(screen: Offscreen, head: Rig, folder: Path) -> None:
    Image.new("RGB", (8, 8), (128, 128, 255)).save(folder / "straight.png")
    maps = {"bump": folder / "straight.png", "wrinkles": stripes(folder), "wrinkle_height": 0.2}
    rig = painted(head, folder, EVERYWHERE, **maps)
    still, smiling = (
        screen.render(rig, {"smile": smile}, size=SIZE, look=Look(shading="skin")).astype(int)
        for smile in (-1e-9, 1.0)
    )
    bare = screen.render(painted(head, folder), {"smile": 1.0}, size=SIZE).astype(int)
    assert np.abs(smiling - bare).max() > 20
    assert np.abs(still - screen.render(painted(head, folder), {}, size=SIZE)).max() <= 1


@pytest.mark.parametrize("quality", ["full", "fast"])
def test_furrows_darken_skin_even_without_depth_and_dark_skin_more(
    ctx: moderngl.Context, head: Rig, folder: Path, quality: str
) -> None:
    """So that they read in flat light: shade in a fold does not depend on where light comes from."""
    camera, look = Camera.framing(head.neutral.bounds, "front", 1.0), Look(light="flat")
    lost = []
    for skin in ((225, 185, 165), (85, 55, 40)):
        means = []
        for maps in ({}, {"wrinkles": stripes(folder), "wrinkle_height": 0.0}):
            renderer = Renderer(ctx)
            renderer.load(painted(head, folder, EVERYWHERE, skin=skin, **maps))
            renderer.draw({"smile": 1.0}, camera, look, SIZE, quality=quality)  # type: ignore[arg-type]
            shown = renderer.read()[..., :3].astype(int)
            means.append(shown)
            renderer.release()
        plain, furrowed = means
        assert (furrowed <= plain + 1).all()
        middle = (slice(60, 100), slice(60, 100))
        linear = [((picture[middle] / 255.0) ** 2.2).mean() for picture in means]
        lost.append(1.0 - linear[1] / linear[0])
    assert 0.03 < lost[0] < lost[1]


def test_both_lobes_throw_back_all_there_is_however_rough(ctx: moderngl.Context, folder: Path) -> None:
    """GGX's distribution D has a projected area of 1 (Walter et al. 2007, eq. 4); the lobes are pi D."""
    shutil.copytree(data_folder("shaders") / "lib", folder / "lib")
    (folder / "probe.vert").write_text(LOBES, encoding="utf-8")
    program = Programs(ctx, folder).get("probe.vert", capture=("found",))
    program["key_softness"].value = 0.0
    # Even steps of cos^2: the integral over the hemisphere of f cos is pi times their mean.
    square = (np.arange(40000) + 0.5) / 40000
    screen = ctx.simple_framebuffer((4, 4))
    screen.use()
    for rough in (0.35, 0.5, 0.7):
        asked = np.stack([np.sqrt(square), np.full(len(square), rough)], 1).astype("f4")
        source, result = ctx.buffer(asked.tobytes()), ctx.buffer(reserve=4 * len(square))
        ctx.vertex_array(program, [(source, "2f", "asked")]).transform(result, moderngl.POINTS)
        found = np.frombuffer(result.read(), "f4").astype(float)
        assert found.mean() == pytest.approx(1.0, rel=0.02)
        source.release()
        result.release()
    screen.release()


def test_heights_beyond_reason_are_held(screen: Offscreen, head: Rig, folder: Path) -> None:
    """A file's height in other units than its mesh's may look rough, never broken."""
    high = [
        screen.render(painted(head, folder, bump=stripes(folder), bump_height=height), {}, size=SIZE)
        for height in (1e4, 1e6)
    ]
    assert np.array_equal(*high)


def test_rough_skin_shines_less(screen: Offscreen, head: Rig, folder: Path) -> None:
    bright = []
    for level in (80, 255):
        Image.new("L", (8, 8), level).save(folder / f"{level}.png")
        rig = painted(head, folder, skin=(70, 45, 30), roughness=folder / f"{level}.png")
        bright.append(screen.render(rig, {}, size=SIZE)[50:110, 50:110, :3].mean())
    assert bright[0] > bright[1] + 1.5
    assert ROUGHNESS_UNIT < 16


@pytest.mark.parametrize("name", ["bump", "roughness", "wrinkles"])
def test_a_map_that_cannot_be_read_is_told_and_left_out(
    screen: Offscreen, head: Rig, folder: Path, name: str
) -> None:
    (folder / "broken.png").write_bytes(b"no picture")
    plain = screen.render(painted(head, folder, EVERYWHERE), {"smile": 1.0}, size=SIZE)
    broken = painted(head, folder, EVERYWHERE, **{name: folder / "broken.png"})
    assert np.array_equal(screen.render(broken, {"smile": 1.0}, size=SIZE), plain)
    assert any("broken.png" in problem for problem in screen.renderer.problems)


@pytest.mark.parametrize("light", LIGHT_RIGS)
def test_lights_adapt_to_skin_in_part(screen: Offscreen, head: Rig, folder: Path, light: LightRig) -> None:
    """Dark skin stays darker, but by less than its colour is; eyes see the same lights."""
    means = []
    for skin in ((225, 185, 165), (85, 55, 40)):
        rig = painted(head, folder, skin=skin)
        pixels = screen.render(rig, {}, size=SIZE, look=Look(light=light)).astype(float)
        means.append(pixels[60:100, 60:100, :3].mean())
    assert 1.0 < means[0] / means[1] < 195 / 60


def test_exposure_is_the_rule_and_within_bounds() -> None:
    assert exposure(FAIR) == pytest.approx(1.0)
    assert exposure(FAIR / 3) == pytest.approx(3**EASING, abs=1e-4)
    assert (exposure(0.0), exposure(1.0)) == (MOST, pytest.approx(max(LEAST, FAIR**EASING), abs=1e-4))
    lights = {"key_light": (1.0, 2.0, 3.0), "key_direction": (1.0, 0.0, 0.0)}
    assert exposed(lights, 2.0) == {"key_light": (2.0, 4.0, 6.0), "key_direction": (1.0, 0.0, 0.0)}


def test_a_sphere_bends_as_its_radius_says_whatever_its_unit() -> None:
    """Of a height of 30 it has a radius of 15."""
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=4)
    for scale in (1.0, 250.0):
        found = bends((ball.vertices * scale).astype(np.float32), ball.faces.astype(np.int32))
        assert found == pytest.approx(np.full(len(found), 1 / 15), rel=0.03)
    assert not bends(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.int32)).any()


@pytest.mark.parametrize("lit", [["LIT"], ["LIT", "LIT_BY_VERTEX"]])
@pytest.mark.parametrize("maps", [[], ["RELIEF"], ["WRINKLES"], ["RELIEF", "ROUGHNESS", "WRINKLES"]])
def test_every_kind_of_skin_compiles(ctx: moderngl.Context, lit: list[str], maps: list[str]) -> None:
    programs = Programs(ctx)
    others = ["PARTNERS 2", "PARTNER0_TEXTURED", "PARTNER1_TEXTURED", "PARTNER1_UV", "CUTOUT", "GLOW", "HEM"]
    for more in ([], ["GLOW"], ["HEM"], others):
        programs.get("face.vert", "skin.frag", define=[*lit, "SKIN", "TEXTURED", *maps, *more])
    if not maps:
        for plain in ([], ["COLOURED"]):
            programs.get("face.vert", "skin.frag", define=[*lit, "SKIN", *plain])
    programs.release()
