"""The mouse on the face: turn, move, zoom, choose a pivot, or the page's tool. Never through a widget."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui.state import App
from facemorph.ui.widgets import unit

DEGREES_PER_HEIGHT = 220.0
ZOOM_PER_NOTCH = 1.12
# A press that moves less than this before it ends was a click.
CLICK_UNITS = 4.0
_LEFT, _RIGHT, _MIDDLE = 0, 1, 2


def handle(app: App) -> None:
    """Move the camera, or what the page's tool moves, by what the mouse did over the face."""
    io = imgui.get_io()
    if app.drag:
        _go_on(app, io)
        return
    mouse = io.mouse_pos
    if io.want_capture_mouse or app.shown_face is None or not app.viewport.contains(mouse.x, mouse.y):
        return
    if _taken(app, mouse.x, mouse.y):
        app.drag = "tool"
    elif imgui.is_mouse_double_clicked(_LEFT) and app.on_face.tool is None:
        view = app.view_at(mouse.x, mouse.y)
        app.pick_at = view.pixel(mouse.x, mouse.y)
    elif imgui.is_mouse_clicked(_MIDDLE) or (imgui.is_mouse_clicked(_LEFT) and io.key_shift):
        app.drag = "pan"
    elif imgui.is_mouse_clicked(_LEFT):
        app.drag, app.pressed_at = "orbit", (mouse.x, mouse.y)
    if io.mouse_wheel:
        x, y = app.view_at(mouse.x, mouse.y).centred(mouse.x, mouse.y)
        app.camera = app.camera.zoomed(ZOOM_PER_NOTCH**io.mouse_wheel, x, y)


def _taken(app: App, x: float, y: float) -> bool:
    tool = app.on_face.tool
    if tool is None:
        return False
    return any(imgui.is_mouse_clicked(button) and tool.press(app, x, y, button) for button in (_LEFT, _RIGHT))


def _go_on(app: App, io: imgui.IO) -> None:
    mouse, tool = io.mouse_pos, app.on_face.tool
    if not any(imgui.is_mouse_down(button) for button in (_LEFT, _RIGHT, _MIDDLE)):
        drag, app.drag = app.drag, ""
        if tool is not None and drag == "tool":
            tool.release(app)
        elif tool is not None and drag == "orbit" and app.pressed_at is not None:
            tool.click(app, *app.pressed_at)
        app.pressed_at = None
        return
    if app.drag == "tool":
        if tool is not None:
            tool.drag(app, mouse.x, mouse.y)
        return
    if app.pressed_at is not None and _far(app.pressed_at, mouse):
        app.pressed_at = None
    height = max(app.viewport.height, 1.0)
    right, down = io.mouse_delta.x / height, io.mouse_delta.y / height
    if not (right or down):
        return
    if app.drag == "pan":
        app.camera = app.camera.panned(-right, down)
    else:
        # The face follows the hand: dragged to the right, its left cheek comes into sight.
        app.turntable = False
        app.camera = app.camera.orbited(-right * DEGREES_PER_HEIGHT, down * DEGREES_PER_HEIGHT)


def _far(place: tuple[float, float], mouse: ImVec2) -> bool:
    return abs(mouse.x - place[0]) + abs(mouse.y - place[1]) > CLICK_UNITS * unit()
