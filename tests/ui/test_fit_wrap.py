"""The page Fit with scans of another mesh: points on both views, wrapping, and carrying along."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.mesh import Labels
from facemorph.core.rig import Landmark, Rig
from facemorph.fit import registration
from facemorph.io import write_obj
from facemorph.ui import actions, fit_carry, fit_files, fit_run, fit_weights, fit_wrap
from facemorph.ui.fit_page import EXAMPLES, NEUTRAL, WEIGHTS
from facemorph.ui.fit_plan import Piece
from facemorph.ui.on_screen import projected
from facemorph.ui.run import open_dropped
from facemorph.ui.settings import Settings
from facemorph.ui.state import Face
from tests.ui import fit_case
from tests.ui.fit_case import head_rig, person_rig, scanned
from tests.ui.harness import Offscreen


@pytest.fixture(scope="module")
def template() -> Rig:
    """A head with landmarks all over its front."""
    rig = head_rig()
    front = np.flatnonzero(rig.neutral.positions[:, 2] > 1.0)[::5]
    marks = tuple(Landmark(f"mark {place}", int(vertex)) for place, vertex in enumerate(front))
    return replace(rig, info=replace(rig.info, landmarks=marks))


@pytest.fixture(scope="module")
def person(template: Rig) -> Rig:
    return person_rig(template)


@pytest.fixture
def page(opengl: None, template: Rig, person: Rig, tmp_path: Path) -> Iterator[Offscreen]:
    """The window with a scan of the person taken for the neutral, in millimetres and elsewhere."""
    write_obj(tmp_path / "neutral.obj", scanned(person.neutral))
    with Offscreen(template, settings=Settings(right_page="Fit")) as window:
        window.app.pages.fit.step = NEUTRAL
        drop(window, tmp_path / "neutral.obj")
        window.frames(3)
        yield window


def drop(page: Offscreen, *paths: Path) -> None:
    open_dropped(page.app, [str(path) for path in paths])
    page.until(lambda: not page.app.jobs.running)


def neutral(page: Offscreen) -> Piece:
    return page.app.fit.neutral


def point(page: Offscreen, count: int) -> None:
    """Say where the next points are: the scan's first vertices are the template's."""
    for _ in range(count):
        vertex, _name = fit_wrap.wanted_vertex(page.app, neutral(page))
        fit_wrap.point_at(page.app, neutral(page), neutral(page).mesh.positions[vertex].astype(np.float64))


def wrapped(page: Offscreen) -> None:
    point(page, len(page.app.fit.template.rig.info.landmarks))
    fit_wrap.wrap(page.app, neutral(page))
    page.until(lambda: neutral(page).quality is not None or page.app.messages.shown)
    assert not page.app.messages.shown


def seen(page: Offscreen, place: np.ndarray, side: int) -> tuple[float, float]:
    """Where a place (3,) of the shown surfaces is in the window."""
    x, y = projected(page.app, np.asarray(place, np.float64)[None], page.app.views()[side])[0][0]
    return float(x), float(y)


def shown_scan(page: Offscreen) -> np.ndarray:
    """The scan's vertices where the right view shows them."""
    split = page.app.on_face.split
    return split.right.positions(split.face.rig)


def test_the_landmark_asked_for_is_clicked_on_the_scan(page: Offscreen) -> None:
    vertex, name = fit_wrap.wanted_vertex(page.app, neutral(page))
    while np.abs(shown_scan(page)[vertex][:2]).max() > 5.0:
        fit_wrap.skip(page.app, neutral(page))
        vertex, name = fit_wrap.wanted_vertex(page.app, neutral(page))
    page.click(*seen(page, shown_scan(page)[vertex], 1))
    (pair,) = neutral(page).pairs
    assert (pair.vertex, pair.name) == (vertex, name)
    assert pair.point == pytest.approx(neutral(page).mesh.positions[vertex].tolist(), abs=2.0)
    assert fit_wrap.wanted_vertex(page.app, neutral(page))[0] != vertex
    page.frames(2)
    assert page.app.history.undo_words == "points on neutral"
    page.key("Z", ctrl=True)
    assert neutral(page).pairs == ()


def test_any_vertex_of_the_template_can_be_chosen(page: Offscreen, template: Rig) -> None:
    places = template.neutral.positions
    vertex = int(np.argmin(((places - (2.0, 3.0, 8.0)) ** 2).sum(axis=1)))
    page.click(*seen(page, places[vertex], 0))
    assert page.app.pages.fit.vertex == vertex
    page.click(*seen(page, shown_scan(page)[vertex], 1))
    assert neutral(page).pairs[0].vertex == vertex
    assert page.app.pages.fit.vertex is None


def test_hair_is_left_away_while_points_are_set(page: Offscreen, template: Rig) -> None:
    app = page.app
    mesh = template.neutral
    labels = Labels(("skin", "hair_locks"), np.arange(mesh.polygon_count, dtype=np.int32) % 7 // 6)
    haired = replace(template, neutral=replace(mesh, materials_used=labels))
    app.fit = replace(app.fit, template=Face(haired, ("haired",)))
    page.frames(3)
    shown = app.on_face.stage.rig
    assert shown.neutral.polygon_count == np.count_nonzero(labels.index == 0)
    assert shown.neutral.positions is mesh.positions
    assert app.on_face.split.words[0] == "Template"
    assert fit_wrap.base_of(app, neutral(page)) is haired.neutral


def test_a_landmark_can_be_passed_over(page: Offscreen) -> None:
    first = fit_wrap.wanted_vertex(page.app, neutral(page))
    fit_wrap.skip(page.app, neutral(page))
    assert fit_wrap.wanted_vertex(page.app, neutral(page)) != first


def test_a_point_is_dragged_and_taken_away_on_the_scan(page: Offscreen) -> None:
    point(page, 6)
    page.frames(3)
    placed = shown_scan(page)
    pair = max(neutral(page).pairs, key=lambda pair: placed[pair.vertex][2])
    number = neutral(page).pairs.index(pair)
    start = seen(page, placed[pair.vertex], 1)
    page.drag(start, (start[0] + 14, start[1] + 9))
    moved = neutral(page).pairs[number]
    assert moved.vertex == pair.vertex
    assert 0.5 < np.linalg.norm(np.subtract(moved.point, pair.point)) < 40.0
    assert page.app.history.undo_words == "points on neutral"
    page.key("Z", ctrl=True)
    page.frames(2)
    assert neutral(page).pairs[number] == pair
    page.click(*seen(page, shown_scan(page)[pair.vertex], 1), button=1)
    assert pair not in neutral(page).pairs
    assert len(neutral(page).pairs) == 5


def test_with_points_both_heads_stand_alike(page: Offscreen, template: Rig) -> None:
    point(page, 8)
    page.frames(3)
    vertices = [pair.vertex for pair in neutral(page).pairs]
    away = np.linalg.norm(shown_scan(page)[vertices] - template.neutral.positions[vertices], axis=1)
    assert away.max() < 1.0


def test_a_scan_lying_otherwise_can_be_turned(page: Offscreen) -> None:
    before = shown_scan(page)
    fit_wrap.turn(page.app, neutral(page), 1)
    page.frames(2)
    turned = shown_scan(page)
    centre = before - (before.max(axis=0) + before.min(axis=0)) / 2
    new = turned - (turned.max(axis=0) + turned.min(axis=0)) / 2
    assert np.linalg.norm(new) == pytest.approx(np.linalg.norm(centre), rel=0.3)
    ratio = new[:, 0] / centre[:, 2]
    assert ratio[np.abs(centre[:, 2]) > 1] == pytest.approx(ratio[0], abs=1e-3)
    vertex, _ = fit_wrap.wanted_vertex(page.app, neutral(page))
    front = int(np.argmax(turned[:, 2]))
    page.click(*seen(page, turned[front], 1))
    assert neutral(page).pairs[0].vertex == vertex
    assert neutral(page).pairs[0].point == pytest.approx(
        neutral(page).mesh.positions[front].tolist(), abs=3.0
    )


def test_a_point_that_contradicts_the_others_is_told_before_wrapping(page: Offscreen) -> None:
    point(page, 12)
    assert fit_wrap.doubt(page.app, neutral(page)) == ""
    fit_wrap.move_point(page.app, neutral(page), 3, np.add(neutral(page).pairs[3].point, (90.0, 80.0, 0.0)))
    assert "contradicts" in fit_wrap.doubt(page.app, neutral(page))
    fit_wrap.wrap(page.app, neutral(page))
    page.until(lambda: page.app.messages.shown)
    assert "contradicts" in page.app.messages.shown[0].text
    assert neutral(page).fitted is None


def test_the_template_is_wrapped_around_the_scan(page: Offscreen, person: Rig) -> None:
    wrapped(page)
    piece = neutral(page)
    assert piece.fitted.vertex_count == person.neutral.vertex_count
    assert piece.quality.mean_percent < 0.5
    page.frames(3)
    app = page.app
    split = app.on_face.split
    assert app.on_face.stage.rig.neutral is piece.mesh
    off = np.linalg.norm(split.right.positions(split.face.rig) - split.right.reference, axis=1)
    assert np.all(off <= piece.quality.distances + 1e-4)
    assert split.face.rig.info.unit == "mm"
    assert app.second_legend.unit == "mm"
    assert app.history.undo_words == "wrap neutral"
    page.key("Z", ctrl=True)
    assert neutral(page).fitted is None
    assert len(neutral(page).pairs) == len(piece.pairs)


def test_a_cancelled_wrap_leaves_the_points_and_nothing_else(
    page: Offscreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    reached, go_on = threading.Event(), threading.Event()

    def slow(template, scan, pairs, *, progress):
        reached.set()
        go_on.wait(10)
        progress(0.5, "on the way")
        raise AssertionError("it went on")

    monkeypatch.setattr(registration, "register", slow)
    point(page, 8)
    pairs = neutral(page).pairs
    fit_wrap.wrap(page.app, neutral(page))
    assert reached.wait(10)
    page.frames(2)
    page.app.jobs.of_kind("fit wrap").cancel()
    go_on.set()
    page.until(lambda: not page.app.jobs.running)
    assert (neutral(page).fitted, neutral(page).quality, neutral(page).pairs) == (None, None, pairs)
    assert not page.app.messages.shown


def test_points_are_kept_in_a_file(page: Offscreen, tmp_path: Path) -> None:
    point(page, 9)
    pairs = neutral(page).pairs
    fit_wrap.save_pairs(page.app, tmp_path / "points.csv")
    fit_wrap.remove_all(page.app, neutral(page))
    assert neutral(page).pairs == ()
    drop(page, tmp_path / "points.csv")
    kept = neutral(page).pairs
    assert [pair.vertex for pair in kept] == [pair.vertex for pair in pairs]
    assert np.array([p.point for p in kept]) == pytest.approx(np.array([p.point for p in pairs]), abs=1e-3)
    (tmp_path / "bad.csv").write_text("no, points\n")
    drop(page, tmp_path / "bad.csv")
    assert "bad.csv" in page.app.messages.shown[-1].text
    assert neutral(page).pairs == kept


def test_points_dropped_where_no_scan_wants_any_are_refused(page: Offscreen, tmp_path: Path) -> None:
    page.app.pages.fit.step = WEIGHTS
    page.app.pages.fit.step = EXAMPLES
    (tmp_path / "points.csv").write_text("")
    drop(page, tmp_path / "points.csv")
    assert "no scan" in page.app.messages.shown[-1].text


def test_expressions_of_the_same_scan_need_no_points(page: Offscreen, person: Rig, tmp_path: Path) -> None:
    app = page.app
    for name, weights in fit_case.EXAMPLES.items():
        write_obj(tmp_path / f"{name}.obj", scanned(person.posed(weights)))
    app.pages.fit.step = EXAMPLES
    drop(page, tmp_path / "smile.obj", tmp_path / "shout.obj")
    assert [piece.finding.standing for piece in app.fit.examples] == ["other", "other"]
    app.pages.fit.step = NEUTRAL
    wrapped(page)
    page.until(lambda: app.fit.ready or app.messages.shown)
    assert not app.messages.shown, app.messages.shown
    page.frames(2)
    assert app.history.undo_words == "wrap neutral"
    for piece in app.fit.examples:
        truth = scanned(person.posed(fit_case.EXAMPLES[piece.name])).positions
        moved = np.linalg.norm(truth - neutral(page).mesh.positions, axis=1).max()
        own = neutral(page).fitted.positions
        vertex = int(np.argmax(np.linalg.norm(piece.fitted.positions - own, axis=1)))
        assert np.linalg.norm(piece.fitted.positions[vertex] - own[vertex]) == pytest.approx(moved, rel=0.1)
    app.pages.fit.step = EXAMPLES
    drop(page, tmp_path / "grimace.obj")
    page.until(lambda: app.fit.ready)
    app.pages.fit.step = WEIGHTS
    page.until(lambda: fit_run.can_make(app))
    fit_run.make(app)
    page.until(lambda: app.pages.fit.made is not None)
    assert all(example.rms_percent < 1.0 for example in app.pages.fit.made.result.examples)
    assert app.pages.fit.made.result.rig.info.unit == "mm"


def test_an_expression_of_another_scan_is_pointed_at_beside_the_neutral(
    page: Offscreen, person: Rig, tmp_path: Path
) -> None:
    app = page.app
    wrapped(page)
    cut = scanned(person.posed(fit_case.EXAMPLES["smile"]))
    faces = cut.corner_vertices.reshape(-1, 3)[:-6]
    write_obj(tmp_path / "smile.obj", type(cut).from_triangles(cut.positions, faces))
    app.pages.fit.step = EXAMPLES
    drop(page, tmp_path / "smile.obj")
    page.frames(3)
    piece = fit_wrap.pointed_piece(app)
    assert piece is app.fit.examples[0]
    assert fit_wrap.base_of(app, piece) is neutral(page).fitted
    assert app.on_face.stage.rig.neutral is neutral(page).fitted
    for mark in app.fit.template.rig.info.landmarks:
        piece = app.fit.examples[0]
        assert fit_wrap.wanted_vertex(app, piece)[0] == mark.vertex
        fit_wrap.point_at(app, piece, piece.mesh.positions[mark.vertex].astype(np.float64))
    fit_wrap.wrap(app, app.fit.examples[0])
    page.until(lambda: app.fit.ready or app.messages.shown)
    assert app.fit.examples[0].quality.mean_percent < 0.5
    actions.show_page(app, "Shapes")
    page.frames(2)


class Held:
    """Work that waits until it may go on."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, place: object, name: str) -> None:
        self.reached, self.go_on, self.times = threading.Event(), threading.Event(), 0
        work = getattr(place, name)

        def held(*arguments, **others):
            self.times += 1
            self.reached.set()
            self.go_on.wait(10)
            return work(*arguments, **others)

        monkeypatch.setattr(place, name, held)


def test_a_wrap_of_the_template_before_is_dropped(page: Offscreen, monkeypatch: pytest.MonkeyPatch) -> None:
    held = Held(monkeypatch, registration, "register")
    point(page, 8)
    fit_wrap.wrap(page.app, neutral(page))
    assert held.reached.wait(10)
    fit_files.use_template(page.app, Face(head_rig("Other", 9), ("other",)))
    held.go_on.set()
    page.until(lambda: not page.app.jobs.running)
    page.frames(2)
    assert (neutral(page).fitted, neutral(page).quality) == (None, None)


def test_a_point_that_the_template_has_not_is_not_asked_for(page: Offscreen) -> None:
    app = page.app
    app.pages.fit.vertex = 10**6
    page.frames(3)
    named = fit_wrap.wanted_vertex(app, neutral(page))
    assert named[0] < app.fit.template.rig.neutral.vertex_count
    fit_wrap.skip(app, neutral(page))
    fit_files.use_template(app, Face(head_rig("Other", 9), ("other",)))
    assert (app.pages.fit.vertex, app.pages.fit.skipped) == (None, frozenset())


def test_while_a_point_is_dragged_the_scan_stays_in_its_place(page: Offscreen) -> None:
    point(page, 6)
    app, base = page.app, page.app.fit.template.rig.neutral
    before = fit_wrap.placement(app, neutral(page), base)
    app.pages.fit.held, app.pages.fit.held_from = 2, neutral(page)
    fit_wrap.move_point(app, neutral(page), 2, np.add(neutral(page).pairs[2].point, (9.0, 8.0, 0.0)))
    assert fit_wrap.placement(app, neutral(page), base) is before
    app.pages.fit.held = app.pages.fit.held_from = None
    assert fit_wrap.placement(app, neutral(page), base) is not before


def test_carrying_along_that_was_cancelled_does_not_begin_again(
    page: Offscreen, person: Rig, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, held = page.app, Held(monkeypatch, registration, "followed")
    write_obj(tmp_path / "smile.obj", scanned(person.posed(fit_case.EXAMPLES["smile"])))
    app.pages.fit.step = EXAMPLES
    drop(page, tmp_path / "smile.obj")
    app.pages.fit.step = NEUTRAL
    wrapped(page)
    page.frames(2)
    assert held.reached.wait(10)
    app.jobs.of_kind(fit_carry.JOB).cancel()
    held.go_on.set()
    page.until(lambda: not app.jobs.running)
    page.frames(4)
    assert held.times == 1
    assert not app.jobs.running
    assert app.fit.examples[0].fitted is None


def test_an_expression_wrapped_by_the_neutral_before_is_wrapped_anew(
    page: Offscreen, person: Rig, tmp_path: Path
) -> None:
    app = page.app
    wrapped(page)
    cut = scanned(person.posed(fit_case.EXAMPLES["smile"]))
    write_obj(
        tmp_path / "smile.obj",
        type(cut).from_triangles(cut.positions, cut.corner_vertices.reshape(-1, 3)[:-6]),
    )
    app.pages.fit.step = EXAMPLES
    drop(page, tmp_path / "smile.obj")
    for mark in app.fit.template.rig.info.landmarks:
        piece = app.fit.examples[0]
        fit_wrap.point_at(app, piece, piece.mesh.positions[mark.vertex].astype(np.float64))
    fit_wrap.wrap(app, app.fit.examples[0])
    page.until(lambda: app.fit.ready)
    fit_weights.set_weight(app, app.fit.examples[0].key, "happy", 0.5)
    page.frames(2)
    before = app.fit
    fit_wrap.wrap(app, neutral(page))
    page.until(lambda: neutral(page) is not before.neutral and not app.jobs.running)
    page.frames(3)
    page.until(lambda: not app.jobs.running)
    after = app.fit.examples[0]
    assert (after.fitted, after.quality, after.finding.standing) == (None, None, "other")
    assert after.pairs == before.examples[0].pairs
    assert after.weights == {"happy": 0.5}
    assert app.history.undo_words == "wrap neutral"
    page.key("Z", ctrl=True)
    page.frames(2)
    assert app.fit == before
