"""The mouse on the face: turn, move, zoom, choose a pivot. Never through a widget."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.ui.state import App

DEGREES_PER_HEIGHT = 220.0
ZOOM_PER_NOTCH = 1.12
_LEFT, _MIDDLE = 0, 2


def handle(app: App) -> None:
    """Move the camera by what the mouse did over the face since the last frame."""
    io = imgui.get_io()
    if app.drag:
        _go_on(app, io)
        return
    mouse = io.mouse_pos
    if io.want_capture_mouse or app.face is None or not app.viewport.contains(mouse.x, mouse.y):
        return
    if imgui.is_mouse_double_clicked(_LEFT):
        app.pick_at = app.viewport.pixel(mouse.x, mouse.y)
    elif imgui.is_mouse_clicked(_MIDDLE) or (imgui.is_mouse_clicked(_LEFT) and io.key_shift):
        app.drag = "pan"
    elif imgui.is_mouse_clicked(_LEFT):
        app.drag = "orbit"
    if io.mouse_wheel:
        x, y = app.viewport.centred(mouse.x, mouse.y)
        app.camera = app.camera.zoomed(ZOOM_PER_NOTCH**io.mouse_wheel, x, y)


def _go_on(app: App, io: imgui.IO) -> None:
    if not (imgui.is_mouse_down(_LEFT) or imgui.is_mouse_down(_MIDDLE)):
        app.drag = ""
        return
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
