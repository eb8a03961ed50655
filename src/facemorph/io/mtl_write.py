"""Writing an OBJ's materials and textures beside it, without touching a file of somebody else's."""

from __future__ import annotations

import filecmp
from collections.abc import Iterable, Iterator
from pathlib import Path

from facemorph.core.mesh import Material, Mesh
from facemorph.errors import MeshFileError, OutputError
from facemorph.io.atomic import write_bytes
from facemorph.io.limits import TEXTURE_BYTES, read_bytes
from facemorph.io.names import written_name

_MOST_TRIES = 1_000


def write_materials(mesh_path: Path, mesh: Mesh) -> tuple[str | None, tuple[Path, ...]]:
    """The name of the `.mtl` beside `mesh_path`, None where no material is known; and the new files.

    Textures are copied into the mesh's folder. A file that is there with the same content is used as it
    is; one with another content stays, and the new one gets a number. A texture that is gone is left out.
    Raises `OutputError`.
    """
    if not mesh.materials:
        return None, ()
    folder = mesh_path.parent
    new: list[Path] = []
    textures: dict[Path, str] = {}
    for material in mesh.materials.values():
        if material.texture is not None and material.texture not in textures:
            name = _copied(material.texture, folder, new)
            if name is not None:
                textures[material.texture] = name
    text = "".join(_lines(mesh.materials.values(), textures)).encode()
    path = _placed(folder, f"{mesh_path.stem}.mtl", text, new)
    return path.name, tuple(new)


def _lines(materials: Iterable[Material], textures: dict[Path, str]) -> Iterator[str]:
    yield "# facemorph\n"
    for material in materials:
        yield f"newmtl {written_name(material.name)}\n"
        yield f"Kd {_numbers(material.diffuse)}\nKs {_numbers(material.specular)}\n"
        yield f"Ns {material.shininess!r}\nd {material.opacity!r}\n"
        if material.texture in textures:
            yield f"map_Kd {textures[material.texture]}\n"


def _numbers(colour: tuple[float, float, float]) -> str:
    return " ".join(repr(float(part)) for part in colour)


def _copied(texture: Path, folder: Path, new: list[Path]) -> str | None:
    """The name under which `texture` lies in `folder`."""
    beside = folder / texture.name
    try:
        if beside.is_file() and filecmp.cmp(texture, beside, shallow=False):
            return beside.name
        data = read_bytes(texture, TEXTURE_BYTES)
    except (OSError, MeshFileError):
        return None
    return _placed(folder, texture.name, data, new).name


def _placed(folder: Path, name: str, data: bytes, new: list[Path]) -> Path:
    """Where `data` lies in `folder`: a file that has it already, or a new one under the first free name."""
    wanted = Path(name)
    for number in range(1, _MOST_TRIES):
        path = folder / (name if number == 1 else f"{wanted.stem}_{number}{wanted.suffix}")
        if _holds(path, data):
            return path
        if not path.exists() and not path.is_symlink():
            write_bytes(path, data)
            new.append(path)
            return path
    raise OutputError(
        f"{folder / name} and {_MOST_TRIES} names like it are taken by other files; choose another folder."
    )


def _holds(path: Path, data: bytes) -> bool:
    try:
        return path.is_file() and path.stat().st_size == len(data) and path.read_bytes() == data
    except OSError:
        return False
