"""Examples that are the neutral scan's own mesh: the wrapped template is carried along to them."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from dataclasses import replace

from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.core.reorder import same_polygons
from facemorph.core.rig import Rig
from facemorph.ui.actions import tell_error
from facemorph.ui.fit_plan import Finding, Piece, bare
from facemorph.ui.state import App

JOB = "fit carry"


def refresh(app: App) -> None:
    """Once a frame while the page is on show: carry what is to be carried, and again after another wrap."""
    neutral = app.fit.neutral
    by = neutral.fitted if neutral is not None else None
    present = app.history.present
    # What a step that is not yet settled brings about is part of that step.
    before, settled = app.fit, present is not None and present.fit == app.fit
    for piece in app.fit.examples:
        if piece.carried_by is not None and piece.carried_by is not by:
            kept = replace(bare(piece), pairs=piece.pairs, weights=piece.weights)
            app.fit = app.fit.put(replace(kept, finding=Finding("checking")))
    if settled and app.fit is not before:
        app.history.carry(lambda snapshot: replace(snapshot, fit=app.fit))
    if neutral is None or neutral.quality is None or app.jobs.of_kind(JOB) is not None:
        return
    wanted = [piece for piece in app.fit.examples if piece.fitted is None and _is_twin(app, neutral, piece)]
    if wanted:
        _carry(app, neutral, wanted)


def with_unseen(
    template: Rig, neutral: Mesh, expressions: Sequence[Mesh], shapes: Sequence[str]
) -> list[Mesh]:
    """Expressions of scans with teeth, tongue, lashes and hair where their skin says that they are.

    shapes  names of those that may explain the skin
    """
    from facemorph.fit.unseen import with_likely_parts

    placed = with_likely_parts(template, neutral, expressions, shapes)
    return [neutral.with_positions(positions) for positions in placed]


def _is_twin(app: App, neutral: Piece, piece: Piece) -> bool:
    """Whether an example is the neutral's mesh in another expression, and may be carried."""
    if piece.finding.standing != "other" or piece.mesh.vertex_count != neutral.mesh.vertex_count:
        return False
    if neutral.fitted is None or _tried(neutral.fitted, piece) in app.pages.fit.untwinned:
        return False
    key = ("twins", neutral.mesh, piece.mesh)
    return app.pages.fit.keep(key, lambda: same_polygons(neutral.mesh, piece.mesh))


def _tried(wrapped: Mesh, piece: Piece) -> object:
    return weakref.ref(wrapped), weakref.ref(piece.mesh)


def _carry(app: App, neutral: Piece, pieces: list[Piece]) -> None:
    wrapped, template, used = neutral.fitted, app.fit.template, app.fit.used
    assert wrapped is not None and template is not None

    def work(progress: Progress) -> list[Piece]:
        from facemorph.fit.registration import followed

        gone = []
        for done, piece in enumerate(pieces):
            progress(done / (len(pieces) + 1), f"carrying the template along to {piece.name}")
            gone.append(wrapped.with_positions(followed(wrapped, neutral.mesh, piece.mesh)))
        progress(len(pieces) / (len(pieces) + 1), "placing what the scans do not show")
        words = "The neutral's mesh in another expression: the wrapped template is carried along."
        return [
            replace(piece, finding=Finding("fits", words), fitted=fitted, carried_by=wrapped)
            for piece, fitted in zip(pieces, with_unseen(template.rig, wrapped, gone, used), strict=True)
        ]

    # Once only: neither cancelled nor failed work begins again of itself.
    tried = frozenset(_tried(wrapped, piece) for piece in pieces)
    app.pages.fit.untwinned |= tried

    def done(found: list[Piece]) -> None:
        app.pages.fit.untwinned -= tried
        for before, piece in zip(pieces, found, strict=True):
            if app.fit.piece(piece.key) is before and app.fit.neutral is neutral:
                app.fit = app.fit.put(piece)
        app.history.carry(lambda snapshot: replace(snapshot, fit=app.fit))

    def failed(error: BaseException) -> None:
        tell_error(app, "The template was not carried along", error)

    app.jobs.start("Carrying the template along", work, done, failed, kind=JOB)
