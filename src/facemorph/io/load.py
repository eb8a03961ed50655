"""A `Rig` from whatever names a face: a built-in's name, a folder, or mesh files."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from facemorph.core.progress import Progress, silent
from facemorph.core.rig import FaceInfo, Rig, Shape, plain_label
from facemorph.errors import FaceFolderError, UnknownNameError
from facemorph.io.face_set import read_set
from facemorph.io.face_toml import FACE_TOML, DescribedFace, described, load_described
from facemorph.io.limits import reason
from facemorph.io.names import composed
from facemorph.io.plain_folder import neutral_among, plain_meshes, shapes_of
from facemorph.resources import builtin_face, builtin_faces


def load_rig(
    source: str | Path | Sequence[str | Path], *, progress: Progress = silent, cache: bool = True
) -> Rig:
    """A face as a `Rig`.

    source  a built-in face's name ("ada"; a folder of the same name is "./ada"); a folder with a
            `face.toml`, or with a neutral and one mesh for each shape; one mesh file (a face without
            shapes); or several mesh files: the one called neutral, else the first, is the neutral.
    cache   keep what was read in the user's cache folder, by content, and use what is there

    In a plain folder, and where a `face.toml` lists no expressions, every mesh but the neutral is a shape
    called by its file's name; folders in it and hidden files are passed over. Links are followed in a plain
    folder, but what a `face.toml` or `.mtl` names must lie inside the folder. Raises `FaceFolderError`,
    `UnknownNameError`, `MeshFileError`, `CorrespondenceError`; what `progress` raises passes through.
    """
    if not isinstance(source, str | Path):
        return _from_files([Path(path) for path in source], progress, cache)
    path = place_of(source)
    if not path.is_dir():
        return _from_files([path], progress, cache)
    if (path / FACE_TOML).is_file():
        return load_described(path, progress, cache)
    files = face_files(path)
    return _from_set(path.resolve().name or "face", files.neutral, files.shapes, progress, cache)


@dataclass(frozen=True)
class FaceFiles:
    """The files of a face: its neutral, its shapes by name in order, and what a `face.toml` says more."""

    neutral: Path
    shapes: Mapping[str, Path]
    described: DescribedFace | None = None


def face_files(folder: Path) -> FaceFiles:
    """The files of a face folder, as its `face.toml` says; or of a plain one.

    Shapes of a plain folder stand with the known expressions first, then as people count. Raises
    `FaceFolderError`.
    """
    if (folder / FACE_TOML).is_file():
        face = described(folder)
        return FaceFiles(face.neutral, {shape.name: path for shape, path in face.shapes}, face)
    files = plain_meshes(folder)
    neutral = neutral_among(files, f"{folder}", None)
    return FaceFiles(neutral, shapes_of(neutral, files, f"{folder}"))


def place_of(source: str | Path) -> Path:
    """The folder or file that `source` means: a built-in's folder by its name, else the path itself.

    Raises `FaceFolderError` and `UnknownNameError` where there is none.
    """
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
        if str(path) in builtin_faces() and not path.exists() and len(files) > 1:
            raise FaceFolderError(
                f"{path} is a built-in face, and several words mean mesh files, the neutral first. "
                "Name a built-in face alone."
            )
        if path.is_dir():
            raise FaceFolderError(f"{path} is a folder; among several files each must be a mesh.")
    if len(files) == 1:
        return _from_set(composed(files[0].stem), files[0], {}, progress, cache)
    neutral = neutral_among(files, "these files", files[0])
    shapes = shapes_of(neutral, files, "these files")
    return _from_set(composed(neutral.stem), neutral, shapes, progress, cache)


def _from_set(name: str, neutral: Path, shapes: Mapping[str, Path], progress: Progress, cache: bool) -> Rig:
    found = read_set(neutral, shapes, progress, cache)
    return Rig(
        found.neutral, tuple(Shape(n, plain_label(n)) for n in found.names), found.deltas, FaceInfo(name)
    )
