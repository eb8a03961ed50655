"""Texts, numbers, arrays and tables of these, and arrays of tables as TOML; other values are left out."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any


def toml_text(values: Mapping[str, Any]) -> str:
    """A TOML file that says `values`."""
    lines = list(_pairs(values))
    for key, tables in values.items():
        if isinstance(tables, list):
            for table in tables:
                if isinstance(table, dict):
                    lines += ["", f"[[{_text(key)}]]", *_pairs(table)]
    return "\n".join(lines) + "\n"


def _pairs(values: Mapping[str, Any]) -> Iterator[str]:
    for key, value in values.items():
        text = _value(value)
        if text is not None:
            yield f"{_text(key)} = {text}"


def _value(value: Any) -> str | None:
    """One value in TOML's words, None for what has none here."""
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) or (isinstance(value, float) and math.isfinite(value)):
        return repr(value)
    if isinstance(value, dict):
        return f"{{ {', '.join(_pairs(value))} }}"
    if isinstance(value, list) and not any(isinstance(part, dict) for part in value):
        parts = [_value(part) for part in value]
        return None if None in parts else f"[{', '.join(part for part in parts if part)}]"
    return None


def _text(text: str) -> str:
    """A quoted text: TOML's basic strings are JSON's, but for DEL, which must be escaped."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
