"""Files that the window opens and writes: faces, meshes, pictures. The work runs beside the window."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from facemorph.core.arrays import UInt8
from facemorph.core.progress import Progress
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError
from facemorph.gl.heat import Legend
from facemorph.ui.actions import tell_error
from facemorph.ui.paths import suffixed
from facemorph.ui.state import App, Face

MESH_SUFFIXES = (".obj", ".ply", ".stl", ".gltf", ".glb", ".off")


def open_builtin(app: App, name: str) -> None:
    """Open a built-in face."""
    open_source(app, (name,), builtin=True)


def open_source(app: App, source: Sequence[str], *, builtin: bool = False) -> None:
    """Load a face beside the window; the present one stays until that has gone well."""
    paths = tuple(source) if builtin else tuple(str(Path(path).absolute()) for path in source)
    title = paths[0] if builtin else short(paths)

    def work(progress: Progress) -> Rig:
        return load(paths, progress, builtin=builtin)

    def done(rig: Rig) -> None:
        app.arriving = Face(rig, paths, builtin)

    def failed(error: BaseException) -> None:
        if not builtin and not any(Path(path).exists() for path in paths):
            app.settings.forget(paths)
        tell_error(app, f"{title} was not opened", error)

    app.jobs.start(f"Opening {title}", work, done, failed, kind="face")


def load(paths: tuple[str, ...], progress: Progress, *, builtin: bool) -> Rig:
    """The rig of a built-in's name, of a folder or file, or of several files."""
    from facemorph.io import load_rig

    if builtin:
        return load_rig(paths[0], progress=progress)
    if len(paths) == 1:
        return load_rig(Path(paths[0]), progress=progress)
    return load_rig([Path(path) for path in paths], progress=progress)


def export_mesh(app: App, path: Path) -> None:
    """Write the shown face as an OBJ, in the neutral's order, with the morphed surface's normals."""
    face = app.shown_face
    if face is None:
        return
    rig, scene = face.rig, app.scene()
    path = suffixed(path, ".obj")

    def work(progress: Progress) -> Path:
        from facemorph.api import export_positions

        progress(0.1, "Morphing")
        positions = scene.positions(rig)
        progress(0.4, f"Writing {path.name}")
        return export_positions(rig, positions, path)

    app.jobs.start(f"Exporting {path.name}", work, lambda saved: _saved(app, saved), _failing(app, path))


def save_picture(app: App, path: Path) -> None:
    """Save the face as the next frame shows it."""
    app.picture_path = suffixed(path, ".png")


def write_picture(app: App, path: Path, pixels: UInt8, legend: Legend | None = None) -> None:
    """Write pixels (H, W, 4) uint8 as a PNG, a heat map's with its legend, beside the window."""

    def work(progress: Progress) -> Path:
        from facemorph.gl.legend import with_legend
        from facemorph.io import write_png

        progress(0.1, f"Writing {path.name}")
        write_png(path, pixels if legend is None else with_legend(pixels, legend))
        return path

    app.jobs.start(f"Saving {path.name}", work, lambda saved: _saved(app, saved), _failing(app, path))


def _saved(app: App, path: Path) -> None:
    app.messages.tell(f"Saved {path}")


def _failing(app: App, path: Path) -> Callable[[BaseException], None]:
    def failed(error: BaseException) -> None:
        tell_error(app, f"{path.name} was not saved", error)

    return failed


def keep(app: App, path: Path, unsaved: str, write: Callable[[Path], object]) -> None:
    """Write to `path` what a page keeps, at once; where that fails, say so in the words `unsaved`."""
    try:
        write(path)
    except FacemorphError as error:
        tell_error(app, unsaved, error)
        return
    _saved(app, path)


def short(paths: tuple[str, ...]) -> str:
    """A file's or folder's name, and how many more there are."""
    name = Path(paths[0]).name or paths[0]
    return name if len(paths) == 1 else f"{name} and {len(paths) - 1} more"
