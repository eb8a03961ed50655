"""How bright the lights are: as a photographer opens the lens for dark skin, so that its form shows too.

    exposure = clamp((FAIR / Y)^EASING, LEAST, MOST)

Y = 0.2126 R + 0.7152 G + 0.0722 B is the linear luminance of the skin's mean colour: of what its texture,
its vertices or its material store, over all that faces +Z, by area. All lights are multiplied by it, so
that skin keeps its own colour, and dark skin stays darker than fair skin: the easing takes the ratio back
in part only. Mixed people's means are mixed as their colours are (`gl.colours`), so that a mixture is lit
as one face of that colour.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Mapping, Sequence

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.core.mesh import Material, Mesh
from facemorph.gl.colours import encoded
from facemorph.gl.materials import PLAIN, colour_without_texture, finish_of
from facemorph.gl.textures import Textures

FAIR = 0.20
EASING = 0.26
LEAST, MOST = 0.75, 2.0
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
_WHITE = (1.0, 1.0, 1.0)


class Exposures:
    """The exposures of meshes and their mixtures; each mesh is looked at once."""

    def __init__(self, textures: Textures) -> None:
        self._textures = textures
        self._known: weakref.WeakKeyDictionary[Mesh, Float64 | None] = weakref.WeakKeyDictionary()

    def of(self, meshes: Sequence[Mesh], shares: Sequence[float]) -> float:
        """That of a mixture by shares; 1 where nobody has skin."""
        found = [(self._mean(mesh), share) for mesh, share in zip(meshes, shares, strict=True) if share]
        means = [(mean, share) for mean, share in found if mean is not None]
        total = math.fsum(share for _, share in means)
        if not total:
            return 1.0
        # Exact sums, so that the order of people changes no pixel.
        columns = zip(*((mean * share).ravel().tolist() for mean, share in means), strict=True)
        stored, factor = np.reshape([math.fsum(column) / total for column in columns], (2, 3))
        return exposure(float((_linear(stored) * factor) @ _LUMINANCE))

    def _mean(self, mesh: Mesh) -> Float64 | None:
        if mesh not in self._known:
            self._known[mesh] = mean_skin(mesh, self._textures)
        return self._known[mesh]


def exposure(luminance: float) -> float:
    """What lights are multiplied by for skin of that luminance."""
    # Rounded, so that the order of polygons changes no pixel.
    return round(float(np.clip((FAIR / max(luminance, 1e-4)) ** EASING, LEAST, MOST)), 4)


def exposed(scene: Mapping[str, object], factor: float) -> dict[str, object]:
    """The uniforms with the colours of the lights among them multiplied by `factor`."""
    return {
        name: tuple(float(part) * factor for part in value)
        if name.endswith("_light") and isinstance(value, tuple)
        else value
        for name, value in scene.items()
    }


def mean_skin(mesh: Mesh, textures: Textures) -> Float64 | None:
    """The stored colour of a mesh's skin, sRGB, and the linear factor on it, (2, 3); None without skin."""
    used = mesh.materials_used
    names = used.names if used is not None else ()
    of_polygon = used.index if used is not None else np.full(mesh.polygon_count, -1)
    weight = _facing(mesh)
    sizes = np.diff(mesh.polygon_starts)
    of_corner = np.repeat(weight / np.maximum(sizes, 1), sizes)
    labels = np.repeat(of_polygon, sizes)
    total, sums = 0.0, np.zeros((2, 3))
    for index in (-1, *range(len(names))):
        material = PLAIN if index < 0 else mesh.materials.get(names[index], PLAIN)
        corners = np.flatnonzero((labels == index) & (of_corner > 0.0))
        if not len(corners) or not finish_of(material).relief:
            continue
        stored, factor = _colours(material, mesh, corners, textures)
        here = float(of_corner[corners].sum())
        sums += np.stack([of_corner[corners] @ stored, here * np.array(factor)])
        total += here
    return sums / total if total else None


def _facing(mesh: Mesh) -> Float64:
    """For each polygon (P,) its area as seen from +Z; 0 for what faces away."""
    starts = mesh.polygon_starts.astype(np.int64)
    place = mesh.positions[mesh.corner_vertices, :2].astype(np.float64)
    following = np.arange(1, len(place) + 1)
    # After a polygon's last corner comes its first.
    filled = starts[1:] > starts[:-1]
    following[starts[1:][filled] - 1] = starts[:-1][filled]
    there = place[following] if len(place) else place
    twice = place[:, 0] * there[:, 1] - place[:, 1] * there[:, 0]
    sums = np.concatenate([[0.0], np.cumsum(twice)])
    return np.asarray(np.maximum(0.5 * (sums[starts[1:]] - sums[starts[:-1]]), 0.0), np.float64)


def _colours(
    material: Material, mesh: Mesh, corners: Int64, textures: Textures
) -> tuple[Float64, tuple[float, float, float]]:
    """Stored colours (n, 3) at corners, and the factor on them, as `gl.colours.source_of` has them."""
    small = textures.small(material.texture) if material.texture is not None else None
    if small is not None and mesh.corner_uvs is not None and len(mesh.uvs):
        uvs = mesh.uvs[np.maximum(mesh.corner_uvs[corners], 0)].astype(np.float64)
        shown = _looked_up(small.astype(np.float64) / 255.0, uvs % 1.0)
        return shown, material.diffuse
    if mesh.colours is not None:
        return mesh.colours[mesh.corner_vertices[corners]].astype(np.float64), _WHITE
    lost = material.texture is not None or material.texture_lost
    plain = colour_without_texture(material) if lost else material.diffuse
    return np.tile([encoded(part) for part in plain], (len(corners), 1)), _WHITE


def _looked_up(picture: Float64, uvs: Float64) -> Float64:
    """Colours (n, 3) of a picture (h, w, channels), bottom row first, between its pixels."""
    side = len(picture)
    place = np.clip(uvs * side - 0.5, 0.0, side - 1.0)
    low = np.minimum(place.astype(np.int64), side - 2)
    u, v = (place - low).T[:, :, None]
    column, row = low.T
    below = picture[row, column] * (1.0 - u) + picture[row, column + 1] * u
    above = picture[row + 1, column] * (1.0 - u) + picture[row + 1, column + 1] * u
    shown = below * (1.0 - v) + above * v
    return shown[:, :3] if shown.shape[1] >= 3 else np.repeat(shown[:, :1], 3, axis=1)


def _linear(stored: Float64) -> Float64:
    """`linear_from_srgb` of `shaders/lib/colour.glsl`."""
    return np.asarray(stored * (stored * (stored * 0.305306011 + 0.682171111) + 0.012522878), np.float64)
