"""Poses, changes and times in plain words, for menus, lists and the text over the face."""

from __future__ import annotations

from typing import TYPE_CHECKING

from facemorph.core.pose import State
from facemorph.core.rig import Rig, plain_label
from facemorph.deform.controls import METHODS, PeopleControl
from facemorph.ui.fit_plan import plan_words
from facemorph.ui.methods import OWN

if TYPE_CHECKING:
    from facemorph.ui.history import Snapshot

NEUTRAL_LABEL = "Neutral"
METHOD_WORDS = {
    "facs": "FACS units",
    "emotion": "emotion map",
    "people": "people",
    "handles": "handles",
    "regions": "regions",
}


def label_of(rig: Rig, name: str) -> str:
    """The words shown for a shape; a name that the rig does not know is shown as it is."""
    for shape in rig.shapes:
        if shape.name == name:
            return shape.label
    return plain_label(name)


def percent(weight: float) -> str:
    """0.62 -> `62 %`."""
    return f"{round(weight * 100)} %"


def state_words(rig: Rig, state: State, most: int = 2) -> str:
    """A mixture of shapes in a few words: `Neutral`, `Happy`, `Happy 62 %`, `Happy 62 %, Sad 20 %`."""
    parts = [(name, weight) for name, weight in state.items() if round(weight * 100) != 0]
    if not parts:
        return NEUTRAL_LABEL
    parts.sort(key=lambda part: -abs(part[1]))
    if len(parts) == 1 and round(parts[0][1] * 100) == 100:
        return label_of(rig, parts[0][0])
    shown = ", ".join(f"{label_of(rig, name)} {percent(weight)}" for name, weight in parts[:most])
    return shown if len(parts) <= most else f"{shown}, {len(parts) - most} more"


def change_words(before: Snapshot, after: Snapshot) -> str:
    """What happened between two snapshots, as `Undo` names it."""
    if before.face is not after.face:
        if before.face and after.face and before.face.rig.neutral is after.face.rig.neutral:
            if before.face.rig.corrected != after.face.rig.corrected:
                return "correctives on" if after.face.rig.corrected else "correctives off"
            return f"keep {after.face.rig.shapes[-1].label}"
        return f"open {after.face.title}" if after.face else "close the face"
    if before.fit != after.fit:
        return plan_words(before.fit, after.fit)
    if before.shapes_on != after.shapes_on:
        return "shapes on" if after.shapes_on else "shapes off"
    if before.painted is not after.painted:
        return "painted regions"
    changed = [m for m in METHODS if getattr(before.controls, m) != getattr(after.controls, m)]
    switched = before.controls.off ^ after.controls.off
    if changed[:1] == ["people"]:
        return _people_words(before.controls.people, after)
    if changed or switched:
        return METHOD_WORDS[next(iter(changed or sorted(switched)))]
    was, now = before.pose, after.pose
    rig = after.face.rig if after.face else None
    names = [n for n in {**was.weights, **now.weights} if was.weights.get(n, 0) != now.weights.get(n, 0)]
    if names:
        return label_of(rig, names[0]) if rig and len(names) == 1 else f"{len(names)} shapes"
    if was.target != now.target:
        return f"choose {state_words(rig, now.target)}" if rig else "choose"
    if was.curve != now.curve:
        return f"{now.curve} motion"
    if was.t != now.t and was.source == now.source:
        return f"slider to {now.t:.2f}"
    return f"start from {state_words(rig, now.source)}" if rig else "start"


def _people_words(was: PeopleControl, after: Snapshot) -> str:
    now, rig = after.controls.people, after.face.rig if after.face else None
    goal = now.mix.target if now.mix else OWN
    if goal not in (OWN, was.mix.target if was.mix else OWN):
        return f"people, choose {goal}"
    # The page's first goal is there without being chosen; the first drag only writes it down.
    chosen = now.target != was.target and bool(was.source or was.target or now.t == 0.0)
    if rig is not None and chosen and (now.source or now.target):
        return f"people, choose {state_words(rig, now.target)}"
    places = [(kept.mix.s if kept.mix else 0.0, kept.t) for kept in (was, now)]
    return METHOD_WORDS["people"] if places[0] == places[1] else "people to {:.2f}, {:.2f}".format(*places[1])


def duration_words(seconds: float) -> str:
    """How long something still takes: `3 s`, `2 min`."""
    if seconds < 1.0:
        return "under 1 s"
    return f"{round(seconds)} s" if seconds < 90.0 else f"{round(seconds / 60.0)} min"
