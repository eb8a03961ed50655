"""Every shading on every morph path: what must be seen is seen, and both paths show the same."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from facemorph.core.camera import Camera
from facemorph.core.picture import SHADINGS, Look, Shading
from facemorph.core.rig import Rig
from facemorph.gl import Offscreen
from tests.gl.heads import head_rig

SIZE = (200, 200)
POSE = {"smile": 1.0, "jaw": 0.5}


@pytest.mark.parametrize("shading", SHADINGS)
def test_both_morph_paths_show_the_same(ctx: moderngl.Context, head: Rig, shading: Shading) -> None:
    pictures = []
    for path in ("cpu", "shader"):
        with Offscreen(ctx=ctx, morph=path) as screen:
            pictures.append(screen.render(head, POSE, size=SIZE, look=Look(shading=shading)).astype(int))
    different = np.abs(pictures[0] - pictures[1]).max(axis=2)
    assert np.mean(different > 6) < 0.002


@pytest.mark.parametrize("shading", SHADINGS)
def test_every_shading_draws_the_morphed_face(screen: Offscreen, head: Rig, shading: Shading) -> None:
    look = Look(shading=shading, background=(0.0, 0.0, 0.0, 0.0))
    still = screen.render(head, {}, size=SIZE, look=look, legend=False).astype(int)
    moved = screen.render(head, POSE, size=SIZE, look=look, legend=False).astype(int)
    assert np.mean(np.abs(still - moved).max(axis=2) > 8) > 0.01


def test_light_by_vertex_on_fine_meshes_looks_as_light_by_pixel(
    screen: Offscreen, head: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    fine = head_rig(rows=110, columns=140)
    pictures = []
    for limit in (1, 10**9):
        monkeypatch.setattr("facemorph.gl.painter.FINE_MESH", limit)
        pictures.append(screen.render(fine, POSE, size=SIZE).astype(int))
    different = np.abs(pictures[0] - pictures[1]).max(axis=2)
    assert different.mean() < 0.5
    assert np.mean(different > 12) < 0.002


def test_normals_are_shown_as_axes(screen: Offscreen, head: Rig) -> None:
    pixels = screen.render(head, {}, size=SIZE, look=Look(shading="normals"))
    hit = screen.renderer.pick(100.5, 60.5)
    assert hit is not None
    wanted = (head.normals({})[hit.vertex] * 0.5 + 0.5) * 255.0
    assert np.abs(pixels[60, 100, :3] - wanted).max() < 12


def test_heat_is_the_ramps_ends_at_no_and_at_full_displacement(screen: Offscreen, head: Rig) -> None:
    camera = Camera.framing(head.neutral.bounds)
    pixels = screen.render(
        head, {"smile": 1.0}, size=SIZE, camera=camera, look=Look(shading="heat"), legend=False
    )
    legend = screen.renderer.legend
    assert legend is not None
    cool, hot = legend.colours[0].astype(int), legend.colours[-1].astype(int)
    forehead = pixels[40, 100, :3].astype(int)
    assert np.argmax(forehead) == np.argmax(cool)
    corner = screen.render(
        head, {"smile": 1.0}, size=SIZE, camera=camera, look=Look(shading="heat", heat_max=0.3), legend=False
    )
    reddest = (corner[..., 0].astype(int) - corner[..., 2]).max()
    assert reddest > 0.6 * (hot[0] - hot[2])


def test_wires_are_the_polygons_edges_not_the_triangles(screen: Offscreen, head: Rig) -> None:
    """As triangles the same surface shows about half as many lines again."""
    from facemorph.core.mesh import Mesh

    triangles = Rig(Mesh.from_triangles(head.neutral.positions, head.triangles), head.shapes, head.deltas)
    camera = Camera.framing(head.neutral.bounds).zoomed(2.5)

    def lines(rig: Rig) -> float:
        bare = screen.render(rig, {}, size=(400, 400), camera=camera, look=Look(shading="clay"))
        wired = screen.render(rig, {}, size=(400, 400), camera=camera, look=Look(shading="clay", wire=True))
        return float((bare.astype(int) - wired).clip(0).mean())

    assert 1.2 < lines(triangles) / lines(head) < 2.2


def test_wires_can_lie_over_any_shading(screen: Offscreen, head: Rig) -> None:
    for shading in ("skin", "normals", "heat"):
        bare = screen.render(head, POSE, size=SIZE, look=Look(shading=shading))
        wired = screen.render(head, POSE, size=SIZE, look=Look(shading=shading, wire=True))
        assert np.mean(np.any(bare != wired, axis=2)) > 0.1


def test_hidden_wires_stay_hidden(screen: Offscreen, head: Rig) -> None:
    """The lines seen are those of the near side: a head whose far side is denser shows no more of them."""
    look = Look(shading="wire")
    front = screen.render(head, {}, size=SIZE, look=look).astype(int)
    positions = head.neutral.positions.copy()
    behind = positions[:, 2] < -3.0
    positions[behind, 0] += np.sin(positions[behind, 1] * 9.0).astype(np.float32) * 0.2
    dented = Rig(head.neutral.with_positions(positions), head.shapes, head.deltas, head.info)
    other = screen.render(
        dented, {}, size=SIZE, camera=Camera.framing(head.neutral.bounds), look=look
    ).astype(int)
    middle = np.s_[40:150, 80:120]
    assert np.abs(front[middle] - other[middle]).max() < 8
