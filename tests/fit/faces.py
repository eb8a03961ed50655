"""Small faces made for the laws of fitting: a sheet of skin, and parts that hang on nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.core.triangles import triangulated
from tests.conftest import bumpy_grid

NAMES = ("smile", "frown", "puff", "blink", "sneer", "pout")


def sheet_rig(shapes: int = 4, rows: int = 13, columns: int = 15, seed: int = 3) -> Rig:
    """A curved sheet whose shapes are smooth bumps that leave its border still."""
    mesh = bumpy_grid(rows, columns)
    return rig_of(mesh, bumps(mesh.positions.astype(np.float64), shapes, seed))


def rig_of(mesh: Mesh, offsets: np.ndarray) -> Rig:
    """A rig of offsets (K, V, 3)."""
    made = {NAMES[k]: mesh.positions + offset.astype(np.float32) for k, offset in enumerate(offsets)}
    rig = Rig.from_arrays(mesh, made)
    return replace(rig, deltas=offsets.astype(np.float32))


def bumps(points: np.ndarray, count: int, seed: int) -> np.ndarray:
    """Offsets (K, V, 3) of a sheet from -2 to 2 by -1.5 to 1.5: 0 on its border, and in part of it."""
    draw = np.random.default_rng(seed)
    inside = np.clip(2.0 - np.abs(points[:, 0]), 0, 1) * np.clip(1.5 - np.abs(points[:, 1]), 0, 1)
    made = []
    for _ in range(count):
        centre, width = draw.uniform(-1.0, 1.0, 2) * (1.3, 0.9), draw.uniform(0.5, 1.1)
        near = np.exp(-((points[:, :2] - centre) ** 2).sum(axis=1) / width**2)
        made.append((np.where(near > 0.02, near, 0.0) * inside)[:, None] * draw.normal(0.0, 0.6, 3))
    return np.array(made)


def other(points: np.ndarray) -> np.ndarray:
    """Another person: a smooth warp of points (N, 3)."""
    x, y, z = points.T
    wave = 0.12 * np.sin(1.3 * x + 0.5) * np.cos(1.1 * y)
    return np.stack([1.1 * x + 0.1 * np.sin(y), 0.95 * y + wave, 1.05 * z + wave], axis=1)


def styled(rig: Rig) -> tuple[np.ndarray, np.ndarray]:
    """That person: the neutral (V, 3), and the rig's shapes warped, in a style of their own, (K, V, 3)."""
    points = rig.neutral.positions.astype(np.float64)
    neutral = other(points)
    gains = 1.0 + 0.35 * np.sin(2.0 * points[:, 0] + 1.0 + np.arange(len(rig.names))[:, None])
    moved = np.array([other(points + delta) - neutral for delta in rig.deltas.astype(np.float64)])
    return neutral, moved * gains[..., None]


def mixed(neutral: np.ndarray, offsets: np.ndarray, weights: np.ndarray) -> dict[str, np.ndarray]:
    """Faces by name in weights (m, K)."""
    return {f"face {j}": neutral + np.tensordot(row, offsets, 1) for j, row in enumerate(weights)}


def named(rig: Rig, weights: np.ndarray) -> list[dict[str, float]]:
    """Weights (m, K) as a person gives them: those that are not 0, by name."""
    return [{name: float(v) for name, v in zip(rig.names, row, strict=True) if v > 0.0} for row in weights]


def octahedron(centre: tuple[float, float, float], size: float) -> tuple[np.ndarray, np.ndarray]:
    """A small closed part: positions (6, 3) and triangles (8, 3)."""
    points = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
    faces = [(a, b, c) for a in (0, 1) for b in (2, 3) for c in (4, 5)]
    return points * size + centre, np.array(faces, np.int32)


def joined(skin: Mesh, *parts: tuple[np.ndarray, np.ndarray]) -> tuple[Mesh, list[slice]]:
    """One mesh of triangles: the skin, then the parts; and where each part's vertices lie."""
    count = skin.vertex_count
    points, faces, places = [skin.positions], [triangulated(skin).vertices], []
    for positions, triangles in parts:
        points.append(positions)
        faces.append(triangles + count)
        places.append(slice(count, count + len(positions)))
        count += len(positions)
    mesh = Mesh.from_triangles(
        np.concatenate(points).astype(np.float32), np.concatenate(faces).astype(np.int32)
    )
    return mesh, places


def turned(degrees: float, axis: int = 1) -> np.ndarray:
    """A rotation (3, 3) about one axis."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    a, b = ((1, 2), (2, 0), (0, 1))[axis]
    made = np.eye(3)
    made[[a, a, b, b], [a, b, a, b]] = (c, -s, s, c)
    return made
