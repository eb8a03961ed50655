"""Painted regions as a `.npz`, to be kept, shared and used on other faces of one topology.

format          text, "facemorph regions 1"
vertices        int, V
region_names    (R,) text
region_weights  (R, V) float32, 0 to 1, at most 1 summed over the regions at every vertex
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.rig import Rig
from facemorph.deform.regions import RegionSet
from facemorph.errors import ControlsFileError
from facemorph.io.atomic import replacing
from facemorph.io.limits import plain_size
from facemorph.io.npz import Arrays, NpzError, read_npz, table, texts, whole

FORMAT = "facemorph regions 1"
MOST_REGIONS = 64
_NEEDED = ("format", "vertices", "region_names", "region_weights")
_SPARE_BYTES = 1 << 20
_LONGEST_NAME = 64
_SUM = 1.0 + 1e-5


def write_regions(path: str | Path, regions: RegionSet, rig: Rig) -> None:
    """Keep `regions`, whole or not at all. Raises `OutputError`."""
    with replacing(Path(path)) as temporary, temporary.open("wb") as file:
        np.savez_compressed(
            file,
            format=np.array([FORMAT]),
            vertices=np.int32(rig.neutral.vertex_count),
            region_names=np.array(regions.names),
            # Reading takes arrays row by row only.
            region_weights=np.ascontiguousarray(regions.weights, np.float32),
        )


def read_regions(path: str | Path, rig: Rig) -> RegionSet:
    """The regions kept in a file. Raises `ControlsFileError` where they are none, or not for this face."""
    path, count = Path(path), rig.neutral.vertex_count
    try:
        arrays = _arrays(path, MOST_REGIONS * count * 4 + _SPARE_BYTES)
        vertices = whole(arrays, "vertices")
        if vertices != count:
            raise NpzError(
                f"is for a face of {vertices:,} vertices; {rig.info.name} has {count:,}. "
                "Use a face of the same topology"
            )
        names = texts(arrays, "region_names", MOST_REGIONS)
        if not names or len(set(names)) < len(names) or not all(_is_name(name) for name in names):
            raise NpzError(f"must give every region a name of its own, in at most {_LONGEST_NAME} letters")
        return RegionSet(rig, names, _weights(arrays, len(names), count))
    except NpzError as error:
        raise ControlsFileError(f"{path} {error}.") from error


def _is_name(name: str) -> bool:
    return bool(name.strip()) and name.isprintable() and len(name) <= _LONGEST_NAME


def _arrays(path: Path, limit: int) -> Arrays:
    try:
        if not path.is_file():
            raise NpzError("is no ordinary file" if path.exists() else "does not exist")
        if path.stat().st_size > limit:
            raise NpzError(f"is larger than {plain_size(limit)}, the most that regions of this face take")
    except (OSError, ValueError) as error:
        raise NpzError("cannot be read") from error
    arrays = read_npz(path, _NEEDED, limit=limit)
    if arrays["format"].dtype.kind != "U" or texts(arrays, "format", 1) != (FORMAT,):
        raise NpzError(f"is no file of regions: its format is not {FORMAT!r}")
    return arrays


def _weights(arrays: Arrays, regions: int, vertices: int) -> Float32:
    weights = table(arrays, "region_weights", "f", (regions, vertices)).astype(np.float32)
    sound = bool(np.isfinite(weights).all()) and float(weights.min(initial=0.0)) >= 0.0
    if not sound or float(weights.sum(axis=0).max(initial=0.0)) > _SUM:
        raise NpzError("must hold weights of 0 or more that sum to at most 1 at every vertex")
    return weights
