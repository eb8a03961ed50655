"""An OpenGL context by OSMesa, Mesa's off-screen library: it needs no display, no EGL and no device."""

from __future__ import annotations

import ctypes
import ctypes.util
from types import TracebackType

_RGBA = 0x1908
_UNSIGNED_BYTE = 0x1401
# Attribute names of OSMesaCreateContextAttribs (GL/osmesa.h).
_FORMAT, _DEPTH_BITS, _PROFILE, _CORE_PROFILE = 0x22, 0x30, 0x33, 0x34
_MAJOR_VERSION, _MINOR_VERSION = 0x36, 0x37
_LIBRARIES = ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.dylib", "osmesa.dll")


class OSMesaContext:
    """A GL 3.3 core context that moderngl can load its functions from.

    It offers what moderngl asks of a context: `load_opengl_function`, entering and leaving to make it
    current, and `release`. Raises `OSError` when the library or such a context cannot be had.
    """

    def __init__(self) -> None:
        self._library = _library()
        self._library.OSMesaCreateContextAttribs.restype = ctypes.c_void_p
        self._library.OSMesaGetProcAddress.restype = ctypes.c_void_p
        self._library.OSMesaGetCurrentContext.restype = ctypes.c_void_p
        wanted = [_FORMAT, _RGBA, _DEPTH_BITS, 0, _PROFILE, _CORE_PROFILE]
        wanted += [_MAJOR_VERSION, 3, _MINOR_VERSION, 3]
        attributes = (ctypes.c_int * (len(wanted) + 1))(*wanted, 0)
        self._context = self._library.OSMesaCreateContextAttribs(attributes, None)
        if not self._context:
            raise OSError("OSMesa makes no OpenGL 3.3 core context")
        # Everything is drawn into framebuffers of our own; OSMesa only insists on having one to bind.
        self._pixels = (ctypes.c_ubyte * (4 * 4 * 4))()
        self._make_current()

    def _make_current(self) -> None:
        made = self._library.OSMesaMakeCurrent(
            ctypes.c_void_p(self._context), ctypes.byref(self._pixels), _UNSIGNED_BYTE, 4, 4
        )
        if not made:
            raise OSError("OSMesa cannot make its context current")

    def load_opengl_function(self, name: str) -> int:
        """The address of the GL function `name`, or 0."""
        return self._library.OSMesaGetProcAddress(name.encode()) or 0

    # moderngl 5 asks for the function by this name.
    load = load_opengl_function

    def __enter__(self) -> OSMesaContext:
        if self._library.OSMesaGetCurrentContext() != self._context:
            self._make_current()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None = None,
        error: BaseException | None = None,
        trace: TracebackType | None = None,
    ) -> None:
        # moderngl leaves without saying why, hence the defaults.
        return None

    def release(self) -> None:
        """Give the context back; nothing can be drawn with it afterwards."""
        if self._context:
            self._library.OSMesaDestroyContext(ctypes.c_void_p(self._context))
            self._context = None


def _library() -> ctypes.CDLL:
    found = ctypes.util.find_library("OSMesa")
    for name in (*_LIBRARIES, *((found,) if found else ())):
        try:
            return ctypes.CDLL(name)
        except OSError:
            continue
    raise OSError("the library OSMesa is not installed")
