"""Pictures of the built-in people for the pages Faces and People: made once, a piece a frame, and cached."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph import __version__
from facemorph.core.arrays import UInt8
from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError
from facemorph.resources import builtin_faces
from facemorph.ui.state import App

if TYPE_CHECKING:
    import moderngl

SIZE = (176, 208)
_BACKGROUND = (0.20, 0.21, 0.23, 1.0)


class Thumbnails:
    """Fills `app.face_pictures`, one built-in at a time, while a page shows them.

    The mesh is read in a worker thread; the frames after that load it into a renderer of its own, draw
    it, and hand the pixels to a texture. A picture that is in the cache skips the first two.
    """

    def __init__(self, ctx: moderngl.Context, folder: Path | None = None) -> None:
        self._ctx = ctx
        self._folder = folder if folder is not None else cache_folder()
        self._textures: dict[str, moderngl.Texture] = {}
        self._asked: set[str] = set()
        self._ready: list[tuple[str, Rig]] = []
        self._pixels: list[tuple[str, UInt8]] = []
        self._more = False  # pictures still to be asked for, and in sight

    def step(self, app: App) -> None:
        """One piece of the work, if there is any and its place is in sight."""
        if not _in_sight(app):
            self._more = False
            return
        self._more = any(name not in self._asked for name in app.builtins)
        if self._pixels:
            name, pixels = self._pixels.pop(0)
            self._show(app, name, pixels)
        elif self._ready:
            name, rig = self._ready.pop(0)
            self._draw(app, name, rig)
        else:
            self._ask(app)

    @property
    def busy(self) -> bool:
        """Whether a frame soon has a piece to do."""
        return bool(self._pixels or self._ready or self._more)

    def _ask(self, app: App) -> None:
        if app.jobs.of_kind("thumbnail") or app.jobs.of_kind("face"):
            return
        waiting = [name for name in app.builtins if name not in self._asked]
        if not waiting:
            return
        name = waiting[0]
        self._asked.add(name)
        folder, path = builtin_faces().get(name), self._folder
        if folder is None:
            return

        def work(progress: Progress) -> UInt8 | Rig:
            kept = _kept(path / f"{_key(folder)}.npy") if path is not None else None
            return kept if kept is not None else _neutral_only(name)

        def done(result: UInt8 | Rig) -> None:
            if isinstance(result, Rig):
                self._ready.append((name, result))
            else:
                self._pixels.append((name, result))

        # A face without a picture still has its name to click on.
        app.jobs.start(f"Picture of {name}", work, done, lambda error: None, kind="thumbnail", quiet=True)

    def _draw(self, app: App, name: str, rig: Rig) -> None:
        from facemorph.gl import Renderer

        renderer = Renderer(self._ctx)
        try:
            renderer.load(rig)
            camera = Camera.of_face(rig, "10,2", SIZE[0] / SIZE[1])
            renderer.draw(Pose(), camera, Look(background=_BACKGROUND), (SIZE[0] * 2, SIZE[1] * 2))
            large = renderer.read().reshape(SIZE[1], 2, SIZE[0], 2, 4).astype(np.float32)
        except FacemorphError:
            return
        finally:
            renderer.release()
        pixels = np.ascontiguousarray(large.mean(axis=(1, 3)).round().astype(np.uint8))
        self._pixels.append((name, pixels))
        folder = builtin_faces().get(name)
        if folder is not None and self._folder is not None:
            _keep(self._folder / f"{_key(folder)}.npy", pixels)

    def _show(self, app: App, name: str, pixels: UInt8) -> None:
        from facemorph.gl import texture_of

        texture = texture_of(self._ctx, pixels)
        self._textures[name] = texture
        app.face_pictures[name] = texture.glo

    def release(self) -> None:
        """Give the textures back."""
        for texture in self._textures.values():
            texture.release()
        self._textures.clear()


def _in_sight(app: App) -> bool:
    people = app.settings.right_open and app.settings.right_page == "People"
    return (app.settings.left_open or people) and not app.panels_hidden


def cache_folder() -> Path | None:
    """Where pictures are kept between starts, None for a user without a home.

    FACEMORPH_CACHE_DIR names another place.
    """
    override = os.environ.get("FACEMORPH_CACHE_DIR")
    if override:
        return Path(override) / "thumbnails"
    import platformdirs

    try:
        folder = platformdirs.user_cache_path("facemorph", appauthor=False) / "thumbnails"
    except RuntimeError:
        return None
    return folder if folder.is_absolute() else None


def _neutral_only(name: str) -> Rig:
    from facemorph.io import load_rig

    rig = load_rig(name, progress=silent)
    return Rig(rig.neutral, (), np.zeros((0, rig.neutral.vertex_count, 3), np.float32), rig.info)


def _key(folder: Path) -> str:
    """A name for the face as it is now: changed files get a new picture."""
    digest = hashlib.sha256(f"{__version__} {SIZE} {_BACKGROUND}".encode())
    for path in sorted(folder.iterdir()):
        stat = path.stat()
        digest.update(f"{path.name} {stat.st_size} {stat.st_mtime_ns}".encode())
    return f"{folder.name}-{digest.hexdigest()[:16]}"


def _kept(path: Path) -> UInt8 | None:
    try:
        pixels = np.load(path, allow_pickle=False)
    except (OSError, ValueError, EOFError):
        return None
    fits = (
        isinstance(pixels, np.ndarray) and pixels.shape == (SIZE[1], SIZE[0], 4) and pixels.dtype == np.uint8
    )
    return pixels if fits else None


def _keep(path: Path, pixels: UInt8) -> None:
    from facemorph.io.atomic import replacing

    # A cache that cannot be written costs time at the next start, nothing else.
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as temporary, temporary.open("wb") as file:
            np.save(file, pixels)
    except (OSError, FacemorphError):
        return
