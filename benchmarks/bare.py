"""The limit: the same mesh, never morphed, drawn by a few lines of moderngl (Phong, one light)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.camera import Camera
from facemorph.core.rig import Rig
from facemorph.core.split import split_vertices
from facemorph.core.triangles import triangulated

if TYPE_CHECKING:
    import moderngl

VERTEX = """
#version 330 core
uniform mat4 clip_from_model;
in vec3 position;
in vec3 normal;
out vec3 surface_position;
out vec3 surface_normal;
void main() {
    surface_position = position;
    surface_normal = normal;
    gl_Position = clip_from_model * vec4(position, 1.0);
}
"""
FRAGMENT = """
#version 330 core
uniform vec3 eye;
in vec3 surface_position;
in vec3 surface_normal;
out vec4 colour;
const vec3 LIGHT = vec3(0.36, 0.48, 0.8);
void main() {
    vec3 n = normalize(surface_normal);
    vec3 mirrored = reflect(-LIGHT, n);
    float shine = pow(max(dot(mirrored, normalize(eye - surface_position)), 0.0), 20.0);
    colour = vec4(vec3(0.8, 0.65, 0.55) * (0.2 + 0.8 * max(dot(n, LIGHT), 0.0)) + 0.3 * shine, 1.0);
}
"""


class BareDraw:
    """One indexed draw of static buffers with Phong's shading, no antialiasing."""

    def __init__(self, context: moderngl.Context, rig: Rig, camera: Camera, size: tuple[int, int]) -> None:
        self._context = context
        drawn = split_vertices(rig.neutral, triangulated(rig.neutral))
        attributes = np.concatenate([rig.neutral.positions, rig.normals({})], axis=1)[drawn.position_of]
        program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        matrix = camera.clip_from_model(size[0] / size[1]).T.astype("f4")
        program["clip_from_model"].write(matrix.tobytes())  # type: ignore[union-attr]
        program["eye"].value = tuple(float(value) for value in camera.position())  # type: ignore[union-attr]
        self._array = context.vertex_array(
            program,
            [(context.buffer(attributes.astype("f4").tobytes()), "3f 3f", "position", "normal")],
            index_buffer=context.buffer(drawn.triangles.tobytes()),
        )
        self._framebuffer = context.simple_framebuffer(size, 4)

    def frame(self) -> bytes:
        """Draw and read back."""
        self._framebuffer.use()
        self._context.enable_only(self._context.DEPTH_TEST)
        self._framebuffer.clear(0.16, 0.17, 0.19, 1.0)
        self._array.render()
        return self._framebuffer.read(components=4, alignment=1)
