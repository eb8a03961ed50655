"""What the window remembers from one day to the next, as JSON in the platform's usual folder.

FACEMORPH_CONFIG_DIR names another folder. A file that cannot be used never stops the start: it is
kept aside under another name, and the defaults are taken.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from facemorph.core.picture import LEAST_LUMINANCE, LIGHT_RIGS, LUMINANCE, LUMINANCES_OF, MOST_LUMINANCE

VERSION = 1
MOST_RECENT = 12
THEMES = ("dark", "light")
SMOOTH_SURFACES = ("off", "1", "2", "auto")


@dataclass
class Settings:
    """Sizes in unscaled pixels; `recent` holds what was opened, newest first, each as its paths."""

    window_size: list[int] = field(default_factory=lambda: [1280, 800])
    maximized: bool = False
    theme: str = "dark"
    light: str = "studio"
    equal_luminance: bool = False
    luminance: float = LUMINANCE
    luminance_of: str = "face"
    recent: list[list[str]] = field(default_factory=list)
    left_open: bool = False
    right_open: bool = True
    left_width: float = 236.0
    right_width: float = 376.0
    right_page: str = "Shapes"
    shut_sections: list[str] = field(default_factory=list)
    wide_weights: bool = False
    loop: bool = False
    duration_secs: float = 1.5
    curve: str = "cosine"
    hint_seen: bool = False
    last_folder: str = ""
    smooth_surface: str = "auto"

    def remember(self, source: tuple[str, ...]) -> None:
        """Put what was just opened at the head of the recent list."""
        entry = list(source)
        self.recent = [entry, *(other for other in self.recent if other != entry)][:MOST_RECENT]

    def forget(self, source: tuple[str, ...]) -> None:
        """Take out of the recent list what is not there any more."""
        self.recent = [other for other in self.recent if other != list(source)]


def _text_list(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(entry, str) for entry in value)


def _number(low: float, high: float) -> Callable[[Any], bool]:
    def fits(value: Any) -> bool:
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        # Bounds first and alone: they hold off nan, infinity, and integers too large for a float.
        return plain and low <= value <= high

    return fits


def _is_size(value: Any) -> bool:
    pair = isinstance(value, list) and len(value) == 2
    return pair and all(isinstance(side, int) and _number(200, 16384)(side) for side in value)


def _flag(value: Any) -> bool:
    return isinstance(value, bool)


_FITS: dict[str, Callable[[Any], bool]] = {
    "window_size": _is_size,
    "maximized": _flag,
    "theme": lambda v: v in THEMES,
    "light": lambda v: v in LIGHT_RIGS,
    "equal_luminance": _flag,
    "luminance": _number(LEAST_LUMINANCE, MOST_LUMINANCE),
    "luminance_of": lambda v: v in LUMINANCES_OF,
    "recent": lambda v: isinstance(v, list) and len(v) <= 100 and all(_text_list(e) and e for e in v),
    "left_open": _flag,
    "right_open": _flag,
    "left_width": _number(120, 2000),
    "right_width": _number(120, 2000),
    "right_page": lambda v: isinstance(v, str),
    "shut_sections": _text_list,
    "wide_weights": _flag,
    "loop": _flag,
    "duration_secs": _number(0.1, 60.0),
    "curve": lambda v: v in ("linear", "cosine"),
    "hint_seen": _flag,
    "last_folder": lambda v: isinstance(v, str),
    "smooth_surface": lambda v: v in SMOOTH_SURFACES,
}


def config_folder() -> Path | None:
    """Where the settings are kept; None for a user without a home, who has the defaults each time."""
    override = os.environ.get("FACEMORPH_CONFIG_DIR")
    if override:
        return Path(override)
    import platformdirs

    try:
        folder = platformdirs.user_config_path("facemorph", appauthor=False)
    except RuntimeError:
        return None
    return folder if folder.is_absolute() else None


def load_settings(folder: Path) -> tuple[Settings, str]:
    """The settings kept in `folder`, and a sentence on what was wrong with them ("" if nothing was)."""
    path = folder / "settings.json"
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return Settings(), ""
    except (OSError, UnicodeDecodeError) as error:
        return Settings(), _set_aside(path, f"cannot be read ({error})")
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return Settings(), _set_aside(path, "is not valid JSON")
    if not isinstance(data, dict) or data.get("version") != VERSION:
        return Settings(), _set_aside(path, f"is not of version {VERSION}")
    settings = Settings()
    wrong = [name for name, fits in _FITS.items() if name in data and not fits(data[name])]
    for entry in fields(settings):
        if entry.name in data and entry.name not in wrong:
            setattr(settings, entry.name, data[entry.name])
    return settings, _set_aside(path, f"has unusable values for {', '.join(wrong)}") if wrong else ""


def save_settings(folder: Path, settings: Settings) -> None:
    """Write the settings, whole or not at all. Raises `OutputError` where the folder cannot be written."""
    from facemorph.errors import OutputError
    from facemorph.io.atomic import replacing

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"the settings cannot be kept in {folder}: {error}.") from error
    text = json.dumps({"version": VERSION, **asdict(settings)}, indent=1, ensure_ascii=False)
    with replacing(folder / "settings.json") as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


def _set_aside(path: Path, problem: str) -> str:
    kept = path.with_name("settings-broken.json")
    try:
        path.replace(kept)
    except OSError:
        return f"The settings file {path} {problem}; the usual settings are used."
    return f"The settings file {problem}; the usual settings are used and the file is kept as {kept}."
