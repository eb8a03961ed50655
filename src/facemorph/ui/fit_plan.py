"""What a person's blendshapes are to be made of: a template, a neutral, examples. Never changed in place.

The window keeps the present plan as `App.fit`, and undo brings earlier ones back. What is worked out of it
(`fit_page`) is no part of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from facemorph.core.arrays import Bool, Int64
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.reorder import same_polygons, vertex_order
from facemorph.core.rig import Rig
from facemorph.core.triangles import triangulated
from facemorph.errors import CorrespondenceError, FacemorphError
from facemorph.fit.checks import check_triangles, points_of
from facemorph.fit.parts import connected_parts
from facemorph.gl.form import Form

if TYPE_CHECKING:
    from facemorph.fit.registration import LandmarkPair, Quality
    from facemorph.ui.state import Face

Standing = Literal["checking", "fits", "order", "other", "unusable"]


@dataclass(frozen=True)
class Finding:
    """How a mesh stands to the template.

    standing  "fits" (one topology), "order" (the same surface, its vertices in another order), "other"
              (another mesh, which the template can be wrapped around), "unusable"; "checking" meanwhile
    words     that in plain words
    """

    standing: Standing
    words: str = ""


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh of the person: the neutral, or one expression.

    key      tells it from all others, whatever they are called
    mesh     as its file has it
    skin     (V,) the vertices of its largest part: without hair, eyes and teeth, which are parts apart
    form     the mesh made ready for drawing
    fitted   in the template's topology: the mesh itself, put in order, or what was wrapped around it
    order    (V,) the order in which its vertices are the template's, where they had another
    carried_by  the person's neutral that was carried along to it or wrapped around it
    pairs    points of the template and the same on the mesh, for wrapping
    quality  how well the template was wrapped around it
    by_name  shapes that it is called by, where it is, are the only ones in its estimate
    weights  starting weights set by hand, shape name -> 0..1; the others are estimated
    """

    key: int
    name: str
    path: Path
    mesh: Mesh
    finding: Finding
    skin: Bool
    form: Form | None = None
    fitted: Mesh | None = None
    order: Int64 | None = None
    carried_by: Mesh | None = None
    pairs: tuple[LandmarkPair, ...] = ()
    quality: Quality | None = None
    weights: Mapping[str, float] = field(default_factory=dict)
    by_name: bool = True

    @property
    def shown(self) -> Mesh:
        """What is looked at: in the template's order where it is known, else as the file has it."""
        return self.fitted if self.fitted is not None and self.finding.standing == "fits" else self.mesh


@dataclass(frozen=True)
class FitPlan:
    """All of it. `without` are sets of shapes that may not explain the examples."""

    template: Face | None = None
    neutral: Piece | None = None
    examples: tuple[Piece, ...] = ()
    without: frozenset[str] = frozenset()
    iterations: int = 10

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The neutral, where there is one, and the examples."""
        return self.examples if self.neutral is None else (self.neutral, *self.examples)

    @property
    def waiting(self) -> tuple[Piece, ...]:
        """Pieces that are not yet in the template's topology."""
        return tuple(piece for piece in self.pieces if piece.fitted is None)

    @property
    def ready(self) -> bool:
        """Whether everything is there to make the person's shapes."""
        return self.template is not None and self.neutral is not None and not self.waiting

    @property
    def used(self) -> tuple[str, ...]:
        """Names of the shapes that may explain the examples."""
        if self.template is None:
            return ()
        return tuple(shape.name for shape in self.template.rig.controls if shape.set not in self.without)

    def piece(self, key: int) -> Piece | None:
        """The piece of a key, if it is still here."""
        return next((piece for piece in self.pieces if piece.key == key), None)

    def put(self, piece: Piece) -> FitPlan:
        """With `piece` in the place of the one of its key; without that, nothing changes."""
        if self.neutral is not None and self.neutral.key == piece.key:
            return replace(self, neutral=piece)
        return replace(
            self, examples=tuple(piece if kept.key == piece.key else kept for kept in self.examples)
        )

    def drop(self, key: int) -> FitPlan:
        """Without the piece of a key."""
        neutral = None if self.neutral is not None and self.neutral.key == key else self.neutral
        return replace(self, neutral=neutral, examples=tuple(p for p in self.examples if p.key != key))

    def named(self, wanted: str) -> str:
        """`wanted`, or with a number where an example has that name already."""
        taken, name, number = {piece.name for piece in self.examples}, wanted, 2
        while name in taken:
            name, number = f"{wanted} ({number})", number + 1
        return name

    def on(self, template: Face) -> FitPlan:
        """For another template: what the pieces were found to be holds no longer."""
        same = self.template is not None and self.template.rig.neutral is template.rig.neutral
        if same:
            return replace(self, template=template)
        again = [replace(bare(piece), finding=Finding("checking")) for piece in self.pieces]
        neutral = again.pop(0) if self.neutral is not None else None
        return replace(self, template=template, neutral=neutral, examples=tuple(again), without=frozenset())


def bare(piece: Piece) -> Piece:
    """A piece without what holds for one template only."""
    return replace(piece, fitted=None, order=None, carried_by=None, pairs=(), quality=None, weights={})


def new_piece(name: str, path: Path, mesh: Mesh, form: Form | None = None, *, key: int = 0) -> Piece:
    """A piece that is yet to be compared with the template; its key is given when it is taken."""
    return Piece(key, name, path, mesh, Finding("checking"), skin_of(mesh), form)


def skin_of(mesh: Mesh) -> Bool:
    """The vertices (V,) of a mesh's largest part."""
    if not mesh.vertex_count:
        return np.zeros(0, bool)
    part = connected_parts(triangulated(mesh).vertices, mesh.vertex_count)
    return np.asarray(part == np.bincount(part).argmax())


def examined(template: Rig, piece: Piece, *, neutral: bool) -> Piece:
    """A piece with what there is to say of it beside the template; takes up to a second."""
    finding = _found(template, piece.mesh, neutral=neutral)
    fitted = piece.mesh if finding.standing == "fits" else None
    return replace(piece, finding=finding, fitted=fitted)


def _found(template: Rig, mesh: Mesh, *, neutral: bool) -> Finding:
    unlike, own = difference(template.neutral, mesh), template.neutral.vertex_count
    if unlike is None:
        try:
            points = points_of(template, mesh, "it")
            if neutral:
                check_triangles(points, template.triangles, "it")
        except FacemorphError as error:
            return Finding("unusable", str(error).removeprefix("it: "))
        return Finding("fits", f"{mesh.vertex_count:,} vertices, as in the template.")
    if unlike.cause == "order":
        return Finding("order", "The template's surface, with its vertices in another order.")
    if not mesh.polygon_count:
        return Finding("unusable", "It has no polygons: points alone are no surface.")
    if unlike.cause == "vertices":
        return Finding("other", f"Another mesh: {mesh.vertex_count:,} vertices, the template has {own:,}.")
    return Finding("other", f"Another mesh: {mesh.vertex_count:,} vertices as the template, other polygons.")


def in_order(reference: Mesh, piece: Piece, guide: Piece | None) -> Piece:
    """A piece with its vertices in the order of `reference`, a mesh of the template's topology.

    guide  another piece that was put in order: meshes with the same polygons as that had take its order,
           for where parts look alike (lashes, strands of hair) no two searches need agree
    Raises `CorrespondenceError` where no order fits.
    """
    known = guide is not None and guide.order is not None and same_polygons(guide.mesh, piece.mesh)
    order = guide.order if guide is not None and known else vertex_order(reference, piece.mesh)
    if order is None:
        raise CorrespondenceError(piece.name, "no order of its vertices fits the template.", cause="polygons")
    mesh = replace(reference, normals=np.zeros((0, 3), np.float32), corner_normals=None)
    words = f"{piece.mesh.vertex_count:,} vertices, put in the template's order."
    fitted = mesh.with_positions(piece.mesh.positions[order])
    return replace(piece, finding=Finding("fits", words), fitted=fitted, order=order)


def plan_words(before: FitPlan, after: FitPlan) -> str:
    """What happened between two plans, as `Undo` names it."""
    if before.template is not after.template:
        return f"template {after.template.title}" if after.template else "template"
    was, now = {p.key: p for p in before.pieces}, {p.key: p for p in after.pieces}
    added = [p.name for key, p in now.items() if key not in was]
    gone = [p.name for key, p in was.items() if key not in now]
    if added or gone:
        verb, names = ("add", added) if added else ("take out", gone)
        return f"{verb} {names[0]}" if len(names) == 1 else f"{verb} {len(names)} meshes"
    changed = [(was[key], now[key]) for key in now if was[key] is not now[key]]
    if not changed:
        return "settings of the fit"
    old, new = changed[0]
    if old.pairs != new.pairs:
        return f"points on {new.name}"
    if (old.weights, old.by_name) != (new.weights, new.by_name):
        return f"starting weights of {new.name}"
    if new.quality is not None and old.quality is not new.quality:
        return f"wrap {new.name}"
    if old.finding.standing == "order":
        return f"put {new.name} in order" if len(changed) == 1 else f"put {len(changed)} meshes in order"
    return f"check {new.name}"
