"""Structured strips of quads: order them as grids and run smooth curves along them."""

from collections import Counter, defaultdict

import numpy as np


def grid_of(quads: np.ndarray) -> np.ndarray:
    """Vertex indices (rows, columns) of a rectangular strip of quads; columns run along the long side."""
    adjacent, corners, border = _connections(quads)
    start = corners[0]
    first, second = (_walk(border, corners, start, step) for step in border[start])
    long, short = (first, second) if len(first) >= len(second) else (second, first)
    rows, seen = [long], set(long)
    for r in range(1, len(short)):
        row = [short[r]]
        for above in rows[-1][1:]:
            row.append(min(v for v in adjacent[row[-1]] & adjacent[above] if v not in seen and v not in row))
        rows.append(row)
        seen.update(row)
    return np.array(rows)


def _connections(quads: np.ndarray):
    """Neighbours of each vertex, the four corners of the strip, and neighbours along its border."""
    adjacent, border = defaultdict(set), defaultdict(list)
    valence, shared = Counter(), Counter()
    for quad in quads.tolist():
        for a, b in zip(quad, quad[1:] + quad[:1], strict=True):
            adjacent[a].add(b)
            adjacent[b].add(a)
            valence[a] += 1
            shared[min(a, b), max(a, b)] += 1
    for (a, b), count in shared.items():
        if count == 1:
            border[a].append(b)
            border[b].append(a)
    return adjacent, [v for v, count in valence.items() if count == 1], border


def _walk(border: dict, corners: list, start: int, step: int) -> list[int]:
    path = [start, step]
    while path[-1] not in corners:
        path.append(next(v for v in border[path[-1]] if v != path[-2]))
    return path


def catmull_rom(count: int, at: np.ndarray) -> np.ndarray:
    """Weights (len(at), count) of control points for a Catmull-Rom curve at parameters 0..count - 1."""
    at = np.asarray(at, float)
    left = np.clip(np.floor(at).astype(int), 0, count - 2)
    t = at - left
    basis = [
        (-t + 2 * t**2 - t**3) / 2,
        (2 - 5 * t**2 + 3 * t**3) / 2,
        (t + 4 * t**2 - 3 * t**3) / 2,
        (-(t**2) + t**3) / 2,
    ]
    weights, rows = np.zeros((len(at), count)), np.arange(len(at))
    for shift, value in zip((-1, 0, 1, 2), basis, strict=True):
        index = left + shift
        below, above = index < 0, index > count - 1
        within = ~below & ~above
        np.add.at(weights, (rows[within], index[within]), value[within])
        # Beyond an end the curve continues straight: a phantom point 2 p0 - p1.
        for beyond, end, inner in ((below, 0, 1), (above, count - 1, count - 2)):
            weights[rows[beyond], end] += 2 * value[beyond]
            weights[rows[beyond], inner] -= value[beyond]
    return weights
