"""How much of the sky each vertex of the skin sees, by casting rays."""

import numpy as np
import trimesh

from .subdivide import vertex_normals

RAYS = 96
REACH = 0.9
LIFT = 0.006


def sky_directions(count: int) -> np.ndarray:
    """Evenly spread unit vectors (count, 3) over the upper half-sphere."""
    k = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - k / count), np.pi * (1 + 5**0.5) * k
    return np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], -1)


def _frames(normals: np.ndarray):
    """Two unit tangents for every normal."""
    helper = np.where(np.abs(normals[:, :1]) > 0.8, [[0, 1.0, 0]], [[1.0, 0, 0]])
    tangent = np.cross(normals, helper)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    return tangent, np.cross(normals, tangent)


def visible_sky(points, triangles, blockers, averaging) -> np.ndarray:
    """Brightness (n,) 0..1 of each skin vertex.

    blockers: (points, triangles) pairs that cast shade too; averaging: sparse (n, n) neighbour mean.
    """
    normals = vertex_normals(points, triangles)
    tangent, bitangent = _frames(normals)
    scene = _scene([(points, triangles), *blockers])
    origins, directions = points + normals * LIFT, sky_directions(RAYS)
    shade = np.zeros(len(points))
    for direction in directions:
        rays = tangent * direction[0] + bitangent * direction[1] + normals * direction[2]
        places, which, _ = scene.ray.intersects_location(origins, rays, multiple_hits=False)
        distance = np.full(len(points), np.inf)
        distance[which] = np.linalg.norm(places - origins[which], axis=1)
        shade += direction[2] * np.clip(1 - distance / REACH, 0, 1) ** 0.7
    light = 1 - shade / directions[:, 2].sum()
    return 0.5 * light + 0.5 * (averaging @ light)


def _scene(meshes) -> trimesh.Trimesh:
    points, triangles, offset = [], [], 0
    for mesh_points, mesh_triangles in meshes:
        points.append(mesh_points)
        triangles.append(mesh_triangles + offset)
        offset += len(mesh_points)
    return trimesh.Trimesh(np.concatenate(points), np.concatenate(triangles), process=False)
