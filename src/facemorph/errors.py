"""Every error that a person can cause, under one root.

    FacemorphError                  anything the package refuses, told in one line
      MeshFileError                 a mesh file that cannot be read as what it claims to be
        UnsupportedFormatError      a file type that no reader handles
      MeshDataError                 arrays that do not make a mesh
      CorrespondenceError           a shape that does not match its neutral
      FaceFolderError               a folder (or set of files) that is not a face
      ControlsFileError             a file of points or regions that is none, or is for another face
      UnknownNameError              a shape, expression, face, unit or option nobody knows
      DeformError                   controls of a method that make no deformation: coincident points, ...
      FitError                      examples or scans that no face can be made of, and why
      PoseError                     a weight or position on the slider that is no usable number
      OptionError                   an option whose value cannot be used
      OutputError                   a file that cannot be written, or would overwrite something
      GraphicsError                 no OpenGL context, or one that cannot draw this
        DisplayError                no screen to open a window on
      JobCancelledError             long work that the user stopped

A message says what was expected, what came, where, and what to do. The command line prints
`str(error)` and exits with status 2; the window shows it and goes on.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path


class FacemorphError(Exception):
    """Root of every error the package raises on purpose; `str()` is one line made for people."""


class MeshFileError(FacemorphError):
    """A mesh file that cannot be read. `path` and `line` (1-based, or None) say where."""

    def __init__(self, path: Path | str, problem: str, *, line: int | None = None, hint: str = "") -> None:
        self.path = Path(path)
        self.line = line
        self.problem = problem
        self.hint = hint
        where = f"{self.path}:{line}" if line is not None else f"{self.path}"
        super().__init__(_sentences(f"{where}: {problem}", hint))


class UnsupportedFormatError(MeshFileError):
    """A file type that no reader handles."""


class MeshDataError(FacemorphError):
    """Arrays that do not make a mesh: wrong shape, index out of range, not finite."""


class CorrespondenceError(FacemorphError):
    """A shape whose vertices or polygons do not match the neutral's; `cause` is a short key."""

    def __init__(self, shape: str, problem: str, *, cause: str, hint: str = "") -> None:
        self.shape = shape
        self.cause = cause
        self.problem = problem
        self.hint = hint
        super().__init__(_sentences(f"{shape}: {problem}", hint))


class FaceFolderError(FacemorphError):
    """A folder, or a list of files, that does not make a face."""


class ControlsFileError(FacemorphError):
    """A file that should keep controls of a method (points, regions) and cannot be used on this face."""


class UnknownNameError(FacemorphError):
    """A name nobody knows, with what was meant perhaps, and what there is."""

    def __init__(self, kind: str, name: str, choices: Iterable[str]) -> None:
        self.kind = kind
        self.name = name
        self.choices = tuple(choices)
        super().__init__(f"no {kind} is called {name!r}.{_suggestion(name, self.choices)}")


class PoseError(FacemorphError):
    """A weight, or a position on the slider, that is no usable number."""


class DeformError(FacemorphError):
    """Controls of a method that make no deformation: coincident control points, a singular system."""


class FitError(FacemorphError):
    """A template, neutral, example or scan that no face can be made of; says which one and why."""


class OptionError(FacemorphError):
    """An option of the command line or the library whose value cannot be used."""


class OutputError(FacemorphError):
    """A file that cannot be written, or that would overwrite something of the user's."""


class GraphicsError(FacemorphError):
    """No OpenGL context could be had, or the one there is cannot draw this."""


class DisplayError(GraphicsError):
    """There is no screen to open a window on."""


class JobCancelledError(FacemorphError):
    """Long work that the user stopped; nothing of it was kept."""


def _sentences(problem: str, hint: str) -> str:
    if not hint:
        return problem
    end = "" if problem.endswith((".", "?", "!")) else "."
    return f"{problem}{end} {hint}"


def _suggestion(name: str, choices: tuple[str, ...], most: int = 12) -> str:
    if not choices:
        return " There are none here."
    folded = {choice.casefold(): choice for choice in choices}
    close = difflib.get_close_matches(name.casefold(), folded, n=1, cutoff=0.6)
    meant = f" Did you mean {folded[close[0]]!r}?" if close else ""
    more = f", and {len(choices) - most} more" if len(choices) > most else ""
    return f"{meant} There are: {', '.join(choices[:most])}{more}."
