"""The Facial Action Coding System: units by number, prototypes of emotions, and units as text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from facemorph.core.pose import parsed_weight
from facemorph.core.rig import Rig
from facemorph.errors import OptionError, UnknownNameError

# Table 2.1 of the thesis, in its order; the other units of a face follow.
TABLE_2_1 = (1, 2, 4, 5, 6, 9, 10, 12, 14, 15, 16, 17, 20, 23, 26)

# Happy and sad as in the thesis (2.1.2); the others after the FACS Investigator's Guide
# (Ekman, Friesen and Hager 2002).
PROTOTYPES: Mapping[str, tuple[int, ...]] = MappingProxyType(
    {
        "happy": (6, 12),
        "sad": (1, 4, 15, 23),
        "angry": (4, 5, 7, 23),
        "surprised": (1, 2, 5, 26),
        "disgusted": (9, 15, 16),
        "afraid": (1, 2, 4, 5, 20, 26),
    }
)
# The scoring letters of FACS, from a trace to the maximum.
INTENSITIES: Mapping[str, float] = MappingProxyType({"A": 0.2, "B": 0.4, "C": 0.6, "D": 0.8, "E": 1.0})

_TERM = re.compile(r"(?:AU)?\s*([LR]?)\s*(\d{1,2})\s*(?:([A-E])|\(\s*([^()]*?)\s*\))?", re.IGNORECASE)
_LONGEST_TEXT = 2000


@dataclass(frozen=True)
class Sides:
    """A unit's weight on the person's own left and right side of the face."""

    left: float
    right: float

    @classmethod
    def both(cls, weight: float) -> Sides:
        """The same on both sides."""
        return cls(weight, weight)

    @property
    def weight(self) -> float:
        """The mean of both sides."""
        return (self.left + self.right) / 2.0


def units_of(rig: Rig) -> tuple[int, ...]:
    """The numbers of the units that `rig` has: those of table 2.1 first, then by number."""
    numbers = {int(s.name[2:]) for s in rig.shapes if re.fullmatch(r"AU\d{1,2}", s.name)}
    return (*(n for n in TABLE_2_1 if n in numbers), *sorted(numbers - set(TABLE_2_1)))


def prototype(emotion: str, available: tuple[int, ...]) -> dict[int, Sides]:
    """The units of an emotion at weight 1, those that the face has. Raises `UnknownNameError`."""
    if emotion not in PROTOTYPES:
        raise UnknownNameError("prototype", emotion, PROTOTYPES)
    return {number: Sides.both(1.0) for number in PROTOTYPES[emotion] if number in available}


def units_text(units: Mapping[int, Sides]) -> str:
    """Units as FACS writes them: "AU1+4+15"; other weights in brackets, one-sided units with L or R."""
    terms: list[str] = []
    for number, sides in sorted(units.items()):
        if sides.left == sides.right:
            terms.append(_term("", number, sides.left))
        else:
            terms += [_term("L", number, sides.left), _term("R", number, sides.right)]
    shown = [term for term in terms if term]
    return "AU" + "+".join(shown) if shown else ""


def _term(side: str, number: int, weight: float) -> str:
    if weight == 0.0:
        return ""
    return f"{side}{number}" if weight == 1.0 else f"{side}{number}({weight:.12g})"


def parsed_units(
    text: str, available: tuple[int, ...], present: Mapping[int, Sides] = MappingProxyType({})
) -> dict[int, Sides]:
    """Units from text such as "AU1+4+15", "6C+12E", "L12(0.4)", put on top of the `present` ones.

    Raises `OptionError`, `PoseError`, `UnknownNameError`.
    """
    if len(text) > _LONGEST_TEXT:
        raise OptionError(f"units are a short text as AU1+4+15; this one has {len(text):,} letters.")
    units = dict(present)
    for part in text.split("+") if text.strip() else []:
        match = _TERM.fullmatch(part.strip())
        if match is None:
            raise OptionError(
                f"{part.strip()!r} is no FACS unit. Units are written AU1+4+15, 12C or L12(0.5)."
            )
        side, number = match[1].upper(), known_unit(match[2], available)
        weight = _weight(match[3], match[4])
        old = units.get(number, Sides.both(0.0))
        units[number] = Sides(old.left if side == "R" else weight, old.right if side == "L" else weight)
    return units


def known_unit(text: str, available: tuple[int, ...]) -> int:
    """The number of a unit that the face has, from "12" or "AU12". Raises `UnknownNameError`."""
    digits = re.fullmatch(r"(?:AU)?0*(\d{1,2})", text.strip(), re.IGNORECASE)
    if digits is None or int(digits[1]) not in available:
        raise UnknownNameError("FACS unit", text.strip(), (str(n) for n in sorted(available)))
    return int(digits[1])


def _weight(letter: str | None, number: str | None) -> float:
    if letter:
        return INTENSITIES[letter.upper()]
    if number is None:
        return 1.0
    return parsed_weight(number, "a unit's weight, as in 12(0.5),")
