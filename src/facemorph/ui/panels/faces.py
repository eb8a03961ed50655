"""The faces panel: the built-in people by their pictures, and what was opened lately."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import ImVec2, imgui

from facemorph.core.rig import plain_label
from facemorph.ui import actions, files
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.thumbnails import SIZE
from facemorph.ui.widgets import colours, cut, tooltip, unit

_LEAST_TILE = 92.0


def draw(app: App) -> None:
    """The panel's contents."""
    imgui.align_text_to_frame_padding()
    imgui.text("Faces")
    imgui.begin_child("faces", ImVec2(0, 0))
    if app.builtins:
        _tiles(app)
    else:
        imgui.text_disabled("No built-in faces found.")
    imgui.dummy(ImVec2(0, 6 * unit()))
    if imgui.button("Open face…", ImVec2(-1, 0)):
        actions.ask_for(app, "open")
    tooltip(
        "A folder with neutral.obj and its expressions, or one mesh file. You can also drop it on the window."
    )
    _recent(app)
    imgui.end_child()


def _tiles(app: App) -> None:
    room, gap = imgui.get_content_region_avail().x, 8 * unit()
    columns = max(int((room + gap) // (_LEAST_TILE * unit() + gap)), 1)
    width = (room - gap * (columns - 1)) / columns
    for place, name in enumerate(app.builtins):
        if place % columns:
            imgui.same_line(0, gap)
        _tile(app, name, width)


def _tile(app: App, name: str, width: float) -> None:
    c, scale = colours(app), unit()
    place = imgui.get_cursor_screen_pos()
    picture = width * SIZE[1] / SIZE[0]
    height = picture + imgui.get_font_size() + 10 * scale
    if imgui.invisible_button(name, ImVec2(width, height)):
        files.open_builtin(app, name)
    hovered = imgui.is_item_hovered()
    tooltip(f"Open {plain_label(name)}")
    paint = imgui.get_window_draw_list()
    low = (place.x + width, place.y + picture)
    paint.add_rect_filled(place, low, packed(c.field), 6 * scale)
    texture = app.face_pictures.get(name)
    if texture:
        paint.add_image_rounded(
            imgui.ImTextureRef(texture), place, low, (0, 0), (1, 1), packed((1, 1, 1, 1)), 6 * scale
        )
    present = app.face is not None and app.face.builtin and app.face.source == (name,)
    if present or hovered:
        paint.add_rect(place, low, packed(c.accent if present else c.dim), 6 * scale, 2 * scale)
    label = cut(plain_label(name), width)
    size = imgui.calc_text_size(label)
    ink = packed(c.text if present or hovered else c.dim)
    paint.add_text((place.x + (width - size.x) / 2, place.y + picture + 4 * scale), ink, label)


def _recent(app: App) -> None:
    if not app.settings.recent:
        return
    imgui.dummy(ImVec2(0, 4 * unit()))
    imgui.text_disabled("Opened lately")
    for place, source in enumerate(app.settings.recent):
        path = Path(source[0])
        more = f" and {len(source) - 1} more" if len(source) > 1 else ""
        imgui.push_id(place)
        label = cut(f"{path.name or path}{more}", imgui.get_content_region_avail().x)
        if imgui.selectable(label, app.face is not None and list(app.face.source) == source)[0]:
            files.open_source(app, source)
        imgui.pop_id()
        tooltip("\n".join(source[:12]))
