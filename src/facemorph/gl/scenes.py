"""Scenes are checked against the rig before anything is drawn of them; a partner gets its surface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.correspondence import difference
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.errors import CorrespondenceError, MeshDataError, PoseError
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl


def checked_scene(scene: Scene, rig: Rig, known: Float32 | None = None) -> Scene:
    """`scene` if it fits `rig`; offsets that are the array `known` are taken as looked at.

    Raises `MeshDataError` for arrays of another shape, `PoseError` for offsets or an s that are no numbers.
    """
    count = rig.neutral.vertex_count
    for name, array, shape in (
        ("offsets", scene.offsets, (count, 3)),
        ("glow", scene.glow, (count,)),
        ("reference", scene.reference, (count, 3)),
    ):
        if array is not None and array.shape != shape:
            raise MeshDataError(f"a scene's {name} for this face must be {shape}, not {array.shape}.")
    offsets = scene.offsets
    if offsets is not None and offsets is not known and not np.isfinite(offsets).all():
        raise PoseError("a scene's offsets must be numbers; some are infinite or none.")
    if scene.partner is not None and not math.isfinite(scene.partner.s):
        raise PoseError(f"the partner's s must be a number, not {scene.partner.s}.")
    return scene


def partner_surface(ctx: moderngl.Context, rig: Rig, surface: Surface, partner: Rig) -> Surface:
    """A surface of `rig` that carries the partner's texture coordinates and colours beside its own.

    Raises `CorrespondenceError` where the partner has other polygons.
    """
    unlike = difference(rig.neutral, partner.neutral)
    if unlike is not None:
        hint = "Colours are mixed between faces of one topology only; the built-in people are."
        raise CorrespondenceError(partner.info.name, unlike.problem, cause=unlike.cause, hint=hint)
    return Surface(ctx, rig.neutral, partner.neutral, kin=surface)
