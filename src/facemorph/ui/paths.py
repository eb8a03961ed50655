"""Completing a path that is typed: what there is in its folder that begins as it does."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

MOST_ENTRIES = 500


@dataclass(frozen=True)
class Entry:
    """A folder or a file that a typed path could mean."""

    name: str
    path: str
    is_folder: bool


def home() -> Path:
    """The user's home, or the present folder for a user without one."""
    try:
        return Path.home()
    except RuntimeError:
        return Path.cwd()


def expanded(text: str) -> Path:
    """A typed path with `~` and quotes resolved, absolute."""
    words = text.strip().strip("\"'")
    # Not `resolve`: a link keeps the name that was typed.
    return Path(os.path.normpath(Path.cwd() / (f"{home()}{words[1:]}" if words[:1] == "~" else words)))


def folder_of(text: str) -> Path:
    """The folder whose contents a typed path is about: itself if it ends with a slash, else its parent."""
    path = expanded(text)
    ends = text.strip().endswith(("/", os.sep)) or not text.strip()
    return path if ends else path.parent


def entries(text: str, suffixes: tuple[str, ...]) -> list[Entry]:
    """Folders and files of `suffixes` that complete a typed path: folders first, hidden ones on request."""
    folder = folder_of(text)
    ends = text.strip().endswith(("/", os.sep)) or not text.strip()
    begin = "" if ends else expanded(text).name.casefold()
    found: list[Entry] = []
    try:
        with os.scandir(folder) as listing:
            for item in listing:
                if len(found) >= MOST_ENTRIES:
                    break
                if _fits(item, begin, suffixes):
                    found.append(_entry(item))
    except OSError:
        return []
    return sorted(found, key=lambda entry: (not entry.is_folder, entry.name.casefold()))


def _fits(item: os.DirEntry[str], begin: str, suffixes: tuple[str, ...]) -> bool:
    if not item.name.casefold().startswith(begin) or (
        item.name.startswith(".") and not begin.startswith(".")
    ):
        return False
    return _is_folder(item) or item.name.casefold().endswith(suffixes)


def _is_folder(item: os.DirEntry[str]) -> bool:
    try:
        return item.is_dir()
    except OSError:
        return False


def _entry(item: os.DirEntry[str]) -> Entry:
    folder = _is_folder(item)
    return Entry(item.name, item.path + (os.sep if folder else ""), folder)


def completed(text: str, found: list[Entry]) -> str:
    """The typed path, made longer as far as all entries agree."""
    if not found:
        return text
    names = [entry.path for entry in found]
    folded = [name.casefold() for name in names]
    first, last = min(folded), max(folded)
    agreed = next(
        (i for i in range(min(len(first), len(last))) if first[i] != last[i]), min(len(first), len(last))
    )
    longer = names[0][:agreed]
    return longer if len(longer) > len(str(expanded(text))) or len(found) == 1 else text


def suffixed(path: Path, suffix: str) -> Path:
    """The file that a chosen name stands for: the suffix is added where it is missing."""
    return path if path.suffix.lower() == suffix else path.with_name(path.name + suffix)
