"""The health of a face folder: whether its shapes correspond, and what else a rigger should look at."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import Shape
from facemorph.errors import FaceFolderError, FacemorphError, MeshFileError
from facemorph.io.check_mesh import mesh_findings
from facemorph.io.check_shape import Movements
from facemorph.io.correctives_toml import read_correctives
from facemorph.io.face_set import HINTS, check_size
from facemorph.io.face_toml import FACE_TOML, DescribedFace, described_rig, read_face_info, unknown_keys
from facemorph.io.limits import read_bytes, shortened
from facemorph.io.load import FaceFiles, face_files, place_of
from facemorph.io.mtl import Library, read_libraries
from facemorph.io.obj_read import parse_obj
from facemorph.io.pictures import picture_problem
from facemorph.io.plain_folder import is_called_neutral, plain_meshes
from facemorph.io.read import read_mesh
from facemorph.io.report import Finding, Level, Report
from facemorph.io.shapes_npz import MoreShapes, read_shapes


def check_folder(path: Path | str, *, progress: Progress = silent) -> Report:
    """Examine a face folder, plain or with a `face.toml`, or a built-in face by its name.

    A bad file is a finding, and the others go on. What loading would refuse is an error here. Raises
    `FaceFolderError` or `UnknownNameError` only for what is no folder with any mesh in it.
    """
    folder = place_of(path)
    if not folder.is_dir():
        raise FaceFolderError(f"{folder} is a file; a folder with a neutral and its shapes was expected.")
    check = _Check(folder)
    try:
        files = face_files(folder)
    except FaceFolderError as error:
        described = (folder / FACE_TOML).is_file()
        meshes = plain_meshes(folder, none_is_well=described)
        check.add("error", folder / FACE_TOML if described else folder, "folder", check.plain(error))
        check.meshes(meshes)
    else:
        check.face(files, progress)
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

    def plain(self, error: Exception) -> str:
        """An error's words without the file that the finding names anyway."""
        text = str(error)
        for path in (self._folder / FACE_TOML, self._folder):
            text = text.removeprefix(f"{path}: ")
        return text

    def meshes(self, files: Iterable[Path]) -> None:
        """Read files of which nobody knows what belongs together."""
        for path in files:
            self._read(path)

    def face(self, files: FaceFiles, progress: Progress) -> None:
        """Examine a neutral and what are to be its shapes."""
        progress(0.0, f"reading {files.neutral.name}")
        if files.described is not None:
            self._description(files.described)
        elif not is_called_neutral(files.neutral):
            self.add("warning", files.neutral, "neutral", "is taken for the neutral, being the only mesh.")
        mesh = self._neutral = self._read(files.neutral, with_textures=True)
        if mesh is None:
            self.meshes(files.shapes.values())
            self._as_loaded(files, None, None)
            return
        for kind, message in mesh_findings(mesh):
            self.add("warning", files.neutral, kind, message)
        movements = Movements(mesh)
        for done, (name, path) in enumerate(files.shapes.items()):
            progress((done + 1) / (len(files.shapes) + 1), f"checking {path.name}")
            shape = self._read(path)
            if shape is not None and self._corresponds(mesh, shape, path):
                self._shape(movements, path, "", Shape(name, name), shape.positions - mesh.positions)
        more = None
        if files.described is not None and files.described.more is not None:
            more = self._more(movements, files.described, files.described.more, mesh.vertex_count)
        self._as_loaded(files, mesh, more)

    def _description(self, face: DescribedFace) -> None:
        """What a `face.toml` says in vain, and leaves unsaid."""
        for sentence in unknown_keys(self._folder):
            self.add("warning", self._folder / FACE_TOML, "key", sentence)
        for path in face.unlisted:
            self.add(
                "warning",
                path,
                "unlisted",
                f"is not loaded: {FACE_TOML} does not list it. Give it a name and file in [[expressions]].",
            )

    def _as_loaded(self, files: FaceFiles, neutral: Mesh | None, more: MoreShapes | None) -> None:
        """What loading refuses although each file is well by itself."""
        try:
            if neutral is not None:
                check_size(len(files.shapes), neutral.vertex_count)
            if files.described is None:
                return
            if neutral is None:
                read_face_info(self._folder)
                return
            count = len(files.shapes) + (len(more.shapes) if more is not None else 0)
            still = np.broadcast_to(np.float32(0.0), (count, neutral.vertex_count, 3))
            described_rig(files.described, neutral, still, more)
        except FaceFolderError as error:
            where = self._folder if files.described is None else self._folder / FACE_TOML
            self.add("error", where, "folder", self.plain(error))

    def report(self) -> Report:
        """What was found so far."""
        mesh = self._neutral
        counts = (mesh.vertex_count, mesh.polygon_count) if mesh is not None else (0, 0)
        names = tuple(shape.name for shape, _ in self._good)
        return Report(str(self._folder), *counts, names, tuple(self._findings))

    def _read(self, path: Path, with_textures: bool = False) -> Mesh | None:
        try:
            if path.suffix.lower() != ".obj":
                mesh = read_mesh(path)
                for note in mesh.notes:
                    self.add("warning", path, "left-out", note.removeprefix(f"{path}: "))
                return mesh
            file = parse_obj(path, read_bytes(path))
        except MeshFileError as error:
            where = f"line {error.line:,}: " if error.line is not None else ""
            kind = "not-finite" if "not finite" in error.problem else "unreadable"
            self.add("error", path, kind, f"{where}{error.problem}.{' ' * bool(error.hint)}{error.hint}")
            return None
        if with_textures:
            self._textures(path, read_libraries(path, file.libraries))
        return file.mesh

    def _textures(self, path: Path, library: Library) -> None:
        for problem in library.problems:
            self.add("warning", path, "texture", f"{problem}.")
        found = {path: m.name for m in library.materials.values() for path in m.pictures}
        for texture, material in found.items():
            wrong = picture_problem(texture)
            if wrong is not None:
                self.add("warning", texture, "texture", f"the texture of {shortened(material)!r} {wrong}.")

    def _corresponds(self, neutral: Mesh, shape: Mesh, path: Path) -> bool:
        unlike = difference(neutral, shape)
        if unlike is None:
            return True
        hint = HINTS[unlike.cause].replace("FOLDER", shlex.quote(str(self._folder)))
        self.add("error", path, unlike.cause, f"{unlike.problem} {hint}")
        return False

    def _shape(
        self,
        movements: Movements,
        path: Path,
        prefix: str,
        shape: Shape,
        delta: Float32,
        under: Float32 | None = None,
    ) -> None:
        empty = False
        for kind, message in movements.findings(delta, under):
            level: Level = "error" if kind in ("scale", "turned") else "warning"
            empty = empty or kind == "empty"
            self.add(level, path, kind, prefix + message)
        # The same movement under the names of two conventions (jawOpen, AU27) is meant.
        same_set = [(other.name, there) for other, there in self._good if other.set == shape.set]
        twin = next((name for name, there in same_set if movements.alike(delta, there)), None)
        if twin is not None and not empty:
            self.add("warning", path, "duplicate", f"{prefix}is the same shape as {twin!r}.")
        self._good.append((shape, delta))

    def _more(
        self, movements: Movements, face: DescribedFace, path: Path, vertex_count: int
    ) -> MoreShapes | None:
        try:
            more = read_shapes(path, vertex_count)
            check_size(len(face.shapes) + len(more.shapes), vertex_count)
        except FacemorphError as error:
            self.add("error", path, "unreadable", str(error).removeprefix(f"{path} "))
            return None
        drivers = _drivers(face)
        known = {shape.name: moves for shape, moves in self._good}
        for shape, delta in zip(more.shapes, more.deltas, strict=True):
            at = drivers.get(shape.name, {})
            moved = [known[name] * np.float32(weight) for name, weight in at.items() if name in known]
            under = sum(moved[1:], start=moved[0]) if moved else None
            self._shape(movements, path, f"{shape.name} ", shape, delta, under)
            known[shape.name] = delta
        return more


def _drivers(face: DescribedFace) -> dict[str, dict[str, float]]:
    """Of each corrective, the weights of the shapes by which it is on whole."""
    try:
        rules = read_correctives(face.table)
    except FaceFolderError:
        # It is told where the whole description is read.
        return {}
    return {
        rule.shape: {**dict.fromkeys(rule.product, 1.0), **{hat.over: hat.peak for hat in rule.hats}}
        for rule in rules
    }
