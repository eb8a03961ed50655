"""`shapes.npz`: many shapes in little room, each as the few vertices that it moves, in 16-bit steps.

    format          int32, 1
    vertices        int32, V
    names, labels, sets   (K,) text
    starts          (K + 1,) int; shape k has the entries starts[k]:starts[k + 1]
    index           (N,) int, the vertex of each entry
    delta           (N, 3) int16, and scale (K,) float32: the vertex moves by delta * scale[k]
    region_names    (R,) text, and region_weights (R, V) uint8; both may be left out

A zip from outside can claim any size, so each array's own header is read and its size checked before any
of its data; nothing is unpickled.
"""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, cast

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from facemorph.core.arrays import Float32
from facemorph.core.rig import Regions, Shape
from facemorph.errors import FaceFolderError
from facemorph.io.limits import NAME_BYTES, SHAPES, plain_size, reason

_ARRAY_BYTES = 512 << 20
_REGIONS = 1_024
_NEEDED = ("format", "vertices", "names", "labels", "sets", "starts", "index", "delta", "scale")
_REGION_ARRAYS = ("region_names", "region_weights")
_HEADER_BYTES = 10_000


@dataclass(frozen=True, eq=False)
class MoreShapes:
    """K shapes, their deltas (K, V, 3), and the face's soft regions where the file has them."""

    shapes: tuple[Shape, ...]
    deltas: Float32
    regions: Regions | None


def read_shapes(path: Path, vertex_count: int) -> MoreShapes:
    """The shapes in `path` for a neutral of `vertex_count` vertices. Raises `FaceFolderError`."""
    arrays = _arrays(path)
    try:
        return _checked(arrays, vertex_count)
    except (_NotShapesError, OverflowError) as error:
        raise FaceFolderError(f"{path}: {error}.") from error


class _NotShapesError(Exception):
    """What is wrong with the arrays."""


def _arrays(path: Path) -> dict[str, NDArray[Any]]:
    try:
        with zipfile.ZipFile(path) as archive:
            members = {info.filename: info for info in archive.infolist()}
            missing = [name for name in _NEEDED if f"{name}.npy" not in members]
            if missing:
                raise _NotShapesError(f"the array {missing[0]!r} is missing")
            wanted = [name for name in (*_NEEDED, *_REGION_ARRAYS) if f"{name}.npy" in members]
            result = {}
            for name in wanted:
                with archive.open(members[f"{name}.npy"]) as file:
                    result[name] = _array(cast(BinaryIO, file), name)
            return result
    except (
        _NotShapesError,
        zipfile.BadZipFile,
        zlib.error,
        OSError,
        ValueError,
        EOFError,
        NotImplementedError,
        RuntimeError,
    ) as error:
        raise FaceFolderError(f"{path} cannot be read as shapes: {reason(error)}.") from error


def _array(file: BinaryIO, name: str) -> NDArray[Any]:
    """One array, read only when its header says that it is of a plain kind and not too large."""
    version = npy.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise _NotShapesError(f"the array {name!r} is of npy version {version}")
    read_header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, fortran, dtype = read_header(file, max_header_size=_HEADER_BYTES)
    if dtype.kind not in "iufU" or dtype.itemsize > 4 * NAME_BYTES:
        raise _NotShapesError(f"the array {name!r} is of type {dtype}")
    count = 1
    for side in shape:
        count *= side
    size = count * dtype.itemsize
    if size > _ARRAY_BYTES or any(side < 0 for side in shape):
        raise _NotShapesError(
            f"the array {name!r} claims {plain_size(size)}, more than {plain_size(_ARRAY_BYTES)}"
        )
    data = file.read(size)
    if len(data) != size or (fortran and len(shape) > 1):
        raise _NotShapesError(f"the array {name!r} ends early or lies in another order than expected")
    return np.frombuffer(data, dtype).reshape(shape)


def _checked(arrays: Mapping[str, NDArray[Any]], vertex_count: int) -> MoreShapes:
    """The arrays as shapes, every number in them checked. Raises `_NotShapesError`."""
    version, vertices = _whole(arrays, "format"), _whole(arrays, "vertices")
    if version != 1:
        raise _NotShapesError(f"format {version}; this version of facemorph reads 1")
    if vertices != vertex_count:
        raise _NotShapesError(f"made for {vertices:,} vertices; the neutral has {vertex_count:,}")
    names = _texts(arrays, "names", SHAPES)
    k = len(names)
    labels, sets = _texts(arrays, "labels", SHAPES), _texts(arrays, "sets", SHAPES)
    if len(labels) != k or len(sets) != k:
        raise _NotShapesError(f"{k} names, {len(labels)} labels and {len(sets)} sets")
    shapes = tuple(Shape(*three) for three in zip(names, labels, sets, strict=True))
    return MoreShapes(shapes, _deltas(arrays, k, vertices), _regions(arrays, vertices))


def _deltas(arrays: Mapping[str, NDArray[Any]], k: int, vertices: int) -> Float32:
    starts = _table(arrays, "starts", "iu", (k + 1,)).astype(np.int64)
    index = _table(arrays, "index", "iu", (None,))
    delta = _table(arrays, "delta", "i", (len(index), 3))
    scale = _table(arrays, "scale", "f", (k,)).astype(np.float32)
    if int(starts[0]) != 0 or int(starts[-1]) != len(index) or bool((np.diff(starts) < 0).any()):
        raise _NotShapesError(f"starts must rise from 0 to {len(index):,}")
    if len(index) and not 0 <= int(index.min()) <= int(index.max()) < vertices:
        raise _NotShapesError(f"it moves vertices outside of 0 to {vertices - 1:,}")
    if not bool(np.isfinite(scale).all()):
        raise _NotShapesError("a scale is not finite")
    deltas = np.zeros((k, vertices, 3), np.float32)
    for shape in range(k):
        part = slice(int(starts[shape]), int(starts[shape + 1]))
        deltas[shape, index[part]] = delta[part] * scale[shape]
    return deltas


def _regions(arrays: Mapping[str, NDArray[Any]], vertices: int) -> Regions | None:
    if not all(name in arrays for name in _REGION_ARRAYS):
        return None
    names = _texts(arrays, "region_names", _REGIONS)
    weights = _table(arrays, "region_weights", "u", (len(names), vertices))
    if weights.dtype != np.uint8 or bool((weights.sum(axis=0, dtype=np.int64) > 255).any()):
        raise _NotShapesError("region_weights must be uint8, at most 255 summed over the regions")
    return Regions(names, np.ascontiguousarray(weights))


def _whole(arrays: Mapping[str, NDArray[Any]], name: str) -> int:
    array = arrays[name]
    if array.size != 1 or array.dtype.kind not in "iu":
        raise _NotShapesError(f"{name!r} must be one whole number")
    return int(array.reshape(-1)[0])


def _texts(arrays: Mapping[str, NDArray[Any]], name: str, most: int) -> tuple[str, ...]:
    array = arrays[name]
    if array.ndim != 1 or array.dtype.kind != "U" or len(array) > most:
        raise _NotShapesError(f"{name!r} must be a list of at most {most:,} texts")
    return tuple(str(text) for text in array)


def _table(
    arrays: Mapping[str, NDArray[Any]], name: str, kinds: str, shape: tuple[int | None, ...]
) -> NDArray[Any]:
    """The array `name`, of one of the dtype kinds and of the shape, where None stands for any length."""
    array = arrays[name]
    fits = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape, strict=False))
    if array.dtype.kind not in kinds or not fits:
        wanted = tuple("any" if n is None else n for n in shape)
        raise _NotShapesError(f"{name!r} must be {wanted}, not {array.shape} {array.dtype}")
    return array
