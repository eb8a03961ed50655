"""Arrays out of a `.npz`, believing nothing that it claims.

A zip can claim any size, and small files can unpack to huge ones; so each array's own header is read and
its size checked before any of its data, and no more than that size is unpacked. Nothing is unpickled.
"""

from __future__ import annotations

import math
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, BinaryIO, cast

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from facemorph.io.limits import NAME_BYTES, plain_size, reason

Arrays = dict[str, NDArray[Any]]
_HEADER_BYTES = 10_000
_MEMBERS = 1_000


class NpzError(Exception):
    """Why a `.npz` cannot be used, in words that follow the file's name."""


def read_npz(path: Path, needed: Sequence[str], optional: Sequence[str] = (), limit: int = 1 << 30) -> Arrays:
    """The arrays of these names, at most `limit` bytes together. Raises `NpzError`."""
    try:
        with zipfile.ZipFile(path) as archive:
            if len(archive.infolist()) > _MEMBERS:
                raise NpzError(f"has more than {_MEMBERS:,} arrays")
            there = {info.filename: info for info in archive.infolist()}
            arrays: Arrays = {}
            for name in (*needed, *optional):
                info = there.get(f"{name}.npy")
                if info is None and name in needed:
                    raise NpzError(f"has no array {name!r}")
                if info is not None:
                    with archive.open(info) as file:
                        arrays[name] = _array(cast(BinaryIO, file), name, limit)
                    limit -= arrays[name].nbytes
            return arrays
    except (zipfile.BadZipFile, zlib.error, OSError, ValueError, EOFError, NotImplementedError, RuntimeError,
            TypeError, OverflowError, SyntaxError) as error:  # fmt: skip
        raise NpzError(f"cannot be read: {reason(error)}") from error


def whole(arrays: Arrays, name: str) -> int:
    """The array `name` as the one whole number that it must hold. Raises `NpzError`."""
    array = arrays[name]
    if array.size != 1 or array.dtype.kind not in "iu":
        raise NpzError(f"must hold one whole number as {name!r}")
    return int(array.reshape(-1)[0])


def texts(arrays: Arrays, name: str, most: int) -> tuple[str, ...]:
    """The array `name` as a list of at most `most` texts. Raises `NpzError`."""
    array = arrays[name]
    if array.ndim != 1 or array.dtype.kind != "U" or len(array) > most:
        raise NpzError(f"must hold a list of at most {most:,} texts as {name!r}")
    try:
        return tuple(str(text) for text in array)
    except ValueError as error:
        raise NpzError(f"holds no text as {name!r}") from error


def table(arrays: Arrays, name: str, kinds: str, shape: tuple[int | None, ...]) -> NDArray[Any]:
    """The array `name`, of one of the dtype kinds and of the shape, where None stands for any length.

    Raises `NpzError`.
    """
    array = arrays[name]
    fits = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape, strict=True))
    if array.dtype.kind not in kinds or not fits:
        wanted = tuple("any" if n is None else n for n in shape)
        raise NpzError(f"must hold {wanted} as {name!r}, not {array.shape} {array.dtype}")
    return array


def _array(file: BinaryIO, name: str, limit: int) -> NDArray[Any]:
    version = npy.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise NpzError(f"holds {name!r} in npy version {version}, which is not read")
    read_header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, fortran, dtype = read_header(file, max_header_size=_HEADER_BYTES)
    if dtype.kind not in "iufU" or dtype.itemsize > 4 * NAME_BYTES:
        raise NpzError(f"holds {name!r} as {dtype}, which is not read")
    size = math.prod(shape) * dtype.itemsize
    if size > limit or any(side < 0 for side in shape) or len(shape) > 4:
        raise NpzError(f"claims {plain_size(size)} for {name!r}, more than is read")
    if fortran and len(shape) > 1:
        raise NpzError(f"holds {name!r} column by column")
    # Unpacked piece by piece: a short file that claims much takes no more than it has.
    data = bytearray()
    while len(data) < size and (piece := file.read(min(size - len(data), 1 << 20))):
        data += piece
    if len(data) != size or file.read(1):
        raise NpzError(f"does not hold as much as it claims for {name!r}")
    return np.frombuffer(data, dtype).reshape(shape)
