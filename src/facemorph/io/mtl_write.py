"""Writing an OBJ's materials and textures beside it, without touching a file of somebody else's."""

from __future__ import annotations

import filecmp
import shutil
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

from facemorph.core.mesh import Material, Mesh
from facemorph.errors import OutputError
from facemorph.io.atomic import replacing
from facemorph.io.limits import TEXTURE_BYTES
from facemorph.io.names import written_name
from facemorph.io.read import is_mesh

_MOST_TRIES = 1_000


class Companions:
    """The `.mtl` and the textures that are to lie beside a mesh; nothing is written before `write`.

    library   the name of the `.mtl` beside `mesh_path`, None where no material is known

    Textures come into the mesh's folder. A file that is there with the same content is used as it is; one
    with another content stays, and the new one gets a number. A texture that is gone is left out. Raises
    `OutputError`.
    """

    def __init__(self, mesh_path: Path, mesh: Mesh) -> None:
        self.library: str | None = None
        self._folder = mesh_path.parent
        self._new: dict[Path, Path | bytes] = {}
        if mesh.materials:
            textures = self._textures(mesh.materials.values())
            text = "".join(_lines(mesh.materials.values(), textures)).encode()
            self.library = self._placed(f"{mesh_path.stem}.mtl", text).name

    def write(self, stack: ExitStack) -> tuple[Path, ...]:
        """Write the files that are new to temporaries, put in place as `stack` closes; returns them."""
        for path, content in self._new.items():
            temporary = stack.enter_context(replacing(path))
            if isinstance(content, Path):
                shutil.copyfile(content, temporary)
            else:
                temporary.write_bytes(content)
        return tuple(self._new)

    def _textures(self, materials: Iterable[Material]) -> dict[Path, str]:
        """The name beside the mesh of each texture that can be copied."""
        found = dict.fromkeys(path for material in materials for path in material.pictures)
        names: dict[Path, str] = {}
        for texture in found:
            with suppress(OSError):
                if is_mesh(texture):
                    continue  # No picture; beside the face it would be taken for a shape.
                if texture.is_file() and texture.stat().st_size <= TEXTURE_BYTES:
                    with texture.open("rb"):
                        names[texture] = self._placed(texture.name, texture).name
        return names

    def _placed(self, name: str, content: Path | bytes) -> Path:
        """Where `content` is to lie: a file that has it already, or a new one under the first free name."""
        wanted = Path(name)
        for number in range(1, _MOST_TRIES):
            path = self._folder / (name if number == 1 else f"{wanted.stem}_{number}{wanted.suffix}")
            if _is_same(self._new.get(path, path), content):
                return path
            if path not in self._new and not path.exists() and not path.is_symlink():
                self._new[path] = content
                return path
        raise OutputError(
            f"{self._folder / name} and {_MOST_TRIES} names like it are taken by other files; "
            "choose another folder."
        )


def remove(paths: Sequence[Path]) -> None:
    """Take away files that were written a moment ago, as far as can be."""
    for path in paths:
        with suppress(OSError):
            path.unlink()


def _lines(materials: Iterable[Material], textures: dict[Path, str]) -> Iterator[str]:
    yield "# facemorph\n"
    for material in materials:
        yield f"newmtl {written_name(material.name)}\n"
        yield f"Kd {_numbers(material.diffuse)}\nKs {_numbers(material.specular)}\n"
        yield f"Ns {material.shininess!r}\nd {material.opacity!r}\n"
        if material.texture in textures:
            yield f"map_Kd {textures[material.texture]}\n"
        for key, path, height in (
            ("map_Bump", material.bump, material.bump_height),
            ("map_Pr", material.roughness, None),
            ("map_wrinkles", material.wrinkles, material.wrinkle_height),
        ):
            if path in textures:
                yield f"{key} {'' if height is None else f'-bm {height!r} '}{textures[path]}\n"


def _numbers(colour: tuple[float, float, float]) -> str:
    return " ".join(repr(float(part)) for part in colour)


def _is_same(there: Path | bytes, content: Path | bytes) -> bool:
    """Whether a file, or what is to become one, holds just `content`."""
    if isinstance(there, bytes) or isinstance(content, bytes):
        return _bytes_of(there) == _bytes_of(content)
    with suppress(OSError):
        return there.is_file() and filecmp.cmp(there, content, shallow=False)
    return False


def _bytes_of(content: Path | bytes) -> bytes | None:
    if isinstance(content, bytes):
        return content
    with suppress(OSError):
        return content.read_bytes() if content.is_file() else None
    return None
