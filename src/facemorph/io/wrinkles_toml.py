"""The wrinkles of a face in its `face.toml`, which its shapes fade in.

    [[wrinkles]]
    name = "crow's feet, left"
    set = "green"                       the channel of the picture that map_wrinkles names in the MTL
    area = [0.55, 0.5, 0.8, 0.7]        u0, v0, u1, v1 of the texture, v up
    soft = 0.04                         how wide the area's border is; so it is if left out
    rest = 0.1                          what shows of it in the neutral face; 0 if left out
    shapes = { AU6 = 1.0, cheekSquintLeft = 0.8 }

Shapes that the face has not are passed over, so that one table serves faces with some sets of shapes.
`core.wrinkles` has the formulas.
"""

from __future__ import annotations

from facemorph.core.wrinkles import MOST_WRINKLES, Wrinkle
from facemorph.errors import FaceFolderError
from facemorph.io.limits import SHAPES, shortened
from facemorph.io.toml_table import Table

KEY = "wrinkles"
KEYS: tuple[str, ...] = ("name", "set", "area", "soft", "rest", "shapes")
_USUAL_SOFT = 0.04


def read_wrinkles(table: Table) -> tuple[Wrinkle, ...]:
    """The wrinkles that a face's table has. Raises `FaceFolderError` for one that is none."""
    return tuple(_wrinkle(entry) for entry in table.tables(KEY, MOST_WRINKLES))


def _wrinkle(entry: Table) -> Wrinkle:
    name = entry.text("name")
    area = entry.numbers("area", 4)
    if len(area) != 4:
        raise FaceFolderError(
            f"{entry.path}: the area of the wrinkle {shortened(name)!r} needs four numbers: u0, v0, u1, v1; "
            f"there are {len(area)}."
        )
    return Wrinkle(
        name,
        entry.text("set"),
        (area[0], area[1], area[2], area[3]),
        entry.decimal("soft", _USUAL_SOFT),
        entry.decimal("rest", 0.0),
        entry.weights("shapes", SHAPES),
    )
