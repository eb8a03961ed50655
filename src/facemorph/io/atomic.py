"""Writing without halves: a temporary file beside the goal, renamed onto it when all is well."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from facemorph.errors import OutputError
from facemorph.io.limits import reason


@contextlib.contextmanager
def replacing(path: Path | str) -> Iterator[Path]:
    """A temporary path to write to; it takes the place of `path` when the block ends without an error.

    The temporary file lies in the same folder and has the same suffix (writers that choose a format by
    it work), so the rename is atomic: whoever looks sees the old file or the new one, never half of
    either. A symbolic link is followed: what it points to is replaced, the link stays. Missing folders
    on the way are made. On any error the temporary file and those folders go and `path` is as before.
    Raises `OutputError`.
    """
    shown = Path(path)
    goal = Path(os.path.realpath(shown))
    if goal.is_dir():
        raise OutputError(f"{shown} is a folder; a file's name was expected. Add one, as {shown / 'name'}.")
    if not shown.name:
        raise OutputError(f"{str(shown)!r} is no file name.")
    with folders_for(goal, shown):
        temporary = _empty_file_beside(goal, shown)
        try:
            yield temporary
            temporary.chmod(usual_mode(goal))
            temporary.replace(goal)
        except OSError as error:
            raise OutputError(f"{shown} could not be written: {reason(error)}.") from error
        finally:
            temporary.unlink(missing_ok=True)


def write_bytes(path: Path | str, *parts: bytes | memoryview) -> None:
    """Write `parts` one after the other as the whole of `path`, atomically. Raises `OutputError`."""
    with replacing(path) as temporary, temporary.open("wb") as file:
        for part in parts:
            file.write(part)


@contextlib.contextmanager
def folders_for(goal: Path, shown: Path) -> Iterator[None]:
    """Make the folders on the way to `goal`; those that were made, and are empty, go again on an error.

    Raises `OutputError`, which names the path `shown`.
    """
    missing = [folder for folder in goal.parents if not folder.exists()]
    try:
        goal.parent.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        _remove_empty(missing)
        raise OutputError(f"{shown} could not be written: {reason(error)}.") from error
    try:
        yield
    except BaseException:
        _remove_empty(missing)
        raise


def _remove_empty(folders: list[Path]) -> None:
    for folder in folders:
        with contextlib.suppress(OSError):
            folder.rmdir()


def _empty_file_beside(goal: Path, shown: Path) -> Path:
    try:
        handle, name = tempfile.mkstemp(suffix=goal.suffix[:16], prefix=".facemorph-", dir=goal.parent)
    except (OSError, ValueError) as error:
        raise OutputError(f"{shown} could not be written: {reason(error)}.") from error
    os.close(handle)
    return Path(name)


def usual_mode(goal: Path, new: int = 0o666) -> int:
    """The mode that `goal` has, or a new one would get: temporary ones shut others out."""
    with contextlib.suppress(OSError):
        return goal.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return new & ~mask
