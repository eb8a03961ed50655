"""A face folder that describes itself: `face.toml` names its files, what they show, and who made it.

    name = "Ada"                    description, credit, licence, unit ("cm") likewise
    neutral = "neutral.obj"
    shapes = "shapes.npz"           further shapes and soft regions, see `shapes_npz`; may be left out
    [[expressions]]                 in the order of the menu
    name = "happy"                  label = "Happy", file = "happy.obj"; a label may be left out
    [[landmarks]]
    name = "nose_tip"               vertex = 1234, mpeg4 = "9.3", ibug = 30; the last two may be left out

Every file named must lie in the folder or below it, links followed first. Keys of another name are
passed over, so that a newer face opens in an older program.
"""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from facemorph.core.pose import NEUTRAL
from facemorph.core.progress import Progress
from facemorph.core.rig import FaceInfo, Landmark, Rig, Shape, plain_label
from facemorph.errors import FaceFolderError, MeshDataError, MeshFileError
from facemorph.io.face_set import check_size, read_set
from facemorph.io.inside import inside
from facemorph.io.limits import NAME_BYTES, SHAPES, TOML_BYTES, read_bytes, shortened
from facemorph.io.shapes_npz import read_shapes

_LANDMARKS = 10_000
_T = TypeVar("_T")


def load_described(folder: Path, progress: Progress, cache: bool) -> Rig:
    """The face of a folder with a `face.toml`. Raises `FaceFolderError` and what reading meshes raises."""
    table = _Table(folder / "face.toml", _parsed(folder / "face.toml"))
    neutral = _file(folder, table, "neutral", "neutral.obj")
    shapes, files = _expressions(folder, table)
    found = read_set(neutral, files, progress)
    more = None
    if table.has("shapes"):
        progress(0.95, "reading shapes")
        more = read_shapes(_file(folder, table, "shapes", ""), found.neutral.vertex_count)
        check_size(len(shapes) + len(more.shapes), found.neutral.vertex_count)
    info = _info(folder, table, found.neutral.vertex_count)
    try:
        if more is None:
            return Rig(found.neutral, shapes, found.deltas, info)
        deltas = np.concatenate([found.deltas, more.deltas])
        return Rig(found.neutral, (*shapes, *more.shapes), deltas, info, more.regions)
    except MeshDataError as error:
        raise FaceFolderError(f"{folder}: {error}") from error


class _Table:
    """A table of a TOML file whose values are asked for by key and type."""

    def __init__(self, path: Path, values: Any, where: str = "") -> None:
        if not isinstance(values, dict):
            raise FaceFolderError(f"{path}: {where} must be a table.")
        self.path, self._values, self._where = path, values, where

    def has(self, key: str) -> bool:
        """Whether the key is there."""
        return key in self._values

    def text(self, key: str, otherwise: str | None = None) -> str:
        """A text; where it is not there, `otherwise`, or an error where that is None."""
        value = self._of(str, key, otherwise)
        if len(value.encode("utf-8", "replace")) > NAME_BYTES * 4:
            raise FaceFolderError(f"{self.path}: {self._where}{key} is longer than {NAME_BYTES * 4:,} bytes.")
        return value

    def number(self, key: str) -> int:
        """A whole number that must be there."""
        return self._of(int, key, None)

    def tables(self, key: str, most: int) -> list[_Table]:
        """The tables of an array; none where it is not there."""
        values = self._of(list, key, [])
        if len(values) > most:
            raise FaceFolderError(f"{self.path}: more than {most:,} {key}.")
        return [_Table(self.path, v, f"{key} {i + 1}: ") for i, v in enumerate(values)]

    def _of(self, kind: type[_T], key: str, otherwise: _T | None) -> _T:
        value = self._values.get(key, otherwise)
        if value is None:
            raise FaceFolderError(f"{self.path}: {self._where}{key} is missing.")
        if not isinstance(value, kind) or isinstance(value, bool):
            wanted = {str: "a text", int: "a whole number", list: "an array of tables"}[kind]
            raise FaceFolderError(
                f"{self.path}: {self._where}{key} must be {wanted}, not {shortened(repr(value))}."
            )
        return value


def _parsed(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(read_bytes(path, TOML_BYTES).decode("utf-8"))
    except MeshFileError as error:
        raise FaceFolderError(str(error)) from error
    except (ValueError, RecursionError) as error:
        raise FaceFolderError(f"{path} is not TOML: {shortened(str(error), 120)}.") from error


def _file(folder: Path, table: _Table, key: str, otherwise: str | None) -> Path:
    name = table.text(key, otherwise or None)
    found = inside(folder, name)
    if found is None:
        raise FaceFolderError(
            f"{table.path}: {key} names {shortened(name)!r}, which is no file in the folder."
        )
    return found


def _expressions(folder: Path, table: _Table) -> tuple[tuple[Shape, ...], dict[str, Path]]:
    shapes: list[Shape] = []
    files: dict[str, Path] = {}
    for entry in table.tables("expressions", SHAPES):
        name = entry.text("name")
        if name == NEUTRAL:
            continue
        if name in files or not name.strip():
            raise FaceFolderError(f"{table.path}: two expressions are called {name!r}.")
        files[name] = _file(folder, entry, "file", None)
        shapes.append(Shape(name, entry.text("label", plain_label(name))))
    return tuple(shapes), files


def _info(folder: Path, table: _Table, vertex_count: int) -> FaceInfo:
    info = FaceInfo(table.text("name", folder.resolve().name or "face"))
    landmarks = tuple(_landmark(entry, vertex_count) for entry in table.tables("landmarks", _LANDMARKS))
    return replace(
        info,
        description=table.text("description", ""),
        credit=table.text("credit", ""),
        licence=table.text("licence", ""),
        unit=table.text("unit", ""),
        landmarks=landmarks,
    )


def _landmark(entry: _Table, vertex_count: int) -> Landmark:
    vertex = entry.number("vertex")
    if not 0 <= vertex < vertex_count:
        raise FaceFolderError(
            f"{entry.path}: the landmark {shortened(entry.text('name'))!r} is vertex {vertex:,} "
            f"of {vertex_count:,}."
        )
    mpeg4 = entry.text("mpeg4") if entry.has("mpeg4") else None
    return Landmark(entry.text("name"), vertex, mpeg4, entry.number("ibug") if entry.has("ibug") else None)
