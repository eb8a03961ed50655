"""Which pixels of a picture show skin: white on black, by the same triangles that the picture has."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.camera import Camera
from facemorph.gl.colours import STENCIL_UNIT, stencil_of
from facemorph.gl.materials import finish_of
from facemorph.gl.programs import Programs
from facemorph.gl.surface import Surface
from facemorph.gl.textures import Textures
from facemorph.gl.uniforms import assign

if TYPE_CHECKING:
    import moderngl


def paint_skin(
    ctx: moderngl.Context,
    programs: Programs,
    textures: Textures,
    surface: Surface,
    camera: Camera,
    framebuffer: moderngl.Framebuffer,
) -> None:
    """Fill `framebuffer` with white where skin is seen, or what is solid of a face without; black elsewhere.

    What a bust's end fades into the backdrop is black.
    """
    width, height = framebuffer.size
    matrix = np.ascontiguousarray(camera.clip_from_model(width / height).T, np.float32).tobytes()
    solid = [part for part in surface.parts if part.material.opacity >= 1.0 and not part.in_hem]
    counted = [part for part in solid if finish_of(part.material).relief] or solid
    framebuffer.use()
    framebuffer.clear(0.0, 0.0, 0.0, 1.0)
    ctx.enable_only(ctx.DEPTH_TEST)
    ctx.depth_func = "<="
    for part in surface.parts:
        define = stencil_of(part.material, surface.mesh, textures)
        program = programs.get("face.vert", "mask.frag", define=define)
        own = {"clip_from_model": matrix, "side": 1.0, "stencil_texture": STENCIL_UNIT}
        assign(program, {**own, "counted": float(part in counted)})
        surface.vertex_array(program).render(vertices=part.count * 3, first=part.first * 3)
