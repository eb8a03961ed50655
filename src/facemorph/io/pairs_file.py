"""Pairs of landmarks between a template and a scan as a small table (CSV, UTF-8, commas).

    name,template,scan              name,template,x,y,z
    nose tip,5010,20344             nose tip,5010,0.02,-3.41,4.66
    chin,chin bottom,1877           chin,chin bottom,0.01,-9.3,3.2

The first line names the columns, in any order. `template` is a vertex of the template, counted from 0 as in
face.toml, or the name of one of its landmarks, or "ibug 30" for number 30, from 0, of the usual 68.
The other side is either `scan`, a vertex of the scan counted from 0, or `x`, `y` and `z` in the scan's
unit. `name` may be left out. Empty lines are passed over.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from facemorph.core.landmark_pair import MOST_PAIRS, LandmarkPair
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.errors import ControlsFileError, MeshFileError
from facemorph.io.atomic import replacing
from facemorph.io.limits import NAME_BYTES, plain_size, read_bytes, shortened

_LARGEST_FILE = 1 << 20
_FARTHEST = 1e12
_LONGEST_NUMBER = 40
_NAME, _TEMPLATE, _SCAN, _PLACE = "name", "template", "scan", ("x", "y", "z")
_HINT = "The first line names the columns: template,scan or template,x,y,z, and name if wanted."

_Row = Mapping[str, str]


def write_pairs(path: str | Path, pairs: Sequence[LandmarkPair]) -> None:
    """Keep pairs with their places by coordinates, whole or not at all. Raises `OutputError`."""
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow((_NAME, _TEMPLATE, *_PLACE))
    for pair in pairs:
        rows.writerow((_one_line(pair.name), pair.vertex, *(repr(float(value)) for value in pair.point)))
    with replacing(Path(path)) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")


def read_pairs(path: str | Path, template: Rig | Mesh, scan: Mesh) -> tuple[LandmarkPair, ...]:
    """The pairs kept in a file, places in the scan's unit.

    Landmarks may be named where `template` is a rig that has them. Raises `ControlsFileError`, which names
    file and line, for what is no such table, a vertex or a landmark that is not there, or one given twice.
    """
    path = Path(path)
    source = _Source(path, template, scan)
    pairs: dict[int, tuple[int, LandmarkPair]] = {}
    for line, row in _rows(path):
        pair = source.pair(line, row)
        before = pairs.setdefault(pair.vertex, (line, pair))
        if before[0] != line:
            raise _wrong(
                path, line, f"vertex {pair.vertex} of the template stands in line {before[0]} already."
            )
        if len(pairs) > MOST_PAIRS:
            raise _wrong(path, line, f"at most {MOST_PAIRS:,} pairs are taken.")
    if not pairs:
        raise ControlsFileError(f"{path} holds no pairs. {_HINT}")
    return tuple(pair for _, pair in pairs.values())


@dataclass(frozen=True, eq=False)
class _Source:
    """What the lines of a file are about."""

    path: Path
    template: Rig | Mesh
    scan: Mesh

    def pair(self, line: int, row: _Row) -> LandmarkPair:
        """The pair of one line."""
        vertex = self._vertex(line, row[_TEMPLATE])
        return LandmarkPair(vertex, self._place(line, row), row.get(_NAME, "") or self._named(row[_TEMPLATE]))

    def _vertex(self, line: int, text: str) -> int:
        mesh = self.template.neutral if isinstance(self.template, Rig) else self.template
        if text.isascii() and text.isdecimal():
            return self._number(line, text, mesh, "template")
        marks = self.template.info.landmarks if isinstance(self.template, Rig) else ()
        for mark in marks:
            if mark.name == text or (mark.ibug is not None and text == f"ibug {mark.ibug}"):
                return mark.vertex
        among = f" among its {len(marks)}" if marks else ""
        raise _wrong(
            self.path,
            line,
            f"the template has no landmark called {shortened(text)!r}{among}; "
            "a vertex counted from 0 is always taken.",
        )

    def _named(self, text: str) -> str:
        return "" if text.isdecimal() else text

    def _place(self, line: int, row: _Row) -> tuple[float, float, float]:
        if _SCAN in row:
            vertex = self._number(line, row[_SCAN], self.scan, _SCAN)
            x, y, z = self.scan.positions[vertex].astype(float).tolist()
        else:
            x, y, z = (self._coordinate(line, axis, row[axis]) for axis in _PLACE)
        return x, y, z

    def _number(self, line: int, text: str, mesh: Mesh, side: str) -> int:
        """A vertex of `mesh`."""
        plain = text.isascii() and text.isdecimal() and len(text) <= _LONGEST_NUMBER
        if not plain or int(text) >= mesh.vertex_count:
            raise _wrong(
                self.path,
                line,
                f"`{side}` must be a vertex from 0 to {mesh.vertex_count - 1:,}, not {shortened(text)!r}.",
            )
        return int(text)

    def _coordinate(self, line: int, axis: str, text: str) -> float:
        try:
            value = float(text) if len(text) <= _LONGEST_NUMBER and "_" not in text else math.nan
        except ValueError:
            value = math.nan
        # Also holds off nan and infinity.
        if not abs(value) <= _FARTHEST:
            raise _wrong(self.path, line, f"`{axis}` must be a number, not {shortened(text)!r}.")
        return value


def _rows(path: Path) -> list[tuple[int, _Row]]:
    """Each line's number and its cells by column."""
    lines = list(_cells(path))
    if not lines:
        raise ControlsFileError(f"{path} is empty. {_HINT}")
    header_line, header = lines[0]
    columns = [cell.casefold() for cell in header]
    _check_columns(path, header_line, columns)
    rows: list[tuple[int, _Row]] = []
    for line, cells in lines[1:]:
        if len(cells) != len(columns):
            raise _wrong(
                path,
                line,
                f"{len(columns)} values were expected, as in line {header_line}, not {len(cells)}.",
            )
        rows.append((line, dict(zip(columns, cells, strict=True))))
    return rows


def _check_columns(path: Path, line: int, columns: Sequence[str]) -> None:
    sides = [column for column in columns if column != _NAME]
    if len(set(columns)) < len(columns) or set(sides) not in ({_TEMPLATE, _SCAN}, {_TEMPLATE, *_PLACE}):
        found = shortened(",".join(columns), 60)
        raise _wrong(path, line, f"these columns cannot be read: {found}. {_HINT}")


def _cells(path: Path) -> list[tuple[int, list[str]]]:
    """The cells of every line that has any, without the blanks around them."""
    reader = csv.reader(StringIO(_text(path), newline=""), strict=True)
    lines = []
    try:
        for cells in reader:
            plain = [cell.strip() for cell in cells]
            if any(len(cell.encode()) > NAME_BYTES or not cell.isprintable() for cell in plain):
                raise _wrong(path, reader.line_num, "a value is too long, or holds what cannot be printed.")
            if any(plain):
                lines.append((reader.line_num, plain))
    except csv.Error as error:
        raise _wrong(path, reader.line_num, f"is no line of a table: {error}.") from error
    return lines


def _text(path: Path) -> str:
    if not path.is_file():
        problem = "is no file" if path.exists() else "does not exist"
        raise ControlsFileError(f"{path} {problem}; a table of landmark pairs (.csv) was expected.")
    try:
        return read_bytes(path, _LARGEST_FILE).decode("utf-8-sig")
    except MeshFileError as error:
        raise ControlsFileError(
            f"{path} {error.problem}; pairs of landmarks take less than {plain_size(_LARGEST_FILE)}."
        ) from error
    except UnicodeDecodeError as error:
        raise ControlsFileError(f"{path} is no table of pairs: it is not text in UTF-8.") from error


def _one_line(name: str) -> str:
    """`name` as it can be read again."""
    plain = "".join(c if c.isprintable() else "_" for c in name).strip()
    return plain.encode("utf-8", "replace")[:NAME_BYTES].decode("utf-8", "ignore")


def _wrong(path: Path, line: int, problem: str) -> ControlsFileError:
    return ControlsFileError(f"{path}:{line}: {problem}")
