"""Bringing shapes whose vertices stand in another order back into the neutral's."""

from __future__ import annotations

from pathlib import Path

from facemorph.core.correspondence import difference
from facemorph.core.progress import Progress, silent
from facemorph.core.reorder import reorder
from facemorph.errors import OutputError
from facemorph.io.load import face_files
from facemorph.io.obj_write import write_obj
from facemorph.io.read import read_mesh


def repair_folder(folder: Path | str, out: Path | str, *, progress: Progress = silent) -> tuple[Path, ...]:
    """Write reordered copies, as OBJ, of those shapes of a face folder whose vertices are in another order.

    Only those are written, into `out`, under their own names; nothing in `folder` changes, and no file is
    overwritten. Returns what was written. Raises `OutputError` where a file is in the way, and what
    reading the set raises.
    """
    files = face_files(Path(folder))
    neutral = read_mesh(files.neutral)
    written: list[Path] = []
    for done, (name, path) in enumerate(files.shapes.items()):
        progress(done / len(files.shapes), f"reading {path.name}")
        shape = read_mesh(path)
        unlike = difference(neutral, shape)
        if unlike is None or unlike.cause != "order":
            continue
        goal = Path(out) / f"{path.stem}.obj"
        if goal.exists():
            raise OutputError(f"{goal} is there already and would be overwritten; name a new folder.")
        written.extend(write_obj(goal, reorder(neutral, shape, name)))
    return tuple(written)
