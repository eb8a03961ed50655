"""Write the text files of a person: OBJ shapes, materials and the description."""

from pathlib import Path

import numpy as np

from .correctives import HALF_WAY, HALF_WAY_PAIRS, JAW, JAW_OVER, LIPS, LIPS_ON_JAW, PAIRS, half_way, together
from .hair_atlas import hair_material
from .head import Head
from .lash_pictures import brow_material, lash_material
from .people import Person
from .skin_pictures import skin_maps_text

CREDIT = "MakeHuman base mesh and targets (MakeHuman team), Face Units 01 (Mika Suominen)"
LICENCE = "CC0-1.0"
# Colour (linear light), shine, exponent and picture.
MATERIALS = {
    "skin": ((1, 1, 1), 0.16, 18, "skin.jpg"),
    "mouth": ((1, 1, 1), 0.16, 18, "skin.jpg"),
    "eye": ((1, 1, 1), 0.9, 180, "eye.jpg"),
    "tear": ((0.80, 0.74, 0.70), 0.9, 250, None),
    "teeth": ((1, 1, 1), 0.5, 60, "teeth.jpg"),
    "gum": ((1, 1, 1), 0.35, 50, "gum.jpg"),
    "tongue": ((1, 1, 1), 0.3, 30, "tongue.jpg"),
    "lash": None,
    "brow": None,
    "hair": None,
    "hair_lock": None,
}
# These have a colour of each person's own; their pictures' opacity lets through what lies behind them.
SEE_THROUGH = ("lash", "brow", "hair", "hair_lock")

# How much below the chin a picture still shows, as a part of the head's height.
NECK = 0.15

# Of materials that let light through.
OPACITY = {"tear": 0.3}


def layout_text(head: Head, *, textured: bool) -> str:
    """Faces, with texture coordinates or without: the same text at the end of every OBJ of every person.

    The neutral alone carries texture coordinates; a shape is its positions, and files stay small.
    """
    lines = [f"vt {u:.4f} {v:.4f}" for u, v in head.uv.tolist()] if textured else []
    for group in head.groups:
        lines += [f"g {group.name}", f"usemtl {group.material}"]
        rows = zip((group.polygons + 1).tolist(), (group.uv_polygons + 1).tolist(), strict=True)
        lines += [_face(corners, uvs, textured=textured) for corners, uvs in rows]
    return "\n".join(lines) + "\n"


def _face(corners: list[int], uvs: list[int], *, textured: bool) -> str:
    pairs = [(corner, uv) for corner, uv in zip(corners, uvs, strict=True) if corner > 0]
    return "f " + " ".join(f"{corner}/{uv}" if textured else str(corner) for corner, uv in pairs)


def write_obj(path: Path, title: str, points: np.ndarray, layout: str):
    """Points (V, 3) in centimetres."""
    head = [
        f"# {title}, facemorph bundled face; centimetres, Y up, looking along +Z",
        f"# {LICENCE}; from {CREDIT}",
        "mtllib face.mtl",
    ]
    # Adding zero turns -0.0 into 0.0, so that rounding never writes "-0.0000".
    rounded = np.round(points, 4) + 0.0
    vertices = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in rounded.tolist()]
    path.write_text("\n".join(head + vertices) + "\n" + layout, encoding="ascii", newline="\n")


def write_mtl(path: Path, person: Person):
    look = person.look
    lines = [f"# {LICENCE}"]
    materials = MATERIALS | {
        "lash": lash_material(look),
        "brow": brow_material(look),
        "hair": hair_material(look),
        "hair_lock": hair_material(look),
    }
    for name, (colour, shine, exponent, picture) in materials.items():
        diffuse, specular = (" ".join(f"{part:g}" for part in value) for value in (colour, (shine,) * 3))
        lines += [f"newmtl {name}", f"Kd {diffuse}", f"Ks {specular}", f"Ns {exponent}", "illum 2"]
        # Not quite opaque: readers of OBJ then draw it last, blended over what lies behind it.
        lines += ["d 0.995"] if name in SEE_THROUGH else []
        lines += [f"d {OPACITY[name]:g}"] if name in OPACITY else []
        lines += [f"map_Kd {picture}"] if picture else []
        lines += skin_maps_text(person) if name == "skin" else []
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def _rules() -> list[str]:
    """Which shapes switch the correctives on."""
    lines = []
    for name in HALF_WAY:
        lines += ["", "[[correctives]]", f'shape = "{half_way(name)}"', f'hat = "{name}"']
    for one, other in PAIRS:
        lines += ["", "[[correctives]]", f'shape = "{together(one, other)}"']
        lines += [f'product = ["{one}", "{other}"]']
    for mood, blink in HALF_WAY_PAIRS:
        lines += ["", "[[correctives]]", f'shape = "{together(half_way(mood), blink)}"']
        lines += [f'product = ["{blink}"]', f'hat = "{mood}"']
    lines += ["", "[[correctives]]", f'shape = "{LIPS_ON_JAW}"', f'product = ["{LIPS}"]']
    lines += [f'hat = "{JAW}"', f"over = [{', '.join(str(foot) for foot in JAW_OVER)}]"]
    return lines


def frame_lines(points: np.ndarray, landmarks: list) -> list[str]:
    """What a picture shows of a neutral (V, 3): the head, the neck, and where the shoulders begin.

    The bust fades away below; there a picture's own edge is the better end.
    """
    chin = min(points[landmark.vertex][1] for landmark in landmarks)
    end = chin - NECK * (points[:, 1].max() - chin)
    seen = points[points[:, 1] >= end]
    low, high = (np.floor(seen.min(axis=0) * 10) / 10, np.ceil(seen.max(axis=0) * 10) / 10)
    low[1] = np.round(end, 1)
    corners = [", ".join(f"{value + 0.0:.1f}" for value in corner.tolist()) for corner in (low, high)]
    return ["", "[frame]", f"low = [{corners[0]}]", f"high = [{corners[1]}]"]


def write_toml(
    path: Path, person: Person, expressions: list[str], landmarks: list, wrinkles: list[str], frame: list[str]
):
    lines = [
        f'name = "{person.name}"',
        f'description = "{person.description}"',
        f'credit = "{CREDIT}"',
        f'licence = "{LICENCE}"',
        'unit = "cm"',
        'neutral = "neutral.obj"',
        'shapes = "shapes.npz"',
        *frame,
    ]
    for name in expressions:
        lines += [
            "",
            "[[expressions]]",
            f'name = "{name}"',
            f'label = "{name.capitalize()}"',
            f'file = "{name}.obj"',
        ]
    for landmark in landmarks:
        lines += ["", "[[landmarks]]", f'name = "{landmark.name}"', f"vertex = {landmark.vertex}"]
        lines += [f'mpeg4 = "{landmark.mpeg4}"'] if landmark.mpeg4 else []
        lines += [f"ibug = {landmark.ibug}"] if landmark.ibug is not None else []
    lines += _rules() + wrinkles
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")
