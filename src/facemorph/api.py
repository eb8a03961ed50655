"""The library in a handful of functions: load a face, pose it, draw it, write it.

rig = facemorph.load("ada")
pose = facemorph.Pose.between("neutral", "happy", t=0.6, curve="cosine")
pixels = facemorph.render(rig, pose, size=(800, 800))
facemorph.save_picture("happy.png", pixels)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Int32, UInt8
from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels
from facemorph.core.normals import vertex_normals
from facemorph.core.picture import Look, checked_size
from facemorph.core.pose import Pose, state_of
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.core.scene import Scene
from facemorph.errors import DeformError, OptionError, PoseError

if TYPE_CHECKING:
    from facemorph.deform.handles import HandleSet
    from facemorph.deform.rbf import Kernel
    from facemorph.deform.rebuild import Rebuilt
    from facemorph.gl import Offscreen

MOST_POINTS = 2000
AnyPose = Pose | Mapping[str, float] | Scene


def load(
    source: str | Path | Sequence[str | Path], *, progress: Progress = silent, cache: bool = True
) -> Rig:
    """A face from a built-in's name, a folder, or mesh files of which the first is the neutral.

    Raises `MeshFileError`, `CorrespondenceError`, `FaceFolderError` or `UnknownNameError`.
    """
    from facemorph.io import load_rig

    if not isinstance(source, str | Path) and len(source) == 1:
        source = source[0]
    return load_rig(source, progress=progress, cache=cache)


def render(
    rig: Rig,
    pose: AnyPose | None = None,
    *,
    size: tuple[int, int] = (1280, 800),
    camera: Camera | str = "front",
    look: Look | None = None,
) -> UInt8:
    """A picture of `rig` in `pose` as (H, W, 4) uint8, sRGB, top row first; `size` is (W, H) in pixels.

    `camera` is a `Camera`, a named direction (front, three-quarter, left, right) or "AZIMUTH,ELEVATION".
    Opens an OpenGL context of its own and closes it; for many pictures keep a `facemorph.Offscreen`.
    Raises `GraphicsError`, `OptionError`, `PoseError`, `UnknownNameError`.
    """
    from facemorph.gl import render as drawn

    return drawn(rig, pose, size=size, camera=camera, look=look)


def render_sheet(
    rig: Rig, *, tile: tuple[int, int] = (320, 320), camera: str = "front", look: Look | None = None
) -> UInt8:
    """Neutral and every expression as labelled tiles of (W, H) pixels, (H, W, 4) uint8."""
    from facemorph.gl import Offscreen, sheet

    checked_size(tile)
    with Offscreen() as screen:
        return sheet(screen, rig, tile=tile, camera=camera, look=look or Look())


def film_strip(
    screen: Offscreen, rig: Rig, target: str, *, frames: int = 6, tile: tuple[int, int] = (240, 300)
) -> UInt8:
    """Neutral to `target` in equal steps, side by side, (H, frames W, 4) uint8."""
    steps = np.linspace(0.0, 1.0, frames)
    poses = [Pose.between("neutral", target, float(t)) for t in steps]
    return np.concatenate([screen.render(rig, pose, size=tile) for pose in poses], axis=1)


def save_picture(path: str | Path, pixels: UInt8) -> Path:
    """Write pixels (H, W, 4) as a PNG, whole or not at all. Raises `OutputError`, `OptionError`."""
    from facemorph.io import write_png

    if Path(path).suffix.lower() != ".png":
        raise OptionError(f"pictures are written as .png; {Path(path).name!r} does not end so.")
    write_png(Path(path), pixels)
    return Path(path)


def export(rig: Rig, pose: AnyPose, path: str | Path) -> Path:
    """Write the posed face as an OBJ: same order, polygons, groups, uvs; normals of the morphed surface."""
    return export_positions(rig, Scene.of(pose).positions(rig), path)


def export_positions(rig: Rig, positions: Float32, path: str | Path) -> Path:
    """Write the face with other positions (V, 3) as an OBJ, with the normals of that surface."""
    from facemorph.io import write_obj

    if not np.isfinite(positions).all():
        raise PoseError("the face flies apart in this pose: its positions are no finite numbers.")
    write_obj(Path(path), rig.neutral.with_positions(positions), vertex_normals(positions, rig.triangles))
    return Path(path)


def control_points(
    rig: Rig,
    source: str,
    target: str,
    points: int | str | Path,
    kernel: Kernel = "r",
    c: float | None = None,
) -> HandleSet:
    """Points to rebuild `target` from: so many that do it well by `kernel`, or those of a handles file.

    Raises `OptionError`, `DeformError`, `UnknownNameError`, `ControlsFileError`, `MeshFileError`.
    """
    from facemorph.deform.control_points import rebuilding_vertices
    from facemorph.deform.handles import Handle, HandleSet
    from facemorph.io import read_handles

    if isinstance(points, str) and points.isdecimal():
        points = int(points[:9])
    if not isinstance(points, int):
        return read_handles(points, rig)
    if not 4 <= points <= MOST_POINTS:
        raise OptionError(f"RBF takes 4 to {MOST_POINTS} control points, not {points}.")
    first, last = rig.positions(state_of(source)), rig.positions(state_of(target))
    vertices = rebuilding_vertices(rig, first, last, points, kernel, c)
    return HandleSet(tuple(Handle(int(vertex)) for vertex in vertices), kernel, c)


def rebuild(
    rig: Rig, source: str, target: str, vertices: Int32, kernel: Kernel = "r", c: float | None = None
) -> Rebuilt:
    """Expression `target` rebuilt from `source` and how the control points at `vertices` (n,) move (2.3).

    Raises `DeformError` for points that make no deformation, `UnknownNameError`.
    """
    from facemorph.deform.rebuild import rebuilt

    strange = [int(vertex) for vertex in vertices if not 0 <= vertex < rig.neutral.vertex_count]
    if strange:
        raise DeformError(
            f"there is no vertex {strange[0]}; the face has 0 to {rig.neutral.vertex_count - 1}."
        )
    return rebuilt(rig, rig.positions(state_of(source)), rig.positions(state_of(target)), vertices, kernel, c)


def save_expressions(rig: Rig, folder: str | Path, *, size: tuple[int, int] = (800, 800)) -> list[Path]:
    """A picture of neutral and of each expression, and a film strip to the first one; returns their paths."""
    from facemorph.gl import Offscreen
    from facemorph.io.names import file_stem

    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    names = [shape.name for shape in rig.shapes_in(EXPRESSION)]
    paths: list[Path] = []
    with Offscreen() as screen:
        for name in ["neutral", *names]:
            pixels = screen.render(rig, Pose.between("neutral", name, 1.0), size=size)
            paths.append(save_picture(_free(folder / f"{file_stem(name)}.png", paths), pixels))
        if names:
            strip = film_strip(screen, rig, names[0])
            paths.append(save_picture(_free(folder / f"neutral-to-{file_stem(names[0])}.png", paths), strip))
    return paths


def _free(path: Path, taken: list[Path]) -> Path:
    """`path`, or one with a number where names of shapes became alike."""
    names = {other.name.casefold() for other in taken}
    number, free = 2, path
    while free.name.casefold() in names:
        free = path.with_stem(f"{path.stem}-{number}")
        number += 1
    return free


def facts(rig: Rig) -> dict[str, object]:
    """What `facemorph info` tells: counts, parts, shapes and size, ready for JSON."""
    mesh = rig.neutral
    low, high = mesh.bounds.astype(float)
    return {
        "name": rig.info.name,
        "vertices": mesh.vertex_count,
        "polygons": mesh.polygon_count,
        "triangles": len(rig.triangles),
        "uvs": len(mesh.uvs),
        "groups": _names(mesh.groups),
        "objects": _names(mesh.objects),
        "materials": _names(mesh.materials_used),
        "shapes": [shape.name for shape in rig.controls],
        "correctives": [rule.shape for rule in rig.correctives],
        "diagonal": mesh.diagonal,
        "size": [round(float(side), 6) for side in high - low],
        "unit": rig.info.unit,
        "landmarks": len(rig.info.landmarks),
        "landmark_names": [landmark.name for landmark in rig.info.landmarks],
        "regions": list(rig.regions.names) if rig.regions else [],
        "credit": rig.info.credit,
        "licence": rig.info.licence,
        "notes": list(mesh.notes),
    }


def _names(labels: Labels | None) -> list[str]:
    return list(labels.names) if labels else []
