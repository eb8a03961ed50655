"""One mesh from one file, by its suffix."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from facemorph.core.mesh import Mesh
from facemorph.errors import UnsupportedFormatError
from facemorph.io.foreign import read_foreign
from facemorph.io.obj_read import read_obj

READERS: Mapping[str, Callable[[Path], Mesh]] = MappingProxyType(
    {
        ".obj": read_obj,
        ".ply": read_foreign,
        ".stl": read_foreign,
        ".off": read_foreign,
        ".gltf": read_foreign,
        ".glb": read_foreign,
    }
)
"""Suffix in lower case -> reader."""


def read_mesh(path: Path | str) -> Mesh:
    """The mesh in one file; its kind is told by the suffix, in either case.

    Raises `MeshFileError` (with the line, where the format has lines) and, for a suffix that no reader
    takes, `UnsupportedFormatError`.
    """
    path = Path(path)
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        kind = f"{path.suffix} files are" if path.suffix else "a file without a suffix is"
        raise UnsupportedFormatError(path, f"{kind} not read", hint=f"Meshes are: {', '.join(READERS)}.")
    return reader(path)


def is_mesh(path: Path) -> bool:
    """Whether a file's name says that it is a mesh some reader takes."""
    return path.suffix.lower() in READERS
