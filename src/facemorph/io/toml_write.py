"""Texts, numbers, arrays and tables of these, and arrays of tables as TOML; other values are left out."""

from __future__ import annotations

import json
import math
import numbers
import re
from collections.abc import Iterator, Mapping
from typing import Any


def toml_text(values: Mapping[str, Any]) -> str:
    """A TOML file that says `values`."""
    lines = list(_pairs(values))
    for key, tables in values.items():
        if isinstance(tables, list):
            for table in tables:
                if isinstance(table, dict):
                    lines += ["", f"[[{_key(key)}]]", *_pairs(table)]
    return "\n".join(lines) + "\n"


def _pairs(values: Mapping[str, Any]) -> Iterator[str]:
    for key, value in values.items():
        text = _value(value)
        if text is not None:
            yield f"{_key(key)} = {text}"


def _value(value: Any) -> str | None:
    """One value in TOML's words, None for what has none here."""
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, numbers.Integral):
        return repr(int(value))
    # Those of arrays are told with the digits that they have.
    if isinstance(value, numbers.Real) and math.isfinite(value):
        return repr(float(str(value)))
    if isinstance(value, dict):
        return f"{{ {', '.join(_pairs(value))} }}"
    if isinstance(value, list) and not any(isinstance(part, dict) for part in value):
        parts = [_value(part) for part in value]
        return None if None in parts else f"[{', '.join(part for part in parts if part)}]"
    return None


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _text(key)


def _text(text: str) -> str:
    """A quoted text: TOML's basic strings are JSON's, but for DEL, which must be escaped.

    What is no letter (half a pair of UTF-16, as in file names of another encoding) becomes a "?".
    """
    plain = text.encode("utf-8", "replace").decode("utf-8")
    return json.dumps(plain, ensure_ascii=False).replace("\x7f", "\\u007f")
