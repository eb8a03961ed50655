"""The heat map's legend drawn into a picture: a bar with ticks, its title and its unit.

It stands at the left of wide pictures and lies along the bottom of narrow ones, where it covers the
neck and not the face. Everything is sized by the picture, so that it is legible and inside from
200 x 200 pixels up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import UInt8
from facemorph.gl.heat import Legend
from facemorph.gl.labels import as_image, fitted, font, text_width

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

_INK = (240, 242, 245, 255)
_SOFT_INK = (205, 209, 216, 255)
_PANEL = (18, 20, 24, 190)
_SMALLEST_PICTURE = 64
_LYING_BELOW = 480  # pixels of width


def with_legend(pixels: UInt8, legend: Legend) -> UInt8:
    """`pixels` (H, W, 4) with `legend` over them; the same size. Tiny pictures have no room for one."""
    from PIL import Image, ImageDraw

    if min(pixels.shape[:2]) < _SMALLEST_PICTURE:
        return pixels
    picture = as_image(pixels)
    layer = Image.new("RGBA", picture.size, (0, 0, 0, 0))
    draw = _lying if picture.width < _LYING_BELOW else _standing
    draw(layer, ImageDraw.Draw(layer), legend, _Measures(picture.width, picture.height))
    return np.array(Image.alpha_composite(picture, layer), np.uint8)


def legend_panel(legend: Legend, width: int, letter: float) -> UInt8:
    """`legend` alone, lying, (H, W, 4): `width` pixels wide with letters of so many pixels."""
    from PIL import Image, ImageDraw

    measures = _Measures(width, 0, letter)
    measures.margin = 0
    layer = Image.new("RGBA", (width, _lying_height(measures) + 1), (0, 0, 0, 0))
    measures.height = layer.height
    _lying(layer, ImageDraw.Draw(layer), legend, measures)
    return np.array(layer, np.uint8)


class _Measures:
    """Sizes in pixels that both forms share."""

    def __init__(self, width: int, height: int, letter: float | None = None) -> None:
        size = float(np.clip(min(width, height) / 34.0, 10.0, 30.0)) if letter is None else letter
        self.width, self.height = width, height
        self.font, self.small = font(size), font(size * 0.9)
        self.gap = max(round(size * 0.6), 4)
        self.margin = max(round(size * 0.7), 4)
        self.line = round(size * 1.35)
        self.thick = max(round(size * 0.9), 7)
        self.size = size


def _standing(layer: Image, pen: ImageDraw, legend: Legend, m: _Measures) -> None:
    """The bar upright at the lower left, its words above it."""
    from PIL import Image

    length = int(min(m.height * 0.42, m.size * 16))
    room = m.width - 2 * m.margin - 2 * m.gap
    title, unit = fitted(legend.title, m.font, room), fitted(legend.unit, m.small, room)
    ticks = max((text_width(text, m.small) for _, text in legend.ticks), default=0.0)
    wide = max(m.thick + m.gap + ticks, text_width(title, m.font), text_width(unit, m.small))
    box = (int(wide) + 2 * m.gap + 1, length + 2 * m.line + 3 * m.gap + m.line // 2)
    left, top = m.margin, max(m.height - m.margin - box[1], 0)
    pen.rounded_rectangle((left, top, left + box[0], top + box[1]), radius=m.gap, fill=_PANEL)
    x, y = left + m.gap, top + m.gap
    pen.text((x, y), title, font=m.font, fill=_INK)
    pen.text((x, y + m.line), unit, font=m.small, fill=_SOFT_INK)
    y += 2 * m.line + m.gap
    layer.paste(Image.fromarray(_bar(legend, length, m.thick).transpose(1, 0, 2)[::-1].copy()), (x, y))
    x += m.thick
    last = float("inf")
    for place, text in legend.ticks:
        at = y + round((1.0 - place) * (length - 1))
        if last - at < m.line * 0.85:
            continue
        pen.line((x, at, x + m.gap // 2, at), fill=_INK)
        pen.text((x + m.gap, at), text, font=m.small, fill=_INK, anchor="lm")
        last = at


def _lying_height(m: _Measures) -> int:
    return 2 * m.line + m.thick + m.gap


def _lying(layer: Image, pen: ImageDraw, legend: Legend, m: _Measures) -> None:
    """The bar along the bottom, its words over it and its ticks under it."""
    from PIL import Image

    box_width = m.width - 2 * m.margin
    box_height = _lying_height(m)
    left, top = m.margin, max(m.height - m.margin - box_height, 0)
    pen.rounded_rectangle((left, top, left + box_width, top + box_height), radius=m.gap, fill=_PANEL)
    ends = max((text_width(text, m.small) / 2 for _, text in legend.ticks), default=0.0)
    x = left + m.gap + int(ends)
    length = max(left + box_width - m.gap - int(ends) - x, 1)
    words = fitted(f"{legend.title}, {legend.unit}", m.font, box_width - 2 * m.gap)
    pen.text((left + m.gap, top + m.gap // 2), words, font=m.font, fill=_INK)
    y = top + m.gap // 2 + m.line
    layer.paste(Image.fromarray(_bar(legend, length, m.thick)), (x, y))
    free_from = float("-inf")
    for place, text in legend.ticks:
        at, half = x + place * (length - 1), text_width(text, m.small) / 2
        if at - half < free_from:
            continue
        pen.line((round(at), y + m.thick, round(at), y + m.thick + m.gap // 3), fill=_INK)
        pen.text((at, y + m.thick + m.gap // 3 + 2), text, font=m.small, fill=_INK, anchor="mt")
        free_from = at + half + m.gap


def _bar(legend: Legend, length: int, thick: int) -> UInt8:
    """The colours from low at the left to high at the right, (thick, length, 3)."""
    columns = np.linspace(0, len(legend.colours) - 1, length).round().astype(int)
    return np.repeat(legend.colours[columns][None], thick, axis=0)
