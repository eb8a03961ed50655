"""Playing the slider over time."""

from __future__ import annotations

from dataclasses import dataclass

SHORTEST_SECS, LONGEST_SECS = 0.1, 60.0


@dataclass
class Playback:
    """Runs t from 0 to 1 in `duration_secs`; looped, it runs there and back, so that the face never jumps.

    `phase` counts ways: 0..1 from source to target, 1..2 back again.
    """

    playing: bool = False
    loop: bool = False
    duration_secs: float = 1.5
    phase: float = 0.0

    def start(self, t: float) -> None:
        """Play on from where the slider stands; from its end, once through again."""
        self.playing = True
        inside = min(max(t, 0.0), 1.0)
        self.phase = inside if inside < 1.0 or self.loop else 0.0

    def stop(self) -> None:
        """Leave the slider where it is."""
        self.playing = False

    def advanced(self, elapsed_secs: float) -> float:
        """The slider's t after so many seconds more; stops itself at the end of a single run."""
        # A single run ends at the target; a loop switched off on its way back ends where it came from.
        end = 1.0 if self.phase < 1.0 else 2.0
        self.phase += elapsed_secs / min(max(self.duration_secs, SHORTEST_SECS), LONGEST_SECS)
        if self.loop:
            self.phase %= 2.0
        elif self.phase >= end:
            self.playing, self.phase = False, 0.0
            return 1.0 if end == 1.0 else 0.0
        return self.phase if self.phase <= 1.0 else 2.0 - self.phase
