"""Words on pictures, by Pillow: sized to the room there is, shortened where it is not enough."""

from __future__ import annotations

from typing import TYPE_CHECKING

from facemorph.core.arrays import UInt8

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageFont import FreeTypeFont, ImageFont

ELLIPSIS = "…"


def font(size: float) -> FreeTypeFont | ImageFont:
    """Pillow's own sans at `size` pixels; it travels with Pillow, so pictures are alike everywhere."""
    from PIL import ImageFont

    return ImageFont.load_default(max(size, 6.0))


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
