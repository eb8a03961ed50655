"""The page Fit, driven as by a user: files dropped, weights dragged, shapes made, saved and opened."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import facemorph
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError, GraphicsError
from facemorph.fit import example_based
from facemorph.gl import Renderer
from facemorph.io import write_obj
from facemorph.ui import actions, files, fit_files, fit_run, fit_views, fit_weights, fit_wrap
from facemorph.ui.fit_page import EXAMPLES, MAKE, NEUTRAL, RESULT, SAVE, TEMPLATE, WEIGHTS
from facemorph.ui.run import open_dropped
from facemorph.ui.settings import Settings
from facemorph.ui.state import Face
from tests.ui import fit_case
from tests.ui.fit_case import head_rig, person_files, person_rig, shuffled
from tests.ui.harness import Offscreen


@pytest.fixture(scope="module")
def template() -> Rig:
    return head_rig()


@pytest.fixture(scope="module")
def person(template: Rig) -> Rig:
    return person_rig(template)


@pytest.fixture
def folder(person: Rig, tmp_path: Path) -> Path:
    return person_files(person, tmp_path / "Zoe")


@pytest.fixture
def page(opengl: None, template: Rig) -> Iterator[Offscreen]:
    with Offscreen(template, settings=Settings(right_page="Fit")) as window:
        yield window


def drop(page: Offscreen, *paths: Path) -> None:
    """Drop files on the window and wait until they are there."""
    open_dropped(page.app, [str(path) for path in paths])
    page.until(lambda: not page.app.jobs.running)


def started(page: Offscreen, folder: Path) -> None:
    """Everything dropped, weights estimated."""
    page.app.pages.fit.step = NEUTRAL
    drop(page, folder)
    page.app.pages.fit.step = WEIGHTS
    page.until(lambda: fit_run.can_make(page.app))


def made(page: Offscreen, folder: Path) -> None:
    started(page, folder)
    page.app.pages.fit.step = MAKE
    fit_run.make(page.app)
    page.until(lambda: page.app.pages.fit.made is not None)


def told(page: Offscreen) -> str:
    return "\n".join(message.text for message in page.app.messages.shown)


def test_the_open_face_is_the_template_and_that_is_no_step_of_undo(page: Offscreen, template: Rig) -> None:
    assert page.app.fit.template.rig is template
    assert page.app.history.undo_words == ""


def test_a_folder_dropped_is_sorted_into_neutral_and_examples(page: Offscreen, folder: Path) -> None:
    page.app.pages.fit.step = NEUTRAL
    drop(page, folder)
    plan = page.app.fit
    assert plan.neutral.name == "neutral"
    assert [piece.name for piece in plan.examples] == ["grimace", "shout", "smile"]
    assert all(piece.finding.standing == "fits" for piece in plan.pieces)
    assert page.app.pages.fit.name == "Zoe"
    assert page.app.pages.fit.step == EXAMPLES


def test_a_single_file_is_the_neutral_where_that_is_asked_for(page: Offscreen, folder: Path) -> None:
    page.app.pages.fit.step = NEUTRAL
    drop(page, folder / "smile.obj")
    assert page.app.fit.neutral.name == "smile"
    page.app.pages.fit.step = EXAMPLES
    drop(page, folder / "shout.obj", folder / "smile.obj")
    assert [piece.name for piece in page.app.fit.examples] == ["shout", "smile"]
    drop(page, folder / "smile.obj")
    assert [piece.name for piece in page.app.fit.examples] == ["shout", "smile", "smile (2)"]


def test_on_another_page_a_drop_opens_a_face_as_ever(page: Offscreen, folder: Path) -> None:
    actions.show_page(page.app, "Shapes")
    page.frames(2)
    drop(page, folder)
    page.until(lambda: page.app.face.title == "Zoe")
    assert page.app.fit.neutral is None


def test_a_folder_dropped_on_the_first_step_is_the_template(
    page: Offscreen, folder: Path, template: Rig
) -> None:
    drop(page, folder)
    assert page.app.fit.template.rig.names == ("grimace", "shout", "smile")
    page.app.face = None
    page.frames(2)
    assert page.app.fit.template.title == "Zoe"


def test_bad_files_are_told_and_the_others_taken(page: Offscreen, folder: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.obj"
    bad.write_text("v 0 0 0\nf 1 2 3\n")
    page.app.pages.fit.step = EXAMPLES
    drop(page, folder / "neutral.obj", bad, folder / "smile.obj")
    assert "bad.obj" in told(page)
    assert [piece.name for piece in page.app.fit.pieces] == ["neutral", "smile"]
    drop(page, tmp_path / "nowhere.obj")
    assert "nowhere.obj" in told(page)


@pytest.mark.parametrize(
    "text",
    [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n",
        "",
        "v 1e30 0 0\nv -1e30 0 0\nv 0 1e30 5\nf 1 2 3\n",
    ],
)
def test_odd_meshes_are_shown_or_refused_and_the_window_goes_on(
    page: Offscreen, tmp_path: Path, text: str
) -> None:
    odd = tmp_path / "odd.obj"
    odd.write_text(text)
    app = page.app
    for step in (NEUTRAL, EXAMPLES):
        app.pages.fit.step = step
        drop(page, odd)
        page.frames(4)
    for axis in range(3):
        for piece in app.fit.pieces:
            fit_wrap.turn(app, piece, axis)
        page.frames(2)
    page.click(680, 400)
    page.click(230, 400)
    assert not app.fit.ready
    app.pages.fit.step = WEIGHTS
    page.frames(3)
    assert app.pages.fit.step < WEIGHTS


@pytest.mark.parametrize("name", ["smile", "neutral"])
def test_what_cannot_be_drawn_is_told_once_and_the_window_goes_on(
    page: Offscreen, folder: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    load = Renderer.load

    def refusing(renderer: Renderer, rig: Rig) -> None:
        if rig.info.name == name:
            raise GraphicsError("it is too large.")
        load(renderer, rig)

    monkeypatch.setattr(Renderer, "load", refusing)
    app = page.app
    app.pages.fit.step = EXAMPLES
    drop(page, folder)
    page.frames(5)
    assert f"{name} cannot be drawn" in told(page)
    for message in list(app.messages.shown):
        app.messages.close(message)
    page.frames(5)
    assert not told(page)
    monkeypatch.undo()
    app.pages.fit.selected = app.fit.examples[0].key
    page.frames(3)


def test_a_template_without_shapes_is_refused(page: Offscreen, folder: Path, template: Rig) -> None:
    fit_files.ask_template(page.app, [folder / "smile.obj"])
    page.until(lambda: not page.app.jobs.running)
    assert "no shapes" in told(page)
    assert page.app.fit.template.rig is template


def test_meshes_in_another_order_are_put_right_by_one_press(
    page: Offscreen, person: Rig, tmp_path: Path
) -> None:
    for name, mesh in (("neutral", person.neutral), ("smile", person.posed(fit_case.EXAMPLES["smile"]))):
        write_obj(tmp_path / f"{name}.obj", shuffled(mesh))
    page.app.pages.fit.step = EXAMPLES
    drop(page, *(tmp_path / f"{name}.obj" for name in ("neutral", "smile")))
    assert [piece.finding.standing for piece in page.app.fit.pieces] == ["order", "order"]
    fit_files.put_in_order(page.app)
    page.until(lambda: page.app.fit.ready)
    assert page.app.fit.neutral.fitted.positions == pytest.approx(person.neutral.positions, abs=1e-4)
    smile = person.positions(fit_case.EXAMPLES["smile"])
    assert page.app.fit.examples[0].fitted.positions == pytest.approx(smile, abs=1e-4)
    page.frames(2)
    assert page.app.history.undo_words == "put 2 meshes in order"


def test_taking_out_an_example_can_be_undone(page: Offscreen, folder: Path) -> None:
    page.app.pages.fit.step = EXAMPLES
    drop(page, folder)
    page.frames(2)
    before = page.app.fit
    fit_files.take_out(page.app, before.examples[1].key)
    page.frames(2)
    assert [piece.name for piece in page.app.fit.examples] == ["grimace", "smile"]
    page.key("Z", ctrl=True)
    assert page.app.fit == before
    fit_files.start_over(page.app)
    page.frames(2)
    assert page.app.fit.pieces == ()
    page.key("Z", ctrl=True)
    assert page.app.fit == before


def test_another_template_compares_everything_anew_in_one_step(page: Offscreen, folder: Path) -> None:
    page.app.pages.fit.step = EXAMPLES
    drop(page, folder)
    page.frames(2)
    before = page.app.fit
    other = head_rig("Other", 9)
    fit_files.use_template(page.app, Face(other, ("other",)))
    page.until(lambda: page.app.fit.ready and not page.app.jobs.running)
    page.frames(2)
    assert page.app.history.undo_words == "template Other"
    page.key("Z", ctrl=True)
    assert page.app.fit == before


def test_weights_are_estimated_as_the_fit_would(
    page: Offscreen, folder: Path, template: Rig, person: Rig
) -> None:
    started(page, folder)
    app = page.app
    pieces = {piece.name: piece.fitted for piece in app.fit.examples}
    first = example_based(template, app.fit.neutral.fitted, pieces, iterations=1, lambda_=(1e9, 1e9))
    for piece, weights in zip(app.fit.examples, first.weights, strict=True):
        assert fit_weights.weights_of(app, piece) == pytest.approx(weights, abs=1e-4)
    shout = next(piece for piece in app.fit.examples if piece.name == "shout")
    assert fit_weights.start_of(app, shout).order[0] == "jawOpen"


def test_an_example_called_as_a_shape_is_taken_for_it(page: Offscreen, folder: Path, person: Rig) -> None:
    write_obj(folder / "happy_01.obj", person.posed({"happy": 0.9, "AU1": 0.3}))
    write_obj(folder / "sad.obj", person.posed({"AU12": 1.0}))
    started(page, folder)
    app = page.app
    named = next(piece for piece in app.fit.examples if piece.name == "happy_01")
    assert set(fit_weights.weights_of(app, named)) == {"happy"}
    assert fit_weights.start_of(app, named).named == ("happy",)
    # It is called sad and is not: then all shapes are looked at.
    wrong = next(piece for piece in app.fit.examples if piece.name == "sad")
    assert fit_weights.weights_of(app, wrong)["AU12"] > 0.3
    fit_weights.toggle_named(app, named.key)
    page.until(lambda: fit_run.can_make(app))
    again = app.fit.piece(named.key)
    assert {"happy", "AU1"} <= set(fit_weights.weights_of(app, again))
    page.frames(2)
    assert app.history.undo_words == "starting weights of happy_01"
    page.key("Z", ctrl=True)
    page.until(lambda: fit_run.can_make(app))
    assert set(fit_weights.weights_of(app, app.fit.piece(named.key))) == {"happy"}


def test_a_slider_sets_a_weight_in_one_step_and_the_estimate_comes_back(
    page: Offscreen, folder: Path
) -> None:
    started(page, folder)
    app = page.app
    page.frames(3)
    piece = fit_wrap.shown_example(app)
    estimate = fit_weights.weights_of(app, piece)
    for y in range(380, 620, 6):
        page.drag((1090, y), (1180, y))
        if app.fit.piece(piece.key).weights:
            break
    (name,) = app.fit.piece(piece.key).weights
    assert app.history.undo_words == f"starting weights of {piece.name}"
    assert fit_weights.weights_of(app, app.fit.piece(piece.key))[name] != pytest.approx(
        estimate.get(name, 0.0)
    )
    fit_weights.reset(app, piece.key)
    assert fit_weights.weights_of(app, app.fit.piece(piece.key)) == estimate
    page.frames(2)
    page.key("Z", ctrl=True)
    assert set(app.fit.piece(piece.key).weights) == {name}


def test_the_preview_shows_the_weights_beside_the_example(page: Offscreen, folder: Path) -> None:
    started(page, folder)
    app = page.app
    page.frames(3)
    piece = fit_wrap.shown_example(app)
    weights = fit_weights.weights_of(app, piece)
    rig = app.on_face.stage.rig
    assert app.scene().positions(rig) == pytest.approx(rig.positions(weights))
    split = app.on_face.split
    assert split.right.positions(rig) == pytest.approx(piece.fitted.positions, abs=0.02)
    assert split.right.reference == pytest.approx(rig.positions(weights))
    assert len(app.views()) == 2


def test_shapes_left_out_of_the_explanation_get_no_weight(page: Offscreen, folder: Path) -> None:
    started(page, folder)
    app = page.app
    for name in ("arkit", "expression"):
        fit_weights.toggle_set(app, name)
    page.until(lambda: fit_run.can_make(app))
    for piece in app.fit.examples:
        assert set(fit_weights.weights_of(app, piece)) <= {"AU1", "AU12"}
    fit_weights.toggle_set(app, "facs")
    assert app.fit.used == ("AU1", "AU12")


def test_from_dropping_files_to_a_saved_face(
    page: Offscreen, folder: Path, person: Rig, tmp_path: Path
) -> None:
    made(page, folder)
    app, fit = page.app, page.app.pages.fit
    assert fit.step == RESULT
    assert len(fit.told) == app.fit.iterations
    for example, plain in zip(fit.made.result.examples, fit.made.plain, strict=True):
        assert example.rms < 0.6 * plain.rms
    fit.name = "Zoe Example"
    goal = tmp_path / "out" / "zoe"
    goal.parent.mkdir()
    fit_run.save(app, goal)
    page.until(lambda: fit.saved)
    rig = facemorph.load(goal)
    assert rig.info.name == "Zoe Example"
    assert set(rig.names) == set(person.names)
    assert rig.neutral.positions == pytest.approx(person.neutral.positions, abs=1e-3)
    for example in fit.made.result.examples:
        truth = person.positions(fit_case.EXAMPLES[example.name])
        away = np.linalg.norm(rig.positions(dict(example.weights)) - truth, axis=1)
        assert float(np.sqrt(np.mean(away**2))) == pytest.approx(example.rms, abs=2e-3)
    fit_run.open_saved(app)
    page.until(lambda: app.face.title == "Zoe Example")
    page.frames(2)
    assert app.settings.right_page == "Shapes"
    assert app.shown_face is app.face
    assert fit.made is not None


def test_who_looks_at_another_step_meanwhile_stays_there(page: Offscreen, folder: Path) -> None:
    started(page, folder)
    fit_run.make(page.app)
    page.until(lambda: page.app.pages.fit.made is not None)
    assert page.app.pages.fit.step == WEIGHTS


def test_nothing_is_overwritten(page: Offscreen, folder: Path) -> None:
    made(page, folder)
    before = sorted(path.read_bytes() for path in folder.iterdir())
    fit_run.save(page.app, folder)
    page.until(lambda: page.app.messages.shown)
    assert "not empty" in told(page)
    assert page.app.pages.fit.saved == ""
    assert sorted(path.read_bytes() for path in folder.iterdir()) == before


def test_a_cancelled_run_leaves_what_was_before(page: Offscreen, folder: Path, monkeypatch) -> None:
    made(page, folder)
    app, fit = page.app, page.app.pages.fit
    before, plan = fit.made, app.fit
    reached, go_on = threading.Event(), threading.Event()

    def slow(*arguments, progress, each, **others):
        def held(part: float, doing: str) -> None:
            reached.set()
            go_on.wait(10)
            progress(part, doing)

        return example_based(*arguments, progress=held, each=each, **others)

    monkeypatch.setattr(fit_run, "example_based", slow)
    fit.step = MAKE
    fit_run.make(app)
    assert reached.wait(10)
    page.frames(2)
    fit_run.cancel(app)
    go_on.set()
    page.until(lambda: not app.jobs.running)
    assert fit.made is before
    assert (fit.told, fit.step) == ([], MAKE)
    assert app.fit == plan
    assert not told(page)


def test_who_starts_over_gets_no_shapes_of_the_person_before(
    page: Offscreen, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started(page, folder)
    app, reached, go_on = page.app, threading.Event(), threading.Event()
    fitted = fit_run.example_based

    def held(*arguments, **others):
        reached.set()
        go_on.wait(10)
        return fitted(*arguments, **others)

    monkeypatch.setattr(fit_run, "example_based", held)
    fit_run.make(app)
    assert reached.wait(10)
    (job,) = [job for job in app.jobs.running if job.kind == "fit make"]
    fit_files.start_over(app)
    assert job.cancelled
    go_on.set()
    page.until(lambda: not app.jobs.running)
    page.frames(2)
    assert (app.pages.fit.made, app.pages.fit.told, app.pages.fit.step) == (None, [], TEMPLATE)


def test_a_reading_that_was_cancelled_is_over(
    page: Offscreen, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, go_on = page.app, threading.Event()
    read = fit_files._read

    def held(*arguments):
        go_on.wait(10)
        return read(*arguments)

    monkeypatch.setattr(fit_files, "_read", held)
    fit_files.read(app, [folder / "smile.obj"])
    fit_files.read(app, [folder / "shout.obj"])
    assert fit_files.reading(app)
    first, _second = app.jobs.running
    assert not first.cancelled
    first.cancel()
    assert fit_files.reading(app)
    go_on.set()
    page.until(lambda: not app.jobs.running)
    assert not fit_files.reading(app)
    assert [piece.name for piece in app.fit.examples] == ["shout"]


def test_a_comparison_that_fails_is_told_once(
    page: Offscreen, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page.app.pages.fit.step = EXAMPLES
    drop(page, folder)

    def failing(*arguments, **others):
        raise FacemorphError("it went wrong.")

    monkeypatch.setattr(fit_files, "examined", failing)
    fit_files.use_template(page.app, Face(head_rig("Other", 9), ("other",)))
    page.until(lambda: page.app.messages.shown)
    page.frames(4)
    assert not page.app.jobs.running
    assert {piece.finding.standing for piece in page.app.fit.pieces} == {"unusable"}
    assert len(page.app.messages.shown) == 1


def test_an_example_equal_to_the_neutral_is_told(page: Offscreen, folder: Path, person: Rig) -> None:
    write_obj(folder / "smile.obj", person.neutral)
    page.app.pages.fit.step = NEUTRAL
    drop(page, folder)
    page.app.pages.fit.step = WEIGHTS
    page.until(lambda: page.app.messages.shown)
    assert "smile" in told(page)
    assert "equal to the neutral" in told(page)
    page.frames(5)
    assert not page.app.jobs.running
    smile = next(piece for piece in page.app.fit.examples if piece.name == "smile")
    fit_files.take_out(page.app, smile.key)
    page.until(lambda: fit_run.can_make(page.app))


def test_preparing_can_be_stopped_and_begun_again(
    page: Offscreen, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, reached, go_on = page.app, threading.Event(), threading.Event()
    prepared = fit_weights.Transfer.prepared

    def held(way, progress):
        reached.set()
        go_on.wait(10)
        return prepared(way, progress)

    monkeypatch.setattr(fit_weights.Transfer, "prepared", held)
    app.pages.fit.step = NEUTRAL
    drop(page, folder)
    app.pages.fit.step = WEIGHTS
    page.frames(2)
    assert reached.wait(10)
    fit_weights.stop(app)
    go_on.set()
    page.until(lambda: not app.jobs.running)
    page.frames(4)
    assert fit_weights.stopped(app)
    assert fit_weights.preview(app) is None
    assert not app.jobs.running
    fit_weights.again(app)
    page.until(lambda: fit_run.can_make(app))


def test_without_examples_the_shapes_are_carried_over(page: Offscreen, folder: Path, template: Rig) -> None:
    page.app.pages.fit.step = NEUTRAL
    drop(page, folder / "neutral.obj")
    page.app.pages.fit.step = MAKE
    page.until(lambda: fit_run.can_make(page.app))
    fit_run.make(page.app)
    page.until(lambda: page.app.pages.fit.made is not None)
    result = page.app.pages.fit.made.result
    assert result.examples == ()
    assert result.rig.names == template.names
    page.frames(2)
    assert page.app.on_face.split is None
    assert page.app.on_face.stage.rig.neutral is result.rig.neutral


def test_what_the_template_cannot_make_becomes_a_shape(page: Offscreen, folder: Path, person: Rig) -> None:
    points = person.neutral.positions.copy()
    low = int(np.argmin(((points - (4.0, -5.0, 7.0)) ** 2).sum(axis=1)))
    push = np.exp(-(((points - points[low]) / 1.5) ** 2).sum(axis=1))
    points[:, 0] += 4.0 * push
    write_obj(folder / "puff.obj", person.neutral.with_positions(points))
    made(page, folder)
    app, fit = page.app, page.app.pages.fit
    examples = {example.name: example for example in fit.made.result.examples}
    assert fit_run.is_poor(examples["puff"])
    assert not all(fit_run.is_poor(example) for example in examples.values())
    fit_run.add_shape(app, examples["puff"], "happy")
    assert "name of its own" in told(page)
    fit_run.add_shape(app, examples["puff"], fit_run.shape_name(fit.made, examples["puff"]))
    assert fit.made.result.rig.names[-1] == "puff"
    puff = next(example for example in fit.made.result.examples if example.name == "puff")
    assert puff.rms == pytest.approx(0.0)
    page.frames(3)
    fit_run.take_shape_out(app, "puff")
    assert "puff" not in fit.made.result.rig.names
    assert fit_run.is_poor(next(e for e in fit.made.result.examples if e.name == "puff"))


def test_a_changed_plan_is_not_what_was_made(page: Offscreen, folder: Path) -> None:
    made(page, folder)
    app = page.app
    assert fit_run.is_current(app)
    key = app.fit.examples[0].key
    fit_weights.set_weight(app, key, "sad", 0.9)
    page.frames(2)
    assert not fit_run.is_current(app)
    page.key("Z", ctrl=True)
    assert fit_run.is_current(app)


def test_the_fitted_face_is_seen_beside_the_example(page: Offscreen, folder: Path) -> None:
    made(page, folder)
    app = page.app
    app.pages.fit.heat = True
    page.frames(4)
    example = fit_views.shown_result(app)
    rig = app.on_face.stage.rig
    left, right = app.scene().positions(rig), app.on_face.split.right
    assert right.positions(rig) - left == pytest.approx(example.offsets, abs=1e-4)
    away = np.linalg.norm(right.positions(rig) - right.reference, axis=1)
    assert away == pytest.approx(example.distances, abs=1e-4)
    assert app.second_legend.title == "Difference"
    assert app.second_legend.high >= example.largest


def test_every_step_draws_and_nothing_is_lost_on_the_way(page: Offscreen, folder: Path) -> None:
    made(page, folder)
    app, fit = page.app, page.app.pages.fit
    plan, kept = app.fit, fit.made
    seen = []
    for step in (TEMPLATE, NEUTRAL, EXAMPLES, WEIGHTS, MAKE, RESULT, SAVE):
        fit.step = step
        page.frames(3)
        assert fit.step == step
        seen.append(page.pixels_now()[110:740, 910:].copy())
    assert all(np.any(one != other) for one, other in itertools.pairwise(seen))
    actions.show_page(app, "Shapes")
    page.frames(2)
    assert app.on_face.stage is None
    actions.show_page(app, "Fit")
    page.frames(2)
    assert (app.fit, fit.made, fit.step) == (plan, kept, SAVE)


def test_the_open_face_keeps_its_camera_and_pose(page: Offscreen, folder: Path) -> None:
    app = page.app
    app.pose = Pose.between("neutral", "happy", 0.5)
    actions.show_page(app, "Shapes")
    page.frames(2)
    app.camera = app.camera.orbited(25.0, 5.0).zoomed(2.0)
    page.frames(2)
    own = app.camera
    actions.show_page(app, "Fit")
    app.pages.fit.step = NEUTRAL
    drop(page, folder)
    page.frames(3)
    assert app.camera.azimuth_deg == own.azimuth_deg
    assert app.camera != own
    app.camera = app.camera.orbited(10.0, 0.0)
    page.frames(2)
    staged = app.camera
    actions.show_page(app, "Shapes")
    page.frames(3)
    assert app.camera == own
    assert app.pose == Pose.between("neutral", "happy", 0.5)
    actions.show_page(app, "Fit")
    page.frames(3)
    assert app.camera == staged


def test_what_is_exported_is_what_is_seen(page: Offscreen, folder: Path, tmp_path: Path) -> None:
    made(page, folder)
    page.frames(3)
    goal = tmp_path / "seen.obj"
    files.export_mesh(page.app, goal)
    page.until(goal.exists)
    page.until(lambda: not page.app.jobs.running)
    example = fit_views.shown_result(page.app)
    rig = page.app.pages.fit.made.face.rig
    exported = facemorph.load(goal).neutral.positions
    assert exported == pytest.approx(rig.positions(dict(example.weights)), abs=1e-4)


def test_the_command_opens_the_page_and_the_work_shows_once(page: Offscreen, folder: Path) -> None:
    actions.show_page(page.app, "Shapes")
    page.run("Make a person's blendshapes…")
    assert page.app.settings.right_page == "Fit"
    started(page, folder)
    assert {"fit start", "fit make"} <= page.app.on_face.tells
    actions.show_page(page.app, "Shapes")
    page.frames(2)
    assert page.app.on_face.tells == frozenset()


def test_a_step_that_is_no_longer_there_gives_way(page: Offscreen, folder: Path) -> None:
    started(page, folder)
    fit_files.take_out(page.app, page.app.fit.neutral.key)
    page.frames(2)
    assert page.app.pages.fit.step == EXAMPLES


def test_the_chooser_offers_the_persons_name_for_the_folder(
    page: Offscreen, folder: Path, tmp_path: Path
) -> None:
    made(page, folder)
    app, chooser = page.app, page.app.chooser
    app.settings.last_folder = str(tmp_path)
    actions.ask_for(app, "save person")
    page.frames(2)
    assert chooser.path == str(tmp_path / "Zoe")
    page.key("enter")
    # The person's own files are in a folder of that name.
    assert chooser.purpose == "save person"
    chooser.fresh = True  # as a click into the field
    page.frames(3)
    page.key("A", ctrl=True)
    page.type(str(tmp_path / "Zoe's face"))
    page.key("enter")
    page.until(lambda: app.pages.fit.saved)
    assert app.pages.fit.saved == str(tmp_path / "Zoe's face")
    assert facemorph.load(tmp_path / "Zoe's face").info.name == "Zoe"


@pytest.mark.parametrize(("size", "scale"), [((1280, 800), 1.0), ((700, 500), 1.0), ((1280, 800), 2.0)])
def test_it_draws_at_every_size(
    opengl: None, template: Rig, folder: Path, size: tuple[int, int], scale: float
) -> None:
    with Offscreen(template, size, scale=scale, settings=Settings(right_page="Fit")) as window:
        made(window, folder)
        for step in range(SAVE + 1):
            window.app.pages.fit.step = step
            window.frames(2)
        assert not told(window)


def test_where_no_face_is_open_a_template_can_be_chosen(opengl: None, folder: Path) -> None:
    with Offscreen(settings=Settings(right_page="Fit")) as window:
        window.frames(2)
        assert window.app.fit.template is None
        drop(window, folder)
        window.frames(3)
        assert window.app.fit.template.title == "Zoe"
        assert window.app.shown_face.title == "Zoe"
        assert window.app.fit.template.rig.names == ("grimace", "shout", "smile")
