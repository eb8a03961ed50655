"""Hair as the renderer draws it: cut out by its texture in every shading, shining across its strands."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.picture import Look, Shading
from facemorph.core.rig import FaceInfo, Rig
from facemorph.core.triangles import triangulated
from facemorph.gl import Offscreen
from facemorph.gl.hem import hem_of
from facemorph.gl.materials import finish_of
from tests.gl.heads import head_mesh

FROM_FRONT = Camera((0.0, 0.0, 0.0), 0.0, 0.0, 10.0, 24.0, 2.0)


def strip(folder: Path, name: str, *, curved: bool = False, covers: bool = True) -> Rig:
    """A strip of hair before the camera, v upwards; the picture's left half lets everything through."""
    rows = 25
    y = np.linspace(1.0, -1.0, rows)
    z = np.sqrt(1.1 - y**2) if curved else 0.0 * y
    sides = [np.stack([np.full(rows, x), y, z], -1) for x in (-1.0, 1.0)]
    positions = np.stack(sides, 1).reshape(-1, 3).astype(np.float32)
    uvs = np.stack([np.tile([0.0, 1.0], rows), np.repeat(0.5 + 0.5 * y, 2)], -1).astype(np.float32)
    corners = np.array([[2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1] for k in range(rows - 1)], np.int32)
    pixels = np.full((8, 8, 4), 140, np.uint8)
    pixels[:, :4, 3], pixels[:, 4:, 3] = 0, 255 * covers
    path = folder / f"hair {covers}.png"
    Image.fromarray(pixels).save(path)
    mesh = Mesh(
        positions,
        np.arange(0, corners.size + 1, 4, dtype=np.int32),
        corners.ravel(),
        uvs,
        corners.ravel(),
        materials_used=Labels((name,), np.zeros(len(corners), np.int32)),
        materials={name: Material(name, (0.3, 0.2, 0.1), specular=(0.3,) * 3, opacity=0.995, texture=path)},
    )
    return Rig(mesh, (), np.zeros((0, len(positions), 3), np.float32), FaceInfo("Strip"))


def shown(
    screen: Offscreen, folder: Path, name: str, shading: Shading, camera: Camera = FROM_FRONT
) -> np.ndarray:
    """(60, 60) bool, where a strip of this material changes the picture."""
    look = Look(shading=shading)
    rigs = [strip(folder, name, covers=covers) for covers in (True, False)]
    pictures = [screen.render(rig, {}, size=(60, 60), camera=camera, look=look) for rig in rigs]
    return np.asarray(np.abs(pictures[0].astype(int) - pictures[1]).max(-1) > 8)


@pytest.mark.parametrize("shading", ["skin", "clay", "normals", "heat"])
def test_every_shading_leaves_out_what_the_texture_leaves_out(
    screen: Offscreen, folder: Path, shading: Shading
) -> None:
    seen = shown(screen, folder, "hair", shading)
    assert seen[18:42, 34:40].all()
    assert not seen[18:42, 20:27].any()


def test_locks_have_one_side_and_sheets_two(screen: Offscreen, folder: Path) -> None:
    behind = replace(FROM_FRONT, azimuth_deg=180.0)
    for name, both in (("hair", True), ("hair_lock", False)):
        assert shown(screen, folder, name, "skin").any()
        assert shown(screen, folder, name, "skin", behind).any() == both


def test_hair_shines_in_a_band_across_its_strands(screen: Offscreen, folder: Path) -> None:
    rig = strip(folder, "hair", curved=True)
    dull = replace(rig.neutral.materials["hair"], specular=(0.0, 0.0, 0.0))
    bright = replace(dull, specular=(0.3, 0.3, 0.3))
    pictures = []
    for material in (dull, bright):
        mesh = replace(rig.neutral, materials={"hair": material})
        pictures.append(screen.render(replace(rig, neutral=mesh), {}, size=(60, 60), camera=FROM_FRONT))
    extra = (pictures[1].astype(int) - pictures[0])[:, 34:40, :3].sum(-1)
    assert extra.min() >= 0
    by_row = extra.mean(1)
    lit = np.flatnonzero(by_row > 0.6 * by_row.max())
    assert by_row.max() > 10
    assert len(lit) == lit[-1] - lit[0] + 1 < 25, "one band, and no wider than a part of the strip"
    assert np.ptp(extra[lit], axis=1).max() <= 0.2 * by_row.max() + 3, "alike from strand to strand"


def test_hair_shines_as_its_file_says() -> None:
    straight, coiled = (Material("hair", specular=(shine,) * 3) for shine in (0.3, 0.075))
    assert finish_of(straight).gloss == pytest.approx(4 * finish_of(coiled).gloss)
    assert finish_of(Material("Hair_Lock", specular=(0.3,) * 3)).one_sided
    assert not finish_of(Material("hair_lock", specular=(0.075,) * 3)).one_sided, "coils are seen from behind"
    assert not finish_of(Material("eyelash")).one_sided


def test_hair_that_hangs_low_is_no_hem() -> None:
    mesh = head_mesh()
    low = float(mesh.bounds[0, 1])
    fringe = np.array([[x, low + dy, 9.0] for x in np.linspace(-2, 2, 9) for dy in (0.2, 1.0)], np.float32)
    first = mesh.vertex_count
    corners = np.array([[2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1] for k in range(8)], np.int32) + first
    bust = triangulated(mesh).vertices
    hair = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]).astype(np.int32)
    both = Mesh.from_triangles(np.concatenate([mesh.positions, fringe]), np.concatenate([bust, hair]))
    triangles = triangulated(both).vertices
    apart = np.arange(len(triangles)) >= len(bust)
    alone = hem_of(mesh, bust)
    hem = hem_of(both, triangles, apart)
    assert alone is not None
    assert hem is not None
    np.testing.assert_array_equal(hem.triangles[: len(bust)], alone.triangles)
    assert not hem.triangles[len(bust) :].any(), "hair does not fade with the bust"
