"""What the page Fit shows in the viewport, step by step: the template, the scan, the person, the example."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.mesh import Mesh
from facemorph.core.polygons import with_polygons
from facemorph.core.pose import Pose
from facemorph.core.rig import FaceInfo, Rig
from facemorph.core.scene import Scene
from facemorph.fit.result import Example
from facemorph.fit.units import MM_PER, unit_of
from facemorph.gl.heat import heat_end
from facemorph.ui import fit_weights, fit_wrap
from facemorph.ui.fit_page import EXAMPLES, NEUTRAL, RESULT, SAVE, TEMPLATE, WEIGHTS, Preview, Start
from facemorph.ui.fit_plan import Piece
from facemorph.ui.on_face import Split
from facemorph.ui.state import App, Face

if TYPE_CHECKING:
    from facemorph.fit.registration import Quality

_SHOWN_OF_P95, _SHOWN_AT_LEAST = 3.0, 0.001
HEAT_WORDS = "Distance to the example"


@dataclass(frozen=True)
class Views:
    """The left view, and what of the right one; words for both."""

    face: Face
    scene: Scene
    words: tuple[str, ...]
    split: Split | None = None


def put(app: App) -> None:
    """Say what the viewport shows now."""
    views = _views(app)
    if views is None:
        return
    app.on_face.stage, app.on_face.scene = views.face, views.scene
    app.on_face.words, app.on_face.split = views.words, views.split


def _views(app: App) -> Views | None:
    plan, page = app.fit, app.pages.fit
    template = plan.template
    if template is None:
        return None
    if page.step in (TEMPLATE, NEUTRAL):
        if page.step == NEUTRAL and plan.neutral is not None:
            return _beside(app, template, plan.neutral)
        return None if template is app.face else Views(template, _rest(app), ("The template",))
    if page.step == EXAMPLES:
        return _example(app, template)
    if page.step in (RESULT, SAVE) and page.made is not None:
        return _result(app)
    return _preview(app, template)


def _beside(app: App, left: Face, piece: Piece) -> Views:
    """A piece beside what it is compared with, in its place; where it was wrapped, both in its own."""
    page = app.pages.fit
    if piece.finding.standing == "other" and piece.quality is not None and page.shows_wrap:
        return _wrapped(app, piece)
    right, template = scan_face(app, piece), app.fit.template
    of_template = template is not None and left.rig.neutral is template.rig.neutral
    if fit_wrap.pointed_piece(app) is piece:
        left = app.pages.fit.keep(("bald", left.rig.neutral), partial(_bald, left))
    base = left.rig.neutral
    key = ("placed", piece.shown, fit_wrap.placed_by(app, piece), base, _turned(app, piece))
    moved = app.pages.fit.keep(key, lambda: _placed(app, piece, base))
    words = ("Template" if of_template else "At rest", piece.name)
    return Views(left, _rest(app), (_asked(app, piece),), Split(moved, words, heat=False, face=right))


def _bald(face: Face) -> Face:
    """A face without hair, which scans lack, and which hides ears and brows that are to be pointed at."""
    mesh, used = face.rig.neutral, face.rig.neutral.materials_used
    if used is None:
        return face
    hair = np.array(["hair" in name.casefold() for name in (*used.names, "")])[used.index]
    if hair.all() or not hair.any():
        return face
    rig = _without_shapes(with_polygons(mesh, ~hair), face.title, face.rig.info.unit)
    return Face(replace(rig, info=face.rig.info), face.source)


def _asked(app: App, piece: Piece) -> str:
    from facemorph.ui.fit_landmarks import words_of

    if fit_wrap.pointed_piece(app) is not piece:
        return "Side by side"
    wanted = fit_wrap.wanted_vertex(app, piece)
    if wanted is None:
        return "Click a point here, then on the right"
    return f"Next: {words_of(wanted[1], wanted[0]).lower()}"


def _turned(app: App, piece: Piece) -> object:
    rotation = app.pages.fit.turns.get(piece.key)
    return None if rotation is None else rotation.tobytes()


def _placed(app: App, piece: Piece, base: Mesh) -> Scene:
    way = fit_wrap.placement(app, piece, base)
    goal = way.points(piece.shown.positions.astype(np.float64))
    return Scene(Pose(), (goal - piece.shown.positions).astype(np.float32))


def _wrapped(app: App, piece: Piece) -> Views:
    """The scan, and the template wrapped around it, coloured by its distance."""
    fitted, quality = piece.fitted, piece.quality
    assert fitted is not None and quality is not None
    right = app.pages.fit.keep(
        ("wrapped", fitted), lambda: Face(_bare_rig(app, fitted, "wrapped"), (piece.name,))
    )
    unit = right.rig.info.unit
    # The heat map shows how far each vertex is from a reference: one as far off as it is from the scan.
    scene = app.pages.fit.keep(
        ("quality", quality),
        lambda: Scene(Pose(), reference=_off(fitted.positions, _told_by_colour(quality, unit))),
    )
    split = Split(scene, (piece.name, "Wrapped around it"), heat=True, face=right)
    app.on_face.legend = "To the scan (red: more)"
    return Views(scan_face(app, piece), _rest(app), ("The scan as it came",), split)


def _told_by_colour(quality: Quality, unit: str) -> Float32:
    """Distances to a scan where it has the surface; those beyond most others as the map's end."""
    most = max(_SHOWN_OF_P95 * quality.p95, _SHOWN_AT_LEAST * quality.diagonal)
    most = heat_end(most, unit, quality.diagonal)
    return np.minimum(quality.distances * quality.judged, np.float32(most))


def _off(positions: Float32, distances: Float32) -> Float32:
    off = positions.copy()
    off[:, 2] += distances
    return off


def _example(app: App, template: Face) -> Views | None:
    plan = app.fit
    piece = fit_wrap.shown_example(app)
    if piece is None:
        return _beside(app, template, plan.neutral) if plan.neutral is not None else None
    neutral = plan.neutral
    if neutral is None or neutral.fitted is None:
        return _beside(app, template, piece)
    base = neutral.fitted
    left = app.pages.fit.keep(
        ("neutral", base), lambda: Face(_bare_rig(app, base, neutral.name), (neutral.name,))
    )
    return _beside(app, left, piece)


def _preview(app: App, template: Face) -> Views | None:
    """The transferred shapes in the starting weights, and the example beside them."""
    made, piece = fit_weights.preview(app), fit_wrap.shown_example(app)
    if made is None:
        return _example(app, template)
    start = fit_weights.start_of(app, piece) if piece is not None else None
    if piece is None or start is None:
        return Views(made.face, _rest(app), ("The template's shapes, transferred",))
    weights = fit_weights.weights_of(app, piece)
    left = app.pages.fit.keep(
        ("mixture", made, tuple(sorted(weights.items()))), lambda: Scene(Pose.of(weights))
    )
    lit = app.on_face.glow
    if lit is not None:
        left = Scene(left.pose, glow=lit)
    right = _against(app, made, start, weights)
    words = ("These weights", piece.name)
    app.on_face.legend = HEAT_WORDS
    heat = app.pages.fit.heat and app.pages.fit.step == WEIGHTS
    return Views(made.face, left, ("Plain transfer",), Split(right, words, heat=heat))


def _against(app: App, made: Preview, start: Start, weights: dict[str, float]) -> Scene:
    """The example, and how far the mixture is from it."""
    rig = made.face.rig
    offsets = app.pages.fit.keep(
        ("example", made, start), lambda: Scene(Pose(), start.placed - rig.neutral.positions)
    )
    key = ("against", made, start, tuple(sorted(weights.items())))
    return app.pages.fit.keep(key, lambda: Scene(Pose(), offsets.offsets, reference=rig.positions(weights)))


def _result(app: App) -> Views:
    """The fitted person, and the example with what is left of it."""
    page = app.pages.fit
    made = page.made
    assert made is not None
    example = shown_result(app)
    if example is None:
        return Views(made.face, _rest(app), ("The person's shapes",))
    left = app.pages.fit.keep(("fitted", made, example.name), lambda: Scene(Pose.of(dict(example.weights))))
    right = app.pages.fit.keep(("left over", made, example.name), lambda: _left_over(made.face.rig, example))
    app.on_face.legend = HEAT_WORDS
    words = ("Fitted", example.name)
    return Views(made.face, left, ("Fitted to the examples",), Split(right, words, heat=page.heat))


def _left_over(rig: Rig, example: Example) -> Scene:
    fitted = rig.positions(dict(example.weights))
    offsets = fitted + example.offsets - rig.neutral.positions
    return Scene(Pose(), offsets.astype(np.float32), reference=fitted)


def shown_result(app: App) -> Example | None:
    """The example on show of those that were fitted."""
    page = app.pages.fit
    if page.made is None or not page.made.result.examples:
        return None
    piece = fit_wrap.shown_example(app)
    examples = page.made.result.examples
    return next((e for e in examples if piece is not None and e.name == piece.name), examples[0])


def scan_face(app: App, piece: Piece) -> Face:
    """A piece as it came, to be looked at; the same one from frame to frame."""
    return app.pages.fit.keep(("scan", piece.shown), lambda: _scan_face(app, piece))


def _scan_face(app: App, piece: Piece) -> Face:
    form = piece.form if piece.shown is piece.mesh else None
    return Face(_scan_rig(app, piece), (piece.name,), form=form)


def _scan_rig(app: App, piece: Piece) -> Rig:
    template = app.fit.template
    unit = ""
    if template is not None:
        scale = fit_wrap.placement(app, piece, template.rig.neutral).scale
        unit = unit_of(template.rig.info.unit, scale)
    return _without_shapes(piece.shown, piece.name, unit)


def _bare_rig(app: App, mesh: Mesh, name: str) -> Rig:
    template = app.fit.template
    assert template is not None
    ratio = template.rig.neutral.diagonal / (mesh.diagonal or 1.0)
    return _without_shapes(mesh, name, unit_of(template.rig.info.unit, ratio))


def _without_shapes(mesh: Mesh, name: str, unit: str) -> Rig:
    return Rig(mesh, (), np.zeros((0, mesh.vertex_count, 3), np.float32), FaceInfo(name, unit=unit))


def shown_lengths(rig: Rig) -> tuple[float, str]:
    """How lengths of a face are told, as in the legend: what to multiply by, and the unit's name."""
    mm = MM_PER.get(rig.info.unit)
    return (1.0, "model units") if mm is None else (mm, "mm")


def _rest(app: App) -> Scene:
    return app.pages.fit.keep("rest", lambda: Scene(Pose()))
