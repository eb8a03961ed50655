"""A copy of a face in which shapes whose vertices stand in another order are back in the neutral's."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.reorder import reorder
from facemorph.errors import FacemorphError, MeshFileError
from facemorph.io.atomic import new_folder
from facemorph.io.face_toml import FACE_TOML
from facemorph.io.foreign import named_files
from facemorph.io.limits import read_bytes
from facemorph.io.load import FaceFiles, face_files, load_rig, place_of
from facemorph.io.mtl import library_files
from facemorph.io.names import listed
from facemorph.io.obj_read import parse_obj
from facemorph.io.obj_write import write_parts
from facemorph.io.read import read_mesh
from facemorph.io.shapes_npz import read_shapes
from facemorph.io.toml_table import read_table
from facemorph.io.toml_write import toml_text


@dataclass
class Repair:
    """What a repair of `folder` wrote into `out`, by file name.

    left_out  each file that could not be used, and why; `refused` is why the copy does not open yet, or ""
    """

    folder: Path
    out: Path
    reordered: list[str] = field(default_factory=list)
    copied: list[str] = field(default_factory=list)
    left_out: list[tuple[str, str]] = field(default_factory=list)
    refused: str = ""

    @property
    def needed(self) -> bool:
        """Whether there was anything to repair; else nothing was written."""
        return bool(self.reordered or self.left_out)

    def lines(self) -> list[str]:
        """What was done, for people."""
        if not self.needed:
            return [f"nothing to repair in {self.folder}; {self.out} was not written."]
        put = listed(self.reordered) if self.reordered else "no shape"
        first = f"wrote {self.out}: {put} put in the neutral's order, {len(self.copied):,} files copied."
        lines = [first, *(f"left out {name}: {why}" for name, why in self.left_out)]
        return [*lines, f"{self.out} does not open yet: {self.refused}"] if self.refused else lines


def repair_folder(source: Path | str, out: Path | str, *, progress: Progress = silent) -> Repair:
    """Write a face into `out` that is the one in `source` with every vertex in the neutral's order.

    Shapes in another order are written anew as OBJ; the neutral, the other shapes, materials, textures,
    `shapes.npz` and `face.toml` are copied. What cannot be read, or is another surface, is left out. `out`
    must be new or empty, and nothing in `source` changes; where there is nothing to repair, nothing is
    written. Raises `OutputError`, and what reading the neutral raises.
    """
    folder, out = place_of(source), Path(out)
    files = face_files(folder)
    repair = Repair(folder, out)
    with new_folder(out, lambda: repair.needed) as stage:
        _Copying(folder, files, stage, repair).run(progress)
    if repair.needed:
        try:
            load_rig(out, cache=False)
        except FacemorphError as error:
            repair.refused = str(error)
    return repair


class _Copying:
    """The files of one face on their way into `stage`."""

    def __init__(self, folder: Path, files: FaceFiles, stage: Path, repair: Repair) -> None:
        self._folder, self._files, self._stage, self._repair = folder, files, stage, repair

    def run(self, progress: Progress) -> None:
        """Copy and repair all there is."""
        shapes = self._files.shapes
        progress(0.0, f"reading {self._files.neutral.name}")
        neutral, libraries = _read(self._files.neutral)
        self._copy(self._files.neutral, libraries)
        renamed: dict[str, str] = {}
        for done, (name, path) in enumerate(shapes.items()):
            progress((done + 1) / (len(shapes) + 1), f"reading {path.name}")
            try:
                renamed[name] = self._shape(neutral, name, path)
            except MeshFileError as error:
                where = f"line {error.line}: " if error.line is not None else ""
                self._repair.left_out.append((path.name, f"{where}{error.problem}."))
        if self._files.described is not None:
            self._description(renamed, self._more(neutral.vertex_count))

    def _shape(self, neutral: Mesh, name: str, path: Path) -> str:
        """The file, relative to the face, under which a shape is in the stage; "" where it is not."""
        mesh, libraries = _read(path)
        unlike = difference(neutral, mesh)
        if unlike is None:
            return self._copy(path, libraries)
        if unlike.cause != "order":
            self._repair.left_out.append((path.name, unlike.problem))
            return ""
        goal = self._goal(path)
        write_parts(goal, reorder(neutral, mesh, name), None, libraries)
        self._repair.reordered.append(goal.name)
        for companion in library_files(path, libraries):
            self._copy_one(companion)
        return goal.relative_to(self._stage).as_posix()

    def _more(self, vertex_count: int) -> bool:
        """Whether there is a `shapes.npz` and it came along."""
        assert self._files.described is not None
        path = self._files.described.more
        if path is None:
            return False
        try:
            read_shapes(path, vertex_count)
        except FacemorphError as error:
            self._repair.left_out.append((path.name, str(error).removeprefix(f"{path} ")))
            return False
        self._copy_one(path)
        return True

    def _description(self, renamed: Mapping[str, str], more: bool) -> None:
        """The `face.toml`: as it is where it is still true, else written anew without its comments."""
        path, repair = self._folder / FACE_TOML, self._repair
        moved = any(
            file and file != self._relative(self._files.shapes[name]).as_posix()
            for name, file in renamed.items()
        )
        if not repair.left_out and not moved:
            self._copy_one(path)
            return
        values = read_table(path).values()
        if not more:
            values.pop("shapes", None)
        entries = [
            {**entry, "file": renamed[entry["name"]]}
            for entry in values.pop("expressions", [])
            if renamed.get(entry["name"])
        ]
        text = toml_text({**values, "expressions": entries})
        (self._stage / FACE_TOML).write_text(text, encoding="utf-8")
        repair.copied.append(FACE_TOML)

    def _copy(self, mesh: Path, libraries: tuple[str, ...]) -> str:
        """Copy a mesh and the files that it names."""
        obj = mesh.suffix.lower() == ".obj"
        for path in library_files(mesh, libraries) if obj else named_files(mesh):
            self._copy_one(path)
        return self._copy_one(mesh)

    def _copy_one(self, path: Path) -> str:
        relative = self._relative(path)
        goal = self._stage / relative
        if not goal.exists():
            goal.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, goal)
            self._repair.copied.append(relative.as_posix())
        return relative.as_posix()

    def _relative(self, path: Path) -> Path:
        return Path(os.path.normpath(path.relative_to(self._folder)))

    def _goal(self, path: Path) -> Path:
        """Where in the stage the OBJ of a shape goes: under its own name, or one that no file takes."""
        relative = self._relative(path)
        if path.suffix.lower() != ".obj":
            taken = {self._relative(p) for p in (self._files.neutral, *self._files.shapes.values())}
            names = (relative.with_name(f"{relative.stem}{end}.obj") for end in ("", *range(2, 9999)))
            relative = next(name for name in names if name not in taken and not (self._stage / name).exists())
        goal = self._stage / relative
        goal.parent.mkdir(parents=True, exist_ok=True)
        return goal


def _read(path: Path) -> tuple[Mesh, tuple[str, ...]]:
    """A mesh, and the material files that it names if it is an OBJ."""
    if path.suffix.lower() != ".obj":
        return read_mesh(path), ()
    file = parse_obj(path, read_bytes(path))
    return file.mesh, file.libraries
