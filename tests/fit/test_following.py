"""A template that lies on a scan goes where the scan's own vertices go, and its other parts with it."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.rig import Rig
from facemorph.core.triangles import triangulated
from facemorph.errors import CorrespondenceError, FitError
from facemorph.fit.registration import followed
from facemorph.fit.unseen import with_likely_parts
from tests.fit.faces import joined, octahedron, turned
from tests.fit.people import person
from tests.fit.scans import halved, head_at, hull_of, skin_of, template_head

ROTATION = turned(70.0) @ turned(40.0, 0)


@pytest.fixture(scope="module")
def scan() -> Mesh:
    """A head of triangles between random points."""
    directions = np.random.default_rng(2).normal(size=(4000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return Mesh.from_triangles(head_at(directions, 0.0).astype(np.float32), hull_of(directions))


@pytest.fixture(scope="module")
def head() -> Mesh:
    return template_head()


def smiled(points: np.ndarray) -> np.ndarray:
    """Points (n, 3) of a head after a smooth move of its front."""
    near = np.exp(-((points - (0.2, -0.3, 0.9)) ** 2).sum(axis=1) / 0.15)
    return np.asarray(points + near[:, None] * (0.08, 0.06, -0.03))


def moved(mesh: Mesh, points: np.ndarray) -> Mesh:
    return mesh.with_positions(points.astype(np.float32))


def test_nothing_moves_with_a_scan_that_stays(head, scan):
    np.testing.assert_allclose(followed(head, scan, scan), head.positions, atol=1e-6)


def test_what_lies_on_the_scan_goes_where_its_place_goes(head, scan):
    there = followed(head, scan, moved(scan, smiled(scan.positions)))
    truth = smiled(head.positions)
    assert np.abs(truth - head.positions).max() > 0.07
    # What is left: a scan's flat triangles under a curved template.
    np.testing.assert_allclose(there, truth, atol=0.004)


@pytest.mark.parametrize("off", [0.0, 0.01])
def test_a_scan_turned_and_carried_away_takes_the_template_along_as_it_is(head, scan, off):
    """So does what stands off the scan a little, as a template over its noise does."""
    out = vertex_normals(head.positions, triangulated(head).vertices)
    above = moved(head, head.positions + off * out)
    there = followed(above, scan, moved(scan, scan.positions @ ROTATION.T + (5.0, -3.0, 1.0)))
    np.testing.assert_allclose(there, above.positions @ ROTATION.T + (5.0, -3.0, 1.0), atol=1e-4)


def test_a_scan_in_another_unit_takes_the_template_to_that_size(head, scan):
    there = followed(head, scan, moved(scan, scan.positions * 10.0))
    np.testing.assert_allclose(there, head.positions * 10.0, atol=0.2)


def test_what_lies_over_a_hole_of_the_scan_rides_along(head, scan):
    triangles = scan.corner_vertices.reshape(-1, 3)
    middles = scan.positions[triangles].mean(axis=1)
    open_scan = Mesh.from_triangles(
        scan.positions, triangles[np.linalg.norm(middles - (0.0, 0.0, 1.0), axis=1) > 0.25]
    )
    there = followed(head, open_scan, moved(open_scan, smiled(scan.positions)))
    np.testing.assert_allclose(there, smiled(head.positions), atol=0.03)


def test_a_ball_inside_goes_along(scan):
    ball = octahedron((0.2, -0.2, 0.7), 0.08)
    both, (place,) = joined(template_head(), ball)
    away = np.array([1.0, 2.0, 3.0])
    there = followed(both, scan, moved(scan, smiled(scan.positions) + away))[place]
    middle = there.mean(axis=0)
    assert np.linalg.norm(middle - ball[0].mean(axis=0) - away) < 0.1
    sizes = np.linalg.norm(there - middle, axis=1)
    np.testing.assert_allclose(sizes, 0.08, rtol=0.4)


def test_what_is_no_move_of_the_scan_is_refused_by_name(head, scan):
    with pytest.raises(CorrespondenceError, match=r"the moved scan: it has 748 vertices, the scan 4,000"):
        followed(head, scan, head)
    strange = scan.positions.copy()
    strange[6, 1] = np.nan
    with pytest.raises(FitError, match="the moved scan: vertex 7 "):
        followed(head, scan, moved(scan, strange))
    with pytest.raises(FitError, match="the scan: vertex 7 "):
        followed(head, moved(scan, strange), scan)


def test_a_template_that_does_not_lie_on_the_scan_is_refused(head, scan):
    with pytest.raises(FitError, match="does not lie on the scan"):
        followed(moved(head, head.positions * 1.3), scan, scan)


def test_a_scan_that_collapses_gives_no_number_that_is_none(head, scan):
    there = followed(head, scan, moved(scan, np.zeros_like(scan.positions)))
    assert np.isfinite(there).all()


def part_of(rig: Rig, *names: str) -> np.ndarray:
    """The vertices of some groups."""
    groups = rig.neutral.groups
    assert groups is not None
    wanted = np.isin(groups.index, [groups.names.index(name) for name in names])
    return np.unique(rig.neutral.corner_vertices[np.repeat(wanted, np.diff(rig.neutral.polygon_starts))])


@pytest.fixture(scope="module")
def ada_smiling():
    """Ada following a scan of her own skin alone, four times finer, into a smile; and the truth."""
    ada = person("ada")
    kept, triangles = skin_of(ada)
    meshes = []
    for points in (ada.neutral.positions, ada.positions({"happy": 1.0})):
        fine, faces = halved(points[kept].astype(np.float64), triangles)
        meshes.append(Mesh.from_triangles(fine.astype(np.float32), faces.astype(np.int32)))
    return ada, kept, followed(ada.neutral, *meshes), ada.positions({"happy": 1.0})


def test_a_persons_skin_follows_to_the_last_digit_and_her_eyes_and_brows_nearly(ada_smiling):
    ada, kept, there, truth = ada_smiling
    off = np.linalg.norm(there - truth, axis=1) / ada.neutral.diagonal
    assert off[kept].max() < 1e-6
    assert off[part_of(ada, "eye_L", "eye_R", "brows")].max() < 0.005


@pytest.mark.parametrize("way", [np.eye(3), ROTATION], ids=["in place", "turned"])
def test_what_a_scan_does_not_show_goes_where_its_skin_says(ada_smiling, way):
    """Hair as the skull, teeth and lashes as the smile has them: the skin of a smile tells that it is one."""
    ada, kept, there, truth = ada_smiling
    (found,) = with_likely_parts(ada, ada.neutral, [there.astype(np.float64) @ way.T + (1.0, 2.0, 3.0)])
    off = np.linalg.norm(found - (truth @ way.T + (1.0, 2.0, 3.0)), axis=1) / ada.neutral.diagonal
    assert off[kept].max() < 1e-5
    assert off[part_of(ada, "hair", "hair_locks", "teeth_upper")].max() < 1e-5
    before = np.linalg.norm(there - truth, axis=1) / ada.neutral.diagonal
    for name in ("teeth_lower", "tongue", "lashes"):
        assert off[part_of(ada, name)].max() < 0.15 * before[part_of(ada, name)].max()


def test_shapes_that_do_not_show_on_the_skin_are_not_guessed(ada_smiling):
    ada, _, there, _ = ada_smiling
    (found,) = with_likely_parts(ada, ada.neutral, [there], ["eyeLookInLeft", "tongueOut", "happy"])
    (alone,) = with_likely_parts(ada, ada.neutral, [there], ["happy"])
    np.testing.assert_allclose(found, alone, atol=1e-4)
