"""The text of an OBJ file made even, and cut into lines and tokens in whole arrays.

Making even changes no offset: a BOM, carriage returns and continued lines ("\\" at the end) become
blanks of the same length, so a place in the text is a place in the file, and its line can be told.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Int64, UInt8
from facemorph.errors import MeshFileError
from facemorph.io.decimals import PAD, PaddedText
from facemorph.io.limits import LINE_BYTES, plain_size

CHUNK_BYTES = 1 << 18
"""So much of a text is taken at a time: its arrays fit the processor's cache, and reuse their memory."""

BOM = b"\xef\xbb\xbf"
_FIRST = np.zeros(1, np.int64)
_PADDING = b"\n" * PAD
_LONE_RETURN = re.compile(rb"\r(?!\n)")
_COMMENT_OR_CONTINUED = re.compile(rb"(?<!\S)#[^\n]*|\\[ \t]*(?:\n|\Z)")


class Kind(IntEnum):
    """What a line says, by its first word."""

    OTHER = 0
    VERTEX = 1
    UV = 2
    NORMAL = 3
    FACE = 4
    GROUP = 5
    OBJECT = 6
    MATERIAL = 7
    LIBRARY = 8


_WORD = re.compile(rb"[a-z]{1,7}(?![^\x00-\x20])")
_NAMED = {b"g": Kind.GROUP, b"o": Kind.OBJECT, b"usemtl": Kind.MATERIAL, b"mtllib": Kind.LIBRARY}


class ObjText(PaddedText):
    """An OBJ file's text, evened and padded, that knows the line of every place."""

    def __init__(self, path: Path, data: bytes) -> None:
        """Raises `MeshFileError` for what is no text."""
        if b"\0" in data:
            hint = "Save it as UTF-8." if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ""
            raise MeshFileError(path, "is not a text file, as an OBJ must be", hint=hint)
        self.path = path
        self._line_ends = _with_line_ends(data)
        super().__init__(b"".join((_PADDING, _joined_lines(self._line_ends), _PADDING)))
        self.begin, self.end = PAD, PAD + len(data)

    def line_at(self, place: int) -> int:
        """The line (1-based) of the file on which `place` lies."""
        return self._line_ends.count(b"\n", 0, max(place - PAD, 0)) + 1

    def chunks(self) -> Iterator[tuple[int, int]]:
        """Ranges of whole lines that cover the text. Raises `MeshFileError` on an endless line."""
        begin = self.begin
        while begin < self.end:
            end = min(begin + CHUNK_BYTES, self.end)
            if end < self.end:
                end = self.data.rfind(b"\n", begin, end) + 1 or self._end_of_line(begin)
            yield begin, end
            begin = end

    def _end_of_line(self, begin: int) -> int:
        end = self.data.find(b"\n", begin, begin + LINE_BYTES) + 1
        if not end:
            problem = f"the line is longer than {plain_size(LINE_BYTES)}, the most that is read"
            raise MeshFileError(self.path, problem, line=self.line_at(begin))
        return end


@dataclass(frozen=True, eq=False)
class Lines:
    """The lines with anything on them in one range of a text, L of them, and their N tokens.

    kind            (L,) `Kind`
    first, count    (L,) the line's first token, and how many it has before any "# comment"
    starts, ends    (N,) where each token lies in the text
    """

    kind: UInt8
    first: Int64
    count: Int64
    starts: Int64
    ends: Int64

    def of(self, kind: Kind) -> Int64:
        """Indices of the lines of one kind."""
        return np.flatnonzero(self.kind == kind)


def without_uvs_and_normals(text: ObjText, begin: int, end: int) -> tuple[int, int]:
    """A range of whole lines without the `vt` and `vn` lines at its begin and end."""
    starts = np.flatnonzero(text.bytes[begin - 1 : end - 1] == ord("\n")) + begin
    second = text.bytes[starts + 1]
    other = (text.bytes[starts] != ord("v")) | ((second != ord("t")) & (second != ord("n")))
    kept = np.flatnonzero(other)
    if not len(kept):
        return begin, begin
    last = int(kept[-1])
    return int(starts[kept[0]]), int(starts[last + 1]) if last + 1 < len(starts) else end


def lines_between(text: ObjText, begin: int, end: int) -> Lines:
    """The lines of a range that begins and ends at line ends."""
    # A last line without an end is ended by the padding.
    window = text.bytes[begin - 1 : end + (end == text.end and text.bytes[end - 1] != ord("\n"))]
    blanks = np.flatnonzero(window <= ord(" ")) + (begin - 1)
    starts, ends = blanks[:-1] + 1, blanks[1:]
    filled = ends > starts
    last_of_line = text.bytes[ends] == ord("\n")
    if not filled.all():
        # Where blanks follow blanks, a token is the last of its line if any of them ends the line.
        token = np.cumsum(filled) - 1
        after = token[last_of_line & (token >= 0)]
        starts, ends = starts[filled], ends[filled]
        last_of_line = np.zeros(len(starts), bool)
        last_of_line[after] = True
    last = np.flatnonzero(last_of_line)
    first = np.concatenate([_FIRST, last[:-1] + 1])[: len(last)]
    count = last - first + 1
    kind = _kinds(text, starts[first])
    if text.data.find(b"#", begin, end) >= 0:
        _end_at_comments(text, starts, first, count)
    return Lines(kind, first, count, starts, ends)


def tokens_of(lines: Lines, chosen: Int64) -> tuple[Int64, Int64]:
    """Where all tokens but the first of the chosen lines begin and end, in order."""
    if not len(chosen):
        return lines.starts[:0], lines.ends[:0]
    counts = lines.count[chosen]
    first, last, width = int(lines.first[chosen[0]]), int(lines.first[chosen[-1]]), int(counts[0])
    if last - first == width * (len(chosen) - 1) and bool((counts == width).all()):
        # Lines of one form without a gap, as nearly all are: a table whose first column is left out.
        block = slice(first, last + width)
        starts, ends = lines.starts[block].reshape(-1, width), lines.ends[block].reshape(-1, width)
        return starts[:, 1:].ravel(), ends[:, 1:].ravel()
    counts = counts - 1
    before = np.cumsum(counts) - counts
    tokens = np.repeat(lines.first[chosen] + 1 - before, counts) + np.arange(int(counts.sum()))
    return lines.starts[tokens], lines.ends[tokens]


def _kinds(text: ObjText, starts: Int64) -> UInt8:
    """(L,) `Kind` of each line from where its first token starts."""
    head, second = text.bytes[starts], text.bytes[starts + 1]
    alone = second <= ord(" ")
    kind = np.zeros(len(starts), np.uint8)
    vector = head == ord("v")
    kind[vector & alone] = Kind.VERTEX
    kind[(head == ord("f")) & alone] = Kind.FACE
    pairs = np.flatnonzero(vector & ((second == ord("t")) | (second == ord("n"))))
    if len(pairs):
        pairs = pairs[text.bytes[starts[pairs] + 2] <= ord(" ")]
        kind[pairs] = np.where(second[pairs] == ord("t"), Kind.UV, Kind.NORMAL)
    names = (head == ord("g")) | (head == ord("o")) | (head == ord("u")) | (head == ord("m"))
    for i in np.flatnonzero(names):
        word = _WORD.match(text.data, int(starts[i]))
        kind[i] = _NAMED.get(word[0], Kind.OTHER) if word else Kind.OTHER
    return kind


def _end_at_comments(text: ObjText, starts: Int64, first: Int64, count: Int64) -> None:
    """Lower each line's count to its tokens before one that begins with "#"; names are read apart."""
    comments = np.flatnonzero(text.bytes[starts] == ord("#"))
    if len(comments):
        line = np.searchsorted(first, comments, side="right") - 1
        np.minimum.at(count, line, comments - first[line])


def _with_line_ends(data: bytes) -> bytes:
    """The same length, with lines that end in "\\n" alone and no BOM."""
    if data.startswith(BOM):
        data = b"   " + data[len(BOM) :]
    if b"\r" in data:
        data = _LONE_RETURN.sub(b"\n", data.replace(b"\r\n", b" \n"))
    return data


def _joined_lines(data: bytes) -> bytes | bytearray:
    """The same length, with continued lines joined; a comment that ends in "\\" (a path) goes on nowhere."""
    if b"\\" not in data:
        return data
    joined = bytearray(data)
    for found in _COMMENT_OR_CONTINUED.finditer(data):
        start, end = found.span()
        if data[start] == ord("\\"):
            joined[start:end] = b" " * (end - start)
    return joined
