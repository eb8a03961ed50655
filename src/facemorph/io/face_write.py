"""Write a rig as a face folder that opens like any other; see `face_toml` for what stands in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from facemorph.core.correctives import Corrective
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import EXPRESSION, Landmark, Rig, Shape
from facemorph.core.wrinkles import Wrinkle
from facemorph.errors import FaceFolderError, OutputError
from facemorph.io.atomic import new_folder
from facemorph.io.face_toml import FACE_TOML, described, read_face_info
from facemorph.io.limits import NAME_BYTES, shortened
from facemorph.io.names import composed, file_stem
from facemorph.io.obj_write import write_obj, write_parts
from facemorph.io.shapes_npz_write import write_shapes
from facemorph.io.toml_write import toml_text

_NEUTRAL = "neutral.obj"
_SHAPES = "shapes.npz"


def write_face(rig: Rig, folder: Path | str, *, progress: Progress = silent) -> Path:
    """Write `rig` into the new folder `folder`, whole or not at all. Returns the folder.

    The neutral is an OBJ with its materials and their pictures beside it, each expression an OBJ of
    positions and polygons; shapes of other sets, correctives too, and regions stand in `shapes.npz`.
    Expressions come first when it is opened again, in their order, then the others in theirs.
    Raises `OutputError` where the folder is not empty or cannot be written, or as `check_writable` does;
    what `progress` raises passes through, and nothing is left behind.
    """
    folder = Path(folder)
    check_writable(rig)
    with new_folder(folder) as stage:
        files = _write_expressions(rig, stage, progress)
        more = [k for k, shape in enumerate(rig.shapes) if shape.set != EXPRESSION]
        if more or rig.regions is not None:
            progress(0.7, f"writing {_SHAPES}")
            listed = [rig.shapes[k] for k in more]
            write_shapes(stage / _SHAPES, listed, rig.deltas[more], rig.neutral.diagonal, rig.regions)
        text = toml_text(_description(rig, files, more=(stage / _SHAPES).exists()))
        (stage / FACE_TOML).write_text(text, encoding="utf-8", newline="\n")
        progress(0.8, f"writing {_NEUTRAL}")
        # Last: a picture called as one of the files above is given another name.
        write_obj(stage / _NEUTRAL, rig.neutral)
        _check_description(stage, folder)
        progress(1.0, f"wrote {folder.name}")
    return folder


def check_writable(rig: Rig) -> None:
    """Raises `OutputError` where a face folder cannot hold what `rig` has, before anything is worked out."""
    for shape in rig.shapes:
        name = shape.name
        if not name.strip() or not _is_text(name) or len(name.encode("utf-8", "replace")) > NAME_BYTES:
            raise OutputError(
                f"the shape {shortened(name)!r} cannot be kept: a name is a text in UTF-8 that is not blank, "
                f"of at most {NAME_BYTES:,} bytes. Rename it."
            )
        for text in (shape.label, shape.set):
            if not _is_text(text) or len(text.encode("utf-8", "replace")) > NAME_BYTES:
                raise OutputError(
                    f"the label or the set of the shape {shortened(name)!r} cannot be kept: each is a text "
                    f"in UTF-8 of at most {NAME_BYTES:,} bytes. Change it."
                )
    for rule in rig.correctives:
        if len(rule.hats) > 1:
            raise OutputError(
                f"the corrective {rule.shape!r} has {len(rule.hats)} hats; a face.toml holds one."
            )
    if not np.isfinite(rig.deltas).all():
        strange = int(np.argmin(np.isfinite(rig.deltas).all(axis=(1, 2))))
        raise OutputError(f"the shape {rig.shapes[strange].name!r} has deltas that are no finite numbers.")


def _is_text(name: str) -> bool:
    """Whether a file can hold it: no NUL, and no half of a pair of UTF-16."""
    return "\0" not in name and not any("\ud800" <= letter <= "\udfff" for letter in name)


def _write_expressions(rig: Rig, stage: Path, progress: Progress) -> dict[Shape, str]:
    """An OBJ for each expression; the name of its file."""
    expressions = rig.shapes_in(EXPRESSION)
    files = dict(zip(expressions, _file_names(expressions), strict=True))
    for done, (shape, name) in enumerate(files.items()):
        progress(0.7 * done / len(files), f"writing {name}")
        positions = rig.neutral.positions + rig.deltas[rig.shapes.index(shape)]
        write_parts(stage / name, _bare(rig.neutral.with_positions(positions)), None, ())
    return files


def _check_description(stage: Path, folder: Path) -> None:
    """Raises `OutputError` where what was written of the face, a unit nobody knows, say, is refused again."""
    try:
        described(stage)
        read_face_info(stage)
    except FaceFolderError as error:
        problem = str(error).removeprefix(f"{stage / FACE_TOML}: ")
        raise OutputError(f"{folder} could not be written: {problem}") from error


def _bare(mesh: Mesh) -> Mesh:
    """Positions, polygons and their groups: all that a shape is read for."""
    return replace(
        Mesh(mesh.positions, mesh.polygon_starts, mesh.corner_vertices),
        groups=mesh.groups,
        objects=mesh.objects,
    )


def _file_names(shapes: tuple[Shape, ...]) -> Iterator[str]:
    """A file name for each shape, none twice and none the neutral's, whatever the names of the shapes are."""
    taken = {_NEUTRAL.casefold()}
    for shape in shapes:
        stem, number = file_stem(shape.name), 2
        name = f"{stem}.obj"
        while _folded(name) in taken:
            name, number = f"{stem}-{number}.obj", number + 1
        taken.add(_folded(name))
        yield name


def _folded(name: str) -> str:
    """Equal for names that some file system takes for one."""
    return composed(composed(name).casefold())


def _description(rig: Rig, files: dict[Shape, str], *, more: bool) -> dict[str, Any]:
    info = rig.info
    told = {
        "name": info.name,
        "description": info.description,
        "credit": info.credit,
        "licence": info.licence,
        "unit": info.unit,
    }
    values: dict[str, Any] = {key: text for key, text in told.items() if text}
    values["neutral"] = _NEUTRAL
    if more:
        values["shapes"] = _SHAPES
    if info.frame is not None:
        low, high = info.frame
        values["frame"] = {"low": list(low), "high": list(high)}
    values["expressions"] = [
        {"name": shape.name, "label": shape.label, "file": name} for shape, name in files.items()
    ]
    values["landmarks"] = [_landmark(landmark) for landmark in info.landmarks]
    values["correctives"] = [_rule(rule) for rule in rig.correctives]
    values["wrinkles"] = [_wrinkle(wrinkle) for wrinkle in rig.wrinkles]
    return values


def _landmark(landmark: Landmark) -> dict[str, Any]:
    told = {"name": landmark.name, "vertex": landmark.vertex, "mpeg4": landmark.mpeg4, "ibug": landmark.ibug}
    return {key: value for key, value in told.items() if value is not None}


def _rule(rule: Corrective) -> dict[str, Any]:
    values: dict[str, Any] = {"shape": rule.shape}
    if rule.product:
        values["product"] = list(rule.product)
    for hat in rule.hats:
        values |= {"hat": hat.over, "over": [hat.start, hat.peak, hat.end]}
    return values


def _wrinkle(wrinkle: Wrinkle) -> dict[str, Any]:
    return {
        "name": wrinkle.name,
        "set": wrinkle.set,
        "area": list(wrinkle.area),
        "soft": wrinkle.soft,
        "rest": wrinkle.rest,
        "shapes": dict(wrinkle.shapes),
    }
