"""The smooth surface: which level of subdivision is shown, and its making beside the window.

A surface is refined in a worker's thread; until it is there the one before is shown. Automatic shows level 1
where frames leave room for it, which is judged anew for each face:

    OpenGL on the CPU       level 0: the time a frame takes grows with its vertices
    over MOST_AUTOMATIC     vertices at level 1: level 0
    otherwise               level 1, once a frame at level 0, times how many more vertices there will be,
                            is within ROOM_SECS; for good 0 again where frames then take over TOO_LONG_SECS

Times are the graphics card's own, the median of the last few frames.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from statistics import median

from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress
from facemorph.gl.describe import Graphics
from facemorph.gl.form import Form
from facemorph.ui.actions import tell_error
from facemorph.ui.state import App

KIND = "smooth"
MOST_AUTOMATIC = 200_000
# Half of a frame at 60 a second, and nearly all of it.
ROOM_SECS, TOO_LONG_SECS = 0.008, 0.014
_FEWEST, _LOOKED_AT = 5, 15


@dataclass
class Automatic:
    """Judges by the frames of one mesh: `level` is what to show of it."""

    mesh: Mesh | None = None
    level: int = 0
    refused: bool = False
    _secs: deque[float] = field(default_factory=lambda: deque(maxlen=_LOOKED_AT))
    _seen_level: int = 0

    def judge(self, mesh: Mesh, graphics: Graphics | None, shown: int, secs: float | None) -> int:
        """The level for `mesh`, whose last frame at level `shown` took `secs`; None where that is unknown."""
        if mesh is not self.mesh:
            self.mesh, self.level, self.refused = mesh, 0, False
            self._secs.clear()
        if shown != self._seen_level:
            self._secs.clear()
            self._seen_level = shown
        if secs is not None and (not self._secs or secs != self._secs[-1]):
            self._secs.append(secs)
        if graphics is None or graphics.software or self.refused or vertices_after(mesh) > MOST_AUTOMATIC:
            self.level = 0
        elif len(self._secs) >= _FEWEST:
            self._decide(mesh, shown, median(self._secs))
        return self.level

    def _decide(self, mesh: Mesh, shown: int, secs: float) -> None:
        if shown == 0 and self.level == 0:
            self.level = int(secs * vertices_after(mesh) / max(mesh.vertex_count, 1) <= ROOM_SECS)
        elif shown == 1 and secs > TOO_LONG_SECS:
            self.level, self.refused = 0, True


def vertices_after(mesh: Mesh) -> int:
    """About how many vertices level 1 of a closed mesh has: V + E + F, with E half the corners."""
    return mesh.vertex_count + len(mesh.corner_vertices) // 2 + mesh.polygon_count


class Smoothing:
    """Brings the wanted level about. `step` is called once a frame."""

    def __init__(self) -> None:
        self._automatic = Automatic()
        self._asked: tuple[Mesh, int] | None = None  # tried once: what failed or was stopped stays away

    def step(self, app: App, draw_secs: float | None) -> int:
        """The level to draw now; `app.form` is the refined surface that it needs, None for none.

        draw_secs   what the card lately took for a frame, or None
        """
        mesh = app.shown_face.rig.neutral if app.shown_face else None
        if app.form is not None and app.form.of_file is not mesh:
            app.form = None
        shown = app.form.level if app.form else 0
        wanted = 0 if mesh is None else self._wanted(app, mesh, shown, draw_secs)
        if mesh is None or wanted in (0, shown):
            self._stop(app)
            app.form = app.form if wanted else None
        elif self._asked is None or self._asked[0] is not mesh or self._asked[1] != wanted:
            self._start(app, mesh, wanted)
        return app.form.level if app.form else 0

    def _wanted(self, app: App, mesh: Mesh, shown: int, draw_secs: float | None) -> int:
        if app.settings.smooth_surface == "auto":
            return self._automatic.judge(mesh, app.graphics, shown, draw_secs)
        return {"1": 1, "2": 2}.get(app.settings.smooth_surface, 0)

    def _start(self, app: App, mesh: Mesh, level: int) -> None:
        self._asked, graphics = (mesh, level), app.graphics

        def work(progress: Progress) -> Form:
            return Form.of(mesh, level, progress, ahead=graphics)

        def done(form: Form) -> None:
            app.form = form

        def failed(error: BaseException) -> None:
            tell_error(app, "The surface stays as it is", error)

        app.jobs.start(f"Smoothing the surface, level {level}", work, done, failed, kind=KIND)

    def _stop(self, app: App) -> None:
        self._asked = None
        running = app.jobs.of_kind(KIND)
        if running is not None:
            running.cancel()
