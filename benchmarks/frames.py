"""Slider to pixels, off-screen at 1280x800: facemorph, a bare static draw of the same mesh, and peers."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.bare import BareDraw
from benchmarks.harness import Table, have, interleaved_ms, process
from benchmarks.make_faces import Head, head, shape, shape_names
from facemorph.core.camera import Camera
from facemorph.core.mesh import Mesh
from facemorph.core.normals import NormalsOf
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.gl import Renderer, create_context

SIZE = (1280, 800)
BARE, SLIDER, CAMERA = "bare static draw", "facemorph, slider moves", "facemorph, camera moves"
NORMALS = "normals"
CASES = ((7, 27_000), (52, 27_000), (52, 100_000))


def run() -> list[Table]:
    """A table for each case: so many active shapes on so many vertices."""
    return [_case(shapes, vertices) for shapes, vertices in CASES]


def made_mesh(face: Head) -> Mesh:
    """The neutral of a head: its quads, then its caps."""
    blocks = (face.quads, face.caps)
    sizes = np.concatenate([np.full(len(block), block.shape[1]) for block in blocks])
    return Mesh(
        face.positions.astype(np.float32),
        np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32),
        np.concatenate([block.ravel() for block in blocks]).astype(np.int32),
        uvs=face.uvs.astype(np.float32),
        corner_uvs=np.concatenate([face.uv_quads.ravel(), face.uv_caps.ravel()]).astype(np.int32),
    )


def made_rig(shapes: int, vertices: int) -> Rig:
    """A head with shapes of local support."""
    face = head(vertices)
    positions = face.positions
    made = {name: shape(positions, k).astype(np.float32) for k, name in enumerate(shape_names(shapes))}
    return Rig.from_arrays(made_mesh(face), made)


def _case(shapes: int, vertices: int) -> Table:
    rig = made_rig(shapes, vertices)
    normals = NormalsOf(rig.triangles, rig.neutral.vertex_count)
    # In turn with the frames, since drawing leaves neither with a warm cache.
    works = _own_works(rig) | {NORMALS: lambda: normals(rig.neutral.positions)}
    times: dict[str, float | None] = dict(interleaved_ms(works, times=15))
    times["the same without the exact normals"] = times[SLIDER] - times.pop(NORMALS)
    times |= {peer: _peer(peer, rig) for peer in ("pyvista", "polyscope")}
    title = f"Slider to pixels, 1280x800, {shapes} shapes active, {rig.neutral.vertex_count:,} vertices"
    table = Table(title, ("who", "median ms", "times the bare draw", "times camera only"))
    for name, ms in times.items():
        ratios = ["" if ms is None else f"{ms / times[other]:.2f}" for other in (BARE, CAMERA)]
        table.add(name, "not installed" if ms is None else f"{ms:.1f}", *ratios)
    return table


def _own_works(rig: Rig) -> dict[str, Callable[[], object]]:
    context = create_context()
    renderer = Renderer(context)
    renderer.load(rig)
    camera = Camera.framing(rig.neutral.bounds, "front", SIZE[0] / SIZE[1])
    bare = BareDraw(context, rig, camera, SIZE)
    step = iter(range(10**9))
    target = {name: 1.0 / len(rig.names) ** 0.5 for name in rig.names}

    def slider() -> object:
        pose = Pose(target=target, t=(next(step) % 20) / 20)
        renderer.draw(pose, camera, Look(), SIZE, quality="fast")
        return renderer.read()

    still = Renderer(context)
    still.load(rig)

    def camera_only() -> object:
        turned = camera.orbited((next(step) % 20) / 10, 0.0)
        still.draw(Pose(target=target, t=0.5), turned, Look(), SIZE, quality="fast")
        return still.read()

    return {
        BARE: bare.frame,
        SLIDER: slider,
        CAMERA: camera_only,
    }


def _peer(name: str, rig: Rig) -> float | None:
    if not have(name):
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "face.npz"
        np.savez(path, neutral=rig.neutral.positions, triangles=rig.triangles, deltas=rig.deltas)
        done = process([sys.executable, "-m", "benchmarks.peers", name, str(path)])
    if done.status:
        raise SystemExit(f"the peer {name} failed:\n{done.output}")
    return float(done.output.split()[-1])
