"""The emotion map: a cursor among poles of expressions mixes the two poles it lies between (thesis, 2.1.2).

Poles of the paper: happy at +y, anger at -y, sad at +x, fear at -x, neutral in the middle. A cursor
(Cx, Cy) gives

    w_sad = max(Cx, 0)   w_fear = max(-Cx, 0)   w_happy = max(Cy, 0)   w_anger = max(-Cy, 0)

and the face is the neutral plus these weights of its poles. With poles at other angles the same rule
reads: the cursor is written as a sum of the two poles' directions that it lies between; its parts are
the weights. For the paper's four poles both are equal.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from facemorph.errors import OptionError


@dataclass(frozen=True)
class Pole:
    """An expression at a place on the circle: degrees, 0 to the right, 90 up."""

    name: str
    angle_deg: float


PAPER_POLES = (Pole("sad", 0.0), Pole("happy", 90.0), Pole("afraid", 180.0), Pole("angry", 270.0))


def spread_poles(names: Sequence[str]) -> tuple[Pole, ...]:
    """Poles for any number of expressions: evenly round the circle, the first on top, then clockwise."""
    step = 360.0 / max(len(names), 1)
    return tuple(Pole(name, (90.0 - k * step) % 360.0) for k, name in enumerate(names))


def on_disc(x: float, y: float) -> tuple[float, float]:
    """The cursor, brought back to the unit disc if it lies outside: what a round pad does with a hand."""
    length = math.hypot(x, y)
    return (x / length, y / length) if length > 1.0 else (x, y)


def emotion_weights(x: float, y: float, poles: Sequence[Pole] = PAPER_POLES) -> dict[str, float]:
    """Weights by expression for a cursor; only those above 0.

    Raises `OptionError` for unfit poles and for a cursor that is no two numbers.
    """
    if not (math.isfinite(x) and math.isfinite(y)):
        raise OptionError(f"a place on the emotion map is two numbers from -1 to 1, not {x}, {y}.")
    if x == 0.0 and y == 0.0:
        return {}
    ring = _checked(poles)
    angle = math.degrees(math.atan2(y, x)) % 360.0
    for first, second in zip(ring, [*ring[1:], ring[0]], strict=True):
        gap = (second.angle_deg - first.angle_deg) % 360.0
        if (angle - first.angle_deg) % 360.0 <= gap:
            return _between(x, y, first, second)
    raise AssertionError("the poles' gaps cover the circle")


def _between(x: float, y: float, first: Pole, second: Pole) -> dict[str, float]:
    """(x, y) = w1 d1 + w2 d2 with the poles' directions d, solved by Cramer's rule."""
    (ax, ay), (bx, by) = _direction(first), _direction(second)
    area = ax * by - ay * bx
    weights = {first.name: (x * by - y * bx) / area, second.name: (ax * y - ay * x) / area}
    return {name: weight for name, weight in weights.items() if weight > 0.0}


def _direction(pole: Pole) -> tuple[float, float]:
    """Unit vector of a pole; exact along the axes, so that the paper's rule holds to the last bit."""
    exact = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
    angle = pole.angle_deg % 360.0
    return exact.get(angle) or (math.cos(math.radians(angle)), math.sin(math.radians(angle)))


def _checked(poles: Sequence[Pole]) -> list[Pole]:
    ring = sorted((Pole(p.name, p.angle_deg % 360.0) for p in poles), key=lambda pole: pole.angle_deg)
    gaps = [(b.angle_deg - a.angle_deg) % 360.0 for a, b in zip(ring, [*ring[1:], *ring[:1]], strict=True)]
    if len(ring) < 3 or max(gaps) >= 180.0 or min(gaps) < 1.0 or len({p.name for p in ring}) < len(ring):
        raise OptionError(
            "an emotion map needs at least 3 different poles, less than half a turn and at least a degree "
            f"apart; there are {', '.join(f'{p.name} at {p.angle_deg:g}' for p in ring) or 'none'}."
        )
    return ring
