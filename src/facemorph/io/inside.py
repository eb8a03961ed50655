"""Files that other files name: only those in the same folder or below it."""

from __future__ import annotations

from pathlib import Path


def inside(folder: Path, name: str) -> Path | None:
    """The file `name` (either kind of slash) in `folder` or below it, or None where there is no such file.

    Symbolic links are followed before it is decided whether the file lies inside.
    """
    parts = name.replace("\\", "/")
    if not parts or parts.startswith("/") or "\0" in parts or parts[1:2] == ":":
        return None
    try:
        found = (folder / parts).resolve()
        if found.is_relative_to(folder.resolve()) and found.is_file():
            return folder / parts
    except (OSError, ValueError, RuntimeError):
        pass
    return None
