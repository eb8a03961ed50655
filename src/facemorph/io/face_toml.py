"""A face folder that describes itself: `face.toml` names its files, what they show, and who made it.

    name = "Ada"                    description, credit, licence likewise
    unit = "cm"                     the length that 1 in the meshes is: mm, cm, m or in
    neutral = "neutral.obj"
    shapes = "shapes.npz"           further shapes and soft regions, see `shapes_npz`; may be left out
    [frame]                         what a picture shows of the face, see `frame_toml`
    [[expressions]]                 in the order of the menu
    name = "happy"                  label = "Happy", file = "happy.obj"; a label may be left out
    [[landmarks]]
    name = "nose_tip"               vertex = 1234, mpeg4 = "9.3", ibug = 30; the last two may be left out
    [[correctives]]                 shapes that others switch on, see `correctives_toml`
    [[wrinkles]]                    what shapes fade in on the skin, see `wrinkles_toml`

Where it has no expressions, the meshes in the folder are the shapes, as in a plain folder. Every file
named must lie in the folder or below it, links followed first. Keys of another name are passed over, so
that a newer face opens in an older program; `unknown_keys` tells them.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from facemorph.core.arrays import Float32
from facemorph.core.mesh import Mesh
from facemorph.core.pose import NEUTRAL
from facemorph.core.progress import Progress
from facemorph.core.rig import FaceInfo, Landmark, Rig, Shape, plain_label
from facemorph.errors import FaceFolderError, MeshDataError
from facemorph.io import correctives_toml, frame_toml, wrinkles_toml
from facemorph.io.face_set import read_set
from facemorph.io.inside import inside
from facemorph.io.limits import SHAPES, shortened
from facemorph.io.plain_folder import neutral_among, plain_meshes, shapes_of
from facemorph.io.shapes_npz import MoreShapes, read_shapes
from facemorph.io.toml_table import Table, read_table

FACE_TOML = "face.toml"
UNITS: Mapping[str, str] = MappingProxyType({"mm": "mm", "cm": "cm", "m": "m", "in": "in", "inch": "in"})
"""A unit as it may be written -> as it is called."""

_NEUTRAL_FILE = "neutral.obj"
_LANDMARKS = 10_000
_KEYS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "": ("name", "description", "credit", "licence", "unit", "neutral", "shapes", frame_toml.KEY,
             "expressions", "landmarks", correctives_toml.KEY, wrinkles_toml.KEY),
        frame_toml.KEY: frame_toml.KEYS,
        "expressions": ("name", "label", "file"),
        "landmarks": ("name", "vertex", "mpeg4", "ibug"),
        correctives_toml.KEY: correctives_toml.KEYS,
        wrinkles_toml.KEY: wrinkles_toml.KEYS,
    }
)  # fmt: skip


_SINGLE = (frame_toml.KEY,)  # tables of which there is one


@dataclass(frozen=True)
class DescribedFace:
    """What a `face.toml` says: the neutral, each shape and its file in order, and perhaps a `shapes.npz`.

    `unlisted` are the meshes in the folder that its expressions leave out, `table` is all it says.
    """

    folder: Path
    table: Table
    neutral: Path
    shapes: tuple[tuple[Shape, Path], ...]
    more: Path | None
    unlisted: tuple[Path, ...]


def load_described(folder: Path, progress: Progress, cache: bool) -> Rig:
    """The face of a folder with a `face.toml`. Raises `FaceFolderError` and what reading meshes raises."""
    face = described(folder)
    files = {shape.name: path for shape, path in face.shapes}
    found = read_set(face.neutral, files, progress, cache)
    count, deltas = found.neutral.vertex_count, found.deltas
    more = None
    if face.more is not None:
        progress(0.95, f"reading {face.more.name}")
        more = read_shapes(face.more, count, deltas)
        deltas = more.deltas
    return described_rig(face, found.neutral, deltas, more)


def described(folder: Path) -> DescribedFace:
    """What the folder's `face.toml` says of its files. Raises `FaceFolderError`."""
    table = _table(folder)
    entries = _expression_entries(table)
    more = _file(folder, table, "shapes", None) if table.has("shapes") else None
    if not table.tables("expressions", SHAPES):
        neutral = _neutral(folder, table)
        by_name = shapes_of(neutral, _meshes(folder), f"{folder}")
        shapes = [(Shape(name, plain_label(name)), path) for name, path in by_name.items()]
        return DescribedFace(folder, table, neutral, tuple(shapes), more, ())
    neutral = _file(folder, table, "neutral", _NEUTRAL_FILE)
    names = [entry.text("name") for entry in entries]
    shapes = [
        (
            Shape(name, entry.text("label", "").strip() or plain_label(name)),
            _file(folder, entry, "file", None),
        )
        for name, entry in zip(names, entries, strict=True)
    ]
    listed = {path.resolve() for path in (neutral, *(path for _, path in shapes))}
    unlisted = tuple(path for path in _meshes(folder) if path.resolve() not in listed)
    return DescribedFace(folder, table, neutral, tuple(shapes), more, unlisted)


def described_rig(face: DescribedFace, neutral: Mesh, deltas: Float32, more: MoreShapes | None) -> Rig:
    """The rig of a neutral and the deltas (K, V, 3) of all shapes, those of a `shapes.npz` last.

    Raises `FaceFolderError` where what `face.toml` says does not fit them.
    """
    table = face.table
    info = _info(face.folder, table, neutral)
    rules = correctives_toml.read_correctives(table)
    wrinkles = wrinkles_toml.read_wrinkles(table)
    shapes = tuple(shape for shape, _ in face.shapes)
    try:
        if more is None:
            return Rig(neutral, shapes, deltas, info, correctives=rules, wrinkles=wrinkles)
        every = (*shapes, *more.shapes)
        return Rig(neutral, every, deltas, info, more.regions, rules, wrinkles=wrinkles)
    except MeshDataError as error:
        raise FaceFolderError(f"{face.folder}: {error}") from error


def read_face_info(folder: Path | str) -> FaceInfo:
    """What a folder's `face.toml` says of the face, its meshes unread. Raises `FaceFolderError`."""
    folder = Path(folder)
    return _info(folder, _table(folder), None)


def unknown_keys(folder: Path) -> Iterator[str]:
    """A sentence for each key of the folder's `face.toml` that means nothing. Raises `FaceFolderError`."""
    table = _table(folder)
    told: set[tuple[str, str]] = set()
    tables = [("", table)]
    for kind in tuple(_KEYS)[1:]:
        if table.has(kind):
            entries = [table.table(kind)] if kind in _SINGLE else table.tables(kind, _LANDMARKS)
            tables += [(kind, entry) for entry in entries]
    for kind, entry in tables:
        for key in entry.unknown(_KEYS[kind]):
            if (kind, key) not in told:
                told.add((kind, key))
                yield _unknown(kind, key)


def _unknown(kind: str, key: str) -> str:
    head = f"[{kind}]" if kind in _SINGLE else f"[[{kind}]]"
    where = f" in {head}" if kind else ""
    if kind and key in _KEYS[""]:
        meant = f"It is one of the face's own: put it above the first {head}."
    else:
        close = difflib.get_close_matches(key.casefold(), _KEYS[kind], n=1, cutoff=0.6)
        meant = f"Did you mean {close[0]!r}?" if close else f"There are: {', '.join(_KEYS[kind])}."
    return f"nothing is known of {shortened(key)!r}{where}, so it does nothing. {meant}"


def _table(folder: Path) -> Table:
    return read_table(folder / FACE_TOML)


def _meshes(folder: Path) -> list[Path]:
    """The meshes that lie in the folder itself; none is no error where a table names those below."""
    return plain_meshes(folder, none_is_well=True)


def _neutral(folder: Path, table: Table) -> Path:
    """The neutral that the table names, else `neutral.obj`, else the one that is called so."""
    meshes = _meshes(folder)
    if table.has("neutral") or not meshes or inside(folder, _NEUTRAL_FILE):
        return _file(folder, table, "neutral", _NEUTRAL_FILE)
    return neutral_among(meshes, f"{folder}", None)


def _file(folder: Path, table: Table, key: str, otherwise: str | None) -> Path:
    name = table.text(key, otherwise)
    found = inside(folder, name)
    if found is None:
        raise FaceFolderError(
            f"{table.path}: {key} names {shortened(name)!r}, which is no file in the folder."
        )
    return found


def _expression_entries(table: Table) -> list[Table]:
    """The expressions but the neutral one, each with a name of its own."""
    entries = [entry for entry in table.tables("expressions", SHAPES) if entry.text("name") != NEUTRAL]
    names = [entry.text("name") for entry in entries]
    for name in names:
        if names.count(name) > 1 or not name.strip():
            raise FaceFolderError(
                f"{table.path}: every expression needs a name of its own, not {name!r} again."
            )
    return entries


def _info(folder: Path, table: Table, neutral: Mesh | None) -> FaceInfo:
    vertex_count = None if neutral is None else neutral.vertex_count
    info = FaceInfo(table.text("name", folder.resolve().name or "face"))
    landmarks = tuple(_landmark(entry, vertex_count) for entry in table.tables("landmarks", _LANDMARKS))
    return replace(
        info,
        description=table.text("description", ""),
        credit=table.text("credit", ""),
        licence=table.text("licence", ""),
        unit=_unit(table),
        landmarks=landmarks,
        frame=frame_toml.read_frame(table, None if neutral is None else neutral.bounds),
    )


def _unit(table: Table) -> str:
    unit = table.text("unit", "").strip()
    if unit and unit.casefold() not in UNITS:
        raise FaceFolderError(
            f"{table.path}: unit must be one of {', '.join(dict.fromkeys(UNITS.values()))}, "
            f"not {shortened(unit)!r}; leave it out where it is not known."
        )
    return UNITS[unit.casefold()] if unit else ""


def _landmark(entry: Table, vertex_count: int | None) -> Landmark:
    vertex = entry.number("vertex")
    name = entry.text("name")
    if vertex < 0 or (vertex_count is not None and vertex >= vertex_count):
        last = "" if vertex_count is None else f", the last being {vertex_count - 1}"
        raise FaceFolderError(
            f"{entry.path}: the landmark {shortened(name)!r} is vertex {vertex}, which is none of the "
            f"neutral's; they are counted from 0 here{last}."
        )
    mpeg4 = entry.text("mpeg4") if entry.has("mpeg4") else None
    return Landmark(name, vertex, mpeg4, entry.number("ibug") if entry.has("ibug") else None)
