"""A template wrapped on a scan: where it lies, what it keeps, and what is refused by name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.errors import FitError, JobCancelledError, OptionError
from facemorph.fit.align import Similarity
from facemorph.fit.registration import LandmarkPair, Partners, Registered, register
from facemorph.fit.registration.surface import ScanSurface
from facemorph.fit.registration.triangle_points import nearest_in_triangles
from tests.fit.scans import PLACES, head_at, hull_of, scanned_head, template_head, with_triangles

TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
AWAY = Similarity(25.4, TURN, np.array([3.0, -500.0, 80.0]))


def head_pairs(template: Mesh, kind: float, names: tuple[str, ...] = tuple(PLACES)) -> list[LandmarkPair]:
    """Pairs at the vertices nearest to landmarks, exact on the other head."""
    pairs = []
    rest = template.positions / np.linalg.norm(template.positions, axis=1, keepdims=True)
    for name in names:
        direction = np.array(PLACES[name])
        # Directions of a head of kind 0 are those of its points, unstretched.
        stretched = head_at(direction[None], 0.0)[0]
        vertex = int(np.argmax(rest @ (stretched / np.linalg.norm(stretched))))
        own = template.positions[vertex] / np.array([0.8, 1.1, 0.95])
        x, y, z = head_at(own[None], kind)[0].tolist()
        pairs.append(LandmarkPair(vertex, (x, y, z), name))
    return pairs


def truth(template: Mesh, kind: float) -> np.ndarray:
    """Where the template's own vertices are on a head of another kind."""
    return head_at(template.positions.astype(float) / np.array([0.8, 1.1, 0.95]), kind)


@pytest.fixture(scope="module")
def template() -> Mesh:
    return template_head()


@pytest.fixture(scope="module")
def wrapped(template: Mesh) -> Registered:
    return register(template, scanned_head(1.0), head_pairs(template, 1.0))


def test_the_wrapped_template_lies_on_the_scan_and_keeps_what_it_is(template: Mesh, wrapped: Registered):
    quality = wrapped.quality
    assert quality.judged_percent == 100.0
    assert quality.mean_percent < 0.01
    assert quality.largest_percent < 0.2
    assert len(quality.flipped) == 0
    assert wrapped.mesh.polygon_starts is template.polygon_starts
    assert wrapped.mesh.corner_vertices is template.corner_vertices
    assert set(wrapped.seconds) == {"align", "wrap", "ride", "measure"}


def test_vertices_come_to_where_they_belong_not_only_on_the_surface(template: Mesh, wrapped: Registered):
    own = truth(template, 1.0)
    for pair in head_pairs(template, 1.0):
        assert np.linalg.norm(wrapped.mesh.positions[pair.vertex] - pair.point) < 0.05
    many = [LandmarkPair(v, tuple(own[v].tolist())) for v in range(0, template.vertex_count, 12)]
    led = register(template, scanned_head(1.0), many).mesh.positions
    before = np.linalg.norm(template.positions - own, axis=1).mean()
    assert np.linalg.norm(led - own, axis=1).mean() < 0.2 * before


def test_distances_are_those_to_the_nearest_of_all_triangles(template: Mesh, wrapped: Registered):
    scan = scanned_head(1.0)
    corners = scan.positions.astype(float)[scan.corner_vertices.reshape(-1, 3)]
    for vertex in range(0, template.vertex_count, 97):
        point = np.repeat(wrapped.mesh.positions[vertex].astype(float)[None], len(corners), axis=0)
        places = np.einsum("tc,tci->ti", nearest_in_triangles(point, corners), corners)
        nearest = np.linalg.norm(places - point, axis=1).min()
        assert wrapped.quality.distances[vertex] == pytest.approx(nearest, abs=1e-6)


def test_a_scan_elsewhere_turned_and_in_another_unit_gives_the_same_there(
    template: Mesh, wrapped: Registered
):
    scan, pairs = scanned_head(1.0), head_pairs(template, 1.0)
    moved = scan.with_positions(AWAY.points(scan.positions.astype(float)).astype(np.float32))
    there = [replace(pair, point=tuple(AWAY.points(np.array(pair.point)).tolist())) for pair in pairs]
    found = register(template, moved, there)
    expected = AWAY.points(wrapped.mesh.positions.astype(float))
    assert np.abs(found.mesh.positions - expected).max() < 2e-3 * moved.diagonal
    assert found.quality.mean < 1e-4 * moved.diagonal


def test_how_a_scan_is_stored_does_not_matter(template: Mesh, wrapped: Registered):
    scan, pairs = scanned_head(1.0), head_pairs(template, 1.0)
    triangles = scan.corner_vertices.reshape(-1, 3)
    loose = Mesh.from_triangles(
        scan.positions[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)
    )
    inside_out = Mesh.from_triangles(scan.positions, triangles[:, ::-1])
    flat = np.concatenate([triangles, np.zeros((50, 3), np.int32), triangles[:50, [0, 1, 1]]])
    for stored in (loose, inside_out, Mesh.from_triangles(scan.positions, flat)):
        found = register(template, stored, pairs)
        assert np.abs(found.mesh.positions - wrapped.mesh.positions).max() < 1e-3 * scan.diagonal
        assert len(found.quality.flipped) == 0


def test_what_the_scan_does_not_have_is_not_pulled_to_its_edge(template: Mesh):
    scan = scanned_head(1.0, count=4000)
    middles = scan.positions[scan.corner_vertices.reshape(-1, 3)].mean(axis=1)
    hole = np.linalg.norm(middles - np.array([0.62, -0.25, 0.45]), axis=1) > 0.3
    face = with_triangles(scan, hole & (middles[:, 2] > -0.2))
    found = register(template, face, head_pairs(template, 1.0))
    own = truth(template, 1.0)
    away = np.linalg.norm(found.mesh.positions - own, axis=1)
    seen = (own[:, 2] > -0.1) & (np.linalg.norm(own - np.array([0.62, -0.25, 0.45]), axis=1) > 0.35)
    in_hole = np.linalg.norm(own - np.array([0.62, -0.25, 0.45]), axis=1) < 0.2
    assert in_hole.sum() > 5
    assert not found.quality.judged[in_hole].any()
    assert not found.quality.judged[own[:, 2] < -0.35].any()
    assert found.quality.judged[seen].mean() > 0.95
    assert away[in_hole].mean() < 0.03
    # The back of the head stays a head, though nothing of it was scanned.
    assert away[own[:, 2] < -0.35].max() < 0.25
    assert len(found.quality.flipped) == 0


def test_noise_is_not_followed_by_a_stiff_template(template: Mesh):
    scan = scanned_head(1.0, count=4000, noise=0.01)
    pairs = head_pairs(template, 1.0)
    ideal = ScanSurface(*surface_of(scanned_head(1.0, count=4000)), 1.0)
    loose, stiff = (
        ideal.nearest(register(template, scan, pairs, stiffness=(100.0, end)).mesh.positions.astype(float))
        for end in (0.3, 10.0)
    )
    assert stiff.distances.mean() < loose.distances.mean()
    assert stiff.distances.mean() < 0.01


def surface_of(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    return mesh.positions.astype(float), mesh.corner_vertices.reshape(-1, 3).astype(np.int64)


@pytest.mark.parametrize("names", [tuple(PLACES)[:4], tuple(PLACES)[:3]])
def test_a_few_pairs_do_where_heads_are_alike(template: Mesh, names: tuple[str, ...]):
    found = register(template, scanned_head(0.4), head_pairs(template, 0.4, names))
    assert found.quality.mean_percent < 0.02
    assert len(found.quality.flipped) <= template.polygon_count // 500


def ball() -> np.ndarray:
    """Points (120, 3) all over a sphere of radius 1."""
    points = np.random.default_rng(1).normal(size=(120, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def with_extras(template: Mesh) -> tuple[Mesh, np.ndarray, np.ndarray]:
    """The head with two eyeballs behind it, a brow on it, a lone vertex; the eyes' and the brow's rows."""
    eyes = [ball() * 0.12 + np.array([side * 0.28, 0.25, 0.72]) for side in (-1, 1)]
    strip = np.array([[x, y, 1.0] for y in (0.42, 0.46) for x in np.linspace(0.1, 0.5, 7)])
    brow = head_at(strip / np.array([0.8, 1.1, 0.95]), 0.0) * 1.004
    low, high = np.arange(6), np.arange(7, 13)
    points = [template.positions, *eyes, brow, np.zeros((1, 3))]
    starts = np.cumsum([0, *map(len, points)])
    polygons = [
        *template.corner_vertices.reshape(-1, 4).tolist(),
        *(hull_of(ball()) + starts[1]).tolist(),
        *(hull_of(ball()) + starts[2]).tolist(),
        *(np.stack([low, low + 1, high + 1, high], axis=1) + starts[3]).tolist(),
    ]
    mesh = Mesh(
        np.concatenate(points).astype(np.float32),
        np.cumsum([0, *map(len, polygons)]).astype(np.int32),
        np.concatenate([np.array(polygon) for polygon in polygons]).astype(np.int32),
    )
    return mesh, np.arange(starts[1], starts[3]).reshape(2, -1), np.arange(starts[3], starts[4])


def test_parts_that_the_scan_lacks_ride_along_and_eyes_stay_round(template: Mesh, wrapped: Registered):
    mesh, eyes, brow = with_extras(template)
    found = register(mesh, scanned_head(1.0), head_pairs(template, 1.0))
    count = template.vertex_count
    assert np.allclose(found.mesh.positions[:count], wrapped.mesh.positions, atol=1e-5)
    assert not found.quality.matched[count:].any()
    for eye in eyes:
        placed, rest = (points[eye].astype(float) for points in (found.mesh.positions, mesh.positions))
        away, was = (np.linalg.norm(points - points.mean(axis=0), axis=1) for points in (placed, rest))
        assert np.ptp(away / was) < 1e-4
        assert 0.8 < (away / was).mean() < 1.25
    scan = ScanSurface(*surface_of(scanned_head(1.0)), 1.0)
    under = scan.nearest(found.mesh.positions[brow].astype(float))
    outward = ((found.mesh.positions[brow] - under.points) * under.normals).sum(axis=1)
    assert (outward > 0.0).mean() > 0.9
    assert under.distances.max() < 0.02


def test_parts_that_the_scan_has_too_can_be_laid_on_it(template: Mesh):
    mesh, eyes, _ = with_extras(template)
    scan = scanned_head(1.0)
    # The scan's own eye: not where riding along takes the template's, and larger.
    own = ball() * 0.123 + register(mesh, scan, head_pairs(template, 1.0)).mesh.positions[eyes[1]].mean(
        axis=0
    )
    both = Mesh.from_triangles(
        np.concatenate([scan.positions, own]).astype(np.float32),
        np.concatenate([scan.corner_vertices.reshape(-1, 3), hull_of(ball()) + scan.vertex_count]),
    )
    riding = register(mesh, both, head_pairs(template, 1.0))
    laid = register(mesh, both, head_pairs(template, 1.0), parts="present")
    assert not riding.quality.matched[eyes].any()
    assert laid.quality.matched[eyes[1]].all()
    assert not laid.quality.matched[eyes[0]].any()
    assert laid.quality.distances[eyes[1]].mean() < 0.2 * riding.quality.distances[eyes[1]].mean()


def test_a_cancelled_run_stops_at_once_and_progress_never_falls(template: Mesh):
    told: list[float] = []
    scan, pairs = scanned_head(1.0), head_pairs(template, 1.0)
    register(template, scan, pairs, progress=lambda part, _: told.append(part))
    assert told == sorted(told)
    assert told[0] == 0.0
    assert told[-1] == 1.0

    def stop(part: float, doing: str) -> None:
        if part > 0.3:
            raise JobCancelledError("stopped")

    with pytest.raises(JobCancelledError):
        register(template, scan, pairs, progress=stop)


def test_partners_are_suggested_from_four_pairs_on_in_both_directions(template: Mesh):
    scan, pairs = scanned_head(1.0), head_pairs(template, 1.0)
    partners = Partners(template, scan)
    assert partners.place_of(pairs[4].vertex, pairs[:3]) is None
    assert partners.vertex_of(pairs[4].point, pairs[:3]) is None
    own = truth(template, 1.0)
    vertices = range(0, template.vertex_count, 31)
    places = np.array([partners.place_of(vertex, pairs) for vertex in vertices])
    assert np.linalg.norm(places - own[::31], axis=1).mean() < 0.02 * scan.diagonal
    surface = ScanSurface(*surface_of(scan), 1.0)
    assert surface.nearest(places).distances.max() < 1e-6
    for pair in pairs:
        assert np.linalg.norm(np.array(partners.place_of(pair.vertex, pairs)) - pair.point) < 0.05
        back = partners.vertex_of(pair.point, pairs)
        assert np.linalg.norm(template.positions[back] - template.positions[pair.vertex]) < 0.15


def refused(template: Mesh, scan: Mesh, pairs: list[LandmarkPair], words: str, **options: object) -> None:
    with pytest.raises((FitError, OptionError), match=words) as error:
        register(template, scan, pairs, **options)
    assert "\n" not in str(error.value)


def test_pairs_that_cannot_be_used_are_named(template: Mesh):
    scan, pairs = scanned_head(0.5, 300), head_pairs(template, 0.5)
    refused(template, scan, pairs[:2], "at least 3 pairs")
    refused(template, scan, [], "there are 0")
    refused(
        template, scan, [*pairs, LandmarkPair(template.vertex_count, (0, 0, 1), "lost")], "'lost'.*not on the"
    )
    refused(template, scan, [*pairs, LandmarkPair(-1, (0, 0, 1))], "not on the template")
    refused(template, scan, [*pairs, LandmarkPair(5, (0.0, np.nan, 1.0), "gap")], "'gap'.*no finite number")
    refused(template, scan, [*pairs, replace(pairs[0], point=(0.0, 1.0, 0.0))], "two places")
    refused(template, scan, [*pairs, replace(pairs[0], vertex=9)], "'right eye'.* have one place")
    swapped = [
        replace(pairs[0], point=pairs[3].point),
        *pairs[1:3],
        replace(pairs[3], point=pairs[0].point),
        *pairs[4:],
    ]
    refused(template, scan, swapped, "'(right eye|chin)' .* contradicts the others")
    line = [LandmarkPair(40 * i, (0.0, 0.1 * i, 1.0)) for i in range(4)]
    refused(template, scan, line, "on one line")
    far = [replace(pair, point=tuple(10 * np.array(pair.point))) for pair in pairs]
    refused(template, scan, far, "no surface|off the scan's surface")


def test_left_and_right_confused_are_told(template: Mesh):
    scan, pairs = scanned_head(0.5, 300), head_pairs(template, 0.5)
    mirrored = [replace(pair, point=(-pair.point[0], *pair.point[1:])) for pair in pairs]
    refused(template, scan, mirrored, "mirrored")


def test_surfaces_that_cannot_be_used_are_named(template: Mesh):
    scan, pairs = scanned_head(0.5, 300), head_pairs(template, 0.5)
    broken = scan.positions.copy()
    broken[17, 1] = np.inf
    points = Mesh(scan.positions, np.zeros(1, np.int32), np.zeros(0, np.int32))
    flat = Mesh.from_triangles(scan.positions, np.zeros((500, 3), np.int32))
    empty = Mesh(np.zeros((0, 3), np.float32), np.zeros(1, np.int32), np.zeros(0, np.int32))
    refused(template, scan.with_positions(broken), pairs, "the scan: vertex 18 .*no finite number")
    refused(template, points, pairs, "0 triangles, so it is no surface")
    refused(template, flat, pairs, "no surface")
    refused(template, empty, pairs, "the scan is empty")
    refused(empty, scan, pairs, "the template is empty")


def test_a_scan_of_more_triangles_than_a_face_needs_is_refused_before_any_work(
    template: Mesh, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("facemorph.fit.registration.checks.MOST_TRIANGLES", 400)
    refused(template, scanned_head(0.5, 300), head_pairs(template, 0.5), "at most 400 are taken. Thin it out")


def test_options_out_of_range_are_refused(template: Mesh):
    scan, pairs = scanned_head(0.5, 300), head_pairs(template, 0.5)
    for options in (
        {"parts": "some"},
        {"steps": 0},
        {"stiffness": (100.0, 0.0)},
        {"reach": (np.nan, 0.1)},
        {"angle_deg": 120.0},
        {"landmark_weight": -1.0},
    ):
        refused(template, scan, pairs, "not", **options)


def test_the_nearest_place_in_a_triangle_is_the_nearest_of_many():
    rng = np.random.default_rng(3)
    corners = rng.normal(size=(300, 3, 3))
    corners[::10, 2] = corners[::10, 1]
    corners[::15, 1:] = corners[::15, :1]
    points = rng.normal(size=(300, 3)) * 2.0
    weights = nearest_in_triangles(points, corners)
    assert weights.min() >= -1e-12
    assert np.allclose(weights.sum(axis=1), 1.0)
    found = np.linalg.norm(np.einsum("nc,nci->ni", weights, corners) - points, axis=1)
    tried = rng.dirichlet(np.full(3, 0.4), size=4000)
    for row in range(300):
        least = np.linalg.norm(tried @ corners[row] - points[row], axis=1).min()
        assert found[row] <= least + 1e-9
        assert found[row] >= least - 0.15
