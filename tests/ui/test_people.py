"""The People page: the pad of (2.10), re-basing, people from files, driven by fed events."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.facs import Sides
from facemorph.core.pose import Pose, state_of
from facemorph.core.progress import Progress
from facemorph.core.rig import FaceInfo, Rig
from facemorph.deform.controls import Controls, PeopleControl
from facemorph.deform.people import PeopleMix, bilinear
from facemorph.io import read_mesh, write_obj
from facemorph.ui import comparing, files, people, units
from facemorph.ui.history import MOST_PEOPLE, History
from facemorph.ui.methods import OWN
from facemorph.ui.settings import Settings
from facemorph.ui.state import App, Face
from tests.ui.harness import Offscreen, ball_rig

# The square in which the dot moves, at 1280 x 800: s to the right, t upwards.
LEFT, RIGHT, LOW, HIGH = 1004.0, 1180.0, 541.0, 365.0
SWITCH = (985, 124)
# Positions of about 10 cm and the offsets are float32: their sum is off by a few units in the last place.
DRAWN = 1e-5


def other_person(name: str, seed: int, rig: Rig) -> Rig:
    """A person of the same topology with another head and other movements."""
    random = np.random.default_rng(seed)
    positions = rig.neutral.positions * random.uniform(0.8, 1.2, 3).astype(np.float32)
    deltas = rig.deltas * random.uniform(0.5, 1.5, (len(rig.shapes), 1, 3)).astype(np.float32)
    return Rig(rig.neutral.with_positions(positions), rig.shapes, deltas, FaceInfo(name, unit="cm"))


@pytest.fixture
def ada() -> Rig:
    return ball_rig(name="Ada", rings=12)


@pytest.fixture
def kofi(ada: Rig) -> Rig:
    return other_person("Kofi", 1, ada)


@pytest.fixture
def mei(ada: Rig) -> Rig:
    return other_person("Mei", 2, ada)


@pytest.fixture
def page(opengl: None, ada: Rig) -> Iterator[Offscreen]:
    with Offscreen(ada, settings=Settings(right_page="People")) as window:
        yield window


def take(page: Offscreen, rig: Rig) -> None:
    """Mix the face with a person as if they had just been read."""
    page.app.methods.people[rig.info.name] = rig
    page.app.methods.forget()
    people.choose(page.app, rig.info.name)
    page.frames(2)


def put(page: Offscreen, s: float, t: float) -> None:
    people.put(page.app, s, t)
    page.frames(2)


def drag_to(page: Offscreen, s: float, t: float) -> None:
    kept = people.control(page.app)
    start = LEFT + (RIGHT - LEFT) * (kept.mix.s if kept.mix else 0.0), LOW + (HIGH - LOW) * kept.t
    page.drag(start, (LEFT + (RIGHT - LEFT) * s, LOW + (HIGH - LOW) * t))


def shown(page: Offscreen) -> np.ndarray:
    return page.app.scene().positions(page.app.rig)


def exact(app: App, rigs: dict[str, Rig]) -> np.ndarray:
    """What the page makes, in float64: sum_i s_i (N_i + sum_k c_k delta_ik)."""
    total = np.zeros((app.rig.neutral.vertex_count, 3))
    for name, share in people.shares(app).items():
        rig = rigs[name]
        face = rig.neutral.positions.astype(np.float64)
        for shape, weight in app.controls.people.weights().items():
            face = face + weight * rig.deltas[rig.names.index(shape)].astype(np.float64)
        total += share * face
    return total


def save_folder(folder: Path, rig: Rig, names: tuple[str, ...]) -> Path:
    folder.mkdir()
    write_obj(folder / "neutral.obj", rig.neutral)
    for name in names:
        write_obj(folder / f"{name}.obj", rig.posed({name: 1.0}))
    return folder


def test_a_drag_on_the_pad_is_the_bilinear_interpolation_of_four_meshes(
    page: Offscreen, ada: Rig, kofi: Rig
) -> None:
    take(page, kofi)
    drag_to(page, 0.7, 0.4)
    kept = page.app.controls.people
    assert (kept.mix.s, kept.t) == pytest.approx((0.7, 0.4), abs=0.01)
    key_frames = [[rig.positions({}), rig.positions({"happy": 1.0})] for rig in (ada, kofi)]
    np.testing.assert_allclose(shown(page), bilinear(key_frames, kept.mix.s, kept.t), atol=DRAWN)


def test_the_corners_are_the_four_meshes(page: Offscreen, ada: Rig, kofi: Rig) -> None:
    take(page, kofi)
    people.choose_target(page.app, "angry")
    for s, t in ((0, 1), (1, 1), (1, 0), (0, 0)):
        # The hand goes beyond the square; the dot stays in its corner.
        drag_to(page, s * 1.6 - 0.3, t * 1.6 - 0.3)
        kept = page.app.controls.people
        assert (kept.mix.s, kept.t) == (s, t)
        corner = (kofi if s else ada).positions({"angry": float(t)})
        np.testing.assert_allclose(shown(page), corner, atol=DRAWN)


def test_sliders_below_say_and_set_the_same_places(page: Offscreen, kofi: Rig) -> None:
    take(page, kofi)
    page.drag((1046, 625), (1125, 625))
    page.drag((1046, 660), (1165, 660))
    kept = page.app.controls.people
    assert kept.mix.s == pytest.approx(0.5, abs=0.05)
    assert kept.t == pytest.approx(0.75, abs=0.05)


def test_the_hovered_slider_lights_up_what_t_moves(page: Offscreen) -> None:
    page.move(1100, 660)
    page.frames(2)
    assert page.app.scene().glow is not None
    page.move(450, 300)
    page.frames(2)
    assert page.app.scene().glow is None


def test_compared_faces_have_the_mixtures_colours(page: Offscreen, ada: Rig, kofi: Rig) -> None:
    take(page, kofi)
    put(page, 0.5, 0.5)
    together, without = (comparing.scene_by(page.app, ada, way) for way in ("Present", "Without people"))
    assert [partner.rig for partner in together.partners] == [kofi]
    np.testing.assert_array_equal(together.positions(ada), shown(page))
    assert without.partners == ()
    np.testing.assert_array_equal(without.positions(ada), ada.neutral.positions)


def test_without_another_person_the_pad_moves_the_expression_alone(page: Offscreen, ada: Rig) -> None:
    page.drag((LEFT, LOW), (RIGHT, (LOW + HIGH) / 2))
    kept = page.app.controls.people
    assert kept.mix is None
    assert kept.t == pytest.approx(0.5, abs=0.01)
    np.testing.assert_allclose(shown(page), ada.positions({"happy": kept.t}), atol=DRAWN)


def test_a_new_person_and_a_new_expression_move_nothing(
    page: Offscreen, ada: Rig, kofi: Rig, mei: Rig
) -> None:
    app, rigs = page.app, {OWN: ada, "Kofi": kofi, "Mei": mei}
    people.set_curve(app, "cosine")
    take(page, kofi)
    put(page, 0.6, 0.3)
    before, drawn = exact(app, rigs), shown(page)
    take(page, mei)
    assert app.controls.people.mix.s == 0.0
    assert np.abs(exact(app, rigs) - before).max() < 1e-12
    np.testing.assert_allclose(shown(page), drawn, atol=DRAWN)
    put(page, 0.25, 0.8)
    before, drawn = exact(app, rigs), shown(page)
    people.choose_target(app, "surprised")
    assert app.controls.people.t == 0.0
    assert np.abs(exact(app, rigs) - before).max() < 1e-12
    np.testing.assert_allclose(shown(page), drawn, atol=DRAWN)
    np.testing.assert_allclose(shown(page), before, atol=DRAWN)


def test_every_choice_and_every_drag_is_one_step_of_undo(page: Offscreen, kofi: Rig, mei: Rig) -> None:
    app = page.app
    seen = [app.controls]
    for act in (
        lambda: take(page, kofi),
        lambda: drag_to(page, 0.6, 0.5),
        lambda: people.choose_target(app, "sad"),
        lambda: drag_to(page, 0.6, 0.3),
        lambda: take(page, mei),
        lambda: drag_to(page, 0.5, 0.5),
    ):
        act()
        page.frames(2)
        seen.append(app.controls)
    assert len({id(step) for step in seen}) == 7
    assert app.history.undo_words == "people to 0.50, 0.50"
    for step in reversed(seen[:-1]):
        page.key("Z", ctrl=True)
        assert app.controls == step
        shown(page)
    assert app.controls == Controls()
    for step in seen[1:]:
        page.key("Z", ctrl=True, shift=True)
        assert app.controls == step
    assert app.controls.off == frozenset()


def test_the_same_person_or_expression_again_changes_nothing_and_says_so(page: Offscreen, kofi: Rig) -> None:
    take(page, kofi)
    put(page, 1.0, 1.0)
    before = page.app.controls
    people.choose(page.app, "Kofi")
    people.choose_target(page.app, "happy")
    assert page.app.controls is before
    assert [message.text for message in page.app.messages.shown] == [
        "What the page People makes is Kofi already.",
        "What the page People makes is happy already.",
    ]


def test_both_ends_change_places_without_a_jump(page: Offscreen, ada: Rig, kofi: Rig) -> None:
    app, rigs = page.app, {OWN: ada, "Kofi": kofi}
    people.set_curve(app, "cosine")
    take(page, kofi)
    put(page, 0.3, 0.4)
    before = exact(app, rigs)
    people.swap(app)
    assert app.controls.people.mix.target == OWN
    people.choose_source(app, "happy")
    assert app.controls.people.source == {"happy": 1.0}
    assert app.controls.people.target == {}
    assert np.abs(exact(app, rigs) - before).max() < 1e-12


def test_the_face_itself_comes_back(page: Offscreen, ada: Rig, kofi: Rig, mei: Rig) -> None:
    take(page, kofi)
    put(page, 0.5, 0.5)
    take(page, mei)
    put(page, 0.5, 0.5)
    assert people.shares(page.app) == pytest.approx({OWN: 0.25, "Kofi": 0.25, "Mei": 0.5})
    page.run("People: start again")
    assert page.app.controls.people.mix == PeopleMix({OWN: 1.0}, "Mei")
    np.testing.assert_allclose(shown(page), ada.positions({"happy": 0.5}), atol=DRAWN)
    people.reset(page.app)
    assert page.app.controls == Controls()


def test_people_wear_what_the_other_pages_make(page: Offscreen, ada: Rig, kofi: Rig) -> None:
    app = page.app
    take(page, kofi)
    put(page, 0.35, 0.5)
    app.pose = replace(Pose.between("neutral", "sad", 0.25), weights={"jawOpen": 0.4})
    units.set_unit(app, 12, Sides.both(0.6))
    app.controls = replace(app.controls, emotion=replace(app.controls.emotion, x=-0.2))
    page.frames(2)
    weights = {"happy": 0.5, "sad": 0.25, "jawOpen": 0.4, "AU12": 0.6, "afraid": 0.2}
    expected = 0.65 * ada.positions(weights) + 0.35 * kofi.positions(weights)
    np.testing.assert_allclose(shown(page), expected, atol=2 * DRAWN)
    assert app.controls.off == frozenset()


def test_switched_off_the_page_moves_nothing_and_keeps_its_settings(
    page: Offscreen, ada: Rig, kofi: Rig
) -> None:
    take(page, kofi)
    put(page, 0.5, 0.5)
    kept = page.app.controls.people
    page.click(*SWITCH)
    np.testing.assert_array_equal(shown(page), ada.neutral.positions)
    assert page.app.scene().partners == ()
    page.click(*SWITCH)
    assert page.app.controls.people is kept
    assert np.abs(shown(page) - ada.neutral.positions).max() > 0.1


def test_skins_are_mixed_only_where_that_is_wanted(page: Offscreen, kofi: Rig) -> None:
    take(page, kofi)
    put(page, 0.5, 0.0)
    assert [(p.rig, p.weight) for p in page.app.scene().partners] == [(kofi, 0.5)]
    page.run("People: skin too")
    assert page.app.scene().partners == ()


def test_a_person_from_a_folder_is_read_beside_the_window(page: Offscreen, kofi: Rig, tmp_path: Path) -> None:
    folder = save_folder(tmp_path / "Kofi", kofi, ("happy", "sad"))
    people.ask_files(page.app, [str(folder)])
    assert page.app.controls == Controls()
    page.until(lambda: page.app.controls.people.mix is not None)
    name = page.app.controls.people.mix.target
    read = page.app.methods.people[name]
    put(page, 1.0, 1.0)
    np.testing.assert_allclose(shown(page), read.positions({"happy": 1.0}), atol=DRAWN)
    assert people.expressions(page.app).keys() == {"neutral", "happy", "sad"}
    assert set(people.lacked(page.app)) == {"angry", "surprised", "disgusted", "afraid"}


def test_the_chooser_asks_for_another_face(page: Offscreen, kofi: Rig, tmp_path: Path) -> None:
    folder = save_folder(tmp_path / "Kofi", kofi, ("happy",))
    page.app.settings.last_folder = str(tmp_path)
    page.click(970, 255)
    assert page.app.chooser.purpose == "person"
    page.frames(4)
    page.type("Kofi")
    page.key("enter")
    page.until(lambda: page.app.controls.people.mix is not None)
    assert page.app.face.title == "Ada"
    assert page.app.pages.people.files.keys() == {(str(folder),)}


def test_a_face_of_another_topology_is_refused_in_words_and_nothing_is_lost(
    page: Offscreen, kofi: Rig, obj_face: Path
) -> None:
    take(page, kofi)
    put(page, 0.5, 0.5)
    before = page.app.controls
    people.ask_files(page.app, [str(obj_face)])
    page.until(lambda: bool(page.app.messages.shown))
    text = page.app.messages.shown[-1].text
    assert "small cannot be mixed with Ada" in text
    assert "vertices" in text
    assert "one topology" in text
    assert page.app.controls is before
    assert set(page.app.methods.people) == {"Kofi"}


def test_a_person_who_lacks_what_the_face_shows_is_refused(
    page: Offscreen, kofi: Rig, tmp_path: Path
) -> None:
    folder = save_folder(tmp_path / "Kofi", kofi, ("sad",))
    put(page, 0.0, 0.5)
    people.ask_files(page.app, [str(folder)])
    page.until(lambda: bool(page.app.messages.shown))
    assert "has no Happy" in page.app.messages.shown[-1].text
    assert page.app.controls.people.mix is None
    assert page.app.methods.people == {}
    people.reset(page.app)
    people.ask_files(page.app, [str(folder)])
    page.until(lambda: page.app.controls.people.mix is not None)
    assert people.control(page.app).target == {"sad": 1.0}


def test_cancelled_the_reading_leaves_nothing_behind(
    page: Offscreen, kofi: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on = threading.Event()

    def slow(paths: tuple[str, ...], progress: Progress, *, builtin: bool) -> Rig:
        go_on.wait(10.0)
        progress(0.5, "Reading")
        return kofi

    monkeypatch.setattr(files, "load", slow)
    page.app.builtins = ("kofi",)
    people.ask_builtin(page.app, "kofi")
    page.frames(2)
    assert people.loading(page.app) == "Kofi"
    page.app.jobs.of_kind(people.JOB).cancel()
    go_on.set()
    page.until(lambda: not page.app.jobs.running)
    assert people.loading(page.app) == ""
    assert page.app.controls == Controls()
    assert page.app.methods.people == {}
    assert page.app.messages.shown == []
    assert page.app.history.undo_words == ""


def test_a_person_who_comes_when_another_face_is_open_is_not_taken(
    page: Offscreen, kofi: Rig, mei: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on = threading.Event()

    def slow(paths: tuple[str, ...], progress: Progress, *, builtin: bool) -> Rig:
        go_on.wait(10.0)
        return kofi

    monkeypatch.setattr(files, "load", slow)
    people.ask_builtin(page.app, "kofi")
    page.app.arriving = Face(mei, ("mei",), builtin=True)
    page.frames(2)
    go_on.set()
    page.until(lambda: not page.app.jobs.running)
    assert page.app.controls == Controls()
    assert page.app.methods.people == {}


def test_another_face_starts_anew_and_undo_brings_the_mixture_back(
    page: Offscreen, ada: Rig, kofi: Rig, mei: Rig
) -> None:
    take(page, kofi)
    put(page, 0.5, 0.5)
    kept, drawn = page.app.controls, shown(page)
    page.app.arriving = Face(mei, ("mei",), builtin=True)
    page.frames(3)
    assert page.app.controls == Controls()
    np.testing.assert_array_equal(shown(page), mei.neutral.positions)
    page.key("Z", ctrl=True)
    assert page.app.controls == kept
    np.testing.assert_array_equal(shown(page), drawn)


def test_a_person_who_is_gone_switches_the_page_off_with_a_message(page: Offscreen, kofi: Rig) -> None:
    take(page, kofi)
    put(page, 0.5, 0.0)
    page.app.methods.people.clear()
    page.app.methods.forget()
    page.frames(2)
    assert page.app.controls.off == {"people"}
    assert "People is switched off" in page.app.messages.shown[-1].text
    assert "Kofi" in page.app.messages.shown[-1].text


def test_a_unit_that_somebody_lacks_switches_the_page_off_with_a_message(page: Offscreen, kofi: Rig) -> None:
    shapes = tuple(shape for shape in kofi.shapes if shape.name != "AU12")
    places = [k for k, shape in enumerate(kofi.shapes) if shape.name != "AU12"]
    take(page, replace(kofi, shapes=shapes, deltas=kofi.deltas[places]))
    put(page, 0.5, 0.0)
    units.set_unit(page.app, 12, Sides.both(0.5))
    page.frames(2)
    assert page.app.controls.off == {"people"}
    assert "AU12" in page.app.messages.shown[-1].text


def test_people_whom_no_step_needs_are_let_go(page: Offscreen, ada: Rig, tmp_path: Path) -> None:
    app = page.app
    app.methods.people["Nobody"] = other_person("Nobody", 9, ada)
    folder = save_folder(tmp_path / "Kofi", other_person("Kofi", 1, ada), ("happy",))
    people.ask_files(app, [str(folder)])
    page.until(lambda: app.controls.people.mix is not None)
    assert "Nobody" not in app.methods.people
    assert len(app.methods.people) == 1


def test_undo_holds_few_people() -> None:
    app, history = App(), History()
    app.show(Face(ball_rig(rings=6), ("ball",)))
    for place in range(MOST_PEOPLE + 5):
        mix = PeopleMix({OWN: 1.0}, f"person {place}", 0.5)
        app.controls = Controls(people=PeopleControl(mix))
        history.settle(app.snapshot(), busy=False)
    # Those of the present and of the steps that are left, and the face itself.
    assert len(history.people()) <= MOST_PEOPLE + 2


def test_what_is_exported_and_saved_is_the_mixture(page: Offscreen, kofi: Rig, tmp_path: Path) -> None:
    from PIL import Image

    files.save_picture(page.app, tmp_path / "own.png")
    page.until(lambda: (tmp_path / "own.png").is_file() and not page.app.jobs.running)
    take(page, kofi)
    put(page, 0.8, 0.6)
    files.export_mesh(page.app, tmp_path / "mixed.obj")
    files.save_picture(page.app, tmp_path / "mixed.png")
    page.until(lambda: (tmp_path / "mixed.png").is_file() and not page.app.jobs.running)
    np.testing.assert_allclose(read_mesh(tmp_path / "mixed.obj").positions, shown(page), atol=1e-5)
    own, mixed = (np.asarray(Image.open(tmp_path / name), int) for name in ("own.png", "mixed.png"))
    assert np.abs(own - mixed).max() > 60
    np.testing.assert_array_equal(mixed, page.session.renderer.read())


def test_the_corners_have_pictures_and_then_the_window_sleeps(page: Offscreen, kofi: Rig, mei: Rig) -> None:
    take(page, kofi)
    page.frames(8)
    wanted = page.app.pages.people.wanted
    assert set(wanted) == {(0, 0), (0, 1), (1, 0), (1, 1)}
    assert len({page.app.pages.people.pictures[key] for key in wanted.values()}) == 4
    assert page.session.wants_frame_in() is None
    drag_to(page, 0.5, 0.5)
    assert page.app.pages.people.wanted == wanted
    take(page, mei)
    page.frames(8)
    assert page.app.pages.people.wanted != wanted
    assert page.session.wants_frame_in() is None


def test_a_picture_of_a_corner_does_not_stay_on_the_face(page: Offscreen, kofi: Rig) -> None:
    before = page.session.renderer.read()
    page.frames(6)
    take(page, kofi)
    page.frames(8)
    np.testing.assert_array_equal(page.session.renderer.read(), before)


def test_mixtures_have_short_words(page: Offscreen, kofi: Rig, mei: Rig) -> None:
    app = page.app
    take(page, kofi)
    put(page, 0.4, 0.5)
    assert people.mixture_words(app, people.shares(app)) == "Ada 60 % + Kofi 40 %"
    take(page, mei)
    put(page, 0.5, 0.5)
    assert people.mixture_words(app, people.shares(app)) == "Mei 50 % + Ada 30 % + 1 more"
    assert people.corner_words(app, 1, 1) == ("Mei", "Happy")
    people.choose_target(app, "angry")
    assert people.corner_words(app, 0, 0) == ("Ada 60 % + Kofi 40 %", "Happy 50 %")
    assert app.controls.people.target == state_of("angry")
