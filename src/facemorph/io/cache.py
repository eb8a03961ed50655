"""Face sets read before, kept by content, so that the same files open again at once.

An entry's name is a digest of what the files hold (not of their names or dates), of this layout's version
and of the program's. Entries are plain arrays, written whole or not at all; all together they stay under
a bound, the least recently used going first. Nothing here can stop a load: an entry that is damaged,
cannot be read or cannot be written counts as not there.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facemorph import __version__
from facemorph.core.arrays import Float32
from facemorph.core.mesh import Labels, Mesh
from facemorph.errors import MeshDataError, OutputError
from facemorph.io.atomic import replacing
from facemorph.io.npz import Arrays, NpzError, read_npz
from facemorph.io.obj_read import ObjFile

FOLDER_VARIABLE = "FACEMORPH_CACHE_DIR"
_LAYOUT = 1
_TOTAL_BYTES = 512 << 20
_ENTRY_BYTES = 256 << 20
_SMALL_BYTES = 1 << 20
_PIECE_BYTES = 16 << 20
_UNFINISHED_SECS = 86_400
_LABELS = ("groups", "objects", "materials_used")
_NEEDED = ("positions", "polygon_starts", "corner_vertices", "uvs", "normals", "deltas", "words")
_OPTIONAL = ("corner_uvs", "corner_normals", "colours", *_LABELS)


def cache_folder() -> Path | None:
    """Where entries lie: `FACEMORPH_CACHE_DIR`, or the platform's usual place for what can be made again.

    None for a user without a home.
    """
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen) / "meshes"
    import platformdirs

    try:
        return Path(platformdirs.user_cache_dir("facemorph", appauthor=False)) / "meshes"
    except RuntimeError:
        return None


def worth_keeping(total_bytes: int) -> bool:
    """Whether files of this size together take long enough to read."""
    return total_bytes >= _SMALL_BYTES


def key_of(digests: Sequence[bytes]) -> str:
    """An entry's name from the digests of the neutral's and the shapes' contents in order."""
    digest = hashlib.blake2b(
        f"{__version__} {_LAYOUT} {sys.byteorder} {len(digests)}".encode(), digest_size=20
    )
    for one in digests:
        digest.update(one)
    return digest.hexdigest()


def digest_of(path: Path) -> bytes:
    """The digest of one file's content."""
    # Processors have instructions for SHA-256: with them it takes half of BLAKE2's time.
    digest = hashlib.sha256()
    with path.open("rb", buffering=0) as file:
        # Large pieces: two threads that hand the interpreter to each other often are no quicker than one.
        while piece := file.read(_PIECE_BYTES):
            digest.update(piece)
    return digest.digest()


def load(key: str, shape_count: int) -> tuple[ObjFile, Float32] | None:
    """The neutral and deltas (K, V, 3) kept under `key`, or None."""
    folder = cache_folder()
    if folder is None:
        return None
    path = folder / f"{key}.npz"
    try:
        if not path.is_file():
            return None
        found = _unpacked(read_npz(path, _NEEDED, _OPTIONAL, _ENTRY_BYTES), shape_count)
        os.utime(path)
    except (NpzError, MeshDataError, OSError, ValueError, TypeError, KeyError, RecursionError):
        with contextlib.suppress(OSError):
            path.unlink()
        return None
    return found


def store(key: str, neutral: ObjFile, deltas: Float32) -> None:
    """Keep a set under `key`, where it can be kept."""
    arrays = _packed(neutral, deltas)
    if sum(array.nbytes for array in arrays.values()) > _ENTRY_BYTES:
        return
    folder = cache_folder()
    if folder is None:
        return
    try:
        with replacing(folder / f"{key}.npz") as temporary, temporary.open("wb") as file:
            np.savez(file, allow_pickle=False, **arrays)
        _drop_oldest(folder)
    except (OutputError, OSError, ValueError):
        return


def _packed(neutral: ObjFile, deltas: Float32) -> Arrays:
    mesh = neutral.mesh
    arrays: Arrays = {
        "positions": mesh.positions,
        "polygon_starts": mesh.polygon_starts,
        "corner_vertices": mesh.corner_vertices,
        "uvs": mesh.uvs,
        "normals": mesh.normals,
        "deltas": deltas,
    }
    words: dict[str, Any] = {"libraries": neutral.libraries}
    for name in ("corner_uvs", "corner_normals", "colours"):
        if getattr(mesh, name) is not None:
            arrays[name] = getattr(mesh, name)
    for name in _LABELS:
        labels: Labels | None = getattr(mesh, name)
        if labels is not None:
            arrays[name], words[name] = labels.index, labels.names
    arrays["words"] = np.frombuffer(json.dumps(words).encode(), np.uint8)
    return arrays


def _unpacked(arrays: Arrays, shape_count: int) -> tuple[ObjFile, Float32]:
    """Raises `ValueError` and its kind where the arrays are not what `_packed` makes."""
    words = json.loads(arrays["words"].tobytes())
    corners = len(arrays["corner_vertices"])
    polygons = len(arrays["polygon_starts"]) - 1
    positions = _table(arrays, "positions", np.float32, (-1, 3))
    mesh = Mesh(
        positions,
        _table(arrays, "polygon_starts", np.int32, (-1,)),
        _table(arrays, "corner_vertices", np.int32, (-1,)),
        uvs=_table(arrays, "uvs", np.float32, (-1, 2)),
        normals=_table(arrays, "normals", np.float32, (-1, 3)),
        corner_uvs=_index(arrays, "corner_uvs", corners, len(arrays["uvs"])),
        corner_normals=_index(arrays, "corner_normals", corners, len(arrays["normals"])),
        colours=_table(arrays, "colours", np.float32, positions.shape) if "colours" in arrays else None,
        groups=_labels(arrays, words, "groups", polygons),
        objects=_labels(arrays, words, "objects", polygons),
        materials_used=_labels(arrays, words, "materials_used", polygons),
    )
    deltas = _table(arrays, "deltas", np.float32, (shape_count, *positions.shape))
    return ObjFile(mesh, tuple(str(name) for name in words["libraries"])), deltas


def _table(arrays: Arrays, name: str, dtype: type, shape: tuple[int, ...]) -> NDArray[Any]:
    """The array of this kind and shape; -1 stands for any length."""
    array = arrays[name]
    fits = array.ndim == len(shape) and all(n in (-1, m) for n, m in zip(shape, array.shape, strict=True))
    if array.dtype != np.dtype(dtype) or not fits:
        raise ValueError(f"{name} is {array.shape} {array.dtype}")
    return array


def _index(arrays: Arrays, name: str, count: int, bound: int) -> NDArray[Any] | None:
    if name not in arrays:
        return None
    index = _table(arrays, name, np.int32, (count,))
    if len(index) and not -1 <= int(index.min()) <= int(index.max()) < bound:
        raise ValueError(f"{name} is out of range")
    return index


def _labels(arrays: Arrays, words: Any, name: str, polygons: int) -> Labels | None:
    if name not in arrays:
        return None
    names = tuple(str(word) for word in words[name])
    index = _index(arrays, name, polygons, len(names))
    return None if index is None else Labels(names, index)


def _drop_oldest(folder: Path) -> None:
    """Remove the least recently used entries over the bound, and what broken-off writing left."""
    now = time.time()
    kept = 0
    found = [(path.stat(), path) for path in folder.iterdir() if path.is_file()]
    for status, path in sorted(found, key=lambda one: -one[0].st_mtime):
        unfinished = path.name.startswith(".facemorph-")
        kept += 0 if unfinished else status.st_size
        if kept > _TOTAL_BYTES or (unfinished and now - status.st_mtime > _UNFINISHED_SECS):
            path.unlink(missing_ok=True)
