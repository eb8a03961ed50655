"""Write a `shapes.npz`; `shapes_npz` says what stands in it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.core.rig import Regions, Shape
from facemorph.io.shapes_npz import FORMAT

_LARGEST = 32_767
# Steps finer than this part of the face's diagonal would only store noise.
_FINEST = 1e-8


def write_shapes(
    path: Path, shapes: Sequence[Shape], deltas: Float32, diagonal: float, regions: Regions | None
) -> None:
    """Shapes with deltas (K, V, 3) into the file `path`, rounded to 1 / 32,767 of each one's largest move."""
    packed = [_packed(delta, diagonal) for delta in deltas]
    counts = [len(index) for index, _, _ in packed]
    more = {} if regions is None else _region_arrays(regions)
    with path.open("wb") as file:
        np.savez_compressed(
            file,
            allow_pickle=False,
            format=np.int32(FORMAT),
            vertices=np.int32(deltas.shape[1]),
            names=np.array([shape.name for shape in shapes], np.str_),
            labels=np.array([shape.label for shape in shapes], np.str_),
            sets=np.array([shape.set for shape in shapes], np.str_),
            starts=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
            index=np.concatenate([np.zeros(0, np.int32), *(index for index, _, _ in packed)]),
            delta=np.concatenate([np.zeros((0, 3), np.int16), *(steps for _, steps, _ in packed)]),
            scale=np.array([scale for *_, scale in packed], np.float32),
            **more,
        )


def _packed(
    delta: Float32, diagonal: float
) -> tuple[Int32, np.ndarray[tuple[int, ...], np.dtype[np.int16]], float]:
    """The moved vertices, their moves in steps, and the step."""
    scale = float(np.float32(max(float(np.abs(delta).max(initial=0.0)) / _LARGEST, _FINEST * diagonal)))
    steps = np.clip(np.rint(delta / max(scale, 1e-30)), -_LARGEST, _LARGEST).astype(np.int16)
    moved = np.flatnonzero(steps.any(axis=1)).astype(np.int32)
    return moved, steps[moved], scale


def _region_arrays(regions: Regions) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.generic]]]:
    return {"region_names": np.array(regions.names, np.str_), "region_weights": regions.weights}
