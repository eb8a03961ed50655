"""`Painter`: the passes of one picture; backdrop, the face in its shading, the polygons' edges."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.camera import Camera
from facemorph.core.mesh import Material
from facemorph.core.picture import Look
from facemorph.errors import GraphicsError
from facemorph.gl.heat import ramp
from facemorph.gl.lights import Lights
from facemorph.gl.materials import CLAY, CLAY_COLOUR, Finish, finish_of
from facemorph.gl.programs import Programs
from facemorph.gl.surface import Part, Surface
from facemorph.gl.textures import load_texture

if TYPE_CHECKING:
    import moderngl

Uniforms = Mapping[str, object]
ANISOTROPY = 8.0
# GL's blend factors: ONE, SRC_ALPHA and ONE_MINUS_SRC_ALPHA.
_PREMULTIPLIED = (0x0001, 0x0303)
_STRAIGHT = (0x0302, 0x0303)


class Painter:
    """Draws a surface with a context's programs. `problems` tells which textures could not be shown."""

    def __init__(self, ctx: moderngl.Context, programs: Programs, lights: Lights, *, software: bool) -> None:
        self._ctx = ctx
        self._programs = programs
        self._lights = lights
        # Several times the texture reads: too dear where they are made on the CPU.
        self._anisotropy = 1.0 if software else min(ANISOTROPY, float(ctx.max_anisotropy))
        self._textures: dict[Path, moderngl.Texture | None] = {}
        self._ramp: moderngl.Texture | None = None
        self._backdrop: moderngl.VertexArray | None = None
        self.problems: list[str] = []

    def paint(
        self,
        framebuffer: moderngl.Framebuffer,
        surface: Surface,
        camera: Camera,
        look: Look,
        size: tuple[int, int],
    ) -> None:
        """Fill `framebuffer` with the face as `look` wants it."""
        scene = self._scene(surface, camera, look, size)
        framebuffer.use()
        framebuffer.clear(0.0, 0.0, 0.0, 0.0)
        self._ctx.enable_only(self._ctx.DEPTH_TEST)
        self._ctx.depth_func = "<="
        # Blended parts come last and lie over what is behind them.
        for part in surface.parts:
            if part.material.opacity >= 1.0:
                self._draw_part(surface, part, look, scene)
        self._draw_backdrop(scene)
        self._ctx.enable_only(self._ctx.DEPTH_TEST | self._ctx.BLEND)
        self._ctx.blend_func = _PREMULTIPLIED
        for part in surface.parts:
            if part.material.opacity < 1.0:
                self._draw_part(surface, part, look, scene)
        if look.wire or look.shading == "wire":
            self._draw_wire(surface, scene)

    def _scene(
        self, surface: Surface, camera: Camera, look: Look, size: tuple[int, int]
    ) -> dict[str, object]:
        """The uniforms that every part of the picture shares."""
        matrix = camera.clip_from_model(size[0] / size[1])
        scene: dict[str, object] = {
            "clip_from_model": np.ascontiguousarray(matrix.T, np.float32).tobytes(),
            "camera_position": tuple(float(value) for value in camera.position()),
            "background": look.background,
            "picture_size": (float(size[0]), float(size[1])),
            "per_heat_max": 1.0 / look.heat_max if look.heat_max else 1.0,
        }
        scene.update(self._lights.uniforms(camera))
        return scene

    def _draw_part(self, surface: Surface, part: Part, look: Look, scene: Uniforms) -> None:
        if look.shading in ("clay", "wire"):
            self._draw_skin(surface, part, scene, CLAY, CLAY_COLOUR, None)
        elif look.shading == "normals":
            self._draw_plain(surface, part, scene, "normals.frag", [])
        elif look.shading == "heat":
            self._heat_ramp().use(0)
            self._draw_plain(surface, part, {**scene, "ramp": 0}, "heat.frag", ["HEAT"])
        else:
            material = part.material
            texture = self._texture(material)
            self._draw_skin(surface, part, scene, finish_of(material), material.diffuse, texture)

    def _draw_plain(
        self, surface: Surface, part: Part, values: Uniforms, name: str, define: list[str]
    ) -> None:
        program = self._programs.get("face.vert", name, define=[*define, *(["HEM"] if part.in_hem else [])])
        _assign(program, values)
        surface.vertex_array(program).render(vertices=part.count * 3, first=part.first * 3)

    def _draw_skin(
        self,
        surface: Surface,
        part: Part,
        scene: Uniforms,
        finish: Finish,
        albedo: tuple[float, float, float],
        texture: moderngl.Texture | None,
    ) -> None:
        define = ["HEM"] if part.in_hem else []
        painted = finish is not CLAY or albedo != CLAY_COLOUR
        if texture is not None:
            texture.use(0)
            define += ["TEXTURED", "CUTOUT"] if texture.components == 4 else ["TEXTURED"]
        elif painted and surface.mesh.colours is not None:
            define.append("COLOURED")
            albedo = (1.0, 1.0, 1.0)
        values = {
            **scene,
            "albedo": tuple(value * finish.shade for value in albedo),
            "opacity": part.material.opacity if painted else 1.0,
            "albedo_texture": 0,
            "wrap": finish.wrap,
            "gloss": finish.gloss,
            "sharpness": finish.sharpness,
            "sheen": finish.sheen,
            "recess": finish.recess,
        }
        self._draw_plain(surface, part, values, "skin.frag", define)

    def _draw_backdrop(self, scene: Uniforms) -> None:
        program = self._programs.get("backdrop.vert", "backdrop.frag")
        if self._backdrop is None:
            self._backdrop = self._ctx.vertex_array(program, [])
        _assign(program, scene)
        self._backdrop.render(self._ctx.TRIANGLES, vertices=3)

    def _draw_wire(self, surface: Surface, scene: Uniforms) -> None:
        program = self._programs.get("face.vert", "wire.frag", "wire.geom", define=["HEM"])
        surface.polygon_edges().use(1)
        line = (0.05, 0.055, 0.065, 0.85)
        _assign(program, {**scene, "polygon_edges": 1, "line_colour": line})
        # Towards the camera by a hair: the same triangles' depths may differ in the last bit.
        self._ctx.polygon_offset = -1.0, -1.0
        surface.vertex_array(program).render()
        self._ctx.polygon_offset = 0.0, 0.0

    def _heat_ramp(self) -> moderngl.Texture:
        if self._ramp is None:
            colours = ramp()
            self._ramp = self._ctx.texture((len(colours), 1), 3, colours.tobytes())
            self._ramp.repeat_x = False
        return self._ramp

    def _texture(self, material: Material) -> moderngl.Texture | None:
        """The material's texture, read when it is first drawn; None where it has none that can be shown."""
        path = material.texture
        if path is None:
            return None
        if path not in self._textures:
            try:
                self._textures[path] = load_texture(self._ctx, path, self._anisotropy)
            except GraphicsError as error:
                self._textures[path] = None
                self.problems.append(str(error))
        return self._textures[path]

    def restore(self, framebuffer: moderngl.Framebuffer) -> None:
        """Leave the context as others expect it: plain state, and the framebuffer that was bound before."""
        self._ctx.enable_only(self._ctx.NOTHING)
        self._ctx.blend_func = _STRAIGHT
        self._ctx.depth_func = "<"
        framebuffer.use()

    def forget(self) -> None:
        """Give back the textures of the face before."""
        for texture in self._textures.values():
            if texture is not None:
                texture.release()
        self._textures.clear()
        self.problems.clear()

    def release(self) -> None:
        """Give everything back to the context."""
        self.forget()
        for held in (self._ramp, self._backdrop):
            if held is not None:
                held.release()
        self._ramp = self._backdrop = None


def _assign(program: moderngl.Program, values: Uniforms) -> None:
    """Set those uniforms that the program has."""
    for name in program:
        value = values.get(name)
        if value is None:
            continue
        if isinstance(value, bytes):
            program[name].write(value)  # type: ignore[union-attr]
        else:
            program[name].value = value  # type: ignore[union-attr]
