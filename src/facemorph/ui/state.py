"""`App`: the one state object of the window. Panels read it, draw, and assign back.

It knows no window and no graphics: what it wants of them it writes down as a wish (`framing`,
`pick_at`, `picture_path`, `quit`), and `session.Session` fulfils the wishes once a frame.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.pose import Pose, state_of
from facemorph.core.rig import EXPRESSION, Rig, Shape
from facemorph.core.scene import Scene
from facemorph.deform.controls import Controls
from facemorph.deform.regions import RegionSet
from facemorph.gl.describe import Graphics
from facemorph.gl.form import Form
from facemorph.gl.heat import Legend
from facemorph.ui.fit_plan import FitPlan
from facemorph.ui.history import History, Snapshot
from facemorph.ui.jobs import Jobs
from facemorph.ui.lab import Lab
from facemorph.ui.messages import Messages
from facemorph.ui.methods import Methods
from facemorph.ui.on_face import OnFace
from facemorph.ui.pages import Pages
from facemorph.ui.playback import Playback
from facemorph.ui.settings import Settings

if TYPE_CHECKING:
    from facemorph.ui.dialogs import NativeDialog
    from facemorph.ui.on_screen import Surface
    from facemorph.ui.paths import Entry


@dataclass(frozen=True, eq=False)
class Face:
    """A loaded rig and what it was loaded from: a built-in's name, a folder, or files.

    form  its surface made ready for drawing beside the window, where that was done
    """

    rig: Rig
    source: tuple[str, ...]
    builtin: bool = False
    form: Form | None = None

    @property
    def title(self) -> str:
        """The face's own name."""
        return self.rig.info.name


@dataclass(frozen=True)
class Viewport:
    """Where the face is shown, in the interface's units, and how many pixels a unit has."""

    x: float = 0.0
    y: float = 0.0
    width: float = 1.0
    height: float = 1.0
    pixels_per_unit: float = 1.0

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels, at least 1."""
        return (
            max(round(self.width * self.pixels_per_unit), 1),
            max(round(self.height * self.pixels_per_unit), 1),
        )

    @property
    def aspect(self) -> float:
        """Width over height."""
        width, height = self.size
        return width / height

    def contains(self, x: float, y: float) -> bool:
        """Whether a place in the interface's units lies inside."""
        return self.x <= x < self.x + self.width and self.y <= y < self.y + self.height

    def centred(self, x: float, y: float) -> tuple[float, float]:
        """A place as `Camera` takes it: from the centre, in halves of the height, y up."""
        half = max(self.height, 1.0) / 2.0
        return (x - self.x - self.width / 2.0) / half, (self.y + self.height / 2.0 - y) / half

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """A place as a pixel of the face's picture, from its top left."""
        return (x - self.x) * self.pixels_per_unit, (y - self.y) * self.pixels_per_unit


@dataclass
class ShapesPanel:
    """The shapes panel's own: what is searched, and the active shapes in the order they are listed."""

    search: str = ""
    active: tuple[str, ...] = ()
    listed_search: str = ""


@dataclass
class Palette:
    """The command palette: open, the words typed, the entry marked."""

    open: bool = False
    words: str = ""
    marked: int = 0
    fresh: bool = False


@dataclass
class Chooser:
    """The window's own file chooser, used where the desktop has none. `purpose` "" is shut."""

    purpose: str = ""
    path: str = ""
    fresh: bool = False
    replacing: str = ""
    dialog: NativeDialog | None = None  # the desktop's own, while it is open
    listed: tuple[str, list[Entry]] | None = None  # the typed path and what completes it


@dataclass
class App:
    """Everything that the window shows and changes."""

    settings: Settings = field(default_factory=Settings)
    jobs: Jobs = field(default_factory=Jobs)
    messages: Messages = field(default_factory=Messages)
    history: History = field(default_factory=History)
    playback: Playback = field(default_factory=Playback)
    graphics: Graphics | None = None  # what draws, for Help > About

    face: Face | None = None
    pose: Pose = field(default_factory=Pose)
    shapes_on: bool = True
    controls: Controls = field(default_factory=Controls)  # what the methods beside the shapes are set to
    methods: Methods = field(default_factory=Methods)
    painted: RegionSet | None = None  # regions painted on the face, in place of the rig's own
    fit: FitPlan = field(default_factory=FitPlan)  # what a person's shapes are to be made of
    on_face: OnFace = field(default_factory=OnFace)
    lab: Lab = field(default_factory=Lab)
    camera: Camera = field(default_factory=Camera)
    look: Look = field(default_factory=Look)
    luminance_problem: str = ""  # why the face has not the luminance that was asked for
    form: Form | None = None  # the refined surface that the look's subdivision shows
    turntable: bool = False
    legend: Legend | None = None  # of the heat map as drawn last
    second_legend: Legend | None = None  # of the second view's, where the face is seen twice
    viewport: Viewport = field(default_factory=Viewport)

    pages: Pages = field(default_factory=Pages)
    shapes: ShapesPanel = field(default_factory=ShapesPanel)
    palette: Palette = field(default_factory=Palette)
    chooser: Chooser = field(default_factory=Chooser)
    keys_open: bool = False
    about_open: bool = False
    panels_hidden: bool = False
    typing: str = ""  # the slider whose value is being typed
    typing_fresh: bool = False  # the field has yet to take the keyboard
    builtins: tuple[str, ...] = ()  # names of the built-in faces
    drag: str = ""  # what the mouse does to the face: "orbit", "pan", "tool" (the page's), or none
    pressed_at: tuple[float, float] | None = None  # of the left button, while it may be a click
    face_pictures: dict[str, int] = field(default_factory=dict)  # built-in's name -> texture

    arriving: Face | None = None  # loaded, and to be shown if the renderer takes it
    arriving_pose: Pose | None = None  # to show it in, or at rest
    framing: str | None = "front"  # a direction to frame the face from
    pick_at: tuple[float, float] | None = None  # pixel of the surface to turn about from now on
    picture_path: Path | None = None  # where the next frame is to be saved
    native_dialogs: bool = False  # the desktop can ask for files
    quit: bool = False

    @property
    def rig(self) -> Rig | None:
        """The present face's rig."""
        return self.face.rig if self.face else None

    @property
    def shown_face(self) -> Face | None:
        """What the viewport shows: what the page on show has put there, else the open face."""
        return self.on_face.stage or self.face

    @property
    def expressions(self) -> tuple[Shape, ...]:
        """Whole expressions of the present face, without neutral."""
        return self.face.rig.shapes_in(EXPRESSION) if self.face else ()

    @property
    def shown_pose(self) -> Pose:
        """The pose that is drawn, saved and exported: without the shapes where they are switched off."""
        return self.pose if self.shapes_on else replace(self.pose, weights={})

    def surface(self, make: Callable[[Rig], Surface]) -> Surface | None:
        """The present face's surface; made once a head."""
        if self.face is None:
            return None
        kept = self.lab.surface
        if kept is None or kept.rig.neutral is not self.face.rig.neutral:
            kept = self.lab.surface = make(self.face.rig)
        return kept

    def views(self) -> tuple[Viewport, ...]:
        """The viewport, or its two halves where the face is seen twice."""
        view = self.viewport
        if self.on_face.split is None:
            return (view,)
        half = view.width / 2.0
        return replace(view, width=half), replace(view, x=view.x + half, width=half)

    def view_at(self, x: float, y: float) -> Viewport:
        """The view that holds a place of the window, or the first."""
        return next((view for view in self.views() if view.contains(x, y)), self.views()[0])

    @property
    def shown_look(self) -> Look:
        """How the face is drawn: as chosen, or with the shading that the page on show wants."""
        shading = self.on_face.shading
        return self.look if shading is None else replace(self.look, shading=shading)

    def scene(self) -> Scene:
        """What is drawn, saved and exported: the shown pose with what all methods add."""
        if self.on_face.stage is not None:
            return self.on_face.scene or Scene(Pose())
        return self.on_face.scene or self.methods.scene(self)

    def shown_state(self) -> dict[str, float]:
        """Shape name -> weight of all that is drawn."""
        pose = self.scene().pose
        state = pose.way_state()
        for name, weight in pose.weights.items():
            state[name] = state.get(name, 0.0) + weight
        return {name: weight for name, weight in state.items() if weight != 0.0}

    def snapshot(self) -> Snapshot:
        """What undo would bring back."""
        return Snapshot(self.face, self.pose, self.shapes_on, self.controls, self.painted, self.fit)

    def restore(self, snapshot: Snapshot) -> None:
        """Bring back a snapshot; another face is framed anew."""
        if not same_head(snapshot.face, self.face):
            self.framing = "front"
        self.face, self.pose, self.shapes_on = snapshot.face, snapshot.pose, snapshot.shapes_on
        self.controls, self.painted, self.fit = snapshot.controls, snapshot.painted, snapshot.fit
        self.stop_playing()

    def show(self, face: Face, pose: Pose | None = None) -> None:
        """Make `face` the present one, at rest or in `pose`, seen from the front."""
        self.face = face
        self.pose = pose if pose is not None else first_pose(face.rig, self.settings)
        self.shapes_on = True
        self.controls, self.painted = Controls(), None
        self.lab = Lab()
        self.framing = "front"
        self.shapes = ShapesPanel()
        self.stop_playing()

    def stop_playing(self) -> None:
        """Leave everything that plays where it is."""
        self.playback.stop()
        self.pages.emotion.player.stop()

    def type_into(self, name: str) -> None:
        """Open the number beside a slider for typing."""
        self.typing, self.typing_fresh = name, True


def same_head(one: Face | None, other: Face | None) -> bool:
    """Whether two faces are one head, perhaps with shapes that were made since."""
    return one is other or bool(one and other and one.rig.neutral is other.rig.neutral)


def first_pose(rig: Rig, settings: Settings) -> Pose:
    """At rest, with the first expression as the slider's goal, so that the slider does something."""
    expressions = rig.shapes_in(EXPRESSION)
    target = state_of(expressions[0].name) if expressions else {}
    return Pose(target=target, curve="linear" if settings.curve == "linear" else "cosine")
