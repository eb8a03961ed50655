"""`Surface`: a mesh as the graphics card draws it; vertices split at texture seams, triangles by material.

The morphed positions and normals live in one buffer, which a morph path fills and every pass draws.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Bool, Float32, Int32, Int64, UInt8
from facemorph.core.mesh import Material, Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.split import split_vertices
from facemorph.core.triangles import Triangles, triangulated
from facemorph.gl.bends import bends
from facemorph.gl.counterpart import counterparts
from facemorph.gl.hem import Hem, hem_of
from facemorph.gl.insides import Insides
from facemorph.gl.materials import PLAIN
from facemorph.gl.shell import Shell, shell_of

if TYPE_CHECKING:
    import moderngl

MORPHED_BYTES = 24  # position and normal, three float32 each
# What else shaders may ask of a drawn vertex, and how its buffer holds it.
_FORMS = {
    "uv": "2f",
    "colour": "3f1",
    "reference": "3f",
    "glow": "1f",
    "kept": "1f",
    "bend": "1f",
}
_OF_PARTNER = re.compile(r"partner(\d+)_(uv|colour)")


@dataclass(frozen=True)
class Part:
    """A run of triangles drawn alike: material, first triangle, how many, whether they fade at the hem.

    `partners` are the partners' materials there; `in_shell` tells the shell's triangles, where it is known.
    """

    material: Material
    first: int
    count: int
    in_hem: bool
    partners: tuple[Material, ...] = ()
    in_shell: bool = False


class Surface:
    """G drawn vertices and T triangles of a mesh of V positions.

    With `partners`, meshes of the same polygons, the vertices carry their texture coordinates and colours
    too; `kin` is a surface of the same mesh, whose triangles and hem are taken over.

    position_of  (G,) int32, the position each drawn vertex is a copy of
    order        (T,) the mesh's triangles in the order they are drawn
    morphed      buffer of (G, 6) float32: position and normal of each drawn vertex
    insides      what tells when the shell's insides are hidden, from `find_shell` on; None without a shell
    caps         first index and number of indices of the triangles that close the shell's rims
    """

    def __init__(
        self, ctx: moderngl.Context, mesh: Mesh, partners: Sequence[Mesh] = (), *, kin: Surface | None = None
    ) -> None:
        self._ctx = ctx
        self.mesh, self.partners = mesh, tuple(partners)
        self.triangles: Triangles = kin.triangles if kin else triangulated(mesh)
        split, others = counterparts(mesh, self.triangles, split_vertices(mesh, self.triangles), partners)
        self._materials = [_materials(mesh, self.triangles.polygon)]
        self._materials += [_materials(other.mesh, other.polygon) for other in others]
        self._clear = _see_through(*self._materials[0])
        self.hem: Hem | None = kin.hem if kin else hem_of(mesh, self.triangles.vertices, self._clear)
        self._partner_uvs = [other.uvs for other in others]
        self.position_of: Int32 = split.position_of
        self.drawn_count = len(split.position_of)
        self.triangle_count = len(split.triangles)
        self._uvs = split.uvs
        self._given: dict[str, Float32] = {}
        self._buffers: dict[str, moderngl.Buffer] = {}
        self._arrays: dict[int, moderngl.VertexArray] = {}
        self._edges: moderngl.Texture | None = None
        self.morphed = ctx.buffer(reserve=max(self.drawn_count, 1) * MORPHED_BYTES, dynamic=True)
        self._drawn_triangles = split.triangles
        self._shell_sought = False
        self.insides: Insides | None = None
        self._indices: moderngl.Buffer | None = None
        self._arrange(None)

    def _arrange(self, shell: Shell | None) -> None:
        """Put the triangles in the order that they are drawn in."""
        self.parts, self.order = _parts(self._materials, self.hem, shell)
        indices = self._drawn_triangles[self.order]
        self.caps = 3 * len(indices), 0
        if shell is not None:
            drawn_of = np.zeros(self.mesh.vertex_count, np.int32)
            drawn_of[self.position_of] = np.arange(self.drawn_count, dtype=np.int32)
            indices = np.concatenate([indices, drawn_of[shell.caps]])
            self.caps = self.caps[0], 3 * len(shell.caps)
        self._release_order()
        data = np.ascontiguousarray(indices, np.uint32)
        self._indices = self._ctx.buffer(data.tobytes() if len(data) else b"\0" * 12)

    def find_shell(self) -> None:
        """Find out which insides may be hidden. Costs some milliseconds, and counts once."""
        if self._shell_sought:
            return
        self._shell_sought = True
        positions, triangles = self.mesh.positions, self.triangles.vertices
        apart = self._clear if self.hem is None else self._clear | self.hem.triangles
        shell = shell_of(positions, triangles, apart)
        if shell is not None:
            self._arrange(shell)
            self.insides = Insides(self._ctx, positions, vertex_normals(positions, triangles))

    def vertex_array(self, program: moderngl.Program) -> moderngl.VertexArray:
        """The surface bound to the attributes that `program` reads."""
        if program.glo not in self._arrays:
            self._arrays[program.glo] = self._ctx.vertex_array(program, self._content(program), self._indices)
        return self._arrays[program.glo]

    def _content(self, program: moderngl.Program) -> list[tuple[object, ...]]:
        wanted = [name for name in ("position", "normal") if name in program]
        layout = {1: "3f 12x", 2: "3f 3f"}[len(wanted)]
        content: list[tuple[object, ...]] = [(self.morphed, layout, *wanted)]
        of_partners = [f"partner{i}_{kind}" for i in range(len(self.partners)) for kind in ("uv", "colour")]
        for name in (*_FORMS, *of_partners):
            if name in program:
                content.append((self._buffer(name), _FORMS[name.rpartition("_")[2]], name))
        return content

    def shares_uvs(self, partner: int) -> bool:
        """Whether the texture coordinates of that one of the partners are the mesh's own."""
        return self._partner_uvs[partner] is None

    def give(self, name: str, values: Float32) -> None:
        """Set `glow` (V,) or `reference` (V, 3); the array that was given last is not uploaded again."""
        if self._given.get(name) is values:
            return
        self._given[name] = values
        if name in self._buffers:
            self._buffers[name].orphan()
            self._buffers[name].write(self._drawn_values(values).tobytes() or b"\0")

    def _drawn_values(self, values: Float32) -> Float32:
        return np.ascontiguousarray(values[self.position_of], np.float32)

    def _buffer(self, name: str) -> moderngl.Buffer:
        if name not in self._buffers:
            values = np.ascontiguousarray(self._values(name))
            self._buffers[name] = self._ctx.buffer(values.tobytes() or b"\0")
        return self._buffers[name]

    def _values(self, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float32 | np.uint8]]:
        if name in self._given:
            return self._drawn_values(self._given[name])
        if name == "uv":
            return self._uvs
        if name == "reference":
            return self.mesh.positions[self.position_of]
        if name == "glow":
            return np.zeros(self.drawn_count, np.float32)
        if name == "kept":
            kept = self.hem.kept if self.hem else np.ones(self.mesh.vertex_count, np.float32)
            return kept[self.position_of]
        if name == "bend":
            return bends(self.mesh.positions, self.triangles.vertices)[self.position_of]
        whose, kind = self.mesh, name
        of_partner = _OF_PARTNER.match(name)
        if of_partner:
            i, kind = int(of_partner[1]), of_partner[2]
            whose = self.partners[i]
        if kind == "uv":
            uvs = self._partner_uvs[i]
            return self._uvs if uvs is None else uvs
        colours = whose.colours
        if colours is None:
            return np.full((self.drawn_count, 3), 255, np.uint8)
        return (np.clip(colours[self.position_of], 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)

    def texture_paths(self) -> set[Path]:
        """The textures that its materials, and its partners', name."""
        materials = [material for part in self.parts for material in (part.material, *part.partners)]
        return {path for material in materials for path in material.pictures}

    def polygon_edges(self) -> moderngl.Texture:
        """For each triangle in drawing order, which of its edges belong to a polygon: bits 1, 2 and 4."""
        if self._edges is None:
            bits = polygon_edge_bits(self.mesh, self.triangles)[self.order]
            width = min(4096, max(len(bits), 1))
            rows = -(-max(len(bits), 1) // width)
            padded = np.zeros(width * rows, np.uint8)
            padded[: len(bits)] = bits
            self._edges = self._ctx.texture((width, rows), 1, padded.tobytes(), dtype="u1")
        return self._edges

    def _release_order(self) -> None:
        """Give back what follows the order of triangles."""
        for held in (*self._arrays.values(), self._indices, self._edges):
            if held is not None:
                held.release()
        self._arrays.clear()
        self._edges = None

    def release(self) -> None:
        """Give every buffer back to the context."""
        self._release_order()
        for buffer in (*self._buffers.values(), self.morphed):
            buffer.release()


def polygon_edge_bits(mesh: Mesh, triangles: Triangles) -> UInt8:
    """(T,) bits: bit i is set where the edge from corner i to corner i + 1 is one of the polygon's own."""
    starts = mesh.polygon_starts.astype(np.int64)
    first = starts[triangles.polygon]
    last = starts[triangles.polygon + 1] - 1
    corners = triangles.corners.astype(np.int64)
    bits = np.zeros(len(corners), np.uint8)
    for i in range(3):
        here, there = corners[:, i], corners[:, (i + 1) % 3]
        following = np.where(here == last, first, here + 1)
        bits |= (there == following).astype(np.uint8) << i
    return bits


_OfTriangles = tuple[Sequence[Material], Int64]


def _parts(
    materials: Sequence[_OfTriangles], hem: Hem | None, shell: Shell | None
) -> tuple[tuple[Part, ...], Int64]:
    """The runs to draw, opaque ones first, and the order of triangles that makes them.

    `materials` are the mesh's own and then each partner's.
    """
    own, of_triangle = materials[0]
    in_hem = np.zeros(len(of_triangle), bool) if hem is None else hem.triangles
    key = (_see_through(own, of_triangle).astype(np.int64) * 2 + in_hem) * len(own) + of_triangle
    for known, of_partner in materials[1:]:
        # Numbered anew each time: products of many people's counts of materials would overflow.
        key = np.unique(key, return_inverse=True)[1] * len(known) + of_partner
    in_shell = np.zeros(len(of_triangle), bool) if shell is None else shell.triangles
    key = key * 2 + in_shell
    order = np.argsort(key, kind="stable")
    _, first, count = np.unique(key[order], return_index=True, return_counts=True)
    parts = []
    for start, number in zip(first.tolist(), count.tolist(), strict=True):
        triangle = order[start]
        material, *partners = (known[index[triangle]] for known, index in materials)
        faded, closed = bool(in_hem[triangle]), bool(in_shell[triangle])
        parts.append(Part(material, start, number, faded, tuple(partners), closed))
    return tuple(parts), order


def _see_through(materials: Sequence[Material], of_triangle: Int64) -> Bool:
    """(T,) whether a triangle's material lets light through: hair, lashes, tears."""
    clear = np.array([material.opacity < 1.0 for material in materials])
    return np.asarray(clear[of_triangle])


def _materials(mesh: Mesh, polygon: Int32) -> _OfTriangles:
    """The materials in use and, for each triangle, which one."""
    used = mesh.materials_used
    if used is None or not used.names:
        return (PLAIN,), np.zeros(len(polygon), np.int64)
    known = [mesh.materials.get(name, Material(name, diffuse=PLAIN.diffuse)) for name in used.names]
    return (*known, PLAIN), np.where(used.index < 0, len(known), used.index)[polygon].astype(np.int64)
