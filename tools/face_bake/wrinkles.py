"""Paint wrinkles as heights: three sets in the channels of one picture, and the rules that fade them in."""

from dataclasses import dataclass, field

import numpy as np
from PIL import Image
from scipy.interpolate import PchipInterpolator

from .ageing import age_of
from .atlas import BOXES
from .cage import HEAD
from .paintkit import Noise, smoothstep
from .people import Person
from .raster import Raster
from .wrinkle_rules import RULES, Rule
from .wrinkle_strokes import Stroke

# The axis that s goes around, and its distance from the skin in front.
AXIS_Z, AROUND = 0.35, 1.0
STEPS = 48
MIDDLE = 128
# Heights in centimetres from black to white, of a young skin and what age adds.
YOUNG, AGEING = 0.060, 0.090


@dataclass(frozen=True)
class Placed:
    """A rule's area in the picture, on the person's left side and on the right: u0, v0, u1, v1."""

    rule: Rule
    areas: dict = field(default_factory=dict)


def wrinkle_height(person: Person) -> float:
    """Centimetres from black to white."""
    return YOUNG + AGEING * age_of(person)


def paint_wrinkles(points: np.ndarray, raster: Raster) -> tuple[Image.Image, list[Placed]]:
    """The picture of the heights at pixels with `points` (p, 3) on the base head; the same for everybody."""
    around = AROUND * np.arctan2(points[:, 0], points[:, 2] - AXIS_Z)
    heights = np.zeros((len(points), 3), np.float32)
    rows, columns = np.nonzero(raster.covered)
    u, v = (columns + 0.5) / raster.size, 1 - (rows + 0.5) / raster.size
    front = (points[:, 2] > AXIS_Z) & (v > BOXES[HEAD][1])
    placed = []
    for rule in RULES:
        areas = {}
        for side, sign in (("left", 1.0), ("right", -1.0)):
            own = _painted(rule, points, sign * around, front, seed=len(placed) * 2 + (sign < 0))
            if rule.paints:
                heights[:, rule.set] += own
            reached = (np.abs(own) > 0.01) & (sign * around >= 0)
            areas[side] = _area(rule, u[reached], v[reached], side)
        placed.append(Placed(rule, areas))
    levels = np.clip(MIDDLE + 127 * heights, 0, 255)
    picture = np.full((raster.size, raster.size, 3), MIDDLE, np.uint8)
    picture[raster.covered] = np.round(levels).astype(np.uint8)
    return Image.fromarray(picture), placed


def _area(rule: Rule, u: np.ndarray, v: np.ndarray, side: str) -> list[float]:
    """The box around what was painted; its inner edge at the middle where the wrinkle crosses it."""
    margin = 0.6 * rule.soft
    low, high = u.min() - margin, u.max() + margin
    if rule.crosses:
        low, high = (low, 0.5) if side == "left" else (0.5, high)
    split = rule.split
    if split is not None:
        inner, outer = split
        if side == "left":
            low, high = (0.5 - outer, 0.5 - inner)
        else:
            low, high = (0.5 + inner, 0.5 + outer)
    return [round(float(n), 4) for n in (low, v.min() - margin, high, v.max() + margin)]


def _painted(rule: Rule, points, around, front, seed: int) -> np.ndarray:
    """Heights (p,) of one side's strokes and bumps, -1..1."""
    noise = Noise(100 + seed)
    height = np.zeros(len(points), np.float32)
    for number, stroke in enumerate(rule.strokes):
        _add(height, stroke, around, points[:, 1], front, np.random.default_rng(1000 * seed + number))
    if rule.bumps is not None:
        s, y, a, b = rule.bumps
        where = np.exp(-(((around - s) / a) ** 2) - ((points[:, 1] - y) / b) ** 2) * (around > -0.002) * front
        pits = noise(points, 26) + 0.6 * noise(points + 5, 44)
        height += 0.55 * np.clip(pits, -1.4, 1.0) * smoothstep(0.1, 0.7, where)
    return np.clip(height, -1, 1)


def _add(height, stroke: Stroke, around, up, front, rng):
    """Carve one furrow into heights (p,) with bulges beside it."""
    line = _wandering(stroke, rng)
    reach = 5 * stroke.width
    low, high = line.min(0) - reach, line.max(0) + reach
    near = front & (around > low[0]) & (around < high[0]) & (up > low[1]) & (up < high[1])
    near &= around > -reach
    if not near.any():
        return
    where = np.flatnonzero(near)
    distance, along = _distance(line, np.stack([around[where], up[where]], 1))
    uneven = _uneven(rng)
    depth = stroke.depth * np.interp(along, np.linspace(0, 1, len(uneven)), 1 + 0.30 * uneven)
    if stroke.first:
        depth = depth * smoothstep(0, stroke.first, along)
    if stroke.last:
        depth = depth * smoothstep(1, 1 - stroke.last, along)
    thick = stroke.width * (0.65 + 0.35 * np.minimum(depth / stroke.depth, 1.2))
    d = distance / thick
    furrow = np.exp(-(d**2))
    bulge = 0.30 * np.exp(-(((d - 2.1) / 1.3) ** 2))
    # A line that begins at the middle goes on beyond it on the other side: it is mirrored there.
    own = around[where] >= 0
    height[where] += (depth * (bulge - furrow) * own).astype(np.float32)


def _uneven(rng) -> np.ndarray:
    raw = rng.standard_normal(10)
    return np.clip(raw, -1.5, 1.5)


def _wandering(stroke: Stroke, rng) -> np.ndarray:
    """Points (STEPS, 2) along a smooth curve through the stroke's line, off it by a smooth noise."""
    line = np.array(stroke.line, float)
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    t = np.linspace(0, way[-1], STEPS)
    smooth = np.stack([PchipInterpolator(way, column)(t) for column in line.T], 1)
    tangent = np.gradient(smooth, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    wander = stroke.astray * rng.standard_normal(7).clip(-1.6, 1.6)
    off = PchipInterpolator(np.linspace(0, way[-1], 7), wander)(t)
    if line[0, 0] == 0.0:
        off *= smoothstep(0.0, 0.05, smooth[:, 0])
    return smooth + off[:, None] * np.stack([-tangent[:, 1], tangent[:, 0]], 1)


def _distance(line: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (n,) of places (n, 2) to a polyline, and how far along it the nearest point lies, 0..1."""
    nearest = np.full(len(places), np.inf)
    along = np.zeros(len(places))
    for k in range(len(line) - 1):
        start, step = line[k], line[k + 1] - line[k]
        t = np.clip(((places - start) @ step) / (step @ step), 0, 1)
        distance = np.linalg.norm(places - start - t[:, None] * step, axis=1)
        closer = distance < nearest
        nearest = np.where(closer, distance, nearest)
        along = np.where(closer, (k + t) / (len(line) - 1), along)
    return nearest, along
