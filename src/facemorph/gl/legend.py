"""The heat map's legend drawn into a picture: a bar with ticks, its title and unit, at the left edge.

Everything is sized by the picture, so that it is legible and inside from 200 x 200 pixels up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import UInt8
from facemorph.gl.heat import Legend
from facemorph.gl.labels import as_image, fitted, font, text_width

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

_INK = (240, 242, 245, 255)
_SOFT_INK = (205, 209, 216, 255)
_PANEL = (18, 20, 24, 190)


def with_legend(pixels: UInt8, legend: Legend) -> UInt8:
    """`pixels` (H, W, 4) with `legend` at the left, in the lower half; the same size."""
    from PIL import Image, ImageDraw

    picture = as_image(pixels)
    width, height = picture.size
    size = float(np.clip(min(width, height) / 34.0, 10.0, 30.0))
    layer = Image.new("RGBA", picture.size, (0, 0, 0, 0))
    _Bar(legend, width, height, size).draw(ImageDraw.Draw(layer), layer)
    return np.asarray(Image.alpha_composite(picture, layer), np.uint8)


class _Bar:
    """The measures of one legend in one picture, pixels."""

    def __init__(self, legend: Legend, width: int, height: int, size: float) -> None:
        self.legend = legend
        self.font = font(size)
        self.small = font(size * 0.9)
        self.gap = max(round(size * 0.6), 4)
        self.line = round(size * 1.35)
        self.thick = max(round(size * 0.9), 7)
        self.length = int(min(height * 0.42, size * 16))
        self.margin = max(round(size * 0.7), 4)
        tick_width = max((text_width(text, self.small) for _, text in legend.ticks), default=0.0)
        body = self.thick + self.gap + tick_width
        self.room = width - 2 * self.margin - 2 * self.gap
        self.title = fitted(legend.title, self.font, self.room)
        self.unit = fitted(legend.unit, self.small, self.room)
        wide = max(body, text_width(self.title, self.font), text_width(self.unit, self.small))
        self.box = (int(wide) + 2 * self.gap + 1, self.length + 2 * self.line + 3 * self.gap + self.line // 2)
        self.left = self.margin
        self.top = max(height - self.margin - self.box[1], 0)

    def draw(self, pen: ImageDraw, layer: object) -> None:
        from PIL import Image

        right, bottom = self.left + self.box[0], self.top + self.box[1]
        pen.rounded_rectangle((self.left, self.top, right, bottom), radius=self.gap, fill=_PANEL)
        x, y = self.left + self.gap, self.top + self.gap
        pen.text((x, y), self.title, font=self.font, fill=_INK)
        pen.text((x, y + self.line), self.unit, font=self.small, fill=_SOFT_INK)
        y += 2 * self.line + self.gap
        rows = np.linspace(len(self.legend.colours) - 1, 0, self.length).round().astype(int)
        bar = np.repeat(self.legend.colours[rows][:, None], self.thick, axis=1)
        assert isinstance(layer, Image.Image)
        layer.paste(Image.fromarray(np.ascontiguousarray(bar)), (x, y))
        self._ticks(pen, x + self.thick, y)

    def _ticks(self, pen: ImageDraw, x: int, y: int) -> None:
        lowest_used = float("inf")
        for place, text in self.legend.ticks:
            at = y + round((1.0 - place) * (self.length - 1))
            if lowest_used - at < self.line * 0.85:
                continue
            pen.line((x, at, x + self.gap // 2, at), fill=_INK)
            pen.text((x + self.gap, at), text, font=self.small, fill=_INK, anchor="lm")
            lowest_used = at
