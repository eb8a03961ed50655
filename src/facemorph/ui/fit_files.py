"""What the page Fit reads: the template, the person's meshes, and what is dropped on the window."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.progress import Progress
from facemorph.core.rig import Rig, plain_label
from facemorph.errors import FacemorphError, FitError
from facemorph.gl.describe import Graphics
from facemorph.gl.form import Form
from facemorph.ui import files, fit_page
from facemorph.ui.actions import tell_error
from facemorph.ui.fit_page import EXAMPLES, NEUTRAL, TEMPLATE
from facemorph.ui.fit_plan import Finding, FitPlan, Piece, bare, examined, in_order, new_piece
from facemorph.ui.state import App, Face

CHECK, READ = "fit check", "fit read"
# Work that goes on when the person is left.
_TEMPLATE_JOB = "fit template"


def refresh(app: App) -> None:
    """Once a frame while the page is on show: the open face is the first template; compare what is new."""
    if app.fit.template is None and app.face is not None and app.face.rig.controls:
        app.fit = replace(app.fit, template=app.face)
        _carry(app)
    unseen = [piece for piece in app.fit.pieces if piece.finding.standing == "checking"]
    if unseen and app.fit.template is not None and app.jobs.of_kind(CHECK) is None:
        _check(app, app.fit.template.rig, unseen)


def use_template(app: App, face: Face) -> None:
    """Take a face's shapes; the person's meshes are compared with it anew."""
    if not face.rig.controls:
        app.messages.fail(
            f"{face.title} has no shapes, so there is nothing to copy. Choose a face with shapes."
        )
        return
    app.fit = app.fit.on(face)
    app.pages.fit.forget_points()


def ask_template(app: App, source: Sequence[str | Path], *, builtin: bool = False) -> None:
    """Read a template: a built-in's name, a folder, or mesh files."""
    paths = tuple(str(source[0]) if builtin else str(Path(path).absolute()) for path in source)
    title = plain_label(paths[0]) if builtin else files.short(paths)

    def work(progress: Progress) -> Rig:
        return files.load(paths, progress, builtin=builtin)

    app.jobs.start(
        f"Reading {title}",
        work,
        lambda rig: use_template(app, Face(rig, paths, builtin)),
        lambda error: tell_error(app, f"{title} was not taken for a template", error),
        kind=_TEMPLATE_JOB,
    )


def read(app: App, paths: Sequence[Path], *, neutral: Path | None = None) -> None:
    """Read meshes of the person beside the window and compare them with the template.

    neutral  the one of them that is the person's neutral; the others are examples
    """
    if not paths:
        return
    template, graphics = app.fit.template, app.graphics
    words = files.short(tuple(str(path) for path in paths))

    def work(progress: Progress) -> tuple[list[tuple[Piece, bool]], list[FacemorphError]]:
        return _read(template.rig if template else None, paths, neutral, graphics, progress)

    def done(found: tuple[list[tuple[Piece, bool]], list[FacemorphError]]) -> None:
        for piece, is_neutral in found[0]:
            _add(app, piece, template, is_neutral=is_neutral)
        for error in found[1]:
            tell_error(app, "A file was not taken", error)

    def failed(error: BaseException) -> None:
        tell_error(app, f"{words} was not read", error)

    # A kind of its own: two readings do not stop each other.
    kinds = (f"{READ} {number}" for number in itertools.count())
    kind = next(kind for kind in kinds if app.jobs.of_kind(kind) is None)
    app.jobs.start(f"Reading {words}", work, done, failed, kind=kind)


def reading(app: App) -> bool:
    """Whether meshes are being read."""
    return any(job.kind.startswith(READ) and not job.cancelled for job in app.jobs.running)


def read_neutral(app: App, path: Path) -> None:
    """Read the person's neutral, in place of the one there is."""
    read(app, [path], neutral=path)


def _read(
    template: Rig | None,
    paths: Sequence[Path],
    neutral: Path | None,
    graphics: Graphics | None,
    progress: Progress,
) -> tuple[list[tuple[Piece, bool]], list[FacemorphError]]:
    from facemorph.io import read_mesh

    pieces: list[tuple[Piece, bool]] = []
    errors: list[FacemorphError] = []
    for done, path in enumerate(paths):
        progress(done / len(paths), path.name)
        try:
            mesh = read_mesh(path)
            piece = new_piece(path.stem, path, mesh, Form.of(mesh, ahead=graphics))
        except FacemorphError as error:
            errors.append(error)
            continue
        if template is not None:
            piece = examined(template, piece, neutral=path == neutral)
        pieces.append((piece, path == neutral))
    return pieces, errors


def _add(app: App, piece: Piece, template: Face | None, *, is_neutral: bool) -> None:
    page = app.pages.fit
    page.keys += 1
    piece = replace(piece, key=page.keys)
    if template is not app.fit.template:
        piece = replace(bare(piece), finding=Finding("checking"))
    if is_neutral:
        app.fit = replace(app.fit, neutral=piece)
        named = piece.name if piece.name.casefold() != "neutral" else piece.path.absolute().parent.name
        page.name = page.name or named
        return
    piece = replace(piece, name=app.fit.named(piece.name))
    app.fit = replace(app.fit, examples=(*app.fit.examples, piece))
    page.selected = piece.key


def _check(app: App, template: Rig, pieces: Sequence[Piece]) -> None:
    neutral = app.fit.neutral

    def work(progress: Progress) -> list[Piece]:
        found = []
        for done, piece in enumerate(pieces):
            progress(done / len(pieces), f"comparing {piece.name} with the template")
            found.append(examined(template, piece, neutral=piece is neutral))
        return found

    def done(found: list[Piece]) -> None:
        for before, piece in zip(pieces, found, strict=True):
            if app.fit.piece(piece.key) is before:
                app.fit = app.fit.put(piece)
        _carry(app)

    def failed(error: BaseException) -> None:
        # Else the next frame would compare them again, and the one after that.
        finding = Finding("unusable", "It could not be compared with the template.")
        for piece in pieces:
            if app.fit.piece(piece.key) is piece:
                app.fit = app.fit.put(replace(piece, finding=finding))
        _carry(app)
        tell_error(app, "The meshes were not compared with the template", error)

    app.jobs.start("Comparing with the template", work, done, failed, kind=CHECK)


def _carry(app: App) -> None:
    """What came of itself is no step of undo."""
    app.history.carry(lambda snapshot: replace(snapshot, fit=app.fit))


def put_in_order(app: App) -> None:
    """Put every mesh of another order in the template's, as `facemorph check --repair` does for a folder."""
    template, plan = app.fit.template, app.fit
    wanted = disordered(app)
    if template is None or not wanted:
        return

    def work(progress: Progress) -> list[tuple[Piece, Piece]]:
        neutral, found = plan.neutral, list[tuple[Piece, Piece]]()
        for done, piece in enumerate(wanted):
            progress(done / len(wanted), f"putting {piece.name} in the template's order")
            # The person's own neutral lies nearer than the template's, so parts alike are told apart by it.
            own = neutral.fitted if neutral is not None else None
            ordered = in_order(own or template.rig.neutral, piece, neutral)
            if piece is neutral:
                neutral = ordered
            found.append((piece, ordered))
        return found

    def done(found: list[tuple[Piece, Piece]]) -> None:
        for before, piece in found:
            if app.fit.piece(piece.key) is before:
                app.fit = app.fit.put(piece)

    def failed(error: BaseException) -> None:
        tell_error(app, "The vertices were not put in order", error)

    app.jobs.start("Putting vertices in order", work, done, failed, kind="fit order")


def disordered(app: App) -> list[Piece]:
    """The meshes whose vertices stand in another order."""
    return [piece for piece in app.fit.pieces if piece.finding.standing == "order"]


def take_out(app: App, key: int) -> None:
    """Leave a piece out; the file stays where it is."""
    app.fit = app.fit.drop(key)


def start_over(app: App) -> None:
    """Nothing but the template; undo brings the rest back. What goes on for the person stops."""
    for job in app.jobs.running:
        if job.kind.startswith("fit ") and job.kind != _TEMPLATE_JOB:
            job.cancel()
    app.fit = FitPlan(app.fit.template)
    page = app.pages.fit
    page.step, page.made, page.saved, page.name = TEMPLATE, None, "", ""
    page.told, page.untwinned = [], frozenset()
    page.forget_points()


def take_dropped(app: App, dropped: Sequence[str]) -> bool:
    """What was dropped while the page is on show is the page's, by the step that is open."""
    if not fit_page.on_show(app):
        return False
    page, paths = app.pages.fit, [Path(path).absolute() for path in dropped]
    tables = [path for path in paths if path.suffix.lower() == ".csv"]
    if tables:
        from facemorph.ui import fit_wrap

        fit_wrap.load_pairs(app, tables[0])
        return True
    if page.step == TEMPLATE and len(paths) == 1 and (paths[0].is_dir() or paths[0].name == "face.toml"):
        ask_template(app, [paths[0] if paths[0].is_dir() else paths[0].parent])
        return True
    take_meshes(app, paths)
    return True


def take_meshes(app: App, paths: Sequence[Path]) -> None:
    """Meshes of the person, or folders of them: the neutral by its name, or where it is lacking the first."""
    from facemorph.io.plain_folder import is_called_neutral

    page = app.pages.fit
    try:
        meshes = [mesh for path in paths for mesh in _meshes(path)]
    except FacemorphError as error:
        tell_error(app, "Nothing was taken", error)
        return
    named = next((path for path in meshes if is_called_neutral(path)), None)
    wanted = app.fit.neutral is None or (page.step == NEUTRAL and len(meshes) == 1)
    neutral = named if named is not None else meshes[0] if wanted and meshes else None
    if page.step == TEMPLATE:
        page.step = NEUTRAL
    if page.step == NEUTRAL and len(meshes) > 1:
        page.step = EXAMPLES
    read(app, meshes, neutral=neutral)


def _meshes(path: Path) -> list[Path]:
    """The file itself, or a folder's meshes."""
    from facemorph.io.plain_folder import plain_meshes

    if not path.exists():
        raise FitError(f"{path} is not there any more.")
    return list(plain_meshes(path)) if path.is_dir() else [path]
