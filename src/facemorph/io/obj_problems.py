"""What is wrong in one range of an OBJ's text; the earliest of it becomes the error."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Int64
from facemorph.errors import MeshFileError
from facemorph.io.limits import shortened
from facemorph.io.obj_text import ObjText


class Problems:
    """Collects problems with their places: kinds of lines are read one after the other, not in file order."""

    def __init__(self, text: ObjText) -> None:
        self._text = text
        self._found: list[tuple[int, str, str]] = []

    def add(self, place: int, problem: str, hint: str = "") -> None:
        """Something wrong at a place of the text."""
        self._found.append((place, problem, hint))

    def add_first(self, starts: Int64, ends: Int64, wrong: Int64, problem: str, hint: str = "") -> None:
        """The first wrong token of some; `problem` has a place for its text as {token}."""
        if len(wrong):
            first = int(np.min(wrong))
            start, end = int(starts[first]), int(ends[first])
            self.add(start, problem.format(token=shown(self._text, start, end)), hint)

    def raise_first(self) -> None:
        """Raises `MeshFileError` for the problem nearest to the file's start, if there is any."""
        if self._found:
            place, problem, hint = min(self._found, key=lambda found: found[0])
            raise MeshFileError(self._text.path, problem, line=self._text.line_at(place), hint=hint)


def shown(text: ObjText, start: int, end: int) -> str:
    """A token as a message shows it, in quotes."""
    return f"'{shortened(text.token(start, min(end, start + 200)).decode('utf-8', 'replace'))}'"
