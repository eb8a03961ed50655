"""Over the face: its name and what is active, buttons for view and shading, the heat map's legend, a hint."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.core.camera import DIRECTIONS
from facemorph.core.picture import SHADINGS
from facemorph.core.rig import Rig
from facemorph.gl.heat import DIFFERENCE, DISPLACEMENT, Legend
from facemorph.ui import actions, handles, people, regions
from facemorph.ui.commands import DIRECTION_WORDS, SHADING_WORDS
from facemorph.ui.layout import Layout
from facemorph.ui.state import App, Viewport
from facemorph.ui.theme import FONT_PIXELS, Rgba, faded, packed
from facemorph.ui.widgets import chip, chip_width, colours, cut, unit
from facemorph.ui.words import NEUTRAL_LABEL, label_of, percent

_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_background
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.no_bring_to_front_on_focus
)
_INERT = _FLAGS | imgui.WindowFlags_.no_inputs
_MARGIN = 14.0
_TITLE_PIXELS = 22.0
_MOST_LINES = 6
_BUTTONS_WIDTH = 356.0  # about what those at the lower right take
_SHORT_DIRECTION = {"three-quarter": "¾", "left": "Left", "right": "Right"}
NO_FACE = "No face is open. Drop a folder of meshes here, or press Ctrl+O."
LEGEND_WORDS = {DISPLACEMENT: "Moved from neutral", DIFFERENCE: "Difference"}
HINT = "Pick an expression, then drag the slider"


def draw(app: App, layout: Layout) -> None:
    """Everything over the face: what is only read first, then the buttons."""
    view = app.viewport
    _open("##over the face", view.x, view.y, (0.0, 0.0), inert=(view.width, view.height))
    if app.shown_face is None:
        _centred(app, "Opening a face…" if app.jobs.of_kind("face") else NO_FACE)
    else:
        _caption(app)
        if app.on_face.tool is not None:
            app.on_face.tool.paint(app)
        if app.legend is not None:
            _legend(app, app.legend, app.views()[0])
        if app.on_face.split is not None and app.second_legend is not None:
            _legend(app, app.second_legend, app.views()[1], lift=2 * imgui.get_frame_height() + 14 * unit())
        if not app.settings.hint_seen and app.expressions and app.on_face.stage is None:
            _hint(app)
    imgui.end()
    if app.shown_face is not None:
        _buttons(app)


def _caption(app: App) -> None:
    """The face's name, and under it what is active, a line each, on a ground that keeps them readable."""
    view, c, scale = app.viewport, colours(app), unit()
    face = app.shown_face
    assert face is not None
    room = min(app.views()[0].width - 4 * _MARGIN * scale, 300 * scale)
    if room < 60 * scale:
        return
    x, y = view.x + _MARGIN * scale, view.y + 12 * scale
    lines = [cut(line, room) for line in _active_lines(app, face.rig)]
    imgui.push_font(None, _TITLE_PIXELS)
    title = cut(face.title, room)
    title_size = imgui.calc_text_size(title)
    widest = max([title_size.x, *(line_width(line) for line in lines)])
    step = imgui.get_font_size() * FONT_PIXELS / _TITLE_PIXELS + 3 * scale
    paint, pad = imgui.get_window_draw_list(), 8 * scale
    low = (x + widest + 1.5 * pad, y + title_size.y + step * len(lines) + pad)
    paint.add_rect_filled((x - 0.5 * pad, y - 0.6 * pad), low, packed(faded(c.panel, 0.62)), 6 * scale)
    paint.add_text((x + 0.4 * pad, y), packed(c.text), title)
    imgui.pop_font()
    for place, line in enumerate(lines):
        at = (x + 0.4 * pad, y + title_size.y + 3 * scale + step * place)
        paint.add_text(at, packed(c.dim if line == NEUTRAL_LABEL else c.text), line)


def line_width(text: str) -> float:
    """Width of a text at the usual size, whatever font is pushed."""
    return float(imgui.calc_text_size(text).x * FONT_PIXELS / _TITLE_PIXELS)


def _active_lines(app: App, rig: Rig) -> list[str]:
    if app.on_face.words:
        return list(app.on_face.words)
    state = sorted(app.shown_state().items(), key=lambda part: -abs(part[1]))
    lines = [f"{label_of(rig, name)} {percent(weight)}" for name, weight in state if round(weight * 100)]
    if len(lines) > _MOST_LINES:
        lines = [*lines[: _MOST_LINES - 1], f"{len(lines) - _MOST_LINES + 1} more"]
    if app.controls.on("people") and people.mixes(app):
        lines.append(people.mixture_words(app, people.shares(app)))
    if app.controls.on("handles") and not handles.at_rest(app):
        lines.append("Handles moved")
    if app.controls.on("regions") and not regions.at_rest(app):
        lines.append("Regions moved")
    if not app.shapes_on and app.pose.weights:
        lines.append("Shapes are switched off")
    return lines or [NEUTRAL_LABEL]


def _buttons(app: App) -> None:
    """View and shading, bottom right; they break into two lines, or stay away, where there is no room."""
    view, scale = app.viewport, unit()
    gap = 4 * scale
    directions = [_SHORT_DIRECTION.get(name, DIRECTION_WORDS[name]) for name in DIRECTIONS]
    shadings = [SHADING_WORDS[name] for name in SHADINGS]
    widest = max(
        sum(chip_width(text) + gap for text in (*directions, "Frame", "Turntable")),
        sum(chip_width(text) + gap for text in shadings),
    )
    if widest > view.width - 2 * _MARGIN * scale or view.height < 160 * scale:
        return
    _open(
        "##view buttons", view.x + view.width - _MARGIN * scale, view.y + view.height - 12 * scale, (1.0, 1.0)
    )
    imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, gap))
    _indented(sum(chip_width(text) + gap for text in (*directions, "Frame", "Turntable")), widest)
    for name, text in zip(DIRECTIONS, directions, strict=True):
        if chip(app, text, f"Look from: {DIRECTION_WORDS[name].lower()}"):
            actions.view_from(app, name)
        imgui.same_line()
    if chip(app, "Frame", "The whole face in sight (F)"):
        actions.frame_face(app)
    imgui.same_line()
    if chip(app, "Turntable", "The camera goes round the face (T)", lit=app.turntable):
        actions.toggle_turntable(app)
    _indented(sum(chip_width(text) + gap for text in shadings), widest)
    for place, name in enumerate(SHADINGS):
        if place:
            imgui.same_line()
        if chip(app, SHADING_WORDS[name], _SHADING_TIPS[name], lit=app.shown_look.shading == name):
            actions.set_shading(app, name)
    imgui.pop_style_var()
    imgui.end()


_SHADING_TIPS = {
    "skin": "The face as it looks",
    "clay": "One grey, to see the form",
    "wire": "The mesh's polygons",
    "normals": "The direction in which each point of the surface looks, as a colour",
    "heat": "How far each point has moved from the neutral face (H)",
}


def _indented(width: float, widest: float) -> None:
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + widest - width)


def _open(
    name: str, x: float, y: float, pivot: tuple[float, float], *, inert: tuple[float, float] | None = None
) -> None:
    """Begin a window without ground or edge; with a size, one that takes no mouse."""
    imgui.set_next_window_pos((x, y), 0, pivot)
    if inert is not None:
        imgui.set_next_window_size(inert)
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(0, 0))
    imgui.begin(name, None, _INERT if inert is not None else _FLAGS | imgui.WindowFlags_.always_auto_resize)
    imgui.pop_style_var()


def _legend(app: App, legend: Legend, view: Viewport, lift: float = 0.0) -> None:
    """A heat map's colours at the lower left of its view, `lift` higher to clear what is there."""
    c, scale = colours(app), unit()
    width, height, pad = 190 * scale, 10 * scale, 10 * scale
    line = imgui.get_font_size()
    x, y = view.x + _MARGIN * scale, view.y + view.height - 12 * scale - lift
    box = 2 * pad + 2 * line + height + 8 * scale
    if view.width < width + 4 * _MARGIN * scale or view.height < box + 60 * scale:
        return
    paint = imgui.get_window_draw_list()
    top = y - box
    paint.add_rect_filled((x, top), (x + width + 3 * pad, y), packed(faded(c.panel, 0.86)), 6 * scale)
    left, bar = x + 1.5 * pad, top + pad + line + 4 * scale
    own = app.on_face.legend if legend.title == DIFFERENCE else ""
    paint.add_text(
        (left, top + pad),
        packed(c.text),
        f"{own or LEGEND_WORDS[legend.title]}, {legend.unit}",
    )
    _ramp(legend, left, bar, width, height)
    for at, text in legend.ticks:
        size = imgui.calc_text_size(text)
        middle = left + at * width
        paint.add_line((middle, bar + height), (middle, bar + height + 3 * scale), packed(c.dim), scale)
        paint.add_text((middle - size.x / 2, bar + height + 4 * scale), packed(c.text), text)


def _ramp(legend: Legend, left: float, top: float, width: float, height: float, steps: int = 32) -> None:
    paint = imgui.get_window_draw_list()
    last = len(legend.colours) - 1
    inks = [packed(_rgba(legend, round(step / steps * last))) for step in range(steps + 1)]
    for step in range(steps):
        a, b = left + width * step / steps, left + width * (step + 1) / steps
        paint.add_rect_filled_multi_color(
            (a, top), (b, top + height), inks[step], inks[step + 1], inks[step + 1], inks[step]
        )


def _rgba(legend: Legend, place: int) -> Rgba:
    red, green, blue = (float(value) / 255.0 for value in legend.colours[place])
    return (red, green, blue, 1.0)


def _hint(app: App) -> None:
    view, scale = app.viewport, unit()
    size = imgui.calc_text_size(HINT)
    if size.x > view.width - 20 * scale:
        return
    c, pad = colours(app), 10 * scale
    x, y = view.x + (view.width - size.x) / 2, view.y + view.height - 30 * scale - size.y
    beside = view.x + view.width - (_BUTTONS_WIDTH + _MARGIN) * scale - size.x - 3 * pad
    if beside >= view.x + _MARGIN * scale + 2 * pad and not app.settings.equal_luminance:
        # Low down, so that the chin stays free.
        x = min(x, beside)
    else:
        y -= 2 * imgui.get_frame_height() + 10 * scale
    paint = imgui.get_window_draw_list()
    corner = (x + size.x + 1.6 * pad, y + size.y + 0.8 * pad)
    paint.add_rect_filled((x - 1.6 * pad, y - 0.8 * pad), corner, packed(faded(c.panel, 0.80)), 14 * scale)
    paint.add_text((x, y), packed(c.text), HINT)


def _centred(app: App, text: str) -> None:
    view = app.viewport
    shown = cut(text, view.width - 40 * unit())
    size = imgui.calc_text_size(shown)
    place = (view.x + (view.width - size.x) / 2, view.y + (view.height - size.y) / 2)
    imgui.get_window_draw_list().add_text(place, packed(colours(app).dim), shown)
