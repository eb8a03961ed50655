"""`Painter`: the passes of one picture; backdrop, the face in its shading, the polygons' edges.

The outside of every surface is drawn before its inside, each with the other culled: what lies behind
is then rejected by depth before it is shaded, and open surfaces still show both sides. While something
moves on software OpenGL, insides that `gl.insides` finds hidden are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.gl.backdrop import STRENGTH, Backdrop, shadow_uniforms
from facemorph.gl.colours import (
    FIRST_PARTNER_UNIT,
    OWN_UNIT,
    Source,
    blended_opacity,
    source_of,
    stencil_of,
)
from facemorph.gl.exposure import Exposures, exposed
from facemorph.gl.heat import ramp
from facemorph.gl.insides import Insides
from facemorph.gl.light_rigs import lights_of
from facemorph.gl.materials import CLAY, CLAY_COLOUR, Finish, finish_of
from facemorph.gl.programs import Programs
from facemorph.gl.skin_maps import skin_maps
from facemorph.gl.surface import Part, Surface
from facemorph.gl.textures import Textures
from facemorph.gl.uniforms import NOTHING_OF_FACE, Uniforms, assign, lit_uniforms, scene_uniforms

if TYPE_CHECKING:
    import moderngl

# GL's blend factors: ONE, SRC_ALPHA and ONE_MINUS_SRC_ALPHA.
_PREMULTIPLIED = (0x0001, 0x0303)
_STRAIGHT = (0x0302, 0x0303)
_OUTSIDE, _INSIDE = 1.0, -1.0
# From so many vertices on, a face's triangles are a few pixels each: light is as good by vertex.
FINE_MESH = 8000


class Painter:
    """Draws a surface with a context's programs."""

    def __init__(self, ctx: moderngl.Context, programs: Programs, *, software: bool) -> None:
        self._ctx = ctx
        self._programs = programs
        self._software = software
        self.textures = Textures(ctx, software=software)
        self._exposures = Exposures(self.textures)
        self._backdrop = Backdrop(ctx, programs)
        self._ramp: moderngl.Texture | None = None
        self._assigned: set[int] = set()
        self._glowing = self._hurried = False
        self._shares: tuple[float, ...] = (1.0,)

    def paint(
        self,
        framebuffer: moderngl.Framebuffer,
        surface: Surface,
        camera: Camera,
        look: Look,
        size: tuple[int, int],
        *,
        glowing: bool = False,
        shares: Sequence[float] = (),
        face: Uniforms = NOTHING_OF_FACE,
        hurried: bool = False,
    ) -> None:
        """Fill `framebuffer` with the face as `look` wants it.

        glowing   whether the surface's `glow` lights it up, in shadings that have light
        shares    of the colours: the face's own and those of each of the surface's partners, together 1;
                  all its own where they are left out
        face      what the drivers tell shaders of the face in its pose
        hurried   whether insides that are hidden may be left out
        """
        self._glowing, self._hurried = glowing, hurried
        self._shares = tuple(shares) or (1.0, *(0.0 for _ in surface.partners))
        lights = lights_of(look.light)
        scene = {**scene_uniforms(camera, look, size, lights, self._shares), **face}
        scene |= shadow_uniforms(surface.form.of_file.bounds, camera, size, STRENGTH)
        self._assigned.clear()
        later = self._backdrop.begin(framebuffer, scene)
        if look.shading == "skin":
            scene = exposed(scene, self._exposures.of((surface.mesh, *surface.partners), self._shares))
        self._ctx.enable_only(self._ctx.DEPTH_TEST | self._ctx.CULL_FACE)
        self._ctx.depth_func = "<="
        solid = [part for part in surface.parts if self._opacity(part) >= 1.0]
        self._draw_parts(surface, solid, look, scene, _OUTSIDE)
        self._draw_insides(framebuffer, surface, solid, camera, look, scene, hurried=hurried)
        if later:
            self._ctx.disable(self._ctx.CULL_FACE)
            self._backdrop.fill(scene)
            self._ctx.enable(self._ctx.CULL_FACE)
        self._ctx.enable(self._ctx.BLEND)
        self._ctx.blend_func = _PREMULTIPLIED
        clear = [part for part in surface.parts if self._opacity(part) < 1.0]
        hair = [part for part in clear if finish_of(part.material).behind]
        for parts in (hair, [part for part in clear if part not in hair]):
            both = [part for part in parts if not finish_of(part.material).one_sided]
            self._draw_parts(surface, both, look, scene, _INSIDE)
            self._draw_parts(surface, parts, look, scene, _OUTSIDE)
        if look.wire or look.shading == "wire":
            self._draw_wire(surface, scene)

    def _opacity(self, part: Part) -> float:
        return blended_opacity((part.material, *part.partners), self._shares)

    def _draw_parts(
        self, surface: Surface, parts: list[Part], look: Look, scene: Uniforms, side: float
    ) -> None:
        self._ctx.cull_face = "back" if side == _OUTSIDE else "front"
        for part in parts:
            self._draw_part(surface, part, look, {**scene, "side": side})

    def _draw_insides(
        self,
        framebuffer: moderngl.Framebuffer,
        surface: Surface,
        solid: list[Part],
        camera: Camera,
        look: Look,
        scene: Uniforms,
        *,
        hurried: bool,
    ) -> None:
        """The insides of the parts whose outsides are drawn, all of them or those that can be seen."""
        width, height = framebuffer.size
        samples = width * height * max(framebuffer.samples, 1)
        insides = surface.insides
        hidden: list[Part] = []
        if insides is not None and insides.may_be_hidden(camera, width / height):
            shell = [part for part in surface.parts if part.in_shell]
            if all(self._covers(surface, part, look) for part in shell) and not self._looked_into(
                framebuffer, surface, insides, scene, samples
            ):
                hidden = shell
        seen = [part for part in solid if not (hidden and part.in_shell)]
        self._draw_parts(surface, seen, look, scene, _INSIDE)
        if insides is not None and hidden and not insides.may_be_left_out(hurried=hurried):
            with insides.watching(samples):
                self._draw_parts(surface, hidden, look, scene, _INSIDE)

    def _covers(self, surface: Surface, part: Part, look: Look) -> bool:
        """Whether nothing is seen through the part's outside."""
        if self._opacity(part) < 1.0:
            return False
        if look.shading != "skin":
            return True
        meshes = zip((part.material, *part.partners), (surface.mesh, *surface.partners), strict=True)
        return not any(source_of(material, mesh, self.textures).cut_out for material, mesh in meshes)

    def _looked_into(
        self,
        framebuffer: moderngl.Framebuffer,
        surface: Surface,
        insides: Insides,
        scene: Uniforms,
        samples: int,
    ) -> bool:
        """Whether one of the shell's caps would be seen."""
        program = self._programs.get("face.vert", "nothing.frag")
        assign(program, scene)
        self._ctx.disable(self._ctx.CULL_FACE)
        framebuffer.color_mask, framebuffer.depth_mask = (False, False, False, False), False
        framebuffer.use()
        # By a hair behind: a cap is no nearer than the surface whose rim it begins at.
        self._ctx.polygon_offset = 0.0, 4.0
        try:
            return insides.looked_into(surface.vertex_array(program), *surface.caps, samples)
        finally:
            self._ctx.polygon_offset = 0.0, 0.0
            framebuffer.color_mask, framebuffer.depth_mask = (True, True, True, True), True
            framebuffer.use()
            self._ctx.enable(self._ctx.CULL_FACE)

    def _draw_part(self, surface: Surface, part: Part, look: Look, scene: Uniforms) -> None:
        if look.shading in ("clay", "wire"):
            self._draw_lit(
                surface,
                part,
                scene,
                CLAY,
                Source(CLAY_COLOUR, 1.0),
                stencil=stencil_of(part.material, surface.mesh, self.textures),
            )
        elif look.shading == "normals":
            self._draw(
                surface,
                part,
                scene,
                "normals.frag",
                stencil_of(part.material, surface.mesh, self.textures),
                {},
            )
        elif look.shading == "heat":
            self._heat_ramp().use(0)
            self._draw(
                surface,
                part,
                scene,
                "heat.frag",
                ["LIT", "HEAT", *stencil_of(part.material, surface.mesh, self.textures)],
                {},
            )
        else:
            self._draw_material(surface, part, scene)

    def _draw_material(self, surface: Surface, part: Part, scene: Uniforms) -> None:
        """A part in its own colours: its texture's, the vertices', or its material's."""
        own = source_of(part.material, surface.mesh, self.textures)
        partners: list[Source] = []
        if any(self._shares[1:]):
            own = own.as_stored()
            others = zip(part.partners, surface.partners, strict=True)
            partners = [source_of(material, mesh, self.textures).as_stored() for material, mesh in others]
        self._draw_lit(surface, part, scene, finish_of(part.material), own, partners)

    def _draw_lit(
        self,
        surface: Surface,
        part: Part,
        scene: Uniforms,
        finish: Finish,
        source: Source,
        partners: Sequence[Source] = (),
        stencil: Sequence[str] = (),
    ) -> None:
        define = [*source.defines(), *stencil]
        if source.texture is not None:
            source.texture.use(OWN_UNIT)
        own = lit_uniforms(finish, source, scene)
        if partners:
            define.append(f"PARTNERS {len(partners)}")
            own["stored_colour"] = source.stored
        for i, partner in enumerate(partners):
            define += partner.defines(f"PARTNER{i}_")
            # Textures of one set of coordinates are looked up at one.
            if partner.texture is not None:
                partner.texture.use(FIRST_PARTNER_UNIT + i)
                if not (surface.shares_uvs(i) and source.texture is not None):
                    define.append(f"PARTNER{i}_UV")
            own |= {
                f"partner{i}_stored_colour": partner.stored,
                f"partner{i}_albedo": tuple(value * finish.shade for value in partner.factor),
                f"partner{i}_opacity": partner.opacity,
            }
        if finish.relief:
            finish = finish if self._hurried else replace(finish, by_pixel=True)
            maps = skin_maps(part.material, surface.mesh, source, self.textures, scene)
            define, own = [*define, *maps.defines], own | maps.uniforms
        if any(one.cut_out for one in (source, *partners)):
            define.append("CUTOUT")
        if self._glowing:
            define.append("GLOW")
        # Of the inside hardly a pixel is seen, unless of hair: light by vertex would be work for nothing.
        fine = surface.mesh.vertex_count >= FINE_MESH and not finish.by_pixel
        by_vertex = self._software and fine and (scene["side"] == _OUTSIDE or source.cut_out)
        lit = ["LIT", "LIT_BY_VERTEX"] if by_vertex else ["LIT"]
        self._draw(surface, part, scene, finish.shader, [*lit, *define], own)

    def _draw(
        self, surface: Surface, part: Part, scene: Uniforms, name: str, define: list[str], own: Uniforms
    ) -> None:
        program = self._programs.get("face.vert", name, define=[*define, *(["HEM"] if part.in_hem else [])])
        if program.glo not in self._assigned:
            assign(program, scene)
            self._assigned.add(program.glo)
        assign(program, {**own, "side": scene["side"]})
        surface.vertex_array(program).render(vertices=part.count * 3, first=part.first * 3)

    def _draw_wire(self, surface: Surface, scene: Uniforms) -> None:
        program = self._programs.get("face.vert", "wire.frag", "wire.geom", define=["HEM"])
        surface.polygon_edges().use(1)
        line = (0.05, 0.055, 0.065, 0.85)
        assign(program, {**scene, "line_colour": line, "finer": float(2**surface.form.level)})
        self._ctx.disable(self._ctx.CULL_FACE)
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

    def restore(self, framebuffer: moderngl.Framebuffer) -> None:
        """Leave the context as others expect it: plain state, and the framebuffer that was bound before."""
        self._ctx.enable_only(self._ctx.NOTHING)
        self._ctx.blend_func = _STRAIGHT
        self._ctx.depth_func = "<"
        self._ctx.cull_face = "back"
        framebuffer.use()

    def release(self) -> None:
        """Give everything back to the context."""
        self.textures.forget()
        self._backdrop.release()
        if self._ramp is not None:
            self._ramp.release()
            self._ramp = None
