"""The rules of a face's correctives in its `face.toml`.

    [[correctives]]
    shape = "blink and look down"       the shape that is added
    product = ["eyeBlink", "eyeLookDown"]   shapes whose weights multiply
    hat = "jawOpen"                     and a hat over one shape's weight, with
    over = [0.0, 0.5, 1.0]              where it begins, is 1, and ends; these are what it has if left out

Either `product` or `hat` may be left out. See `core.correctives` for the formulas.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from facemorph.core.correctives import Corrective, Hat
from facemorph.errors import FaceFolderError
from facemorph.io.limits import SHAPES, shortened
from facemorph.io.toml_table import Table

KEY = "correctives"
KEYS: tuple[str, ...] = ("shape", "product", "hat", "over")
_MOST_FACTORS = 8
_USUAL: Mapping[int, float] = MappingProxyType({0: 0.0, 1: 0.5, 2: 1.0})


def read_correctives(table: Table) -> tuple[Corrective, ...]:
    """The rules that a face's table has. Raises `FaceFolderError` for one that is none."""
    return tuple(_rule(entry) for entry in table.tables(KEY, SHAPES))


def _rule(entry: Table) -> Corrective:
    shape = entry.text("shape")
    product = entry.texts("product", _MOST_FACTORS)
    if not entry.has("hat"):
        return Corrective(shape, product)
    feet = entry.numbers("over", 3) if entry.has("over") else tuple(_USUAL.values())
    if len(feet) != 3:
        raise FaceFolderError(
            f"{entry.path}: the hat of the corrective {shortened(shape)!r} needs three numbers in over: "
            f"where it begins, its peak, and its end; there are {len(feet)}."
        )
    return Corrective(shape, product, (Hat(entry.text("hat"), *feet),))
