"""What a picture of a face should show, in its `face.toml`.

    [frame]
    low = [-9.8, -14.6, -17.3]      the lowest and the highest corner of a box in model units: head and
    high = [9.8, 11.5, 4.8]         neck, say, where the mesh goes down to the shoulders

The first view, "Frame face", small pictures and `render` see the whole box from every side. What of it lies
beyond the neutral counts for nothing. A face without it is seen whole.
"""

from __future__ import annotations

from facemorph.core.arrays import Float32
from facemorph.core.rig import Box
from facemorph.errors import FaceFolderError
from facemorph.io.toml_table import Table

KEY = "frame"
KEYS: tuple[str, ...] = ("low", "high")


def read_frame(table: Table, bounds: Float32 | None) -> Box | None:
    """The frame that a face's table has, or None. `bounds` (2, 3) are the neutral's, where it is known.

    Raises `FaceFolderError` for one that is no box, or has nothing of the neutral in it.
    """
    if not table.has(KEY):
        return None
    entry = table.table(KEY)
    low, high = _corner(entry, "low"), _corner(entry, "high")
    if not all(a < b for a, b in zip(low, high, strict=True)):
        raise FaceFolderError(
            f"{entry.path}: every number of the frame's low must be below that of its high."
        )
    if bounds is not None and not all(
        a <= most and least <= b for a, b, least, most in zip(low, high, *bounds.tolist(), strict=True)
    ):
        box = " to ".join("({:g}, {:g}, {:g})".format(*corner) for corner in bounds.tolist())
        raise FaceFolderError(
            f"{entry.path}: the frame shows nothing of the neutral, which takes up {box}. "
            "Give it in the neutral's unit, or leave it out."
        )
    return low, high


def _corner(entry: Table, key: str) -> tuple[float, float, float]:
    numbers = entry.numbers(key, 3)
    if len(numbers) != 3:
        raise FaceFolderError(
            f"{entry.path}: the frame needs three numbers in {key}: x, y, z; there are {len(numbers)}."
        )
    return numbers[0], numbers[1], numbers[2]
