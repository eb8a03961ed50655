"""The health of a face folder: whether its shapes correspond, and what else a rigger should look at."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from facemorph.core.arrays import Float32
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import Shape
from facemorph.errors import FaceFolderError, FacemorphError, MeshFileError
from facemorph.io.check_mesh import mesh_findings
from facemorph.io.check_shape import Movements
from facemorph.io.face_set import HINTS, check_size
from facemorph.io.limits import read_bytes
from facemorph.io.load import face_files, plain_meshes
from facemorph.io.mtl import read_libraries
from facemorph.io.obj_read import parse_obj
from facemorph.io.read import read_mesh
from facemorph.io.report import Finding, Level, Report
from facemorph.io.shapes_npz import read_shapes


def check_folder(path: Path | str, *, progress: Progress = silent) -> Report:
    """Examine a face folder, plain or with a `face.toml`. A bad file is a finding, and the others go on.

    Raises `FaceFolderError` only for what is no folder with any mesh in it.
    """
    folder = Path(path)
    if not folder.is_dir():
        what = "is a file" if folder.exists() else "does not exist"
        raise FaceFolderError(f"{folder} {what}; a folder with a neutral and its shapes was expected.")
    check = _Check(folder)
    try:
        files = face_files(folder)
    except FaceFolderError as error:
        meshes = plain_meshes(folder)
        check.add("error", folder, "folder", str(error))
        check.meshes(meshes)
    else:
        check.face(files.neutral, files.shapes, files.more, progress)
    return check.report()


class _Check:
    """A check under way."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._findings: list[Finding] = []
        self._neutral: Mesh | None = None
        self._good: list[tuple[Shape, Float32]] = []

    def add(self, level: Level, file: Path, kind: str, message: str) -> None:
        """Note something."""
        self._findings.append(Finding(level, file.name or str(file), kind, message))

    def meshes(self, files: list[Path]) -> None:
        """Read files of which nobody knows what belongs together."""
        for path in files:
            self._read(path)

    def face(self, neutral: Path, shapes: Mapping[str, Path], more: Path | None, progress: Progress) -> None:
        """Examine a neutral and what are to be its shapes."""
        progress(0.0, f"reading {neutral.name}")
        mesh = self._neutral = self._read(neutral, with_textures=True)
        if mesh is None:
            self.meshes(list(shapes.values()))
            return
        for kind, message in mesh_findings(mesh):
            self.add("warning", neutral, kind, message)
        movements = Movements(mesh)
        for done, (name, path) in enumerate(shapes.items()):
            progress((done + 1) / (len(shapes) + 1), f"checking {path.name}")
            shape = self._read(path)
            if shape is not None and self._corresponds(mesh, shape, path):
                self._shape(movements, path, "", Shape(name, name), shape.positions - mesh.positions)
        if more is not None:
            self._more(movements, more, mesh.vertex_count)

    def report(self) -> Report:
        """What was found so far."""
        mesh = self._neutral
        counts = (mesh.vertex_count, mesh.polygon_count) if mesh is not None else (0, 0)
        names = tuple(shape.name for shape, _ in self._good)
        return Report(str(self._folder), *counts, names, tuple(self._findings))

    def _read(self, path: Path, with_textures: bool = False) -> Mesh | None:
        try:
            if path.suffix.lower() != ".obj":
                return read_mesh(path)
            file = parse_obj(path, read_bytes(path))
        except MeshFileError as error:
            where = f"line {error.line:,}: " if error.line is not None else ""
            kind = "not-finite" if "not finite" in error.problem else "unreadable"
            self.add("error", path, kind, f"{where}{error.problem}.{' ' * bool(error.hint)}{error.hint}")
            return None
        if with_textures:
            for problem in read_libraries(path, file.libraries).problems:
                self.add("warning", path, "texture", f"{problem}.")
        return file.mesh

    def _corresponds(self, neutral: Mesh, shape: Mesh, path: Path) -> bool:
        unlike = difference(neutral, shape)
        if unlike is None:
            return True
        self.add("error", path, unlike.cause, f"{unlike.problem} {HINTS[unlike.cause]}")
        return False

    def _shape(self, movements: Movements, path: Path, prefix: str, shape: Shape, delta: Float32) -> None:
        empty = False
        for kind, message in movements.findings(delta):
            level: Level = "error" if kind == "scale" else "warning"
            empty = empty or kind == "empty"
            self.add(level, path, kind, prefix + message)
        # The same movement under the names of two conventions (jawOpen, AU27) is meant.
        same_set = [(other.name, there) for other, there in self._good if other.set == shape.set]
        twin = next((name for name, there in same_set if movements.alike(delta, there)), None)
        if twin is not None and not empty:
            self.add("warning", path, "duplicate", f"{prefix}is the same shape as {twin!r}.")
        self._good.append((shape, delta))

    def _more(self, movements: Movements, path: Path, vertex_count: int) -> None:
        try:
            more = read_shapes(path, vertex_count)
            check_size(len(self._good) + len(more.shapes), vertex_count)
        except FacemorphError as error:
            self.add("error", path, "unreadable", str(error))
            return
        for shape, delta in zip(more.shapes, more.deltas, strict=True):
            self._shape(movements, path, f"{shape.name} ", shape, delta)
