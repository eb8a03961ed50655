"""A part of the Handles page: the paper's own use of RBF, an expression rebuilt from n control points."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from facemorph.core.arrays import Float64
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.deform.rbf import KERNELS
from facemorph.ui import rebuilding
from facemorph.ui.on_face import OnlyPaints
from facemorph.ui.on_screen import faces_away, projected, surface_of
from facemorph.ui.panels.kernels import KERNEL_WORDS, kernel_rows
from facemorph.ui.panels.rows import quiet_words
from facemorph.ui.panels.value_rows import (
    Value,
    button_row,
    choice_row,
    expression_words,
    switch_row,
    value_row,
)
from facemorph.ui.plots import Line, plot
from facemorph.ui.state import App
from facemorph.ui.theme import faded, packed
from facemorph.ui.widgets import colours, unit
from facemorph.ui.words import label_of

_TIP = (
    "The displacements of n points from the source to the target are all that is known; the RBF through "
    "them moves the rest, (2.13) to (2.15). The face shows what comes of it, the colours its error."
)


def draw(app: App, rig: Rig) -> None:
    """The section; while it is on, the face shows the rebuilt expression."""
    page = app.lab.rebuild
    shapes = rig.shapes_in(EXPRESSION)
    if not shapes:
        quiet_words("This face has no expressions to rebuild.")
        page.on = False
        return
    if page.target not in rig.names:
        page.target = shapes[0].name
    page.on = switch_row(app, "Rebuild on the face", page.on, _TIP)
    if not page.on:
        return
    _settings(app, rig)
    rebuilding.refresh(app, rig)
    _result(app, rig)
    _kernels(app, rig)
    if page.scene is not None:
        app.on_face.scene = page.scene
        app.on_face.legend = "Error"
        app.on_face.words = _words(app, rig)
        app.on_face.shading = "heat" if page.heat else None
        app.on_face.tool = _Shown()


def _settings(app: App, rig: Rig) -> None:
    page, words = app.lab.rebuild, expression_words(rig)
    page.source = choice_row(app, "rebuild source", "From", page.source, words, "Where the points start")
    page.target = choice_row(app, "rebuild target", "To", page.target, words, "What is to be rebuilt")
    row = Value("rebuild n", "Points n", page.count, rebuilding.LEAST, rebuilding.MOST, _COUNT_TIP, 40, 0)
    page.count = round(value_row(app, row))
    page.kernel, page.c = kernel_rows(app, rig, "rebuild", page.kernel, page.c)
    page.heat = switch_row(app, "Error as heat map", page.heat, "Distance to the true target, by colour")


_COUNT_TIP = "Landmarks first, then the places that are farthest from all others, more where more moves"


def _result(app: App, rig: Rig) -> None:
    page = app.lab.rebuild
    imgui.spacing()
    if page.problem:
        imgui.push_text_wrap_pos(0.0)
        imgui.push_style_color(imgui.Col_.text, colours(app).error)
        imgui.text_unformatted(page.problem)
        imgui.pop_style_color()
        imgui.pop_text_wrap_pos()
    elif page.result is not None:
        result = page.result
        imgui.text_unformatted(f"Error: rms {result.rms_percent:.3f} %, largest {result.max_percent:.2f} %")
        quiet_words(
            f"of the face's diagonal ({result.diagonal:.1f} {rig.info.unit}). "
            f"Set-up {result.bind_secs * 1000:.0f} ms, a drag {result.drag_secs * 1000:.1f} ms."
        )


def _words(app: App, rig: Rig) -> tuple[str, ...]:
    page = app.lab.rebuild
    count = len(page.vertices)
    return (f"{label_of(rig, page.target)} rebuilt from {count} points",)


def _kernels(app: App, rig: Rig) -> None:
    page = app.lab.rebuild
    running = app.jobs.of_kind("sweep")
    tip = "Rebuilds with 8 to 250 points and every kernel, and draws error and time"
    words = "Comparing…" if running else "Compare kernels"
    if button_row(app, ((words, tip, running is None),)):
        rebuilding.sweep(app, rig)
    if page.sweep is None or page.swept != (rig, page.source, page.target, page.c):
        return
    imgui.spacing()
    counts = page.sweep.counts
    height = 190 * unit()
    for name, title, values in (
        ("error", "rms error, % of diagonal", page.sweep.errors),
        ("time", "time, ms", page.sweep.bind_ms),
    ):
        lines = tuple(
            Line(
                KERNEL_WORDS[kernel], counts[np.isfinite(values[kernel])], _finite(values[kernel]), dots=True
            )
            for kernel in KERNELS
        )
        plot(
            app,
            name,
            "control points n",
            title,
            lines,
            height=height,
            legend=name == "error",
            logarithmic=True,
        )


def _finite(values: Float64) -> Float64:
    return values[np.isfinite(values)]


class _Shown(OnlyPaints):
    """Where the control points are; the mouse turns the face as ever."""

    def paint(self, app: App) -> None:
        """The control points as dots."""
        page, surface = app.lab.rebuild, app.surface(surface_of)
        if surface is None or page.result is None:
            return
        vertices = list(page.vertices)
        points = page.result.positions[vertices].astype(np.float64)
        places, _ = projected(app, points)
        paint, scale = imgui.get_window_draw_list(), unit()
        for (x, y), away in zip(places, faces_away(app, surface, vertices, points), strict=True):
            if not away:
                paint.add_circle_filled((x, y), 3.2 * scale, packed(faded((0.05, 0.06, 0.07, 1), 0.9)))
                paint.add_circle_filled((x, y), 2.0 * scale, packed((1, 1, 1, 1)))
