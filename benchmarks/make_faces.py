"""Write a set of head-like OBJs to measure with: quads, uvs with seams, shapes that each move a part.

    python benchmarks/make_faces.py FOLDER [--vertices 27000] [--shapes 7] [--normals] [--triangles]

Also a module: `head(vertices)`, `write_set(folder, vertices, shapes)`. The same numbers, the same bytes.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

EXPRESSIONS = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
_ISLANDS = 8  # strips of the texture: every border between two is a seam


@dataclass(frozen=True)
class Head:
    """Positions (V, 3) in cm, uvs (U, 2), and polygons' vertices and uvs: quads, and caps of triangles."""

    positions: Floats
    uvs: Floats
    quads: Ints
    uv_quads: Ints
    caps: Ints
    uv_caps: Ints


def head(vertices: int) -> Head:
    """A closed head of about so many vertices.

    Columns go round the head, rows from crown to chin, with nose and cheeks pressed into it; fans of
    triangles close both ends. The texture lies in eight strips: at every border between two of them, and
    at both ends, a vertex has several uvs.
    """
    columns = max(_ISLANDS * round(np.sqrt(vertices * 1.2) / _ISLANDS), _ISLANDS)
    rows = max(round((vertices - 2) / columns), 2)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    polar = np.pi * (row + 1.0) / (rows + 1.0)
    around = 2.0 * np.pi * column / columns
    nose = 1.5 * np.cos(around) * np.exp(-((polar - 1.7) ** 2) / 0.02)
    radius = 9.0 + nose + 0.2 * np.sin(5 * around) * np.sin(polar)
    x, z = radius * np.sin(polar) * np.sin(around), radius * np.sin(polar) * np.cos(around)
    wall = np.stack([x, 12.0 * np.cos(polar), z], axis=2).reshape(-1, 3)
    positions = np.concatenate([wall, [[0.0, 12.0, 0.0], [0.0, -12.0, 0.0]]])
    r, c = (grid.ravel() for grid in np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij"))
    right = (c + 1) % columns
    quads = np.stack(
        [r * columns + c, (r + 1) * columns + c, (r + 1) * columns + right, r * columns + right], axis=1
    )
    across = columns + _ISLANDS
    left = c + c // (columns // _ISLANDS)
    uv_quads = np.stack(
        [r * across + left, (r + 1) * across + left, (r + 1) * across + left + 1, r * across + left + 1],
        axis=1,
    )
    top, bottom = quads[:columns, [0, 3]], quads[-columns:, [2, 1]]
    uv_top, uv_bottom = uv_quads[:columns, [0, 3]], uv_quads[-columns:, [2, 1]]
    caps = np.concatenate([np.insert(top, 2, rows * columns, 1), np.insert(bottom, 2, rows * columns + 1, 1)])
    uv_caps = np.concatenate(
        [
            np.insert(uv_top, 2, rows * across, 1),
            np.insert(uv_bottom, 2, rows * across + 1, 1),
        ]
    )
    uv_row, uv_column = np.meshgrid(np.arange(rows), np.arange(across), indexing="ij")
    uvs = np.stack([(uv_column + 0.5) / across, 1.0 - (uv_row + 1.0) / (rows + 1.0)], axis=2).reshape(-1, 2)
    return Head(positions, np.concatenate([uvs, [[0.5, 1.0], [0.5, 0.0]]]), quads, uv_quads, caps, uv_caps)


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


def obj_text(face: Head, positions: Floats, normals: bool = False, triangles: bool = False) -> str:
    """An OBJ with six decimals, as most programs write it; `triangles` cuts each quad into two."""
    parts = ["# head for measuring\no head\n"]
    parts.append("".join(map("v %.6f %.6f %.6f\n".__mod__, map(tuple, positions.tolist()))))
    parts.append("".join(map("vt %.6f %.6f\n".__mod__, map(tuple, face.uvs.tolist()))))
    if normals:
        outward = positions / np.linalg.norm(positions, axis=1, keepdims=True)
        parts.append("".join(map("vn %.4f %.4f %.4f\n".__mod__, map(tuple, outward.tolist()))))
    polygons = (("skin", face.quads, face.uv_quads), ("ends", face.caps, face.uv_caps))
    for name, vertices, uvs in polygons:
        corners = np.stack([vertices, uvs] + ([vertices] if normals else []), axis=2) + 1
        if triangles and vertices.shape[1] == 4:
            corners = np.stack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]], axis=1).reshape(
                -1, 3, corners.shape[2]
            )
        line = "f " + " ".join(["/".join(["%d"] * corners.shape[2])] * corners.shape[1]) + "\n"
        parts.append(
            f"g {name}\n" + "".join(map(line.__mod__, map(tuple, corners.reshape(len(corners), -1).tolist())))
        )
    return "".join(parts)


def write_set(
    folder: Path, vertices: int = 27_000, shapes: int = 7, normals: bool = False, triangles: bool = False
) -> list[Path]:
    """Write `neutral.obj` and `shapes` shapes into `folder`; returns their paths, the neutral first."""
    folder.mkdir(parents=True, exist_ok=True)
    face = head(vertices)
    faces = {"neutral": face.positions}
    faces |= {name: shape(face.positions, i) for i, name in enumerate(shape_names(shapes))}
    paths = []
    for name, moved in faces.items():
        paths.append(folder / f"{name}.obj")
        paths[-1].write_text(obj_text(face, moved, normals, triangles), encoding="utf-8", newline="\n")
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
