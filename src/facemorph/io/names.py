"""Names in files: what one line, or one file name, can hold."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

from facemorph.io.limits import NAME_BYTES

_DIGITS = re.compile(r"(\d+)")
_STEM_BYTES = 200
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)\s*(\.|$)", re.IGNORECASE)


def written_name(name: str) -> str:
    """`name` fit to stand at a line's end: no control characters, blanks around it or "\\" at its end."""
    plain = "".join("_" if unicodedata.category(c) in ("Cc", "Cs", "Zl", "Zp") else c for c in name)
    plain = plain.encode("utf-8")[:NAME_BYTES].decode("utf-8", "ignore").strip()
    return re.sub(r"\\(?=\s*$)", "_", plain) or "unnamed"


def file_stem(name: str) -> str:
    """A shape's name as a file's: letters, digits, blanks, `-`, `_`, dots inside; it stays in its folder.

    Short enough for every file system, and none of the names that mean devices on Windows.
    """
    plain = "".join(c if c.isalnum() or c in " -_." else "_" for c in name[:80])
    plain = plain.encode("utf-8")[:_STEM_BYTES].decode("utf-8", "ignore").strip(" .")
    return f"_{plain}" if _DEVICE.match(plain) else plain or "shape"


def natural_key(name: str) -> tuple[tuple[int, int, str], ...]:
    """A key that sorts as people count: AU2 before AU12, letters without regard to case."""
    parts = _DIGITS.split(name.casefold())
    return tuple((0, int(part), "") if part.isdecimal() else (1, 0, part) for part in parts if part)


def composed(name: str) -> str:
    """`name` with accents composed: some file systems store them apart."""
    return unicodedata.normalize("NFC", name)


def listed(names: Sequence[str], most: int = 4) -> str:
    """Some names in a sentence: a, b, c and 3 more."""
    shown = ", ".join(names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown
