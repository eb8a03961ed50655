"""What may be wrong with one mesh, whatever it is a shape of."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from facemorph.core.arrays import Float64, Int32, Int64
from facemorph.core.mesh import Mesh
from facemorph.core.triangles import Triangles, triangulated

# A triangle counts as degenerate when its height is less than this part of its longest side.
_THIN = 1e-5


def mesh_findings(mesh: Mesh) -> Iterator[tuple[str, str]]:
    """Kind and message of each thing that looks wrong with a neutral."""
    unused = np.setdiff1d(np.arange(mesh.vertex_count), mesh.corner_vertices)
    if len(unused):
        yield "stray-vertices", f"{_belong(len(unused))} to no polygon: {vertex_numbers(unused)}."
    flat = _degenerate_polygons(mesh)
    if len(flat):
        yield "degenerate", f"{_polygons(len(flat))} without area: {polygon_numbers(flat)}."
    turned = _unlike_neighbours(mesh)
    if len(turned):
        a, b = (int(p) + 1 for p in turned[0])
        yield (
            "winding",
            f"neighbouring polygons face opposite ways along {len(turned):,} edge{'s' * (len(turned) > 1)}, "
            f"as {a} and {b} (counted from 1). Make the normals consistent in your modelling program.",
        )


def triangle_areas(positions: Float64, triangles: Int32) -> Float64:
    """The area vectors (T, 3) of triangles: along the normal, twice the area long."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    areas: Float64 = np.cross(b - a, c - a)
    return areas


def vertex_numbers(index: Int64) -> str:
    """Vertices for a message, counted as an OBJ does, and that this is not how `face.toml` does."""
    return f"{_numbers(index)} (counted from 1, as in an OBJ; face.toml counts from 0)"


def polygon_numbers(index: Int64) -> str:
    """Polygons for a message, counted from 1."""
    return f"{_numbers(index)} (counted from 1)"


def _numbers(index: Int64, most: int = 5) -> str:
    """Indices from 1: 3, 8, 9 and 12 more. Without commas in thousands, which would look like the list's."""
    shown = ", ".join(str(i + 1) for i in index[:most].tolist())
    return f"{shown} and {len(index) - most} more" if len(index) > most else shown


def _degenerate_polygons(mesh: Mesh) -> Int64:
    """Polygons without area, or that have a vertex twice in a row."""
    triangles = triangulated(mesh)
    thin = _thin(mesh.positions.astype(np.float64), triangles)
    # A polygon with one thin triangle among others is well; one of nothing else is not.
    whole = np.bincount(triangles.polygon, ~thin, mesh.polygon_count) == 0
    return np.flatnonzero(whole)


def _thin(positions: Float64, triangles: Triangles) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    corners = positions[triangles.vertices]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    double = np.linalg.norm(triangle_areas(positions, triangles.vertices), axis=1)
    thin: np.ndarray[tuple[int], np.dtype[np.bool_]] = double <= _THIN * sides**2
    return thin


def _unlike_neighbours(mesh: Mesh) -> Int64:
    """Pairs (n, 2) of polygons, the only two at an edge, that go along it in the same direction."""
    sizes = np.diff(mesh.polygon_starts).astype(np.int64)
    first = np.repeat(mesh.polygon_starts[:-1].astype(np.int64), sizes)
    corner = np.arange(len(mesh.corner_vertices))
    after = first + (corner - first + 1) % np.repeat(sizes, sizes)
    start, end = mesh.corner_vertices.astype(np.int64), mesh.corner_vertices[after].astype(np.int64)
    edge = np.minimum(start, end) * mesh.vertex_count + np.maximum(start, end)
    order = np.argsort(edge, kind="stable")
    edge, forward = edge[order], (start < end)[order]
    polygon = np.repeat(np.arange(len(sizes)), sizes)[order]
    begins = np.flatnonzero(np.diff(edge, prepend=-1))
    pairs = begins[np.diff(begins, append=len(edge)) == 2]
    same = pairs[(forward[pairs] == forward[pairs + 1]) & (polygon[pairs] != polygon[pairs + 1])]
    return np.stack([polygon[same], polygon[same + 1]], axis=1)


def _belong(count: int) -> str:
    return "1 vertex belongs" if count == 1 else f"{count:,} vertices belong"


def _polygons(count: int) -> str:
    return "1 polygon" if count == 1 else f"{count:,} polygons"
