"""How a sculpted field is described; fields_mouth.py and fields_face.py list them.

Numbers are decimetres on the base head, at full strength. The head is 2.2 high; a mouth corner sits at
(0.27, 6.61), an alar wing at (0.17, 6.86), a cheek's apple at (0.42, 6.98), a pupil at (0.32, 7.29).
"""

from dataclasses import dataclass

# Heights (y) between which a domain's fields act.
DOMAINS = {"mouth": (6.02, 7.20), "cheeks": (6.35, 7.26), "nose": (6.30, 7.62), "brows": (7.26, 8.12)}


@dataclass(frozen=True)
class Fold:
    """A furrow along points (x, y) of the left side; across it runs a wave along the skin's normal.

    The wave is -height at the line and rises to +height about `width` to the line's left (walking).
    """

    line: tuple
    height: float
    width: float


@dataclass(frozen=True)
class Field:
    """Moves (dx, dy, dz) with dx outwards, given for the left side and mirrored.

    corner: the mouth's corner; None leaves the lips free.
    upper, lower: moves of the lines where the lips meet, by place: 0 middle to 1 corner.
    upper_roll, lower_roll: what the red's edge moves beyond its line, by place.
    skin: (x, y) -> move of the outside there. slides: the same for skin over bone: (dx, dy, lift).
    bulges: (x, y, radius x, radius y, height) along the skin's normal. folds: see Fold.
    domain: where the field acts at all.
    """

    corner: tuple | None = None
    upper: dict | None = None
    lower: dict | None = None
    upper_roll: dict | None = None
    lower_roll: dict | None = None
    skin: dict | None = None
    slides: dict | None = None
    bulges: tuple = ()
    folds: tuple = ()
    domain: str = "mouth"
