"""How large things from outside may be, and reading files within it."""

from __future__ import annotations

from pathlib import Path

from facemorph.errors import MeshFileError

MESH_BYTES = 512 << 20
"""Largest mesh file. A scan of two million vertices with uvs is about 250 MB as an OBJ."""

LINE_BYTES = 4 << 20
"""Longest line of a text format; parsing takes memory in proportion to the longest line."""

POLYGON_CORNERS = 65_536
"""Most corners of one polygon."""

NAME_BYTES = 1_024
"""Longest name of a group, object, material or shape, in bytes of UTF-8."""

NAMES = 65_536
"""Most different names of one kind in a file."""

SHAPES = 4_096
"""Most shapes of one face."""

DELTA_BYTES = 4 << 30
"""Most memory for all shapes of a face together."""

TOML_BYTES = 1 << 20
MTL_BYTES = 4 << 20
TEXTURE_BYTES = 256 << 20


def read_bytes(path: Path, limit: int = MESH_BYTES) -> bytes:
    """The bytes of `path`, at most `limit`. Raises `MeshFileError`; devices and pipes are refused."""
    try:
        if not path.is_file():
            raise MeshFileError(path, _not_a_file(path))
        with path.open("rb") as file:
            # One byte more than allowed tells a file that is too large, even one that grows meanwhile.
            data = file.read(limit + 1) if path.stat().st_size > limit else file.read()
    except (OSError, ValueError) as error:
        raise MeshFileError(path, f"cannot be read: {reason(error)}") from error
    if len(data) > limit:
        raise MeshFileError(path, f"is larger than {plain_size(limit)}, the most that is read")
    return data


def plain_size(count: int) -> str:
    """A number of bytes for people: 512 MB."""
    for unit, size in (("GB", 1 << 30), ("MB", 1 << 20), ("kB", 1 << 10)):
        if count >= size:
            return f"{count / size:.3g} {unit}"
    return f"{count} bytes"


def reason(error: Exception) -> str:
    """Why the operating system refused, in lower case, without numbers and paths."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]


def shortened(text: str, most: int = 40) -> str:
    """`text` fit for one line of a message: printable, at most `most` characters."""
    plain = "".join(c if c.isprintable() else "?" for c in text[: most + 1])
    return plain if len(plain) <= most else plain[: most - 1] + "…"


def _not_a_file(path: Path) -> str:
    if path.is_dir():
        return "is a folder, where a mesh file was expected"
    return "is no ordinary file" if path.exists() else "does not exist"
