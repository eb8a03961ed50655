"""Plain values as TOML: texts, numbers, and arrays of tables of these; others are left out."""

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
        if isinstance(value, str):
            yield f"{_text(key)} = {_text(value)}"
        elif isinstance(value, bool):
            yield f"{_text(key)} = {str(value).lower()}"
        elif isinstance(value, int) or (isinstance(value, float) and math.isfinite(value)):
            yield f"{_text(key)} = {value!r}"


def _text(text: str) -> str:
    """A quoted text: TOML's basic strings are JSON's, but for DEL, which must be escaped."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
