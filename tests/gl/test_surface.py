"""What is drawn of a mesh: parts by material, polygon edges, and the hem of a bust."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np

from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.triangles import triangulated
from facemorph.gl.hem import hem_of
from facemorph.gl.materials import EYE, LASH, SKIN, TEETH, finish_of
from facemorph.gl.surface import Surface, polygon_edge_bits
from tests.gl.heads import head_mesh


def edges_of(mesh: Mesh) -> set[tuple[int, int]]:
    """The edges that would be drawn as wires."""
    triangles = triangulated(mesh)
    bits = polygon_edge_bits(mesh, triangles)
    drawn = set()
    for corners, bit in zip(triangles.vertices.tolist(), bits.tolist(), strict=True):
        for i in range(3):
            if bit & (1 << i):
                a, b = corners[i], corners[(i + 1) % 3]
                drawn.add((min(a, b), max(a, b)))
    return drawn


def test_a_polygons_edges_are_its_outline() -> None:
    hexagon = np.array([[np.cos(a), np.sin(a), 0.0] for a in np.arange(6) * np.pi / 3], np.float32)
    assert edges_of(Mesh.from_polygons(hexagon, np.arange(6, dtype=np.int32)[None])) == {
        (0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (0, 5)
    }  # fmt: skip


def test_a_concave_polygons_edges_are_its_outline_too() -> None:
    dart = np.array([[0, 0, 0], [2, -1, 0], [0.5, 0, 0], [2, 1, 0]], np.float32)
    assert edges_of(Mesh.from_polygons(dart, np.arange(4, dtype=np.int32)[None])) == {
        (0, 1),
        (1, 2),
        (2, 3),
        (0, 3),
    }


def test_every_triangle_is_drawn_once_with_its_material(ctx: moderngl.Context) -> None:
    mesh = head_mesh()
    glass = Material("glass", opacity=0.5)
    index = np.zeros(mesh.polygon_count, np.int32)
    index[::3], index[::7] = 1, -1
    mesh = replace(mesh, materials_used=Labels(("glass", "skin"), index), materials={"glass": glass})
    surface = Surface(ctx, mesh)
    assert sorted(surface.order.tolist()) == list(range(surface.triangle_count))
    covered = 0
    for part in surface.parts:
        triangles = surface.order[part.first : part.first + part.count]
        names = {index[p] for p in surface.triangles.polygon[triangles]}
        assert {("glass", "skin", "")[n] for n in names} == {part.material.name}
        covered += part.count
    assert covered == surface.triangle_count
    opacities = [part.material.opacity for part in surface.parts]
    assert opacities == sorted(opacities, reverse=True), "see-through parts come last"
    surface.release()


def test_a_bust_has_a_hem_at_its_cut() -> None:
    mesh = head_mesh()
    hem = hem_of(mesh, triangulated(mesh).vertices)
    assert hem is not None
    lowest = mesh.positions[:, 1] < mesh.bounds[0, 1] + 1e-4
    assert (hem.kept[lowest] == 0.0).all()
    assert (
        hem.kept[mesh.positions[:, 1] > mesh.bounds[0, 1] + 0.2 * (mesh.bounds[1, 1] - mesh.bounds[0, 1])]
        == 1
    ).all()
    assert 0 < hem.triangles.sum() < len(hem.triangles) / 4


def test_masks_closed_bodies_and_soups_have_none() -> None:
    mesh = head_mesh()
    triangles = triangulated(mesh).vertices
    front = triangles[(mesh.positions[:, 2] > 0.0)[triangles].all(axis=1)]
    assert hem_of(mesh, front) is None, "a mask's rim goes all the way up"
    eyes = triangles[triangles.min(axis=1) > 36 * 48]
    assert hem_of(mesh, eyes) is None, "eyeballs are closed"
    soup = Mesh.from_triangles(
        mesh.positions[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)
    )
    assert hem_of(soup, triangulated(soup).vertices) is None, "every edge of a soup is open"
    flat = mesh.with_positions(mesh.positions * np.array([1, 0, 1], np.float32))
    assert hem_of(flat, triangles) is None


def test_names_choose_how_a_part_answers_light() -> None:
    names = {"skin": SKIN, "Eye_L": EYE, "eyelash": LASH, "teeth_upper": TEETH}
    for name, finish in names.items():
        assert finish_of(Material(name)) is finish
    shiny = finish_of(Material("car paint", specular=(1.0, 1.0, 1.0), shininess=200.0))
    dull = finish_of(Material("felt"))
    assert shiny.gloss > dull.gloss == 0.0
    assert shiny.sharpness == 200.0
