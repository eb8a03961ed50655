"""The whole window, drawn without a display and driven by fed events; places are those of 1280 x 800."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facemorph.core.camera import Camera
from facemorph.core.rig import Rig
from facemorph.errors import GraphicsError
from facemorph.ui import actions, files, fonts
from facemorph.ui.commands import MENUS, STATIC, commands
from facemorph.ui.layout import LEAST_SIDE_WIDTH
from facemorph.ui.panels.palette import ranked
from facemorph.ui.settings import Settings
from facemorph.ui.state import Face
from tests.ui.harness import Offscreen, ball_rig

FILE, EXPRESSION, VIEW = (27, 14), (134, 14), (204, 14)
FACE = (450, 380)
SLIDER_START, SLIDER_END = (372, 775), (857, 775)
HAPPY_ROW = (1078, 229)
SEARCH = (1050, 160)


def menu_entry(place: int) -> tuple[int, int]:
    """An entry of an open menu that hangs under the menu bar, without separators above it."""
    return 0, 48 + 25 * place


def choose(window: Offscreen, menu: tuple[int, int], place: int) -> None:
    window.click(*menu)
    window.click(menu[0], menu_entry(place)[1])


def test_happy_is_chosen_and_the_slider_dragged_and_the_face_turned_and_left(window: Offscreen) -> None:
    app = window.app
    app.pose = replace(app.pose, target={"sad": 1.0})
    choose(window, EXPRESSION, 1)
    assert app.pose.target == {"happy": 1.0}
    before = window.pixels_now().copy()
    window.drag(SLIDER_START, (620, 775))
    assert app.pose.t == pytest.approx(0.5, abs=0.03)
    assert app.settings.hint_seen
    moved = np.abs(window.pixels_now().astype(int) - before)[100:600, 100:800].max()
    assert moved > 20
    azimuth = app.camera.azimuth_deg
    window.drag(FACE, (FACE[0] + 100, FACE[1]))
    assert app.camera.azimuth_deg == pytest.approx(azimuth - 100 / app.viewport.height * 220, abs=1.0)
    # Exit is the seventh entry, after three lines.
    window.click(*FILE)
    window.click(30, 246)
    assert app.quit


def test_undo_by_keys_takes_back_a_drag_at_once(window: Offscreen) -> None:
    window.drag(SLIDER_START, (700, 775))
    t = window.app.pose.t
    assert t > 0.5
    window.key("Z", ctrl=True)
    assert window.app.pose.t == 0.0
    window.key("Z", ctrl=True, shift=True)
    assert window.app.pose.t == t


def test_a_shapes_slider_adds_its_shape_and_a_right_click_resets_it(window: Offscreen) -> None:
    window.drag(HAPPY_ROW, (HAPPY_ROW[0] + 70, HAPPY_ROW[1]))
    weight = window.app.pose.weights["happy"]
    assert 0.3 < weight < 0.8
    window.move(*FACE)
    window.frames(2)
    assert window.app.shapes.active == ("happy",)
    window.click(HAPPY_ROW[0] + 30, HAPPY_ROW[1], 1)
    assert window.app.pose.weights == {}


def test_the_list_stays_still_under_the_pointer(window: Offscreen) -> None:
    window.drag(HAPPY_ROW, (HAPPY_ROW[0] + 70, HAPPY_ROW[1]))
    window.frames(3)
    assert window.app.shapes.active == ()


def test_a_double_click_on_a_slider_types_its_value(window: Offscreen) -> None:
    window.double_click(HAPPY_ROW[0] + 60, HAPPY_ROW[1])
    window.frames(2)
    window.type("0.25")
    window.key("enter")
    assert window.app.pose.weights == {"happy": 0.25}
    assert window.app.typing == ""


def test_the_sliders_number_is_typed_and_kept_in_its_range(window: Offscreen) -> None:
    for typed, expected in (("0,4", 0.4), ("7", 1.0), ("-3", 0.0), ("nan", 0.0), ("none", 0.0)):
        window.click(895, 775)
        window.frames(2)
        window.type(typed)
        window.key("enter")
        assert window.app.pose.t == pytest.approx(expected), typed


def test_weights_beyond_the_usual_only_where_asked(window: Offscreen) -> None:
    end = (1279, HAPPY_ROW[1])
    window.drag(HAPPY_ROW, end)
    assert window.app.pose.weights["happy"] == 1.0
    actions.toggle_wide(window.app)
    window.drag((HAPPY_ROW[0] + 60, HAPPY_ROW[1]), end)
    assert window.app.pose.weights["happy"] == 2.0


def test_search_shows_the_shapes_that_hold_the_words(window: Offscreen) -> None:
    window.click(*SEARCH)
    window.type("au1")
    assert window.app.shapes.search == "au1"
    # The first row is now AU1, where Happy was.
    window.drag((HAPPY_ROW[0], HAPPY_ROW[1]), (HAPPY_ROW[0] + 70, HAPPY_ROW[1]))
    assert set(window.app.pose.weights) == {"AU1"}


def test_letters_typed_in_the_search_run_no_command(window: Offscreen) -> None:
    window.click(*SEARCH)
    window.type("w")
    window.key("W")
    window.key("T")
    window.key("Space")
    assert not window.app.look.wire
    assert not window.app.turntable
    assert not window.app.playback.playing


def test_the_switch_takes_the_shapes_out(window: Offscreen) -> None:
    actions.set_weight(window.app, "happy", 1.0)
    window.frames(2)
    with_shape = window.pixels_now().copy()
    actions.toggle_shapes(window.app)
    window.frames(2)
    assert np.abs(window.pixels_now().astype(int) - with_shape)[100:600, 100:800].max() > 20


@pytest.mark.parametrize("start", [(1100, 500), (600, 792), (500, 14), (1062, 157)])
def test_dragging_over_a_panel_moves_no_camera(window: Offscreen, start: tuple[int, int]) -> None:
    camera = window.app.camera
    window.drag(start, FACE)
    window.wheel(0)
    assert window.app.camera == camera
    window.move(*start)
    window.wheel(3)
    assert window.app.camera == camera


def test_a_click_beside_an_open_menu_shuts_it_and_turns_nothing(window: Offscreen) -> None:
    camera = window.app.camera
    window.click(*FILE)
    window.drag(FACE, (FACE[0] + 80, FACE[1]))
    assert window.app.camera == camera


def on_screen(camera: Camera, window: Offscreen, point: np.ndarray) -> np.ndarray:
    clip = camera.clip_from_model(window.app.viewport.aspect) @ np.append(point, 1.0)
    view = window.app.viewport
    x = view.x + (clip[0] / clip[3] * 0.5 + 0.5) * view.width
    y = view.y + (0.5 - clip[1] / clip[3] * 0.5) * view.height
    return np.array([x, y])


def test_the_wheel_zooms_to_the_pointer(window: Offscreen) -> None:
    before = window.app.camera
    window.move(560, 300)
    view = window.app.viewport
    origin, along = before.ray(*view.centred(560, 300))
    on_plane = origin + along * (before.distance / (-along @ before.axes()[2]))
    window.wheel(4)
    after = window.app.camera
    assert after.distance < before.distance * 0.7
    assert on_screen(after, window, on_plane) == pytest.approx([560, 300], abs=0.5)


@pytest.mark.parametrize("how", ["middle", "shift"])
def test_the_face_follows_a_pan(window: Offscreen, how: str) -> None:
    before = window.app.camera
    target = np.array(before.target)
    window.io.add_key_event(imgui.Key.mod_shift, how == "shift")
    window.drag(FACE, (FACE[0] + 60, FACE[1] + 40), button=2 if how == "middle" else 0)
    after = window.app.camera
    assert after.azimuth_deg == before.azimuth_deg
    shift = on_screen(after, window, target) - on_screen(before, window, target)
    assert shift == pytest.approx([60, 40], abs=1.0)


def test_a_double_click_turns_about_the_surface_under_it(window: Offscreen) -> None:
    window.double_click(FACE[0] + 40, FACE[1] - 60)
    window.frames(2)
    target = np.array(window.app.camera.target)
    assert math.hypot(*(target[:2] / (7.5, 10.5))) < 1.0
    assert np.sum((target / (7.5, 10.5, 9.0)) ** 2) == pytest.approx(1.0, abs=0.03)


def test_a_double_click_beside_the_face_changes_nothing(window: Offscreen) -> None:
    camera = window.app.camera
    window.double_click(60, 700)
    assert window.app.camera == camera


def test_every_command_of_the_table_runs(window: Offscreen, tmp_path: Path) -> None:
    app = window.app
    app.settings.recent = [[str(tmp_path / "nowhere")]]
    app.builtins = ("nobody",)
    titles = []
    table = commands(app)
    for command in table:
        if command.title == "Exit":
            continue
        assert command.enabled(app) in (True, False)
        command.run(app)
        window.frames(2)
        titles.append(command.full_title(app))
        app.chooser.purpose, app.palette.open, app.keys_open, app.about_open = "", False, False, False
        window.key("escape")
    assert len(titles) == len(table) - 1
    window.until(lambda: not app.jobs.running)


def test_the_light_is_chosen_in_the_menu_and_kept(window: Offscreen) -> None:
    app = window.app
    assert app.look.light == app.settings.light == "studio"
    before = window.pixels_now().astype(int)
    window.run("Flat light")
    assert app.look.light == app.settings.light == "flat"
    chosen = [c.title for c in commands(app) if c.menu == "View/Lights" and c.checked and c.checked(app)]
    assert chosen == ["Flat light"]
    face = np.abs(window.pixels_now().astype(int) - before)[300:500, 400:800]
    assert face.max() > 20, "the face is drawn in it"


def test_every_command_has_a_place_and_no_two_share_a_key(window: Offscreen) -> None:
    table = commands(window.app)
    keys = [chord for command in table for chord in command.keys]
    assert len(keys) == len(set(keys))
    assert {command.menu.split("/")[0] for command in STATIC} <= {*MENUS, ""}
    assert all(command.menu or command.keys for command in table)


def test_keys_do_what_the_table_says(window: Offscreen) -> None:
    app = window.app
    for place, name in enumerate(("happy", "sad", "angry", "surprised", "disgusted", "afraid"), start=2):
        window.key(str(place))
        assert app.pose.target == {name: 1.0}
    window.key("End")
    assert app.pose.t == 1.0
    window.key("1")
    assert app.pose.target == {}
    assert app.pose.source == {"afraid": 1.0}
    window.key("End")
    window.key("Left")
    assert app.pose.t == pytest.approx(0.99)
    window.key("Left", shift=True)
    assert app.pose.t == pytest.approx(0.89)
    window.key("Home")
    assert app.pose.t == 0.0
    window.key("W")
    assert app.look.wire
    window.key("H")
    assert app.look.shading == "heat"
    window.key("H")
    assert app.look.shading == "skin"
    window.key("Tab")
    assert app.viewport.width == 1280
    window.key("F1")
    assert app.keys_open
    window.key("escape")
    assert not app.keys_open


def test_space_plays_and_pauses(window: Offscreen) -> None:
    window.key("Space")
    assert window.app.playback.playing
    assert window.session.wants_frame_in() == 0.0
    window.frames(30)
    assert 0.2 < window.app.pose.t < 0.6
    window.key("Space")
    t = window.app.pose.t
    window.frames(10)
    assert window.app.pose.t == t


def test_at_rest_nothing_wants_a_frame_and_the_face_is_not_drawn_again(window: Offscreen) -> None:
    window.frames(5)
    drawn = window.session.renderer.stats.frames
    window.move(1230, 84)
    window.frames(5)
    assert window.session.wants_frame_in() is None
    assert window.session.renderer.stats.frames == drawn


def test_the_turntable_turns_and_a_drag_ends_it(window: Offscreen) -> None:
    window.key("T")
    before = window.app.camera.azimuth_deg
    window.frames(30)
    assert window.app.camera.azimuth_deg != before
    window.drag(FACE, (FACE[0] + 30, FACE[1]))
    assert not window.app.turntable


def test_the_palette_finds_a_command_and_runs_it(window: Offscreen) -> None:
    window.key("K", ctrl=True)
    assert window.app.palette.open
    window.type("turnt")
    window.key("enter")
    assert window.app.turntable
    assert not window.app.palette.open


def test_the_palette_ranks_titles_that_begin_so(window: Offscreen) -> None:
    table = commands(window.app)
    assert ranked(table, "sad")[0].title == "Sad"
    assert ranked(table, "heat")[0].title == "Heat map"
    assert ranked(table, "zzz") == []
    assert len(ranked(table, "")) == len(table)


def test_a_folder_is_opened_beside_the_window(window: Offscreen, obj_face: Path) -> None:
    files.open_source(window.app, (str(obj_face),))
    window.until(lambda: window.app.face is not None and window.app.face.rig.names == ("happy",))
    assert window.app.settings.recent == [[str(obj_face)]]
    window.key("Z", ctrl=True)
    assert window.app.face.title == "Ball"
    window.frames(2)


def test_a_bad_file_keeps_the_face_and_tells_why_until_read(window: Offscreen, tmp_path: Path) -> None:
    bad = tmp_path / "bad.obj"
    bad.write_text("v 0 0 0\nf 1 2 3\n")
    face = window.app.face
    files.open_source(window.app, (str(bad),))
    window.until(lambda: bool(window.app.messages.shown))
    window.frames(600)
    (message,) = window.app.messages.shown
    assert message.error
    assert "bad.obj" in message.text
    assert window.app.face is face
    assert window.app.settings.recent == []


def test_a_face_that_cannot_be_drawn_keeps_the_one_before(window: Offscreen, monkeypatch) -> None:
    face, load = window.app.face, window.session.renderer.load

    def refuse(rig: Rig) -> None:
        if rig is not face.rig:
            raise GraphicsError("too large for this OpenGL.")
        load(rig)

    monkeypatch.setattr(window.session.renderer, "load", refuse)
    window.app.arriving = Face(ball_rig(rings=6), ("other",))
    window.frames(3)
    assert window.app.face is face
    assert "too large" in window.app.messages.shown[0].text


def test_the_picture_saved_is_the_face_as_seen(window: Offscreen, tmp_path: Path) -> None:
    from PIL import Image

    files.save_picture(window.app, tmp_path / "face")
    window.until(lambda: (tmp_path / "face.png").exists() and not window.app.jobs.running)
    with Image.open(tmp_path / "face.png") as picture:
        assert picture.size == window.app.viewport.size
    assert "face.png" in window.app.messages.shown[0].text


def test_the_mesh_exported_is_the_morphed_face(window: Offscreen, tmp_path: Path) -> None:
    from facemorph.io import read_mesh

    window.app.pose = replace(window.app.pose, t=0.5)
    files.export_mesh(window.app, tmp_path / "out.obj")
    window.until(lambda: not window.app.jobs.running)
    mesh = read_mesh(tmp_path / "out.obj")
    expected = window.app.face.rig.positions(window.app.pose)
    assert np.abs(mesh.positions - expected).max() < 1e-4


def test_saving_over_a_file_asks_first(window: Offscreen, tmp_path: Path) -> None:
    (tmp_path / "Ball.png").write_bytes(b"mine")
    window.app.settings.last_folder = str(tmp_path)
    window.key("S", ctrl=True)
    window.frames(4)
    assert window.app.chooser.path == str(tmp_path / "Ball.png")
    window.key("enter")
    assert window.app.chooser.replacing
    assert (tmp_path / "Ball.png").read_bytes() == b"mine"


class AnsweredDialog:
    """The desktop's dialog when the user has chosen."""

    def __init__(self, *paths: Path) -> None:
        self.paths = paths

    def answer(self) -> list[str]:
        return [str(path) for path in self.paths]

    def close(self) -> None:
        pass


def test_a_name_that_gets_its_suffix_here_overwrites_nothing_unasked(
    window: Offscreen, tmp_path: Path
) -> None:
    chooser, there = window.app.chooser, tmp_path / "mine.png"
    there.write_bytes(b"mine")
    chooser.purpose, chooser.dialog = "picture", AnsweredDialog(tmp_path / "mine")
    window.frames(4)
    assert (chooser.purpose, chooser.replacing) == ("picture", str(there))
    assert there.read_bytes() == b"mine"
    window.key("enter")
    window.until(lambda: not window.app.jobs.running and not window.app.picture_path)
    assert there.read_bytes() != b"mine"
    # The desktop has asked about this name itself, and about one that is new there is nothing to ask.
    for name in ("mine.png", "new"):
        chooser.purpose, chooser.dialog = "picture", AnsweredDialog(tmp_path / name)
        window.frames(3)
        assert chooser.purpose == ""
    window.until(lambda: (tmp_path / "new.png").exists() and not window.app.jobs.running)


def test_an_entry_clicked_in_the_chooser_goes_into_its_path(window: Offscreen, obj_face: Path) -> None:
    window.app.settings.last_folder = str(obj_face)
    window.key("O", ctrl=True)
    window.frames(4)
    window.click(500, 302)
    window.frames(4)
    assert window.app.chooser.path == str(obj_face / "happy.obj")


def test_the_chooser_opens_what_is_typed(window: Offscreen, obj_face: Path) -> None:
    window.app.settings.last_folder = str(obj_face)
    window.key("O", ctrl=True)
    window.frames(4)
    window.type("happy.obj")
    window.key("enter")
    window.until(lambda: window.app.face is not None and window.app.face.source[0].endswith("happy.obj"))
    assert window.app.chooser.purpose == ""


def test_the_panels_edge_is_pulled(window: Offscreen) -> None:
    edge = 1280 - 376
    window.drag((edge, 400), (edge - 60, 400))
    assert window.app.settings.right_width == pytest.approx(436, abs=4)


def test_the_heat_map_has_a_legend_in_millimetres(window: Offscreen) -> None:
    window.app.pose = replace(window.app.pose, t=1.0)
    window.run("Heat map")
    assert window.app.legend is not None
    assert window.app.legend.unit == "mm"
    moved = np.linalg.norm(window.app.face.rig.deltas[0], axis=1).max()
    assert window.app.legend.high >= moved


def test_light_and_dark_differ_everywhere(window: Offscreen) -> None:
    dark = window.pixels_now().copy()
    window.run("Light theme")
    light = window.pixels_now()
    assert light[790, 300].sum() > dark[790, 300].sum() + 300
    assert light[60, 200].sum() > dark[60, 200].sum() + 200


def test_the_window_is_the_same_at_double_density(opengl: None, rig: Rig) -> None:
    with Offscreen(rig) as once:
        small = once.pixels_now().astype(float)
    with Offscreen(rig, density=2.0) as twice:
        large = twice.pixels_now().astype(float)
    assert large.shape == (1600, 2560, 3)
    halved = large.reshape(800, 2, 1280, 2, 3).mean(axis=(1, 3))
    assert np.abs(halved - small).mean() < 3.0


def test_two_hundred_long_names_fit(opengl: None) -> None:
    names = tuple(f"expression_with_a_very_long_name_that_goes_on_{i}" for i in range(200))
    with Offscreen(ball_rig(names, (), (), rings=4)) as window:
        window.click(*EXPRESSION)
        window.frames(2)
        assert window.app.expressions[-1].name == names[-1]


def test_expressions_without_a_title_or_with_the_same_can_be_chosen(opengl: None) -> None:
    ball = ball_rig(("happy", "sad", "angry"), (), (), rings=4)
    labels = ("", "Twin", "Twin")
    shapes = tuple(replace(shape, label=label) for shape, label in zip(ball.shapes, labels, strict=True))
    with Offscreen(Rig(ball.neutral, shapes, ball.deltas, ball.info)) as window:
        for place, name in enumerate(("happy", "sad", "angry"), start=1):
            choose(window, EXPRESSION, place)
            assert window.app.pose.target == {name: 1.0}
        titles = [c.title for c in commands(window.app) if c.menu == "Expression"]
        assert titles[1] == "happy"


def test_escape_dismisses_the_newest_message_where_nothing_else_takes_it(window: Offscreen) -> None:
    messages = window.app.messages
    for text in ("first", "second"):
        messages.fail(text)
    window.click(*FILE)
    window.key("escape")
    window.key("F1")
    window.key("escape")
    window.click(*SEARCH)
    window.key("escape")
    assert [message.text for message in messages.shown] == ["first", "second"]
    window.key("escape")
    assert [message.text for message in messages.shown] == ["first"]
    window.key("escape")
    assert messages.shown == []


@pytest.mark.parametrize("size", [(1280, 800), (640, 420), (300, 200), (3000, 500)])
def test_a_face_without_shapes_and_no_face_at_all_fit_any_size(opengl: None, size: tuple[int, int]) -> None:
    for rig in (None, ball_rig((), (), (), rings=4)):
        with Offscreen(rig, size, settings=Settings(left_open=True)) as window:
            window.frames(2)
            window.key("Space")
            window.drag((size[0] / 2, size[1] - 10), (size[0] / 2 + 30, size[1] - 10))
            assert window.app.pose.t == 0.0


def test_pictures_of_the_faces_are_made_once_and_kept(opengl: None, tmp_path: Path) -> None:
    from facemorph.resources import builtin_faces

    names = tuple(builtin_faces())[:2]
    if not names:
        pytest.skip("the built-in faces are not baked here")
    kept: list[list[int]] = []
    for _ in range(2):
        with Offscreen(
            None, settings=Settings(left_open=True), thumbnails=tmp_path, builtins=names
        ) as window:
            window.until(lambda shown=window: len(shown.app.face_pictures) == len(names))
        kept.append(sorted(path.stat().st_mtime_ns for path in tmp_path.iterdir()))
    assert len(kept[0]) == len(names)
    assert kept[1] == kept[0]


def test_the_fonts_that_the_window_needs_are_there() -> None:
    assert (fonts.font_folder() / "Roboto" / "Roboto-Regular.ttf").is_file()
    assert (fonts.font_folder() / "Font_Awesome_6_Free-Solid-900.otf").is_file()
    assert fonts.needs_wide_script("笑")
    assert not fonts.needs_wide_script("Tạ Thị Thảo")


def test_digits_are_equally_wide(window: Offscreen) -> None:
    imgui.backends.opengl3_new_frame()
    imgui.new_frame()
    assert len({imgui.calc_text_size(digit * 4).x for digit in "0123456789"}) == 1
    imgui.end_frame()


@pytest.mark.parametrize("page", ["Shapes", "FACS", "Emotion", "People", "Handles", "Regions", "Compare"])
def test_no_buttons_words_are_cut_off_in_the_narrowest_panel(
    page: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn, button = [], imgui.button

    def measured(label: str, *size: object) -> bool:
        pressed = button(label, *size)
        low, high = imgui.get_item_rect_min().x, imgui.get_item_rect_max().x
        edge = imgui.get_window_pos().x + imgui.get_window_width()
        words = imgui.calc_text_size(label, hide_text_after_double_hash=True).x
        drawn.append((label, round(high - low) >= round(words), high <= edge + 0.5))
        return pressed

    with Offscreen(ball_rig(), settings=Settings(right_page=page, right_width=LEAST_SIDE_WIDTH)) as window:
        monkeypatch.setattr(imgui, "button", measured)
        window.frames(3)
    assert [part for part in drawn if not all(part[1:])] == []
    assert len({label for label, *_ in drawn}) > 8


def test_the_first_view_and_the_key_f_show_what_the_face_says(opengl: None) -> None:
    ball = ball_rig()
    framed = replace(ball, info=replace(ball.info, frame=((-7.0, -4.0, -9.0), (7.0, 11.0, 9.0))))
    with Offscreen(framed) as window:
        app = window.app
        first = Camera.of_face(framed, "front", app.views()[0].aspect)
        assert app.camera == first
        assert app.camera.target[1] > 3.0
        window.move(*FACE)
        window.wheel(3)
        assert app.camera != first
        window.key("F")
        assert app.camera == first
        window.run("Left side")
        assert app.camera == Camera.of_face(framed, "left", app.views()[0].aspect)


def test_a_view_that_nobody_moved_is_framed_anew_where_it_gets_narrow(window: Offscreen) -> None:
    app = window.app
    wide = app.camera
    app.settings.right_page, app.lab.compare.split = "Compare", True
    window.frames(3)
    assert app.camera == Camera.of_face(app.face.rig, "front", app.views()[0].aspect)
    assert app.camera.distance > wide.distance
    app.lab.compare.split = False
    window.frames(3)
    assert app.camera == wide
    app.camera = zoomed = wide.zoomed(2.0)
    app.lab.compare.split = True
    window.frames(3)
    assert app.camera == zoomed
