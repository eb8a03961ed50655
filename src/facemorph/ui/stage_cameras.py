"""A camera for each face that pages put in the place of the open one: each is found again as it was left."""

from __future__ import annotations

from facemorph.core.camera import Camera
from facemorph.core.mesh import Mesh
from facemorph.ui.state import App

_MOST_KEPT = 8


class StageCameras:
    """Changes `app.camera` when another head, or the same in another number of views, comes to be shown.

    One that was seen before is seen as then; another is put in sight from where the camera stands. Pages
    that show the open face, once or twice, see to its camera themselves.
    """

    def __init__(self) -> None:
        self._shown: tuple[Mesh, int] | None = None
        self._staged = False
        self._kept: dict[tuple[Mesh, int], Camera] = {}

    def settle(self, app: App) -> None:
        """Once a frame, when it is known what is shown."""
        face = app.shown_face
        now = (face.rig.neutral, len(app.views())) if face else None
        concerned = self._staged or app.on_face.stage is not None
        before, self._shown, self._staged = self._shown, now, app.on_face.stage is not None
        if now is None or before is None or now == before or not concerned:
            return
        self._kept.pop(before, None)
        self._kept[before] = app.camera
        if app.framing is None and now in self._kept:
            app.camera = self._kept[now]
        elif app.framing is None:
            app.framing = f"{app.camera.azimuth_deg},{app.camera.elevation_deg}"
        while len(self._kept) > _MOST_KEPT:
            del self._kept[next(iter(self._kept))]
