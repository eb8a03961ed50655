"""PLY, STL, OFF and static glTF (.gltf, .glb) through trimesh, its processing off, so the order is kept.

What these give: positions and triangles (polygons are cut into triangles), a PLY's colours and its uvs
where they belong to vertices, and the parts of a glTF scene put in their places, one after the other; its
materials, morph targets, skins and animation are left out, and `Mesh.notes` tells of targets and skins.
An STL has three vertices of its own for each triangle, so two of them correspond only when written from
the same mesh by the same program.

The files that a .gltf names must lie in its folder or below it, links followed first.
"""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.mesh import Mesh
from facemorph.errors import MeshDataError, MeshFileError
from facemorph.io.inside import inside
from facemorph.io.limits import read_bytes, shortened

_VERTICES = 64_000_000
_NODES = 100_000
_NAMES = {".ply": "PLY", ".stl": "STL", ".off": "OFF", ".gltf": "glTF", ".glb": "binary glTF"}


def read_foreign(path: Path) -> Mesh:
    """The mesh of a file that trimesh reads. Raises `MeshFileError`."""
    data = read_bytes(path)
    suffix = path.suffix.lower()
    notes: tuple[str, ...] = ()
    if suffix in (".gltf", ".glb"):
        scene = _scene_json(path, data)
        _check_scene(path, scene)
        notes = tuple(f"{path}: {note}" for note in _left_out(scene))
    loaded = _loaded(path, suffix, data)
    vertices, triangles = getattr(loaded, "vertices", None), getattr(loaded, "faces", None)
    if vertices is None or triangles is None or not len(vertices) or not len(triangles):
        raise MeshFileError(path, "has no surface: no vertices, or no faces")
    with np.errstate(over="ignore"):
        positions = np.ascontiguousarray(vertices, np.float32)
    if not np.isfinite(positions).all():
        first = int(np.argmin(np.isfinite(positions).all(axis=1)))
        raise MeshFileError(path, f"vertex {first + 1:,} is not finite")
    corners = np.ascontiguousarray(triangles, np.int64).ravel()
    if int(corners.min()) < 0 or int(corners.max()) >= len(positions):
        raise MeshFileError(path, f"a face names vertex {int(corners.max()) + 1:,} of {len(positions):,}")
    try:
        return replace(_mesh(positions, corners, loaded), notes=notes)
    except MeshDataError as error:
        raise MeshFileError(path, str(error)) from error


def named_files(path: Path) -> tuple[Path, ...]:
    """The files in its folder that a .gltf names: buffers and pictures. Raises `MeshFileError`."""
    if path.suffix.lower() not in (".gltf", ".glb"):
        return ()
    scene = _scene_json(path, read_bytes(path))
    lists = [scene.get(kind) for kind in ("buffers", "images")]
    parts = [part for some in lists if isinstance(some, list) for part in some if isinstance(part, dict)]
    found = (inside(path.parent, unquote(str(part["uri"]))) for part in parts if "uri" in part)
    return tuple(file for file in dict.fromkeys(found) if file is not None)


def _mesh(positions: Float32, corners: Any, loaded: Any) -> Mesh:
    vertices = corners.astype(np.int32)
    starts = np.arange(0, len(vertices) + 1, 3, dtype=np.int32)
    uvs = _of_vertices(getattr(loaded.visual, "uv", None), len(positions), 2)
    colours = None
    if getattr(loaded.visual, "kind", None) == "vertex":
        colours = _of_vertices(loaded.visual.vertex_colors, len(positions), 3)
    if uvs is None:
        return Mesh(
            positions, starts, vertices, colours=None if colours is None else colours / np.float32(255)
        )
    return Mesh(positions, starts, vertices, uvs=uvs, corner_uvs=vertices)


def _of_vertices(values: Any, count: int, width: int) -> Float32 | None:
    """The first `width` columns of finite values (V, n), or None where they are not of that form."""
    if values is None:
        return None
    table = np.asarray(values)
    if table.ndim != 2 or len(table) != count or table.shape[1] < width or table.dtype.kind not in "fiu":
        return None
    chosen = np.ascontiguousarray(table[:, :width], np.float32)
    return chosen if bool(np.isfinite(chosen).all()) else None


def _loaded(path: Path, suffix: str, data: bytes) -> Any:
    import trimesh

    try:
        with np.errstate(all="ignore"):
            return trimesh.load(
                io.BytesIO(data),
                file_type=suffix[1:],
                resolver=_resolver(path.parent),
                force="mesh",
                process=False,
                fix_texture=False,
                skip_materials=True,
            )
    except Exception as error:
        detail = shortened(" ".join(str(error).split()), 80) or type(error).__name__
        raise MeshFileError(path, f"cannot be read as {_NAMES[suffix]}: {detail}") from error


def _resolver(folder: Path) -> Any:
    """What finds the files that a mesh file names, in its folder alone."""
    from trimesh.resolvers import Resolver

    class InFolder(Resolver):
        def __init__(self) -> None:
            """Nothing to keep: the folder is known."""

        def get(self, key: str) -> bytes:
            found = inside(folder, unquote(str(key)))
            if found is None:
                raise ValueError(f"{shortened(str(key))!r} is not in the mesh's folder")
            return read_bytes(found)

        def write(self, name: str, data: Any) -> None:
            raise NotImplementedError

        def namespaced(self, namespace: str) -> Any:
            raise NotImplementedError

        def keys(self) -> list[str]:
            return []

    return InFolder()


def _scene_json(path: Path, data: bytes) -> Any:
    """The JSON of a glTF, as text or as the first chunk of its binary form."""
    if data[:4] == b"glTF":
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    try:
        return json.loads(data)
    except (ValueError, RecursionError) as error:
        raise MeshFileError(path, f"is not glTF: {shortened(str(error), 80)}") from error


def _check_scene(path: Path, scene: Any) -> None:
    """Raises `MeshFileError` for a scene that claims far more than it holds, or whose nodes go in rings."""
    try:
        accessors = scene.get("accessors", [])
        if any("bufferView" not in accessor for accessor in accessors):
            raise MeshFileError(path, "has data without a buffer (sparse, or compressed), which is not read")
        nodes = scene.get("nodes", [])
        children = [child for node in nodes for child in node.get("children", [])]
        if len(nodes) > _NODES or len(set(children)) != len(children) or _has_ring(nodes):
            raise MeshFileError(path, f"its nodes are no tree, or more than {_NODES:,}")
        sizes = [
            sum(accessors[part["attributes"]["POSITION"]]["count"] for part in mesh["primitives"])
            for mesh in scene.get("meshes", [])
        ]
        total = sum(sizes[node["mesh"]] for node in nodes if "mesh" in node)
    except (TypeError, KeyError, IndexError, AttributeError) as error:
        raise MeshFileError(path, f"is not glTF: {shortened(str(error), 80)}") from error
    if total > _VERTICES:
        raise MeshFileError(path, f"holds {total:,} vertices; at most {_VERTICES:,} are read")


def _left_out(scene: Any) -> Iterator[str]:
    """A sentence for what of a checked scene moves its meshes, and is not read."""
    parts = [part for mesh in scene.get("meshes", []) for part in mesh["primitives"]]
    targets = [part["targets"] for part in parts if isinstance(part.get("targets"), list)]
    count = max(map(len, targets), default=0)
    if count:
        yield (
            f"{count:,} morph target{'s are' if count > 1 else ' is'} not read; export the shapes as meshes "
            "of their own, of the same vertices."
        )
    if scene.get("skins"):
        yield "its skin (bones) is not applied; export the mesh as it is to stand."


def _has_ring(nodes: list[dict[str, Any]]) -> bool:
    """Whether some nodes are reached from no root, which only happens in a ring."""
    children = {child for node in nodes for child in node.get("children", [])}
    waiting = [i for i in range(len(nodes)) if i not in children]
    reached = 0
    while waiting:
        node = waiting.pop()
        reached += 1
        waiting.extend(nodes[node].get("children", []))
    return reached != len(nodes)
