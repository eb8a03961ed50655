"""MTL: the colours and textures of an OBJ's materials.

A material file, and each texture, must lie in the OBJ's folder or below it; symbolic links are
followed first, and what then lies outside counts as missing. What is missing or cannot be read never
stops a mesh: the material is without it, and `facemorph check` says so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from facemorph.core.mesh import Material
from facemorph.errors import MeshFileError
from facemorph.io.inside import inside
from facemorph.io.limits import MTL_BYTES, NAMES, read_bytes, shortened

# Options of map_Kd and how many words each takes; those with a range take one to three numbers.
_OPTIONS = {"-blendu": 1, "-blendv": 1, "-bm": 1, "-boost": 1, "-cc": 1, "-clamp": 1, "-imfchan": 1,
            "-mm": 2, "-texres": 1, "-type": 1, "-o": 3, "-s": 3, "-t": 3}  # fmt: skip


@dataclass(frozen=True)
class Library:
    """Materials by name, and what was wrong on the way, in plain words."""

    materials: dict[str, Material]
    problems: tuple[str, ...]


def read_libraries(mesh_path: Path, names: Sequence[str]) -> Library:
    """The materials of the files that an OBJ's `mtllib` lines name; the first to define a name has it."""
    folder = mesh_path.parent
    materials: dict[str, Material] = {}
    problems: list[str] = []
    for name in _files(folder, names, problems):
        library = _read(folder, name)
        problems.extend(library.problems)
        materials = {**library.materials, **materials}
    return Library(materials, tuple(problems))


def library_files(mesh_path: Path, names: Sequence[str]) -> tuple[Path, ...]:
    """The material files that an OBJ's `mtllib` lines name, and the textures that these name."""
    folder = mesh_path.parent
    files = [folder / name for name in _files(folder, names, [])]
    textures = (material.texture for material in read_libraries(mesh_path, names).materials.values())
    return (*files, *(path for path in dict.fromkeys(textures) if path is not None))


def _files(folder: Path, names: Sequence[str], problems: list[str]) -> list[str]:
    """The files that mtllib lines name: each a file with blanks in its name, or several files."""
    files = []
    for name in dict.fromkeys(names):
        choices = [name] if inside(folder, name) else name.split()
        for choice in choices:
            if inside(folder, choice):
                files.append(choice)
            else:
                problems.append(f"the material file {shortened(choice)!r} is not in the mesh's folder")
    return list(dict.fromkeys(files))


def _read(folder: Path, name: str) -> Library:
    path = folder / name
    try:
        text = read_bytes(path, MTL_BYTES).decode("utf-8-sig", "replace")
    except MeshFileError as error:
        return Library({}, (f"the material file {shortened(name)!r} {error.problem}",))
    materials: dict[str, Material] = {}
    problems: list[str] = []
    current: Material | None = None
    for line in text.splitlines():
        words = line.split(None, 1)
        if not words:
            continue
        key, rest = words[0], words[1].strip() if len(words) > 1 else ""
        if key == "newmtl":
            current = None
            if rest and rest not in materials and len(materials) < NAMES:
                current = materials[rest] = Material(rest)
        elif current is not None:
            current = materials[current.name] = _with(current, key, rest, folder, problems)
    return Library(materials, tuple(problems))


def _with(material: Material, key: str, rest: str, folder: Path, problems: list[str]) -> Material:
    """`material` with what one line says of it."""
    numbers = _numbers(rest)
    if key == "Kd" and numbers:
        return replace(material, diffuse=_colour(numbers))
    if key == "Ks" and numbers:
        return replace(material, specular=_colour(numbers))
    if key == "Ns" and numbers:
        return replace(material, shininess=min(max(numbers[0], 0.0), 1000.0))
    if key == "d" and numbers:
        return replace(material, opacity=min(max(numbers[-1], 0.0), 1.0))
    if key == "Tr" and numbers:
        return replace(material, opacity=min(max(1.0 - numbers[0], 0.0), 1.0))
    if key.lower() == "map_kd" and rest:
        name = _texture_name(rest)
        texture = inside(folder, name) or inside(folder, rest)
        if texture is None:
            problems.append(
                f"the texture {shortened(name)!r} of {shortened(material.name)!r} is not in the mesh's folder"
            )
        return replace(material, texture=texture, texture_lost=texture is None)
    return material


def _texture_name(rest: str) -> str:
    """The file in what follows map_Kd, after its options; it may have blanks in it."""
    words = rest.split(" ")
    while words and words[0] in _OPTIONS:
        most = _OPTIONS[words.pop(0)]
        for taken in range(most):
            if not words or (most == 3 and taken and not _numbers(words[0])):
                break
            words.pop(0)
    return " ".join(words).strip()


def _numbers(rest: str) -> list[float]:
    """The finite numbers among the first words, at most three."""
    numbers = []
    for word in rest.split()[:4]:
        try:
            number = float(word)
        except ValueError:
            continue
        if math.isfinite(number):
            numbers.append(number)
    return numbers[:3]


def _colour(numbers: list[float]) -> tuple[float, float, float]:
    """Three factors 0..1; one number stands for all three."""
    r, g, b = (numbers * 3)[:3] if len(numbers) < 3 else numbers[:3]
    return min(max(r, 0.0), 1.0), min(max(g, 0.0), 1.0), min(max(b, 0.0), 1.0)
