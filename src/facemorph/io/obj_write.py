"""Writing OBJ: everything a `Mesh` has, in the same order, so that reading it again gives the same arrays.

Coordinates are written with the fewest decimals that give the same float32 back. Materials go into a
`.mtl` beside the mesh and their textures are copied there, so that the mesh opens with its looks in any
program; a different file that already has such a name is left alone, and another name is taken.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.core.mesh import Labels, Mesh
from facemorph.errors import MeshDataError
from facemorph.io.atomic import folders_for, replacing
from facemorph.io.mtl_write import Companions, remove
from facemorph.io.names import written_name

_MOST_DECIMALS = 12
_ROWS = 1 << 16


def write_obj(path: Path | str, mesh: Mesh, normals: Float32 | None = None) -> tuple[Path, ...]:
    """Write `mesh` as an OBJ; returns the files written, the mesh first. All of them appear, or none.

    normals (V, 3), one for each vertex, take the place of the mesh's own (those of a morphed face belong
    to its neutral: pass the morphed ones). Raises `OutputError`, and `MeshDataError` where normals do
    not fit.
    """
    path = Path(path)
    if normals is not None and normals.shape != mesh.positions.shape:
        raise MeshDataError(f"normals must be {mesh.positions.shape}, not {normals.shape}.")
    with folders_for(path, path):
        return (path, *_written(path, mesh, normals))


def _written(path: Path, mesh: Mesh, normals: Float32 | None) -> tuple[Path, ...]:
    """Write the mesh and what is to lie beside it, and return the latter."""
    beside: tuple[Path, ...] = ()
    try:
        with ExitStack() as stack:
            # Entered first, the mesh is refused before anything else is touched, and put in place last.
            temporary = stack.enter_context(replacing(path))
            companions = Companions(path, mesh)
            write_parts(temporary, mesh, normals, [companions.library] if companions.library else [])
            beside = companions.write(stack)
    except BaseException:
        remove(beside)
        raise
    return beside


def write_parts(path: Path, mesh: Mesh, normals: Float32 | None, libraries: Sequence[str]) -> None:
    """Write the text of `mesh` into `path` itself; material files of these names are taken to be there."""
    with path.open("wb") as file:
        for part in _parts(mesh, normals, libraries):
            file.write(part)


def _parts(mesh: Mesh, normals: Float32 | None, libraries: Sequence[str]) -> Iterator[bytes]:
    """The file's text, piece by piece."""
    yield b"# facemorph\n"
    for library in libraries:
        yield f"mtllib {library}\n".encode()
    rows = mesh.positions if mesh.colours is None else np.hstack([mesh.positions, mesh.colours])
    yield from _rows(b"v", rows)
    yield from _rows(b"vt", mesh.uvs)
    yield from _rows(b"vn", mesh.normals if normals is None else normals)
    corner_normals = mesh.corner_normals if normals is None else mesh.corner_vertices
    yield from _faces(mesh, _corners(mesh.corner_vertices, mesh.corner_uvs, corner_normals))


def _rows(word: bytes, numbers: Float32) -> Iterator[bytes]:
    """One line a row of `numbers` (n, m)."""
    for start in range(0, len(numbers), _ROWS):
        block = numbers[start : start + _ROWS]
        texts = _decimal_texts(block)
        columns = [texts[i :: block.shape[1]] for i in range(block.shape[1])]
        prefix = word.decode() + " "
        yield "".join([prefix + " ".join(row) + "\n" for row in zip(*columns, strict=True)]).encode()


def _decimal_texts(numbers: Float32) -> list[str]:
    """Each number with the fewest decimals, at least one, that give the same float32 back."""
    values = numbers.astype(np.float64).ravel()
    single = numbers.ravel()
    rounded = values.copy()
    decimals = np.full(len(values), -1)
    left = np.flatnonzero(np.isfinite(values) & (np.abs(values) < 1e9))
    for count in range(1, _MOST_DECIMALS + 1):
        power = 10.0**count
        candidate = np.rint(values[left] * power) / power
        same = candidate.astype(np.float32) == single[left]
        rounded[left[same]] = candidate[same]
        decimals[left[same]] = count
        left = left[~same]
        if not len(left):
            break
    if len(values) and (decimals == decimals[0]).all() and decimals[0] > 0:
        return (f"%.{decimals[0]}f " * len(values) % tuple(rounded.tolist())).split()
    forms = [f"%.{count}f" for count in range(_MOST_DECIMALS + 1)]
    return [
        forms[count] % value if count > 0 else str(np.float32(value))
        for value, count in zip(rounded.tolist(), decimals.tolist(), strict=True)
    ]


def _corners(vertices: Int32, uvs: Int32 | None, normals: Int32 | None) -> list[str]:
    """Each corner as `v`, `v/vt`, `v//vn` or `v/vt/vn`."""
    texts = _indices(vertices, "")
    if uvs is not None:
        texts = list(map("".join, zip(texts, _indices(uvs, "/"), strict=True)))
    if normals is None:
        return texts
    before = "/" if uvs is None else ""
    ends = _indices(normals, before + "/")
    if uvs is not None and bool((uvs < 0).any()):
        ends = ["/" + end if end and uv < 0 else end for end, uv in zip(ends, uvs.tolist(), strict=True)]
    return list(map("".join, zip(texts, ends, strict=True)))


def _indices(index: Int32, prefix: str) -> list[str]:
    """Indices from 1 after `prefix`; nothing for -1."""
    known = [prefix + str(i) for i in range(1, int(index.max(initial=-1)) + 2)]
    known.append("")
    return [known[i] for i in index.tolist()]


def _faces(mesh: Mesh, corners: list[str]) -> Iterator[bytes]:
    """The polygons, with a line wherever object, group or material change."""
    starts = mesh.polygon_starts.tolist()
    lines = [f"f {' '.join(corners[start:end])}\n" for start, end in pairwise(starts)]
    labels = (("o", mesh.objects), ("g", mesh.groups), ("usemtl", mesh.materials_used))
    for word, label in labels:
        if label is not None:
            _put_before(lines, word, label)
    yield "".join(lines).encode()


def _put_before(lines: list[str], word: str, label: Labels) -> None:
    """Put a line before each polygon where the label changes; the word alone says that there is none."""
    before = np.concatenate([np.full(1, -1, np.int32), label.index[:-1]])
    for p in np.flatnonzero(label.index != before).tolist():
        number = int(label.index[p])
        name = f" {written_name(label.names[number])}" if number >= 0 else ""
        lines[p] = f"{word}{name}\n{lines[p]}"
