"""Expressions, FACS action units and ARKit shapes as weighted sums of the source's units.

A recipe maps 'arkit:NAME' (an ARKit unit) or 'mh:NAME' (a MakeHuman expression unit, blended over
the person's descent) to a weight. A name without a side means both sides. The weights were tuned by
eye until every one of the six people was named right in a blind trial.
"""

import re

EXPRESSIONS = {
    "neutral": {},
    "happy": {
        "sculpt:smile": 1.1,
        "sculpt:cheek": 1.0,
        "sculpt:upper": 0.45,
        "sculpt:part": 0.55,
        "arkit:jawOpen": 0.05,
        "arkit:eyeSquint": 0.62,
        "sculpt:browOuter": 0.08,
    },
    "sad": {
        "sculpt:browInner": 1.45,
        "sculpt:browDown": 0.75,
        "sculpt:browOuter": -0.15,
        "sculpt:frown": 0.92,
        "sculpt:chin": 0.60,
        "sculpt:stretch": 0.10,
        "arkit:eyeBlink": 0.08,
        "arkit:eyeLookDown": 0.38,
        "arkit:eyeSquint": 0.10,
        "sculpt:cheek": 0.15,
    },
    "angry": {
        "sculpt:browDown": 1.3,
        "sculpt:browAngle": 0.85,
        "mh:eye-opened-up": 0.60,
        "arkit:eyeSquint": 0.55,
        "sculpt:sneer": 0.15,
        "mh:nose-dilatation": 1.0,
        "sculpt:press": 1.15,
        "sculpt:chin": 0.30,
        "sculpt:frown": 0.05,
    },
    "surprised": {
        "sculpt:browInner": 1.15,
        "sculpt:browOuter": 1.20,
        "mh:eye-opened-up": 0.80,
        "arkit:eyeWide": 0.2,
        "arkit:jawOpen": 0.70,
        "sculpt:oval": 1.15,
    },
    "disgusted": {
        "sculpt:sneer": 1.34,
        "sculpt:upper": 0.78,
        "sculpt:lower": -0.76,
        "sculpt:browDown": 0.25,
        "sculpt:cheek": 0.8,
        "arkit:eyeSquint": 0.62,
        "sculpt:frown": 0.12,
        "sculpt:chin": 0.42,
        "sculpt:stretch": 0.10,
    },
    "afraid": {
        "sculpt:browInner": 1.6,
        "sculpt:browOuter": 0.80,
        "sculpt:browDown": 0.75,
        "mh:eye-opened-up": 1.20,
        "arkit:eyeWide": 0.25,
        "sculpt:stretch": 0.95,
        "sculpt:frown": 0.12,
        "sculpt:part": 0.55,
        "sculpt:lower": 0.22,
        "sculpt:upper": 0.28,
        "arkit:jawOpen": 0.17,
        "mh:neck-platysma": 0.6,
    },
}

# Brows, lids and gaze are there sooner than the mouth, in disgust the nose and the upper lip, and a fright
# is all over the face at once: half way to an expression these have come LEAD further than half of their way.
LEAD = 0.15
BROWS = ("sculpt:browInner", "sculpt:browOuter", "sculpt:browDown", "sculpt:browAngle")
LIDS = ("mh:eye-opened-up", "arkit:eyeWide", "arkit:eyeSquint", "arkit:eyeBlink", "arkit:eyeLookDown")
LEADERS = {
    "sad": (*BROWS, *LIDS),
    "angry": (*BROWS, *LIDS),
    "surprised": (*BROWS, *LIDS),
    "disgusted": ("sculpt:sneer", "sculpt:upper", "sculpt:lower", "sculpt:cheek", "arkit:eyeSquint"),
    "afraid": (*BROWS, *LIDS, "sculpt:stretch", "sculpt:part", "sculpt:lower"),
}

# Not made: 8, 11, 31-33, 35-37 and 39 (no units that show them well); 51-58 are poses of the head.
FACS = {
    "AU1": ("Inner brow raiser", {"sculpt:browInner": 1.15}),
    "AU2": ("Outer brow raiser", {"sculpt:browOuter": 1.0}),
    "AU4": ("Brow lowerer", {"sculpt:browDown": 1.1, "sculpt:browAngle": 0.35}),
    "AU5": ("Upper lid raiser", {"mh:eye-opened-up": 0.75}),
    "AU6": ("Cheek raiser", {"sculpt:cheek": 1.35, "arkit:eyeSquint": 0.45}),
    "AU7": ("Lid tightener", {"arkit:eyeSquint": 1.0}),
    "AU9": ("Nose wrinkler", {"sculpt:sneer": 1.35}),
    "AU10": ("Upper lip raiser", {"sculpt:upper": 1.0}),
    "AU12": ("Lip corner puller", {"sculpt:smile": 1.0}),
    "AU13": ("Sharp lip puller", {"sculpt:sharp": 1.0}),
    "AU14": ("Dimpler", {"sculpt:dimple": 1.0}),
    "AU15": ("Lip corner depressor", {"sculpt:frown": 1.0}),
    "AU16": ("Lower lip depressor", {"sculpt:lower": 1.0}),
    "AU17": ("Chin raiser", {"sculpt:chin": 1.0}),
    "AU18": ("Lip pucker", {"sculpt:pucker": 1.0}),
    "AU19": ("Tongue show", {"arkit:tongueOut": 1.0, "arkit:jawOpen": 0.35}),
    "AU20": ("Lip stretcher", {"sculpt:stretch": 1.0}),
    "AU21": ("Neck tightener", {"mh:neck-platysma": 0.8}),
    "AU22": ("Lip funneler", {"sculpt:funnel": 1.0}),
    "AU23": ("Lip tightener", {"sculpt:press": 0.8, "sculpt:pucker": 0.12}),
    "AU24": ("Lip presser", {"sculpt:press": 1.1, "sculpt:chin": 0.1}),
    "AU25": ("Lips part", {"sculpt:part": 1.0}),
    "AU26": ("Jaw drop", {"arkit:jawOpen": 0.45, "sculpt:oval": 0.2}),
    "AU27": ("Mouth stretch", {"arkit:jawOpen": 1.0, "sculpt:oval": 0.5}),
    "AU28": ("Lip suck", {"sculpt:rollUpper": 1.0, "sculpt:rollLower": 1.0}),
    "AU29": ("Jaw thrust", {"arkit:jawForward": 1.0}),
    "AU30": ("Jaw sideways", {"arkit:jawLeft": 1.0}),
    "AU34": ("Cheek puff", {"arkit:cheekPuff": 1.0}),
    "AU38": ("Nostril dilator", {"mh:nose-dilatation": 1.8}),
    "AU43": ("Eyes closed", {"arkit:eyeBlink": 1.0}),
    "AU61": ("Eyes turn left", {"arkit:eyeLookOutLeft": 1.0, "arkit:eyeLookInRight": 1.0}),
    "AU62": ("Eyes turn right", {"arkit:eyeLookInLeft": 1.0, "arkit:eyeLookOutRight": 1.0}),
    "AU63": ("Eyes up", {"arkit:eyeLookUp": 1.0}),
    "AU64": ("Eyes down", {"arkit:eyeLookDown": 1.0}),
}

# ARKit's own names for sculpted fields, by stem; a side is carried over. Other shapes are the source's.
ARKIT_SCULPTED = {
    "browDown": {"sculpt:browDown": 1.1, "sculpt:browAngle": 0.35},
    "browInnerUp": {"sculpt:browInner": 1.0},
    "browOuterUp": {"sculpt:browOuter": 1.0},
    "cheekSquint": {"sculpt:cheek": 1.2, "arkit:eyeSquint": 0.1},
    "mouthDimple": {"sculpt:dimple": 1.0},
    "mouthFrown": {"sculpt:frown": 1.0},
    "mouthFunnel": {"sculpt:funnel": 1.0},
    "mouthLowerDown": {"sculpt:lower": 1.0},
    "mouthPress": {"sculpt:press": 1.0},
    "mouthPucker": {"sculpt:pucker": 1.0},
    "mouthRollLower": {"sculpt:rollLower": 1.0},
    "mouthRollUpper": {"sculpt:rollUpper": 1.0},
    "mouthShrugLower": {"sculpt:chin": 1.0},
    "mouthSmile": {"sculpt:smile": 1.0},
    "mouthStretch": {"sculpt:stretch": 1.0},
    "mouthUpperUp": {"sculpt:upper": 1.0},
    "noseSneer": {"sculpt:sneer": 1.0},
}

ARKIT_LABELS = {
    "browDown": "Brow down",
    "browInnerUp": "Inner brows up",
    "browOuterUp": "Outer brow up",
    "cheekPuff": "Cheeks puffed",
    "cheekSquint": "Cheek raised",
    "eyeBlink": "Eye closed",
    "eyeLookDown": "Eye looks down",
    "eyeLookIn": "Eye looks inwards",
    "eyeLookOut": "Eye looks outwards",
    "eyeLookUp": "Eye looks up",
    "eyeSquint": "Eye squints",
    "eyeWide": "Eye wide open",
    "jawForward": "Jaw forward",
    "jawLeft": "Jaw to the left",
    "jawOpen": "Jaw open",
    "jawRight": "Jaw to the right",
    "mouthClose": "Lips together on an open jaw",
    "mouthDimple": "Mouth corner dimple",
    "mouthFrown": "Mouth corner down",
    "mouthFunnel": "Lips funnelled",
    "mouthLeft": "Mouth to the left",
    "mouthLowerDown": "Lower lip down",
    "mouthPress": "Lips pressed",
    "mouthPucker": "Lips puckered",
    "mouthRight": "Mouth to the right",
    "mouthRollLower": "Lower lip rolled in",
    "mouthRollUpper": "Upper lip rolled in",
    "mouthShrugLower": "Lower lip pushed up",
    "mouthShrugUpper": "Upper lip pushed up",
    "mouthSmile": "Mouth corner up",
    "mouthStretch": "Mouth corner stretched",
    "mouthUpperUp": "Upper lip up",
    "noseSneer": "Nose wrinkled",
    "tongueOut": "Tongue out",
}


# Lips that close on a jaw that is not open have nowhere to go: by itself mouthClose is this much of its way,
# and the rest comes with the jaw, see correctives.py.
CLOSING = {"arkit:mouthClose": 1.0}
CLOSING_ALONE = 0.25


def half_way_recipe(name: str, recipe: dict) -> dict:
    """What a shape is half way: half of its recipe, with more of what leads."""
    leaders = LEADERS.get(name, ())
    return {term: weight * (0.5 + LEAD * (term in leaders)) for term, weight in recipe.items()}


def arkit_recipe(name: str) -> dict:
    """What makes an ARKit shape: sculpted fields of its side, or the source's own unit."""
    stem, side = re.fullmatch(r"(\w+?)(Left|Right|)", name).groups()
    if name == "mouthClose":
        return {term: CLOSING_ALONE * weight for term, weight in CLOSING.items()}
    if stem not in ARKIT_SCULPTED:
        return {f"arkit:{name}": 1.0}
    return {term + side: weight for term, weight in ARKIT_SCULPTED[stem].items()}


def arkit_label(name: str) -> str:
    """'mouthSmileLeft' -> 'Mouth corner up, left'; jawLeft and mouthLeft are directions, not sides."""
    if name in ARKIT_LABELS:
        return ARKIT_LABELS[name]
    stem, side = re.fullmatch(r"(\w+)(Left|Right)", name).groups()
    return f"{ARKIT_LABELS[stem]}, {side.lower()}"
