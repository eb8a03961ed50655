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
from facemorph.core.triangles import Triangles
from facemorph.gl.counterpart import counterparts, in_order_of
from facemorph.gl.form import Form, OfTriangles, materials_of, see_through
from facemorph.gl.hem import Hem
from facemorph.gl.insides import Insides
from facemorph.gl.shell import Shell

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
    """G drawn vertices and T triangles of a file's mesh, or of the finer one of V positions in its `form`.

    With `partners`, meshes of the file's polygons, the vertices carry their texture coordinates and colours
    too. What comes by vertex comes by the file's vertices, and is refined with the mesh.

    mesh         what is drawn; `partners` have its polygons
    position_of  (G,) int32, the position each drawn vertex is a copy of
    order        (T,) the mesh's triangles in the order they are drawn
    morphed      buffer of (G, 6) float32: position and normal of each drawn vertex
    insides      what tells when the shell's insides are hidden, from `find_shell` on; None without a shell
    caps         first index and number of indices of the triangles that close the shell's rims
    """

    def __init__(self, ctx: moderngl.Context, of: Mesh | Form, partners: Sequence[Mesh] = ()) -> None:
        self._ctx = ctx
        self.form = of if isinstance(of, Form) else Form.of(of)
        self.mesh, self.triangles = self.form.mesh, self.form.triangles
        self.partners = _at_the_level_of(self.form, partners)
        split, others = counterparts(self.mesh, self.triangles, self.form.split, self.partners)
        self._materials = [self.form.materials]
        self._materials += [materials_of(other.mesh, other.polygon) for other in others]
        self.hem: Hem | None = self.form.hem
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
        if self.form.shell is not None:
            self._arrange(self.form.shell)
            positions = self.mesh.positions
            self.insides = Insides(self._ctx, positions, vertex_normals(positions, self.triangles.vertices))

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
        """Set `glow` or `reference` of the file's vertices; what was given last is not uploaded again."""
        if self._given.get(name) is values:
            return
        self._given[name] = values
        if name in self._buffers:
            self._buffers[name].orphan()
            self._buffers[name].write(self._drawn_values(values).tobytes() or b"\0")

    def _drawn_values(self, values: Float32) -> Float32:
        return np.ascontiguousarray(self.form.refined(values)[self.position_of], np.float32)

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
            return self._drawn_values(self.form.bend)
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
        """For each triangle in drawing order, which edges are the file's polygons' own: bits 1, 2 and 4."""
        if self._edges is None:
            refinement = self.form.refinement
            bits = polygon_edge_bits(self.mesh, self.triangles, refinement.on_edge)[self.order]
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


def _at_the_level_of(form: Form, partners: Sequence[Mesh]) -> tuple[Mesh, ...]:
    """Partners, meshes of the file's polygons, refined as the file's mesh is."""
    if not form.level:
        return tuple(partners)
    return tuple(form.refinement.finer(in_order_of(form.of_file, partner)) for partner in partners)


def polygon_edge_bits(mesh: Mesh, triangles: Triangles, shown: Bool | None = None) -> UInt8:
    """(T,) bits: bit i is set where the edge from corner i to corner i + 1 is one of the polygon's own.

    shown   (C,) of the edges that leave the mesh's corners, those that count; None for all
    """
    starts = mesh.polygon_starts.astype(np.int64)
    first = starts[triangles.polygon]
    last = starts[triangles.polygon + 1] - 1
    corners = triangles.corners.astype(np.int64)
    bits = np.zeros(len(corners), np.uint8)
    for i in range(3):
        here, there = corners[:, i], corners[:, (i + 1) % 3]
        following = np.where(here == last, first, here + 1)
        own = there == following
        bits |= (own if shown is None else own & shown[here]).astype(np.uint8) << i
    return bits


def _parts(
    materials: Sequence[OfTriangles], hem: Hem | None, shell: Shell | None
) -> tuple[tuple[Part, ...], Int64]:
    """The runs to draw, opaque ones first, and the order of triangles that makes them.

    `materials` are the mesh's own and then each partner's.
    """
    own, of_triangle = materials[0]
    in_hem = np.zeros(len(of_triangle), bool) if hem is None else hem.triangles
    key = (see_through(own, of_triangle).astype(np.int64) * 2 + in_hem) * len(own) + of_triangle
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
