"""OpenGL contexts: one of our own for pictures, or the one that a window has made current.

A context is tried in several ways because each fails somewhere: EGL is the way without a display on
Linux, its libraries have their plain names only where the development packages are; OSMesa needs
nothing but its library; macOS and Windows have ways of their own, which moderngl finds.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facemorph.errors import GraphicsError

if TYPE_CHECKING:
    import moderngl

FORCE = "FACEMORPH_GL"
INSTALL = {
    "Debian, Ubuntu": "apt install libegl1 libgl1 libgl1-mesa-dri (or libosmesa6)",
    "Fedora": "dnf install mesa-libEGL mesa-libGL mesa-dri-drivers (or mesa-libOSMesa)",
    "Arch": "pacman -S mesa libglvnd",
    "macOS": "nothing to install; OpenGL comes with the system",
    "Windows": "the graphics card's driver (OpenGL 3.3 or newer)",
}


@dataclass(frozen=True)
class Way:
    """One way to a context: a name for people, the word that `FACEMORPH_GL` knows it by, and how."""

    name: str
    key: str
    make: Callable[[], moderngl.Context]


def ways() -> tuple[Way, ...]:
    """Every way to a context without a window on this system, in the order they are tried."""
    osmesa = Way("OSMesa", "osmesa", _osmesa)
    if sys.platform.startswith("linux"):
        return (Way("EGL", "egl", _egl), Way("EGL by libEGL.so.1", "egl", _egl_by_version), osmesa)
    if sys.platform == "darwin":
        return (Way("CGL", "native", _native), osmesa)
    if sys.platform == "win32":
        return (Way("WGL", "native", _native), osmesa)
    return (Way("EGL", "egl", _egl), Way("the system's own", "native", _native), osmesa)


def create_context() -> moderngl.Context:
    """A context of our own, with no window: EGL, then OSMesa (CGL on macOS, WGL on Windows).

    The environment variable FACEMORPH_GL takes one way only: `egl`, `osmesa`, or `native`.
    Raises `GraphicsError` saying what was tried and what to install.
    """
    tried: list[str] = []
    for way in _chosen_ways():
        try:
            return attempt(way)
        except GraphicsError as error:
            tried.append(str(error))
    raise GraphicsError(f"no OpenGL 3.3 context; tried {'; '.join(tried)}. {install_hint()}")


def attempt(way: Way) -> moderngl.Context:
    """A context made that way and no other. Raises `GraphicsError` saying why not."""
    with _quiet_library_output():
        try:
            return way.make()
        except Exception as error:  # glcontext raises Exception itself
            raise GraphicsError(f"{way.name} ({_first_line(error)})") from error


def wrap_window_context() -> moderngl.Context:
    """The context that a window has made current in this thread. Raises `GraphicsError`."""
    import moderngl

    try:
        return moderngl.create_context(require=330)
    except Exception as error:
        raise GraphicsError(
            f"the window's OpenGL is missing or older than 3.3 ({_first_line(error)}). {install_hint()}"
        ) from error


def install_hint() -> str:
    """One line that says what to install for OpenGL, for each system."""
    return "What to install: " + "; ".join(f"{system}: {what}" for system, what in INSTALL.items()) + "."


def _chosen_ways() -> tuple[Way, ...]:
    wanted = os.environ.get(FORCE, "").strip().lower()
    if not wanted:
        return ways()
    chosen = tuple(way for way in ways() if way.key == wanted)
    if not chosen:
        known = ", ".join(dict.fromkeys(way.key for way in ways()))
        raise GraphicsError(f"{FORCE} is {wanted!r}; this system knows: {known}.")
    return chosen


def _egl() -> moderngl.Context:
    return _made(standalone=True, backend="egl")


def _egl_by_version() -> moderngl.Context:
    return _made(standalone=True, backend="egl", libegl="libEGL.so.1", libgl="libGL.so.1")


def _native() -> moderngl.Context:
    return _made(standalone=True)


def _osmesa() -> moderngl.Context:
    from facemorph.gl.osmesa import OSMesaContext

    return _made(context=OSMesaContext())


def _made(**settings: Any) -> moderngl.Context:
    import moderngl

    return moderngl.create_context(require=330, **settings)


def _first_line(error: BaseException) -> str:
    lines = str(error).strip().splitlines()
    return lines[0].strip() if lines else type(error).__name__


@contextlib.contextmanager
def _quiet_library_output() -> Iterator[None]:
    """Mesa and libEGL warn on the standard error of the process; a failed try is told by us instead."""
    try:
        error_file = sys.stderr.fileno()
        kept = os.dup(error_file)
    except (OSError, ValueError, AttributeError):
        yield
        return
    try:
        with Path(os.devnull).open("wb") as nowhere:
            os.dup2(nowhere.fileno(), error_file)
        yield
    finally:
        os.dup2(kept, error_file)
        os.close(kept)
