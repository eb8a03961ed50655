"""Starting weights: the transferred shapes, what they make of each example, and what is set by hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.glow import glow_of
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.fit.result import Example
from facemorph.fit.starting import explained
from facemorph.fit.transferring import Transfer
from facemorph.ui.actions import tell_error
from facemorph.ui.fit_names import shapes_named
from facemorph.ui.fit_page import START_JOB, Preview, Start
from facemorph.ui.fit_plan import FitPlan, Piece
from facemorph.ui.state import App, Face

# A weight below this is not worth a row among those that matter.
_LEAST = 0.005
# With few shapes nothing needs to be held back; a shape by whose name an example goes shows in it.
_FREE, _SHOWS = 1e-6, 0.1
Worked = tuple[Preview, dict[int, Start]]


def refresh(app: App) -> None:
    """Once a frame while a step needs it: transfer the shapes and estimate weights, unless that is done."""
    plan, page = app.fit, app.pages.fit
    if not plan.ready or app.jobs.of_kind(START_JOB) is not None:
        return
    template, neutral = plan.template, plan.neutral
    assert template is not None and neutral is not None and neutral.fitted is not None
    key = _wanted(app)
    if key == page.failed or _worked_out(app):
        return
    rig, mesh, kept, starts = template.rig, neutral.fitted, page.preview, dict(page.starts)
    name = page.name or neutral.name

    def work(progress: Progress) -> Worked:
        return _work(rig, mesh, plan, kept, starts, name, progress)

    def done(found: Worked) -> None:
        page.preview, page.starts = found
        page.failed = ()

    def failed(error: BaseException) -> None:
        page.failed = key
        tell_error(app, "The template's shapes were not transferred", error)

    app.jobs.start("Transferring the shapes", work, done, failed, kind=START_JOB)


def _wanted(app: App) -> tuple[object, ...]:
    """What the preview and the estimates are made of."""
    plan = app.fit
    parts = ((piece.fitted, piece.name, piece.by_name) for piece in plan.pieces)
    return (plan.template.rig if plan.template else None, plan.used, *parts)


def stop(app: App) -> None:
    """Leave the preparations; they begin again when something of the plan changes, or by `again`."""
    job = app.jobs.of_kind(START_JOB)
    if job is not None:
        job.cancel()
        app.pages.fit.failed = _wanted(app)


def again(app: App) -> None:
    """Try the preparations once more."""
    app.pages.fit.failed = ()


def stopped(app: App) -> bool:
    """Whether the preparations failed or were left, for the plan as it is."""
    return app.fit.ready and app.pages.fit.failed == _wanted(app)


def preview(app: App) -> Preview | None:
    """The transferred shapes, where they are those of the present template and neutral."""
    plan, kept = app.fit, app.pages.fit.preview
    if kept is None or plan.template is None or plan.neutral is None:
        return None
    return kept if _same(kept.of, (plan.template.rig, plan.neutral.fitted)) else None


def start_of(app: App, piece: Piece) -> Start | None:
    """What was estimated for an example, where that still holds."""
    made, start = preview(app), app.pages.fit.starts.get(piece.key)
    if made is None or start is None:
        return None
    return start if start.of == _start_key(made, piece, app.fit.used) else None


def weights_of(app: App, piece: Piece) -> dict[str, float]:
    """The weights that an example starts from: the estimate, and over it what was set by hand."""
    start, used = start_of(app, piece), set(app.fit.used)
    found = {**(start.weights if start else {}), **piece.weights}
    return {name: weight for name, weight in found.items() if weight > 0.0 and name in used}


def set_weight(app: App, key: int, name: str, weight: float) -> None:
    """Set one starting weight by hand."""
    piece = app.fit.piece(key)
    if piece is not None:
        changed = {**piece.weights, name: min(max(weight, 0.0), 1.0)}
        app.fit = app.fit.put(replace(piece, weights=changed))


def reset_weight(app: App, key: int, name: str) -> None:
    """One starting weight as it was estimated."""
    piece = app.fit.piece(key)
    if piece is not None and name in piece.weights:
        kept = {other: weight for other, weight in piece.weights.items() if other != name}
        app.fit = app.fit.put(replace(piece, weights=kept))


def reset(app: App, key: int) -> None:
    """All starting weights of an example as they were estimated."""
    piece = app.fit.piece(key)
    if piece is not None and piece.weights:
        app.fit = app.fit.put(replace(piece, weights={}))


def toggle_named(app: App, key: int) -> None:
    """Estimate an example by the shapes that it is called by, or by all."""
    piece = app.fit.piece(key)
    if piece is not None:
        app.fit = app.fit.put(replace(piece, by_name=not piece.by_name))


def toggle_set(app: App, name: str) -> None:
    """Let a set of shapes explain the examples, or not; the last one stays."""
    plan = app.fit
    changed = replace(plan, without=plan.without ^ {name})
    if changed.used:
        app.fit = changed


def rows(app: App, piece: Piece, start: Start) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the shapes that matter to an example, first those that matter most; and of all others."""
    set_here = [name for name in piece.weights if name in app.fit.used]
    matter = [name for name in start.order if start.weights.get(name, 0.0) >= _LEAST or name in set_here]
    matter += [name for name in set_here if name not in matter]
    kept = set(matter)
    return tuple(matter), tuple(name for name in app.fit.used if name not in kept)


def distances(rig: Rig, weights: Mapping[str, float], placed: Float32) -> Float32:
    """How far the shapes in these weights are from an example, (V,), the person's unit."""
    away = rig.positions(dict(weights)) - placed
    return np.asarray(np.linalg.norm(away, axis=1), np.float32)


def light(app: App, rig: Rig, name: str) -> Float32:
    """Where a shape moves the face; kept while the same is asked for."""
    return app.pages.fit.keep(("light", rig, name), lambda: glow_of(rig, {name: 1.0}))


def _same(kept: tuple[Rig, Mesh], now: tuple[Rig, Mesh | None]) -> bool:
    return kept[0] is now[0] and kept[1] is now[1]


def _worked_out(app: App) -> bool:
    return preview(app) is not None and all(start_of(app, piece) is not None for piece in app.fit.examples)


def _work(
    rig: Rig, neutral: Mesh, plan: FitPlan, kept: Preview | None, starts: dict[int, Start], name: str,
    progress: Progress,
) -> Worked:  # fmt: skip
    if kept is None or not _same(kept.of, (rig, neutral)):
        from facemorph.fit.checks import points_of
        from facemorph.fit.example_based import person

        points = points_of(rig, neutral, "the neutral")
        way = Transfer(rig, points).prepared(lambda part, doing: progress(0.8 * part, doing))
        own = person(rig, neutral, way, way.offsets)
        face = shown_person(own, name)
        kept, starts = Preview((rig, neutral), way, face), {}
    found: dict[int, Start] = {}
    for done, piece in enumerate(plan.examples):
        progress(0.8 + 0.2 * done / len(plan.examples), f"estimating the weights of {piece.name}")
        known = starts.get(piece.key)
        of = _start_key(kept, piece, plan.used)
        found[piece.key] = known if known is not None and known.of == of else _start(kept, piece, plan.used)
    return kept, found


def _start_key(made: Preview, piece: Piece, used: tuple[str, ...]) -> tuple[object, ...]:
    return (made, piece.fitted, piece.name, piece.by_name, used)


def _start(made: Preview, piece: Piece, used: tuple[str, ...]) -> Start:
    """The estimate: by all shapes that may explain the example, or by those alone that it is called by."""
    assert piece.fitted is not None
    shapes = [shape for shape in made.face.rig.controls if shape.name in used]
    named = shapes_named(piece.name, shapes) if piece.by_name else ()
    example = None
    if named:
        (example,) = explained(made.way, {piece.name: piece.fitted}, named, stiffness=_FREE)
        named = named if max(example.weights.values(), default=0.0) >= _SHOWS else ()
    if example is None or not named:
        (example,) = explained(made.way, {piece.name: piece.fitted}, used)
    rig = made.face.rig
    return Start(
        _start_key(made, piece, used), example.weights, placed(rig, example), _order(made, example), named
    )


def placed(rig: Rig, example: Example) -> Float32:
    """An example (V, 3) where the fit has put it: beside its neutral."""
    return np.asarray(rig.positions(dict(example.weights)) + example.offsets, np.float32)


def _order(made: Preview, example: Example) -> tuple[str, ...]:
    """The shapes with a weight, those first that move the face most in it."""
    rig = made.face.rig
    sizes = {
        name: weight * float(np.linalg.norm(rig.deltas[rig.names.index(name)]))
        for name, weight in example.weights.items()
    }
    return tuple(sorted(sizes, key=lambda name: -sizes[name]))


def shown_person(rig: Rig, name: str) -> Face:
    """A person's rig to be looked at: without wrinkles, which the skin has and no example's mesh."""
    return Face(replace(rig, wrinkles=(), info=replace(rig.info, name=name)), (name,))
