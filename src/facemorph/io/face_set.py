"""A neutral and its shapes from files: positions that correspond, or an error that says why not."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.errors import CorrespondenceError, FaceFolderError, MeshFileError
from facemorph.io import cache
from facemorph.io.limits import DELTA_BYTES, MESH_BYTES, SHAPES, plain_size, read_bytes
from facemorph.io.obj_read import ObjFile, parse_obj, parse_positions, with_materials
from facemorph.io.obj_text import BOM, CHUNK_BYTES
from facemorph.io.read import read_mesh

HINTS: Mapping[str, str] = MappingProxyType(
    {
        "order": "`facemorph check FOLDER --repair OUT` writes copies in the neutral's order.",
        "vertices": "Export every shape from the same mesh, without merging or splitting vertices.",
        "polygons": "Export every shape from the same mesh, without triangulating or rebuilding it.",
    }
)
"""What to do about a shape that does not correspond, by the cause."""

_AT_ONCE = 2
_LINE_END = 1_024
_COMPARED_BYTES = 1 << 16
# Blocks of faces that are remembered: the neutral's, and one as its shapes write them.
_MOST_KNOWN = 3


@dataclass(frozen=True, eq=False)
class FaceSet:
    """A neutral, and the deltas (K, V, 3) of its shapes by name."""

    neutral: Mesh
    names: tuple[str, ...]
    deltas: Float32


def read_set(
    neutral: Path, shapes: Mapping[str, Path], progress: Progress = silent, use_cache: bool = True
) -> FaceSet:
    """Read a neutral and its shapes. Raises `MeshFileError`, `CorrespondenceError`, `FaceFolderError`."""
    progress(0.0, f"reading {neutral.name}")
    paths = [neutral, *shapes.values()]
    before = _contents(paths) if use_cache else []
    key = cache.key_of([content.digest for content in before]) if before else ""
    kept = cache.load(key, len(shapes)) if key else None
    if kept is None:
        file, deltas = _parsed(neutral, shapes, progress)
        if key and [content.stamp for content in before] == [_stamp(path) for path in paths]:
            cache.store(key, file, deltas)
    else:
        file, deltas = kept
    return FaceSet(with_materials(neutral, file), tuple(shapes), deltas)


def check_size(shapes: int, vertices: int) -> None:
    """Raises `FaceFolderError` where so many shapes are more than memory should hold."""
    if shapes > SHAPES or shapes * vertices * 12 > DELTA_BYTES:
        raise FaceFolderError(
            f"{shapes:,} shapes of {vertices:,} vertices are too many; at most {SHAPES:,} shapes and "
            f"{plain_size(DELTA_BYTES)} are read."
        )


@dataclass(frozen=True)
class _Content:
    """What a file held, as a digest, and the stamp by which a change since then would show."""

    digest: bytes
    stamp: tuple[int, ...]


def _contents(paths: Sequence[Path]) -> list[_Content]:
    """The contents of the files, when all are OBJs and worth a place in the cache; else none."""
    if any(path.suffix.lower() != ".obj" or not path.is_file() for path in paths):
        return []
    try:
        if not cache.worth_keeping(sum(path.stat().st_size for path in paths)):
            return []
        with ThreadPoolExecutor(_AT_ONCE) as pool:
            return list(pool.map(_content, paths))
    except OSError:
        return []


def _content(path: Path) -> _Content:
    stamp = _stamp(path)
    return _Content(cache.digest_of(path), stamp)


def _stamp(path: Path) -> tuple[int, ...]:
    """Size, times and place of a file, or nothing where it is gone."""
    try:
        status = path.stat()
    except OSError:
        return ()
    return status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino


def _parsed(neutral: Path, shapes: Mapping[str, Path], progress: Progress) -> tuple[ObjFile, Float32]:
    """The neutral, and the deltas (K, V, 3)."""
    face = _Neutral(neutral)
    base = face.file.mesh.positions
    check_size(len(shapes), len(base))
    deltas = np.empty((len(shapes), len(base), 3), np.float32)
    # One after the other: with the many short steps of each, threads wait for the interpreter more
    # than they gain.
    for k, (name, path) in enumerate(shapes.items()):
        progress((k + 1) / (len(shapes) + 1), f"reading {path.name}")
        np.subtract(face.positions_of(name, path), base, out=deltas[k])
    return face.file, deltas


class _Neutral:
    """A neutral that shapes are read for; faces that are written as in a file before are not read again."""

    def __init__(self, path: Path) -> None:
        self._faces: list[bytes] = []
        if path.suffix.lower() != ".obj":
            self.file = ObjFile(read_mesh(path), ())
            return
        data = read_bytes(path)
        self.file = parse_obj(path, data)
        if self.file.faces_from is not None:
            self._faces.append(data[self.file.faces_from :])

    def positions_of(self, name: str, path: Path) -> Float32:
        """The positions (V, 3) of a shape. Raises `CorrespondenceError` where they are not the neutral's."""
        positions = self._before_faces(path)
        if positions is not None and len(positions) == self.file.mesh.vertex_count:
            return positions
        mesh, faces = _read_with_faces(path)
        unlike = difference(self.file.mesh, mesh)
        if unlike is not None:
            hint = HINTS[unlike.cause].replace("FOLDER", shlex.quote(str(path.parent)))
            raise CorrespondenceError(f"{name} ({path})", unlike.problem, cause=unlike.cause, hint=hint)
        if faces and len(self._faces) < _MOST_KNOWN:
            self._faces.append(faces)
        return mesh.positions

    def _before_faces(self, path: Path) -> Float32 | None:
        """The positions of an OBJ that ends in faces known as the neutral's; None to read it whole.

        Such a block follows all of its file's vertices, so after as many it means the same polygons.
        """
        if path.suffix.lower() != ".obj" or not path.is_file():
            return None
        found = (self._before(path, faces) for faces in self._faces)
        return next((positions for positions in found if positions is not None), None)

    def _before(self, path: Path, faces: bytes) -> Float32 | None:
        """The positions in an OBJ before a block of faces that it ends in, or None."""
        try:
            with path.open("rb") as file:
                before = os.fstat(file.fileno()).st_size - len(faces)
                if not 0 < before <= MESH_BYTES or not _goes_on_with(file, before, faces):
                    return None
                pieces = [parse_positions(path, piece) for piece in _pieces(file, before)]
        except (OSError, _OddTextError, MeshFileError):
            # Read whole, it either is good after all or gives the error with its place in the file.
            return None
        found = [piece for piece in pieces if piece is not None]
        return np.concatenate(found) if found and len(found) == len(pieces) else None


def _read_with_faces(path: Path) -> tuple[Mesh, bytes]:
    """A mesh, and of an OBJ whose faces follow all vertices, the block that they are; else nothing."""
    if path.suffix.lower() != ".obj":
        return read_mesh(path), b""
    data = read_bytes(path)
    file = parse_obj(path, data)
    return file.mesh, b"" if file.faces_from is None else data[file.faces_from :]


class _OddTextError(Exception):
    """Text that cannot be cut into pieces at line ends without changing what it says."""


def _goes_on_with(file: BinaryIO, place: int, content: bytes) -> bool:
    """Whether a file holds just `content` from `place` on."""
    file.seek(place)
    starts = range(0, len(content), _COMPARED_BYTES)
    same = all(file.read(_COMPARED_BYTES) == content[i : i + _COMPARED_BYTES] for i in starts)
    return same and not file.read(1)


def _pieces(file: BinaryIO, size: int) -> Iterator[bytes]:
    """The first `size` bytes of an OBJ as pieces of whole lines. Raises `_OddTextError`.

    Small pieces: the memory of each is used again for the next, while a whole file's is asked of the
    system, page by page, every time.
    """
    place = 0
    while place < size:
        file.seek(place)
        piece = file.read(min(CHUNK_BYTES, size - place))
        end = piece.rfind(b"\n") + 1
        last = place + len(piece) >= size
        if not end or (last and end < len(piece)) or (place and piece.startswith(BOM)):
            raise _OddTextError
        piece = piece[:end]
        if piece[-_LINE_END:].rstrip().endswith(b"\\"):
            raise _OddTextError
        yield piece
        place += end
