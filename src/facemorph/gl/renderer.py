"""`Renderer`: draws a rig in a pose from a camera into its own framebuffer.

The window shows that framebuffer; pictures and tests read it. Drawing goes in two stages: MORPH fills
one buffer of positions and normals, and only when a coefficient or the offsets changed; every pass of
DRAW reads that buffer as plain vertex attributes. So a frame costs what a static mesh costs, and moving
the camera blends nothing.

Two views of one frame (a split view: the same face by two methods) take two renderers in one context.
Each keeps its own morphed buffer, so a view whose scene stays the same blends nothing while the other's
changes, and turning linked cameras blends nothing at all; one renderer drawing both in turn would morph
twice a frame. The rig's arrays are shared; what is there twice is the buffers of vertices and textures.

Where a look asks for subdivision, another stage is drawn, of the refined surface; the file's own stays
beside it, so that small pictures at level 0 change nothing. What is picked or measured is always the file's.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Literal

import numpy as np

from facemorph.core.arrays import Bool, Float32, UInt8
from facemorph.core.blend import Blend
from facemorph.core.camera import Camera
from facemorph.core.lengths import displacements
from facemorph.core.picture import Look, checked_size, checked_subdivision
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene, colour_shares
from facemorph.errors import GraphicsError, OptionError
from facemorph.gl.describe import describe
from facemorph.gl.draw_clock import DrawClock
from facemorph.gl.drivers import Driver, drivers_of
from facemorph.gl.form import Form
from facemorph.gl.heat import DIFFERENCE, DISPLACEMENT, Legend, heat_end, heat_legend
from facemorph.gl.luminance import EqualLuminance
from facemorph.gl.morph import Stats, new_morph
from facemorph.gl.painter import Painter
from facemorph.gl.picking import Pick, pick
from facemorph.gl.programs import Programs
from facemorph.gl.scenes import checked_scene
from facemorph.gl.skin_mask import paint_skin
from facemorph.gl.stage import Stage
from facemorph.gl.surface import Surface
from facemorph.gl.target import Target
from facemorph.gl.uniforms import NOTHING_OF_FACE

if TYPE_CHECKING:
    import moderngl

MorphPath = Literal["auto", "shader", "cpu"]
Quality = Literal["full", "fast"]
SAMPLES = 4


class Renderer:
    """Draws one rig at a time with one context. `problems` tells what could not be shown, a line each.

    morph   which path fills the vertices: "shader" on a graphics card, "cpu" where OpenGL itself runs
            on the CPU; "auto" chooses by the context's renderer
    """

    def __init__(self, ctx: moderngl.Context, morph: MorphPath = "auto") -> None:
        if morph not in ("auto", "shader", "cpu"):
            raise OptionError(f"a morph path is auto, shader or cpu; not {morph!r}.")
        self.ctx = ctx
        self.graphics = describe(ctx)
        self.path = self.graphics.morph if morph == "auto" else morph
        self.stats = Stats()
        self._programs = Programs(ctx)
        self._target = Target(ctx)
        self._painter = Painter(ctx, self._programs, software=self.graphics.software)
        self._luminance = EqualLuminance(self)
        self._clock = None if self.graphics.software else DrawClock(ctx)
        self._rig: Rig | None = None
        self._forms: dict[int, Form] = {}
        self._ahead: Form | None = None  # of the face that comes next
        self._stages: dict[int, Stage] = {}
        self._stage: Stage | None = None  # the one drawn last
        self._blend: Blend | None = None
        self._drivers: tuple[Driver, ...] = ()
        self._drawn: tuple[Camera, tuple[int, int]] | None = None
        self._legend: Legend | None = None

    def load(self, rig: Rig) -> None:
        """Take `rig` in place of the one before, which stays where this raises.

        Raises `GraphicsError` where OpenGL cannot hold the face.
        """
        blend = Blend(rig.neutral.positions, rig.deltas)
        forms = {level: form for level, form in self._forms.items() if form.of_file is rig.neutral}
        ahead, self._ahead = self._ahead, None
        forms[0] = forms.get(0) or (ahead if ahead and ahead.of_file is rig.neutral else Form.of(rig.neutral))
        stage = self._new_stage(rig, forms[0], blend)
        self._unload()
        self._rig, self._blend, self._forms = rig, blend, forms
        self._stage, self._stages = stage, {0: stage}
        self._drivers = drivers_of(rig)
        self.stats = Stats()

    def take(self, form: Form) -> None:
        """Keep a form of the loaded face's mesh, made in another thread, for when its level is drawn.

        One of level 0 is kept for the next face that is loaded, if it is that one's. Else one of another mesh
        is left alone. The first frame at a level without makes the form itself, which
        takes from tenths of a second to seconds.
        """
        if not form.level:
            self._ahead = form
        elif self._rig is not None and form.of_file is self._rig.neutral:
            self._forms = {0: self._forms[0], form.level: form}

    @property
    def surface(self) -> Surface | None:
        """What was drawn last; None before a face is loaded."""
        return None if self._stage is None else self._stage.surface

    @property
    def draw_secs(self) -> float | None:
        """How long the graphics card drew at a frame lately; None where there is none, or not yet known."""
        return None if self._clock is None else self._clock.secs

    @property
    def problems(self) -> tuple[str, ...]:
        """What of the loaded face could not be read or shown, a line each; textures once they were drawn."""
        notes = self._rig.neutral.notes if self._rig is not None else ()
        return (*notes, *self._painter.textures.problems)

    @property
    def texture(self) -> moderngl.Texture:
        """The finished picture for the window (`texture.glo`); its first row is the lowest."""
        return self._target.texture

    @property
    def legend(self) -> Legend | None:
        """The legend of the picture drawn last, or None where its shading needs none."""
        return self._legend

    def draw(
        self,
        what: Scene | Pose | Mapping[str, float],
        camera: Camera,
        look: Look,
        size: tuple[int, int],
        *,
        quality: Quality = "full",
        exactly: bool = False,
    ) -> None:
        """Draw `what` seen by `camera` at `size` pixels (width, height) into the own framebuffer.

        A scene's arrays are uploaded when they are others than in the frame before. Its `glow` shows in
        the shadings skin, clay and wire, its `reference` in heat, its partners in skin, with weights
        kept from 0 to 1 as `colour_shares` does. Other partners rebuild what is drawn of the mesh once (so
        keep those of weight 0 listed while a weight is dragged), other weights nothing.

        quality   "fast" leaves out, where OpenGL runs on the CPU, antialiasing (it doubles the frame
                  there) and insides that are hidden: for frames while something moves; "full" for
                  still ones and pictures
        exactly   morph in full, so that equal arguments give equal pixels whatever was drawn before

        Raises `UnknownNameError` and `PoseError` for a pose the rig cannot take, `OptionError` for a size,
        `MeshDataError` for arrays of another shape than the rig's, `CorrespondenceError` for a partner
        with other polygons, `OptionError` for a subdivision that is none or has too many vertices and for
        a luminance that cannot be had (`gl.luminance` says when; it is sought in further pictures).
        """
        rig, _ = self._loaded()
        size, level = checked_size(size), checked_subdivision(look.subdivision)
        scene = checked_scene(Scene.of(what), rig)
        if look.luminance is not None:
            look = self._luminance.settled(scene, camera, look, size)
        # Asked of GL itself: a window's interface binds framebuffers that moderngl has not seen.
        outer = self.ctx.detect_framebuffer()
        hurried = quality == "fast" and self.graphics.software
        samples = 0 if hurried else min(SAMPLES, self.graphics.max_samples)
        try:
            stage = self._stage_at(level)
            self._take_partners(stage, scene)
            surface = stage.surface
            self.stats.morphs += stage.update(scene, self._drivers, exactly=exactly)
            look = self._with_heat_end(look, scene, rig)
            if scene.glow is not None:
                surface.give("glow", scene.glow)
            stage.watch_insides(hurried=hurried)
            framebuffer = self._target.prepare(size, samples)
            shares = colour_shares(rig.neutral, scene.partners)
            with self._clock.running() if self._clock else nullcontext():
                self._painter.paint(
                    framebuffer,
                    surface,
                    camera,
                    look,
                    size,
                    glowing=scene.glow is not None,
                    hurried=hurried,
                    shares=[shares.get(mesh, 0.0) for mesh in (rig.neutral, *stage.people)],
                    face=stage.shown.face if stage.shown else NOTHING_OF_FACE,
                )
            self._target.finish(framebuffer)
        finally:
            self._painter.restore(outer)
        self._drawn = (camera, size)
        self.stats.frames += 1

    def read(self) -> UInt8:
        """The picture drawn last, (H, W, 4) uint8 sRGB with straight alpha, top row first."""
        return self._target.read()

    def skin_pixels(self) -> Bool:
        """Which pixels (H, W), top row first, of the picture drawn last show nothing but skin.

        Of a face that has no skin by its materials' names, all that is solid. The picture itself is lost.
        """
        _, stage = self._loaded()
        if self._drawn is None:
            raise GraphicsError("nothing has been drawn yet; call draw first.")
        camera, size = self._drawn
        outer = self.ctx.detect_framebuffer()
        try:
            framebuffer = self._target.prepare(size, min(SAMPLES, self.graphics.max_samples))
            textures = self._painter.textures
            paint_skin(self.ctx, self._programs, textures, stage.surface, camera, framebuffer)
            self._target.finish(framebuffer)
        finally:
            self._painter.restore(outer)
        return np.asarray(self._target.read()[..., 0] == 255)

    def positions(self) -> Float32:
        """Positions (V, 3) of the file's vertices as drawn last, model units, offsets and all.

        Made on the CPU, nothing is read back; the next call may change the array.
        """
        rig, stage = self._loaded()
        assert self._blend is not None
        shown = stage.shown
        positions = self._blend(shown.coefficients if shown else rig.coefficients(Pose()))
        return positions if shown is None or shown.offsets is None else positions + shown.offsets

    def pick(self, x: float, y: float) -> Pick | None:
        """What lies at pixel (x, y) of the picture drawn last, from its top left; None beside the face.

        It is looked for on the file's own polygons, at any subdivision.
        """
        self._loaded()
        if self._drawn is None:
            raise GraphicsError("nothing has been drawn yet; call draw first.")
        camera, size = self._drawn
        return pick(self.positions(), self._forms[0].triangles, camera, size, x, y)

    def _loaded(self) -> tuple[Rig, Stage]:
        if self._rig is None or self._stage is None:
            raise GraphicsError("no face is loaded; call load first.")
        return self._rig, self._stage

    def _stage_at(self, level: int) -> Stage:
        """The stage of a level, from now on the one that is drawn; beside the file's own one is kept."""
        rig, _ = self._loaded()
        if level not in self._stages:
            assert self._blend is not None
            form = self._forms.get(level) or Form.of(rig.neutral, level)
            stage = self._new_stage(rig, form, self._blend)
            for finer in [kept for kept in self._stages if kept]:
                self._stages.pop(finer).release()
            self._stages[level] = stage
            self.take(form)
        self._stage = self._stages[level]
        return self._stage

    def _new_stage(self, rig: Rig, form: Form, blend: Blend) -> Stage:
        return Stage(self.ctx, rig, form, partial(new_morph, self.path, self.ctx, self._programs, blend))

    def _take_partners(self, stage: Stage, scene: Scene) -> None:
        if not stage.take_partners(scene.partners):
            return
        textures = self._painter.textures
        textures.keep(stage.surface.texture_paths())
        # Read now, when people are chosen, and not under the pointer when a weight is first dragged.
        for material in {material for part in stage.surface.parts for material in part.partners}:
            textures.of(material)
        self.stats.partners += 1

    def _with_heat_end(self, look: Look, scene: Scene, rig: Rig) -> Look:
        """`look` with the heat map's end settled, what it measures from uploaded, and its legend made."""
        if look.shading != "heat":
            self._legend = None
            return look
        reference = rig.neutral.positions if scene.reference is None else scene.reference
        title = DISPLACEMENT if scene.reference is None else DIFFERENCE
        self._loaded()[1].surface.give("reference", reference)
        unit, end = rig.info.unit, look.heat_max
        if end is None or not end > 0.0:
            largest = float(displacements(self.positions(), reference).max(initial=0.0))
            end = heat_end(largest, unit, rig.neutral.diagonal or 1.0)
        if self._legend is None or (self._legend.high, self._legend.title) != (end, title):
            self._legend = heat_legend(end, unit, title)
        return replace(look, heat_max=end)

    def _unload(self) -> None:
        self._painter.textures.forget()
        self._luminance.forget()
        for stage in self._stages.values():
            stage.release()
        self._rig = self._stage = self._blend = None
        self._forms, self._stages, self._drivers = {}, {}, ()
        self._drawn = self._legend = None

    def release(self) -> None:
        """Give everything back to the context; the context itself is its maker's."""
        self._unload()
        self._target.release()
        self._painter.release()
        self._programs.release()
