"""Lists in textures: GL 3.3 has no buffers a shader may index freely, so rows of texels stand in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.errors import GraphicsError

if TYPE_CHECKING:
    import moderngl

WIDTH = 1024


def grid_size(count: int, largest: int) -> tuple[int, int]:
    """Columns and rows for `count` texels. Raises `GraphicsError` where a texture cannot hold so many."""
    width = min(max(WIDTH, -(-count // largest)), largest)
    rows = max(-(-count // width), 1)
    if rows > largest:
        raise GraphicsError(
            f"this OpenGL's textures hold {largest * largest} values; the mesh needs {count}. "
            "Set the morph path to cpu."
        )
    return width, rows


def padded(values: np.ndarray[tuple[int, ...], np.dtype[np.generic]], size: tuple[int, int]) -> bytes:
    """Rows (n, components) as the bytes of a whole grid, zeros behind them."""
    missing = size[0] * size[1] * values.itemsize * values.shape[1] - values.nbytes
    return np.ascontiguousarray(values).tobytes() + b"\0" * missing


def list_texture(
    ctx: moderngl.Context, values: np.ndarray[tuple[int, int], np.dtype[np.generic]], dtype: str, largest: int
) -> moderngl.Texture:
    """Values (n, components) as a texture for `texelFetch`, element i at `texel_of(i, width)`."""
    size = grid_size(len(values), largest)
    texture = ctx.texture(size, values.shape[1], padded(values, size), dtype=dtype)
    texture.filter = (ctx.NEAREST, ctx.NEAREST)
    return texture
