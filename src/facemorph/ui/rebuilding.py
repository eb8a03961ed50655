"""Rebuilding an expression from n points, beside the window: the one asked for, and the sweep over n."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32
from facemorph.core.pose import Pose, state_of
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.deform.control_points import rebuilding_vertices
from facemorph.deform.rbf import KERNELS, Kernel, nearest_mean
from facemorph.deform.rebuild import Rebuilt, rebuilt
from facemorph.errors import DeformError, FacemorphError
from facemorph.ui.actions import tell_error
from facemorph.ui.lab import Sweep
from facemorph.ui.state import App

COUNTS = (8, 12, 20, 30, 40, 60, 80, 120, 160, 250)
LEAST, MOST = 4, 250


def refresh(app: App, rig: Rig) -> None:
    """Have the expression rebuilt that is asked for now, unless that is done or under way."""
    page = app.lab.rebuild
    asked = (rig, page.source, page.target, page.count, page.kernel, page.c)
    if page.asked == asked:
        return
    page.asked = asked
    source, target, count, kernel, c = page.source, page.target, page.count, page.kernel, page.c

    def work(progress: Progress) -> tuple[Rebuilt, Scene, tuple[int, ...]]:
        progress(0.0, "Choosing points")
        first, last = rig.positions(state_of(source)), rig.positions(state_of(target))
        vertices = rebuilding_vertices(rig, first, last, count, kernel, c)
        progress(0.4, "Solving")
        result = rebuilt(rig, first, last, vertices, kernel, c)
        scene = Scene(Pose(), result.positions - rig.neutral.positions, reference=last)
        return result, scene, tuple(int(vertex) for vertex in vertices)

    def done(made: tuple[Rebuilt, Scene, tuple[int, ...]]) -> None:
        page.result, page.scene, page.vertices = made
        page.problem = ""

    def failed(error: BaseException) -> None:
        page.result, page.scene, page.vertices = None, None, ()
        if isinstance(error, FacemorphError):
            page.problem = str(error)
        else:
            tell_error(app, "The expression was not rebuilt", error)

    app.jobs.start("Rebuilding", work, done, failed, kind="rebuild", quiet=True)


def sweep(app: App, rig: Rig) -> None:
    """Measure error and time against n for every kernel."""
    page = app.lab.rebuild
    key = (rig, page.source, page.target, page.c)
    source, target, c = page.source, page.target, page.c

    def work(progress: Progress) -> Sweep:
        return swept(rig, rig.positions(state_of(source)), rig.positions(state_of(target)), c, progress)

    def done(result: Sweep) -> None:
        page.sweep, page.swept = result, key

    def failed(error: BaseException) -> None:
        tell_error(app, "The kernels were not compared", error)

    app.jobs.start("Comparing kernels", work, done, failed, kind="sweep")


def swept(rig: Rig, source: Float32, target: Float32, c: float | None, progress: Progress) -> Sweep:
    """Error and time for each kernel and count; not a number where a system cannot be solved."""
    counts = [count for count in COUNTS if count <= rig.neutral.vertex_count // 2]
    errors = {kernel: np.full(len(counts), np.nan) for kernel in KERNELS}
    times = {kernel: np.full(len(counts), np.nan) for kernel in KERNELS}
    chosen = _chosen(rig, source, target, counts, c, progress)
    for place, count in enumerate(counts):
        for number, kernel in enumerate(KERNELS):
            # The cost of a count grows with it, so progress goes by points and not by counts.
            before = sum(counts[:place]) + count * number / len(KERNELS)
            progress(before / sum(counts), f"{count} points, kernel {kernel}")
            _measure(rig, source, target, chosen[kernel][place], kernel, c, place, errors, times)
    return Sweep(np.array(counts, np.float64), errors, times)


def _chosen(
    rig: Rig, source: Float32, target: Float32, counts: list[int], c: float | None, progress: Progress
) -> dict[Kernel, list[Int32]]:
    """The points of each kernel and count. Fewer points are the first of more, as long as c is the same."""
    chosen: dict[Kernel, list[Int32]] = {}
    for kernel in KERNELS:
        progress(0.0, f"Choosing points, kernel {kernel}")
        if kernel != "multiquadric" or c is not None:
            most = rebuilding_vertices(rig, source, target, counts[-1], kernel, c)
            chosen[kernel] = [most[:count] for count in counts]
            continue
        # c as `rebuilding_vertices` takes it where none is given, without choosing those of r again.
        own = [nearest_mean(source[points].astype(np.float64)) for points in chosen["r"]]
        chosen[kernel] = []
        for count, own_c in zip(counts, own, strict=True):
            progress(0.0, f"Choosing {count} points, kernel {kernel}")
            chosen[kernel].append(rebuilding_vertices(rig, source, target, count, kernel, own_c))
    return chosen


def _measure(
    rig: Rig, source: Float32, target: Float32, vertices: Int32,
    kernel: Kernel, c: float | None, place: int, errors: dict[Kernel, Float64], times: dict[Kernel, Float64],
) -> None:  # fmt: skip
    try:
        result = rebuilt(rig, source, target, vertices, kernel, c)
    except DeformError:
        return
    errors[kernel][place] = result.rms_percent
    times[kernel][place] = (result.bind_secs + result.drag_secs) * 1000.0
