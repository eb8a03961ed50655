"""The type: Roboto, whose digits are all equally wide, with symbols of Font Awesome.

Both ship inside imgui-bundle. ImGui rasterises glyphs when they are first seen, at the size and
density of the screen, so no ranges are named and text stays sharp at every scale. Scripts that Roboto
lacks (Chinese, Japanese, Korean) come from a font of the system, where one is found and only once a
text needs it.
"""

from __future__ import annotations

from pathlib import Path

import imgui_bundle
from imgui_bundle import imgui

from facemorph.ui.theme import FONT_PIXELS

PLAY, PAUSE, LOOP, SEARCH = "\uf04b", "\uf04c", "\uf363", "\uf002"
RECORD, STOP = "\uf111", "\uf04d"
BACK, ON = "\uf053", "\uf054"
CLOSE, COPY, PASTE = "\uf00d", "\uf0c5", "\uf0ea"
FOLDER, FILE, UP = "\uf07b", "\uf15b", "\uf062"

_SYSTEM_FONTS = (
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-sans-cjk-fonts/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/System/Library/Fonts/PingFang.ttc",
    "/System/Library/Fonts/STHeiti Light.ttc",
    "C:/Windows/Fonts/msyh.ttc",
)


def font_folder() -> Path:
    """Where imgui-bundle keeps its fonts."""
    return Path(imgui_bundle.__file__).parent / "assets" / "fonts"


def add_fonts() -> None:
    """Make Roboto with symbols the font of the present ImGui context; ImGui's own where they are missing."""
    fonts = imgui.get_io().fonts
    text = font_folder() / "Roboto" / "Roboto-Regular.ttf"
    symbols = font_folder() / "Font_Awesome_6_Free-Solid-900.otf"
    if not text.is_file():
        fonts.add_font_default()
        return
    fonts.add_font_from_file_ttf(str(text), FONT_PIXELS)
    if symbols.is_file():
        config = imgui.ImFontConfig()
        config.merge_mode = True
        config.glyph_offset = imgui.ImVec2(0, 1)
        fonts.add_font_from_file_ttf(str(symbols), FONT_PIXELS * 0.85, config)


def needs_wide_script(text: str) -> bool:
    """Whether a text has letters that Roboto lacks and system fonts for East Asian scripts have."""
    return any(0x2E80 <= ord(letter) <= 0x9FFF or 0xAC00 <= ord(letter) <= 0xFFEF for letter in text)


def add_wide_script() -> bool:
    """Merge a system font for East Asian scripts; False where none is found."""
    found = next((path for path in _SYSTEM_FONTS if Path(path).is_file()), None)
    if found is None:
        return False
    config = imgui.ImFontConfig()
    config.merge_mode = True
    imgui.get_io().fonts.add_font_from_file_ttf(found, FONT_PIXELS, config)
    return True
