"""What the page on show does with the face: said anew every frame, gone when the page is left."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from facemorph.core.arrays import Float32
from facemorph.core.picture import Shading
from facemorph.core.scene import Scene

if TYPE_CHECKING:
    from facemorph.ui.state import App, Face


class Tool(Protocol):
    """What the mouse does on the face in place of turning it."""

    def press(self, app: App, x: float, y: float, button: int) -> bool:
        """A button went down at a place of the window; True takes the drag that follows."""

    def drag(self, app: App, x: float, y: float) -> None:
        """The pointer of a taken drag is here now."""

    def release(self, app: App) -> None:
        """The taken drag is over."""

    def click(self, app: App, x: float, y: float) -> None:
        """The left button came up again where it went down, and the press was not taken."""

    def paint(self, app: App) -> None:
        """Draw over the face; the present ImGui window covers the viewport."""


class OnlyPaints:
    """A tool that draws over the face and leaves the mouse to the camera."""

    def press(self, app: App, x: float, y: float, button: int) -> bool:
        """Nothing is taken."""
        return False

    def drag(self, app: App, x: float, y: float) -> None:
        """Nothing was taken."""

    def release(self, app: App) -> None:
        """Nothing was taken."""

    def click(self, app: App, x: float, y: float) -> None:
        """A click does nothing."""


@dataclass(frozen=True, eq=False)
class Split:
    """A second view, right of the first: what it shows, and what is written over each.

    face   is seen on the right; None for the one on the left
    """

    right: Scene
    words: tuple[str, str]
    heat: bool
    face: Face | None = None


@dataclass(eq=False)
class OnFace:
    """What a page wants of the face while it is on show.

    tool     takes the mouse on the face
    stage    is shown in place of the open face, from a camera of its own
    scene    is drawn in place of what the methods make; `words` then says what it is, `legend` what a
             heat map of it measures
    glow     (V,) float32 0..1, where the face lights up
    split    a second view beside the first
    shading  is used in place of the chosen one
    tells    kinds of work whose progress the page itself shows
    """

    tool: Tool | None = None
    stage: Face | None = None
    scene: Scene | None = None
    words: tuple[str, ...] = ()
    legend: str = ""
    glow: Float32 | None = None
    split: Split | None = None
    shading: Shading | None = None
    tells: frozenset[str] = frozenset()


def clear(app: App, layout: object) -> None:
    """The first of the parts that may say what is done with the face: nothing, until a page says more."""
    app.on_face = OnFace()
