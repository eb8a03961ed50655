"""Pictures for materials: read by Pillow, decoded to linear light in the shader, mipmapped by GL."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from facemorph.errors import GraphicsError

if TYPE_CHECKING:
    import moderngl
    from PIL.Image import Image as Picture

# Beyond this side a texture is halved while it is read: it bounds memory at 4096 x 4096 x 4 bytes.
LARGEST_SIDE = 4096
LARGEST_PIXELS = 16384 * 16384


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
        with warnings.catch_warnings(), Image.open(path) as opened:
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            if opened.width * opened.height > LARGEST_PIXELS:
                raise GraphicsError(
                    f"{path}: the texture is {opened.width}x{opened.height}; {LARGEST_SIDE} a side is plenty."
                )
            opened.draft("RGB", (LARGEST_SIDE, LARGEST_SIDE))
            see_through = "A" in opened.getbands() or "transparency" in opened.info
            picture: Picture = opened.convert("RGBA" if see_through else "RGB")
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise GraphicsError(f"{path}: the texture cannot be read ({error}).") from error
    if max(picture.size) > LARGEST_SIDE:
        picture.thumbnail((LARGEST_SIDE, LARGEST_SIDE), reducing_gap=2.0)
    return picture.transpose(Image.Transpose.FLIP_TOP_BOTTOM)
