"""Put the parts together: one layout for everybody, and positions for any shape of any person."""

from dataclasses import dataclass

import numpy as np

from .adapt import build_adaptive_mesh, choose_faces, rank_faces
from .cage import build_cage
from .finemesh import build_fine_mesh
from .hair import scalp_lift
from .lashes import Lashes
from .parts_eyes import EYE_VERTICES, eye_mesh, place_eye, push_out
from .parts_teeth import Teeth
from .parts_tongue import Tongue
from .people import Person
from .phenotype import Phenotype
from .recipes import EXPRESSIONS
from .seal import LipSeal
from .shaping import Shaper
from .source import Source
from .subdivide import vertex_normals

SKIN_VERTICES = 8100
CENTIMETRES = 10.0
# MakeHuman's joint cubes at the centres of both eyes.
EYE_JOINTS = slice(13606, 13622)
FLAT_UV = np.array([[0.5, 0.5]])


@dataclass(frozen=True)
class Group:
    """A named part of the file: triangles, uv_triangles (t, 3) are indices into the whole file."""

    name: str
    material: str
    triangles: np.ndarray
    uv_triangles: np.ndarray
    first: int
    count: int


class Head:
    """Everything that the six people share."""

    def __init__(self, source: Source):
        self.source, base = source, source.base
        self.cage = build_cage(base)
        self.fine = build_fine_mesh(base, self.cage)
        self.seal = LipSeal(self.cage, base.points)
        self.skin = self._adapt()
        self._eye_points, eye_uv, eye_triangles = eye_mesh()
        self._teeth = [
            Teeth(base.faces[f"helper-{arch}-teeth"], base.points, arch == "upper")
            for arch in ("upper", "lower")
        ]
        self._tongue = Tongue(base.faces["helper-tongue"], base.points)
        self.lashes = self._make_lashes()
        self.groups, self.uv = self._layout(eye_uv, eye_triangles)
        self.vertex_count = sum(group.count for group in self.groups)

    def _adapt(self):
        """Refine where the base head's own expressions bend; the same faces for everybody."""
        everyone = Phenotype(descent={"african": 1, "asian": 1, "caucasian": 1})
        shaper = Shaper(self.source, Person("", "", "", everyone, None), self.seal)
        shapes = [shaper.shape(recipe) for recipe in EXPRESSIONS.values()]
        score = rank_faces(self.fine, shapes, self.source.base.points)
        return build_adaptive_mesh(self.fine, choose_faces(self.fine, score, SKIN_VERTICES))

    def _make_lashes(self) -> list[Lashes]:
        base, rng = self.source.base, np.random.default_rng(3)
        centres = {side: base.points[ids].mean(0) for side, ids in zip("lr", EYE_VERTICES, strict=True)}
        upper_strip, lower_strip = 2, 1
        return [
            Lashes(
                base.faces[f"helper-{side}-eyelashes-{strip}"],
                base.points,
                centres[side],
                strip == upper_strip,
                rng,
            )
            for side in "lr"
            for strip in (upper_strip, lower_strip)
        ]

    def _layout(self, eye_uv, eye_triangles) -> tuple[list[Group], np.ndarray]:
        lash_triangles, offset = [], 0
        for lashes in self.lashes:
            lash_triangles.append(lashes.triangles + offset)
            offset += lashes.count
        lash_triangles = np.concatenate(lash_triangles)
        upper, lower, tongue, skin = *self._teeth, self._tongue, self.skin
        parts = [
            ("skin", "skin", skin.triangles, skin.uv_triangles, self.fine.uv[skin.pick_uv]),
            ("eye_L", "eye", eye_triangles, eye_triangles, eye_uv),
            ("eye_R", "eye", eye_triangles, eye_triangles, eye_uv),
            ("teeth_upper", "teeth", upper.triangles, upper.triangles, upper.uv),
            ("teeth_lower", "teeth", lower.triangles, lower.triangles, lower.uv),
            ("tongue", "tongue", tongue.triangles, tongue.triangles, tongue.uv),
            ("lashes", "lash", lash_triangles, np.zeros_like(lash_triangles), FLAT_UV),
        ]
        groups, uvs, first, first_uv = [], [], 0, 0
        for name, material, triangles, uv_triangles, uv in parts:
            count = int(triangles.max()) + 1
            groups.append(Group(name, material, triangles + first, uv_triangles + first_uv, first, count))
            uvs.append(uv)
            first, first_uv = first + count, first_uv + len(uv)
        return groups, np.concatenate(uvs)

    def tongue_rest(self) -> np.ndarray:
        """The tongue's points on the base head, for finding its landmarks."""
        return self._tongue.place(self.source.base.points, self.source.base.points)

    def group(self, name: str) -> Group:
        return next(group for group in self.groups if group.name == name)


class Body:
    """One person's head; positions come out in centimetres with the origin between the eyes."""

    def __init__(self, head: Head, person: Person):
        self.head, self.person = head, person
        self.shaper = Shaper(head.source, person, head.seal)
        self._neutral, fine = self.shaper.neutral, head.fine
        self._rest = fine.operator @ self._neutral
        lift = scalp_lift(fine, head.source.base.points, person.look)
        self._hair = lift[:, None] * vertex_normals(self._rest, fine.triangles)
        height = self._neutral[EYE_VERTICES[0]].mean(0)[1]
        self._origin = np.array([0, height, self._neutral[EYE_JOINTS].mean(0)[2]])

    def fine_skin(self, shape: np.ndarray) -> np.ndarray:
        """All fine skin vertices in base-mesh space."""
        points = self.head.fine.operator @ shape
        return push_out(points, self._rest, self.head.fine.on_head, shape, self._neutral) + self._hair

    def solids(self, shape: np.ndarray) -> list[np.ndarray]:
        """Both eyes and both arches of teeth in base-mesh space: what casts shade on the skin."""
        head = self.head
        eyes = [place_eye(head._eye_points, side, shape, self._neutral) for side in (0, 1)]
        return eyes + [teeth.place(shape) for teeth in head._teeth]

    def positions(self, shape: np.ndarray) -> np.ndarray:
        """Every vertex of the file (V, 3), in the order of the groups."""
        head = self.head
        parts = [
            self.fine_skin(shape)[head.skin.pick],
            *self.solids(shape),
            head._tongue.place(shape, self._neutral),
            *(lashes.place(shape) for lashes in head.lashes),
        ]
        return (np.concatenate(parts) - self._origin) * CENTIMETRES
