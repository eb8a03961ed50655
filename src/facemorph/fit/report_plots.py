"""The report's pictures: errors of the methods, over alpha, and against noise."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from facemorph.fit.report import FitReport, Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_INK, _PAPER = "#20242b", "#ffffff"
_TRAINING, _HELD = "#1f6fb4", "#d9822b"
_UNIT = "error (% of the face's diagonal)"


def methods_plot(report: FitReport) -> Figure:
    """A bar for each method's error on the examples, and one on expressions not seen."""
    figure, axes = _figure()
    rows = report.rows
    places = list(range(len(rows)))
    seen = [row.held_out is not None for row in rows]
    height = 0.38 if any(seen) else 0.6
    shift = height / 2 if any(seen) else 0.0
    training = [row.training for row in rows]
    bars = axes.barh([p - shift for p in places], training, height, color=_TRAINING, label="the examples")
    axes.bar_label(bars, fmt="%.3f", padding=3, fontsize=9)
    if any(seen):
        held = [row.held_out or 0.0 for row in rows]
        bars = axes.barh([p + shift for p in places], held, height, color=_HELD, label="expressions not seen")
        axes.bar_label(bars, fmt="%.3f", padding=3, fontsize=9)
    axes.set_yticks(places, [row.method for row in rows])
    axes.invert_yaxis()
    axes.margins(x=0.14)
    axes.set_xlabel(_UNIT)
    axes.set_title("How well each method makes this person's expressions")
    axes.legend(frameon=False)
    return figure


def alpha_plot(report: FitReport) -> Figure:
    """E over alpha (the paper's figure 2), with plain transfer as a line."""
    figure, axes = _figure()
    _lines(axes, report.over_alpha)
    axes.set_xscale("log")
    axes.set_xticks(values := [point.value for point in report.over_alpha], [f"{v:g}" for v in values])
    axes.minorticks_off()
    transfer = next((row for row in report.rows if row.method == "deformation transfer"), None)
    if transfer is not None:
        axes.axhline(
            transfer.training,
            color=_INK,
            linewidth=1.0,
            linestyle=":",
            label="plain transfer, weights as given",
        )
    axes.set_xlabel("alpha: how much the template's motion counts beside the examples")
    axes.set_title("Error over alpha")
    axes.legend(frameon=False)
    return figure


def noise_plot(report: FitReport) -> Figure:
    """E against noise in the starting weights (the paper's figure 1)."""
    figure, axes = _figure()
    _lines(axes, report.over_noise)
    axes.set_xlabel("noise added to the starting weights (standard deviation)")
    axes.set_title("Error against noise in the starting weights")
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False)
    return figure


PLOTS: Mapping[str, Callable[[FitReport], Figure]] = MappingProxyType(
    {"methods": methods_plot, "alpha": alpha_plot, "noise": noise_plot}
)


def save_plot(figure: Figure, path: Path) -> None:
    """Write a figure as a PNG into `path` itself; the same figure gives the same bytes."""
    figure.savefig(path, format="png", dpi=160, facecolor=_PAPER, metadata={"Software": None})


def _figure() -> tuple[Figure, Any]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.grid(axis="both", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def _lines(axes: Axes, points: Sequence[Point]) -> None:
    values = [point.value for point in points]
    axes.plot(values, [p.training for p in points], "o-", color=_TRAINING, label="the examples")
    held = [point.held_out for point in points if point.held_out is not None]
    if len(held) == len(points):
        axes.plot(values, held, "s-", color=_HELD, label="expressions not seen")
    axes.set_ylabel(_UNIT)
