"""The six people: body, local shapes, colouring and hair.

Colours are sRGB, 0..1. The local shapes are MakeHuman targets; a name without a side means both.
"""

from dataclasses import dataclass, field

from .phenotype import Phenotype

# MakeHuman's young adults part their lips and lower their brows; this closes and lifts them.
REST = {"mh:mouth-parling": -0.30, "arkit:browInnerUp": 0.32, "mh:eyebrows-up": 0.10}
# The men's inner brows already sit high and their lids low: lifting those more would look worried.
REST_OF_MEN = {
    "mh:mouth-parling": -0.30,
    "arkit:browInnerUp": 0.12,
    "mh:eyebrows-up": 0.16,
    "mh:eyebrows-extern-up": 0.18,
    "mh:eye-opened-up": 0.35,
    "arkit:eyeWide": 0.22,
}


@dataclass(frozen=True)
class Look:
    """Everything the textures need to know; iris_ring is the iris's colour around the pupil."""

    skin: tuple
    lips: tuple
    hair: tuple
    brow: tuple
    iris: tuple
    iris_ring: tuple
    iris_seed: int
    hair_style: str = "side part"
    feminine: bool = False
    hair_strength: float = 0.97
    brow_thickness: float = 1.0
    brow_arch: float = 0.0
    brow_inner: float = 0.0
    brow_density: float = 1.0
    lash_length: float = 1.0
    lash_density: float = 1.0
    lip_strength: float = 0.80
    lid: tuple = (0.90, 0.78, 0.76)
    blush: float = 1.0
    freckles: float = 0.0
    stubble: float = 0.0
    tooth_age: float = 0.0
    gum_pigment: float = 0.0


@dataclass(frozen=True)
class Person:
    """One identity; `rest` is added to the body to give its neutral."""

    id: str
    name: str
    description: str
    body: Phenotype
    look: Look
    details: dict = field(default_factory=dict)
    rest: dict = field(default_factory=lambda: REST)


ADA = Person(
    "ada",
    "Ada",
    "A young woman with fair, freckled skin, brown hair parted at the side and blue-grey eyes.",
    Phenotype(gender=0.0, weight=0.48, proportions=1.0, descent={"caucasian": 1.0}),
    Look(
        skin=(0.90, 0.72, 0.62),
        lips=(0.75, 0.44, 0.42),
        hair=(0.26, 0.15, 0.09),
        brow=(0.25, 0.15, 0.10),
        iris=(0.39, 0.46, 0.505),
        iris_ring=(0.47, 0.44, 0.35),
        iris_seed=11,
        hair_style="side part",
        feminine=True,
        brow_thickness=0.85,
        lash_length=1.15,
        brow_arch=0.012,
        freckles=0.5,
    ),
    {
        "mouth/mouth-upperlip-volume-incr": 0.5,
        "mouth/mouth-lowerlip-volume-incr": 0.4,
        "nose/nose-scale-horiz-decr": 0.35,
        "nose/nose-hump-decr": 0.3,
        "head/head-oval": 0.4,
        "mouth/mouth-angles-up": 0.25,
        "nose/nose-point-up": 0.15,
        "chin/chin-height-incr": 0.18,
        "chin/chin-triangle": 0.3,
        "forehead/forehead-scale-vert-decr": 0.2,
    },
    rest={**REST, "arkit:eyeWide": -0.12},
)
BEN = Person(
    "ben",
    "Ben",
    "A man of about thirty with fair skin, short brown hair, stubble and hazel eyes.",
    Phenotype(
        gender=1.0, age=0.56, muscle=0.55, proportions=0.9, descent={"caucasian": 0.85, "african": 0.15}
    ),
    Look(
        skin=(0.84, 0.66, 0.56),
        lips=(0.70, 0.42, 0.39),
        hair=(0.17, 0.11, 0.08),
        brow=(0.17, 0.11, 0.08),
        iris=(0.34, 0.315, 0.215),
        iris_ring=(0.43, 0.29, 0.14),
        iris_seed=12,
        hair_style="quiff",
        brow_thickness=1.15,
        brow_density=1.1,
        lash_length=0.8,
        lash_density=0.8,
        brow_arch=-0.006,
        stubble=0.75,
        blush=0.7,
        tooth_age=0.35,
    ),
    {
        "nose/nose-scale-vert-decr": 0.3,
        "head/head-square": 0.35,
        "mouth/mouth-angles-up": 0.2,
        "chin/chin-width-incr": 0.2,
    },
    rest=REST_OF_MEN,
)
MEI = Person(
    "mei",
    "Mei",
    "A young woman with light skin, a black bob with a fringe and dark brown eyes.",
    Phenotype(gender=0.05, muscle=0.45, proportions=1.0, descent={"asian": 1.0}),
    Look(
        skin=(0.91, 0.75, 0.62),
        lips=(0.75, 0.44, 0.41),
        hair=(0.06, 0.05, 0.05),
        brow=(0.10, 0.07, 0.06),
        iris=(0.22, 0.125, 0.07),
        iris_ring=(0.31, 0.17, 0.085),
        iris_seed=13,
        hair_style="fringe bob",
        feminine=True,
        brow_thickness=0.8,
        brow_density=0.9,
        lash_length=0.95,
        lash_density=0.9,
        brow_arch=0.004,
    ),
    {
        "mouth/mouth-angles-up": 0.25,
        "head/head-oval": 0.3,
        "mouth/mouth-upperlip-volume-incr": 0.3,
        "chin/chin-height-incr": 0.2,
        "forehead/forehead-scale-vert-decr": 0.15,
    },
)
KOFI = Person(
    "kofi",
    "Kofi",
    "A young man with dark brown skin, black cropped hair and dark eyes.",
    Phenotype(gender=1.0, muscle=0.6, proportions=1.0, descent={"african": 1.0}),
    Look(
        skin=(0.42, 0.27, 0.19),
        lips=(0.385, 0.215, 0.180),
        hair=(0.05, 0.04, 0.035),
        brow=(0.05, 0.035, 0.03),
        iris=(0.165, 0.095, 0.06),
        iris_ring=(0.23, 0.125, 0.065),
        iris_seed=14,
        hair_style="fade",
        hair_strength=0.93,
        gum_pigment=0.75,
        brow_thickness=1.05,
        brow_density=1.15,
        lash_length=0.8,
        lash_density=0.9,
        lip_strength=0.7,
        lid=(0.88, 0.84, 0.82),
        stubble=0.35,
    ),
    {"mouth/mouth-angles-up": 0.35},
    rest={**REST_OF_MEN, "sculpt:browInner": 0.16},
)
ZOLA = Person(
    "zola",
    "Zola",
    "A young woman with brown skin, a round head of black coils and brown eyes.",
    Phenotype(gender=0.0, weight=0.48, proportions=1.0, descent={"african": 0.8, "caucasian": 0.2}),
    Look(
        skin=(0.52, 0.34, 0.25),
        lips=(0.465, 0.240, 0.215),
        hair=(0.055, 0.04, 0.035),
        brow=(0.06, 0.04, 0.03),
        iris=(0.19, 0.105, 0.06),
        iris_ring=(0.28, 0.155, 0.075),
        iris_seed=15,
        hair_style="afro",
        feminine=True,
        brow_thickness=0.85,
        lash_length=1.15,
        lash_density=1.1,
        brow_arch=0.012,
        lip_strength=0.72,
        gum_pigment=0.55,
        lid=(0.88, 0.82, 0.80),
    ),
    {
        "mouth/mouth-angles-up": 0.25,
        "chin/chin-height-incr": 0.2,
        "forehead/forehead-scale-vert-decr": 0.15,
    },
    rest={**REST, "arkit:eyeWide": -0.25},
)
OMAR = Person(
    "omar",
    "Omar",
    "A man past fifty with tanned skin, short receding grey hair, stubble and brown eyes.",
    Phenotype(gender=0.95, age=0.72, weight=0.55, descent={"caucasian": 0.6, "asian": 0.25, "african": 0.15}),
    Look(
        skin=(0.74, 0.55, 0.43),
        lips=(0.62, 0.36, 0.33),
        hair=(0.42, 0.40, 0.39),
        brow=(0.20, 0.175, 0.155),
        iris=(0.27, 0.19, 0.115),
        iris_ring=(0.36, 0.235, 0.12),
        iris_seed=16,
        hair_style="receding",
        brow_thickness=1.2,
        lash_length=0.75,
        lash_density=0.75,
        stubble=0.6,
        blush=0.6,
        tooth_age=1.0,
        gum_pigment=0.2,
    ),
    {"mouth/mouth-angles-up": 0.2},
    rest=REST_OF_MEN,
)
PEOPLE = {person.id: person for person in (ADA, BEN, MEI, KOFI, ZOLA, OMAR)}
