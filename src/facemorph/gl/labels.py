"""Words on pictures, by Pillow: sized to the room there is, shortened where it is not enough."""

from __future__ import annotations

from typing import TYPE_CHECKING

from facemorph.core.arrays import UInt8
from facemorph.resources import text_font

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageFont import FreeTypeFont, ImageFont

ELLIPSIS = "…"
# Roboto stands smaller in its em than Pillow's own; so letters of both are as high.
_ROBOTO_SIZE = 1.12


def font(size: float) -> FreeTypeFont | ImageFont:
    """A sans at `size` pixels: the window's Roboto, which has accents and Cyrillic, or else Pillow's own."""
    from PIL import ImageFont

    path = text_font()
    if path is None:
        return ImageFont.load_default(max(size, 6.0))
    return ImageFont.truetype(str(path), max(size, 6.0) * _ROBOTO_SIZE)


def text_width(text: str, face: FreeTypeFont | ImageFont) -> float:
    """How wide `text` is in pixels."""
    return float(face.getlength(text))


def fitted(text: str, face: FreeTypeFont | ImageFont, room: float) -> str:
    """`text`, or its beginning and an ellipsis, at most `room` pixels wide; or nothing at all."""
    if text_width(text, face) <= room:
        return text
    for length in range(len(text) - 1, 0, -1):
        short = text[:length].rstrip() + ELLIPSIS
        if text_width(short, face) <= room:
            return short
    return ""


def as_image(pixels: UInt8) -> Image:
    """Pixels (H, W, 4) as a Pillow picture."""
    from PIL import Image

    return Image.fromarray(pixels)
