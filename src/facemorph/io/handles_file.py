"""Sets of control points as a small JSON file, to be kept, shared and used on other faces of one topology.

{"format": "facemorph handles 1", "vertices": 10590, "kernel": "r", "c": null, "caged": true,
 "handles": [{"vertex": 4711, "moved": [0.0, 0.3, 0.0], "anchor": false}, ...]}
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from facemorph.core.rig import Rig
from facemorph.deform.handles import Handle, HandleSet
from facemorph.deform.rbf import Kernel, checked_kernel
from facemorph.errors import ControlsFileError, OptionError
from facemorph.io.atomic import replacing
from facemorph.io.limits import read_bytes

FORMAT = "facemorph handles 1"
_LARGEST_FILE = 4_000_000
MOST_HANDLES = 2000
_FARTHEST = 1e12


def write_handles(path: str | Path, handles: HandleSet, rig: Rig) -> None:
    """Keep `handles`, whole or not at all. Raises `OutputError`."""
    content = {
        "format": FORMAT,
        "vertices": rig.neutral.vertex_count,
        "kernel": handles.kernel,
        "c": handles.c,
        "caged": handles.caged,
        "handles": [
            {"vertex": h.vertex, "moved": list(h.moved), "anchor": h.anchor} for h in handles.handles
        ],
    }
    with replacing(Path(path)) as temporary:
        temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def read_handles(path: str | Path, rig: Rig) -> HandleSet:
    """The handles kept in a file. Raises `ControlsFileError` where they are none, or not for this face."""
    path = Path(path)
    content = _content(path)
    if content.get("vertices") != rig.neutral.vertex_count:
        raise ControlsFileError(
            f"{path}: its points are for a face of {content.get('vertices')} vertices; "
            f"{rig.info.name} has {rig.neutral.vertex_count:,}. Use a face of the same topology."
        )
    rows = content.get("handles")
    if not isinstance(rows, list) or len(rows) > MOST_HANDLES:
        raise ControlsFileError(f"{path}: `handles` must be a list of at most {MOST_HANDLES:,} points.")
    handles = tuple(_handle(path, place, row, rig.neutral.vertex_count) for place, row in enumerate(rows, 1))
    vertices = [handle.vertex for handle in handles]
    if len(set(vertices)) < len(vertices):
        raise ControlsFileError(f"{path}: two points stand at one vertex; take one away.")
    kernel = _kernel(path, str(content.get("kernel", "r")))
    c = content.get("c")
    if c is not None and not _is_length(c):
        raise ControlsFileError(f"{path}: `c` must be null or a length of 0 or more, not {c!r}.")
    return HandleSet(handles, kernel, None if c is None else float(c), content.get("caged", True) is True)


def _content(path: Path) -> dict[str, Any]:
    try:
        content = json.loads(read_bytes(path, _LARGEST_FILE))
    except (ValueError, RecursionError) as error:
        raise ControlsFileError(f"{path} is no file of points: it is not JSON.") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise ControlsFileError(f'{path} is no file of points: it does not say "format": "{FORMAT}".')
    return content


def _handle(path: Path, place: int, row: object, vertex_count: int) -> Handle:
    if not isinstance(row, dict):
        raise ControlsFileError(f"{path}: point {place} must be an object with `vertex` and `moved`.")
    vertex, moved = row.get("vertex"), row.get("moved", [0.0, 0.0, 0.0])
    if type(vertex) is not int or not 0 <= vertex < vertex_count:
        raise ControlsFileError(
            f"{path}: point {place} stands at vertex {vertex!r}; there are {vertex_count:,}."
        )
    if not isinstance(moved, list) or len(moved) != 3 or not all(_is_number(value) for value in moved):
        raise ControlsFileError(f"{path}: point {place} must be moved by three numbers, not {moved!r}.")
    x, y, z = (float(value) for value in moved)
    return Handle(vertex, (x, y, z), row.get("anchor", False) is True)


def _kernel(path: Path, name: str) -> Kernel:
    try:
        return checked_kernel(name)
    except OptionError as error:
        raise ControlsFileError(f"{path}: {error}") from error


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= _FARTHEST


def _is_length(value: object) -> bool:
    return isinstance(value, int | float) and _is_number(value) and value >= 0
