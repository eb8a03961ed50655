"""Each polygon's group, object and material, from lines that hold until the next of their kind."""

from __future__ import annotations

from array import array

import numpy as np

from facemorph.core.arrays import Int64
from facemorph.core.mesh import Labels
from facemorph.errors import MeshFileError
from facemorph.io.limits import NAME_BYTES, NAMES
from facemorph.io.obj_text import ObjText


class LabelChanges:
    """The changes of one kind of label along a file, in order."""

    def __init__(self, kind: str) -> None:
        self._kind = kind
        self._numbers: dict[str, int] = {}
        # Two machine integers a change: a file may change its group at every face.
        self._polygons, self._names = array("q"), array("i")

    def change(self, polygon: int, name: str, text: ObjText, place: int) -> None:
        """From `polygon` on the label is `name`; an empty name is none. Raises `MeshFileError` at `place`."""
        number = self._numbers.setdefault(name, len(self._numbers)) if name else -1
        if len(self._numbers) > NAMES or len(name.encode("utf-8", "replace")) > NAME_BYTES:
            longest = f"at most {NAMES:,} names of at most {NAME_BYTES:,} bytes are read"
            raise MeshFileError(
                text.path, f"too many or too long {self._kind} names; {longest}", line=text.line_at(place)
            )
        if self._polygons and self._polygons[-1] == polygon:
            self._names[-1] = number
        else:
            self._polygons.append(polygon)
            self._names.append(number)

    def labels(self, polygon_count: int) -> Labels | None:
        """The label of each polygon; names in order of first use, None where no polygon has one."""
        changes = np.frombuffer(self._names, np.int32) if self._names else np.zeros(0, np.int32)
        names = np.concatenate([np.full(1, -1, np.int32), changes])
        starts: Int64 = np.array([0, *self._polygons, polygon_count], np.int64)
        lengths = starts[1:] - starts[:-1]
        used, first = np.unique(names[(names >= 0) & (lengths > 0)], return_index=True)
        if not len(used):
            return None
        used = used[np.argsort(first)]
        # One place more, so that the last is that of -1, no name.
        renumbered = np.full(len(self._numbers) + 1, -1, np.int32)
        renumbered[used] = np.arange(len(used), dtype=np.int32)
        known = list(self._numbers)
        return Labels(tuple(known[i] for i in used), np.repeat(renumbered[names], lengths))
