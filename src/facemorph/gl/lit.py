"""What the shaders of lit parts are told of a part's material, its colours and its partners' colours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from facemorph.gl.colours import FIRST_PARTNER_UNIT, OWN_UNIT, Source
from facemorph.gl.materials import Finish
from facemorph.gl.surface import Surface


@dataclass(frozen=True)
class Told:
    """Definitions and uniforms for a shader."""

    defines: list[str]
    uniforms: dict[str, object]


def lit_material(
    surface: Surface,
    finish: Finish,
    source: Source,
    partners: Sequence[Source],
    scene: Mapping[str, object],
) -> Told:
    """Bind the textures of a part's colours, and say what the shader must know of them and of its finish."""
    define = source.defines()
    if source.texture is not None:
        source.texture.use(OWN_UNIT)
    own: dict[str, object] = {
        "albedo": tuple(value * finish.shade for value in source.factor),
        "opacity": source.opacity,
        "wrap": finish.wrap,
        "gloss": finish.gloss,
        "sharpness": finish.sharpness,
        "sheen": finish.sheen,
        "recess": finish.recess,
        "matte": finish.matte,
        "spill": finish.spill,
        "shine_direction": scene["catch_direction" if finish.catches else "key_direction"],
    }
    if partners:
        define.append(f"PARTNERS {len(partners)}")
        own["stored_colour"] = source.stored
    for i, partner in enumerate(partners):
        define += partner.defines(f"PARTNER{i}_")
        # Textures of one set of coordinates are looked up at one.
        if partner.texture is not None:
            partner.texture.use(FIRST_PARTNER_UNIT + i)
            if not (surface.shares_uvs(i) and source.texture is not None):
                define.append(f"PARTNER{i}_UV")
        own |= {
            f"partner{i}_stored_colour": partner.stored,
            f"partner{i}_albedo": tuple(value * finish.shade for value in partner.factor),
            f"partner{i}_opacity": partner.opacity,
        }
    if any(one.cut_out for one in (source, *partners)):
        define.append("CUTOUT")
    return Told(define, own)
