"""Shapes that others switch on, where the straight way between two shapes leaves what the bake makes.

The bake turns eyeballs, swings the jaw and keeps lids outside the ball; files hold straight ways. What is
missing half way becomes a shape with a hat over one weight; what is missing where two shapes are on
together becomes a shape with the product of their weights.
"""

from dataclasses import dataclass

import numpy as np

from .head import Body
from .recipes import CLOSING, EXPRESSIONS, FACS, arkit_recipe, half_way_recipe

# Those of which one of the six people misses more than half a millimetre half way, or where two are on.
# The tongue comes out on no arc: a hat would not help it.
EYES_BOTH_SIDES = ("eyeBlink", "eyeLookDown", "eyeLookIn", "eyeSquint")
SIDES = ("Left", "Right")
HALF_WAY = (
    *("happy", "sad", "angry", "surprised", "disgusted", "afraid"),
    *(f"AU{number}" for number in (7, 12, 13, 17, 18, 22, 26, 27, 28, 29, 30, 43, 61, 62, 64)),
    *(f"{name}{side}" for name in EYES_BOTH_SIDES for side in SIDES),
    *(
        "jawForward",
        "jawLeft",
        "jawOpen",
        "jawRight",
        "mouthClose",
        "mouthFunnel",
        "mouthLeft",
        "mouthPucker",
    ),
    *("mouthRight", "mouthRollLower", "mouthRollUpper", "mouthShrugLower"),
    *(f"mouthSmile{side}" for side in SIDES),
)
MOODS = tuple(name for name in EXPRESSIONS if name != "neutral")
PAIRS = (
    *((f"eyeBlink{side}", f"{other}{side}") for side in SIDES for other in ("eyeLookDown", "eyeLookUp")),
    *((f"eyeBlink{side}", f"{other}{side}") for side in SIDES for other in ("eyeSquint", "cheekSquint")),
    *((f"eyeBlink{side}", f"eyeWide{side}") for side in SIDES),
    *((f"eyeWide{side}", f"eyeLook{way}{side}") for side in SIDES for way in ("Up", "Down")),
    *(("AU43", "AU5"), ("AU43", "AU6"), ("AU43", "AU7"), ("AU43", "AU63"), ("AU43", "AU64"), ("AU5", "AU63")),
    *((mood, "AU43") for mood in MOODS),
    *((mood, f"eyeBlink{side}") for mood in MOODS for side in SIDES),
)
# Lids that lead open further half way than a blink closes by itself.
HALF_WAY_PAIRS = tuple(
    (mood, blink) for mood in ("surprised", "afraid") for blink in ("AU43", "eyeBlinkLeft", "eyeBlinkRight")
)
# Lips close on an open jaw as far as they are told to, however open it is: the hat over jawOpen rises at once
# and stays. It is what follows from JAW_SHARE at the jaw fully open.
LIPS_ON_JAW, LIPS, JAW = "mouthClose on an open jaw", "mouthClose", "jawOpen"
JAW_OVER = (0.0, 0.3, 4.0)
_FALL = (JAW_OVER[2] - 1.0) / (JAW_OVER[2] - JAW_OVER[1])
JAW_SHARE = _FALL * (2.0 - _FALL)
# Of a corrective, vertices that it moves less than this (cm) stay.
SMALLEST = 0.003


@dataclass(frozen=True)
class MadeCorrective:
    """A shape's name and its offsets (V, 3) in centimetres."""

    name: str
    offsets: np.ndarray


def recipes_by_name(arkit_names: list[str]) -> dict[str, dict]:
    """The recipe of every shape of the files."""
    expressions = {name: recipe for name, recipe in EXPRESSIONS.items() if recipe}
    units = {name: recipe for name, (_, recipe) in FACS.items()}
    return {**expressions, **units, **{name: arkit_recipe(name) for name in arkit_names}}


def half_way(name: str) -> str:
    """The name of a shape's in-between; shapes of one recipe share it."""
    recipes = recipes_by_name([one for one in HALF_WAY if one not in {*EXPRESSIONS, *FACS}])
    return f"{next(one for one in HALF_WAY if recipes[one] == recipes[name])} half way"


def together(one: str, other: str) -> str:
    """The name of what mends two shapes."""
    return f"{one} and {other}"


def _both(one: dict, other: dict) -> dict:
    return {term: one.get(term, 0) + other.get(term, 0) for term in dict.fromkeys([*one, *other])}


def correctives(body: Body, recipes: dict, moves: dict[str, np.ndarray]) -> list[MadeCorrective]:
    """Those of one person: the same for everybody, in the same order.

    recipes: of every shape by name; moves: where each leads at full, (V, 3) in centimetres.
    """
    neutral = body.positions(body.shaper.neutral)

    def at(recipe: dict) -> np.ndarray:
        return body.positions(body.shaper.shape(recipe)) - neutral

    halves = [
        MadeCorrective(half_way(name), at(half_way_recipe(name, recipes[name])) - 0.5 * moves[name])
        for name in HALF_WAY
        if half_way(name).startswith(f"{name} ")
    ]
    pairs = {
        (one, other): at(_both(recipes[one], recipes[other])) - moves[one] - moves[other]
        for one, other in PAIRS
    }
    blinks = [
        MadeCorrective(
            together(half_way(mood), blink),
            at(_both(half_way_recipe(mood, recipes[mood]), recipes[blink]))
            - at(half_way_recipe(mood, recipes[mood]))
            - moves[blink]
            - 0.5 * pairs[mood, blink],
        )
        for mood, blink in HALF_WAY_PAIRS
    ]
    closed = at(_both(recipes[JAW], CLOSING)) - moves[JAW] - moves[LIPS]
    named = [MadeCorrective(together(*pair), offsets) for pair, offsets in pairs.items()]
    return [*halves, *named, *blinks, MadeCorrective(LIPS_ON_JAW, closed / JAW_SHARE)]
