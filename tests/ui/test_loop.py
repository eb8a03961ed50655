"""The real window and its loop: on GLFW's null platform, and once on a real X server.

Each runs in a process of its own: GLFW and ImGui keep one state a process.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest

T = TypeVar("T")
ROOT = Path(__file__).resolve().parent.parent.parent

NULL_WINDOW = '''
import json
from imgui_bundle import imgui
import facemorph.ui.run as program

B = imgui.backends
steps = []

def drive(app, screen):
    """Events as GLFW would hand them to ImGui's backend, one a frame."""
    address = screen.address
    def move(x, y):
        B.glfw_cursor_enter_callback(address, 1)
        B.glfw_cursor_pos_callback(address, x, y)
    def button(down):
        B.glfw_mouse_button_callback(address, 0, int(down), 0)
    def click(x, y):
        yield lambda: move(x, y)
        yield lambda: None
        yield lambda: button(True)
        yield lambda: button(False)
        yield lambda: None
    while app.face is None:
        yield lambda: None
    yield from (lambda: None for _ in range(4))
    yield from click(134, 14)
    yield from click(134, 98)
    yield lambda: move(372, 775)
    yield lambda: None
    yield lambda: button(True)
    for k in range(1, 9):
        yield lambda k=k: move(372 + 40 * k, 775)
    yield lambda: button(False)
    yield lambda: None
    steps.append((dict(app.pose.target), app.pose.t))
    yield lambda: screen.dropped.append(DROPPED)
    while not app.messages.shown:
        yield lambda: None
    steps.append(app.messages.shown[0].text)
    yield from click(27, 14)
    yield from click(30, 246)
    yield from (lambda: None for _ in range(50))

loop = program._loop
def driven(app, session, screen, frames):
    script, frame = drive(app, screen), session.frame
    def next_frame(scale):
        next(script)()
        frame(scale)
    session.frame = next_frame
    loop(app, session, screen, frames)

program._loop = driven
status = program.run_window(SOURCE, {"jawOpen": 0.25}, platform="null")
print(json.dumps([status, *steps]))
'''


def run_python(code: str, environment: dict[str, str], secs: float = 300) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", code],
        env=environment,
        capture_output=True,
        text=True,
        timeout=secs,
        check=False,
    )


@pytest.fixture
def face(tmp_path: Path) -> Path:
    """A folder with a face of its own: neutral, two expressions and jawOpen."""
    from facemorph.io import write_obj
    from tests.ui.harness import ball_rig

    rig = ball_rig(("happy", "sad"), (), ("jawOpen",), rings=8)
    folder = tmp_path / "ball"
    folder.mkdir()
    write_obj(folder / "neutral.obj", rig.neutral)
    for name in rig.names:
        write_obj(folder / f"{name}.obj", rig.posed({name: 1.0}))
    return folder


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    own = {"FACEMORPH_CONFIG_DIR": str(tmp_path / "config"), "FACEMORPH_CACHE_DIR": str(tmp_path / "cache")}
    return {**os.environ, **own, "PYTHONUNBUFFERED": "1"}


def test_the_window_runs_without_a_screen(
    opengl: None, face: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    bad = tmp_path / "bad.obj"
    bad.write_text("v 0 0 0\nf 1 2 3\n")
    code = NULL_WINDOW.replace("SOURCE", repr(str(face))).replace("DROPPED", repr(str(bad)))
    result = run_python(code, environment)
    assert result.returncode == 0, result.stderr
    status, (target, t), told = json.loads(result.stdout.strip().splitlines()[-1])
    assert status == 0
    assert target == {"sad": 1.0}
    assert 0.4 < t < 0.9
    assert "bad.obj" in told
    settings = (tmp_path / "config" / "settings.json").read_text()
    assert str(face) in settings


def test_a_first_face_that_cannot_be_read_ends_with_its_error(
    opengl: None, environment: dict[str, str], tmp_path: Path
) -> None:
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
    code = (
        "import facemorph.ui.run as program; from facemorph.errors import FacemorphError\n"
        f"try: program.run_window({str(tmp_path / 'bad.obj')!r}, {{}}, platform='null')\n"
        "except FacemorphError as error: print(type(error).__name__, error)"
    )
    result = run_python(code, environment)
    assert "bad.obj" in result.stdout, result.stderr


def test_a_weight_nobody_knows_ends_with_its_error(
    opengl: None, face: Path, environment: dict[str, str]
) -> None:
    code = (
        "import facemorph.ui.run as program; from facemorph.errors import UnknownNameError\n"
        f"try: program.run_window({str(face)!r}, {{'hapy': 1.0}}, platform='null')\n"
        "except UnknownNameError as error: print(error)"
    )
    result = run_python(code, environment)
    assert "'happy'" in result.stdout, result.stderr


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="there the screen is not named by a variable")
@pytest.mark.parametrize("display", ["", ":9417"])
def test_no_screen_is_told_in_one_line(environment: dict[str, str], display: str) -> None:
    environment = {**environment, "DISPLAY": display, "WAYLAND_DISPLAY": ""}
    code = (
        "from facemorph.ui import run; from facemorph.errors import DisplayError\n"
        "try: run('ada', {})\nexcept DisplayError as error: print(error)"
    )
    result = run_python(code, environment)
    assert len(result.stdout.strip().splitlines()) == 1, result.stderr
    assert "facemorph render" in result.stdout
    assert result.stderr == ""


MINIMIZED_WINDOW = """
import glfw
import facemorph.ui.run as program
frames, waits, drawn = [0], [0], []
frame, wait = program.window.Window.frame, program.window.Window.wait

def counted_frame(screen, build, app):
    frames[0] += 1
    if frames[0] == 5:
        glfw.iconify_window(screen._handle)
    app.quit = frames[0] == 8
    frame(screen, build, app)

def counted_wait(screen, secs):
    if screen.minimized:
        drawn.append(frames[0])
        if len(drawn) == 6:
            glfw.restore_window(screen._handle)
    return wait(screen, secs)

program.window.Window.frame, program.window.Window.wait = counted_frame, counted_wait
program.run_window(SOURCE, {}, platform="null")
print(drawn, frames[0])
"""


def test_nothing_is_drawn_while_the_window_is_minimised(
    opengl: None, face: Path, environment: dict[str, str]
) -> None:
    result = run_python(MINIMIZED_WINDOW.replace("SOURCE", repr(str(face))), environment)
    assert result.stdout.strip() == "[5, 5, 5, 5, 5, 5] 8", result.stderr


@pytest.mark.parametrize(
    ("platform", "scale", "room", "size"),
    [
        ("linux", 1.5, (1920, 1080), (1280, 720)),
        ("linux", 1.0, (1920, 1080), (1280, 800)),
        ("win32", 2.0, (1920, 1040), (960, 520)),
        ("darwin", 2.0, (1440, 775), (1280, 775)),
    ],
)
def test_the_window_opens_within_a_scaled_screen(
    monkeypatch, platform: str, scale: float, room: tuple[int, int], size: tuple[int, int]
) -> None:
    from facemorph.ui import window

    monkeypatch.setattr(window.sys, "platform", platform)
    monkeypatch.setattr(window.glfw, "get_primary_monitor", object)
    monkeypatch.setattr(window.glfw, "get_monitor_workarea", lambda _: (0, 0, *room))
    monkeypatch.setattr(window.glfw, "get_monitor_content_scale", lambda _: (scale, scale))
    assert window._fitting((1280, 800)) == size


@pytest.fixture
def x_display(environment: dict[str, str]) -> Iterator[str]:
    """An X server of our own on a free number."""
    for program in ("Xvfb", "xdotool"):
        if not shutil.which(program):
            pytest.skip(f"{program} is not installed")
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-noreset", "-nolisten", "tcp", "-screen", "0", "1280x800x24"],
        pass_fds=[writing],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    if not number:
        server.wait()
        pytest.skip("Xvfb does not start here")
    yield f":{number}"
    server.terminate()
    server.wait(10)


X_WINDOW = """
import json
from imgui_bundle import imgui
import facemorph.ui.run as program
frame, seen = program.window.Window.frame, [None]
def told_frame(screen, build, app):
    frame(screen, build, app)
    io = imgui.get_io()
    now = [round(io.mouse_pos.x), round(io.mouse_pos.y), bool(io.mouse_down[0])]
    if now != seen[0]:
        seen[0] = now
        print("mouse", json.dumps(now), flush=True)
program.window.Window.frame = told_frame
loop = program._loop
def watched(app, session, screen, frames):
    loop(app, session, screen, frames)
    print(json.dumps([dict(app.pose.target), app.pose.t, app.camera.azimuth_deg]))
program._loop = watched
print(program.run_window(SOURCE, {}))
"""


@pytest.mark.xwindow
def test_on_a_real_screen_a_face_is_morphed_and_left(
    x_display: str, face: Path, environment: dict[str, str]
) -> None:
    environment = {**environment, "DISPLAY": x_display, "WAYLAND_DISPLAY": ""}

    def x(*words: object) -> str:
        told = subprocess.run(
            ["xdotool", *map(str, words)], env=environment, capture_output=True, text=True, check=False
        )
        return told.stdout.strip()

    code = X_WINDOW.replace("SOURCE", repr(str(face)))
    program = subprocess.Popen(
        [sys.executable, "-c", code],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    lines: list[str] = []
    reader = threading.Thread(target=lambda: lines.extend(iter(program.stdout.readline, "")))
    errors: list[str] = []
    other_reader = threading.Thread(target=lambda: errors.append(program.stderr.read()))
    reader.start()
    other_reader.start()
    try:
        # The face's name comes into the title once it is on show.
        window = wait_for(lambda: x("search", "--onlyvisible", "--name", "ball.*facemorph").split("\n")[-1])

        def does(*words: object, until: list[object]) -> None:
            """One event; the next comes once the window has drawn a frame with it."""
            before = len(lines)
            x(*words)
            told = f"mouse {json.dumps(until)}\n"
            wait_for(lambda: told in lines[max(before - 1, 0) :] or program.poll() is not None)

        def at(place_x: float, place_y: float, down: bool = False) -> None:
            does("mousemove", "--window", window, place_x, place_y, until=[place_x, place_y, down])

        def button(down: bool, place: tuple[float, float]) -> None:
            does("mousedown" if down else "mouseup", 1, until=[*place, down])

        def click(place_x: float, place_y: float) -> None:
            at(place_x, place_y)
            button(True, (place_x, place_y))
            button(False, (place_x, place_y))

        def drag(start: tuple[int, int], end: tuple[int, int]) -> None:
            at(*start)
            button(True, start)
            for k in range(1, 9):
                at(*(a + (b - a) * k // 8 for a, b in zip(start, end, strict=True)), down=True)
            button(False, end)

        click(134, 14)
        click(134, 98)
        drag((372, 775), (640, 775))
        drag((450, 400), (530, 400))
        click(27, 14)
        click(30, 246)
        program.wait(120)
    finally:
        program.kill()
        program.wait()
        reader.join()
        other_reader.join()
    assert program.returncode == 0, errors
    result, status = "".join(lines).strip().splitlines()[-2:]
    assert status == "0"
    target, t, azimuth = json.loads(result)
    assert target == {"sad": 1.0}
    assert 0.3 < t < 0.8
    assert azimuth < -10.0


def wait_for(find: Callable[[], T], secs: float = 180.0) -> T:
    end = time.monotonic() + secs
    while time.monotonic() < end:
        found = find()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError("it never happened")
