"""Put the parts together: one layout for everybody, and positions for any shape of any person."""

import numpy as np

from .adapt import AdaptiveMesh, build_adaptive_mesh, choose_faces, rank_faces
from .brows import BrowsPart
from .cage import build_cage
from .fields_face import FIELDS
from .finemesh import build_fine_mesh
from .hair_part import HairPart
from .lashes import LashesPart
from .mouth_fit import MouthFit
from .mouth_room import MouthRoom
from .parts import Group, Part, Posed, stacked
from .parts_eyes import Eye
from .parts_eyes_ball import EYE_VERTICES, Eyeballs, LookUnits
from .parts_eyes_rings import LidRings
from .parts_eyes_wet import Tears
from .parts_skin import SkinPart
from .parts_teeth import Teeth
from .parts_tongue import Tongue
from .people import Person
from .phenotype import Phenotype
from .recipes import EXPRESSIONS
from .sculpt import Sculptor
from .seal import LipSeal
from .shaping import Shaper
from .source import Source

SKIN_VERTICES = 8100
CENTIMETRES = 10.0
# MakeHuman's joint cubes at the centres of both eyes.
EYE_JOINTS = slice(13606, 13622)


class Head:
    """Everything that the six people share."""

    def __init__(self, source: Source):
        self.source, base = source, source.base
        self.cage = build_cage(base)
        self.fine = build_fine_mesh(base, self.cage)
        self.seal = LipSeal(self.cage, base.points)
        self.sculptor = Sculptor(self.cage, base.points, FIELDS)
        self.look_units, self.lids = LookUnits(source), LidRings(self.cage, base)
        self.skin = self._adapt()
        self.lashes = LashesPart.of(base)
        self.parts = self._make_parts()
        self.groups, self.uv = stacked(self.parts)
        self.vertex_count = self.groups[-1].first + self.groups[-1].count

    def _adapt(self) -> AdaptiveMesh:
        """Refine where the base head's own expressions bend; the same faces for everybody."""
        everyone = Phenotype(descent={"african": 1, "asian": 1, "caucasian": 1})
        shaper = Shaper(self.source, Person("", "", "", everyone, None), self.seal, self.sculptor, self.lids)
        shapes = [shaper.shape(recipe) for recipe in EXPRESSIONS.values()]
        score = rank_faces(self.fine, shapes, self.source.base.points)
        return build_adaptive_mesh(self.fine, choose_faces(self.fine, score, SKIN_VERTICES))

    def _make_parts(self) -> list[Part]:
        """In the order of the file; the skin comes first."""
        return [
            SkinPart(self.skin, self.fine),
            Eye(0),
            Eye(1),
            Tears(self.cage, self.lids, self.source.base),
            Teeth(upper=True),
            Teeth(upper=False),
            Tongue(),
            self.lashes,
            BrowsPart(self.fine, self.source.base.points),
            HairPart.of(self.fine, self.source),
        ]

    def group(self, name: str) -> Group:
        return next(group for group in self.groups if group.name == name)


class Body:
    """One person's head; positions come out in centimetres with the origin between the eyes."""

    def __init__(self, head: Head, person: Person):
        self.head, self.person = head, person
        self.shaper = Shaper(head.source, person, head.seal, head.sculptor, head.lids)
        self.neutral, fine = self.shaper.neutral, head.fine
        self.eyes = Eyeballs(head.look_units, self.neutral)
        self._rest = fine.operator @ self.neutral
        self.mouth = MouthFit(fine, head.seal, self._rest, self.neutral)
        self._mouth_room = MouthRoom(fine, head.seal, self._rest, self.mouth)
        height = self.neutral[EYE_VERTICES[0]].mean(0)[1]
        self._origin = np.array([0, height, self.neutral[EYE_JOINTS].mean(0)[2]])

    def posed(self, shape: np.ndarray) -> Posed:
        lifted = shape.copy()
        for grid in (grid for grids in self.head.lids.lashes for grid in grids):
            roots = shape[grid[0]]
            lifted[grid] += self.eyes.push_out(roots, self.neutral[grid[0]], True, shape) - roots
        return Posed(self, lifted)

    def fine_skin(self, shape: np.ndarray) -> np.ndarray:
        """All fine skin vertices in base-mesh space."""
        points = self.head.fine.operator @ shape
        points = self.eyes.push_out(points, self._rest, self.head.fine.on_head, shape)
        return self._mouth_room.clear(points, shape, self.neutral)

    def solids(self, shape: np.ndarray, names: tuple[str, ...]) -> list[tuple[np.ndarray, np.ndarray]]:
        """Points in base-mesh space and triangles of some groups: what casts shade on the skin."""
        posed = self.posed(shape)
        places = {part.groups[0].name: part for part in self.head.parts}
        return [(places[name].place(posed), self.head.group(name).own_triangles) for name in names]

    def positions(self, shape: np.ndarray) -> np.ndarray:
        """Every vertex of the file (V, 3), in the order of the groups."""
        posed = self.posed(shape)
        points = np.concatenate([part.place(posed) for part in self.head.parts])
        return (points - self._origin) * CENTIMETRES
