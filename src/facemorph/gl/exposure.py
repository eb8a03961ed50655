"""How bright the lights are: as a photographer opens the lens for dark skin, so that all faces show their form.

    exposure = clamp((FAIR / luminance) ^ EASING, LEAST, MOST)

`luminance` is the median of the skin's linear luminance Y = 0.2126 R + 0.7152 G + 0.0722 B, over its
polygons' corners, of texture, vertex colours or plain colour. All lights are multiplied by it, so that skin
keeps its own colour, and dark skin stays darker than fair skin: by the easing the ratio is taken back in
part only. A mixture of people has the mean of their exposures by shares.
"""

from __future__ import annotations

import weakref
from collections.abc import Mapping, Sequence

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.core.mesh import Material, Mesh
from facemorph.gl.materials import PLAIN, colour_without_texture, finish_of
from facemorph.gl.textures import Textures

FAIR = 0.44
EASING = 0.36
LEAST, MOST = 0.9, 2.2
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


class Exposures:
    """The exposures of meshes, each worked out once."""

    def __init__(self, textures: Textures) -> None:
        self._textures = textures
        self._known: weakref.WeakKeyDictionary[Mesh, float] = weakref.WeakKeyDictionary()

    def of(self, meshes: Sequence[Mesh], shares: Sequence[float]) -> float:
        """That of a mixture of people; those without a share are not looked at."""
        return sum(share * self._one(mesh) for mesh, share in zip(meshes, shares, strict=True) if share)

    def _one(self, mesh: Mesh) -> float:
        if mesh not in self._known:
            found = skin_luminances(mesh, self._textures)
            self._known[mesh] = exposure(float(np.median(found))) if len(found) else 1.0
        return self._known[mesh]


def exposure(luminance: float) -> float:
    """What lights are multiplied by for skin of that median luminance."""
    return float(np.clip((FAIR / max(luminance, 1e-4)) ** EASING, LEAST, MOST))


def exposed(lights: Mapping[str, object], factor: float) -> dict[str, object]:
    """The uniforms with the colours of the lights among them multiplied by `factor`."""
    return {
        name: tuple(float(part) * factor for part in value)
        if name.endswith("_light") and isinstance(value, tuple)
        else value
        for name, value in lights.items()
    }


def skin_luminances(mesh: Mesh, textures: Textures) -> Float64:
    """Linear luminance at each corner (n,) of polygons of skin; none where there is no skin."""
    used = mesh.materials_used
    of_polygon = np.full(mesh.polygon_count, -1) if used is None else used.index
    names = () if used is None else used.names
    found = []
    for index in (-1, *range(len(names))):
        material = PLAIN if index < 0 else mesh.materials.get(names[index], PLAIN)
        corners = np.flatnonzero(np.repeat(of_polygon == index, np.diff(mesh.polygon_starts)))
        if len(corners) and finish_of(material).relief:
            found.append(_luminances(material, mesh, corners, textures))
    return np.concatenate(found) if found else np.zeros(0)


def _luminances(material: Material, mesh: Mesh, corners: Int64, textures: Textures) -> Float64:
    small = textures.small(material.texture) if material.texture is not None else None
    if small is not None and mesh.corner_uvs is not None and len(mesh.uvs):
        which = mesh.corner_uvs[corners]
        uvs = mesh.uvs[which[which >= 0]].astype(np.float64) % 1.0
        places = np.minimum((uvs * len(small)).astype(int), len(small) - 1)
        shown = small[places[:, 1], places[:, 0]].astype(np.float64) / 255.0
        colours = _linear(shown if shown.shape[1] < 3 else shown[:, :3]) * material.diffuse
    elif mesh.colours is not None:
        colours = _linear(mesh.colours[mesh.corner_vertices[corners]].astype(np.float64))
    else:
        colours = np.tile(colour_without_texture(material), (len(corners), 1))
    return np.asarray(colours @ _LUMINANCE, np.float64)


def _linear(stored: Float64) -> Float64:
    """`linear_from_srgb` of `shaders/lib/colour.glsl`; one channel stands for three."""
    return np.asarray(stored * (stored * (stored * 0.305306011 + 0.682171111) + 0.012522878), np.float64)
