"""The desktop's own file dialogs, where it has some: asked without stopping the window."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

from facemorph.ui.files import MESH_SUFFIXES

_HELPERS = ("zenity", "kdialog", "matedialog", "qarma")
TITLES = {
    "open": "Open face",
    "folder": "Open face folder",
    "picture": "Save picture",
    "mesh": "Export mesh",
    "open points": "Open points",
    "save points": "Save points",
    "person": "Another face",
    "person folder": "Folder of another face",
    "open regions": "Open regions",
    "save regions": "Save regions",
    "open path": "Open path",
    "save path": "Save path",
}


def available() -> bool:
    """Whether the desktop can ask. Without a helper the library answers with nothing, in silence."""
    if sys.platform in ("win32", "darwin"):
        return True
    return any(shutil.which(helper) for helper in _HELPERS)


class NativeDialog:
    """One dialog on show; `answer` is None until the user has chosen or left."""

    def __init__(self, purpose: str, path: Path) -> None:
        from imgui_bundle import portable_file_dialogs as pfd

        self.purpose = purpose
        title = TITLES[purpose]
        meshes = ["Meshes", " ".join(f"*{suffix}" for suffix in MESH_SUFFIXES), "All files", "*"]
        self._dialog: Any
        kinds = {
            "picture": ["PNG pictures", "*.png"],
            "mesh": ["OBJ meshes", "*.obj"],
            "points": ["Points", "*.json"],
            "regions": ["Regions", "*.npz"],
            "path": ["Paths", "*.json"],
        }
        action, _, what = purpose.rpartition(" ")
        if action == "open":
            self._dialog = pfd.open_file(title, str(path.parent), kinds[what], pfd.opt.none)
        elif purpose in ("open", "person"):
            self._dialog = pfd.open_file(title, str(path.parent), meshes, pfd.opt.multiselect)
        elif purpose in ("folder", "person folder"):
            self._dialog = pfd.select_folder(title, str(path.parent))
        else:
            self._dialog = pfd.save_file(title, str(path), kinds[what])

    def answer(self) -> list[str] | None:
        """What was chosen, [] if nothing, None while the dialog is open."""
        if not self._dialog.ready(0):
            return None
        result = self._dialog.result()
        if isinstance(result, str):
            return [result] if result else []
        return list(result)

    def close(self) -> None:
        """Take the dialog away; the window is being shut."""
        if not self._dialog.ready(0):
            self._dialog.kill()
