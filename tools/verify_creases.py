"""Check that no shape of the baked faces creases the skin: python tools/verify_creases.py [FOLDER].

For every expression, unit and ARKit shape at full strength, of every person: how many edges of the skin,
lids left out, fold over. Prints the worst, and exits 1 where one is over the limit. Correctives are left
out: they are no poses of their own.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from face_bake.creases import Creases
from verify_faces import PEOPLE, STATES, read_points, read_triangles, split_obj

# Of some 16,000 edges: what the lips' hidden inner rims and the throat below a wide open jaw come to.
MOST_FOLDS = 30
# Share of a vertex, of 255, that belongs to the lids from here on.
LIDS = 64
SHOWN = 12


def skin_triangles(tail: str) -> np.ndarray:
    start = tail.index("g skin\n")
    end = tail.find("\ng ", start)
    return read_triangles(tail[start : end if end > 0 else len(tail)])


def shapes(folder: Path, neutral: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Name and points (V, 3) of every shape of a person."""
    for state in STATES[1:]:
        yield state, read_points(split_obj((folder / f"{state}.obj").read_text(encoding="ascii"))[0])
    with np.load(folder / "shapes.npz", allow_pickle=False) as units:
        starts, index, delta = units["starts"], units["index"].astype(int), units["delta"]
        for k, name in enumerate(units["names"].tolist()):
            if units["sets"][k] not in ("facs", "arkit"):
                continue
            points = neutral.copy()
            own = slice(starts[k], starts[k + 1])
            points[index[own]] += delta[own] * float(units["scale"][k])
            yield name, points


def folds_of(folder: Path) -> dict[str, int]:
    """Folded edges of every shape."""
    text, tail = split_obj((folder / "neutral.obj").read_text(encoding="ascii"))
    neutral, triangles = read_points(text), skin_triangles(tail)
    with np.load(folder / "shapes.npz", allow_pickle=False) as units:
        lids = units["region_weights"][units["region_names"].tolist().index("eyes")]
    creases = Creases(neutral, triangles[(lids[triangles] < LIDS).all(1)])
    return {name: creases.folds(points) for name, points in shapes(folder, neutral)}


def main() -> int:
    parser = argparse.ArgumentParser(description="Check baked faces for creases.")
    parser.add_argument("folder", type=Path, nargs="?", default=Path("assets/faces"))
    parser.add_argument("--people", default=",".join(PEOPLE), help="comma-separated names, default all six")
    arguments = parser.parse_args()
    people = arguments.people.split(",")
    found = [
        (n, person, shape) for person in people for shape, n in folds_of(arguments.folder / person).items()
    ]
    found.sort(reverse=True)
    for count, person, shape in found[:SHOWN]:
        print(f"{count:5}  {person:5} {shape}")
    bad = sum(count > MOST_FOLDS for count, _, _ in found)
    print(f"{len(found)} shapes, {sum(n for n, _, _ in found)} folded edges, {bad} over {MOST_FOLDS}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
