"""How long work tells where it is, and is stopped."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

# Called with the fraction done, 0..1, and what is being done in plain words; it raises
# JobCancelledError to stop the work.
Progress: TypeAlias = Callable[[float, str], None]


def silent(fraction: float, doing: str) -> None:
    """A `Progress` that nobody looks at."""


def part_of(progress: Progress, begin: float, end: float) -> Progress:
    """The `Progress` of a part of the work, from the fraction `begin` of the whole to `end`."""
    return lambda fraction, doing: progress(begin + (end - begin) * fraction, doing)
