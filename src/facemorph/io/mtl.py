"""MTL: the colours and textures of an OBJ's materials.

Besides `map_Kd` it may name a relief (`map_Bump`, `bump` or `norm`; heights, or normals), a roughness
(`map_Pr`) and, which is our own, heights of wrinkles (`map_wrinkles`, a set a channel; what fades them in
stands in `face.toml`). `-bm` is how many model units lie between black and white.

A material file, and each texture, must lie in the OBJ's folder or below it; symbolic links are
followed first, and what then lies outside counts as missing. What is missing or cannot be read never
stops a mesh: the material is without it, and `facemorph check` says so.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from facemorph.core.mesh import Material
from facemorph.errors import MeshFileError
from facemorph.io.inside import inside
from facemorph.io.limits import MTL_BYTES, NAMES, read_bytes, shortened

# What a map's line is called, in small letters, and the material's field that it fills.
_MAPS: Mapping[str, str] = MappingProxyType(
    {"map_bump": "bump", "bump": "bump", "norm": "bump", "map_pr": "roughness", "map_wrinkles": "wrinkles"}
)
_LARGEST_HEIGHT = 1e6
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
    materials = read_libraries(mesh_path, names).materials.values()
    return (*files, *dict.fromkeys(path for material in materials for path in material.pictures))


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
        texture, _ = _picture(rest, material, folder, problems)
        return replace(material, texture=texture, texture_lost=texture is None)
    if key.lower() in _MAPS and rest:
        field = _MAPS[key.lower()]
        found, height = _picture(rest, material, folder, problems)
        known: dict[str, Any] = {field: found}
        if field != "roughness":
            known["bump_height" if field == "bump" else "wrinkle_height"] = height
        return replace(material, **known)
    return material


def _picture(
    rest: str, material: Material, folder: Path, problems: list[str]
) -> tuple[Path | None, float | None]:
    """The file that a map's line names, None where it is not in the folder, and its `-bm`."""
    name, height = _map_name(rest)
    found = inside(folder, name) or inside(folder, rest)
    if found is None:
        problems.append(
            f"the texture {shortened(name)!r} of {shortened(material.name)!r} is not in the mesh's folder"
        )
    return found, height


def _map_name(rest: str) -> tuple[str, float | None]:
    """The file in what follows a map's key, after its options (it may have blanks), and their `-bm`."""
    words = rest.split(" ")
    height = None
    while words and words[0] in _OPTIONS:
        option = words.pop(0)
        most = _OPTIONS[option]
        for taken in range(most):
            if not words or (most == 3 and taken and not _numbers(words[0])):
                break
            word = words.pop(0)
            if option == "-bm" and _numbers(word):
                height = min(max(_numbers(word)[0], -_LARGEST_HEIGHT), _LARGEST_HEIGHT)
    return " ".join(words).strip(), height


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
