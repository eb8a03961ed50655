"""Pairs of points on template and scan, and wrapping the template around the scan with them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.errors import FacemorphError
from facemorph.fit.align import Similarity, diagonal_of, similarity
from facemorph.ui import files, fit_landmarks
from facemorph.ui.actions import tell_error
from facemorph.ui.fit_carry import with_unseen
from facemorph.ui.fit_page import EXAMPLES, NEUTRAL, WRAP_JOB
from facemorph.ui.fit_plan import Finding, Piece, skin_of
from facemorph.ui.state import App

if TYPE_CHECKING:
    from facemorph.fit.registration import LandmarkPair, Registered

# From so many pairs on, they say where the scan lies; before, the boxes do.
_PLACED_BY = 3


def base_of(app: App, piece: Piece) -> Mesh | None:
    """What is wrapped around a piece: for an expression the person's own neutral, once there is one."""
    plan = app.fit
    if plan.template is None:
        return None
    if plan.neutral is not None and plan.neutral.key != piece.key and plan.neutral.fitted is not None:
        return plan.neutral.fitted
    return plan.template.rig.neutral


def pointed_piece(app: App) -> Piece | None:
    """The piece whose points are being set: of another mesh, and on show."""
    plan, page = app.fit, app.pages.fit
    piece = plan.neutral if page.step == NEUTRAL else None
    if page.step == EXAMPLES:
        piece = shown_example(app)
    return piece if piece is not None and piece.finding.standing == "other" else None


def shown_example(app: App) -> Piece | None:
    """The example on show: the one selected, or the first."""
    examples, key = app.fit.examples, app.pages.fit.selected
    return next((piece for piece in examples if piece.key == key), examples[0] if examples else None)


def wanted_vertex(app: App, piece: Piece) -> tuple[int, str] | None:
    """The template's vertex whose twin is asked for, and its name: one chosen, else the next landmark."""
    template, page = app.fit.template, app.pages.fit
    if template is None:
        return None
    chosen = chosen_vertex(app)
    if chosen is not None:
        return chosen, fit_landmarks.name_of(template.rig, chosen)
    mark = fit_landmarks.next_mark(template.rig, [pair.vertex for pair in piece.pairs], page.skipped)
    return (mark.vertex, mark.name) if mark else None


def chosen_vertex(app: App) -> int | None:
    """The point of the template that was chosen, if the template has it: undo may bring back another."""
    template, vertex = app.fit.template, app.pages.fit.vertex
    if template is None or vertex is None or vertex >= template.rig.neutral.vertex_count:
        return None
    return vertex


def choose_vertex(app: App, vertex: int) -> None:
    """Ask for the twin of a vertex of the template; the same once more is no choice."""
    page = app.pages.fit
    page.vertex = None if page.vertex == vertex else vertex


def point_at(app: App, piece: Piece, place: Float64) -> None:
    """The twin of what is asked for lies at `place` (3,) of the scan."""
    from facemorph.fit.registration import LandmarkPair

    wanted = wanted_vertex(app, piece)
    if wanted is None:
        app.messages.tell("Click a point of the template first, then the same point here.")
        return
    vertex, name = wanted
    x, y, z = (float(value) for value in place)
    pair = LandmarkPair(vertex, (x, y, z), name)
    again = next((number for number, kept in enumerate(piece.pairs) if kept.vertex == vertex), None)
    pairs = list(piece.pairs)
    if again is None:
        pairs.append(pair)
    else:
        pairs[again] = pair
    _set(app, piece, pairs)
    app.pages.fit.vertex = None


def move_point(app: App, piece: Piece, number: int, place: Float64) -> None:
    """Put a point elsewhere on the scan."""
    x, y, z = (float(value) for value in place)
    pairs = list(piece.pairs)
    pairs[number] = replace(pairs[number], point=(x, y, z))
    _set(app, piece, pairs)


def remove_point(app: App, piece: Piece, number: int) -> None:
    """Take a pair away."""
    _set(app, piece, [pair for place, pair in enumerate(piece.pairs) if place != number])


def remove_all(app: App, piece: Piece) -> None:
    """Take all pairs away."""
    app.pages.fit.skipped = frozenset()
    _set(app, piece, [])


def skip(app: App, piece: Piece) -> None:
    """Pass over the landmark that is asked for."""
    page, wanted = app.pages.fit, wanted_vertex(app, piece)
    if chosen_vertex(app) is not None:
        page.vertex = None
    elif wanted is not None:
        page.skipped |= {wanted[1]}


def _set(app: App, piece: Piece, pairs: Sequence[LandmarkPair]) -> None:
    app.fit = app.fit.put(replace(piece, pairs=tuple(pairs)))


def turn(app: App, piece: Piece, axis: int) -> None:
    """Turn a scan that lies otherwise by a quarter about the template's axis x, y or z."""
    after, before = (axis + 1) % 3, (axis + 2) % 3
    quarter = np.zeros((3, 3))
    quarter[axis, axis] = quarter[before, after] = 1.0
    quarter[after, before] = -1.0
    turns = app.pages.fit.turns
    turns[piece.key] = quarter @ turns.get(piece.key, np.eye(3))


def placement(app: App, piece: Piece, base: Mesh) -> Similarity:
    """Where a piece is shown beside `base`: by its skin, else by its points, else by the boxes."""
    rotation = app.pages.fit.turns.get(piece.key)
    turned = None if rotation is None else rotation.tobytes()
    pairs = placed_by(app, piece)
    key = ("placement", piece.shown, piece.finding, pairs, base, turned)
    return app.pages.fit.keep(key, lambda: _placement(app, piece, pairs, base))


def placed_by(app: App, piece: Piece) -> tuple[LandmarkPair, ...]:
    """The points that place a piece: while one of them is dragged, as they were before."""
    held = app.pages.fit.held_from
    return held.pairs if held is not None and held.key == piece.key else piece.pairs


def _placement(app: App, piece: Piece, known: Sequence[LandmarkPair], base: Mesh) -> Similarity:
    points, goal = piece.shown.positions.astype(np.float64), base.positions.astype(np.float64)
    skin = app.pages.fit.keep(("skin", base), lambda: skin_of(base))
    if piece.finding.standing in ("fits", "unusable") and points.shape == goal.shape:
        return similarity(points[skin], goal[skin])
    pairs = [pair for pair in known if pair.vertex < len(goal)]
    if len(pairs) >= _PLACED_BY:
        return similarity(np.array([pair.point for pair in pairs]), goal[[pair.vertex for pair in pairs]])
    rotation = app.pages.fit.turns.get(piece.key, np.eye(3))
    turned = points[piece.skin] @ rotation.T
    size = diagonal_of(turned) or 1.0
    scale = diagonal_of(goal[skin]) / size or 1.0
    middles = [(part.max(axis=0) + part.min(axis=0)) / 2.0 for part in (goal[skin], turned)]
    return Similarity(scale, rotation, middles[0] - scale * middles[1])


def doubt(app: App, piece: Piece) -> str:
    """What speaks against the points: one contradicts the others, all lie on a line; "" for nothing."""
    base = base_of(app, piece)
    if base is None or len(piece.pairs) < fit_landmarks.FEWEST:
        return ""
    return app.pages.fit.keep(("doubt", piece.pairs, base), lambda: _doubt(base, piece.pairs))


def _doubt(base: Mesh, pairs: Sequence[LandmarkPair]) -> str:
    from facemorph.fit.registration.pairs import agreed_similarity

    pairs = [pair for pair in pairs if pair.vertex < base.vertex_count]
    places = np.array([pair.point for pair in pairs]).reshape(-1, 3)
    try:
        agreed_similarity(base.positions[[p.vertex for p in pairs]].astype(np.float64), places, pairs)
    except FacemorphError as error:
        return str(error)
    return ""


def can_wrap(app: App, piece: Piece) -> bool:
    """Enough points, and nothing is being wrapped."""
    return len(piece.pairs) >= fit_landmarks.FEWEST and app.jobs.of_kind(WRAP_JOB) is None


def wrap(app: App, piece: Piece) -> None:
    """Wrap the template, or for an expression the person's neutral, around a scan."""
    base, page = base_of(app, piece), app.pages.fit
    if base is None or not can_wrap(app, piece):
        return

    template, used = app.fit.template, app.fit.used
    own = template is not None and base is not template.rig.neutral

    def work(progress: Progress) -> Registered:
        from facemorph.fit.registration import register

        found = register(base, piece.mesh, piece.pairs, progress=progress)
        if template is None or not own:
            return found
        return replace(found, mesh=with_unseen(template.rig, base, [found.mesh], used)[0])

    def done(found: Registered) -> None:
        now = app.fit.piece(piece.key)
        if now is None or now.mesh is not piece.mesh or base_of(app, now) is not base:
            return
        words = f"{piece.mesh.vertex_count:,} vertices; the template is wrapped around it."
        wrapped = replace(now, finding=Finding("other", words), fitted=found.mesh, quality=found.quality)
        wrapped = replace(wrapped, carried_by=base if own else None)
        app.fit, page.shows_wrap = app.fit.put(wrapped), True

    def failed(error: BaseException) -> None:
        tell_error(app, f"The template was not wrapped around {piece.name}", error)

    app.jobs.start(f"Wrapping the template around {piece.name}", work, done, failed, kind=WRAP_JOB)


def load_pairs(app: App, path: Path) -> None:
    """Read pairs of points for the scan on show, in place of those there are."""
    piece, template = pointed_piece(app), app.fit.template
    if piece is None or template is None:
        app.messages.fail(f"{path.name} holds points, and no scan is on show that needs them.")
        return
    from facemorph.io.pairs_file import read_pairs

    try:
        pairs = read_pairs(path, template.rig, piece.mesh)
    except FacemorphError as error:
        tell_error(app, f"{path.name} was not opened", error)
        return
    _set(app, piece, pairs)


def save_pairs(app: App, path: Path) -> None:
    """Keep the points of the scan on show in a file."""
    from facemorph.io.pairs_file import write_pairs

    piece = pointed_piece(app)
    if piece is not None:
        pairs = piece.pairs
        files.keep(app, path, "The points were not saved", lambda goal: write_pairs(goal, pairs))
