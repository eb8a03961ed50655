"""The Compare page: a vertex's path, speed and acceleration by several methods, and the face seen twice."""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2, imgui

from facemorph.core.arrays import Float64
from facemorph.core.rig import Rig
from facemorph.ui import actions, comparing, fonts
from facemorph.ui.lab import Paths
from facemorph.ui.on_face import OnlyPaints, Split
from facemorph.ui.on_screen import picked, projected, shown_places, surface_of
from facemorph.ui.panels.rows import divider, quiet_words
from facemorph.ui.panels.value_rows import choice_row, switch_row, unit_words
from facemorph.ui.plots import Line, aligned_plots, plot
from facemorph.ui.split_words import paint_split_words
from facemorph.ui.state import App, Viewport
from facemorph.ui.theme import packed
from facemorph.ui.widgets import icon_button, right_edge, row_label, tab_chips, tooltip, unit

_SPLIT_TIP = (
    "Shows the face twice at the same t, by two methods: linear (2.5), cosine (2.1), RBF (2.13), or without "
    "a layer; the cameras are one"
)
_PATHS_TIP = (
    "Present is the sum of all methods as it is set now. Linear goes evenly from where that begins to where "
    "it ends (2.5); cosine the same way, starting and ending gently (2.1). Linear motion starts and stops "
    "at once: its acceleration is 0 between, and without bound at both ends."
)
_WEIGHT_TIP = (
    "The shape whose weight is followed: the sum of what the slider, the shapes and every page add. "
    "Regions and handles move the face without weights"
)
VERTEX = "A vertex"
_FOLLOWS = (
    (VERTEX, "Where a vertex of the face goes: click on the face to choose it"),
    ("A weight", "How much of a shape the face has"),
)
_ORDER = (comparing.PRESENT, comparing.LINEAR, comparing.COSINE)
_HEAT_TIP = "The right face shows by its colours how far it is from the left one"


def draw(app: App) -> None:
    """The page's contents."""
    imgui.align_text_to_frame_padding()
    imgui.text("Compare")
    if app.rig is None:
        quiet_words("No face is open.")
        return
    imgui.begin_child("compare page", ImVec2(0, 0))
    _split(app, app.rig)
    divider(app, "As t runs from 0 to 1")
    tooltip(_PATHS_TIP)
    page = app.lab.compare
    follows = tab_chips(app, _FOLLOWS, page.follows)
    if follows != page.follows:
        page.follows, page.paths, page.asked = follows, None, ()
    if follows == VERTEX:
        _vertex(app, app.rig)
    else:
        _weight(app, app.rig)
    app.on_face.tool = PickTool()
    imgui.end_child()


def _split(app: App, rig: Rig) -> None:
    page = app.lab.compare
    split = switch_row(app, "Split view", page.split, _SPLIT_TIP)
    if split != page.split:
        page.split = split
        # The views are half as wide, or twice: the face is put in sight anew, from where one looks.
        actions.frame_face(app)
    if not page.split:
        return
    choices = comparing.methods_now(app, rig)
    page.left = page.left if page.left in choices else comparing.LINEAR
    page.right = page.right if page.right in choices else comparing.COSINE
    page.left = choice_row(app, "left method", "Left", page.left, choices, "The method on the left")
    page.right = choice_row(app, "right method", "Right", page.right, choices, "The method on the right")
    page.heat = switch_row(app, "Difference on the right", page.heat, _HEAT_TIP)
    comparing.refresh_scenes(app, rig)
    if page.scenes is None:
        return
    left, right = page.scenes
    app.on_face.scene = left
    app.on_face.split = Split(right, (choices[page.left], choices[page.right]), page.heat)
    (most, rms), unit_name = page.difference, unit_words(rig)
    quiet_words(
        f"They differ by {most:.3g} {unit_name} at most, rms {rms:.3g} {unit_name}."
        if most > 1e-6 * rig.neutral.diagonal
        else "They are the same here. Move the slider: linear and cosine meet at 0, ½ and 1."
    )


def _vertex(app: App, rig: Rig) -> None:
    page = app.lab.compare
    if page.vertex is None or page.vertex >= rig.neutral.vertex_count:
        quiet_words("Click on the face to choose a vertex; its path is drawn here.")
        return
    comparing.refresh_paths(app, rig, page.vertex)
    words, unit_name = f"Vertex {page.vertex:,}", unit_words(rig)
    row_label(app, words, imgui.get_content_region_avail().x - imgui.get_frame_height() - 8 * unit())
    imgui.same_line(right_edge() - imgui.get_frame_height())
    if icon_button(app, fonts.CLOSE, "forget vertex", "Follow no vertex any more"):
        page.vertex, page.paths, page.asked = None, None, ()
    if page.paths is not None:
        _plots(
            app,
            page.paths,
            f"from the start, {unit_name}",
            ("distance", unit_name),
            ("speed", f"{unit_name} per t"),
            ("accel.", f"{unit_name} per t²"),
        )


def _weight(app: App, rig: Rig) -> None:
    page, choices = app.lab.compare, comparing.shapes_now(app, rig)
    if not choices:
        quiet_words("This face has no shapes: no weight to follow.")
        return
    if page.shape not in choices:
        page.shape = next((name for name in app.pose.target if name in choices), next(iter(choices)))
    page.shape = choice_row(app, "followed shape", "Weight of", page.shape, choices, _WEIGHT_TIP)
    comparing.refresh_paths(app, rig, page.shape)
    if page.paths is not None:
        _plots(app, page.paths, "weight", ("weight", ""), ("speed", "1 per t"), ("accel.", "1 per t²"))


def _plots(app: App, made: Paths, what: str, *titles: tuple[str, str]) -> None:
    """The numbers where the slider stands, and three plots as high as there is room for."""
    at = app.pose.t
    shown = {method: float(np.interp(at, made.t, made.value[method])) for method in _ORDER}
    decimals = 2 if max(map(abs, shown.values())) >= 0.2 else 3
    # Adding 0 takes the minus from a zero.
    numbers = ", ".join(
        f"{method.lower()} {round(value, decimals) + 0.0:.{decimals}f}" for method, value in shown.items()
    )
    quiet_words(f"At t = {at:.2f}, {what}: {numbers}.")
    below = imgui.get_text_line_height_with_spacing()
    room = imgui.get_content_region_avail().y - below - 5 * imgui.get_style().item_spacing.y
    height = min(max(room / 3, 112 * unit()), 240 * unit())
    with aligned_plots("ways"):
        for (title, unit_name), values in zip(
            titles, (made.value, made.speed, made.acceleration), strict=True
        ):
            # The present way lies on one of the others more often than not: it is drawn wide, under them.
            lines = tuple(
                Line(method, made.t, values[method], ground=method == comparing.PRESENT) for method in _ORDER
            )
            first, last = values is made.value, values is made.acceleration
            plot(
                app,
                title,
                "t" if last else "",
                f"{title}, {unit_name}" if unit_name else title,
                lines,
                height=height + (below if last else 0.0),
                legend=first,
                at=at,
            )


class PickTool(OnlyPaints):
    """A click on the face chooses the vertex to follow."""

    def click(self, app: App, x: float, y: float) -> None:
        """Choose the nearest vertex; beside the face nothing changes."""
        surface = app.surface(surface_of)
        hit = picked(app, surface, x, y) if surface is not None else None
        if hit is not None:
            app.lab.compare.vertex = hit.vertex

    def paint(self, app: App) -> None:
        """The chosen vertex, the line between the two views, and what each of them shows."""
        views = app.views()
        paint_split_words(app)
        vertex = app.lab.compare.vertex
        if vertex is None or app.rig is None or vertex >= app.rig.neutral.vertex_count:
            return
        scenes = (app.scene(),) if app.on_face.split is None else (app.scene(), app.on_face.split.right)
        for view, scene in zip(views, scenes, strict=True):
            _mark(view, projected(app, shown_places(app, [vertex], scene), view)[0][0])


def _mark(view: Viewport, place: Float64) -> None:
    (x, y), paint, scale = place, imgui.get_window_draw_list(), unit()
    if not view.contains(x, y):
        return
    paint.add_circle_filled((x, y), 5 * scale, packed((0.05, 0.06, 0.07, 0.9)))
    paint.add_circle_filled((x, y), 3.5 * scale, packed((1.0, 0.82, 0.25, 1.0)))
