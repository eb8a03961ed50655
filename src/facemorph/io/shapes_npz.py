"""`shapes.npz`: many shapes in little room, each as the few vertices that it moves, in 16-bit steps.

format          int32, 1
vertices        int32, V
names, labels, sets   (K,) text
starts          (K + 1,) int; shape k has the entries starts[k]:starts[k + 1]
index           (N,) int, the vertex of each entry
delta           (N, 3) int16, and scale (K,) float32: the vertex moves by delta * scale[k]
region_names    (R,) text, and region_weights (R, V) uint8; both may be left out
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.rig import Regions, Shape
from facemorph.errors import FaceFolderError
from facemorph.io.face_set import check_size
from facemorph.io.limits import SHAPES
from facemorph.io.npz import Arrays, NpzError, read_npz, table, texts, whole

FORMAT = 1
_REGIONS = 1_024
_NEEDED = ("format", "vertices", "names", "labels", "sets", "starts", "index", "delta", "scale")
_OPTIONAL = ("region_names", "region_weights")


@dataclass(frozen=True, eq=False)
class MoreShapes:
    """K shapes, their deltas (K, V, 3) after those asked for, and soft regions where the file has them."""

    shapes: tuple[Shape, ...]
    deltas: Float32
    regions: Regions | None


def read_shapes(path: Path, vertex_count: int, after: Float32 | None = None) -> MoreShapes:
    """The shapes in `path` for a neutral of `vertex_count` vertices. Raises `FaceFolderError`.

    after   deltas of other shapes, which come before those of `path` in the result's: joined later, all
            would lie in memory twice
    """
    try:
        arrays = read_npz(path, _NEEDED, _OPTIONAL)
        version, vertices = whole(arrays, "format"), whole(arrays, "vertices")
        if version != FORMAT:
            raise NpzError(f"is of format {version}; this version of facemorph reads {FORMAT}")
        if vertices != vertex_count:
            raise NpzError(f"is made for {vertices:,} vertices; the neutral has {vertex_count:,}")
        shapes = _shapes(arrays)
        before = np.empty((0, vertices, 3), np.float32) if after is None else after
        check_size(len(before) + len(shapes), vertices)
        return MoreShapes(shapes, _deltas(arrays, len(shapes), before), _regions(arrays, vertices))
    except NpzError as error:
        raise FaceFolderError(f"{path} {error}.") from error


def _shapes(arrays: Arrays) -> tuple[Shape, ...]:
    names, labels, sets = (texts(arrays, name, SHAPES) for name in ("names", "labels", "sets"))
    if not len(names) == len(labels) == len(sets):
        raise NpzError(f"has {len(names)} names, {len(labels)} labels and {len(sets)} sets")
    return tuple(Shape(*three) for three in zip(names, labels, sets, strict=True))


def _deltas(arrays: Arrays, k: int, before: Float32) -> Float32:
    """Those of `before`, then of the file's k shapes."""
    first, vertices = before.shape[:2]
    starts = table(arrays, "starts", "iu", (k + 1,)).astype(np.int64)
    index = table(arrays, "index", "iu", (None,))
    delta = table(arrays, "delta", "i", (len(index), 3))
    scale = table(arrays, "scale", "f", (k,)).astype(np.float32)
    if int(starts[0]) != 0 or int(starts[-1]) != len(index) or bool((np.diff(starts) < 0).any()):
        raise NpzError(f"has starts that do not rise from 0 to {len(index):,}")
    if len(index) and not 0 <= int(index.min()) <= int(index.max()) < vertices:
        raise NpzError(f"moves vertices outside of 0 to {vertices - 1:,}")
    if delta.dtype.itemsize > 2 or not bool(np.isfinite(scale * np.float32(1 << 15)).all()):
        raise NpzError("has deltas that are not int16, or a scale that is not finite")
    # Of zeros that stay so, which are most, the system keeps no memory.
    deltas = np.zeros((first + k, vertices, 3), np.float32)
    deltas[:first] = before
    for shape in range(k):
        part = slice(int(starts[shape]), int(starts[shape + 1]))
        deltas[first + shape, index[part]] = delta[part] * scale[shape]
    return deltas


def _regions(arrays: Arrays, vertices: int) -> Regions | None:
    if not all(name in arrays for name in _OPTIONAL):
        return None
    names = texts(arrays, "region_names", _REGIONS)
    weights = table(arrays, "region_weights", "u", (len(names), vertices))
    if weights.dtype != np.uint8 or bool((weights.sum(axis=0, dtype=np.int64) > 255).any()):
        raise NpzError("has region_weights that are not uint8, or more than 255 summed over the regions")
    return Regions(names, weights)
