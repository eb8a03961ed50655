"""`Rig`: a neutral mesh and K named shapes over its vertices, with what is known of the face."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32, UInt8
from facemorph.core.correctives import CORRECTIVE, Activation, Corrective
from facemorph.core.mesh import Mesh
from facemorph.core.morph import morphed_positions
from facemorph.core.normals import vertex_normals
from facemorph.core.pose import NEUTRAL, Pose
from facemorph.core.triangles import triangulated
from facemorph.core.wrinkles import Wrinkle, WrinkleWeights
from facemorph.errors import MeshDataError, UnknownNameError

EXPRESSION = "expression"
Box = tuple[tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class Shape:
    """One blendshape: the name it is called by, the words shown for it, and the set it belongs to.

    `set` is "expression" for whole expressions, "facs" for FACS units, "arkit" for ARKit shapes,
    "corrective" for those that others switch on.
    """

    name: str
    label: str
    set: str = EXPRESSION


@dataclass(frozen=True)
class Landmark:
    """A named vertex; `mpeg4` is its MPEG-4 feature point (as "8.3"), `ibug` its place in the usual 68."""

    name: str
    vertex: int
    mpeg4: str | None = None
    ibug: int | None = None


@dataclass(frozen=True, eq=False)
class Regions:
    """Soft regions of the face: weights (R, V) uint8, at most 255 summed over R; the rest belongs to none."""

    names: tuple[str, ...]
    weights: UInt8


@dataclass(frozen=True)
class FaceInfo:
    """What a face folder says of itself.

    unit     a length ("cm", "mm", "m"), or "" where it says none
    frame    the lowest and the highest corner of the box that a picture of the face should show, model
             units, or None where it says none
    """

    name: str
    description: str = ""
    credit: str = ""
    licence: str = ""
    unit: str = ""
    landmarks: tuple[Landmark, ...] = ()
    frame: Box | None = None


@dataclass(frozen=True, eq=False, repr=False)
class Rig:
    """A neutral `Mesh` and K shapes; `deltas` (K, V, 3) float32, in the neutral's unit.

    `correctives` say which shapes follow from the others' weights; where `corrected` is off, they rest, and
    every face is the plain sum of its shapes. `wrinkles` are what the shapes fade in on the skin.
    Raises `MeshDataError` when deltas and neutral do not fit, a name stands twice, or a rule has no shape.
    """

    neutral: Mesh
    shapes: tuple[Shape, ...]
    deltas: Float32
    info: FaceInfo = field(default_factory=lambda: FaceInfo("face"))
    regions: Regions | None = None
    correctives: tuple[Corrective, ...] = ()
    corrected: bool = True
    wrinkles: tuple[Wrinkle, ...] = ()

    def __post_init__(self) -> None:
        expected = (len(self.shapes), self.neutral.vertex_count, 3)
        if self.deltas.shape != expected:
            raise MeshDataError(f"deltas must be {expected}, not {self.deltas.shape}.")
        seen: set[str] = set()
        for shape in self.shapes:
            if shape.name in seen or shape.name == NEUTRAL:
                raise MeshDataError(f"two shapes are called {shape.name!r}; every shape needs its own name.")
            seen.add(shape.name)
        # Bound now, so that a rule over a shape that is not there is told here.
        _ = self._activation
        WrinkleWeights(self.names, self.wrinkles)

    @property
    def frame(self) -> Float32:
        """The box (2, 3) that a picture shows: what the face says, as far as there is mesh, or all of it."""
        low, high = bounds = self.neutral.bounds
        if self.info.frame is None:
            return bounds
        return np.clip(np.asarray(self.info.frame, np.float32), low, high)

    def __repr__(self) -> str:
        return f"<Rig {self.info.name!r}: {self.neutral.vertex_count:,} vertices, {len(self.shapes)} shapes>"

    @classmethod
    def from_arrays(cls, neutral: Mesh, shapes: Mapping[str, Float32], info: FaceInfo | None = None) -> Rig:
        """A rig from the positions (V, 3) of each shape by name."""
        names = tuple(Shape(name, plain_label(name)) for name in shapes)
        deltas = np.empty((len(names), neutral.vertex_count, 3), np.float32)
        for k, (name, positions) in enumerate(shapes.items()):
            if positions.shape != neutral.positions.shape:
                raise MeshDataError(
                    f"shape {name!r} has positions {positions.shape}, the neutral {neutral.positions.shape}."
                )
            np.subtract(positions, neutral.positions, out=deltas[k])
        return cls(neutral, names, deltas, info or FaceInfo("face"))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The shapes' names in order, (K,)."""
        return tuple(shape.name for shape in self.shapes)

    @cached_property
    def _activation(self) -> Activation:
        return Activation(self.names, self.correctives)

    @cached_property
    def controls(self) -> tuple[Shape, ...]:
        """The shapes that have a weight of their own: all but those that follow from others."""
        return tuple(shape for shape in self.shapes if shape.set != CORRECTIVE)

    def linear(self) -> Rig:
        """The same rig with its correctives at rest: every face is the plain sum of its shapes."""
        return replace(self, corrected=False) if self.correctives and self.corrected else self

    @cached_property
    def triangles(self) -> Int32:
        """Triangles (T, 3) over the positions, from the neutral's polygons."""
        return triangulated(self.neutral).vertices

    def shapes_in(self, set_name: str) -> tuple[Shape, ...]:
        """The shapes of one set, in order."""
        return tuple(shape for shape in self.shapes if shape.set == set_name)

    def shape(self, name: str) -> Shape:
        """The shape called `name`. Raises `UnknownNameError`."""
        for shape in self.shapes:
            if shape.name == name:
                return shape
        raise UnknownNameError("shape", name, self.names)

    def coefficients(self, pose: Pose | Mapping[str, float]) -> Float64:
        """Coefficients (K,) of all shapes in `pose`, those that correctives switch on included."""
        plain = as_pose(pose).coefficients(self.names)
        return self._activation(plain) if self.correctives and self.corrected else plain

    def positions(self, pose: Pose | Mapping[str, float]) -> Float32:
        """Positions (V, 3) float32 of the face in `pose` (a `Pose`, or shape name -> weight)."""
        return morphed_positions(self.neutral.positions, self.deltas, self.coefficients(pose))

    def normals(self, pose: Pose | Mapping[str, float]) -> Float32:
        """Unit normals (V, 3) of the morphed surface, area-weighted."""
        return vertex_normals(self.positions(pose), self.triangles)

    def posed(self, pose: Pose | Mapping[str, float]) -> Mesh:
        """The face in `pose` as a mesh: same order, polygons, groups, uvs, materials."""
        return self.neutral.with_positions(self.positions(pose))


def as_pose(pose: Pose | Mapping[str, float]) -> Pose:
    """`pose` itself, or the pose that a mapping of shape names to weights stands for."""
    return pose if isinstance(pose, Pose) else Pose.of(pose)


def plain_label(name: str) -> str:
    """A name as shown to people: `lip_corner` -> `Lip corner`."""
    words = name.replace("_", " ").strip()
    return words[:1].upper() + words[1:] if words else name
