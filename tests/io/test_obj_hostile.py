"""Whatever a file holds, reading it ends in a mesh or in one of the package's errors, in bounded memory."""

from __future__ import annotations

import contextlib
import random
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.triangles import triangulated
from facemorph.errors import MeshFileError
from facemorph.io import limits
from facemorph.io.obj_read import parse_obj, parse_positions
from tests.io.texts import SQUARE, odd_obj

HERE = Path("mesh.obj")
PIECES = [
    b"\0",
    b"\n",
    b"\r",
    b"\\\n",
    b" ",
    b"\t",
    b"\x0b",
    b"\x1c",
    b"/",
    b"//",
    b"-",
    b"+",
    b".",
    b"e",
    b"#",
]
PIECES += [b"0", b"9" * 30, b"1e999", b"nan", b"1/1/1", b"4294967297", b"-2147483649", b"\xff", "é".encode()]
PIECES += [
    b"f ",
    b"v ",
    b"vt ",
    b"vn ",
    b"g ",
    b"usemtl ",
    b"mtllib ../x.mtl\n",
    b"f 1 2 3\n",
    b"f -1 -1 -1\n",
]


def mutated(rng: random.Random, data: bytes) -> bytes:
    """`data` with a few places cut, doubled, swapped or replaced."""
    result = bytearray(data)
    for _ in range(rng.randint(1, 6)):
        at, span = rng.randrange(len(result) + 1), rng.randint(0, 12)
        action = rng.randrange(6)
        if action == 0:
            del result[at : at + span]
        elif action == 1:
            result[at:at] = rng.choice(PIECES)
        elif action == 2:
            result[at : at + span] = rng.choice(PIECES)
        elif action == 3 and at < len(result):
            result[at] = rng.randrange(256)
        elif action == 4:
            result[at:at] = result[rng.randrange(len(result) + 1) :][:span]
        else:
            lines = result.split(b"\n")
            rng.shuffle(lines)
            result = bytearray(b"\n".join(lines))
    return bytes(result)


def check_whole(mesh: Mesh) -> None:
    """What was read is a mesh in all its parts."""
    assert mesh.polygon_count > 0
    assert np.isfinite(mesh.positions).all()
    assert np.isfinite(mesh.uvs).all()
    assert int(mesh.corner_vertices.max()) < mesh.vertex_count
    for index, have in ((mesh.corner_uvs, mesh.uvs), (mesh.corner_normals, mesh.normals)):
        assert index is None or (int(index.min()) >= -1 and int(index.max()) < len(have))
    for labels in (mesh.groups, mesh.objects, mesh.materials_used):
        assert labels is None or (
            len(labels.index) == mesh.polygon_count and int(labels.index.max()) < len(labels.names)
        )


@pytest.mark.parametrize("part", range(20))
def test_mutated_files_raise_nothing_else(part: int) -> None:
    rng = random.Random(part)
    outcomes = set()
    for turn in range(500):
        text, _ = odd_obj(rng.randrange(40), elements=12)
        data = mutated(rng, text.encode())
        error = None
        try:
            check_whole(parse_obj(HERE, data).mesh)
        except MeshFileError as refused:
            error = refused
        outcomes.add("read" if error is None else "refused")
        if error is not None:
            last = data.count(b"\n") + data.count(b"\r") + 1
            assert error.line is None or 1 <= error.line <= last, turn
            assert "\n" not in str(error)
        with contextlib.suppress(MeshFileError):
            parse_positions(HERE, data)
    assert outcomes == {"read", "refused"}


def hostile(kind: str) -> bytes:
    """A megabyte or a few that make a careless reader take far more."""
    size = 1_500_000
    return {
        "corners": SQUARE.encode() + b"f" + b" 1" * 500_000 + b"\n",
        "far index": SQUARE.encode() + b"f 1 2 1000000000\n",
        "long line": SQUARE.encode() + b"#" + b"x" * (4 * size) + b"\n",
        "long number": b"v 0 0 " + b"1" * size + b"\n" + SQUARE.encode(),
        "long blank": b"v 0 0 " + b" " * size + b"0\n" + SQUARE.encode(),
        "short lines": b"v 0 0 0\n" * (size // 8) + b"f 1 2 3\n",
        "empty lines": b"\n" * size + SQUARE.encode(),
        "group each": SQUARE.encode() + b"g a\nf 1 2 3\n" * (size // 12),
        "many names": SQUARE.encode() + b"".join(b"g %d\nf 1 2 3\n" % i for i in range(70_000)),
        "slow numbers": b"v 1e1 1e1 1e1\n" * (size // 14) + b"f 1 2 3\n",
        "slashes": SQUARE.encode() + b"f " + b"/" * (size // 2) + b"\n",
        "backslashes": b"\\ " * (size // 2) + b"\n" + SQUARE.encode(),
        "continued": b"f 1 2 3" + b"\\\n" * (size // 2) + b"\n" + SQUARE.encode(),
    }[kind]


READABLE = ("long blank", "short lines", "empty lines", "group each", "slow numbers", "continued")
REFUSED = ("corners", "far index", "long line", "long number", "many names", "slashes", "backslashes")


@pytest.mark.parametrize("kind", [*READABLE, *REFUSED])
def test_memory_stays_in_proportion_to_the_file(kind: str) -> None:
    data = hostile(kind)
    tracemalloc.start()
    try:
        parse_obj(HERE, data)
        outcome = True
    except MeshFileError:
        outcome = False
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert outcome is (kind in READABLE)
    joined = data.replace(b"\\\n", b"  ")
    longest = min(max(map(len, joined.split(b"\n"))), limits.LINE_BYTES)
    # The padded copy, the arrays of the mesh, and what one chunk, or the longest line, takes meanwhile.
    assert peak < 10 * len(data) + 40 * max(longest, 1 << 19)


def test_a_file_larger_than_any_mesh_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MESH_BYTES", 10)
    path = tmp_path / "mesh.obj"
    path.write_text(SQUARE)
    with pytest.raises(MeshFileError, match="larger than 10 bytes"):
        limits.read_bytes(path, limits.MESH_BYTES)


def test_a_device_is_not_read() -> None:
    device = Path("/dev/zero")
    if not device.exists():
        pytest.skip("this system has no /dev/zero")
    with pytest.raises(MeshFileError, match="no ordinary file"):
        limits.read_bytes(device)


def test_a_polygon_of_many_corners_is_read_and_drawn_in_bounded_time() -> None:
    count = 20_000
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = np.where(np.arange(count) % 2, 1.0, 0.5)
    vertices = "".join(
        f"v {x:.6f} {y:.6f} 0\n" for x, y in zip(np.cos(angle) * radius, np.sin(angle) * radius, strict=True)
    )
    mesh = parse_obj(HERE, f"{vertices}f {' '.join(map(str, range(1, count + 1)))}\n".encode()).mesh
    assert mesh.polygon_starts.tolist() == [0, count]
    assert len(triangulated(mesh).vertices) == count - 2
