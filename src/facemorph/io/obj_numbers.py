"""The numbers of an OBJ's `v`, `vt` and `vn` lines."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int64
from facemorph.io.decimals import floats
from facemorph.io.obj_problems import Problems
from facemorph.io.obj_text import Kind, Lines, ObjText, tokens_of

_LARGEST = float(np.finfo(np.float32).max)


class Numbers:
    """The `v`, `vt` and `vn` lines of one range of a text; what is wrong goes to `problems`."""

    def __init__(self, text: ObjText, lines: Lines, problems: Problems) -> None:
        self._text, self._lines, self._problems = text, lines, problems

    def vertices(self) -> tuple[Float32, Float32 | None]:
        """Positions (n, 3), and colours (n, 3) with NaN where a vertex has none, or None."""
        numbers, counts = self._table(Kind.VERTEX, (3, 4, 6, 7), "a vertex is v x y z")
        positions = np.ascontiguousarray(numbers[:, :3])
        coloured = counts >= 6
        if not coloured.any():
            return positions, None
        return positions, np.where(coloured[:, None], numbers[:, 3:6], np.float32(np.nan))

    def uvs(self) -> Float32:
        """(n, 2); what a line leaves out is 0."""
        return self._table(Kind.UV, (1, 2, 3), "a texture coordinate is vt u v", least=2)[0][:, :2]

    def normals(self) -> Float32:
        """(n, 3) as written."""
        return self._table(Kind.NORMAL, (3,), "a normal is vn x y z", least=3)[0]

    def _table(
        self, kind: Kind, allowed: tuple[int, ...], form: str, least: int = 3
    ) -> tuple[Float32, Int64]:
        """The numbers of the lines of one kind (n, most in a line), 0 where there are fewer; counts (n,)."""
        lines, chosen = self._lines, self._lines.of(kind)
        counts = lines.count[chosen] - 1
        if not len(chosen):
            return np.zeros((0, least), np.float32), counts
        width = int(counts[0])
        if width >= least and width in allowed and bool((counts == width).all()):
            return self._values(*tokens_of(lines, chosen)).reshape(-1, width), counts
        self._check_counts(chosen, counts, allowed, form)
        width = max(least, int(counts.max()))
        if width > max(allowed):
            return np.zeros((len(chosen), least), np.float32), counts
        values = self._values(*tokens_of(lines, chosen))
        table = np.zeros((len(chosen), width), np.float32)
        table[np.arange(width) < counts[:, None]] = values
        return table, counts

    def _check_counts(self, chosen: Int64, counts: Int64, allowed: tuple[int, ...], form: str) -> None:
        wrong = np.flatnonzero(~np.isin(counts, allowed))
        if len(wrong):
            first = wrong[0]
            count = int(counts[first])
            numbers = "no number" if not count else f"{count:,} number{'' if count == 1 else 's'}"
            self._problems.add(
                int(self._lines.starts[self._lines.first[chosen[first]]]), f"{form}, not {numbers}"
            )

    def _values(self, starts: Int64, ends: Int64) -> Float32:
        """The numbers that tokens (n,) write; each must be finite in float32."""
        if not len(starts):
            return np.zeros(0, np.float32)
        values, bad = floats(self._text, starts, ends)
        values[bad] = 0.0
        if len(bad):
            self._problems.add_first(starts, ends, bad, *self._why(starts, ends, bad))
        return self._single(values, starts, ends)

    def _single(self, values: Float64, starts: Int64, ends: Int64) -> Float32:
        with np.errstate(over="ignore"):
            single = values.astype(np.float32)
        if not np.isfinite(single).all():
            wrong = np.flatnonzero(~np.isfinite(single))
            self._problems.add_first(
                starts, ends, wrong, f"{{token}} is larger than {_LARGEST:.3g}, the most there is"
            )
        return single

    def _why(self, starts: Int64, ends: Int64, bad: Int64) -> tuple[str, str]:
        """What is wrong with the first bad number, and what to do."""
        token = self._text.token(int(starts[bad[0]]), int(ends[bad[0]])).lower()
        if any(word in token for word in (b"nan", b"inf", b"#ind")):
            return "{token} is not finite", ""
        hint = "Decimals are written with a point." if b"," in token else ""
        return "{token} is no number", hint
