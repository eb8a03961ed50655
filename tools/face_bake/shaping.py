"""Turn a person and a recipe into positions of the base mesh's vertices."""

import numpy as np

from .jaw import OPENING, Jaw
from .parts_eyes_lids import BLINK, BLINK_SIDES, BlinkFit, with_lids
from .parts_eyes_rings import LidRings
from .people import Person
from .phenotype import body_offsets
from .sculpt import Sculptor
from .seal import LipSeal
from .source import Source


class Shaper:
    """Shapes of one person in base-mesh space (19158, 3), in decimetres."""

    def __init__(self, source: Source, person: Person, seal: LipSeal, sculptor: Sculptor, lids: LidRings):
        self._source, self._sculptor, self._blink = source, sculptor, None
        self._descent = person.body.descent_weights()
        offsets = body_offsets(source, person.body)
        for name, weight in person.details.items():
            offsets = offsets + weight * self._detail(name)
        offsets = offsets + self.offsets(person.rest)
        self.neutral = lids.thickened(seal.close(source.base.points + offsets))
        self._blink = BlinkFit(source, lids.columns)
        self._jaw = Jaw(self.neutral, self._term("arkit", OPENING))

    def offsets(self, recipe: dict) -> np.ndarray:
        """Sum of a recipe's units, see recipes.py; a blink closes what the others leave open."""
        total = np.zeros_like(self._source.base.points)
        blinks = np.zeros(2)
        for term, weight in with_lids(recipe).items():
            kind, name = term.split(":", 1)
            if self._blink is not None and name.startswith(BLINK):
                blinks += weight * np.array([side.startswith(name) for side in BLINK_SIDES])
            else:
                total += weight * self._term(kind, name)
        if blinks.any():
            total += self._blink.offsets(blinks, self.neutral + total)
        return total

    def shape(self, recipe: dict) -> np.ndarray:
        opening = recipe.get(f"arkit:{OPENING}", 0.0)
        return self.neutral + self.offsets(recipe) + self._jaw.bend(opening)

    def _term(self, kind: str, name: str) -> np.ndarray:
        if kind == "sculpt":
            return self._sculptor.field(name)
        return self._sculptor.soften(self._source.arkit(name) if kind == "arkit" else self._unit(name))

    def _detail(self, name: str) -> np.ndarray:
        if self._source.has_target(name):
            return self._source.target(name)
        folder, leaf = name.split("/")
        return self._source.target(f"{folder}/l-{leaf}") + self._source.target(f"{folder}/r-{leaf}")

    def _unit(self, name: str) -> np.ndarray:
        """A MakeHuman expression unit, blended over the person's descent."""
        total = np.zeros_like(self._source.base.points)
        for people, weight in self._descent.items():
            folder = f"expression/units/{people}/"
            if self._source.has_target(folder + name):
                total += weight * self._source.target(folder + name)
            else:
                for side in ("-left-", "-right-"):
                    total += weight * self._source.target(folder + name.replace("-", side, 1))
        return total
