"""What the page Fit keeps for itself and works out of the plan: no part of undo."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from facemorph.core.arrays import Float32, Float64, Int64
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit.result import Example, FitResult, Iteration

if TYPE_CHECKING:
    from facemorph.fit.transferring import Transfer
    from facemorph.ui.fit_plan import FitPlan, Piece
    from facemorph.ui.state import App, Face

T = TypeVar("T")
TITLE = "Fit"
MOST_KEPT = 40
# Kinds of work beside the window.
START_JOB, MAKE_JOB, WRAP_JOB = "fit start", "fit make", "fit wrap"
TEMPLATE, NEUTRAL, EXAMPLES, WEIGHTS, MAKE, RESULT, SAVE = range(7)


@dataclass(frozen=True, eq=False)
class Preview:
    """The template's shapes transferred to the person's neutral: `of` is what they were made from."""

    of: tuple[Rig, Mesh]
    way: Transfer
    face: Face


@dataclass(frozen=True, eq=False)
class Start:
    """What the transferred shapes make of an example, and where it is placed beside them.

    weights  the estimate, shape name -> 0..1; placed (V, 3) the example in the neutral's place
    order    names of the shapes, those that matter most to this example first
    named    the shapes that the example is called by, if the estimate is of these alone
    """

    of: tuple[object, ...]
    weights: Mapping[str, float]
    placed: Float32
    order: tuple[str, ...]
    named: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Made:
    """A person's shapes as they were made, from which plan, and what plain transfer does at its best.

    added  (example, shape): what was left of an example and became a shape; `without` is without these
    """

    plan: FitPlan
    result: FitResult
    plain: tuple[Example, ...]
    face: Face
    without: FitResult
    added: tuple[tuple[str, str], ...] = ()


@dataclass
class FitPage:
    """Which step is open, which piece is on show, and what was worked out.

    keys      how many pieces there have been: the last one's key
    vertex    a point of the template that waits for its twin on the scan
    held      which point of the scan is dragged; held_from is the piece as it was before
    skipped   landmarks passed over
    turns     how scans lying otherwise are turned before there are points, by the piece's key, (3, 3)
    told      iterations of the run going on
    untwinned meshes that the neutral is not carried along to (again), each with the neutral: weak references
    nearest   the vertices of a mesh nearest to a point
    kept      what is on show, by what it is made of: see `keep`
    """

    step: int = TEMPLATE
    selected: int = 0
    keys: int = 0
    vertex: int | None = None
    held: int | None = None
    held_from: Piece | None = None
    skipped: frozenset[str] = frozenset()
    shows_wrap: bool = True
    heat: bool = False
    search: str = ""
    name: str = ""
    turns: dict[int, Float64] = field(default_factory=dict)
    preview: Preview | None = None
    starts: dict[int, Start] = field(default_factory=dict)
    failed: tuple[object, ...] = ()
    told: list[Iteration] = field(default_factory=list)
    made: Made | None = None
    shape_for: str = ""
    untwinned: frozenset[object] = frozenset()
    shape_name: str = ""
    saved: str = ""
    kept: dict[object, Any] = field(default_factory=dict)
    nearest: dict[tuple[Mesh, bytes], Int64] = field(default_factory=dict)

    def keep(self, key: object, make: Callable[[], T]) -> T:
        """What was made for a key: the same object as long as it is asked for; what is not, goes."""
        found: T = self.kept.pop(key) if key in self.kept else make()
        self.kept[key] = found
        while len(self.kept) > MOST_KEPT:
            del self.kept[next(iter(self.kept))]
        return found

    def forget_points(self) -> None:
        """Nothing is asked for, held or passed over."""
        self.vertex = self.held = self.held_from = None
        self.skipped = frozenset()


def on_show(app: App) -> bool:
    """Whether the page is the one on show."""
    return app.settings.right_page == TITLE and app.settings.right_open and not app.panels_hidden
