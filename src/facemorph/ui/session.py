"""One frame of the program, apart from the window it is shown in: state, interface, face, undo.

The window (`window.py`) and the tests drive the same `Session`; it needs a current OpenGL context and
an ImGui context, and nothing else.
"""

from __future__ import annotations

import time
import weakref
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from facemorph.core.camera import Camera
from facemorph.core.picture import Look, checked_light, checked_luminance_of
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.errors import FacemorphError, GraphicsError
from facemorph.ui import actions, emotion_paths, files, fonts, theme
from facemorph.ui.draw import draw_ui
from facemorph.ui.emotion_pictures import pole_pictures
from facemorph.ui.exposing import Exposing
from facemorph.ui.hotkeys import nudging
from facemorph.ui.on_face import OnFace, Split
from facemorph.ui.panels.messages import sliding
from facemorph.ui.people_pictures import corner_pictures
from facemorph.ui.plots import release_plots
from facemorph.ui.smoothing import Smoothing
from facemorph.ui.split_view import DrawsFaces, Quality, SplitView, partner_key, show, side_by_side
from facemorph.ui.stage_cameras import StageCameras
from facemorph.ui.state import App, Face
from facemorph.ui.thumbnails import Thumbnails

TURNTABLE_DEGREES_PER_SEC = 36.0
# After a pause the clock has run on; an animation goes on from where it was and does not leap.
LONGEST_STEP_SECS = 0.25


class Session:
    """An `App` and what draws it."""

    def __init__(
        self, app: App, renderer: DrawsFaces, thumbnails: Thumbnails | None = None,
        clock: Callable[[], float] = time.monotonic,
        second: Callable[[], DrawsFaces] | None = None,
    ) -> None:  # fmt: skip
        self.app = app
        self.split = SplitView(second or (lambda: _another(renderer)))
        self.renderer = renderer
        self.thumbnails = thumbnails
        self.poles = pole_pictures()
        self.corners = corner_pictures()
        self._smoothing = Smoothing()
        self._cameras = StageCameras()
        self._exposing = Exposing()
        self._clock = clock
        self._last_secs = clock()
        self._loaded: Face | None = None
        # What pages show and could not be drawn.
        self._refused: weakref.WeakSet[Face] = weakref.WeakSet()
        self._drawn: tuple[object, ...] = ()
        self._scene: Scene | None = None  # as drawn last; holding it keeps its arrays' identities
        self._framed: tuple[Camera, str, float] | None = None  # as framed last, and for which view
        self._style: tuple[str, float] = ("", 0.0)
        self._wide_script = False
        self._hurried = False  # the last picture was drawn for speed, and a still one is due
        app.graphics = renderer.graphics

    def frame(self, scale: float = 1.0) -> None:
        """Build one frame; between the backends' `new_frame` and `imgui.render` of the caller.

        `scale` is how many of the interface's units a pixel at scale 1 takes.
        """
        app = self.app
        self._begin(scale)
        imgui.new_frame()
        draw_ui(app)
        emotion_paths.take_sample(app, self._last_secs)
        self._cameras.settle(app)
        self._fulfil(app)
        self._draw_face(app)
        busy = imgui.is_any_item_active() or nudging() or app.playback.playing or app.drag == "tool"
        app.history.settle(app.snapshot(), busy=busy)

    def wants_frame_in(self) -> float | None:
        """Seconds until something moves by itself: 0 at once, None not before the user does something."""
        app = self.app
        moving = app.playback.playing or app.turntable or sliding(app) or app.pages.emotion.moves_by_itself
        waiting = app.arriving or app.chooser.fresh or (app.shown_face and (app.framing or app.picture_path))
        thumbs = (self.thumbnails is not None and self.thumbnails.busy) or self.poles.busy(app)
        thumbs = thumbs or self.corners.busy(app)
        if moving or waiting or thumbs or self._hurried:
            return 0.0
        if app.jobs.running or app.chooser.dialog is not None:
            return 0.1
        return app.messages.next_change_secs()

    def close(self) -> None:
        """Stop all work and give back what draws."""
        self.app.jobs.close()
        self.split.release()
        release_plots()
        if self.app.chooser.dialog is not None:
            self.app.chooser.dialog.close()
        if self.thumbnails is not None:
            self.thumbnails.release()
        self.poles.release()
        self.corners.release()
        self.renderer.release()

    def _begin(self, scale: float) -> None:
        app = self.app
        now = self._clock()
        elapsed, self._last_secs = min(now - self._last_secs, LONGEST_STEP_SECS), now
        app.jobs.finish()
        self._take_arriving(app)
        if app.playback.playing:
            app.pose = replace(app.pose, t=app.playback.advanced(elapsed))
        emotion_paths.advance(app, elapsed)
        if app.turntable:
            app.camera = app.camera.orbited(elapsed * TURNTABLE_DEGREES_PER_SEC, 0.0)
        if self.thumbnails is not None:
            self.thumbnails.step(app)
        self._restyle(app, scale)

    def _restyle(self, app: App, scale: float) -> None:
        wanted = (app.settings.theme, scale)
        if wanted != self._style:
            theme.apply(*wanted)
            self._style = wanted
        backdrop = theme.THEMES[app.settings.theme].backdrop
        settings = app.settings
        app.look = replace(
            app.look,
            background=backdrop,
            light=checked_light(settings.light),
            luminance=settings.luminance if settings.equal_luminance else None,
            luminance_of=checked_luminance_of(settings.luminance_of),
        )

    def _take_arriving(self, app: App) -> None:
        """Show the face that was loaded, if the renderer can; else keep the one there is."""
        (face, app.arriving), (pose, app.arriving_pose) = (app.arriving, None), (app.arriving_pose, None)
        if face is None:
            return
        try:
            self._load(face)
        except FacemorphError as error:
            actions.tell_error(app, f"{face.title} cannot be drawn", error)
            self._loaded = None
            return
        before = app.face
        if pose is None and before is not None and before.rig.names == face.rig.names:
            # People can then be compared: the next wears the same face, seen from the same side.
            app.show(face, app.pose)
            app.framing = f"{app.camera.azimuth_deg},{app.camera.elevation_deg}"
        else:
            app.show(face, pose)
        if not face.builtin:
            app.settings.remember(face.source)
        for problem in self.renderer.problems:
            app.messages.tell(problem)

    def _load(self, face: Face) -> None:
        self._drawn = ()
        if face.form is not None:
            self.renderer.take(face.form)
        self.renderer.load(face.rig)
        self._loaded = face
        self._exposing.forget()
        shown = (face.title, *face.source, *(shape.label for shape in face.rig.shapes))
        if not self._wide_script and any(fonts.needs_wide_script(text) for text in shown):
            self._wide_script = fonts.add_wide_script()

    def _fulfil(self, app: App) -> None:
        """The wishes that need to know how large the face is shown."""
        if app.shown_face is None:
            app.pick_at = app.picture_path = None
            return
        self._frame(app, app.shown_face.rig)
        if app.pick_at is not None:
            (x, y), app.pick_at = app.pick_at, None
            hit = self.renderer.pick(x, y) if self._drawn else None
            if hit is not None:
                app.camera = app.camera.pivoted(np.asarray(hit.point, np.float64))

    def _frame(self, app: App, rig: Rig) -> None:
        """Frame the face where that is wished for, or its view changed shape and nobody moved it since."""
        aspect = app.views()[0].aspect
        if app.framing is None and self._framed is not None:
            camera, direction, framed_for = self._framed
            if app.camera == camera and aspect != framed_for:
                app.framing = direction
        if app.framing is not None:
            app.camera = Camera.of_face(rig, app.framing, aspect)
            self._framed, app.framing = (app.camera, app.framing, aspect), None

    def _draw_face(self, app: App) -> None:
        self._hurried = False
        face = self._ready(app)
        if face is None:
            return
        pictured = self.poles.step(app, self.renderer) or self.corners.step(app, self.renderer)
        if pictured:
            self._drawn = ()
        self._smooth(app)
        view = app.views()[0]
        # While something moves, antialiasing is left out where OpenGL runs on the CPU: half the time a frame.
        playing = app.playback.playing or app.pages.emotion.player.playing
        moving = bool(app.drag) or playing or app.turntable or imgui.is_any_item_active()
        quality: Quality = "fast" if moving and app.picture_path is None else "full"
        scene = app.scene()
        wanted = (
            face,
            scene.pose,
            id(scene.offsets),
            id(scene.glow),
            id(scene.reference),
            partner_key(scene),
            app.camera,
            app.shown_look,
            view.size,
            _exactly_lit(app),
        )
        if (*wanted, quality) != self._drawn and (*wanted, "full") != self._drawn:
            self._scene = scene
            look = self._exposed(app, scene, view.size, quality)
            self.renderer.draw(scene, app.camera, look, view.size, quality=quality)
            self._drawn = (*wanted, quality)
        self._hurried |= pictured
        self._legend(app)
        show(self.renderer, view)
        if app.on_face.split is not None:
            self._draw_right(app, app.on_face.split, quality)
        self._save(app)

    def _ready(self, app: App) -> Face | None:
        """The face to draw, loaded. What a page shows and cannot be drawn gives way to the open face."""
        face = app.shown_face
        if face in self._refused:
            app.on_face = OnFace()
            face = app.face
        if face is None or face is self._loaded:
            return face
        try:
            self._load(face)
        except FacemorphError as error:
            if face is app.face:
                raise
            self._refuse(app, face, error)
            return self._ready(app)
        return face

    def _refuse(self, app: App, face: Face, error: FacemorphError) -> None:
        """Never try again to draw what a page shows; say why."""
        actions.tell_error(app, f"{face.title} cannot be drawn", error)
        self._refused.add(face)

    def _draw_right(self, app: App, split: Split, quality: Quality) -> None:
        if split.face in self._refused:
            return
        try:
            self._hurried |= self.split.draw(app, split, quality)
        except FacemorphError as error:
            if split.face is None:
                raise
            self._refuse(app, split.face, error)

    def _exposed(self, app: App, scene: Scene, size: tuple[int, int], quality: Quality) -> Look:
        moving = quality == "fast"
        exactly = _exactly_lit(app)
        look = self._exposing.look(
            self.renderer, scene, app.camera, app.shown_look, size, moving=moving, exactly=exactly
        )
        # The interface was built before: what there is to say takes one more frame.
        self._hurried |= app.luminance_problem != self._exposing.problem
        app.luminance_problem = self._exposing.problem
        return look

    def _smooth(self, app: App) -> None:
        level = self._smoothing.step(app, self.renderer.draw_secs)
        if app.form is not None:
            self.renderer.take(app.form)
        app.look = replace(app.look, subdivision=level)

    def _legend(self, app: App) -> None:
        # The interface was built before the face was drawn, so a new legend takes one more frame.
        if self.renderer.legend is not app.legend:
            app.legend = self.renderer.legend
            self._hurried = True

    def _save(self, app: App) -> None:
        path, app.picture_path = app.picture_path, None
        if path is None:
            return
        if app.luminance_problem:
            app.messages.fail(f"{path.name} has not the luminance asked for: {app.luminance_problem}")
        if app.on_face.split is None:
            files.write_picture(app, path, self.renderer.read(), self.renderer.legend)
        else:
            files.write_picture(app, path, side_by_side(self.renderer, self.split.renderer))


def _exactly_lit(app: App) -> bool:
    """Whether the next picture is one to keep, whose luminance must be exact."""
    return app.picture_path is not None and app.shown_look.luminance is not None


def _another(renderer: DrawsFaces) -> DrawsFaces:
    from facemorph.gl import Renderer

    if not isinstance(renderer, Renderer):
        raise GraphicsError("only facemorph's own renderer can show the face twice.")
    return Renderer(renderer.ctx)
