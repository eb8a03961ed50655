"""The renderer's own framebuffer: with or without multisampling, read as a picture or a texture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import UInt8
from facemorph.errors import GraphicsError

if TYPE_CHECKING:
    import moderngl

_ROWS_AT_ONCE = 32
# A pixel that is opaque and black, as one number.
_ALPHA = np.array([0, 0, 0, 255], np.uint8).view(np.uint32)[0]


class Target:
    """Colour and depth of one size. `texture` holds the finished picture, premultiplied by its alpha.

    What is drawn into is made when it is first asked for: pictures alone need no depth without samples.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self.size = (0, 0)
        self._colour: moderngl.Texture | None = None
        self._finished: moderngl.Framebuffer | None = None
        self._plain: moderngl.Framebuffer | None = None
        self._sampled: moderngl.Framebuffer | None = None

    @property
    def texture(self) -> moderngl.Texture:
        """The finished picture; its first row is the lowest."""
        if self._colour is None:
            raise GraphicsError("nothing has been drawn yet; call draw first.")
        return self._colour

    def prepare(self, size: tuple[int, int], samples: int) -> moderngl.Framebuffer:
        """The framebuffer to draw a picture of `size` into, with so many samples (0: none)."""
        if size != self.size:
            self._resize(size)
        assert self._colour is not None
        if samples == 0:
            if self._plain is None:
                self._plain = self._ctx.framebuffer([self._colour], self._ctx.depth_renderbuffer(size))
            return self._plain
        if self._sampled is None:
            self._sampled = self._ctx.framebuffer(
                [self._ctx.renderbuffer(size, 4, samples=samples)],
                self._ctx.depth_renderbuffer(size, samples=samples),
            )
        return self._sampled

    def _resize(self, size: tuple[int, int]) -> None:
        largest = int(self._ctx.info["GL_MAX_TEXTURE_SIZE"])
        if max(size) > largest:
            raise GraphicsError(
                f"this OpenGL draws at most {largest} pixels a side; {size[0]}x{size[1]} is more."
            )
        self.release()
        self._colour = self._ctx.texture(size, 4)
        self._colour.filter = (self._ctx.LINEAR, self._ctx.LINEAR)
        # Without depth: where there is some on both sides, it would be brought over with the colours.
        self._finished = self._ctx.framebuffer([self._colour])
        self.size = size

    def finish(self, drawn: moderngl.Framebuffer) -> None:
        """Bring what was drawn into `texture`."""
        if drawn is self._sampled and self._finished is not None:
            self._ctx.copy_framebuffer(self._finished, drawn)

    def read(self) -> UInt8:
        """The picture (H, W, 4) uint8, top row first, straight alpha."""
        if self._finished is None:
            raise GraphicsError("nothing has been drawn yet; call draw first.")
        width, height = self.size
        pixels = np.empty((height, width, 4), np.uint8)
        self._finished.read_into(pixels, components=4, alignment=1)
        _turn_over(pixels)
        # All channels of a pixel at once: numpy is three times slower at every fourth byte.
        least = np.bitwise_and.reduce(pixels.view(np.uint32), axis=None)
        if least & _ALPHA != _ALPHA:
            _unmultiply(pixels)
        return pixels

    def release(self) -> None:
        """Give the framebuffers back to the context."""
        for framebuffer in (self._finished, self._plain, self._sampled):
            if framebuffer is not None:
                for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
                    if attachment is not None:
                        attachment.release()
                framebuffer.release()
        self._finished = self._plain = self._sampled = self._colour = None
        self.size = (0, 0)


def _turn_over(pixels: UInt8) -> None:
    """The last row first, in place: a second array of a picture's size costs more than moving its rows."""
    height = len(pixels)
    for start in range(0, height // 2, _ROWS_AT_ONCE):
        end = min(start + _ROWS_AT_ONCE, height // 2)
        above, below = pixels[start:end], pixels[height - end : height - start]
        kept = above.copy()
        above[:] = below[::-1]
        below[:] = kept[::-1]


def _unmultiply(pixels: UInt8) -> None:
    """Colours divided by their alpha, in place."""
    alpha = pixels[..., 3:].astype(np.float32)
    straight = pixels[..., :3] * (255.0 / np.maximum(alpha, 1.0))
    pixels[..., :3] = np.minimum(straight + 0.5, 255.0)
