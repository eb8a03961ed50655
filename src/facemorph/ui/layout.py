"""Where the parts of the window are, in the interface's units."""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import imgui

from facemorph.ui.state import App, Viewport
from facemorph.ui.widgets import unit

LEAST_FACE_WIDTH = 260.0
LEAST_SIDE_WIDTH = 180.0


@dataclass(frozen=True)
class Layout:
    """The window's size, the bars' heights, the side panels' widths (0 where shut)."""

    width: float
    height: float
    menu: float
    bottom: float
    left: float
    right: float

    @property
    def middle_height(self) -> float:
        """Height between the two bars."""
        return max(self.height - self.menu - self.bottom, 1.0)


def laid_out(app: App) -> Layout:
    """The layout for the present window size; sets `app.viewport` to what is left for the face."""
    size, scale = imgui.get_io().display_size, unit()
    # Whole units: ImGui puts windows there, and a gap would show.
    menu = math.ceil(imgui.get_frame_height())
    bottom = math.ceil(imgui.get_frame_height() + 20 * scale)
    left = side_width(app, app.settings.left_open, app.settings.left_width) * scale // 1
    right = side_width(app, app.settings.right_open, app.settings.right_width) * scale // 1
    spare = size.x - LEAST_FACE_WIDTH * scale - left
    right = max(min(right, spare), LEAST_SIDE_WIDTH * scale) if right else 0.0
    layout = Layout(size.x, size.y, menu, bottom, left, right)
    pixels = imgui.get_io().display_framebuffer_scale.x
    app.viewport = Viewport(
        left, menu, max(size.x - left - right, 1.0), layout.middle_height, max(pixels, 0.1)
    )
    return layout


def side_width(app: App, is_open: bool, width: float) -> float:
    """Width of a side panel at scale 1, 0 where it is shut or hidden."""
    return max(width, LEAST_SIDE_WIDTH) if is_open and not app.panels_hidden else 0.0
