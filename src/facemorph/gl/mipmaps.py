"""Textures with mip levels that are made here, each texel the mean of the four it stands for.

OpenGL's own cost more: where it runs on the CPU it compiles a program for each kind of texture first, 50 ms
a piece. It also rounds as the driver likes, on the CPU upwards, by 3 of 255 at the smallest level.
moderngl gives a texture no levels but by OpenGL's own way, so its context is asked for GL's functions.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from facemorph.core.arrays import UInt8

if TYPE_CHECKING:
    import moderngl
    from PIL.Image import Image as Picture

_TEXTURE_2D, _UNSIGNED_BYTE = 0x0DE1, 0x1401
_R8, _RGB8, _RGBA8, _RED, _RGBA = 0x8229, 0x8051, 0x8058, 0x1903, 0x1908
# What moderngl asks of the contexts that it is lent.
_LOAD = "load_opengl_function"
# Rows that are handed over at once: small blocks of memory are used again, large ones asked for anew.
_STRIP = 64
# Pillow's number for its box filter.
_BOX = 4


@dataclass(frozen=True)
class _Format:
    """For pictures of a mode: a texture's components and format, and how its bytes are handed over."""

    components: int
    internal: int
    raw: str
    of_bytes: int


# Pillow keeps three colours in four bytes, and so do drivers.
_FORMATS = {
    "L": _Format(1, _R8, "L", _RED),
    "RGB": _Format(3, _RGB8, "RGBX", _RGBA),
    "RGBA": _Format(4, _RGBA8, "RGBA", _RGBA),
}


def mip_levels(picture: Picture) -> Iterator[Picture]:
    """The picture (L, RGB or RGBA), and halves of the one before, sides rounded down, to a single texel."""
    while max(picture.size) > 1:
        yield picture
        picture = _halved(picture)
    yield picture


def mipmapped(
    ctx: moderngl.Context, levels: Iterable[Picture], *, upside_down: bool = True
) -> moderngl.Texture:
    """A texture of the levels that `mip_levels` makes; L is grey.

    moderngl takes it for one of a single texel: draw with it, but neither read nor write it.

    upside_down   whether the picture's last row becomes the texture's first, as OpenGL counts rows
    """
    step = -1 if upside_down else 1
    load = _loader(ctx)
    if load is None:
        return _by_opengl(ctx, next(iter(levels)), step)
    filled: _Filled | None = None
    for level in levels:
        filled = filled or _Filled(ctx, _FORMATS[level.mode], load)
        filled.add(level, step)
    assert filled is not None, "a picture has a level at least"
    return filled.texture


def texture_of(ctx: moderngl.Context, pixels: UInt8) -> moderngl.Texture:
    """`mipmapped` of pixels (H, W, 4) or (H, W, 3) uint8, their first row first.

    For interfaces: what lies beyond its border is its border.
    """
    from PIL import Image

    texture = mipmapped(ctx, mip_levels(Image.fromarray(pixels)), upside_down=False)
    texture.repeat_x = texture.repeat_y = False
    return texture


def _loader(ctx: moderngl.Context) -> Callable[[str], int] | None:
    """What knows the addresses of OpenGL's functions; None where moderngl does not tell."""
    load: Callable[[str], int] | None = getattr(getattr(ctx.mglo, "_context", None), _LOAD, None)
    return load


def _by_opengl(ctx: moderngl.Context, picture: Picture, step: int) -> moderngl.Texture:
    """The same with levels that OpenGL makes."""
    components = _FORMATS[picture.mode].components
    texture = ctx.texture(picture.size, components, picture.tobytes("raw", picture.mode, 0, step))
    texture.build_mipmaps()
    return _set_up(texture)


def _set_up(texture: moderngl.Texture) -> moderngl.Texture:
    texture.filter = (texture.ctx.LINEAR_MIPMAP_LINEAR, texture.ctx.LINEAR)
    if texture.components == 1:
        texture.swizzle = "RRR1"
    return texture


def _halved(picture: Picture) -> Picture:
    from PIL import Image

    if picture.mode == "RGBA":
        # Each channel for itself, as OpenGL does it: Pillow would weigh colours by their opacity.
        return Image.merge("RGBA", [_halved(band) for band in picture.split()])
    width, height = picture.size
    return picture.resize((max(width // 2, 1), max(height // 2, 1)), _BOX, reducing_gap=1.0)


class _Filled:
    """A texture that gets one level after the other."""

    def __init__(self, ctx: moderngl.Context, form: _Format, load: Callable[[str], int]) -> None:
        self._form = form
        self._image, self._part = (_function(load(f"gl{name}")) for name in ("TexImage2D", "TexSubImage2D"))
        # Of one texel at first: only once Mesa knows of the filter it makes room for all levels together.
        self.texture = _set_up(ctx.texture((1, 1), form.components))
        self.texture.use(ctx.default_texture_unit)
        self._count = 0

    def add(self, level: Picture, step: int) -> None:
        """The next level; `step` is 1 for its first row first, -1 for its last."""
        form, number, (width, height) = self._form, self._count, level.size
        self._count += 1
        of_bytes = form.of_bytes, _UNSIGNED_BYTE
        self._image(_TEXTURE_2D, number, form.internal, width, height, 0, *of_bytes, None)
        for start in range(0, height, _STRIP):
            end = min(start + _STRIP, height)
            top, bottom = (start, end) if step > 0 else (height - end, height - start)
            texels = level.crop((0, top, width, bottom)).tobytes("raw", form.raw, 0, step)
            self._part(_TEXTURE_2D, number, 0, start, width, end - start, *of_bytes, texels)


def _function(address: int) -> Callable[..., None]:
    """One of the two functions that fill a texture, whose parameters are of the same kinds."""
    uint, whole = ctypes.c_uint, ctypes.c_int
    # Windows calls OpenGL in a way of its own.
    prototype = getattr(ctypes, "WINFUNCTYPE", ctypes.CFUNCTYPE)
    kinds: Any = (uint, whole, whole, whole, whole, whole, uint, uint, ctypes.c_char_p)
    made: Callable[..., None] = prototype(None, *kinds)(address)
    return made
