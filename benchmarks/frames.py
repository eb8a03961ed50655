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
    works = _own_works(rig)
    times = interleaved_ms(works, times=15)
    normals = NormalsOf(rig.triangles, rig.neutral.vertex_count)
    cost = interleaved_ms({"normals": lambda: normals(rig.neutral.positions)})["normals"]
    limit = times["bare static draw"]
    title = f"Slider to pixels, 1280x800, {shapes} shapes active, {rig.neutral.vertex_count:,} vertices"
    table = Table(title, ("who", "median ms", "times the bare draw"))
    for name, ms in times.items():
        table.add(name, f"{ms:.1f}", f"{ms / limit:.2f}")
    slider = times["facemorph, slider moves"]
    table.add("the same without the exact normals", f"{slider - cost:.1f}", f"{(slider - cost) / limit:.2f}")
    for peer in ("pyvista", "polyscope"):
        ms = _peer(peer, rig)
        table.add(
            peer, "not installed" if ms is None else f"{ms:.1f}", "" if ms is None else f"{ms / limit:.2f}"
        )
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
        "bare static draw": bare.frame,
        "facemorph, slider moves": slider,
        "facemorph, camera moves": camera_only,
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
