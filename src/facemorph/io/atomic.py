"""Writing without halves: a temporary file beside the goal, renamed onto it when all is well."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
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


@contextlib.contextmanager
def new_folder(out: Path, wanted: Callable[[], bool] = lambda: True) -> Iterator[Path]:
    """A folder to fill that becomes `out` when all is well and it is `wanted`; else it goes.

    `out` must be new or empty; an empty one stays the folder it is (someone may stand in it, or it may be
    a disk of its own) and gets what is in the new one. Raises `OutputError`.
    """
    check_new(out)
    goal = Path(os.path.realpath(out))
    try:
        with folders_for(goal, out):
            beside = goal if goal.is_dir() else goal.parent
            stage = Path(tempfile.mkdtemp(prefix=".facemorph-", dir=beside))
            try:
                yield stage
                if wanted():
                    _put(stage, goal, out)
            finally:
                shutil.rmtree(stage, ignore_errors=True)
    except OSError as error:
        raise OutputError(f"{out} could not be written: {reason(error)}.") from error


def check_new(out: Path) -> None:
    """Raises `OutputError` where no folder `out` can be made: it is there and not empty, or none may be."""
    try:
        goal = Path(os.path.realpath(out))
        if goal.exists() and (not goal.is_dir() or any(goal.iterdir())):
            problem = "is not empty" if goal.is_dir() else "is a file"
            raise OutputError(f"{out} {problem}, and nothing is overwritten; name a new folder.")
    except (OSError, ValueError) as error:
        raise OutputError(f"{out} could not be written: {reason(error)}.") from error
    check_place(goal if goal.exists() else goal.parent, out)


def check_place(folder: Path, shown: Path) -> None:
    """Raises `OutputError`, which names `shown`, where nothing can be written into `folder`, new or not."""
    place = next((path for path in (folder, *folder.parents) if os.path.lexists(path)), None)
    if place is None or not place.is_dir():
        raise OutputError(f"{shown} could not be written: {place or folder} is no folder.")
    if not os.access(place, os.W_OK | os.X_OK):
        raise OutputError(f"{shown} could not be written: nothing may be put into {place}.")


def _put(stage: Path, goal: Path, shown: Path) -> None:
    """Make `stage` the folder `goal`, or what is in it the contents of an empty one; all of it or nothing."""
    if not goal.exists():
        stage.chmod(usual_mode(goal, 0o777))
        stage.rename(goal)
        return
    if any(path != stage for path in goal.iterdir()):
        raise OutputError(f"{shown} is not empty any more, and nothing is overwritten; name a new folder.")
    moved: list[Path] = []
    try:
        for path in sorted(stage.iterdir()):
            moved.append(path)
            path.rename(goal / path.name)
    except BaseException:
        for path in moved:
            with contextlib.suppress(OSError):
                (goal / path.name).rename(path)
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
