"""Pairs of landmarks: which place of the scan belongs to which vertex of the template.

The similarity between them is robust: the least median of squares (Rousseeuw 1984) over triples tells
which pairs agree, and the least squares of those is taken. A pair far off is a mistake, and is named.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from math import comb

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.core.landmark_pair import MOST_PAIRS, LandmarkPair
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.errors import FitError
from facemorph.fit.align import Similarity, similarity

FEWEST = 3
# Pairs of two people differ by a tenth of the landmarks' spread at most; a pair mistaken for another by more.
_CONTRADICTS = 0.4
_MOST_TRIPLES = 400
_STRAIGHT = 0.02
_MIRRORED = 3.0
_CLEARLY_OFF = 0.1


def shared_landmarks(template: Rig, scan: Rig) -> tuple[LandmarkPair, ...]:
    """A pair for each landmark that two rigs have alike, by its place in the usual 68, else by its name."""
    places = {_key(mark.ibug, mark.name): mark.vertex for mark in scan.info.landmarks}
    points = scan.neutral.positions.astype(np.float64)
    pairs = []
    for mark in template.info.landmarks:
        vertex = places.get(_key(mark.ibug, mark.name))
        if vertex is not None:
            x, y, z = points[vertex].tolist()
            pairs.append(LandmarkPair(mark.vertex, (x, y, z), mark.name))
    return tuple(pairs)


def checked_pairs(template: Mesh, pairs: Sequence[LandmarkPair]) -> tuple[LandmarkPair, ...]:
    """`pairs` without repetitions. Raises `FitError` where they name no vertex, no place, or one twice."""
    kept: dict[int, LandmarkPair] = {}
    taken: dict[tuple[float, float, float], LandmarkPair] = {}
    if len(pairs) > MOST_PAIRS:
        raise FitError(f"at most {MOST_PAIRS:,} pairs of landmarks are taken, not {len(pairs):,}.")
    for pair in pairs:
        if not 0 <= pair.vertex < template.vertex_count:
            raise FitError(
                f"the pair {pair} is not on the template, which has the vertices 0 to "
                f"{template.vertex_count - 1:,}."
            )
        if not np.isfinite(pair.point).all():
            raise FitError(f"the pair {pair} has a place on the scan that is no finite number.")
        before = kept.setdefault(pair.vertex, pair)
        if before.point != pair.point:
            raise FitError(f"vertex {pair.vertex} of the template has two places on the scan; take one away.")
        before = taken.setdefault(pair.point, pair)
        if before.vertex != pair.vertex:
            raise FitError(f"the pairs {before} and {pair} have one place on the scan; move or remove one.")
    if len(kept) < FEWEST:
        raise FitError(
            f"at least {FEWEST} pairs of landmarks are needed, and there are {len(kept)}; "
            "four far apart (corners of the eyes, nose, chin) make a start, the usual 68 are best."
        )
    return tuple(kept.values())


def agreed_similarity(source: Float64, goal: Float64, pairs: Sequence[LandmarkPair]) -> Similarity:
    """The similarity that takes the pairs' vertices at `source` (n, 3) to their places `goal` (n, 3).

    Raises `FitError` where they lie on one line, fit only mirrored, or one contradicts the others.
    """
    _check_not_straight(source, "the template")
    _check_not_straight(goal, "the scan")
    _check_not_mirrored(source, goal)
    way = _robust(source, goal)
    away = _relative(way, source, goal)
    worst = int(np.argmax(away))
    if away[worst] > _CONTRADICTS:
        raise FitError(
            f"the pair {pairs[worst]} contradicts the others: its place on the scan is "
            f"{away[worst] * _spread(goal):.3g} units from where they put it. Correct it or take it away."
        )
    return way


def _robust(source: Float64, goal: Float64) -> Similarity:
    best, least = similarity(source, goal), np.inf
    for triple in _triples(source):
        way = similarity(source[triple], goal[triple])
        middle = float(np.sort(_relative(way, source, goal))[len(source) // 2])
        if middle < least:
            best, least = way, middle
    agreed = np.flatnonzero(_relative(best, source, goal) <= max(4.0 * least, 0.15))
    return similarity(source[agreed], goal[agreed]) if len(agreed) >= FEWEST else best


def _triples(points: Float64) -> list[Int64]:
    """Triples of n points, all where they are few, that do not lie on a line."""
    n = len(points)
    if comb(n, 3) <= _MOST_TRIPLES:
        triples = np.array(list(combinations(range(n), 3)))
    else:
        rng = np.random.default_rng(0)
        triples = rng.random((_MOST_TRIPLES, n)).argpartition(3, axis=1)[:, :3]
    area = np.linalg.norm(
        np.cross(
            points[triples[:, 1]] - points[triples[:, 0]], points[triples[:, 2]] - points[triples[:, 0]]
        ),
        axis=1,
    )
    return list(triples[area > 0.1 * _spread(points) ** 2])


def _relative(way: Similarity, source: Float64, goal: Float64) -> Float64:
    """How far each pair is off, as part of the spread of the places on the scan, (n,)."""
    return np.asarray(np.linalg.norm(way.points(source) - goal, axis=1) / _spread(goal))


def _spread(points: Float64) -> float:
    return max(float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean())), 1e-300)


def _check_not_straight(points: Float64, where: str) -> None:
    sizes = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if sizes[1] <= _STRAIGHT * sizes[0] or sizes[0] == 0.0:
        raise FitError(
            f"the landmarks on {where} lie on one line, which does not tell how the head is turned; "
            "add one beside it."
        )


def _check_not_mirrored(source: Float64, goal: Float64) -> None:
    flat = np.linalg.svd(source - source.mean(axis=0), compute_uv=False)
    if len(source) < 4 or flat[2] <= _STRAIGHT * flat[0]:
        return
    mirror = source * np.array([-1.0, 1.0, 1.0])
    plain = float(np.median(_relative(similarity(source, goal), source, goal)))
    mirrored = float(np.median(_relative(similarity(mirror, goal), mirror, goal)))
    if plain > _MIRRORED * mirrored and plain > _CLEARLY_OFF:
        raise FitError(
            "the pairs fit only when the scan is mirrored: are left and right confused? The template's left "
            "is the person's own left."
        )


def _key(ibug: int | None, name: str) -> int | str:
    return name if ibug is None else ibug
