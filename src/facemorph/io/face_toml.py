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

FACE_TOML = "face.toml"
_LANDMARKS = 10_000
_T = TypeVar("_T")


def load_described(folder: Path, progress: Progress, cache: bool) -> Rig:
    """The face of a folder with a `face.toml`. Raises `FaceFolderError` and what reading meshes raises."""
    table = _table(folder)
    neutral, files, npz = _files(folder, table)
    shapes = _expressions(table)
    found = read_set(neutral, files, progress, cache)
    count = found.neutral.vertex_count
    more = None
    if npz is not None:
        progress(0.95, f"reading {npz.name}")
        more = read_shapes(npz, count)
        check_size(len(shapes) + len(more.shapes), count)
    info = _info(folder, table, count)
    try:
        if more is None:
            return Rig(found.neutral, shapes, found.deltas, info)
        deltas = np.concatenate([found.deltas, more.deltas])
        return Rig(found.neutral, (*shapes, *more.shapes), deltas, info, more.regions)
    except MeshDataError as error:
        raise FaceFolderError(f"{folder}: {error}") from error


def described_files(folder: Path) -> tuple[Path, dict[str, Path], Path | None]:
    """The neutral, the shapes by name, and the `shapes.npz` that a folder's `face.toml` names.

    Raises `FaceFolderError`.
    """
    return _files(folder, _table(folder))


def _files(folder: Path, table: _Table) -> tuple[Path, dict[str, Path], Path | None]:
    neutral = _file(folder, table, "neutral", "neutral.obj")
    shapes = {entry.text("name"): _file(folder, entry, "file", None) for entry in _expression_entries(table)}
    return neutral, shapes, _file(folder, table, "shapes", None) if table.has("shapes") else None


def read_face_info(folder: Path | str) -> FaceInfo:
    """What a folder's `face.toml` says of the face, its meshes unread. Raises `FaceFolderError`."""
    folder = Path(folder)
    return _info(folder, _table(folder), None)


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


def _table(folder: Path) -> _Table:
    path = folder / FACE_TOML
    return _Table(path, _parsed(path))


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


def _expression_entries(table: _Table) -> list[_Table]:
    """The expressions but the neutral one, each with a name of its own."""
    entries = [entry for entry in table.tables("expressions", SHAPES) if entry.text("name") != NEUTRAL]
    names = [entry.text("name") for entry in entries]
    for name in names:
        if names.count(name) > 1 or not name.strip():
            raise FaceFolderError(
                f"{table.path}: every expression needs a name of its own, not {name!r} again."
            )
    return entries


def _expressions(table: _Table) -> tuple[Shape, ...]:
    entries = _expression_entries(table)
    names = [entry.text("name") for entry in entries]
    return tuple(Shape(n, e.text("label", plain_label(n))) for n, e in zip(names, entries, strict=True))


def _info(folder: Path, table: _Table, vertex_count: int | None) -> FaceInfo:
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


def _landmark(entry: _Table, vertex_count: int | None) -> Landmark:
    vertex = entry.number("vertex")
    if vertex < 0 or (vertex_count is not None and vertex >= vertex_count):
        raise FaceFolderError(
            f"{entry.path}: the landmark {shortened(entry.text('name'))!r} is vertex {vertex:,} "
            f"of {vertex_count or 0:,}."
        )
    mpeg4 = entry.text("mpeg4") if entry.has("mpeg4") else None
    return Landmark(entry.text("name"), vertex, mpeg4, entry.number("ibug") if entry.has("ibug") else None)
