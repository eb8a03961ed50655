"""Plots: ImPlot in the window's colours."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot

from facemorph.core.arrays import Float64
from facemorph.ui.state import App
from facemorph.ui.theme import Rgba, faded
from facemorph.ui.widgets import colours, unit

# Lines are told apart on both grounds, also by people who see few colours (after Okabe and Ito).
INKS: dict[str, tuple[Rgba, ...]] = {
    "dark": ((0.35, 0.71, 0.91, 1), (0.95, 0.65, 0.15, 1), (0.25, 0.78, 0.55, 1), (0.87, 0.55, 0.78, 1)),
    "light": ((0.0, 0.40, 0.65, 1), (0.75, 0.33, 0.0, 1), (0.0, 0.48, 0.35, 1), (0.62, 0.25, 0.50, 1)),
}


@dataclass(frozen=True, eq=False)
class Line:
    """One line of a plot: its name in the legend, x (n,) and y (n,).

    dots    marks each value
    ground  a wide, quiet line under the others, which may lie upon it
    """

    name: str
    x: Float64
    y: Float64
    dots: bool = False
    ground: bool = False


def plot(
    app: App,
    name: str,
    x_title: str,
    y_title: str,
    lines: tuple[Line, ...],
    *,
    height: float,
    legend: bool = True,
    logarithmic: bool = False,
    at: float | None = None,
    steps: int = 0,
) -> None:
    """Draw lines over one pair of axes, as wide as there is room. `at` marks an x with an upright line;
    with `steps` x counts from 1 to so many.

    The legend stands in the plot, over room that no line enters.
    """
    if implot.get_current_context() is None:
        implot.create_context()
    _dress(app)
    flags = implot.Flags_.no_menus | implot.Flags_.no_title | implot.Flags_.no_box_select
    # The wheel over a plot scrolls the page; lines and axes fit by themselves.
    flags |= (
        implot.Flags_.no_mouse_text | implot.Flags_.no_inputs | (0 if legend else implot.Flags_.no_legend)
    )
    if implot.begin_plot(f"##{name}", ImVec2(-1, height), flags):
        fit = implot.AxisFlags_.auto_fit | implot.AxisFlags_.no_highlight | implot.AxisFlags_.no_menus
        still = fit & ~implot.AxisFlags_.auto_fit
        implot.setup_axes(x_title, y_title, still if steps else fit, still)
        if steps:
            implot.setup_axis_limits(implot.ImAxis_.x1, 0.5, steps + 0.5, imgui.Cond_.always)
            implot.setup_axis_ticks(implot.ImAxis_.x1, 1.0, float(steps), steps)
        if logarithmic:
            implot.setup_axis_scale(implot.ImAxis_.y1, implot.Scale_.log10)
        line_height = imgui.get_text_line_height()
        inside = max(height - line_height * (2.6 if x_title else 1.4), 1.0)
        low, high = _limits(lines, (line_height * 1.5) / inside if legend else 0.0, logarithmic=logarithmic)
        implot.setup_axis_limits(implot.ImAxis_.y1, low, high, imgui.Cond_.always)
        if legend:
            flat = implot.LegendFlags_.horizontal | implot.LegendFlags_.no_menus
            implot.setup_legend(implot.Location_.north, flat)
        for place, line in enumerate(sorted(lines, key=lambda line: not line.ground)):
            implot.plot_line(line.name, _array(line.x), _array(line.y), _spec(app, place, line))
        if at is not None:
            mark = implot.Spec(line_color=ImVec4(*colours(app).dim), line_weight=unit())
            implot.plot_inf_lines("##now", np.array([at]), mark)
        implot.end_plot()
    _undress()


@contextlib.contextmanager
def aligned_plots(name: str) -> Iterator[None]:
    """Plots drawn in the block have their axes one under the other."""
    if implot.get_current_context() is None:
        implot.create_context()
    aligned = implot.begin_aligned_plots(name)
    try:
        yield
    finally:
        if aligned:
            implot.end_aligned_plots()


def _limits(lines: tuple[Line, ...], spare: float, *, logarithmic: bool) -> tuple[float, float]:
    """The y axis' ends: all lines with a margin, and the part `spare` of its height free above them."""
    values = np.concatenate([line.y[np.isfinite(line.y)] for line in lines] or [np.zeros(1)])
    if logarithmic:
        values = np.log10(values[values > 0.0])
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    # A line that does not change stands in the middle, on an axis that says so.
    middle = (high - low) <= 1e-6 * max(abs(low), abs(high), 1e-3)
    margin = max(abs(high) / 2.0, 0.1) if middle else 0.06 * (high - low)
    low, high = low - margin, high + margin
    high = low + (high - low) / (1.0 - min(spare, 0.5))
    return (10.0**low, 10.0**high) if logarithmic else (low, high)


def release_plots() -> None:
    """Give back what plots hold of the present ImGui context."""
    context = implot.get_current_context()
    if context is not None:
        implot.destroy_context(context)


def _array(values: Float64) -> Float64:
    return np.ascontiguousarray(values, np.float64)


def _spec(app: App, place: int, line: Line) -> implot.Spec:
    inks = INKS[app.settings.theme]
    ink = ImVec4(*(faded(colours(app).dim, 0.55) if line.ground else inks[place % len(inks)]))
    spec = implot.Spec(line_color=ink, line_weight=(7.0 if line.ground else 2.0) * unit())
    if line.dots:
        spec.marker, spec.marker_size = implot.Marker_.circle, 3.0 * unit()
        spec.marker_fill_color = spec.marker_line_color = ink
    return spec


_COLOURS = 6
_SIZES = 3


def _dress(app: App) -> None:
    c, scale = colours(app), unit()
    clear = ImVec4(0, 0, 0, 0)
    implot.push_style_color(implot.Col_.frame_bg, clear)
    implot.push_style_color(implot.Col_.plot_bg, ImVec4(*c.field))
    implot.push_style_color(implot.Col_.plot_border, ImVec4(*c.line))
    implot.push_style_color(implot.Col_.legend_bg, ImVec4(*c.field))
    implot.push_style_color(implot.Col_.legend_border, clear)
    implot.push_style_color(implot.Col_.axis_grid, ImVec4(*c.line))
    implot.push_style_var(implot.StyleVar_.plot_padding, ImVec2(12 * scale, 4 * scale))
    implot.push_style_var(implot.StyleVar_.label_padding, ImVec2(3 * scale, 3 * scale))
    implot.push_style_var(implot.StyleVar_.legend_padding, ImVec2(2 * scale, 2 * scale))
    imgui.push_style_color(imgui.Col_.text, ImVec4(*c.text))


def _undress() -> None:
    imgui.pop_style_color()
    implot.pop_style_var(_SIZES)
    implot.pop_style_color(_COLOURS)
