"""Making the person's shapes beside the window, and saving them as a face that opens like any other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError
from facemorph.fit.example_based import example_based
from facemorph.fit.residual import THRESHOLD_PERCENT, with_residual
from facemorph.fit.result import Example, FitResult, Iteration
from facemorph.fit.starting import explained
from facemorph.fit.transferring import Transfer
from facemorph.ui import files, fit_weights
from facemorph.ui.actions import show_page, tell_error
from facemorph.ui.fit_page import MAKE, MAKE_JOB, RESULT, Made
from facemorph.ui.state import App

# Weights free from any guess: the best that the transferred shapes can do.
_FREE = 1e-6


def can_make(app: App) -> bool:
    """Whether everything is there, and nothing is being made."""
    started = all(fit_weights.start_of(app, piece) is not None for piece in app.fit.examples)
    return app.fit.ready and fit_weights.preview(app) is not None and started and not running(app)


def is_poor(example: Example) -> bool:
    """Whether more is left of an example than the template's shapes can make (see `fit.residual`)."""
    return example.worst_percent > THRESHOLD_PERCENT


def running(app: App) -> bool:
    """Whether shapes are being made."""
    return app.jobs.of_kind(MAKE_JOB) is not None


def is_current(app: App) -> bool:
    """Whether what was made last was made from the plan as it is now."""
    made = app.pages.fit.made
    return made is not None and made.plan == app.fit


def make(app: App) -> None:
    """Fit the shapes; what was made before stays until that has gone well."""
    plan, page, ready = app.fit, app.pages.fit, fit_weights.preview(app)
    if not can_make(app) or plan.template is None or plan.neutral is None or ready is None:
        return
    template, neutral, way = plan.template.rig, plan.neutral.fitted, ready.way
    assert neutral is not None
    examples = {piece.name: piece.fitted for piece in plan.examples if piece.fitted is not None}
    weights = [fit_weights.weights_of(app, piece) for piece in plan.examples]
    told: list[Iteration] = []
    page.told = told

    def work(progress: Progress) -> tuple[FitResult, tuple[Example, ...]]:
        return _fitted(template, neutral, examples, weights, plan.used, plan.iterations, way, told, progress)

    def done(found: tuple[FitResult, tuple[Example, ...]]) -> None:
        now = app.fit.neutral
        if now is None or plan.neutral is None or now.key != plan.neutral.key:
            page.told = []
            return
        result, plain = found
        face = fit_weights.shown_person(result.rig, page.name or "person")
        page.made, page.shape_for = Made(plan, result, plain, face, result), ""
        page.saved = ""
        if app.fit == plan and page.step == MAKE:
            page.step = RESULT

    def failed(error: BaseException) -> None:
        page.told = []
        tell_error(app, "The shapes were not made", error)

    app.jobs.start(f"Making the shapes of {page.name or 'the person'}", work, done, failed, kind=MAKE_JOB)


def _fitted(
    template: Rig, neutral: Mesh, examples: dict[str, Mesh], weights: Sequence[dict[str, float]],
    used: tuple[str, ...], iterations: int, way: Transfer, told: list[Iteration], progress: Progress,
) -> tuple[FitResult, tuple[Example, ...]]:  # fmt: skip
    result = example_based(
        template,
        neutral,
        examples,
        weights if examples else None,
        iterations=iterations,
        shapes=used,
        progress=lambda part, doing: progress(0.95 * part, doing),
        each=told.append,
    )
    progress(0.95, "comparing with plain transfer")
    plain = explained(way, examples, used, stiffness=_FREE) if examples else ()
    progress(1.0, "done")
    return result, plain


def cancel(app: App) -> None:
    """Stop; what was made before is there as before."""
    job = app.jobs.of_kind(MAKE_JOB)
    if job is not None:
        job.cancel()
        app.pages.fit.told = []


def shape_name(made: Made, example: Example) -> str:
    """A name for what is left of an example: the example's own, where no shape is called so."""
    name, number = example.name, 2
    while name in made.result.rig.names:
        name, number = f"{example.name} {number}", number + 1
    return name


def add_shape(app: App, example: Example, name: str) -> None:
    """What is left of an example becomes a shape of its own."""
    made = app.pages.fit.made
    if made is not None:
        _with_shapes(app, made, (*made.added, (example.name, name.strip())))


def take_shape_out(app: App, example: str) -> None:
    """Without the shape that was made of what is left of an example."""
    made = app.pages.fit.made
    if made is not None:
        _with_shapes(app, made, tuple(pair for pair in made.added if pair[0] != example))


def _with_shapes(app: App, made: Made, added: tuple[tuple[str, str], ...]) -> None:
    result = made.without
    try:
        for example, name in added:
            result = with_residual(result, example, name)
    except FacemorphError as error:
        tell_error(app, "No shape was added", error)
        return
    page = app.pages.fit
    face = fit_weights.shown_person(result.rig, made.face.title)
    page.made = replace(made, result=result, added=added, face=face)
    page.saved = ""


def save(app: App, folder: Path) -> None:
    """Write the person as a face folder; nothing is overwritten."""
    page, made = app.pages.fit, app.pages.fit.made
    if made is None:
        return
    name = page.name or folder.name
    rig = replace(made.result.rig, info=replace(made.result.rig.info, name=name))

    def work(progress: Progress) -> Path:
        from facemorph.io import write_face

        return write_face(rig, folder, progress=progress)

    def done(written: Path) -> None:
        if page.made is made:
            page.saved = str(written)
        app.messages.tell(f"Saved {written}")

    def failed(error: BaseException) -> None:
        tell_error(app, f"{folder.name} was not saved", error)

    app.jobs.start(f"Saving {folder.name}", work, done, failed)


def open_saved(app: App) -> None:
    """Open the face that was saved, with all its shapes in sight; the page keeps what it has."""
    if app.pages.fit.saved:
        files.open_source(app, (app.pages.fit.saved,))
        show_page(app, "Shapes")


def open_step(app: App, step: int) -> None:
    """Open one of the page's steps."""
    app.pages.fit.step = step


def file_name(app: App) -> str:
    """What the face folder is first called."""
    return app.pages.fit.name
