"""A path of the cursor over the emotion map: recorded with its times, and where it was at any of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.errors import OptionError

LONGEST_SECS = 60.0
MOST_SAMPLES = 20_000
Sample = tuple[float, float, float]


@dataclass(frozen=True)
class EmotionPath:
    """Samples (seconds since the start, x, y) in the order of their times; evenly in between.

    Raises `OptionError` for fewer than two samples, more than `MOST_SAMPLES`, times that do not start at
    0 and rise to at most `LONGEST_SECS`, or a place beyond -1..1.
    """

    samples: tuple[Sample, ...]

    def __post_init__(self) -> None:
        if not 2 <= len(self.samples) <= MOST_SAMPLES:
            raise OptionError(
                f"a path takes 2 to {MOST_SAMPLES:,} samples of seconds, x, y; there are {len(self.samples)}."
            )
        before = 0.0
        for place, (secs, x, y) in enumerate(self.samples, start=1):
            if not (before <= secs <= LONGEST_SECS) or (place == 1 and secs != 0.0):
                raise OptionError(
                    f"sample {place} of a path is at {secs:g} s; times start at 0 and rise to at most "
                    f"{LONGEST_SECS:g}."
                )
            if not (abs(x) <= 1.0 and abs(y) <= 1.0):
                raise OptionError(f"sample {place} of a path is at {x:g}, {y:g}; both lie from -1 to 1.")
            before = secs
        if before == 0.0:
            raise OptionError("a path lasts longer than 0 s.")

    @property
    def duration_secs(self) -> float:
        """When its last sample was taken."""
        return self.samples[-1][0]

    def at(self, secs: float) -> tuple[float, float]:
        """Where the cursor was; before the start and after the end it stands still."""
        times, x, y = self._columns
        return float(np.interp(secs, times, x)), float(np.interp(secs, times, y))

    @cached_property
    def outline(self) -> tuple[tuple[float, float], ...]:
        """Places to draw the path through: all of them, or every so many of a long one, and the last."""
        return thinned(self.samples)

    @cached_property
    def _columns(self) -> Float64:
        """Seconds, x and y, (3, n)."""
        return np.array(self.samples, np.float64).T


def thinned(samples: Sequence[Sample], most: int = 400) -> tuple[tuple[float, float], ...]:
    """The places of samples, at most about `most` of them, with the first and the last."""
    step = max(math.ceil(len(samples) / most), 1)
    return tuple((x, y) for _, x, y in (*samples[::step], *samples[-1:]))


@dataclass
class Recorder:
    """Takes down where the cursor is, from its first press to its last; standing still costs nothing.

    Times are those of any clock. Time between two drags counts, time after the last does not.
    """

    samples: list[Sample] = field(default_factory=list)
    _started: float = math.nan
    _active_secs: float = 0.0

    @property
    def started(self) -> bool:
        """Whether the clock runs: the cursor was pressed."""
        return bool(self.samples)

    @property
    def secs(self) -> float:
        """How long it has been recording."""
        return self.samples[-1][0] if self.samples else 0.0

    @property
    def full(self) -> bool:
        """Nothing more goes into a path."""
        return self.secs >= LONGEST_SECS or len(self.samples) >= MOST_SAMPLES

    def take(self, now_secs: float, x: float, y: float, *, held: bool) -> None:
        """The cursor is here now, and the hand on it or not; nothing counts before it is held first."""
        if not self.samples:
            if held:
                self._started = now_secs
                self.samples.append((0.0, x, y))
            return
        if self.full:
            return
        secs = min(max(now_secs - self._started, self.secs), LONGEST_SECS)
        moved = self.samples[-1][1:] != (x, y)
        if held or moved:
            self._active_secs = secs
        standing = len(self.samples) > 1 and self.samples[-2][1:] == (x, y) and not moved
        if standing:
            self.samples[-1] = (secs, x, y)
        else:
            self.samples.append((secs, x, y))

    def path(self) -> EmotionPath | None:
        """What was recorded; None where the cursor did not move, or for no time."""
        samples = self._until_active()
        if len({sample[1:] for sample in samples}) < 2 or samples[-1][0] <= 0.0:
            return None
        return EmotionPath(tuple(samples))

    def _until_active(self) -> Sequence[Sample]:
        """Without the standing still after the hand was off; it is one sample, or the end of one."""
        if self.secs <= self._active_secs:
            return self.samples
        _, x, y = self.samples[-1]
        before = self.samples[:-1]
        ends_there = bool(before) and before[-1] == (self._active_secs, x, y)
        return before if ends_there else [*before, (self._active_secs, x, y)]
