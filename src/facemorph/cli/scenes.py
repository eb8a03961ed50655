"""The pose options of `render` and `export` into a rig and a scene: both mean the same by them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace

from facemorph.cli.values import pose_between, pose_from
from facemorph.core.facs import Sides, known_unit, parsed_units, units_of
from facemorph.core.pose import NEUTRAL, parsed_number, parsed_weight
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, Scene
from facemorph.deform.controls import BoundControls, Controls, EmotionControl, PeopleControl
from facemorph.deform.people import People, PeopleMix
from facemorph.errors import OptionError, UnknownNameError


def rig_and_scene(options: argparse.Namespace) -> tuple[Rig, Scene]:
    """What to draw or export. Raises what loading and the methods raise, and `OptionError`."""
    if options.bilinear is None:
        if options.s is not None:
            raise OptionError("--s goes with --bilinear FACE1,FACE2 EXPRESSION1,EXPRESSION2.")
        if not options.face:
            raise OptionError("no face was named: a built-in name, a folder, or mesh files.")
        rig = _loaded(options, options.face)
        pose = pose_from(options, rig)
        return rig, Scene.moved(pose, BoundControls(rig)(pose, _controls(options, rig)))
    return _bilinear(options)


def _bilinear(options: argparse.Namespace) -> tuple[Rig, Scene]:
    """(2.10): s between two people, t between two expressions."""
    if options.face or options.source != NEUTRAL or options.target is not None:
        raise OptionError("--bilinear names its own faces and expressions; leave out FACE, --from and --to.")
    names = _pair(options.bilinear[0], "two faces")
    expressions = _pair(options.bilinear[1], "two expressions")
    s = parsed_weight(options.s, "--s") if options.s is not None else 0.0
    rig, other = (_loaded(options, name) for name in names)
    People(dict(zip(names, (rig, other), strict=True)))
    pose = pose_between(options, rig, *expressions)
    first, second = names
    controls = _controls(options, rig, PeopleMix({first: 1.0}, second, s))
    bound = BoundControls(rig, first, {second: other})
    moving = bound(pose, replace(controls, people=PeopleControl())).added_to(pose)
    for name in moving.names() - {NEUTRAL}:
        if name not in other.names:
            raise UnknownNameError(f"shape of {second}", name, (NEUTRAL, *other.names))
    partners = [Partner(other, s)] if first != second else []
    return rig, Scene.moved(pose, bound(pose, controls), partners)


def _loaded(options: argparse.Namespace, source: str | Sequence[str]) -> Rig:
    from facemorph import api

    rig = api.load(source)
    return rig.linear() if options.linear else rig


def _pair(text: str, what: str) -> tuple[str, str]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(parts):
        raise OptionError(f"--bilinear takes {what} with a comma between, as ada,ben; not {text!r}.")
    return parts[0], parts[1]


def _controls(options: argparse.Namespace, rig: Rig, mix: PeopleMix | None = None) -> Controls:
    return Controls(
        facs=units_from(options.units, rig),
        emotion=_emotion(options.emotion, rig),
        people=PeopleControl(mix),
    )


def units_from(words: Sequence[str], rig: Rig) -> dict[int, Sides]:
    """FACS units from words: 12=0.8, L12=0.4 for the left side alone, or a formula as AU1+4+15."""
    available = units_of(rig)
    units: dict[int, Sides] = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals:
            units = parsed_units(word, available, units)
            continue
        name = name.strip().upper()
        side = name[0] if name[:1] in ("L", "R") else ""
        unit, weight = known_unit(name[len(side) :], available), parsed_weight(value, f"--au {name}")
        old = units.get(unit, Sides.both(0.0))
        units[unit] = Sides(old.left if side == "R" else weight, old.right if side == "L" else weight)
    return units


def _emotion(text: str | None, rig: Rig) -> EmotionControl:
    """The emotion map's cursor; its poles must be expressions of the face."""
    if text is None:
        return EmotionControl()
    x, comma, y = text.partition(",")
    if not comma:
        raise OptionError(f"--emotion takes X,Y, each from -1 to 1; not {text!r}.")
    control = EmotionControl(parsed_number(x, "--emotion"), parsed_number(y, "--emotion"))
    if max(abs(control.x), abs(control.y)) > 1.0:
        raise OptionError(f"--emotion takes X,Y, each from -1 to 1; not {text!r}.")
    for name in control.weights():
        rig.shape(name)
    return control
