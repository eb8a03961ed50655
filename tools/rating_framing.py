"""Cameras that fill a picture with the face, for bundled faces and for folders of anybody's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.camera import Camera
from facemorph.core.pose import NEUTRAL
from facemorph.core.rig import Rig

# Points of the 68-point markup: the jaw's line from ear to ear, and the brows.
JAW, BROWS, CHIN = range(17), range(17, 27), 8
# The forehead shown above the brows, as a part of the way from chin to brows.
FOREHEAD = 0.42
# What moves at least this part of the farthest move is the face; what share of it strays at each end.
MOVES, STRAYS = 0.12, 0.005
# Without landmarks, room around what moves, as parts of its height: up, aside, down.
AROUND = (0.35, 0.10, 0.08)
MARGIN = 1.04


def face_points(rig: Rig, emotions: Sequence[str]) -> Float64:
    """Points (n, 3) that a picture of the face must hold: at rest and in every one of `emotions`.

    By the 68-point markup where the rig has its jaw and brows, else by what the emotions move; the whole
    rig where nothing does.
    """
    shapes = [rig.names.index(name) for name in emotions if name != NEUTRAL]
    rest, moves = rig.neutral.positions.astype(np.float64), rig.deltas[shapes].astype(np.float64)
    marked = {mark.ibug: mark.vertex for mark in rig.info.landmarks if mark.ibug is not None}
    if marked.keys() >= {*JAW, *BROWS}:
        return _by_landmarks(rest, moves, marked)
    return _by_what_moves(rest, moves)


def _by_landmarks(rest: Float64, moves: Float64, marked: dict[int, int]) -> Float64:
    held = [marked[number] for number in (*JAW, *BROWS)]
    brows = rest[[marked[number] for number in BROWS]]
    height = brows[:, 1].max() - rest[marked[CHIN], 1]
    forehead = brows + np.array([0.0, FOREHEAD * height, 0.0])
    return np.concatenate([rest[held], forehead, *(rest[held] + move[held] for move in moves)])


def _by_what_moves(rest: Float64, moves: Float64) -> Float64:
    way = np.linalg.norm(moves, axis=2).max(axis=0, initial=0.0)
    if way.max(initial=0.0) <= 0.0:
        return rest
    moved = way > MOVES * way.max()
    points = np.concatenate([rest[moved], *(rest[moved] + move[moved] for move in moves)])
    low, high = np.quantile(points, (STRAYS, 1.0 - STRAYS), axis=0)
    up, aside, down = (part * (high[1] - low[1]) for part in AROUND)
    low, high = low - np.array([aside, down, 0.0]), high + np.array([aside, up, 0.0])
    return np.stack(np.meshgrid(*np.stack([low, high], -1)), -1).reshape(-1, 3)


def face_camera(rig: Rig, points: Float64, direction: str, aspect: float) -> Camera:
    """The camera that sees `points` (n, 3) of a rig from a direction, in the middle and as large as fits.

    It stands as far away as one that sees the whole rig, so perspective is the same, through a longer lens.
    """
    whole = Camera.framing(rig.neutral.bounds, direction, aspect)
    axes = np.stack(whole.axes())
    seen = axes @ points.T
    middle = (seen.min(axis=1) + seen.max(axis=1)) / 2.0
    across, up, back = seen - middle[:, None]
    half = np.maximum(np.abs(across) / aspect, np.abs(up)) * MARGIN
    slope = float((half / (whole.distance - back)).max())
    x, y, z = (float(value) for value in axes.T @ middle)
    field = math.degrees(2.0 * math.atan(slope))
    return replace(whole, target=(x, y, z), field_deg=min(max(field, 0.5), whole.field_deg))
