"""A neutral and its shapes from files: positions that correspond, or an error that says why not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.correspondence import Difference, difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.errors import CorrespondenceError, FaceFolderError
from facemorph.io.limits import DELTA_BYTES, SHAPES, plain_size, read_bytes
from facemorph.io.obj_read import parse_obj, parse_positions, with_materials
from facemorph.io.read import read_mesh

HINTS: Mapping[str, str] = MappingProxyType(
    {
        "order": "`facemorph check FOLDER --repair OUT` writes copies in the neutral's order.",
        "vertices": "Export every shape from the same mesh, without merging or splitting vertices.",
        "polygons": "Export every shape from the same mesh, without triangulating or rebuilding it.",
    }
)
"""What to do about a shape that does not correspond, by the cause."""

_WORDS_BEFORE_FACES = (b"v ", b"vt", b"vn", b"vp")


@dataclass(frozen=True, eq=False)
class FaceSet:
    """A neutral, and the deltas (K, V, 3) of its shapes by name."""

    neutral: Mesh
    names: tuple[str, ...]
    deltas: Float32


def read_set(neutral_path: Path, shapes: Mapping[str, Path], progress: Progress = silent) -> FaceSet:
    """Read a neutral and its shapes. Raises `MeshFileError`, `CorrespondenceError`, `FaceFolderError`."""
    progress(0.0, f"reading {neutral_path.name}")
    neutral, faces = _neutral(neutral_path)
    check_size(len(shapes), neutral.vertex_count)
    deltas = np.empty((len(shapes), neutral.vertex_count, 3), np.float32)
    for k, (name, path) in enumerate(shapes.items()):
        progress((k + 1) / (len(shapes) + 1), f"reading {path.name}")
        np.subtract(_shape_positions(path, name, neutral, faces), neutral.positions, out=deltas[k])
    return FaceSet(neutral, tuple(shapes), deltas)


def check_size(shapes: int, vertices: int) -> None:
    """Raises `FaceFolderError` where so many shapes are more than memory should hold."""
    if shapes > SHAPES or shapes * vertices * 12 > DELTA_BYTES:
        raise FaceFolderError(
            f"{shapes:,} shapes of {vertices:,} vertices are too many; at most {SHAPES:,} shapes and "
            f"{plain_size(DELTA_BYTES)} are read."
        )


def _neutral(path: Path) -> tuple[Mesh, bytes]:
    """The neutral's mesh, and the block of its file that holds all faces (empty where there is none)."""
    if path.suffix.lower() != ".obj":
        return read_mesh(path), b""
    data = read_bytes(path)
    return with_materials(path, parse_obj(path, data)), face_block(data)


def _shape_positions(path: Path, name: str, neutral: Mesh, faces: bytes) -> Float32:
    """A shape's positions (V, 3), which correspond to the neutral's."""
    if path.suffix.lower() != ".obj":
        mesh = read_mesh(path)
    else:
        data = read_bytes(path)
        positions = _positions_before(path, data, faces)
        if positions is not None and len(positions) == neutral.vertex_count:
            return positions
        mesh = parse_obj(path, data).mesh
    unlike = difference(neutral, mesh)
    if unlike is not None:
        raise _not_corresponding(name, path, unlike)
    return mesh.positions


def _not_corresponding(name: str, path: Path, unlike: Difference) -> CorrespondenceError:
    hint = HINTS[unlike.cause].replace("FOLDER", str(path.parent))
    return CorrespondenceError(f"{name} ({path})", unlike.problem, cause=unlike.cause, hint=hint)


def face_block(data: bytes) -> bytes:
    """The end of an OBJ that holds all its faces and nothing that they count on; empty where it mixes them.

    What stands before it are vertices, uvs and normals; so another file with the same block after as many
    vertices has the same polygons.
    """
    last = max(data.rfind(b"\n" + word) for word in _WORDS_BEFORE_FACES)
    start = data.find(b"\n", last + 1) + 1
    block = data[start:] if last >= 0 and start else b""
    indented = b"\n " in block or b"\n\t" in block or b"\\" in block
    return b"" if indented or b"\r" in block.replace(b"\r\n", b"") else block


def _positions_before(path: Path, data: bytes, faces: bytes) -> Float32 | None:
    """The positions of an OBJ that ends in the block `faces`; None where it must be read whole."""
    if not faces or not data.endswith(faces):
        return None
    head = data[: len(data) - len(faces)]
    if not head.endswith(b"\n") or head[:-1].rstrip(b"\r \t").endswith(b"\\"):
        return None
    return parse_positions(path, head)
