"""Scenes are checked against the rig before anything is drawn of them; partners get their surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.correspondence import difference
from facemorph.core.rig import Rig
from facemorph.core.scene import MOST_PARTNERS, Scene
from facemorph.errors import CorrespondenceError, MeshDataError, PoseError
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl


def checked_scene(scene: Scene, rig: Rig) -> Scene:
    """`scene` if it fits `rig`.

    Raises `MeshDataError` for arrays of another shape, `PoseError` for values that are no numbers and for
    more partners than can be drawn.
    """
    count = rig.neutral.vertex_count
    for name, array, shape in (
        ("offsets", scene.offsets, (count, 3)),
        ("glow", scene.glow, (count,)),
        ("reference", scene.reference, (count, 3)),
    ):
        if array is None:
            continue
        if array.shape != shape:
            raise MeshDataError(f"a scene's {name} for this face must be {shape}, not {array.shape}.")
        if not np.isfinite(array).all():
            raise PoseError(f"a scene's {name} must be finite numbers; some are infinite or not a number.")
    weights = [partner.weight for partner in scene.partners]
    if not math.isfinite(sum(abs(weight) for weight in weights)):
        raise PoseError(f"the partners' weights must be numbers, not {', '.join(map(str, weights))}.")
    people = len({partner.rig for partner in scene.partners if partner.rig is not rig})
    if people > MOST_PARTNERS:
        raise PoseError(f"the colours of at most {MOST_PARTNERS} other people can be mixed, not of {people}.")
    return scene


def partner_surface(ctx: moderngl.Context, rig: Rig, surface: Surface, partners: Sequence[Rig]) -> Surface:
    """A surface of `rig` that carries the partners' texture coordinates and colours beside its own.

    Raises `CorrespondenceError` where a partner has other polygons.
    """
    for partner in partners:
        unlike = difference(rig.neutral, partner.neutral)
        if unlike is not None:
            hint = "Colours are mixed between faces of one topology only; the built-in people are."
            raise CorrespondenceError(partner.info.name, unlike.problem, cause=unlike.cause, hint=hint)
    return Surface(ctx, surface.form, [partner.neutral for partner in partners])
