"""Which points of the template are asked for on a scan, in which order, and what they are called."""

from __future__ import annotations

from collections.abc import Collection

from facemorph.core.rig import Landmark, Rig, plain_label

# Places among the usual 68 that everybody finds, corners and tips; then lids and lips, which may else be
# mistaken for each other; those along edges come last.
_EASY = (36, 45, 39, 42, 30, 48, 54, 8, 27, 33, 51, 57, 17, 26, 21, 22, 31, 35, 19, 24, 0, 16, 4, 12)
_THIN = (37, 38, 40, 41, 43, 44, 46, 47, 62, 66, 61, 63, 65, 67, 50, 52, 56, 58)
# Features of MPEG-4 that scans of skin lack, or show elsewhere: pupils, tongue, teeth.
_INSIDE = ("3.5", "3.6", "6.", "9.8", "9.9", "9.10", "9.11")
FEWEST, PLENTY = 4, 40


def asked_for(rig: Rig) -> tuple[Landmark, ...]:
    """The template's landmarks: easy ones, lids and lips, then in its own order; none inside the mouth."""
    outside = [mark for mark in rig.info.landmarks if not _inside(mark)]
    first = [mark for place in (*_EASY, *_THIN) for mark in outside if mark.ibug == place]
    return (*first, *(mark for mark in outside if mark not in first))


def _inside(mark: Landmark) -> bool:
    number = mark.mpeg4 or ""
    return any(number == part or (part.endswith(".") and number.startswith(part)) for part in _INSIDE)


def next_mark(rig: Rig, done: Collection[int], skipped: Collection[str]) -> Landmark | None:
    """The next landmark to point at: neither pointed at yet, its vertex in `done`, nor passed over."""
    marks = asked_for(rig)
    return next((mark for mark in marks if mark.vertex not in done and mark.name not in skipped), None)


def name_of(rig: Rig, vertex: int) -> str:
    """The name of the landmark at a vertex, or "" where there is none."""
    return next((mark.name for mark in rig.info.landmarks if mark.vertex == vertex), "")


def words_of(name: str, vertex: int) -> str:
    """What a point is called in a list."""
    return plain_label(name) if name else f"Vertex {vertex:,}"


def enough_words(count: int) -> str:
    """How far one is with so many points."""
    if count < FEWEST:
        missing = FEWEST - count
        return f"{missing} more point{'s' * (missing > 1)} at least."
    if count < PLENTY:
        return f"{count} points: enough to try. With those on lids and lips, {PLENTY} in all, it fits best."
    return f"{count} points: plenty."
