"""What the face's shaders are told: of the whole picture, and of one part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.gl.colours import FIRST_PARTNER_UNIT, OWN_UNIT, STENCIL_UNIT, Source
from facemorph.gl.lights import Lights
from facemorph.gl.materials import GLOW_COLOUR, Finish

if TYPE_CHECKING:
    import moderngl

Uniforms = Mapping[str, object]
NOTHING_OF_FACE: Uniforms = MappingProxyType({})


def scene_uniforms(
    camera: Camera, look: Look, size: tuple[int, int], lights: Lights, shares: Sequence[float]
) -> dict[str, object]:
    """What every part of a picture shares; `shares` of the colours, the face's own and its partners'."""
    matrix = camera.clip_from_model(size[0] / size[1])
    return {
        "clip_from_model": np.ascontiguousarray(matrix.T, np.float32).tobytes(),
        "camera_position": tuple(float(value) for value in camera.position()),
        "background": look.backdrop,
        "backdrop_depth": lights.backdrop,
        "picture_size": (float(size[0]), float(size[1])),
        "per_heat_max": 1.0 / look.heat_max if look.heat_max else 1.0,
        "ramp": 0,
        "albedo_texture": OWN_UNIT,
        "stencil_texture": STENCIL_UNIT,
        "polygon_edges": 1,
        "own_share": shares[0],
        **{f"partner{i}_share": share for i, share in enumerate(shares[1:])},
        **{f"partner{i}_texture": FIRST_PARTNER_UNIT + i for i in range(len(shares) - 1)},
        "glow_colour": GLOW_COLOUR,
        **lights.uniforms(camera, look.exposure),
    }


def lit_uniforms(finish: Finish, source: Source, scene: Uniforms) -> dict[str, object]:
    """How a part's material answers light, and its own colour."""
    return {
        "albedo": tuple(value * finish.shade for value in source.factor),
        "opacity": source.opacity,
        "wrap": finish.wrap,
        "gloss": finish.gloss,
        "sharpness": finish.sharpness,
        "sheen": finish.sheen,
        "recess": finish.recess,
        "matte": finish.matte,
        "spill": finish.spill,
        "shine_direction": scene["catch_direction" if finish.catches else "key_direction"],
    }


def assign(program: moderngl.Program, values: Uniforms) -> None:
    """Set those uniforms that the program has."""
    for name, value in values.items():
        if name not in program:
            continue
        if isinstance(value, bytes):
            program[name].write(value)  # type: ignore[union-attr]
        else:
            program[name].value = value  # type: ignore[union-attr]
