"""Write a set of head-like OBJs to measure with: quads, uvs with seams, shapes that each move a part.

    python benchmarks/make_faces.py FOLDER [--vertices 27000] [--shapes 7] [--normals] [--triangles]

Also a module: `head(vertices)`, `write_set(folder, vertices, shapes)`. The same numbers, the same bytes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

EXPRESSIONS = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
_ISLANDS = 8  # strips of the texture: every border between two is a seam


def head(vertices: int) -> tuple[Floats, Ints, Floats, Ints]:
    """Positions (V, 3) in cm, quads (P, 4), uvs (U, 2), and the quads' uv indices (P, 4); V near `vertices`.

    A tube closed around the head (its columns wrap) from chin to crown, with brows, nose and mouth pressed
    into it. Each of eight strips of columns has uvs of its own, so a seam's vertices have two.
    """
    columns = max(_ISLANDS * round(np.sqrt(vertices * 1.2) / _ISLANDS), _ISLANDS)
    rows = max(round(vertices / columns), 2)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    polar = np.pi * (row + 1.0) / (rows + 1.0)
    around = 2.0 * np.pi * column / columns
    radius = (
        9.0
        + 1.5 * np.cos(around) * np.exp(-((polar - 1.7) ** 2) / 0.02)
        + 0.2 * np.sin(5 * around) * np.sin(polar)
    )
    positions = np.stack(
        [
            radius * np.sin(polar) * np.sin(around),
            12.0 * np.cos(polar),
            radius * np.sin(polar) * np.cos(around),
        ],
        axis=2,
    ).reshape(-1, 3)
    r, c = (grid.ravel() for grid in np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij"))
    right = (c + 1) % columns
    quads = np.stack(
        [r * columns + c, (r + 1) * columns + c, (r + 1) * columns + right, r * columns + right], axis=1
    )
    width = columns // _ISLANDS
    across = columns + _ISLANDS
    uv_row, uv_column = np.meshgrid(np.arange(rows), np.arange(across), indexing="ij")
    uvs = np.stack([(uv_column + 0.5) / across, 1.0 - (uv_row + 0.5) / rows], axis=2).reshape(-1, 2)
    left = c + c // width
    uv_quads = np.stack(
        [r * across + left, (r + 1) * across + left, (r + 1) * across + left + 1, r * across + left + 1],
        axis=1,
    )
    return positions, quads, uvs, uv_quads


def shape(positions: Floats, number: int) -> Floats:
    """The positions (V, 3) of shape `number`: a smooth bump over a part of the front, different for each."""
    rng = np.random.default_rng(number)
    front = positions[:, 2] > 0.0
    centre = positions[front][rng.integers(int(front.sum()))]
    nearness = np.exp(-((positions - centre) ** 2).sum(axis=1) / (2.0 * rng.uniform(1.5, 3.5) ** 2))
    nearness[nearness < 0.01] = 0.0
    return positions + nearness[:, None] * rng.normal(0.0, 0.5, 3)


def shape_names(count: int) -> list[str]:
    """The six expressions, then `shape_07`, `shape_08`, …"""
    return [EXPRESSIONS[i] if i < len(EXPRESSIONS) else f"shape_{i + 1:02d}" for i in range(count)]


def obj_text(
    positions: Floats,
    quads: Ints,
    uvs: Floats,
    uv_quads: Ints,
    normals: bool = False,
    triangles: bool = False,
) -> str:
    """An OBJ with six decimals, as most programs write it."""
    parts = ["# head for measuring\no head\ng skin\n"]
    parts.append("".join(map("v %.6f %.6f %.6f\n".__mod__, map(tuple, positions.tolist()))))
    parts.append("".join(map("vt %.6f %.6f\n".__mod__, map(tuple, uvs.tolist()))))
    faces = np.stack([quads, uv_quads] + ([quads] if normals else []), axis=2) + 1
    if normals:
        outward = positions / np.linalg.norm(positions, axis=1, keepdims=True)
        parts.append("".join(map("vn %.4f %.4f %.4f\n".__mod__, map(tuple, outward.tolist()))))
    if triangles:
        faces = np.stack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]], axis=1).reshape(-1, 3, faces.shape[2])
    corner = "/".join(["%d"] * faces.shape[2])
    line = "f " + " ".join([corner] * faces.shape[1]) + "\n"
    parts.append("".join(map(line.__mod__, map(tuple, faces.reshape(len(faces), -1).tolist()))))
    return "".join(parts)


def write_set(
    folder: Path, vertices: int = 27_000, shapes: int = 7, normals: bool = False, triangles: bool = False
) -> list[Path]:
    """Write `neutral.obj` and `shapes` shapes into `folder`; returns their paths, the neutral first."""
    folder.mkdir(parents=True, exist_ok=True)
    positions, quads, uvs, uv_quads = head(vertices)
    faces = {"neutral": positions} | {name: shape(positions, i) for i, name in enumerate(shape_names(shapes))}
    paths = []
    for name, moved in faces.items():
        paths.append(folder / f"{name}.obj")
        paths[-1].write_text(obj_text(moved, quads, uvs, uv_quads, normals, triangles), encoding="utf-8")
    return paths


def main() -> None:
    """The command line of this file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--vertices", type=int, default=27_000)
    parser.add_argument("--shapes", type=int, default=7)
    parser.add_argument(
        "--normals", action="store_true", help="with vn lines, which differ from shape to shape"
    )
    parser.add_argument("--triangles", action="store_true", help="each quad cut into two triangles")
    options = parser.parse_args()
    for path in write_set(
        options.folder, options.vertices, options.shapes, options.normals, options.triangles
    ):
        print(path)


if __name__ == "__main__":
    main()
