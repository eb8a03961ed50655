"""A mesh with some of its polygons."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from facemorph.core.mesh import Labels, Mesh
from facemorph.core.polygons import with_polygons


def test_vertices_stay_and_corners_labels_and_uvs_go_along() -> None:
    points = np.arange(21, dtype=np.float32).reshape(7, 3)
    corners = np.array([0, 1, 2, 2, 1, 3, 4, 4, 5, 6], np.int32)
    mesh = Mesh(
        points,
        np.array([0, 3, 7, 10], np.int32),
        corners,
        uvs=np.zeros((10, 2), np.float32),
        corner_uvs=np.arange(10, dtype=np.int32),
        materials_used=Labels(("skin", "hair"), np.array([0, 1, -1], np.int32)),
    )
    some = with_polygons(mesh, np.array([True, False, True]))
    assert some.positions is mesh.positions
    assert some.polygon_starts.tolist() == [0, 3, 6]
    assert some.corner_vertices.tolist() == [0, 1, 2, 4, 5, 6]
    assert some.corner_uvs.tolist() == [0, 1, 2, 7, 8, 9]
    assert some.materials_used.index.tolist() == [0, -1]
    assert some.corner_normals is None
    assert with_polygons(mesh, np.ones(3, bool)).corner_vertices.tolist() == corners.tolist()
    none = with_polygons(replace(mesh, corner_uvs=None), np.zeros(3, bool))
    assert (none.polygon_count, none.vertex_count) == (0, 7)
