"""Pictures for materials: read by Pillow, decoded to linear light in the shader, mipmapped by GL."""

from __future__ import annotations

import warnings
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from facemorph.core.mesh import Material
from facemorph.core.picture import PICTURE_FORMATS
from facemorph.errors import GraphicsError

if TYPE_CHECKING:
    import moderngl
    from PIL.Image import Image as Picture

# Beyond this side a texture is halved while it is read: it bounds memory at 4096 x 4096 x 4 bytes.
LARGEST_SIDE = 4096
ANISOTROPY = 8.0
LARGEST_PIXELS = 16384 * 16384


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

    @property
    def problems(self) -> tuple[str, ...]:
        """Which textures could not be shown, a line each; their parts keep their plain colour."""
        return tuple(self._problems.values())

    def of(self, material: Material) -> moderngl.Texture | None:
        """The material's texture; None where it has none that can be shown."""
        path = material.texture
        if path is None:
            return None
        if path not in self._read:
            try:
                self._read[path] = load_texture(self._ctx, path, self._anisotropy)
            except GraphicsError as error:
                self._read[path] = None
                self._problems[path] = str(error)
        return self._read[path]

    def keep(self, paths: Collection[Path]) -> None:
        """Give back the textures of other paths to the context."""
        for path in [path for path in self._read if path not in paths]:
            texture = self._read.pop(path)
            self._problems.pop(path, None)
            if texture is not None:
                texture.release()

    def forget(self) -> None:
        """Give the textures back to the context."""
        self.keep(())


def load_texture(ctx: moderngl.Context, path: Path, anisotropy: float) -> moderngl.Texture:
    """The picture at `path` as a mipmapped texture, bottom row first. Raises `GraphicsError`."""
    picture = _read(path)
    components = len(picture.getbands())
    texture = ctx.texture(picture.size, components, picture.tobytes())
    texture.build_mipmaps()
    texture.filter = (ctx.LINEAR_MIPMAP_LINEAR, ctx.LINEAR)
    if anisotropy > 1.0:
        texture.anisotropy = anisotropy
    return texture


def _read(path: Path) -> Picture:
    from PIL import Image

    try:
        with warnings.catch_warnings(), Image.open(path, formats=PICTURE_FORMATS) as opened:
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            if opened.width * opened.height > LARGEST_PIXELS:
                raise GraphicsError(
                    f"{path}: the texture is {opened.width}x{opened.height}; {LARGEST_SIDE} a side is plenty."
                )
            opened.draft("RGB", (LARGEST_SIDE, LARGEST_SIDE))
            see_through = "A" in opened.getbands() or "transparency" in opened.info
            picture: Picture = opened.convert("RGBA" if see_through else "RGB")
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise GraphicsError(
            f"{path}: the texture cannot be read ({error}); a plain colour stands in."
        ) from error
    if max(picture.size) > LARGEST_SIDE:
        picture.thumbnail((LARGEST_SIDE, LARGEST_SIDE), reducing_gap=2.0)
    return picture.transpose(Image.Transpose.FLIP_TOP_BOTTOM)
