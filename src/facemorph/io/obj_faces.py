"""The corners of an OBJ's faces: `v`, `v/vt`, `v//vn`, `v/vt/vn`, counted from 1 or back from -1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Int32, Int64
from facemorph.io.decimals import integers
from facemorph.io.limits import POLYGON_CORNERS
from facemorph.io.obj_problems import Problems
from facemorph.io.obj_text import Kind, Lines, ObjText, tokens_of

PARTS = ("vertex", "texture coordinate", "normal")
_KINDS = (Kind.VERTEX, Kind.UV, Kind.NORMAL)
_LARGEST = (1 << 31) - 1
_NOWHERE = 1 << 62


@dataclass(frozen=True, eq=False)
class Faces:
    """Faces of one range of the text.

    sizes    (P,) int32, corners of each
    corners  (3, C) int32, position, uv and normal from 0 on; -1 where a corner has none. They may lie
             past what the file has: references ahead are allowed, so that is checked at its end.
    """

    sizes: Int32
    corners: Int32


def read_faces(text: ObjText, lines: Lines, counts_before: tuple[int, int, int], problems: Problems) -> Faces:
    """The faces among `lines`.

    counts_before   v, vt and vn lines in the file before this range, for indices that count back
    """
    chosen = lines.of(Kind.FACE)
    if not len(chosen):
        return Faces(np.zeros(0, np.int32), np.zeros((3, 0), np.int32))
    sizes = lines.count[chosen] - 1
    _check_sizes(lines, chosen, sizes, problems)
    starts, ends = tokens_of(lines, chosen)
    corners = np.full((3, len(starts)), -1, np.int32)
    low, high = (int(starts[0]), int(ends[-1])) if len(starts) else (0, 0)
    slashes = np.flatnonzero(text.bytes[low:high] == ord("/")) + low
    for part, (begin, end) in enumerate(_parts(slashes, starts, ends)):
        # A corner always has a vertex; an empty one is found to be no number.
        present = np.flatnonzero(end > begin) if part else np.arange(len(begin))
        if not len(present):
            continue
        whole = len(present) == len(begin)
        values, bad = integers(text, *((begin, end) if whole else (begin[present], end[present])))
        values[bad] = 1
        problems.add_first(starts, ends, present[bad], "{token} is no corner of a face")
        if int(values.min()) < 1:
            zero = present[values == 0]
            problems.add_first(starts, ends, zero, f"{{token}} names {PARTS[part]} 0; indices begin at 1")
            back = np.flatnonzero(values < 0)
            before = np.cumsum(lines.kind == _KINDS[part])[chosen] + counts_before[part]
            values[back] += np.repeat(before, sizes)[present[back]] + 1
            problems.add_first(
                starts,
                ends,
                present[back[values[back] < 1]],
                f"{{token}} counts back past the first {PARTS[part]}",
            )
        values -= 1
        if int(values.max()) > _LARGEST:
            np.minimum(values, _LARGEST, out=values)
        corners[part, slice(None) if whole else present] = values
    return Faces(sizes.astype(np.int32), corners)


def corner_token(lines: Lines, corner: int) -> tuple[int, int]:
    """Where the corner numbered `corner` among these lines begins and ends."""
    starts, ends = tokens_of(lines, lines.of(Kind.FACE))
    return int(starts[corner]), int(ends[corner])


def _check_sizes(lines: Lines, chosen: Int64, sizes: Int64, problems: Problems) -> None:
    for i in np.flatnonzero((sizes < 3) | (sizes > POLYGON_CORNERS))[:1]:
        size = int(sizes[i])
        wanted = "a face needs at least 3" if size < 3 else f"at most {POLYGON_CORNERS:,} are read"
        place = int(lines.starts[lines.first[chosen[i]]])
        problems.add(place, f"a face of {size:,} corner{'' if size == 1 else 's'}; {wanted}")


def _parts(slashes: Int64, starts: Int64, ends: Int64) -> tuple[tuple[Int64, Int64], ...]:
    """Where each corner's vertex, uv and normal index begin and end, each (C,); absent ones end before."""
    first, second = _two_slashes(slashes, starts, ends)
    return (starts, first), (first + 1, second), (second + 1, ends)


def _two_slashes(slashes: Int64, starts: Int64, ends: Int64) -> tuple[Int64, Int64]:
    """The first and second slash of each corner, or its end where it has none; each (C,)."""
    for each in (1, 2):
        if len(slashes) == each * len(starts):
            table = slashes.reshape(-1, each)
            if bool(((table[:, 0] >= starts) & (table[:, -1] < ends)).all()):
                return table[:, 0], table[:, 1] if each == 2 else ends
    beyond = np.append(slashes, [_NOWHERE, _NOWHERE])
    nearest = np.searchsorted(slashes, starts)
    return np.minimum(beyond[nearest], ends), np.minimum(beyond[nearest + 1], ends)
