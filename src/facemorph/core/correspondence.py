"""Whether a shape's vertices are the neutral's, and if not, why, in words a person can act on.

A shape corresponds when it has as many vertices and the same polygons over them. In what order the
polygons stand, and with which corner each begins, does not matter: only the shape's positions are used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Int32
from facemorph.core.mesh import Mesh
from facemorph.core.reorder import same_polygons, vertex_order

_SHOWN_CORNERS = 8


@dataclass(frozen=True)
class Difference:
    """Why a mesh does not correspond.

    cause    "vertices" (another number of them), "polygons" (the same number, other polygons) or "order"
             (the same surface, its vertices in another order, which can be repaired)
    problem  in words
    """

    cause: str
    problem: str


def difference(neutral: Mesh, mesh: Mesh) -> Difference | None:
    """How `mesh` fails to correspond to `neutral`, or None where it does."""
    if mesh.vertex_count != neutral.vertex_count:
        return Difference(
            "vertices", f"it has {mesh.vertex_count:,} vertices, the neutral {neutral.vertex_count:,}."
        )
    if same_polygons(neutral, mesh):
        return None
    if vertex_order(neutral, mesh) is not None:
        return Difference("order", "it is the same surface with its vertices in another order.")
    return Difference("polygons", _first_difference(neutral, mesh))


def _first_difference(neutral: Mesh, mesh: Mesh) -> str:
    """Where the polygons first differ, and what each has there; counted from 1, as in an OBJ."""
    counts = ""
    if mesh.polygon_count != neutral.polygon_count:
        counts = f"it has {mesh.polygon_count:,} polygons, the neutral {neutral.polygon_count:,}; "
    common = min(mesh.polygon_count, neutral.polygon_count)
    first = _first_unlike(neutral, mesh, common)
    if first is None:
        return f"{counts}those that both have are the same."
    mine, theirs = _ring(mesh, first), _ring(neutral, first)
    if sorted(mine.tolist()) == sorted(theirs.tolist()) and not counts and _is_turned_over(mine, theirs):
        return f"polygon {first + 1:,} ({_words(mine)}) is turned over; the neutral has {_words(theirs)}."
    return f"{counts}polygon {first + 1:,} is {_words(mine)}, the neutral's {_words(theirs)}."


def _first_unlike(neutral: Mesh, mesh: Mesh, common: int) -> int | None:
    """The first polygon, of those that both have, that is not the same."""
    sizes = np.diff(neutral.polygon_starts)[:common] != np.diff(mesh.polygon_starts)[:common]
    first = int(np.argmax(sizes)) if sizes.any() else common
    end = int(neutral.polygon_starts[first])
    corners = np.flatnonzero(neutral.corner_vertices[:end] != mesh.corner_vertices[:end])
    if len(corners):
        return int(np.searchsorted(neutral.polygon_starts, corners[0], side="right")) - 1
    return first if first < common else None


def _ring(mesh: Mesh, polygon: int) -> Int32:
    return mesh.corner_vertices[mesh.polygon_starts[polygon] : mesh.polygon_starts[polygon + 1]]


def _is_turned_over(ring: Int32, other: Int32) -> bool:
    reversed_ring = ring[::-1]
    # A polygon may have a vertex twice, but a handful of beginnings to try is enough for a message.
    begins = np.flatnonzero(reversed_ring == other[0])[:8].tolist()
    return any(np.array_equal(np.roll(reversed_ring, -k), other) for k in begins)


def _words(ring: Int32) -> str:
    shown = " ".join(str(v + 1) for v in ring[:_SHOWN_CORNERS].tolist())
    return f"{shown} … ({len(ring):,} corners)" if len(ring) > _SHOWN_CORNERS else shown
