"""What is written over two views of a face: the line between them, and what each of them shows."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.ui.state import App, Viewport
from facemorph.ui.theme import faded, packed
from facemorph.ui.widgets import colours, cut, unit

_ROOMY = 330.0


def paint_split_words(app: App) -> None:
    """Draw them, where there are two views; the present ImGui window covers the viewport."""
    views, split = app.views(), app.on_face.split
    if split is None:
        return
    _line(app, views[1])
    for words, side in zip(split.words, (-1.0, 1.0), strict=True):
        _title(app, views[1], words, side)


def _line(app: App, right: Viewport) -> None:
    ink = packed(colours(app).line)
    imgui.get_window_draw_list().add_line(
        (right.x, right.y), (right.x, right.y + right.height), ink, 2 * unit()
    )


def _title(app: App, right: Viewport, words: str, side: float) -> None:
    """What a view shows, beside the line between both: left of it where `side` is -1."""
    c, pad = colours(app), 8 * unit()
    words = cut(words, right.width * 0.6)
    size = imgui.calc_text_size(words)
    x = right.x + 3 * pad if side > 0 else right.x - 3 * pad - size.x
    # Where there is little room, under the face's name.
    y = right.y + (16 if right.width > _ROOMY * unit() else 76) * unit()
    low, high = (x - 1.5 * pad, y - 0.6 * pad), (x + size.x + 1.5 * pad, y + size.y + 0.6 * pad)
    paint = imgui.get_window_draw_list()
    paint.add_rect_filled(low, high, packed(faded(c.panel, 0.86)), 6 * unit())
    paint.add_text((x, y), packed(c.text), words)
