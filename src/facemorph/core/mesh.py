"""`Mesh`: a surface as its file had it.

Positions stay in the file's order and number; polygons stay polygons (a quad stays a quad); texture
coordinates have an index of their own. What a graphics card needs (triangles, vertices split at
texture seams) is derived in `core.triangles` and `core.split`, with a map back to the positions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.errors import MeshDataError


@dataclass(frozen=True)
class Material:
    """How a part of the surface looks; colours are linear factors 0..1, the texture is sRGB.

    `texture` is a file inside the face's folder, or None; `texture_lost` where one was named that is not
    there, so that `diffuse`, a factor on it, says little.

    bump       a picture of the surface's heights in grey, or of its normals in the tangents' space
    roughness  a picture of how rough it is: 0 a mirror, 1 without any highlight
    wrinkles   heights of three sets of wrinkles, one a channel; the middle grey is the surface
    The `_height`s are model units from black to white; None where the file does not say.
    """

    name: str
    diffuse: tuple[float, float, float] = (0.8, 0.8, 0.8)
    specular: tuple[float, float, float] = (0.0, 0.0, 0.0)
    shininess: float = 10.0
    opacity: float = 1.0
    texture: Path | None = None
    texture_lost: bool = False
    bump: Path | None = None
    bump_height: float | None = None
    roughness: Path | None = None
    wrinkles: Path | None = None
    wrinkle_height: float | None = None

    @property
    def pictures(self) -> tuple[Path, ...]:
        """Every picture that it names, the texture first."""
        named = (self.texture, self.bump, self.roughness, self.wrinkles)
        return tuple(dict.fromkeys(path for path in named if path is not None))


@dataclass(frozen=True)
class Labels:
    """A name for each polygon: `names[index[p]]`, or none where `index[p]` is -1. `index` is (P,) int32."""

    names: tuple[str, ...]
    index: Int32

    @classmethod
    def none(cls, polygon_count: int) -> Labels:
        """No polygon has a name."""
        return cls((), np.full(polygon_count, -1, np.int32))


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """A polygon mesh in file order.

    positions        (V, 3) float32, model units
    polygon_starts   (P + 1,) int32; polygon p has the corners polygon_starts[p]:polygon_starts[p + 1]
    corner_vertices  (C,) int32, a position for each corner
    uvs              (U, 2) float32, v up, and corner_uvs (C,) int32, -1 where a corner has none
    normals          (N, 3) float32 as the file had them, and corner_normals (C,) int32, -1 for none;
                     kept for writing and for checks, never used for drawing a morphed surface
    colours          (V, 3) float32 0..1, or None
    groups, objects, materials_used   a name for each polygon
    materials        what is known of each name in materials_used
    notes            what of the file could not be taken (a missing material file, morph targets), a line each
    """

    positions: Float32
    polygon_starts: Int32
    corner_vertices: Int32
    uvs: Float32 = field(default_factory=lambda: np.zeros((0, 2), np.float32))
    corner_uvs: Int32 | None = None
    normals: Float32 = field(default_factory=lambda: np.zeros((0, 3), np.float32))
    corner_normals: Int32 | None = None
    colours: Float32 | None = None
    groups: Labels | None = None
    objects: Labels | None = None
    materials_used: Labels | None = None
    materials: Mapping[str, Material] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Mesh: {self.vertex_count:,} vertices, {self.polygon_count:,} polygons>"

    def __post_init__(self) -> None:
        if self.positions.ndim != 2 or self.positions.shape[1] != 3:
            raise MeshDataError(f"positions must be (V, 3), not {self.positions.shape}.")
        if self.polygon_starts.size and int(self.polygon_starts[-1]) != len(self.corner_vertices):
            raise MeshDataError("the last polygon start must equal the number of corners.")
        if len(self.corner_vertices):
            low, high = int(self.corner_vertices.min()), int(self.corner_vertices.max())
            if low < 0 or high >= len(self.positions):
                raise MeshDataError(
                    f"corners name vertices {low} to {high}, but there are {len(self.positions)}."
                )

    @classmethod
    def from_triangles(cls, positions: Float32, triangles: Int32) -> Mesh:
        """A bare mesh from positions (V, 3) and triangles (T, 3)."""
        return cls.from_polygons(positions, np.asarray(triangles))

    @classmethod
    def from_polygons(cls, positions: Float32, polygons: Int32) -> Mesh:
        """A bare mesh from positions (V, 3) and polygons (P, n) that all have n corners."""
        corners = np.ascontiguousarray(polygons, np.int32)
        count, size = corners.shape
        starts = np.arange(0, count * size + 1, size, dtype=np.int32)
        return cls(np.ascontiguousarray(positions, np.float32), starts, corners.ravel())

    @property
    def vertex_count(self) -> int:
        """V, the number of positions."""
        return len(self.positions)

    @property
    def polygon_count(self) -> int:
        """P, the number of polygons."""
        return max(len(self.polygon_starts) - 1, 0)

    @cached_property
    def bounds(self) -> Float32:
        """The lowest and the highest corner of the box around all positions, (2, 3)."""
        if not len(self.positions):
            return np.zeros((2, 3), np.float32)
        return np.stack([self.positions.min(axis=0), self.positions.max(axis=0)])

    @cached_property
    def diagonal(self) -> float:
        """Length of the box's diagonal in model units; errors are told in percent of it."""
        low, high = self.bounds.astype(np.float64)
        return float(np.linalg.norm(high - low))

    def with_positions(self, positions: Float32) -> Mesh:
        """The same surface with other positions (V, 3); raises `MeshDataError` on another count."""
        if positions.shape != self.positions.shape:
            raise MeshDataError(f"positions must be {self.positions.shape}, not {positions.shape}.")
        return replace(self, positions=np.ascontiguousarray(positions, np.float32))
