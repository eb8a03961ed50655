"""Colours, sizes and type: near-black panels, one accent, red for errors alone; or the same in light.

Every text colour has a contrast of at least 4.5 : 1 on every ground that it stands on (a test
computes it). Sizes are in pixels at scale 1; `apply` multiplies them.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, ImVec4, imgui

# ImGui measures a font from its highest to its lowest point: 18 is what type setters call 15 pixels.
FONT_PIXELS = 18.0
Rgba = tuple[float, float, float, float]


def _hex(text: str, alpha: float = 1.0) -> Rgba:
    red, green, blue = (int(text[place : place + 2], 16) / 255.0 for place in (0, 2, 4))
    return (red, green, blue, alpha)


@dataclass(frozen=True)
class Colours:
    """What each colour is for. Text stands on `panel`, `popup`, `field` and `backdrop`."""

    panel: Rgba
    popup: Rgba
    field: Rgba
    field_hovered: Rgba
    line: Rgba
    text: Rgba
    dim: Rgba
    accent: Rgba
    accent_bright: Rgba
    on_accent: Rgba
    track: Rgba
    knob: Rgba
    error: Rgba
    backdrop: Rgba
    veil: Rgba


DARK = Colours(
    panel=_hex("131417"),
    popup=_hex("1b1d21"),
    field=_hex("24272c"),
    field_hovered=_hex("2e3238"),
    line=_hex("2f333a"),
    text=_hex("e8e9ec"),
    dim=_hex("a4a9b3"),
    accent=_hex("58b4d1"),
    accent_bright=_hex("7acce4"),
    on_accent=_hex("0b1216"),
    track=_hex("3a3f47"),
    knob=_hex("e8e9ec"),
    error=_hex("ff8a80"),
    backdrop=_hex("292b30"),
    veil=_hex("000000", 0.45),
)
LIGHT = Colours(
    panel=_hex("f3f4f6"),
    popup=_hex("ffffff"),
    field=_hex("e2e5e9"),
    field_hovered=_hex("d6dae0"),
    line=_hex("cdd2d9"),
    text=_hex("1b1e23"),
    dim=_hex("4d535d"),
    accent=_hex("0f6c8c"),
    accent_bright=_hex("0a5a76"),
    on_accent=_hex("ffffff"),
    track=_hex("bcc3cc"),
    knob=_hex("0f6c8c"),
    error=_hex("b3261e"),
    backdrop=_hex("dfe2e6"),
    veil=_hex("20242a", 0.30),
)
THEMES = {"dark": DARK, "light": LIGHT}


def contrast(front: Rgba, ground: Rgba) -> float:
    """Contrast ratio 1..21 of two opaque colours, as WCAG 2 defines it."""
    lighter, darker = sorted((_luminance(front), _luminance(ground)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: Rgba) -> float:
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def faded(colour: Rgba, alpha: float) -> Rgba:
    """The colour at another opacity."""
    return (*colour[:3], alpha)


def packed(colour: Rgba) -> int:
    """As draw lists take it."""
    return imgui.get_color_u32(ImVec4(*colour))


def apply(name: str, scale: float) -> None:
    """Set ImGui's style to a theme at a scale."""
    style = imgui.get_style()
    _sizes(style)
    for entry, value in _colour_table(THEMES[name]).items():
        style.set_color_(entry, ImVec4(*value))
    style.scale_all_sizes(scale)
    style.font_size_base = FONT_PIXELS
    style.font_scale_dpi = scale


def _sizes(style: imgui.Style) -> None:
    style.window_padding = ImVec2(12, 10)
    style.frame_padding = ImVec2(9, 5)
    style.item_spacing = ImVec2(8, 7)
    style.item_inner_spacing = ImVec2(6, 5)
    style.cell_padding = ImVec2(6, 4)
    style.indent_spacing = 16
    style.scrollbar_size = 11
    style.grab_min_size = 12
    style.window_border_size = 0
    style.popup_border_size = 1
    style.child_border_size = 0
    style.frame_border_size = 0
    style.window_rounding = 0
    style.child_rounding = 0
    style.popup_rounding = 6
    style.frame_rounding = 5
    style.grab_rounding = 5
    style.scrollbar_rounding = 6
    style.separator_text_border_size = 1
    style.window_min_size = ImVec2(8, 8)
    style.hover_delay_normal = 0.5
    style.hover_stationary_delay = 0.15
    style.disabled_alpha = 0.45


def _colour_table(c: Colours) -> dict[int, Rgba]:
    col = imgui.Col_
    clear = (0.0, 0.0, 0.0, 0.0)
    soft = faded(c.accent, 0.28)
    return {
        col.text: c.text,
        col.text_disabled: c.dim,
        col.window_bg: c.panel,
        col.child_bg: clear,
        col.popup_bg: c.popup,
        col.border: c.line,
        col.border_shadow: clear,
        col.frame_bg: c.field,
        col.frame_bg_hovered: c.field_hovered,
        col.frame_bg_active: c.field_hovered,
        col.menu_bar_bg: c.panel,
        col.title_bg: c.popup,
        col.title_bg_active: c.popup,
        col.scrollbar_bg: clear,
        col.scrollbar_grab: c.track,
        col.scrollbar_grab_hovered: faded(c.dim, 0.8),
        col.scrollbar_grab_active: c.dim,
        col.check_mark: c.accent,
        col.slider_grab: c.accent,
        col.slider_grab_active: c.accent_bright,
        col.button: c.field,
        col.button_hovered: c.field_hovered,
        col.button_active: soft,
        col.header: c.field,
        col.header_hovered: c.field_hovered,
        col.header_active: soft,
        col.separator: c.line,
        col.separator_hovered: c.accent,
        col.separator_active: c.accent,
        col.text_selected_bg: faded(c.accent, 0.40),
        col.plot_histogram: c.accent,
        col.modal_window_dim_bg: c.veil,
        col.nav_cursor: c.accent,
        col.drag_drop_target: c.accent,
        col.input_text_cursor: c.text,
    }
