"""What a part of the head is: its groups in the file, and where its vertices are for any shape.

A new part is a class with these members and a line in `Head._make_parts`.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

from .polygons import NONE, shifted, triangles_of

if TYPE_CHECKING:
    from .head import Body


@dataclass(frozen=True)
class PartGroup:
    """A group of a part: polygons, uv_polygons (m, 4) count from the part's first vertex and uv."""

    name: str
    material: str
    polygons: np.ndarray
    uv_polygons: np.ndarray

    @classmethod
    def of_one_uv(cls, name: str, material: str, polygons: np.ndarray) -> "PartGroup":
        """A group without a picture: every corner has the part's first texture coordinate."""
        return cls(name, material, polygons, np.where(polygons == NONE, NONE, 0))


@dataclass(frozen=True)
class Posed:
    """A person in a shape; shape, neutral: (19158, 3) in base-mesh space."""

    body: "Body"
    shape: np.ndarray

    @property
    def neutral(self) -> np.ndarray:
        return self.body.neutral

    @cached_property
    def skin(self) -> np.ndarray:
        """All fine skin vertices."""
        return self.body.fine_skin(self.shape)


class Part(Protocol):
    """groups: over one list of vertices; uv: (t, 2) of all of them."""

    groups: list[PartGroup]
    uv: np.ndarray

    def place(self, posed: Posed) -> np.ndarray:
        """Every vertex (n, 3) in base-mesh space."""


@dataclass(frozen=True)
class Group:
    """A group of the file: polygons, uv_polygons (m, 4) are indices into the whole file.

    first, count: the vertices of its part, which groups of one part share.
    """

    name: str
    material: str
    polygons: np.ndarray
    uv_polygons: np.ndarray
    first: int
    count: int

    @property
    def own_triangles(self) -> np.ndarray:
        """Triangles (t, 3) counted from the part's first vertex."""
        return triangles_of(self.polygons) - self.first


def stacked(parts: list[Part]) -> tuple[list[Group], np.ndarray]:
    """Groups over one list of vertices and one of texture coordinates."""
    groups, uvs, first, first_uv = [], [], 0, 0
    for part in parts:
        count = max(int(group.polygons.max()) for group in part.groups) + 1
        for group in part.groups:
            moved = shifted(group.polygons, first), shifted(group.uv_polygons, first_uv)
            groups.append(Group(group.name, group.material, *moved, first, count))
        uvs.append(part.uv)
        first, first_uv = first + count, first_uv + len(part.uv)
    return groups, np.concatenate(uvs)
