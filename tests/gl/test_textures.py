"""Textures and their mip levels, read back texel by texel through a shader."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.rig import Rig
from facemorph.gl import Offscreen, mipmaps, texture_of
from facemorph.gl.mipmaps import mip_levels, mipmapped
from facemorph.gl.textures import LARGEST_SIDE, SMALL_SIDE, Textures

VERTEX = """#version 330
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }"""
FRAGMENT = """#version 330
uniform sampler2D picture;
uniform int level;
out vec4 colour;
void main() { colour = texelFetch(picture, ivec2(gl_FragCoord.xy), level); }"""
CHANNELS = {"L": 1, "RGB": 3, "RGBA": 4}


def noise(mode: str, size: tuple[int, int], seed: int = 3) -> Image.Image:
    """A picture with large and small features, so that its levels differ from each other."""
    rng = np.random.default_rng(seed)
    shape = (size[1], size[0], CHANNELS[mode])
    ramp = np.linspace(0.0, 120.0, size[0])[None, :, None] + np.linspace(0.0, 60.0, size[1])[:, None, None]
    values = (ramp + rng.uniform(0.0, 75.0, shape)).astype(np.uint8)
    return Image.fromarray(values[..., 0] if mode == "L" else values, mode)


def level_of(texture: moderngl.Texture | None, number: int, size: tuple[int, int]) -> np.ndarray:
    """Level `number` as OpenGL has it, (h, w, 4) uint8, its first row first."""
    assert texture is not None
    ctx = texture.ctx
    program = ctx.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
    target = ctx.simple_framebuffer(size, components=4)
    array = ctx.vertex_array(program, [])
    target.use()
    ctx.enable_only(ctx.NOTHING)
    texture.use(0)
    program["level"] = number
    array.render(vertices=3)
    pixels = np.frombuffer(target.read(components=4, alignment=1), np.uint8).reshape(size[1], size[0], 4)
    ctx.detect_framebuffer(0).use()
    for made in (array, program, target):
        made.release()
    return pixels


def blocks(values: np.ndarray, number: int) -> np.ndarray:
    """Means over blocks of 2^number a side."""
    side = 2**number
    height, width = values.shape[:2]
    cut = values.astype(np.float64).reshape(height // side, side, width // side, side, -1)
    return np.asarray(cut.mean(axis=(1, 3)))


@pytest.mark.parametrize("mode", CHANNELS)
def test_each_texel_of_a_level_is_the_mean_of_those_it_stands_for(ctx: moderngl.Context, mode: str) -> None:
    picture = noise(mode, (256, 128))
    whole = np.asarray(picture).reshape(128, 256, -1)[::-1]
    texture = mipmapped(ctx, mip_levels(picture))
    for number in range(8):
        found = level_of(texture, number, (256 >> number, 128 >> number))
        expected = blocks(whole, number)
        # Every level is rounded, half a step at most each.
        assert np.abs(found[..., : whole.shape[2]] - expected).max() <= 0.5 * number + 1e-6, number
    texture.release()


@pytest.mark.parametrize("mode", CHANNELS)
def test_levels_are_opengls_own_but_for_rounding(
    ctx: moderngl.Context, mode: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    picture = noise(mode, (256, 64))
    ours = mipmapped(ctx, mip_levels(picture))
    monkeypatch.setattr(mipmaps, "_loader", lambda ctx: None)
    opengls = mipmapped(ctx, mip_levels(picture))
    for number in range(9):
        size = (max(256 >> number, 1), max(64 >> number, 1))
        one, other = (level_of(texture, number, size).astype(int) for texture in (ours, opengls))
        assert np.abs(one - other).max() <= number, number
    ours.release()
    opengls.release()


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (1, 7), (301, 130), (640, 161)])
@pytest.mark.parametrize("mode", CHANNELS)
def test_a_texture_of_any_size_is_complete_and_keeps_a_plain_colour(
    ctx: moderngl.Context, mode: str, size: tuple[int, int]
) -> None:
    colour = (200, 90, 40, 170)[: CHANNELS[mode]]
    picture = Image.new(mode, size, colour if mode != "L" else colour[0])
    sizes = [level.size for level in mip_levels(picture)]
    assert sizes[0] == size
    assert sizes[-1] == (1, 1)
    for before, after in pairwise(sizes):
        assert after == (max(before[0] // 2, 1), max(before[1] // 2, 1))
    texture = mipmapped(ctx, mip_levels(picture))
    # An incomplete texture is black.
    for number, each in enumerate(sizes):
        assert (level_of(texture, number, each)[..., : CHANNELS[mode]] == colour).all(), number
    texture.release()


def test_rows_come_as_they_are_asked_for(ctx: moderngl.Context) -> None:
    picture = noise("RGB", (40, 300))
    rows = np.asarray(picture)
    for upside_down, expected in ((True, rows[::-1]), (False, rows)):
        texture = mipmapped(ctx, mip_levels(picture), upside_down=upside_down)
        assert np.array_equal(level_of(texture, 0, (40, 300))[..., :3], expected)
        texture.release()


def test_a_clear_texel_lends_its_colour_as_in_opengl(ctx: moderngl.Context) -> None:
    values = np.zeros((2, 2, 4), np.uint8)
    values[0, 0] = 200, 100, 40, 255
    texture = mipmapped(ctx, mip_levels(Image.fromarray(values, "RGBA")))
    assert np.abs(level_of(texture, 1, (1, 1))[0, 0].astype(int) - [50, 25, 10, 64]).max() <= 1
    texture.release()


@pytest.mark.parametrize("size", [(256, 256), (700, 90), (48, 48)])
def test_a_small_copy_is_the_picture_shrunk(
    ctx: moderngl.Context, folder: Path, size: tuple[int, int]
) -> None:
    picture = noise("RGB", size)
    picture.save(folder / "picture.png")
    textures = Textures(ctx, software=True)
    small = textures.small(folder / "picture.png")
    assert small is not None
    assert small.shape == (SMALL_SIDE, SMALL_SIDE, 3)
    expected = np.asarray(picture.resize((SMALL_SIDE, SMALL_SIDE), Image.Resampling.BOX), int)[::-1]
    assert np.abs(small - expected).mean() <= 1.0
    textures.forget()


def test_what_was_asked_first_changes_neither_copies_nor_textures(
    ctx: moderngl.Context, folder: Path
) -> None:
    paths = [folder / f"{seed}.png" for seed in range(3)]
    for seed, path in enumerate(paths):
        noise("RGB", (192, 128), seed).save(path)
    found = []
    for order in (paths, paths[::-1]):
        textures = Textures(ctx, software=True)
        assert textures.small(order[0]) is not None
        assert all(textures.at(path) for path in order)
        small = {path: textures.small(path) for path in paths}
        levels = [level_of(textures.at(path), n, (192 >> n, 128 >> n)) for path in paths for n in range(4)]
        found.append([*small.values(), *levels])
        textures.forget()
    assert all(np.array_equal(one, other) for one, other in zip(*found, strict=True))


def test_a_jpeg_beyond_the_largest_side_is_shrunk_to_it(ctx: moderngl.Context, folder: Path) -> None:
    Image.new("RGB", (LARGEST_SIDE + 40, 16), (90, 120, 40)).save(folder / "wide.jpg", quality=95)
    textures = Textures(ctx, software=True)
    texture = textures.at(folder / "wide.jpg")
    assert texture is not None, textures.problems
    assert np.abs(level_of(texture, 0, (8, 8))[..., :3].astype(int) - [90, 120, 40]).max() <= 2
    textures.forget()


def test_a_picture_drawn_first_or_after_another_is_the_same(ctx: moderngl.Context, head: Rig) -> None:
    with Offscreen(ctx=ctx) as first, Offscreen(ctx=ctx) as second:
        second.render(head, {"jaw": 0.5}, size=(64, 48), camera="left")
        one, other = (screen.render(head, {"smile": 1.0}, size=(96, 72)) for screen in (first, second))
    assert np.array_equal(one, other)


def test_an_interfaces_picture_keeps_its_rows_and_ends_at_its_border(ctx: moderngl.Context) -> None:
    pixels = np.asarray(noise("RGBA", (30, 20)))
    texture = texture_of(ctx, pixels)
    assert np.array_equal(level_of(texture, 0, (30, 20)), pixels)
    assert not (texture.repeat_x or texture.repeat_y)
    texture.release()
