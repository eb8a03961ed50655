"""The pictures of a skin besides its colours, and what `shaders/skin.frag` is told of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from facemorph.core.mesh import Material, Mesh
from facemorph.gl.colours import Source
from facemorph.gl.wrinkles import COUNT

if TYPE_CHECKING:
    from facemorph.gl.textures import Textures

# Behind those of the most partners there can be; OpenGL 3.3 has 16 for sure.
RELIEF_UNIT, ROUGHNESS_UNIT, WRINKLE_UNIT = 13, 14, 15
# Heights as parts of the mesh's diagonal: what a relief has whose file does not say, and the most.
_USUAL_HEIGHT, _LARGEST_HEIGHT = 0.0004, 0.01
# Of skin without a picture of it: GGX's, squared in the shader.
PLAIN_ROUGHNESS = 0.52


@dataclass(frozen=True)
class SkinMaps:
    """Definitions and uniforms for the shader."""

    defines: list[str] = field(default_factory=list)
    uniforms: dict[str, object] = field(default_factory=dict)


def skin_maps(
    material: Material, mesh: Mesh, source: Source, textures: Textures, face: Mapping[str, object]
) -> SkinMaps:
    """Bind the material's maps that can be shown; wrinkles only where `face`, the pose's uniforms, has some.

    Maps lie at the coordinates of the texture, so a skin without one has none.
    """
    define: list[str] = ["SKIN"]
    told: dict[str, object] = {"roughness": PLAIN_ROUGHNESS}
    if source.texture is None:
        return SkinMaps(define, told)
    relief = textures.at(material.bump)
    if relief is not None:
        relief.use(RELIEF_UNIT)
        define.append("RELIEF")
        told |= {
            "relief_texture": RELIEF_UNIT,
            "relief_height": _height(material.bump_height, mesh),
            "relief_is_normals": textures.holds_normals(material.bump),
        }
    rough = textures.at(material.roughness)
    if rough is not None:
        rough.use(ROUGHNESS_UNIT)
        define.append("ROUGHNESS")
        told["roughness_texture"] = ROUGHNESS_UNIT
    if face.get(COUNT, 0):
        wrinkles = textures.at(material.wrinkles)
        if wrinkles is not None:
            wrinkles.use(WRINKLE_UNIT)
            define.append("WRINKLES")
            told |= {
                "wrinkle_texture": WRINKLE_UNIT,
                "wrinkle_height": _height(material.wrinkle_height, mesh),
            }
    return SkinMaps(define, told)


def _height(named: float | None, mesh: Mesh) -> float:
    """Model units from black to white: as the file says, within reason, for units are often mistaken."""
    if named is None:
        return _USUAL_HEIGHT * mesh.diagonal
    most = _LARGEST_HEIGHT * mesh.diagonal
    return min(max(named, -most), most)
