"""MakeHuman's macro model: one body shape from sex, age, build and descent."""

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from .source import BASE_VERTICES, Source

# Where on the 0..1 sliders MakeHuman's measured bodies sit; between them it blends linearly.
GENDER = {"female": 0.0, "male": 1.0}
AGE = {"baby": 0.0, "child": 0.1875, "young": 0.5, "old": 1.0}
MUSCLE = {"minmuscle": 0.0, "averagemuscle": 0.5, "maxmuscle": 1.0}
WEIGHT = {"minweight": 0.0, "averageweight": 0.5, "maxweight": 1.0}
PROPORTIONS = {"uncommonproportions": 0.0, "average": 0.5, "idealproportions": 1.0}


@dataclass(frozen=True)
class Phenotype:
    """Macro sliders, 0..1; age 0.5 is 25 years and 1 is 90."""

    gender: float = 0.5
    age: float = 0.5
    muscle: float = 0.5
    weight: float = 0.5
    proportions: float = 0.7
    descent: dict = field(default_factory=lambda: {"caucasian": 1.0})

    def descent_weights(self) -> dict:
        total = sum(self.descent.values())
        return {name: share / total for name, share in self.descent.items()}


def blend(value: float, anchors: dict) -> dict:
    """Piecewise linear weights of the two anchors around `value`; zero weights are left out."""
    names, places = list(anchors), list(anchors.values())
    value = min(max(value, places[0]), places[-1])
    for i in range(len(names) - 1):
        if places[i] <= value <= places[i + 1]:
            t = (value - places[i]) / (places[i + 1] - places[i])
            pair = {names[i]: 1 - t, names[i + 1]: t}
            return {name: weight for name, weight in pair.items() if weight > 0}
    raise ValueError(f"no anchors around {value}")


def body_offsets(source: Source, body: Phenotype) -> np.ndarray:
    """Offsets (19158, 3) from the base mesh; height is left at the average."""
    total = np.zeros((BASE_VERTICES, 3))
    genders, ages = blend(body.gender, GENDER), blend(body.age, AGE)
    descent = body.descent_weights()
    for (people, a), (sex, b), (age, c) in product(descent.items(), genders.items(), ages.items()):
        total += a * b * c * source.target(f"macrodetails/{people}-{sex}-{age}")
    builds = product(
        genders.items(), ages.items(), blend(body.muscle, MUSCLE).items(), blend(body.weight, WEIGHT).items()
    )
    for (sex, a), (age, b), (muscle, c), (weight, d) in builds:
        share, name = a * b * c * d, f"{sex}-{age}-{muscle}-{weight}"
        total += share * source.target(f"macrodetails/universal-{name}")
        for proportions, e in blend(body.proportions, PROPORTIONS).items():
            if proportions != "average":
                total += share * e * source.target(f"macrodetails/proportions/{name}-{proportions}")
    return total
