"""Which shapes show which wrinkles, and how strongly."""

from dataclasses import dataclass, field

from . import wrinkle_strokes as strokes
from .correctives import MOODS, half_way

# Skin that is pushed together buckles, and its furrows deepen with the root of the push: half way they have
# 0.7 of their depth. The expressions' half ways add what the straight way lacks of that.
BUCKLED = 0.2
RED, GREEN, BLUE = range(3)
SET_NAMES = ("red", "green", "blue")


@dataclass(frozen=True)
class Rule:
    """A wrinkle of both sides.

    shapes   name -> gain; `sided` names get Left or Right behind them
    ageing   what an old face shows of it at rest
    young    what part of each gain a young face shows
    crosses  whether it runs over the middle of the face, so that its sides meet there
    split    where the area begins and ends, as parts of the picture from its middle, for strokes that
             two rules share; `paints` tells which of them draws them
    bumps    s, y and radii of a field of dimples
    soft     how wide the area's border is, in parts of the picture
    """

    name: str
    set: int
    strokes: tuple
    shapes: dict
    sided: dict = field(default_factory=dict)
    ageing: float = 0.0
    young: float = 1.0
    crosses: bool = False
    split: tuple | None = None
    paints: bool = True
    bumps: tuple | None = None
    soft: float = 0.016


RULES = (
    Rule(
        "forehead, inner",
        RED,
        strokes.FOREHEAD,
        {"AU1": 0.95, "AU2": 0.30, "surprised": 0.90, "afraid": 0.85, "sad": 0.60, "browInnerUp": 0.95},
        {"browOuterUp": 0.30},
        ageing=0.30,
        split=(0.0, 0.085),
        soft=0.05,
    ),
    Rule(
        "forehead, outer",
        RED,
        strokes.FOREHEAD,
        {"AU2": 1.0, "AU1": 0.25, "surprised": 0.90, "afraid": 0.45, "sad": 0.10, "browInnerUp": 0.25},
        {"browOuterUp": 1.0},
        ageing=0.24,
        split=(0.085, 0.26),
        soft=0.05,
    ),
    Rule(
        "frown",
        GREEN,
        strokes.FROWN,
        {"AU4": 1.0, "AU9": 0.35, "angry": 1.0, "disgusted": 0.25, "sad": 0.55, "afraid": 0.55},
        {"browDown": 1.0, "noseSneer": 0.35},
        ageing=0.30,
        young=0.70,
        crosses=True,
    ),
    Rule(
        "crow's feet",
        GREEN,
        strokes.CROWS_FEET,
        {"AU6": 1.0, "AU7": 0.35, "AU12": 0.25, "AU9": 0.25, "happy": 0.95, "disgusted": 0.50, "angry": 0.20},
        {"cheekSquint": 1.0, "eyeSquint": 0.40, "mouthSmile": 0.25},
        ageing=0.34,
        young=0.35,
    ),
    Rule(
        "nose",
        BLUE,
        strokes.NOSE,
        {"AU9": 1.0, "AU10": 0.15, "disgusted": 1.0, "angry": 0.30},
        {"noseSneer": 1.0},
        ageing=0.06,
        crosses=True,
    ),
    Rule(
        "nasolabial",
        GREEN,
        strokes.NASOLABIAL,
        {
            "AU10": 0.80, "AU12": 0.90, "AU9": 0.65, "AU6": 0.30, "AU13": 0.60, "AU14": 0.35, "AU20": 0.30,
            "happy": 0.95, "disgusted": 0.85, "angry": 0.20, "sad": 0.25, "afraid": 0.20,
        },
        {"mouthSmile": 0.90, "mouthUpperUp": 0.80, "noseSneer": 0.65, "cheekSquint": 0.30,
         "mouthStretch": 0.30, "mouthDimple": 0.35},
        ageing=0.42,
        young=0.5,
    ),
    Rule(
        "smile lines",
        BLUE,
        strokes.SMILE,
        {"AU12": 0.80, "AU13": 0.50, "AU14": 0.90, "AU20": 0.40, "happy": 0.85, "afraid": 0.30},
        {"mouthSmile": 0.80, "mouthDimple": 0.90, "mouthStretch": 0.40},
        ageing=0.08,
    ),
    Rule(
        "corners down",
        RED,
        strokes.MARIONETTE,
        {"AU15": 1.0, "AU17": 0.20, "AU20": 0.30, "sad": 0.80, "disgusted": 0.35, "angry": 0.30,
         "afraid": 0.30},
        {"mouthFrown": 1.0, "mouthStretch": 0.30},
        ageing=0.38,
    ),
    Rule(
        "chin",
        GREEN,
        strokes.CHIN,
        {"AU17": 1.0, "AU15": 0.25, "AU24": 0.30, "sad": 0.60, "angry": 0.45, "disgusted": 0.40,
         "mouthShrugLower": 1.0},
        {"mouthPress": 0.15, "mouthFrown": 0.25},
        crosses=True,
        bumps=(0.0, 6.30, 0.17, 0.085),
    ),
    Rule(
        "purse",
        RED,
        strokes.PURSE,
        {"AU18": 1.0, "AU22": 0.40, "AU23": 0.60, "AU24": 0.55, "AU28": 0.50, "angry": 0.12,
         "mouthPucker": 1.0, "mouthFunnel": 0.40, "mouthRollUpper": 0.40, "mouthShrugUpper": 0.40},
        {"mouthPress": 0.28},
        ageing=0.08,
        young=0.4,
        crosses=True,
    ),
)  # fmt: skip
# The second of two rules that share strokes must not paint them again.
RULES = tuple(
    rule if not any(rule.strokes is other.strokes for other in RULES[:k]) else
    Rule(**{**rule.__dict__, "paints": False})
    for k, rule in enumerate(RULES)
)  # fmt: skip
RULES = tuple(
    Rule(**{**rule.__dict__, "shapes": rule.shapes | {
        half_way(name): BUCKLED * gain for name, gain in rule.shapes.items() if name in MOODS
    }})
    for rule in RULES
)  # fmt: skip
