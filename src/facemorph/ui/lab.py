"""What the pages Handles, Regions and Compare keep for themselves: no part of the face or of undo."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from facemorph.core.arrays import Float32, Float64
from facemorph.core.pose import NEUTRAL
from facemorph.core.scene import Scene
from facemorph.deform.handles import Vector
from facemorph.deform.rbf import Kernel
from facemorph.deform.rebuild import Rebuilt

if TYPE_CHECKING:
    from facemorph.ui.on_screen import Surface


@dataclass(frozen=True, eq=False)
class Grab:
    """A point held by the mouse: `axis` (3,) is where it may go, None for the plane that faces the camera."""

    vertex: int
    twin: int | None
    moved: Vector
    place: Float64
    axis: Float64 | None
    start: tuple[float, float]


@dataclass
class HandlesPage:
    """The points' page: what a click sets, the point selected and the one under the pointer."""

    sets: str = "Set points"
    mirror: bool = True
    selected: int | None = None
    hovered: int | None = None
    grab: Grab | None = None
    name: str = ""


@dataclass(frozen=True, eq=False)
class Sweep:
    """Error (percent of the diagonal) and times (ms) against the number of points, by kernel, (n,) each."""

    counts: Float64
    errors: dict[Kernel, Float64]
    bind_ms: dict[Kernel, Float64]


@dataclass
class RebuildPage:
    """Rebuilding an expression from n points: what is asked for, and what came of it last."""

    on: bool = False
    heat: bool = True
    source: str = NEUTRAL
    target: str = ""
    count: int = 40
    kernel: Kernel = "r"
    c: float | None = None
    asked: tuple[object, ...] = ()
    problem: str = ""
    result: Rebuilt | None = None
    scene: Scene | None = None
    vertices: tuple[int, ...] = ()
    sweep: Sweep | None = None
    swept: tuple[object, ...] = ()


@dataclass
class RegionsPage:
    """The regions' page: the row that is open, and the brush."""

    opened: str = ""
    painting: bool = False
    region: str = ""
    radius: float = 0.0  # model units; 0 until the face is known
    strength: float = 0.5
    takes: bool = False
    mirror: bool = True
    stroke: Float32 | None = None  # region weights (R, V) while the brush is down
    last_dab: tuple[float, float] | None = None  # where the brush was set down last
    lit: tuple[object, Float32 | None] = (None, None)  # kept so that the same light is the same array


@dataclass(frozen=True, eq=False)
class Paths:
    """What a vertex, or a weight, does as t runs from 0 to 1: (n,) each, by method.

    value         a vertex's distance from where it starts; a weight itself
    speed         how fast that changes; acceleration how fast the speed does
    """

    t: Float64
    value: dict[str, Float64]
    speed: dict[str, Float64]
    acceleration: dict[str, Float64]


@dataclass
class ComparePage:
    """The comparison: the vertex or the weight watched, its paths, and the two methods of the split view."""

    follows: str = "A vertex"
    vertex: int | None = None
    shape: str = ""
    paths: Paths | None = None
    asked: tuple[object, ...] = ()
    split: bool = False
    left: str = "Linear"
    right: str = "Cosine"
    heat: bool = True
    kept: tuple[object, ...] = ()  # what `scenes` were made from
    scenes: tuple[Scene, Scene] | None = None
    difference: tuple[float, float] = (0.0, 0.0)  # largest and rms, model units
    rebuilt: tuple[tuple[object, ...], Float32 | None] = ((), None)  # whole way by RBF, and what of


@dataclass
class Lab:
    """All of it; a face that is opened starts with a new one."""

    handles: HandlesPage = field(default_factory=HandlesPage)
    rebuild: RebuildPage = field(default_factory=RebuildPage)
    regions: RegionsPage = field(default_factory=RegionsPage)
    compare: ComparePage = field(default_factory=ComparePage)
    surface: Surface | None = None
