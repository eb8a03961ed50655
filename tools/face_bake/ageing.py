"""How old a person's skin looks."""

import numpy as np

from .people import Person

# MakeHuman's ages: 0.5 is 25 years, 1 is 90.
YOUNG_UNTIL, OLD_FROM = 0.5, 0.72


def age_of(person: Person) -> float:
    """0 young to 1 old."""
    return float(np.clip((person.body.age - YOUNG_UNTIL) / (OLD_FROM - YOUNG_UNTIL), 0, 1))
