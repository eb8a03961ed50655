"""Reading OBJs: one file, a set of eight, the same set again; beside trimesh and tinyobjloader."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from benchmarks.harness import Table, have, interleaved_ms, median_ms
from benchmarks.make_faces import write_set
from facemorph.io import load_rig, read_mesh


def run() -> list[Table]:
    """Two tables, on 27,000 vertices of quads with texture seams."""
    with tempfile.TemporaryDirectory() as name:
        os.environ["FACEMORPH_CACHE_DIR"] = str(Path(name) / "cache")
        folder = Path(name) / "face"
        paths = write_set(folder, 27_000, 7)
        return [_one_file(paths[1]), _whole_set(folder, paths)]


def _one_file(path: Path) -> Table:
    works = {"facemorph": lambda: read_mesh(path), "trimesh (order kept)": lambda: _trimesh(path)}
    if have("tinyobjloader"):
        works["tinyobjloader (numpy 2: by lists)"] = lambda: _tinyobj(path)
    works["bare read of the bytes"] = path.read_bytes
    times = interleaved_ms(works, times=9)
    table = Table("One OBJ, 27,000 vertices", ("reader", "median ms", "trimesh's time / this"))
    for reader, ms in times.items():
        table.add(reader, f"{ms:.1f}", f"{times['trimesh (order kept)'] / ms:.1f}x")
    return table


def _whole_set(folder: Path, paths: list[Path]) -> Table:
    slow = median_ms(lambda: [_trimesh(path) for path in paths], times=3, warm=1)
    fresh = median_ms(lambda: load_rig(folder, cache=False), times=9)
    cached = median_ms(lambda: load_rig(folder), times=15)
    bare = median_ms(lambda: [path.read_bytes() for path in paths], times=9)
    table = Table("Neutral + 7 OBJs into a rig", ("reader", "median ms", "trimesh's time / this"))
    rows = {
        "facemorph": fresh,
        "facemorph, again (cache keyed by content)": cached,
        "trimesh, one by one": slow,
        "bare read of the bytes": bare,
    }
    for reader, ms in rows.items():
        table.add(reader, f"{ms:.1f}", f"{slow / ms:.1f}x")
    return table


def _trimesh(path: Path) -> object:
    import trimesh

    return trimesh.load(path, process=False, maintain_order=True, skip_materials=True)


def _tinyobj(path: Path) -> object:
    import tinyobjloader

    config = tinyobjloader.ObjReaderConfig()
    config.triangulate = False
    reader = tinyobjloader.ObjReader()
    reader.ParseFromFile(str(path), config)
    attributes = reader.GetAttrib()
    corners = [[(i.vertex_index, i.texcoord_index) for i in s.mesh.indices] for s in reader.GetShapes()]
    return attributes.vertices, attributes.texcoords, corners
