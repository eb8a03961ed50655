"""Words from the command line into poses, sizes and looks."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.morph import checked_curve
from facemorph.core.picture import (
    Look,
    checked_light,
    checked_luminance,
    checked_shading,
    checked_subdivision,
)
from facemorph.core.pose import NEUTRAL, Pose, parsed_number, parsed_weight, state_of
from facemorph.core.rig import Rig
from facemorph.errors import OptionError


def pose_from(options: argparse.Namespace, rig: Rig) -> Pose:
    """The pose of --from, --to, --t, --curve and --set. Names and numbers are checked."""
    default_t = float(options.target is not None)
    pose = pose_between(options, rig, options.source, options.target or NEUTRAL, default_t)
    if options.t is not None and not (pose.source or pose.target):
        raise OptionError("--t says how far to go; name an expression to go to with --to.")
    return pose


def pose_between(
    options: argparse.Namespace, rig: Rig, source: str, target: str, default_t: float = 0.0
) -> Pose:
    """The pose of --t, --curve and --set between two expressions."""
    weights = weights_from(options.weights)
    for name in {source, target} - {NEUTRAL} | weights.keys():
        rig.shape(name)
    t = parsed_weight(options.t, "--t") if options.t is not None else default_t
    return Pose(state_of(source), state_of(target), t, checked_curve(options.curve), weights)


def weights_from(words: Sequence[str], option: str = "--set") -> dict[str, float]:
    """Weights from NAME=VALUE words of an option; a name given twice counts with its last value."""
    weights: dict[str, float] = {}
    for word in words:
        name, equals, value = word.rpartition("=")
        if not equals or not name:
            raise OptionError(f"{option} takes NAME=VALUE, as jawOpen=0.5; not {word!r}.")
        weights[name] = parsed_weight(value, f"{option} {name}")
    return weights


def look_from(options: argparse.Namespace) -> Look:
    """The look of --shading, --subdivision and what stands round the face."""
    look = Look(
        checked_shading(options.shading),
        background=None if options.background is None else background_colour(options.background),
        subdivision=checked_subdivision(options.subdivision),
        light=checked_light(options.light),
    )
    if options.luminance is None:
        if options.per_picture:
            raise OptionError("--per-picture says what --equal-luminance holds for; give that too.")
        return look
    luminance = checked_luminance(parsed_number(options.luminance, "--equal-luminance"))
    return replace(look, luminance=luminance, luminance_of="picture" if options.per_picture else "face")


def background_colour(text: str) -> tuple[float, float, float, float]:
    """sRGB and alpha, 0..1, of "transparent" or RRGGBB. Raises `OptionError`."""
    if text == "transparent":
        return (0.0, 0.0, 0.0, 0.0)
    if not re.fullmatch(r"#?[0-9a-fA-F]{6}", text):
        raise OptionError(f"a background is RRGGBB in hexadecimal, as 808080, or transparent; not {text!r}.")
    red, green, blue = bytes.fromhex(text.lstrip("#"))
    return (red / 255.0, green / 255.0, blue / 255.0, 1.0)


def checked_suffix(path: Path, suffix: str) -> Path:
    """`path` if its name ends in `suffix`. Raises `OptionError` before any work is done."""
    if path.suffix.lower() != suffix:
        raise OptionError(f"the output must end in {suffix}; {path.name!r} does not.")
    return path
