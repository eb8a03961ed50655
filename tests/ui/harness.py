"""The whole window without a window: an ImGui context on an EGL framebuffer, driven by fed events.

    with Offscreen(rig) as window:
        window.click(*window.menu("Expression"))
        window.picture("menu.png")

`Offscreen` runs the same `Session` as the real window, with the same renderer; only GLFW is missing.
"""

from __future__ import annotations

from pathlib import Path
from types import TracebackType

import numpy as np
from imgui_bundle import imgui

from facemorph.core.mesh import Mesh
from facemorph.core.rig import FaceInfo, Rig, Shape, plain_label
from facemorph.gl import Renderer, create_context
from facemorph.ui import fonts, theme
from facemorph.ui.session import Session
from facemorph.ui.settings import Settings
from facemorph.ui.state import App, Face
from facemorph.ui.thumbnails import Thumbnails

EXPRESSIONS = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")


def ball_rig(
    expressions: tuple[str, ...] = EXPRESSIONS,
    facs: tuple[str, ...] = ("AU1", "AU2", "AU12"),
    arkit: tuple[str, ...] = ("jawOpen", "mouthSmileLeft"),
    *,
    name: str = "Ball",
    rings: int = 24,
) -> Rig:
    """A head-sized ball (cm) whose shapes each push out a bump at a place of their own."""
    positions, triangles = _ball(rings)
    names = (
        [(n, "expression") for n in expressions] + [(n, "facs") for n in facs] + [(n, "arkit") for n in arkit]
    )
    shapes = tuple(Shape(n, plain_label(n), s) for n, s in names)
    random = np.random.default_rng(7)
    deltas = np.zeros((len(shapes), len(positions), 3), np.float32)
    for k in range(len(shapes)):
        centre = random.normal(size=3) * (1, 1, 0.2) + (0, 0, 1.2)
        centre *= 9.0 / np.linalg.norm(centre)
        near = np.exp(-(((positions - centre) / 3.0) ** 2).sum(axis=1))
        deltas[k] = (positions / 9.0) * near[:, None] * 3.5
    return Rig(Mesh.from_triangles(positions, triangles), shapes, deltas, FaceInfo(name, unit="cm"))


def _ball(rings: int) -> tuple[np.ndarray, np.ndarray]:
    around = 2 * rings
    u, v = np.meshgrid(np.arange(around) / around * 2 * np.pi, np.linspace(0.0, np.pi, rings + 1))
    points = np.stack([np.sin(v) * np.sin(u), np.cos(v), np.sin(v) * np.cos(u)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(rings))
    a, b = j * around + i, j * around + (i + 1) % around
    quads = np.stack([a, a + around, b + around, b], axis=-1).reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return (points * (7.5, 10.5, 9.0)).astype(np.float32), triangles.astype(np.int32)


class Clock:
    """A clock that runs only when a frame is drawn."""

    def __init__(self) -> None:
        self.secs = 1000.0

    def __call__(self) -> float:
        return self.secs


class Offscreen:
    """A window's contents at `size` units; `density` pixels a unit, `scale` units a pixel at scale 1."""

    def __init__(
        self,
        rig: Rig | None = None,
        size: tuple[int, int] = (1280, 800),
        *,
        density: float = 1.0,
        scale: float = 1.0,
        settings: Settings | None = None,
        thumbnails: Path | None = None,
        **state: object,
    ) -> None:
        self.size, self.scale = size, scale
        self.pixels = (round(size[0] * density), round(size[1] * density))
        self.ctx = create_context()
        self.ctx.__enter__()
        imgui.create_context()
        self.io = imgui.get_io()
        self.io.set_ini_filename("")
        self.io.display_size = size
        self.io.display_framebuffer_scale = (density, density)
        self.io.delta_time = 1 / 60
        # One event a frame would make a fed click last for several.
        self.io.config_input_trickle_event_queue = False
        fonts.add_fonts()
        imgui.backends.opengl3_init("#version 330")
        self.framebuffer = self.ctx.simple_framebuffer(self.pixels, 4)
        self.clock = Clock()
        self.app = App(settings=settings or Settings(), **state)
        self.app.messages.clock = self.clock
        pictures = Thumbnails(self.ctx, thumbnails) if thumbnails else None
        self.session = Session(self.app, Renderer(self.ctx), pictures, self.clock)
        self.face = None
        if rig is not None:
            self.app.arriving = Face(rig, (rig.info.name,), builtin=True)
        self.frames(3)

    def frame(self) -> None:
        """Draw one frame."""
        self.clock.secs += self.io.delta_time
        imgui.backends.opengl3_new_frame()
        self.session.frame(self.scale)
        imgui.render()
        self.framebuffer.use()
        self.framebuffer.clear(*theme.THEMES[self.app.settings.theme].backdrop)
        imgui.backends.opengl3_render_draw_data(imgui.get_draw_data())

    def frames(self, count: int = 2) -> None:
        """Draw several frames."""
        for _ in range(count):
            self.frame()

    def until(self, condition, most: int = 2000) -> None:
        """Draw frames until something has happened; fails if it never does."""
        import time

        for _ in range(most):
            self.frame()
            if condition():
                return
            time.sleep(0.005)
        raise AssertionError("it never happened")

    def move(self, x: float, y: float) -> None:
        """Move the pointer."""
        self.io.add_mouse_pos_event(x, y)
        self.frame()

    def press(self, button: int = 0) -> None:
        """Press a mouse button."""
        self.io.add_mouse_button_event(button, True)
        self.frame()

    def release(self, button: int = 0) -> None:
        """Let a mouse button go."""
        self.io.add_mouse_button_event(button, False)
        self.frame()

    def click(self, x: float, y: float, button: int = 0) -> None:
        """Click at a place."""
        self.move(x, y)
        self.frame()
        self.press(button)
        self.release(button)
        self.frame()

    def double_click(self, x: float, y: float) -> None:
        """Click twice at a place."""
        self.move(x, y)
        for _ in range(2):
            self.press()
            self.release()
        self.frame()

    def drag(
        self, start: tuple[float, float], end: tuple[float, float], button: int = 0, steps: int = 8
    ) -> None:
        """Press at one place, let go at another."""
        self.move(*start)
        self.frame()
        self.press(button)
        for step in range(1, steps + 1):
            part = step / steps
            self.move(start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part)
        self.release(button)
        self.frame()

    def wheel(self, notches: float) -> None:
        """Turn the wheel where the pointer is."""
        self.io.add_mouse_wheel_event(0.0, notches)
        self.frame()

    def key(self, name: str, *, ctrl: bool = False, shift: bool = False) -> None:
        """Press and let go a key."""
        from facemorph.ui.hotkeys import imgui_key

        key = (
            getattr(imgui.Key, name, None)
            if name in ("enter", "escape", "down_arrow", "up_arrow")
            else imgui_key(name)
        )
        held = [mod for mod, down in ((imgui.Key.mod_ctrl, ctrl), (imgui.Key.mod_shift, shift)) if down]
        for down in (True, False):
            for mod in held:
                self.io.add_key_event(mod, down)
            self.io.add_key_event(key, down)
            self.frame()
        self.frame()

    def type(self, text: str) -> None:
        """Type into what has the keyboard."""
        self.io.add_input_characters_utf8(text)
        self.frames(2)

    def run(self, title: str) -> None:
        """Run a command of the table by its title."""
        from facemorph.ui.commands import commands

        command = next(c for c in commands(self.app) if c.title == title)
        command.run(self.app)
        self.frames(2)

    def pixels_now(self) -> np.ndarray:
        """The window's picture, (H, W, 3) uint8, top row first."""
        width, height = self.pixels
        data = self.framebuffer.read(components=3, alignment=1)
        return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]

    def picture(self, path: Path | str) -> None:
        """Save the window's picture."""
        from PIL import Image

        Image.fromarray(np.ascontiguousarray(self.pixels_now())).save(path)

    def close(self) -> None:
        """Give everything back."""
        self.session.close()
        imgui.backends.opengl3_shutdown()
        imgui.destroy_context()
        self.framebuffer.release()
        self.ctx.__exit__(None, None, None)
        self.ctx.release()

    def __enter__(self) -> Offscreen:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
