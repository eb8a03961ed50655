"""Where the shaders and the built-in faces are: at the checkout's top, or inside the package in a wheel."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from facemorph.errors import UnknownNameError

_PACKAGE = Path(__file__).resolve().parent


def data_folder(name: str) -> Path:
    """The folder of bundled data called `name`: `shaders` or `faces`."""
    bundled = _PACKAGE / "_data" / name
    if bundled.is_dir():
        return bundled
    checkout = _PACKAGE.parent.parent
    return checkout / "assets" / "faces" if name == "faces" else checkout / name


def text_font() -> Path | None:
    """The font of the window, Roboto, as imgui-bundle carries it; found without importing that."""
    found = importlib.util.find_spec("imgui_bundle")
    if found is None or found.origin is None:
        return None
    path = Path(found.origin).parent / "assets" / "fonts" / "Roboto" / "Roboto-Regular.ttf"
    return path if path.is_file() else None


def builtin_faces() -> dict[str, Path]:
    """The built-in faces: id -> folder, in alphabetical order."""
    root = data_folder("faces")
    if not root.is_dir():
        return {}
    return {entry.name: entry for entry in sorted(root.iterdir()) if (entry / "face.toml").is_file()}


def builtin_face(name: str) -> Path:
    """The folder of the built-in face `name`. Raises `UnknownNameError` naming those there are."""
    faces = builtin_faces()
    if name not in faces:
        raise UnknownNameError("built-in face", name, faces)
    return faces[name]
