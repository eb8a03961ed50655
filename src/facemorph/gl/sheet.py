"""A contact sheet: neutral and every expression of a face as labelled tiles, all by one camera."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from facemorph.core.arrays import UInt8
from facemorph.core.camera import Camera
from facemorph.core.lengths import displacements
from facemorph.core.picture import LARGEST_SIDE, Look, checked_size
from facemorph.core.pose import NEUTRAL, Pose
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.errors import OptionError
from facemorph.gl.heat import heat_end, heat_legend
from facemorph.gl.labels import as_image, fitted, font
from facemorph.gl.legend import legend_panel
from facemorph.gl.light_rigs import lights_of
from facemorph.gl.offscreen import Offscreen


def sheet(
    screen: Offscreen,
    rig: Rig,
    *,
    tile: tuple[int, int] = (320, 320),
    camera: Camera | str = "front",
    look: Look | None = None,
    names: tuple[str, ...] | None = None,
) -> UInt8:
    """Neutral and `names` (every expression; every shape where the rig has none) as (H, W, 4) uint8.

    `tile` is one tile's (width, height) in pixels; the tiles stand in rows, each over its label, with the
    face's name above them. A heat map has one scale for all tiles, up to the largest displacement of all
    (or `look.heat_max`), and one legend beside the name. Raises `OptionError` where the sheet would be too
    large.
    """
    width, height = checked_size(tile)
    states = _states(rig, names)
    look = _on_one_scale(look or Look(), rig, states)
    columns = _columns(len(states), width, height)
    rows = math.ceil(len(states) / columns)
    strip = _strip_height(tile)
    legend = _legend(look, rig, tile, columns * width)
    head = max(round(strip * 1.5), 0 if legend is None else legend.shape[0] + strip // 2)
    full = (columns * width, head + rows * (height + strip))
    if max(full) > 2 * LARGEST_SIDE:
        raise OptionError(
            f"{len(states)} tiles of {width}x{height} make a sheet of {full[0]}x{full[1]} pixels; "
            f"at most {2 * LARGEST_SIDE} a side. Ask for smaller tiles."
        )
    if isinstance(camera, str):
        camera = Camera.of_face(rig, camera, width / height)
    result = np.empty((full[1], full[0], 4), np.uint8)
    result[:] = _paper(look)
    for i, (name, _) in enumerate(states):
        top, left = head + (i // columns) * (height + strip), (i % columns) * width
        pose = Pose.between(NEUTRAL, name, 1.0)
        pixels = screen.render(rig, pose, size=tile, camera=camera, look=look, legend=False)
        result[top : top + height, left : left + width] = pixels
    room = columns * width
    if legend is not None:
        room -= legend.shape[1]
        _lay_over(result[(head - len(legend)) // 2 :, room - strip // 4 :], legend)
    labels = [label for _, label in states]
    return _lettered(result, rig.info.name, labels, columns, tile, head, strip, look, room)


def _states(rig: Rig, names: tuple[str, ...] | None) -> list[tuple[str, str]]:
    """Name and label of each tile."""
    if names is not None:
        shapes = [rig.shape(name) for name in names if name != NEUTRAL]
    else:
        shapes = list(rig.shapes_in(EXPRESSION) or rig.controls)
    return [(NEUTRAL, "Neutral"), *((shape.name, shape.label) for shape in shapes)]


def _on_one_scale(look: Look, rig: Rig, states: list[tuple[str, str]]) -> Look:
    """`look` with the heat map's end settled for all tiles alike."""
    if look.shading != "heat" or (look.heat_max is not None and look.heat_max > 0.0):
        return look
    neutral = rig.neutral.positions
    moved = (rig.positions(Pose.between(NEUTRAL, name, 1.0)) for name, _ in states)
    largest = max(float(displacements(positions, neutral).max(initial=0.0)) for positions in moved)
    return replace(look, heat_max=heat_end(largest, rig.info.unit, rig.neutral.diagonal or 1.0))


def _legend(look: Look, rig: Rig, tile: tuple[int, int], width: int) -> UInt8 | None:
    """The one legend of a heat map's tiles, for a sheet `width` wide; tiny sheets have no room for one."""
    letter = max(_letter_size(tile) * 0.8, 9.0)
    panel = round(min(width * 0.55, letter * 18.0))
    if look.shading != "heat" or look.heat_max is None or panel < letter * 8.0:
        return None
    return legend_panel(heat_legend(look.heat_max, rig.info.unit), panel, letter)


def _lay_over(pixels: UInt8, panel: UInt8) -> None:
    """Put `panel` over the top left of `pixels`, in place."""
    from PIL import Image

    under = pixels[: panel.shape[0], : panel.shape[1]]
    under[:] = np.asarray(Image.alpha_composite(as_image(under.copy()), as_image(panel)))


def _columns(count: int, width: int, height: int) -> int:
    """So many columns that the sheet is about 16:10 and its last row not nearly empty."""
    wanted = math.sqrt(count * 1.6 * height / width)
    choices = [n for n in range(1, count + 1) if 0.6 * wanted <= n <= 1.6 * wanted] or [count]
    return min(choices, key=lambda n: ((-count) % n / n + abs(math.log(n / wanted)), n))


def _strip_height(tile: tuple[int, int]) -> int:
    return round(_letter_size(tile) * 1.9)


def _letter_size(tile: tuple[int, int]) -> float:
    return float(np.clip(min(tile) / 15.0, 9.0, 34.0))


def _paper(look: Look) -> UInt8:
    """The sheet's own colour: that of the backdrop's corners, as `shaders/lib/backdrop.glsl` has it."""
    depth = lights_of(look.light).backdrop * min(1.2 * (1.0 - _luminance(look)), 1.0)
    shade = 1.0 - 0.38 * depth
    colour = [channel * shade for channel in look.backdrop[:3]] + [look.backdrop[3]]
    return (np.clip(colour, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)


def _luminance(look: Look) -> float:
    return float(np.dot(look.backdrop[:3], (0.3, 0.6, 0.1)))


def _ink(look: Look) -> tuple[int, int, int, int]:
    """Letters that can be read on the paper; grey where nobody knows what comes behind it."""
    if look.backdrop[3] <= 0.5:
        return 128, 132, 140, 255
    return (236, 238, 242, 255) if _luminance(look) < 0.5 else (24, 26, 30, 255)


def _lettered(
    sheet_pixels: UInt8,
    title: str,
    labels: list[str],
    columns: int,
    tile: tuple[int, int],
    head: int,
    strip: int,
    look: Look,
    room: int,
) -> UInt8:
    from PIL import ImageDraw

    picture = as_image(sheet_pixels)
    pen = ImageDraw.Draw(picture)
    ink = _ink(look)
    width, height = tile
    size = _letter_size(tile)
    large, small = font(size * 1.3), font(size)
    pen.text(
        (size * 0.7, head / 2),
        fitted(title, large, room - size * 1.4),
        font=large,
        fill=ink,
        anchor="lm",
    )
    for i, label in enumerate(labels):
        x = (i % columns) * width + width / 2
        y = head + (i // columns) * (height + strip) + height + strip / 2
        pen.text((x, y), fitted(label, small, width - size), font=small, fill=ink, anchor="mm")
    return np.asarray(picture, np.uint8)
