"""What the Emotion page keeps for itself: the hand on the pad, and the path recorded or played."""

from __future__ import annotations

from dataclasses import dataclass, field

from facemorph.core.emotion_path import EmotionPath, Recorder
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Shape
from facemorph.ui.playback import Playback

SLOWEST, FASTEST = 0.1, 4.0


@dataclass(frozen=True)
class Pad:
    """Where the pad was drawn last: its middle and the circle's radius, in the interface's units."""

    x: float
    y: float
    radius: float

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a place of the map is on the window."""
        return self.x + x * self.radius, self.y - y * self.radius

    def on_map(self, x: float, y: float) -> tuple[float, float]:
        """The place of the map that a place of the window is: the inverse of `place`."""
        return (x - self.x) / self.radius, (self.y - y) / self.radius


@dataclass
class EmotionPage:
    """Kept while other faces are opened, so that one path can be played on several people.

    grab       what the hand holds: "cursor", "pole" (then `pole` names it), "" for nothing
    recorder   takes down the cursor; None while nothing is recorded
    path       recorded last or opened; `player` runs along it, there and back where it loops
    wanted     the poles whose pictures the page shows; said anew every frame
    pictures   pole's name -> texture, of the head `pictured`; filled by `pole_pictures`
    """

    pad: Pad | None = None
    grab: str = ""
    pole: str = ""
    pressed_at: tuple[float, float] = (0.0, 0.0)
    pole_moved: bool = False
    recorder: Recorder | None = None
    path: EmotionPath | None = None
    player: Playback = field(default_factory=Playback)
    played: float = 0.0  # how much of the path, 0..1
    speed: float = 1.0
    wanted: tuple[Shape, ...] = ()
    pictures: dict[str, int] = field(default_factory=dict)
    pictured: Mesh | None = None

    @property
    def moves_by_itself(self) -> bool:
        """Whether frames are wanted though nobody does anything."""
        return self.player.playing or (self.recorder is not None and self.recorder.started)
