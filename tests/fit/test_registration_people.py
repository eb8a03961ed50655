"""One of the built-in people wrapped on another's skin, meshed anew: a scan whose every vertex is known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

import facemorph
from facemorph.core.mesh import Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.rig import Rig
from facemorph.fit.align import similarity
from facemorph.fit.registration import LandmarkPair, Registered, register, shared_landmarks
from facemorph.fit.registration.quality import Wrapped, quality_of
from facemorph.fit.registration.seams import crossed
from facemorph.fit.registration.surface import ScanSurface
from tests.fit.scans import edges, meshed_anew, skin_of

# Points round the mouth and the eyes among the usual 68.
MOUTH, EYES = range(48, 68), range(36, 48)


@pytest.fixture(scope="module")
def template() -> Rig:
    return facemorph.load("ada")


@pytest.fixture(scope="module")
def person() -> Rig:
    return facemorph.load("omar")


@pytest.fixture(scope="module")
def scan(person: Rig) -> Mesh:
    vertices, triangles = skin_of(person)
    return meshed_anew(person.neutral.positions[vertices].astype(float), triangles, 12_000)


@pytest.fixture(scope="module")
def pairs(template: Rig, person: Rig) -> list[LandmarkPair]:
    usual = {mark.name for mark in template.info.landmarks if mark.ibug is not None}
    return [pair for pair in shared_landmarks(template, person) if pair.name in usual]


@pytest.fixture(scope="module")
def wrapped(template: Rig, scan: Mesh, pairs: list[LandmarkPair]) -> Registered:
    return register(template.neutral, scan, pairs)


def test_the_surface_is_met_and_hardly_a_triangle_turned_over(wrapped: Registered, pairs: list[LandmarkPair]):
    quality = wrapped.quality
    assert len(pairs) == 68
    assert quality.mean_percent <= 0.02
    assert quality.p95_percent <= 0.02
    assert quality.flipped_percent <= 0.1
    assert quality.judged_percent > 97.0


def test_vertices_are_near_their_own_places(template: Rig, person: Rig, wrapped: Registered):
    vertices, _ = skin_of(template)
    away = np.linalg.norm(wrapped.mesh.positions - person.neutral.positions, axis=1)
    start = similarity(template.neutral.positions.astype(float), person.neutral.positions.astype(float))
    apart = np.linalg.norm(
        start.points(template.neutral.positions.astype(float)) - person.neutral.positions, axis=1
    )
    assert away[vertices].mean() < 0.4 * apart[vertices].mean()
    # 0.4 % of the diagonal, about 2 mm.
    assert away[vertices].mean() < 0.004 * person.neutral.diagonal
    for region in (MOUTH, EYES):
        assert away[around(template, region)].mean() < 0.0025 * person.neutral.diagonal


def around(rig: Rig, region: range) -> np.ndarray:
    """The skin's vertices within 1.2 cm of landmarks."""
    vertices, _ = skin_of(rig)
    points = rig.neutral.positions
    marks = [mark.vertex for mark in rig.info.landmarks if mark.ibug in region]
    return vertices[cKDTree(points[marks]).query(points[vertices])[0] < 1.2]


def test_no_lip_or_lid_is_laid_on_the_other(template: Rig, person: Rig, wrapped: Registered):
    # The person's own vertex that a wrapped vertex lies on is, along the surface, near the vertex itself:
    # from one lip to the other it is far, round the corner of the mouth or through its inside.
    triangles = template.triangles
    ends = edges(triangles)
    hops = coo_matrix(
        (np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(template.neutral.vertex_count,) * 2
    )
    normals, own = (vertex_normals(p, triangles) for p in (wrapped.mesh.positions, person.neutral.positions))
    for region in (MOUTH, EYES):
        near = around(template, region)
        # Places count in cm, normals' turns in half of them: which side of a seam it is, matters more.
        goal = np.concatenate([person.neutral.positions[near], 0.5 * own[near]], axis=1)
        found = cKDTree(goal).query(
            np.concatenate([wrapped.mesh.positions[near], 0.5 * normals[near]], axis=1)
        )[1]
        steps = dijkstra(hops, directed=False, indices=near, unweighted=True, limit=12)
        assert np.isfinite(steps[np.arange(len(near)), near[found]]).mean() > 0.995
    assert not len(wrapped.quality.crossed)


def test_eyes_teeth_and_tongue_ride_to_where_the_person_has_them(
    template: Rig, person: Rig, wrapped: Registered
):
    away = np.linalg.norm(wrapped.mesh.positions - person.neutral.positions, axis=1)
    groups = template.neutral.groups
    of_corner = np.repeat(groups.index, np.diff(template.neutral.polygon_starts))
    for name in ("eye_L", "eye_R", "teeth_upper", "teeth_lower", "tongue", "tears", "brows", "lashes"):
        vertices = np.unique(template.neutral.corner_vertices[of_corner == groups.names.index(name)])
        assert away[vertices].mean() < 0.3, name
        assert not wrapped.quality.matched[vertices].any()
    for name in ("eye_L", "eye_R"):
        vertices = np.unique(template.neutral.corner_vertices[of_corner == groups.names.index(name)])
        rest, ball = (p[vertices].astype(float) for p in (template.neutral.positions, wrapped.mesh.positions))
        assert np.abs(similarity(rest, ball).points(rest) - ball).max() < 1e-4


def test_triangles_that_were_turned_over_are_found(template: Rig, person: Rig, scan: Mesh):
    vertices, _ = skin_of(template)
    matched = np.zeros(template.neutral.vertex_count, bool)
    matched[vertices] = True
    surface = ScanSurface(
        scan.positions.astype(float), scan.corner_vertices.reshape(-1, 3).astype(np.int64), 0.8
    )
    truth = person.neutral.positions.astype(float)
    rest = template.neutral.positions.astype(float)
    before = similarity(rest, truth).points(rest)
    triangles = template.triangles.astype(np.int64)

    def flipped(points: np.ndarray) -> set[int]:
        wrapped = Wrapped(before, points, triangles)
        return set(quality_of(wrapped, surface, matched, matched, scan.diagonal).flipped.tolist())

    plain = flipped(truth)
    assert len(plain) < 0.001 * len(triangles)
    # One vertex of the cheek pushed across its neighbours, far enough to turn over one side of its ring.
    smooth = np.flatnonzero(np.abs(truth - np.array([5.0, -4.0, 0.5])).max(axis=1) < 1.5)
    vertex = int(np.intersect1d(smooth, vertices)[0])
    ring = np.unique(triangles[(triangles == vertex).any(axis=1)])
    far = ring[np.argmax(np.linalg.norm(truth[ring] - truth[vertex], axis=1))]
    pushed = truth.copy()
    pushed[vertex] += 2.2 * (truth[far] - truth[vertex])
    more = flipped(pushed) - plain
    assert more
    assert all(np.isin(triangles[list(more)], ring).any(axis=1))


def test_lips_that_went_through_each_other_are_found(template: Rig):
    vertices, triangles = skin_of(template)
    points = template.neutral.positions[vertices].astype(float)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    assert not len(crossed(points, points, triangles, size))
    marks = {mark.ibug: mark.vertex for mark in template.info.landmarks}
    upper, lower = (np.flatnonzero(vertices == marks[place])[0] for place in (62, 66))
    # All of the upper lip, and no more, 3 mm down through the lower one.
    middle = 0.5 * (points[upper] + points[lower])
    lip = (np.linalg.norm(points - middle, axis=1) < 1.2) & (points[:, 1] >= middle[1])
    moved = points - np.where(lip, 0.3, 0.0)[:, None] * np.array([0.0, 1.0, 0.0])
    through = crossed(points, moved, triangles, size)
    assert len(through)
    assert (np.linalg.norm(points[through] - middle, axis=1) < 1.5).all()
