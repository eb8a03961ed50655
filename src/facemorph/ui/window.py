"""The window: GLFW, its OpenGL context, ImGui's backends, and the loop that sleeps while nothing happens.

Importing imgui_bundle before glfw makes both use the one GLFW that ships with imgui-bundle; two
copies of the library would not know each other's windows.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from imgui_bundle import imgui  # isort: skip
import glfw

from facemorph.errors import DisplayError, GraphicsError
from facemorph.gl import wrap_window_context
from facemorph.ui import fonts, theme
from facemorph.ui.state import App

TITLE = "facemorph"
# ImGui settles within a few frames (a menu's size is known after one); tooltips wait for a while.
_SETTLING_FRAMES = 3
_TOOLTIP_SECS = 0.8
_SMALLEST = (640, 420)


class Window:
    """An open window with a current OpenGL context (`ctx`) and an ImGui context.

    `platform="null"` opens one without any screen, for tests. Raises `DisplayError` where there is no
    screen, `GraphicsError` where OpenGL 3.3 is missing.
    """

    def __init__(self, size: tuple[int, int], *, maximized: bool = False, platform: str = "") -> None:
        glfw.ERROR_REPORTING = "ignore"
        self._null = platform == "null"
        _start_glfw(platform)
        try:
            self._handle = _new_window(size, maximized, null=platform == "null")
        except GraphicsError:
            glfw.terminate()
            raise
        self.dropped: list[str] = []
        glfw.make_context_current(self._handle)
        glfw.swap_interval(0 if platform == "null" else 1)
        self.ctx = wrap_window_context()
        # ImGui's backend calls on to callbacks that were there before it.
        glfw.set_drop_callback(self._handle, self._drop)  # type: ignore[arg-type]
        imgui.create_context()
        io = imgui.get_io()
        io.set_ini_filename("")
        io.config_input_text_cursor_blink = False
        fonts.add_fonts()
        self.address = ctypes.cast(self._handle, ctypes.c_void_p).value or 0
        imgui.backends.glfw_init_for_opengl(self.address, True)
        imgui.backends.opengl3_init("#version 330")

    def _drop(self, _window: Any, paths: list[str]) -> None:
        self.dropped.extend(paths)

    @property
    def scale(self) -> float:
        """The interface's units in a pixel at scale 1: the screen's scale, less what the system does."""
        content = max(glfw.get_window_content_scale(self._handle)[0], 0.5)
        size, pixels = glfw.get_window_size(self._handle), glfw.get_framebuffer_size(self._handle)
        ratio = pixels[0] / size[0] if size[0] else 1.0
        return max(content / max(ratio, 0.1), 0.5)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in unscaled pixels, as it is remembered."""
        width, height = glfw.get_window_size(self._handle)
        return round(width / self.scale), round(height / self.scale)

    @property
    def maximized(self) -> bool:
        """Whether it fills the screen."""
        return bool(glfw.get_window_attrib(self._handle, glfw.MAXIMIZED))

    @property
    def minimized(self) -> bool:
        """Whether it is out of sight; there is nothing to draw then."""
        return bool(glfw.get_window_attrib(self._handle, glfw.ICONIFIED))

    def show(self) -> None:
        """Bring it up; it was made hidden so that nobody sees it empty."""
        glfw.show_window(self._handle)

    def title(self, text: str) -> None:
        """Put a face's name in the title bar."""
        glfw.set_window_title(self._handle, text)

    def wants_to_close(self) -> bool:
        """The user pressed its cross."""
        return bool(glfw.window_should_close(self._handle))

    def frame(self, build: Callable[[float], None], app: App) -> None:
        """Draw one frame; `build(scale)` makes it up to, without, `imgui.render`."""
        imgui.backends.opengl3_new_frame()
        imgui.backends.glfw_new_frame()
        build(self.scale)
        imgui.render()
        width, height = glfw.get_framebuffer_size(self._handle)
        self.ctx.screen.use()
        self.ctx.screen.viewport = (0, 0, width, height)
        self.ctx.screen.clear(*theme.THEMES[app.settings.theme].backdrop)
        imgui.backends.opengl3_render_draw_data(imgui.get_draw_data())
        glfw.swap_buffers(self._handle)

    def wait(self, secs: float | None) -> bool:
        """Take in events: at once for 0, else sleep until one comes or `secs` are over; True if one came."""
        began = time.monotonic()
        if self._null and secs != 0.0:
            # That platform has no events of its own and returns at once; here it sleeps a little.
            time.sleep(0.02 if secs is None else min(secs, 0.02))
            glfw.poll_events()
            return False
        if secs is None:
            glfw.wait_events()
            return True
        if secs > 0.0:
            glfw.wait_events_timeout(secs)
            return time.monotonic() - began < secs * 0.9
        glfw.poll_events()
        return False

    def close(self) -> None:
        """Shut it and give everything back."""
        imgui.backends.opengl3_shutdown()
        imgui.backends.glfw_shutdown()
        imgui.destroy_context()
        glfw.destroy_window(self._handle)
        glfw.terminate()


def wake() -> None:
    """End a `wait` from any thread."""
    glfw.post_empty_event()


def hand_is_on() -> bool:
    """Whether the frame just built took in a mouse or key that is moving or held."""
    io = imgui.get_io()
    moved = bool(io.mouse_delta.x or io.mouse_delta.y or io.mouse_wheel)
    return moved or imgui.is_any_mouse_down() or imgui.is_any_item_active()


class Awake:
    """How long to go on drawing after something happened."""

    def __init__(self) -> None:
        self._frames = _SETTLING_FRAMES
        self._until_secs = 0.0

    def wait_secs(self, wanted: float | None) -> float | None:
        """How long to sleep now, given what the session wants (`Session.wants_frame_in`)."""
        if self._frames > 0:
            self._frames -= 1
            return 0.0
        left = self._until_secs - time.monotonic()
        soon = 0.15 if left > 0.0 else None
        return soon if wanted is None else wanted if soon is None else min(wanted, soon)

    def happened(self) -> None:
        """The user did something."""
        self._frames = _SETTLING_FRAMES
        self._until_secs = time.monotonic() + _TOOLTIP_SECS


def _start_glfw(platform: str) -> None:
    if platform == "null":
        glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL)
    elif _no_display():
        raise DisplayError(
            "there is no display to open a window on (neither DISPLAY nor WAYLAND_DISPLAY is set). "
            "facemorph render makes pictures without one."
        )
    with _quiet():
        started = glfw.init()
    if not started:
        raise DisplayError(
            f"no window can be opened here: {_reason()}. facemorph render makes pictures without one."
        )


def _no_display() -> bool:
    linux = sys.platform not in ("win32", "darwin")
    return linux and not os.environ.get("DISPLAY") and not os.environ.get("WAYLAND_DISPLAY")


def _new_window(size: tuple[int, int], maximized: bool, *, null: bool) -> Any:
    glfw.default_window_hints()
    if null:
        glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.EGL_CONTEXT_API)
    glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
    glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
    glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
    glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
    glfw.window_hint(glfw.SCALE_TO_MONITOR, True)
    glfw.window_hint(glfw.VISIBLE, False)
    glfw.window_hint(glfw.MAXIMIZED, maximized)
    glfw.window_hint_string(glfw.X11_CLASS_NAME, TITLE)
    glfw.window_hint_string(glfw.X11_INSTANCE_NAME, TITLE)
    width, height = _fitting(size)
    with _quiet():
        handle = glfw.create_window(width, height, TITLE, None, None)
    if not handle:
        raise GraphicsError(
            f"no window with OpenGL 3.3 can be opened: {_reason()}. facemorph doctor says more."
        )
    # The null platform takes "no upper limit" for a limit.
    if not null:
        scale = _scale_of_sizes()
        width, height = (round(side * scale) for side in _fitting(_SMALLEST))
        glfw.set_window_size_limits(handle, width, height, glfw.DONT_CARE, glfw.DONT_CARE)
    return handle


def _fitting(size: tuple[int, int]) -> tuple[int, int]:
    """A remembered size in unscaled pixels, no larger than the screen is now."""
    monitor = glfw.get_primary_monitor()
    if not monitor:
        return size
    _, _, *room = glfw.get_monitor_workarea(monitor)
    # GLFW gives macOS's screens in unscaled units; elsewhere in pixels, which SCALE_TO_MONITOR has in mind.
    scale = 1.0 if sys.platform == "darwin" else max(glfw.get_monitor_content_scale(monitor)[0], 0.5)
    width, height = (
        min(side, int(most / scale)) if most else side for side, most in zip(size, room, strict=True)
    )
    return width, height


def _scale_of_sizes() -> float:
    """How many of GLFW's units of a window's size an unscaled pixel takes, on the screen it opens on."""
    monitor = glfw.get_primary_monitor()
    if not monitor or glfw.get_platform() not in (glfw.PLATFORM_X11, glfw.PLATFORM_WIN32):
        return 1.0
    return max(glfw.get_monitor_content_scale(monitor)[0], 0.5)


def _reason() -> str:
    _, description = glfw.get_error()
    if isinstance(description, bytes):
        description = description.decode("utf-8", "replace")
    return description or "GLFW gives no reason"


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """GLFW's Python layer warns about errors that are told here in one line."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield
