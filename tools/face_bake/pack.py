"""All units of a person as sparse offsets in one compressed file."""

from pathlib import Path

import numpy as np

from .correctives import SMALLEST as SMALLEST_CORRECTION
from .correctives import correctives, recipes_by_name
from .head import Body
from .recipes import FACS, arkit_label, arkit_recipe

FORMAT = 1
# Offsets shorter than this (cm) are left out.
SMALLEST = 0.0005
# Coarsest step of the stored integers (cm); finer steps would only store noise.
FINEST_STEP = 0.0002


def units(arkit_names: list[str]) -> list[tuple[str, str, str, dict]]:
    """Name, label, set and recipe of every unit, FACS first."""
    facs = [(name, label, "facs", recipe) for name, (label, recipe) in FACS.items()]
    return facs + [(name, arkit_label(name), "arkit", arkit_recipe(name)) for name in arkit_names]


def quantise(offsets: np.ndarray, smallest: float = SMALLEST) -> tuple[np.ndarray, np.ndarray, float]:
    """Moved vertices (n,), their offsets (n, 3) as int16, and the step in centimetres."""
    moved = np.flatnonzero(np.linalg.norm(offsets, axis=1) >= smallest)
    largest = np.abs(offsets[moved]).max() if len(moved) else 0.0
    step = np.float32(max(largest / 32767, FINEST_STEP))
    return moved, np.round(offsets[moved] / step).astype(np.int16), step


def write_shapes(path: Path, body: Body, arkit_names: list[str], regions: dict):
    """regions: name -> weights (V,) uint8."""
    neutral = body.positions(body.shaper.neutral)
    listed = units(arkit_names)
    recipes = recipes_by_name(arkit_names)
    moves = {name: body.positions(body.shaper.shape(recipe)) - neutral for name, recipe in recipes.items()}
    packed = [quantise(moves[name]) for name, *_ in listed]
    made = correctives(body, recipes, moves)
    listed += [(one.name, one.name, "corrective", {}) for one in made]
    packed += [quantise(one.offsets, SMALLEST_CORRECTION) for one in made]
    counts = [len(index) for index, _, _ in packed]
    np.savez_compressed(
        path,
        format=np.int32(FORMAT),
        vertices=np.int32(len(neutral)),
        names=np.array([name for name, *_ in listed]),
        labels=np.array([label for _, label, *_ in listed]),
        sets=np.array([kind for _, _, kind, _ in listed]),
        starts=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
        index=np.concatenate([index for index, _, _ in packed]).astype(np.uint16),
        delta=np.concatenate([delta for _, delta, _ in packed]),
        scale=np.array([step for *_, step in packed], np.float32),
        region_names=np.array(list(regions)),
        region_weights=np.stack(list(regions.values())).astype(np.uint8),
    )
