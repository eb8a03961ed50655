"""Where a part's colour comes from, and how several people's colours are blended.

colour = w_0 own + sum_i w_i colour_i, all w together 1 (thesis, 2.1.2, with two people: 1 - s and s), of
the STORED values, which are sRGB, and not of linear light. That is the thesis' formula as it stands (it
blends the texels of two pictures), and in sRGB equal steps of s look about equal; in linear light half of
the way from a dark face to a pale one would be seen in its first third. It is also one decoding a pixel
instead of one a person. A material without texture stands in with its diffuse colour encoded. Where both
have a texture and other diffuse factors, the factors are blended as well, linearly; at s = 0 and s = 1
every rule gives exactly the one and the other.

It is done a pixel, by one look-up a person: that is exact at any texture coordinates and sizes, uploads
nothing while weights are dragged, and costs on software OpenGL some 2 ms a person of a 1280 x 800 frame.
Mixing into one texture first would write four million texels each time a weight moves.

How a part answers light (`gl.materials`) stays the face's own: partners lend colours, no gloss.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from facemorph.core.mesh import Material, Mesh
from facemorph.gl.materials import Colour, colour_without_texture
from facemorph.gl.textures import Textures

if TYPE_CHECKING:
    import moderngl

_WHITE: Colour = (1.0, 1.0, 1.0)
# Texture units; 1 is the polygon edges', and from 2 on there is one for each partner.
OWN_UNIT, FIRST_PARTNER_UNIT = 0, 2
# Where colours are not shown, no partner is either.
STENCIL_UNIT = FIRST_PARTNER_UNIT


@dataclass(frozen=True, eq=False)
class Source:
    """A linear `factor` on the colour a texture, the vertices (`coloured`) or neither (`stored`) has."""

    factor: Colour
    opacity: float
    texture: moderngl.Texture | None = None
    coloured: bool = False
    stored: Colour = _WHITE

    @property
    def cut_out(self) -> bool:
        """Whether the texture lets the background through in places."""
        return self.texture is not None and self.texture.components == 4

    def defines(self, prefix: str = "") -> list[str]:
        """What the shaders are to look up."""
        if self.texture is not None:
            return [f"{prefix}TEXTURED"]
        return [f"{prefix}COLOURED"] if self.coloured else []

    def as_stored(self) -> Source:
        """The same with a plain colour stored as a texture would hold it, to be blended with another's."""
        if self.texture is not None or self.coloured:
            return self
        red, green, blue = (encoded(value) for value in self.factor)
        return Source(_WHITE, self.opacity, stored=(red, green, blue))


def source_of(material: Material, mesh: Mesh, textures: Textures) -> Source:
    """The material's texture, the mesh's vertex colours, or the material's plain colour."""
    texture = textures.of(material)
    if texture is not None:
        return Source(material.diffuse, material.opacity, texture)
    if mesh.colours is not None:
        return Source(_WHITE, material.opacity, coloured=True)
    lost = material.texture is not None or material.texture_lost
    return Source(colour_without_texture(material) if lost else material.diffuse, material.opacity)


def encoded(linear: float) -> float:
    """What `linear_from_srgb` of `shaders/lib/colour.glsl` makes `linear` of; values above 1 are kept."""
    value = max(linear, 0.0)
    stored = math.sqrt(value)
    # Newton's way to the cubic's root; from 0 on the cubic rises and bends upwards, so it arrives.
    for _ in range(12):
        slope = stored * (3.0 * 0.305306011 * stored + 2.0 * 0.682171111) + 0.012522878
        there = stored * (stored * (0.305306011 * stored + 0.682171111) + 0.012522878)
        stored -= (there - value) / slope
    return stored


def blended_opacity(materials: Sequence[Material], shares: Sequence[float]) -> float:
    """The opacity of a part whose `materials`, own and partners', have these shares: 1 where all have 1."""
    return 1.0 - sum(share * (1.0 - m.opacity) for share, m in zip(shares, materials, strict=True))


def stencil_of(material: Material, mesh: Mesh, textures: Textures) -> list[str]:
    """What shadings without a material's colours define to leave out what its texture leaves out; bound."""
    own = source_of(material, mesh, textures)
    if own.texture is None or not own.cut_out:
        return []
    own.texture.use(STENCIL_UNIT)
    return ["STENCILLED"]
