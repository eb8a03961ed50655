"""The desktop's own file dialogs, where it has some: asked without stopping the window."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

from facemorph.ui.purposes import Purpose

_HELPERS = ("zenity", "kdialog", "matedialog", "qarma")


def available() -> bool:
    """Whether the desktop can ask. Without a helper the library answers with nothing, in silence."""
    if sys.platform in ("win32", "darwin"):
        return True
    return any(shutil.which(helper) for helper in _HELPERS)


class NativeDialog:
    """One dialog on show; `answer` is None until the user has chosen or left."""

    def __init__(self, purpose: Purpose, path: Path) -> None:
        from imgui_bundle import portable_file_dialogs as pfd

        folder, patterns = str(path.parent), " ".join(f"*{suffix}" for suffix in purpose.suffixes)
        kinds = [purpose.kind, patterns, *(("All files", "*") if purpose.ask == "files" else ())]
        self._dialog: Any
        if purpose.ask == "folder":
            self._dialog = pfd.select_folder(purpose.title, folder)
        elif purpose.saving:
            self._dialog = pfd.save_file(purpose.title, str(path), kinds)
        else:
            several = pfd.opt.multiselect if purpose.ask == "files" else pfd.opt.none
            self._dialog = pfd.open_file(purpose.title, folder, kinds, several)

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
