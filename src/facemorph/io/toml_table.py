"""A TOML file from outside, asked for values by key and kind."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

from facemorph.errors import FaceFolderError, MeshFileError
from facemorph.io.limits import NAME_BYTES, TOML_BYTES, read_bytes, shortened

_T = TypeVar("_T")
_LARGEST = 1e9


def read_table(path: Path) -> Table:
    """The whole of a TOML file. Raises `FaceFolderError`."""
    return Table(path, _parsed(path))


class Table:
    """A table of a TOML file whose values are asked for by key and type."""

    def __init__(self, path: Path, values: Any, where: str = "") -> None:
        if not isinstance(values, dict):
            raise FaceFolderError(f"{path}: {where.removesuffix(': ')} must be a table.")
        self.path, self._values, self._where = path, values, where

    def values(self) -> dict[str, Any]:
        """All there is, by key."""
        return dict(self._values)

    def unknown(self, known: Sequence[str]) -> tuple[str, ...]:
        """The keys that are there and not among the known ones."""
        return tuple(key for key in self._values if key not in known)

    def has(self, key: str) -> bool:
        """Whether the key is there."""
        return key in self._values

    def text(self, key: str, otherwise: str | None = None) -> str:
        """A text; where it is not there, `otherwise`, or an error where that is None."""
        value = self._of(str, key, otherwise)
        if len(value.encode("utf-8", "replace")) > NAME_BYTES * 4:
            raise FaceFolderError(f"{self.path}: {self._where}{key} is longer than {NAME_BYTES * 4:,} bytes.")
        return value

    def number(self, key: str) -> int:
        """A whole number that must be there."""
        return self._of(int, key, None)

    def decimal(self, key: str, otherwise: float) -> float:
        """A finite number; where it is not there, `otherwise`."""
        return self._finite(key, self._values.get(key, otherwise))

    def weights(self, key: str, most: int) -> dict[str, float]:
        """A table of finite numbers by name; none where it is not there."""
        values = self._values.get(key, {})
        if not isinstance(values, dict):
            raise FaceFolderError(f"{self.path}: {self._where}{key} must be a table of numbers.")
        if len(values) > most:
            raise FaceFolderError(
                f"{self.path}: {self._where}{key} has {len(values):,} entries; {most} at most."
            )
        return {name: self._finite(f"{key}.{shortened(name)}", value) for name, value in values.items()}

    def _finite(self, key: str, value: Any) -> float:
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        # Bounds first: they hold off infinity, and integers too large for a float.
        if not plain or not -_LARGEST <= value <= _LARGEST:
            raise FaceFolderError(
                f"{self.path}: {self._where}{key} must be a number, not {shortened(repr(value))}."
            )
        return float(value)

    def texts(self, key: str, most: int) -> tuple[str, ...]:
        """An array of texts; none where it is not there."""
        values = self._list(key, most)
        if not all(isinstance(value, str) for value in values):
            raise FaceFolderError(f"{self.path}: {self._where}{key} must be an array of texts.")
        return tuple(str(value) for value in values)

    def numbers(self, key: str, most: int) -> tuple[float, ...]:
        """An array of finite numbers; none where it is not there."""
        values = self._list(key, most)
        plain = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
        # Bounds first and alone: they hold off infinity, and integers too large for a float.
        if not plain or not all(-_LARGEST <= value <= _LARGEST for value in values):
            raise FaceFolderError(f"{self.path}: {self._where}{key} must be an array of numbers.")
        return tuple(float(value) for value in values)

    def _list(self, key: str, most: int) -> list[Any]:
        values = self._values.get(key, [])
        if not isinstance(values, list):
            raise FaceFolderError(f"{self.path}: {self._where}{key} must be an array.")
        if len(values) > most:
            raise FaceFolderError(
                f"{self.path}: {self._where}{key} has {len(values):,} entries; {most} at most."
            )
        return values

    def table(self, key: str) -> Table:
        """The table that is there, or an empty one."""
        return Table(self.path, self._values.get(key, {}), f"{self._where}{key}: ")

    def tables(self, key: str, most: int) -> list[Table]:
        """The tables of an array; none where it is not there."""
        values = self._of(list, key, [])
        if len(values) > most:
            raise FaceFolderError(f"{self.path}: more than {most:,} {key}.")
        return [Table(self.path, v, f"{key} {i + 1}: ") for i, v in enumerate(values)]

    def _of(self, kind: type[_T], key: str, otherwise: _T | None) -> _T:
        value = self._values.get(key, otherwise)
        if value is None:
            raise FaceFolderError(f"{self.path}: {self._where}{key} is missing.")
        if not isinstance(value, kind) or isinstance(value, bool):
            wanted = {str: "a text", int: "a whole number", list: "an array of tables"}[kind]
            raise FaceFolderError(
                f"{self.path}: {self._where}{key} must be {wanted}, not {shortened(repr(value))}."
            )
        return value


def _parsed(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(read_bytes(path, TOML_BYTES).decode("utf-8"))
    except MeshFileError as error:
        raise FaceFolderError(str(error)) from error
    except (ValueError, RecursionError) as error:
        raise FaceFolderError(f"{path} is not TOML: {shortened(str(error), 120)}.") from error
