"""OBJ texts made by tests, and what they must give."""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from facemorph.core.mesh import Mesh

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


def written(folder: Path, text: str | bytes, name: str = "mesh.obj") -> Path:
    """A file with this content."""
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


@dataclass
class Truth:
    """What a text was made to say, kept beside it while it is written."""

    positions: list[list[float]] = field(default_factory=list)
    uvs: list[list[float]] = field(default_factory=list)
    normals: list[list[float]] = field(default_factory=list)
    faces: list[list[tuple[int, int, int]]] = field(default_factory=list)
    groups: list[str] = field(default_factory=list)


def number_text(rng: random.Random) -> str:
    """A decimal as some program may write it."""
    value = rng.choice([rng.uniform(-20, 20), rng.gauss(0, 1e-3), rng.uniform(-1e6, 1e6), 0.0, 1.0])
    form = rng.choice(
        ["%.6f", "%.6f", "%.4f", "%.9f", "%.17g", "%g", "%.3e", "%d", "%+.2f", "%.0f.", "%.12f"]
    )
    text = form % value
    return (
        text.replace("0.", ".", 1)
        if rng.random() < 0.05 and text.startswith("0.") and len(text) > 2
        else text
    )


def odd_obj(seed: int, elements: int = 60) -> tuple[str, Truth]:
    """A valid OBJ in an unusual hand: mixed forms, comments, continued lines, indices that count back."""
    rng = random.Random(seed)
    plain = rng.random() < 0.3
    lines: list[str] = []
    truth = Truth()
    for _ in range(3):
        _add_vector(rng, lines, truth, "v", plain)
    group = ""
    for _ in range(elements):
        kind = rng.choice(["v", "v", "vt", "vn", "f", "f", "f", "g", "other"])
        if kind in ("v", "vt", "vn"):
            _add_vector(rng, lines, truth, kind, plain)
        elif kind == "f":
            _add_face(rng, lines, truth, plain)
            truth.groups.append(group)
        elif kind == "g":
            group = rng.choice(["skin", "eye L", "#1", "Ä_脸", ""])
            lines.append(f"g {group}")
        else:
            lines.append(
                rng.choice(["", "   ", "# f 1 2 3", "s off", "#C:\\faces\\", "\t", "vp 1 2", "l 1 2", "p 1"])
            )
    if not truth.faces:
        _add_face(rng, lines, truth, plain)
        truth.groups.append(group)
    end = "\n" if plain else rng.choice(["\n", "\r\n", "\r"])
    text = end.join(lines) + (end if rng.random() < 0.8 else "")
    return ("\ufeff" + text if rng.random() < 0.1 else text), truth


def _add_vector(rng: random.Random, lines: list[str], truth: Truth, kind: str, plain: bool) -> None:
    width = {"v": 3, "vt": 2, "vn": 3}[kind]
    texts = [f"{rng.uniform(-9, 9):.6f}" if plain else number_text(rng) for _ in range(width)]
    {"v": truth.positions, "vt": truth.uvs, "vn": truth.normals}[kind].append([float(t) for t in texts])
    lines.append(_line(rng, [kind, *texts], plain))


def _add_face(rng: random.Random, lines: list[str], truth: Truth, plain: bool) -> None:
    uv, normal = (bool(some) and rng.random() < 0.5 for some in (truth.uvs, truth.normals))
    face, words = [], ["f"]
    for _ in range(rng.randint(3, 6)):
        corner, parts = [], []
        for wanted, have in ((True, truth.positions), (uv, truth.uvs), (normal, truth.normals)):
            index = rng.randrange(len(have)) if wanted else -1
            corner.append(index)
            back = not plain and rng.random() < 0.2
            parts.append("" if index < 0 else str(index - len(have) if back else index + 1))
        face.append((corner[0], corner[1], corner[2]))
        word = "/".join(parts)
        words.append(word if rng.random() < 0.1 else word.rstrip("/"))
    truth.faces.append(face)
    lines.append(_line(rng, words, plain))


def _line(rng: random.Random, words: list[str], plain: bool) -> str:
    if plain:
        return " ".join(words)
    gaps = [" ", " ", " ", "  ", "\t", " \\\n "]
    text = words[0] + "".join(rng.choice(gaps) + word for word in words[1:])
    return rng.choice(["", "", " ", "\t"]) + text + rng.choice(["", "", "", " ", " # note", "\t\t"])


def assert_says(mesh: Mesh, truth: Truth) -> None:
    """The mesh is exactly what the text was made to say."""
    assert mesh.positions.tolist() == np.array(truth.positions, np.float64).astype(np.float32).tolist()
    assert mesh.uvs.tolist() == np.array(truth.uvs, np.float64).astype(np.float32).reshape(-1, 2).tolist()
    assert (
        mesh.normals.tolist()
        == np.array(truth.normals, np.float64).astype(np.float32).reshape(-1, 3).tolist()
    )
    corners = [corner for face in truth.faces for corner in face]
    assert np.diff(mesh.polygon_starts).tolist() == [len(face) for face in truth.faces]
    for part, index in enumerate((mesh.corner_vertices, mesh.corner_uvs, mesh.corner_normals)):
        wanted = [corner[part] for corner in corners]
        assert (index.tolist() if index is not None else [-1] * len(corners)) == wanted
    labels = mesh.groups
    names = [
        "" if labels is None or i < 0 else labels.names[i]
        for i in (labels.index if labels else [-1] * len(truth.faces))
    ]
    assert names == truth.groups


def assert_same_mesh(a: Mesh, b: Mesh) -> None:
    """Two meshes are the same in every array and label, bit for bit."""
    for name in (
        "positions",
        "polygon_starts",
        "corner_vertices",
        "uvs",
        "corner_uvs",
        "normals",
        "corner_normals",
        "colours",
    ):
        mine, theirs = getattr(a, name), getattr(b, name)
        assert (mine is None) == (theirs is None), name
        if mine is not None:
            assert mine.dtype == theirs.dtype, name
            assert mine.tobytes() == theirs.tobytes(), name
    for name in ("groups", "objects", "materials_used"):
        mine, theirs = getattr(a, name), getattr(b, name)
        assert (mine is None) == (theirs is None), name
        if mine is not None:
            assert mine.names == theirs.names, name
            assert mine.index.tolist() == theirs.index.tolist(), name
