"""OBJ (Wavefront): positions in the file's order, polygons as written, uvs and normals with their own index.

What is read: `v` (x y z; a fourth number is a weight and has no effect on polygons; six are a position
and a colour; seven a position, a colour and an alpha, which is left out), `vt` (u, or u v, or u v w:
w is left out), `vn`, `f` in all its forms, `g`, `o`, `usemtl`, `mtllib`. Lines of another kind (`s`, `l`,
`p`, `vp`, curves, vertex weights) do not concern a polygon mesh and are passed over. Where only some
vertices have a colour, the others are white; colours written 0..255 are scaled to 0..1.

Refused, always with the line: an index out of range or 0, a face of fewer than three corners, a
number that is none, or not finite in float32; and a file without vertices or without faces.
Coordinates are the float32 nearest to the float64 nearest to what is written.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.core.mesh import Mesh
from facemorph.errors import MeshFileError
from facemorph.io.limits import NAME_BYTES, read_bytes
from facemorph.io.mtl import read_libraries
from facemorph.io.obj_faces import PARTS, Faces, corner_token, read_faces
from facemorph.io.obj_labels import LabelChanges
from facemorph.io.obj_numbers import Numbers
from facemorph.io.obj_problems import Problems, shown
from facemorph.io.obj_text import Kind, Lines, ObjText, lines_between, without_uvs_and_normals

_LIBRARIES = 64


@dataclass(frozen=True, eq=False)
class ObjFile:
    """What an OBJ says.

    mesh        the mesh, still without what is known of its materials
    libraries   the names of its material files
    faces_from  where in the file all faces begin, everything they count on standing before; None where
                the file mixes them
    """

    mesh: Mesh
    libraries: tuple[str, ...]
    faces_from: int | None = None


def read_obj(path: Path) -> Mesh:
    """The mesh of an OBJ file, with what its `.mtl` says of its materials. Raises `MeshFileError`."""
    return with_materials(path, parse_obj(path, read_bytes(path)))


def parse_obj(path: Path, data: bytes) -> ObjFile:
    """What an OBJ's bytes say; `path` is named in errors. Raises `MeshFileError`."""
    text = ObjText(path, data)
    scan = _Scan(text)
    for begin, end in text.chunks():
        scan.add(begin, end)
    return ObjFile(scan.mesh(), tuple(dict.fromkeys(scan.libraries)), scan.faces_from())


def with_materials(path: Path, file: ObjFile) -> Mesh:
    """The mesh with what the material files beside `path` say of the materials that it uses."""
    used = file.mesh.materials_used.names if file.mesh.materials_used else ()
    if not used or not file.libraries:
        return file.mesh
    library = read_libraries(path, file.libraries)
    known = {name: library.materials[name] for name in used if name in library.materials}
    return replace(file.mesh, materials=known, notes=tuple(f"{path}: {p}." for p in library.problems))


def parse_positions(path: Path, data: bytes) -> Float32 | None:
    """Positions (V, 3) of the part of an OBJ before its faces; None where it does hold faces.

    Uvs, normals and colours are passed over unread: for a shape whose faces are known already.
    """
    text = ObjText(path, data)
    pieces = [np.zeros((0, 3), np.float32)]
    for begin, end in text.chunks():
        lines = lines_between(text, *without_uvs_and_normals(text, begin, end))
        if (lines.kind == Kind.FACE).any():
            return None
        problems = Problems(text)
        pieces.append(Numbers(text, lines, problems).vertices()[0])
        problems.raise_first()
    return np.concatenate(pieces)


@dataclass(eq=False)
class _Scan:
    """What has been read of a file so far, in pieces."""

    text: ObjText
    positions: list[Float32] = field(default_factory=list)
    colours: list[Float32 | None] = field(default_factory=list)
    uvs: list[Float32] = field(default_factory=list)
    normals: list[Float32] = field(default_factory=list)
    faces: list[Faces] = field(default_factory=list)
    ranges: list[tuple[int, int]] = field(default_factory=list)
    counts: tuple[int, int, int] = (0, 0, 0)
    polygons: int = 0
    libraries: list[str] = field(default_factory=list)
    last_vector: int = 0
    mixed: bool = False
    labels: dict[Kind, LabelChanges] = field(
        default_factory=lambda: {
            Kind.GROUP: LabelChanges("group"),
            Kind.OBJECT: LabelChanges("object"),
            Kind.MATERIAL: LabelChanges("material"),
        }
    )

    def add(self, begin: int, end: int) -> None:
        """Read one range of whole lines."""
        lines = lines_between(self.text, begin, end)
        problems = Problems(self.text)
        numbers = Numbers(self.text, lines, problems)
        positions, colours = numbers.vertices()
        uvs, normals = numbers.uvs(), numbers.normals()
        faces = read_faces(self.text, lines, self.counts, problems)
        problems.raise_first()
        self._add_names(lines)
        self.positions.append(positions)
        self.colours.append(colours)
        self.uvs.append(uvs)
        self.normals.append(normals)
        self.faces.append(faces)
        self.ranges.append((begin, end))
        v, vt, vn = self.counts
        self.counts = (v + len(positions), vt + len(uvs), vn + len(normals))
        self.polygons += len(faces.sizes)

        self._note_order(lines)

    def _note_order(self, lines: Lines) -> None:
        """Note where the last vertex, uv or normal stands, and whether a face stands before it."""
        vectors = np.flatnonzero((lines.kind >= Kind.VERTEX) & (lines.kind <= Kind.NORMAL))
        if len(vectors):
            faces = lines.of(Kind.FACE)
            earlier = self.polygons > len(faces) or (len(faces) > 0 and faces[0] < vectors[-1])
            self.mixed = self.mixed or bool(earlier)
            self.last_vector = int(lines.starts[lines.first[vectors[-1]]])

    def faces_from(self) -> int | None:
        """See `ObjFile`."""
        after = self.text.data.find(b"\n", self.last_vector) + 1
        return None if self.mixed else min(after, self.text.end) - self.text.begin

    def _add_names(self, lines: Lines) -> None:
        named = np.flatnonzero(lines.kind >= Kind.GROUP)
        if not len(named):
            return
        polygons = np.cumsum(lines.kind == Kind.FACE)[named] + self.polygons
        for i, polygon in zip(named, polygons, strict=True):
            word = lines.first[i]
            name = self._rest_of_line(int(lines.ends[word]))
            kind = Kind(lines.kind[i])
            if kind is not Kind.LIBRARY:
                self.labels[kind].change(int(polygon), name, self.text, int(lines.starts[word]))
            elif len(self.libraries) < _LIBRARIES and name:
                self.libraries.append(name)

    def _rest_of_line(self, place: int) -> str:
        end = self.text.data.index(b"\n", place)
        # A little more than is allowed, so that an over-long name is seen to be one.
        return self.text.data[place : min(end, place + 2 * NAME_BYTES)].strip().decode("utf-8", "replace")

    def mesh(self) -> Mesh:
        """The whole mesh. Raises `MeshFileError` where something it needs is missing."""
        path = self.text.path
        if not self.counts[0]:
            raise MeshFileError(path, "has no vertices (lines that begin with v)", hint="Is it an OBJ file?")
        if not self.polygons:
            raise MeshFileError(path, "has no faces (lines that begin with f)")
        self._check_references()
        corners = np.concatenate([faces.corners for faces in self.faces], axis=1)
        return Mesh(
            np.concatenate(self.positions),
            _starts(np.concatenate([faces.sizes for faces in self.faces])),
            np.ascontiguousarray(corners[0]),
            uvs=np.concatenate(self.uvs),
            corner_uvs=_or_none(corners[1]),
            normals=np.concatenate(self.normals),
            corner_normals=_or_none(corners[2]),
            colours=self._all_colours(),
            groups=self.labels[Kind.GROUP].labels(self.polygons),
            objects=self.labels[Kind.OBJECT].labels(self.polygons),
            materials_used=self.labels[Kind.MATERIAL].labels(self.polygons),
        )

    def _check_references(self) -> None:
        for (begin, end), faces in zip(self.ranges, self.faces, strict=True):
            problems = Problems(self.text)
            for part, count in enumerate(self.counts):
                if not faces.corners.size or int(faces.corners[part].max()) < count:
                    continue
                corner = int(np.argmax(faces.corners[part] >= count))
                token = corner_token(lines_between(self.text, begin, end), corner)
                have = f"{count:,}" if count else "none"
                index = int(faces.corners[part, corner]) + 1
                problems.add(
                    token[0],
                    f"{shown(self.text, *token)} names {PARTS[part]} {index:,}, but the file has {have}",
                )
            problems.raise_first()

    def _all_colours(self) -> Float32 | None:
        if all(colours is None for colours in self.colours):
            return None
        whole = np.concatenate(
            [
                np.full((len(positions), 3), np.nan, np.float32) if colours is None else colours
                for positions, colours in zip(self.positions, self.colours, strict=True)
            ]
        )
        without = np.isnan(whole)
        if float(np.max(whole, initial=0.0, where=~without)) > 1.0:
            whole /= np.float32(255.0)
        whole[without] = 1.0
        return np.clip(whole, 0.0, 1.0, out=whole)


def _starts(sizes: Int32) -> Int32:
    starts = np.zeros(len(sizes) + 1, np.int32)
    np.cumsum(sizes, out=starts[1:])
    return starts


def _or_none(index: Int32) -> Int32 | None:
    return np.ascontiguousarray(index) if bool((index >= 0).any()) else None
