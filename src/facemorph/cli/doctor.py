"""`facemorph doctor`: versions, ways to draw, whether a window can open, where things are kept."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Iterator
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from facemorph import __version__
from facemorph.resources import builtin_faces, data_folder

PACKAGES = ("numpy", "moderngl", "glfw", "imgui-bundle", "trimesh", "pillow", "platformdirs")


def examination() -> dict[str, Any]:
    """Everything that is worth knowing when something does not work, ready for JSON."""
    from facemorph.gl.doctor import examine

    graphics = examine()
    return {
        "facemorph": __version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "packages": {name: _version(name) for name in PACKAGES},
        "can_draw": graphics.works,
        "contexts": [
            {
                "way": finding.way,
                "works": finding.works,
                "problem": finding.problem,
                "graphics": asdict(finding.graphics) if finding.graphics else None,
            }
            for finding in graphics.findings
        ],
        "hint": graphics.hint,
        "display": _display(),
        "faces": list(builtin_faces()),
        "faces_folder": str(data_folder("faces")),
        "shaders": data_folder("shaders").is_dir(),
    }


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _display() -> str:
    """The screen a window would open on; empty where there is none."""
    if sys.platform in ("darwin", "win32"):
        return sys.platform
    return os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY") or ""


def in_lines(facts: dict[str, Any]) -> Iterator[str]:
    """The examination in plain words, one finding a line."""
    yield f"facemorph {facts['facemorph']}, Python {facts['python']}, {facts['system']}"
    yield "packages: " + ", ".join(
        f"{name} {found or 'MISSING'}" for name, found in facts["packages"].items()
    )
    for context in facts["contexts"]:
        yield f"OpenGL by {context['way']}: {_context_words(context)}"
    if facts["hint"]:
        yield f"to do: {facts['hint']}"
    if facts["display"]:
        yield f"window: a display is there ({facts['display']})"
    else:
        yield "window: no display here (DISPLAY and WAYLAND_DISPLAY are not set); pictures need none"
    faces = ", ".join(facts["faces"]) or "MISSING"
    yield f"built-in faces: {faces} (in {facts['faces_folder']})"
    if not facts["shaders"]:
        yield "shaders: MISSING; install facemorph again"


def _context_words(context: dict[str, Any]) -> str:
    graphics = context["graphics"]
    if not context["works"]:
        return f"does not work: {context['problem']}"
    kind = "software" if graphics["software"] else "hardware"
    return f"works; {graphics['renderer']}, {graphics['version']} ({kind})"
