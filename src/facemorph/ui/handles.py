"""What can be done with handles: set, drag, hold, take away, keep as a shape. Free of mouse and panels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.pose import NEUTRAL, Pose
from facemorph.core.rig import Rig, Shape
from facemorph.deform.controls import METHODS
from facemorph.deform.handles import STILL, Handle, HandleSet, Vector, mirrored, mirrored_vector
from facemorph.deform.rbf import COINCIDENT
from facemorph.deform.sides import midline
from facemorph.errors import FacemorphError
from facemorph.ui import files
from facemorph.ui.actions import tell_error
from facemorph.ui.paths import suffixed
from facemorph.ui.state import App, Face

MADE = "made"
_AT_REST = 1e-9


def change(app: App, handles: HandleSet) -> None:
    """Put other handles in place of the present ones."""
    app.controls = replace(app.controls, handles=handles)


def handle_at(app: App, vertex: int | None) -> Handle | None:
    """The handle at a vertex, or None."""
    return next((h for h in app.controls.handles.handles if h.vertex == vertex), None)


def offsets(app: App) -> Float32 | None:
    """What the handles alone add, (V, 3), whether switched on or not. Raises `DeformError`."""
    alone = replace(app.controls, off=frozenset(METHODS) - {"handles"})
    return app.methods.bound(app)(Pose(), alone).offsets


def twin_of(app: App, vertex: int) -> int | None:
    """The vertex in the mirror where mirroring is on; the vertex itself where it lies on the midline."""
    if app.rig is None or not app.lab.handles.mirror:
        return None
    return mirrored(app.rig, vertex, midline(app.rig))


def place(app: App, vertex: int) -> None:
    """Set a point at a vertex and at its twin, which moves nothing; or an anchor, which holds what rests."""
    page = app.lab.handles
    page.selected = vertex
    if handle_at(app, vertex) is not None:
        return
    try:
        field = offsets(app)
    except FacemorphError:
        field = None  # the message has been given when the layer was switched off
    handles = app.controls.handles
    for where in dict.fromkeys([vertex, twin_of(app, vertex)]):
        if where is None or any(h.vertex == where for h in handles.handles):
            continue
        if _too_near(app, handles, where):
            if where == vertex:
                page.selected = None
                app.messages.tell("There is a point at this place already.")
            continue
        anchor = page.sets == "Set anchors"
        moved = STILL if anchor or field is None else _vector(field[where])
        handles = replace(handles, handles=(*handles.handles, Handle(where, moved, anchor)))
    if handles is not app.controls.handles:
        change(app, handles)


def _too_near(app: App, handles: HandleSet, vertex: int) -> bool:
    """Whether another point stands where this vertex rests: the system of both could not be solved."""
    if app.rig is None or not handles.handles:
        return False
    positions = app.rig.neutral.positions
    away = positions[list(handles.vertices())].astype(np.float64) - positions[vertex]
    return bool((np.linalg.norm(away, axis=1) < 10 * COINCIDENT * app.rig.neutral.diagonal).any())


def move(app: App, vertex: int, twin: int | None, by: Float64) -> None:
    """Move the handle at a vertex to a displacement (3,), and its twin to the mirrored one."""
    vector = _vector(by)
    if twin == vertex:
        vector = (0.0, vector[1], vector[2])
    handles = app.controls.handles.moved(vertex, vector)
    other = handle_at(app, twin) if twin is not None and twin != vertex else None
    if other is not None and not other.anchor:
        handles = handles.moved(other.vertex, mirrored_vector(vector))
    change(app, handles)


def set_anchor(app: App, vertex: int, *, anchor: bool) -> None:
    """Let a point and its twin hold what is there, or let them be dragged again."""
    chosen = {vertex, twin_of(app, vertex)}
    handles = app.controls.handles
    rows = (
        replace(h, anchor=anchor, moved=STILL if anchor else h.moved) if h.vertex in chosen else h
        for h in handles.handles
    )
    change(app, replace(handles, handles=tuple(rows)))


def remove(app: App, vertex: int) -> None:
    """Take a point and its twin away."""
    handles = app.controls.handles.without(vertex)
    twin = twin_of(app, vertex)
    if twin is not None:
        handles = handles.without(twin)
    change(app, handles)
    app.lab.handles.selected = None


def back_to_rest(app: App) -> None:
    """Every point back to where it rests; the points stay."""
    change(app, app.controls.handles.at_rest())


def clear(app: App) -> None:
    """No points at all; the kernel stays."""
    change(app, replace(app.controls.handles, handles=()))
    app.lab.handles.selected = None


def at_rest(app: App) -> bool:
    """Whether no point is moved."""
    return not any(any(h.moved) for h in app.controls.handles.handles)


def save(app: App, path: Path) -> None:
    """Keep the points in a file."""
    from facemorph.io.handles_file import write_handles

    rig = app.rig
    if rig is None:
        return
    files.keep(
        app,
        suffixed(path, ".json"),
        "The points were not saved",
        lambda goal: write_handles(goal, app.controls.handles, rig),
    )


def load(app: App, path: Path) -> None:
    """Take the points kept in a file; the present ones stay where that fails."""
    from facemorph.io.handles_file import read_handles

    if app.rig is None:
        return
    try:
        change(app, read_handles(path, app.rig))
    except FacemorphError as error:
        tell_error(app, "The points were not opened", error)
        return
    app.lab.handles.selected = None


def keep_as_shape(app: App, label: str) -> None:
    """Add what the handles do now to the face as a shape of its own; the points go back to rest."""
    face = app.face
    if face is None:
        return
    try:
        delta = offsets(app)
    except FacemorphError as error:
        tell_error(app, "No shape was made", error)
        return
    if delta is None or float(np.abs(delta).max()) < _AT_REST:
        app.messages.tell("No point is moved, so there is nothing to keep.")
        return
    words = " ".join(label.split()) or "Made shape"
    shape = Shape(_free_name(face.rig, words), words, MADE)
    deltas = np.concatenate([face.rig.deltas, delta[None].astype(np.float32)])
    rig = replace(face.rig, shapes=(*face.rig.shapes, shape), deltas=deltas)
    app.face = Face(rig, face.source, face.builtin)
    app.pose = app.pose.with_weight(shape.name, 1.0)
    back_to_rest(app)
    app.lab.handles.name = ""
    app.messages.tell(f"{words} is a shape of its own now, at 1 on the page Shapes.")


def _free_name(rig: Rig, words: str) -> str:
    name, taken, number = words.replace(" ", "_"), {NEUTRAL, *rig.names}, 2
    while name in taken:
        name, number = f"{words.replace(' ', '_')}_{number}", number + 1
    return name


def _vector(values: Float32 | Float64) -> Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
