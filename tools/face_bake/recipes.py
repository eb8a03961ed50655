"""Expressions, FACS action units and ARKit shapes as weighted sums of the source's units.

A recipe maps 'arkit:NAME' (an ARKit unit) or 'mh:NAME' (a MakeHuman expression unit, blended over
the person's descent) to a weight. A name without a side means both sides. The weights were tuned by
eye until every one of the six people was named right in a blind trial.
"""

import re

EXPRESSIONS = {
    "neutral": {},
    "happy": {
        "arkit:cheekSquint": 0.8, "arkit:eyeSquint": 0.20, "mh:mouth-upward-retraction": 0.70,
        "mh:mouth-corner-puller": 0.45, "arkit:mouthUpperUp": 0.60, "arkit:browOuterUp": 0.10,
        "arkit:browInnerUp": 0.10, "mh:eyebrows-up": 0.10,
    },
    "sad": {
        "mh:eyebrows-inner-up": 1.25, "arkit:browInnerUp": 1.0, "mh:eyebrows-down": 0.35,
        "mh:eyebrows-extern-up": -0.35, "arkit:mouthFrown": 1.0, "mh:mouth-depression": 0.75,
        "arkit:mouthShrugLower": 0.55, "arkit:eyeBlink": 0.16, "arkit:eyeLookDown": 0.45,
        "arkit:cheekSquint": 0.12,
    },
    "angry": {
        "mh:eyebrows-down": 1.35, "arkit:browDown": 0.7, "mh:eyebrows-extern-up": 0.15,
        "mh:eye-opened-up": 0.45,
        "arkit:eyeSquint": 0.45, "arkit:noseSneer": 0.5, "mh:nose-dilatation": 1.0, "mh:nose-elevation": 0.25,
        "arkit:mouthPress": 0.7, "mh:mouth-depression": 0.55, "arkit:mouthRollUpper": 0.30,
        "arkit:mouthRollLower": 0.15, "arkit:mouthShrugLower": 0.4,
    },
    "surprised": {
        "mh:eyebrows-up": 0.85, "arkit:browInnerUp": 1.3, "mh:eyebrows-inner-up": 0.55,
        "arkit:browOuterUp": 0.45,
        "mh:eye-opened-up": 1.0, "arkit:eyeWide": 0.3, "arkit:jawOpen": 0.66, "arkit:mouthFunnel": 0.12,
    },
    "disgusted": {
        "arkit:noseSneer": 1.1, "mh:nose-elevation": 1.1, "mh:nose-compression": 1.2, "mh:eyebrows-down": 0.7,
        "arkit:browDown": 0.45, "mh:mouth-elevation": 0.75, "arkit:mouthUpperUp": 0.35,
        "arkit:mouthFrown": 0.55,
        "arkit:mouthShrugLower": 0.3, "arkit:eyeSquint": 0.75, "arkit:cheekSquint": 0.55,
        "arkit:mouthLowerDown": 0.2,
    },
    "afraid": {
        "mh:eyebrows-inner-up": 1.3, "arkit:browInnerUp": 1.3, "mh:eyebrows-up": 0.30,
        "mh:eyebrows-down": 0.35,
        "mh:eye-opened-up": 1.05, "arkit:eyeWide": 0.3, "arkit:mouthStretch": 1.1, "arkit:mouthFrown": 0.55,
        "arkit:mouthLowerDown": 0.7, "mh:mouth-depression-retraction": 0.15, "arkit:jawOpen": 0.30,
        "mh:neck-platysma": 0.45,
    },
}

# Not made: 8, 11, 31-33, 35-37 and 39 (no units that show them well); 51-58 are poses of the head.
FACS = {
    "AU1": ("Inner brow raiser", {"mh:eyebrows-inner-up": 0.9, "arkit:browInnerUp": 0.6}),
    "AU2": ("Outer brow raiser", {"mh:eyebrows-extern-up": 0.55, "arkit:browOuterUp": 0.55}),
    "AU4": ("Brow lowerer", {"mh:eyebrows-down": 1.0, "arkit:browDown": 0.45}),
    "AU5": ("Upper lid raiser", {"mh:eye-opened-up": 0.75}),
    "AU6": ("Cheek raiser", {"arkit:cheekSquint": 1.0}),
    "AU7": ("Lid tightener", {"arkit:eyeSquint": 1.0}),
    "AU9": ("Nose wrinkler", {"arkit:noseSneer": 1.0, "mh:nose-elevation": 0.8, "mh:nose-compression": 1.0}),
    "AU10": ("Upper lip raiser", {"arkit:mouthUpperUp": 1.0}),
    "AU12": ("Lip corner puller", {"mh:mouth-corner-puller": 1.0}),
    "AU13": ("Sharp lip puller", {"mh:mouth-compression": 1.0}),
    "AU14": ("Dimpler", {"arkit:mouthDimple": 1.0}),
    "AU15": ("Lip corner depressor", {"arkit:mouthFrown": 1.0, "mh:mouth-depression": 0.35}),
    "AU16": ("Lower lip depressor", {"arkit:mouthLowerDown": 1.0}),
    "AU17": ("Chin raiser", {"arkit:mouthShrugLower": 1.0}),
    "AU18": ("Lip pucker", {"arkit:mouthPucker": 1.0}),
    "AU19": ("Tongue show", {"arkit:tongueOut": 1.0, "arkit:jawOpen": 0.35}),
    "AU20": ("Lip stretcher", {"mh:mouth-retraction": 0.6, "arkit:mouthStretch": 0.7}),
    "AU21": ("Neck tightener", {"mh:neck-platysma": 0.8}),
    "AU22": ("Lip funneler", {"arkit:mouthFunnel": 1.0}),
    "AU23": ("Lip tightener",
             {"arkit:mouthPress": 0.6, "arkit:mouthRollUpper": 0.35, "arkit:mouthRollLower": 0.35}),
    "AU24": ("Lip presser", {"arkit:mouthPress": 1.0}),
    "AU25": ("Lips part", {"mh:mouth-parling": 1.0}),
    "AU26": ("Jaw drop", {"arkit:jawOpen": 0.45}),
    "AU27": ("Mouth stretch", {"arkit:jawOpen": 1.0}),
    "AU28": ("Lip suck", {"arkit:mouthRollUpper": 1.0, "arkit:mouthRollLower": 1.0}),
    "AU29": ("Jaw thrust", {"arkit:jawForward": 1.0}),
    "AU30": ("Jaw sideways", {"arkit:jawLeft": 1.0}),
    "AU34": ("Cheek puff", {"arkit:cheekPuff": 1.0}),
    "AU38": ("Nostril dilator", {"mh:nose-dilatation": 1.0}),
    "AU43": ("Eyes closed", {"arkit:eyeBlink": 1.0}),
    "AU61": ("Eyes turn left", {"arkit:eyeLookOutLeft": 1.0, "arkit:eyeLookInRight": 1.0}),
    "AU62": ("Eyes turn right", {"arkit:eyeLookInLeft": 1.0, "arkit:eyeLookOutRight": 1.0}),
    "AU63": ("Eyes up", {"arkit:eyeLookUp": 1.0}),
    "AU64": ("Eyes down", {"arkit:eyeLookDown": 1.0}),
}

ARKIT_LABELS = {
    "browDown": "Brow down", "browInnerUp": "Inner brows up", "browOuterUp": "Outer brow up",
    "cheekPuff": "Cheeks puffed", "cheekSquint": "Cheek raised", "eyeBlink": "Eye closed",
    "eyeLookDown": "Eye looks down", "eyeLookIn": "Eye looks inwards", "eyeLookOut": "Eye looks outwards",
    "eyeLookUp": "Eye looks up", "eyeSquint": "Eye squints", "eyeWide": "Eye wide open",
    "jawForward": "Jaw forward", "jawLeft": "Jaw to the left", "jawOpen": "Jaw open",
    "jawRight": "Jaw to the right", "mouthClose": "Lips together on an open jaw",
    "mouthDimple": "Mouth corner dimple",
    "mouthFrown": "Mouth corner down", "mouthFunnel": "Lips funnelled", "mouthLeft": "Mouth to the left",
    "mouthLowerDown": "Lower lip down", "mouthPress": "Lips pressed", "mouthPucker": "Lips puckered",
    "mouthRight": "Mouth to the right", "mouthRollLower": "Lower lip rolled in",
    "mouthRollUpper": "Upper lip rolled in", "mouthShrugLower": "Lower lip pushed up",
    "mouthShrugUpper": "Upper lip pushed up", "mouthSmile": "Mouth corner up",
    "mouthStretch": "Mouth corner stretched",
    "mouthUpperUp": "Upper lip up", "noseSneer": "Nose wrinkled", "tongueOut": "Tongue out",
}


def arkit_label(name: str) -> str:
    """'mouthSmileLeft' -> 'Mouth corner up, left'; jawLeft and mouthLeft are directions, not sides."""
    if name in ARKIT_LABELS:
        return ARKIT_LABELS[name]
    stem, side = re.fullmatch(r"(\w+)(Left|Right)", name).groups()
    return f"{ARKIT_LABELS[stem]}, {side.lower()}"
