"""Pictures for materials: read by Pillow, decoded to linear light in the shader."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import UInt8
from facemorph.core.mesh import Material
from facemorph.core.picture import PICTURE_FORMATS
from facemorph.errors import GraphicsError
from facemorph.gl.mipmaps import mip_levels, mipmapped

if TYPE_CHECKING:
    import moderngl
    from PIL.Image import Image as Picture

# Beyond this side a texture is halved while it is read: it bounds memory at 4096 x 4096 x 4 bytes.
LARGEST_SIDE = 4096
ANISOTROPY = 8.0
LARGEST_PIXELS = 16384 * 16384
# Of the small copies that tell what a picture is of. They are shrunk from a level with that many times the
# side: levels are rounded, each a little upwards. Pillow's number for its box filter.
SMALL_SIDE = 64
_SPARE = 2
_BOX = 4


class Textures:
    """The textures of the face that is loaded, each read when it is first drawn.

    `problems` tells which could not be shown, a line each; their parts keep their plain colour.
    """

    def __init__(self, ctx: moderngl.Context, *, software: bool) -> None:
        self._ctx = ctx
        # Several times the texture reads: too dear where they are made on the CPU.
        self._anisotropy = 1.0 if software else min(ANISOTROPY, float(ctx.max_anisotropy))
        self._read: dict[Path, moderngl.Texture | None] = {}
        self._problems: dict[Path, str] = {}
        self._shrunk: dict[Path, Picture] = {}

    @property
    def problems(self) -> tuple[str, ...]:
        """Which textures could not be shown, a line each; their parts keep their plain colour."""
        return tuple(self._problems.values())

    def of(self, material: Material) -> moderngl.Texture | None:
        """The material's texture; None where it has none that can be shown."""
        return self.at(material.texture)

    def at(self, path: Path | None) -> moderngl.Texture | None:
        """The texture of the picture at `path`; None where there is none that can be shown."""
        if path is None:
            return None
        if path not in self._read:
            try:
                self._read[path] = self._load(path)
            except GraphicsError as error:
                self._read[path] = None
                self._problems[path] = str(error)
        return self._read[path]

    def small(self, path: Path) -> UInt8 | None:
        """The picture at `path` shrunk to `SMALL_SIDE` a side, (n, n, channels) sRGB, bottom row first."""
        if self.at(path) is None:
            return None
        shrunk = self._shrunk[path]
        if shrunk.size != (SMALL_SIDE, SMALL_SIDE):
            shrunk = shrunk.resize((SMALL_SIDE, SMALL_SIDE), _BOX)
            self._shrunk[path] = shrunk
        return np.asarray(shrunk, np.uint8).reshape(SMALL_SIDE, SMALL_SIDE, -1)[::-1]

    def holds_normals(self, path: Path | None) -> bool:
        """Whether the picture is of normals, which are blue, and not of heights, which are grey."""
        small = self.small(path) if path is not None else None
        if small is None or small.shape[2] < 3:
            return False
        red, _, blue = small[..., :3].reshape(-1, 3).mean(axis=0).tolist()
        return bool(blue > 160.0 and blue > 1.2 * red)

    def _load(self, path: Path) -> moderngl.Texture:
        """Read the picture at `path`. Raises `GraphicsError`."""
        texture = mipmapped(self._ctx, self._noted(path, mip_levels(_read(path))))
        if self._anisotropy > 1.0:
            texture.anisotropy = self._anisotropy
        return texture

    def _noted(self, path: Path, levels: Iterable[Picture]) -> Iterator[Picture]:
        """The levels, the smallest that is large enough for a small copy noted as they pass."""
        for level in levels:
            if path not in self._shrunk or min(level.size) >= _SPARE * SMALL_SIDE:
                self._shrunk[path] = level
            yield level

    def keep(self, paths: Collection[Path]) -> None:
        """Give back the textures of other paths to the context."""
        for path in [path for path in self._read if path not in paths]:
            texture = self._read.pop(path)
            self._problems.pop(path, None)
            self._shrunk.pop(path, None)
            if texture is not None:
                texture.release()

    def forget(self) -> None:
        """Give the textures back to the context."""
        self.keep(())


def _read(path: Path) -> Picture:
    """The picture at `path` as L, RGB or RGBA, no larger than a texture may be. Raises `GraphicsError`."""
    from PIL import Image

    # Without it Pillow loads its readers of all formats, as soon as it has to try more than one.
    Image.preinit()
    try:
        with warnings.catch_warnings(), Image.open(path, formats=PICTURE_FORMATS) as opened:
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            if opened.width * opened.height > LARGEST_PIXELS:
                raise GraphicsError(
                    f"{path}: the texture is {opened.width}x{opened.height}; {LARGEST_SIDE} a side is plenty."
                )
            opened.draft("RGB", (LARGEST_SIDE, LARGEST_SIDE))
            see_through = "A" in opened.getbands() or "transparency" in opened.info
            grey = opened.mode == "L" and not see_through
            mode = "RGBA" if see_through else "L" if grey else "RGB"
            opened.load()
            # A picture of the wanted mode would be copied.
            picture: Picture = opened if opened.mode == mode else opened.convert(mode)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise GraphicsError(
            f"{path}: the texture cannot be read ({error}); a plain colour stands in."
        ) from error
    if max(picture.size) > LARGEST_SIDE:
        picture.thumbnail((LARGEST_SIDE, LARGEST_SIDE), reducing_gap=2.0)
    return picture
