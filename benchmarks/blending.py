"""The weighted sum and the normals on the CPU, beside scipy's sparse products."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from benchmarks.frames import made_rig
from benchmarks.harness import Table, interleaved_ms
from facemorph.core.blend import Blend
from facemorph.core.mesh import Mesh
from facemorph.core.normals import NormalsOf
from facemorph.core.triangles import triangulated


def run() -> list[Table]:
    """One table, on 27,000 vertices and 52 shapes."""
    rig = made_rig(52, 27_000)
    return [_blending(rig.neutral, rig.deltas), _normals(rig.neutral)]


def _blending(mesh: Mesh, deltas: np.ndarray) -> Table:
    flat = deltas.reshape(len(deltas), -1)
    matrix = sparse.csr_matrix(flat.T)
    one = sparse.csr_matrix(flat[:1].T)
    blend, dragged = Blend(mesh.positions, deltas), Blend(mesh.positions, deltas)
    rng = np.random.default_rng(0)
    base = rng.random(52)

    def all_change() -> object:
        return blend(rng.random(52))

    def one_changes() -> object:
        base[7] = rng.random()
        return dragged(base)

    times = interleaved_ms(
        {
            "all 52 change: facemorph": all_change,
            "all 52 change: scipy CSR": lambda: mesh.positions.ravel() + matrix @ rng.random(52).astype("f4"),
            "all 52 change: numpy matmul": lambda: rng.random(52).astype("f4") @ flat,
            "one of 52 changes: facemorph": one_changes,
            "one of 52 changes: scipy CSR": lambda: one @ rng.random(1).astype("f4"),
        },
        times=41,
    )
    table = Table("Blending 52 shapes of 27,000 vertices on the CPU", ("work", "median ms"))
    for name, ms in times.items():
        table.add(name, f"{ms:.2f}")
    return table


def _normals(mesh: Mesh) -> Table:
    triangles = triangulated(mesh).vertices
    normals = NormalsOf(triangles, mesh.vertex_count)
    count = len(triangles)
    rows, columns = triangles.ravel(), np.repeat(np.arange(count), 3)
    incidence = sparse.csr_matrix((np.ones(3 * count, np.float32), (rows, columns)))

    def by_scipy() -> object:
        a, b, c = (mesh.positions[triangles[:, i]] for i in range(3))
        sums = incidence @ np.cross(b - a, c - a)
        return sums / np.linalg.norm(sums, axis=1, keepdims=True)

    times = interleaved_ms({"facemorph": lambda: normals(mesh.positions), "scipy sparse": by_scipy}, times=21)
    table = Table(f"Area-weighted normals, 27,000 vertices, {count:,} triangles", ("by", "median ms"))
    for name, ms in times.items():
        table.add(name, f"{ms:.2f}")
    return table
