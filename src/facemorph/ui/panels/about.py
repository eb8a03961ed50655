"""Help > About: what this is, what draws it, and whose work is in it."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

from imgui_bundle import ImVec2, imgui

from facemorph import __version__
from facemorph.ui.layout import Layout
from facemorph.ui.panels.frame import begin_page, end_page
from facemorph.ui.state import App
from facemorph.ui.widgets import unit

_PACKAGES = ("moderngl", "glfw", "imgui-bundle", "numpy", "trimesh", "pillow")
CREDITS = (
    "Method: Tạ Thị Thảo, Representing 3D face states by interpolation, VNU Hanoi, 2016.",
    "Type: Roboto (Apache License 2.0). Symbols: Font Awesome Free (SIL OFL 1.1). "
    "Both as shipped with Dear ImGui Bundle.",
    "facemorph is free software under the MIT licence.",
)


def draw(app: App, layout: Layout) -> None:
    """The page, where it is open."""
    if not app.about_open:
        return
    app.about_open = begin_page(app, "About facemorph", 560 * unit(), layout)
    imgui.push_text_wrap_pos(0.0)
    imgui.text_unformatted(f"facemorph {__version__}: view, morph and export 3D facial expressions.")
    imgui.dummy(ImVec2(0, 4 * unit()))
    for line in facts(app):
        imgui.text_disabled(line)
    imgui.dummy(ImVec2(0, 4 * unit()))
    for line in (*face_credits(app), *CREDITS):
        imgui.text_unformatted(line)
    imgui.pop_text_wrap_pos()
    imgui.dummy(ImVec2(0, 4 * unit()))
    if imgui.button("Copy"):
        imgui.set_clipboard_text("\n".join((f"facemorph {__version__}", *facts(app))))
    end_page()


def facts(app: App) -> tuple[str, ...]:
    """What a report of a fault needs: system, OpenGL, versions."""
    drawn = tuple(_sentence(line) for line in app.graphics.lines()) if app.graphics else ()
    system = f"Python {platform.python_version()} on {platform.system()} {platform.release()}"
    return (*drawn, system, ", ".join(f"{name} {_version(name)}" for name in _PACKAGES))


def face_credits(app: App) -> tuple[str, ...]:
    """Whose face it is, as its folder says."""
    if app.face is None:
        return ()
    info = app.face.rig.info
    words = [part for part in (info.credit, f"licence {info.licence}" if info.licence else "") if part]
    return (f"Face {info.name}: {', '.join(words)}.",) if words else ()


def _sentence(line: str) -> str:
    return line[:1].upper() + line[1:]


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "?"
