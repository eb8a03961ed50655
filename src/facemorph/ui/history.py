"""Undo and redo: one list of snapshots, filled by looking at what a frame left behind.

No panel reports its changes. At the end of each frame the present snapshot is compared with the last
one kept; when they differ and the hand is off the controls, the difference becomes one step. So a
drag is one step, and no way of changing a face can be forgotten.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from facemorph.core.pose import Pose
from facemorph.deform.controls import Controls
from facemorph.deform.regions import RegionSet
from facemorph.ui.fit_plan import FitPlan
from facemorph.ui.words import change_words

if TYPE_CHECKING:
    from facemorph.ui.state import Face

MOST_STEPS = 300
# A rig holds tens of megabytes, so older faces are let go together with the steps that need them.
MOST_FACES = 4
MOST_PEOPLE = 16


@dataclass(frozen=True)
class Snapshot:
    """What one step of undo brings back."""

    face: Face | None
    pose: Pose
    shapes_on: bool
    controls: Controls = field(default_factory=Controls)
    painted: RegionSet | None = None
    fit: FitPlan = field(default_factory=FitPlan)

    @property
    def people(self) -> set[str]:
        """Everybody in the mixture, by name."""
        mix = self.controls.people.mix
        return set() if mix is None else {*mix.source, mix.target}


@dataclass
class History:
    """Snapshots before and after the present one, each with what led away from it in plain words."""

    present: Snapshot | None = None
    _past: list[tuple[Snapshot, str]] = field(default_factory=list)
    _future: list[tuple[Snapshot, str]] = field(default_factory=list)

    def settle(self, now: Snapshot, *, busy: bool) -> None:
        """Keep `now` as a step of its own, unless nothing changed or a drag is still going on (`busy`)."""
        if busy or now == self.present:
            return
        if self.present is not None and self.present.face is not None:
            self._past.append((self.present, change_words(self.present, now)))
            self._future.clear()
            self._forget()
        self.present = now

    def carry(self, moved: Callable[[Snapshot], Snapshot]) -> None:
        """Let the present snapshot go along with what moves by itself, so that no step comes of it."""
        if self.present is not None:
            self.present = moved(self.present)

    def undo(self, now: Snapshot) -> Snapshot | None:
        """The snapshot one step back, or None at the beginning."""
        self.settle(now, busy=False)
        return self._move(self._past, self._future)

    def redo(self, now: Snapshot) -> Snapshot | None:
        """The snapshot one step forward, or None at the end."""
        self.settle(now, busy=False)
        return self._move(self._future, self._past)

    def people(self) -> set[str]:
        """Everybody whom some step needs, by name."""
        steps = [snapshot for snapshot, _ in (*self._past, *self._future)]
        kept = steps if self.present is None else [*steps, self.present]
        return {name for snapshot in kept for name in snapshot.people}

    @property
    def undo_words(self) -> str:
        """What undo would take back, or "" where there is nothing."""
        return self._past[-1][1] if self._past else ""

    @property
    def redo_words(self) -> str:
        """What redo would do again, or ""."""
        return self._future[-1][1] if self._future else ""

    def _move(
        self, from_steps: list[tuple[Snapshot, str]], to_steps: list[tuple[Snapshot, str]]
    ) -> Snapshot | None:
        if not from_steps or self.present is None:
            return None
        snapshot, words = from_steps.pop()
        to_steps.append((self.present, words))
        self.present = snapshot
        return snapshot

    def _forget(self) -> None:
        del self._past[: max(len(self._past) - MOST_STEPS, 0)]
        faces: list[int] = []
        people: set[str] = set()
        for place in range(len(self._past) - 1, -1, -1):
            key = id(self._past[place][0].face)
            if key not in faces:
                faces.append(key)
            people |= self._past[place][0].people
            if len(faces) > MOST_FACES or len(people) > MOST_PEOPLE:
                del self._past[: place + 1]
                return
