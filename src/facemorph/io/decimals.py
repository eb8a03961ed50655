"""Numbers out of text, many at once, a column of digits a step, in whole arrays.

A token (a run of characters between blanks) lies at bytes[starts[i]:ends[i]]. The last digits of all
tokens are one array of bytes, those before them the next; pairs of columns, then fours, then eights are
joined, each in the narrowest type that holds them, so that one instruction joins as many as can be. What
stands before a coordinate's point and what stands behind it are two such numbers.
value = mantissa / 10^decimals is then correctly rounded, because both are exact float64 numbers (W. D.
Clinger, "How to read floating point numbers accurately", 1990, its fast case). Every other token (an
exponent, too many digits, or no number at all) goes to Python's own float() or int().
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float64, Int32, Int64, UInt8

_Bool = NDArray[np.bool_]
_Column = NDArray[Any]

PAD = 16
"""Blank bytes before and after a text, so that the bytes before any place can be loaded."""

_AT_ONCE = 8
"""Most digits of one step: 99,999,999 fits 32 bits."""

_JOINS = ((10, np.uint8), (100, np.uint16), (10_000, np.int32))
_POWERS = 10 ** np.arange(19, dtype=np.int64)
_FLOAT_POWERS = 10.0 ** np.arange(19)
_EXACT = 1 << 53
_LONGEST_NUMBER = 1_000
_NUMBER_BYTES = b"0123456789+-.eE"
_INTEGER = re.compile(rb"[+-]?[0-9]+")


class PaddedText:
    """Bytes with `PAD` newlines around them; `bytes` (n,) uint8 are the same."""

    def __init__(self, padded: bytes) -> None:
        self.data = padded
        self.bytes: UInt8 = np.frombuffer(padded, np.uint8)

    def token(self, start: int, end: int) -> bytes:
        """The bytes of one token."""
        return self.data[start:end]


def floats(text: PaddedText, starts: Int64, ends: Int64) -> tuple[Float64, Int64]:
    """Tokens (N,), ascending, as float64 (N,), as Python's float() reads them; and indices of no numbers.

    Signs, missing digits on one side of the point, and exponents are allowed; words as "nan", and
    underscores, are not.
    """
    if not len(starts):
        return np.zeros(0), np.zeros(0, np.int64)
    first = text.bytes[starts]
    negative = first == ord("-")
    values = _uniform_floats(text, starts + negative, ends)
    rest = np.zeros(0, np.int64)
    if values is None:
        dot = _points(text, starts, ends)
        signed = negative | (first == ord("+"))
        values, rest = _mixed_floats(text, ends, dot, dot - starts - signed, np.maximum(ends - dot - 1, 0))
    np.copysign(values, 0.5 - negative, out=values)
    return values, _read_singly(text, starts, ends, values, rest)


def _uniform_floats(text: PaddedText, starts: Int64, ends: Int64) -> Float64 | None:
    """Numbers without signs that all have the same 1 to 8 decimals; None where any is not of that form."""
    count = int(ends[0]) - text.data.find(b".", int(starts[0]), int(ends[0])) - 1
    if not 1 <= count <= _AT_ONCE:
        return None
    dot = ends - (count + 1)
    whole_length = dot - starts
    if not 0 <= int(whole_length.min()) <= int(whole_length.max()) <= min(_AT_ONCE, 15 - count):
        return None
    whole, whole_wrong = _digits(text, dot, whole_length)
    fraction, fraction_wrong = _digits(text, ends, count)
    if bool((text.bytes[dot] != ord(".")).any()) or whole_wrong.any() or fraction_wrong.any():
        return None
    mantissa: Float64 = whole * _FLOAT_POWERS[count]
    mantissa += fraction
    mantissa /= _FLOAT_POWERS[count]
    return mantissa


def _mixed_floats(
    text: PaddedText, ends: Int64, dot: Int64, whole_length: Int64, decimals: Int64
) -> tuple[Float64, Int64]:
    """The sizes of numbers of any form, and the indices of those that must be read singly."""
    digits = whole_length + decimals
    fits = (whole_length >= 0) & (whole_length <= _AT_ONCE) & (decimals <= 16) & (digits > 0) & (digits <= 18)
    decimals = np.where(fits, decimals, 0)
    whole, wrong = _digits(text, dot, np.where(fits, whole_length, 0))
    behind, behind_wrong = _digits(text, ends, np.minimum(decimals, _AT_ONCE))
    mantissa = whole * _POWERS[decimals] + behind
    wrong |= behind_wrong
    long = np.flatnonzero(decimals > _AT_ONCE)
    if len(long):
        front, front_wrong = _digits(text, ends[long] - _AT_ONCE, decimals[long] - _AT_ONCE)
        mantissa[long] += front * _POWERS[_AT_ONCE]
        wrong[long] |= front_wrong
    fits &= ~wrong & (mantissa <= _EXACT)
    return mantissa / _FLOAT_POWERS[decimals], np.flatnonzero(~fits)


def integers(text: PaddedText, starts: Int64, ends: Int64) -> tuple[Int64, Int64]:
    """Tokens (N,) as int64 (N,), and the indices that are no whole numbers.

    What does not fit 62 bits comes out as the largest that does: no count in a file reaches it.
    """
    length = ends - starts
    first = text.bytes[starts]
    plain = len(starts) and 0 < int(length.min()) <= int(length.max()) <= _AT_ONCE
    # Digits are the bytes from "0" on; signs lie below them.
    if plain and int(first.min()) >= ord("0"):
        sizes, wrong = _digits(text, ends, length)
        if not wrong.any():
            return sizes.astype(np.int64), np.zeros(0, np.int64)
    negative = first == ord("-")
    length -= negative | (first == ord("+"))
    fits = (length > 0) & (length <= _AT_ONCE)
    sizes, wrong = _digits(text, ends, np.where(fits, length, 0))
    fits &= ~wrong
    values: Int64 = np.where(negative, -sizes, sizes).astype(np.int64)
    bad = []
    for i in np.flatnonzero(~fits):
        token = text.token(starts[i], ends[i])
        if _INTEGER.fullmatch(token) is None:
            bad.append(i)
            continue
        digits = token.lstrip(b"+-").lstrip(b"0") or b"0"
        size = int(digits) if len(digits) <= 18 else (1 << 62)
        values[i] = -size if negative[i] else size
    return values, np.array(bad, np.int64)


def _points(text: PaddedText, starts: Int64, ends: Int64) -> Int64:
    """Where the first "." of each token is, or the token's end where it has none; (N,)."""
    low = int(starts[0])
    places = np.flatnonzero(text.bytes[low : int(ends[-1])] == ord(".")) + low
    if not len(places):
        return ends
    if len(places) == len(starts) and bool(((places >= starts) & (places < ends)).all()):
        return places
    nearest = np.searchsorted(places, starts)
    found = places[np.minimum(nearest, len(places) - 1)]
    return np.where((found >= starts) & (found < ends), found, ends)


def _digits(text: PaddedText, ends: Int64, lengths: Int64 | int) -> tuple[Int32, _Bool]:
    """The numbers in the `lengths` (0 to 8) digits before `ends`; and where there was a non-digit."""
    most = int(np.max(lengths, initial=0))
    uneven = None if isinstance(lengths, int) else lengths.astype(np.uint8)
    highest = np.zeros(len(ends), np.uint8)
    before = ends - PAD
    columns: list[_Column] = []
    for i in range(1, most + 1):
        column = text.bytes[PAD - i :][before]
        column -= np.uint8(ord("0"))
        if uneven is not None:
            column *= uneven >= i
        np.maximum(highest, column, out=highest)
        columns.append(column)
    return _joined(columns or [highest]), highest > 9


def _joined(columns: list[_Column]) -> Int32:
    """The numbers whose digits are these columns, the last digits first."""
    for base, dtype in _JOINS:
        joined = columns[::2]
        for i, column in enumerate(columns[1::2]):
            high: _Column = column.astype(dtype)
            high *= base
            high += joined[i]
            joined[i] = high
        columns = joined
    return columns[0].astype(np.int32)


def _read_singly(text: PaddedText, starts: Int64, ends: Int64, values: Float64, which: Int64) -> Int64:
    """Fill `values` at `which` by Python's float(); returns those that are no numbers."""
    bad = []
    for i in which:
        token = text.token(starts[i], ends[i])
        # float() also takes "nan", "inf" and "1_000"; none of them has only these bytes.
        if len(token) > _LONGEST_NUMBER or token.translate(None, _NUMBER_BYTES):
            bad.append(i)
            continue
        try:
            values[i] = float(token)
        except ValueError:
            bad.append(i)
    return np.array(bad, np.int64)
