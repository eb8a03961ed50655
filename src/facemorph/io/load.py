"""A `Rig` from whatever names a face: a built-in's name, a folder, or mesh files."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from facemorph.core.pose import NEUTRAL
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import FaceInfo, Rig, Shape, plain_label
from facemorph.errors import FaceFolderError, UnknownNameError
from facemorph.io.face_set import read_set
from facemorph.io.face_toml import FACE_TOML, described_files, load_described
from facemorph.io.limits import reason
from facemorph.io.names import composed, listed, natural_key
from facemorph.io.read import is_mesh
from facemorph.resources import builtin_face, builtin_faces

EXPRESSION_ORDER = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
_NEUTRAL_WORD = re.compile(r"(?<![^\W_])neutral(?![^\W_])", re.IGNORECASE)


def load_rig(
    source: str | Path | Sequence[str | Path], *, progress: Progress = silent, cache: bool = True
) -> Rig:
    """A face as a `Rig`.

    source  a built-in face's name ("ada"; a folder of the same name is "./ada"); a folder with a
            `face.toml`, or with a neutral and one mesh for each shape; one mesh file (a face without
            shapes); or several mesh files: the one called neutral, else the first, is the neutral.
    cache   keep what was read in the user's cache folder, by content, and use what is there

    In a plain folder every mesh but the neutral is a shape called by its file's name; folders in it and
    hidden files are passed over. Links are followed in a plain folder, but what a `face.toml` or `.mtl`
    names must lie inside the folder. Raises `FaceFolderError`, `UnknownNameError`, `MeshFileError`,
    `CorrespondenceError`; what `progress` raises passes through.
    """
    if not isinstance(source, str | Path):
        return _from_files([Path(path) for path in source], progress, cache)
    path = _place_of(source)
    if not path.is_dir():
        return _from_files([path], progress, cache)
    if (path / FACE_TOML).is_file():
        return load_described(path, progress, cache)
    files = face_files(path)
    return _from_set(path.resolve().name or "face", files.neutral, files.shapes, progress, cache)


@dataclass(frozen=True)
class FaceFiles:
    """The files of a face: its neutral, its shapes by name in order, and perhaps a `shapes.npz`."""

    neutral: Path
    shapes: Mapping[str, Path]
    more: Path | None = None


def face_files(folder: Path) -> FaceFiles:
    """The files of a face folder, as its `face.toml` says; or of a plain one.

    Shapes of a plain folder stand with the known expressions first, then as people count. Raises
    `FaceFolderError`.
    """
    if (folder / FACE_TOML).is_file():
        return FaceFiles(*described_files(folder))
    files = plain_meshes(folder)
    return FaceFiles(*_sorted_out(files, f"{folder}", None))


def plain_meshes(folder: Path) -> list[Path]:
    """The meshes that lie in a folder, hidden ones apart. Raises `FaceFolderError` where there is none."""
    try:
        files = sorted(
            p for p in folder.iterdir() if is_mesh(p) and not p.name.startswith(".") and p.is_file()
        )
    except OSError as error:
        raise FaceFolderError(f"{folder} cannot be read: {reason(error)}.") from error
    if not files:
        raise FaceFolderError(f"{folder} holds no mesh. A face is neutral.obj and a mesh for each shape.")
    return files


def _place_of(source: str | Path) -> Path:
    """The folder or file that `source` means."""
    if isinstance(source, str) and re.fullmatch(r"[\w-]+", source) and source in builtin_faces():
        return builtin_face(source)
    path = Path(source)
    try:
        if path.exists():
            return path
    except (OSError, ValueError) as error:
        raise FaceFolderError(f"{source!r} cannot be read: {reason(error)}.") from error
    if isinstance(source, str) and re.fullmatch(r"[\w-]+", source):
        raise UnknownNameError("built-in face, folder or file", source, builtin_faces())
    raise FaceFolderError(f"{source} does not exist. A face is a built-in's name, a folder, or mesh files.")


def _from_files(files: list[Path], progress: Progress, cache: bool) -> Rig:
    if not files:
        raise FaceFolderError("no file was named. A face is a built-in's name, a folder, or mesh files.")
    for path in files:
        if path.is_dir():
            raise FaceFolderError(f"{path} is a folder; among several files each must be a mesh.")
    if len(files) == 1:
        return _from_set(composed(files[0].stem), files[0], {}, progress, cache)
    neutral, shapes = _sorted_out(files, "these files", files[0])
    return _from_set(composed(neutral.stem), neutral, shapes, progress, cache)


def _from_set(name: str, neutral: Path, shapes: Mapping[str, Path], progress: Progress, cache: bool) -> Rig:
    found = read_set(neutral, shapes, progress, cache)
    return Rig(
        found.neutral, tuple(Shape(n, plain_label(n)) for n in found.names), found.deltas, FaceInfo(name)
    )


def _sorted_out(files: Sequence[Path], where: str, otherwise: Path | None) -> tuple[Path, dict[str, Path]]:
    """The neutral among `files` (`otherwise` where none is called so), and the rest by name in order."""
    neutral = _neutral_among(files, where, otherwise)
    shapes: dict[str, Path] = {}
    folded: dict[str, Path] = {NEUTRAL: neutral}
    for path in files:
        if path is neutral:
            continue
        name = composed(path.stem)
        if name.casefold() in folded:
            raise FaceFolderError(
                f"in {where}, {folded[name.casefold()].name} and {path.name} would both be the shape "
                f"{name!r}. Rename one, or take it away."
            )
        folded[name.casefold()] = shapes[name] = path
    names = sorted(shapes, key=_place_in_order)
    return neutral, {name: shapes[name] for name in names}


def _neutral_among(files: Sequence[Path], where: str, otherwise: Path | None) -> Path:
    called = [path for path in files if path.stem.casefold() == NEUTRAL]
    called = called or [path for path in files if _NEUTRAL_WORD.search(path.stem)]
    if len(called) == 1:
        return called[0]
    if called:
        names = listed([path.name for path in called])
        raise FaceFolderError(f"in {where}, {names} are all called neutral; one neutral is needed.")
    if otherwise is not None:
        return otherwise
    if len(files) == 1:
        return files[0]
    names = listed([path.name for path in files])
    raise FaceFolderError(
        f"{where} has {len(files)} meshes ({names}), but none is called neutral. Rename the neutral face to "
        f"neutral{files[0].suffix.lower()}, or name the files with it first."
    )


def _place_in_order(name: str) -> tuple[int, tuple[tuple[int, int, str], ...]]:
    folded = name.casefold()
    known = EXPRESSION_ORDER.index(folded) if folded in EXPRESSION_ORDER else len(EXPRESSION_ORDER)
    return known, natural_key(name)
