"""A part of the page Fit: which of the template's shapes make up each example, beside a live preview."""

from __future__ import annotations

from functools import partial

import numpy as np
from imgui_bundle import ImVec2, imgui

from facemorph.core.rig import plain_label
from facemorph.ui import fit_run, fit_weights, fonts
from facemorph.ui.fit_page import MAKE, START_JOB, Preview, Start
from facemorph.ui.fit_plan import Piece
from facemorph.ui.fit_views import shown_lengths
from facemorph.ui.fit_wrap import shown_example
from facemorph.ui.panels.fit_points import progress_row
from facemorph.ui.panels.fit_rows import Way
from facemorph.ui.panels.rows import divider, pointed_at, quiet_words
from facemorph.ui.panels.shapes import SET_TITLES, found
from facemorph.ui.panels.value_rows import button_row, choice, switch_row
from facemorph.ui.state import App
from facemorph.ui.widgets import (
    chip,
    chip_width,
    icon_button,
    row_label,
    slim_slider,
    tooltip,
    typed_number,
    unit,
)

_HELP = (
    "Roughly how much of each shape is in the example. Estimated already; a better guess helps where the "
    "left face is far from the right one."
)
_HEAT_TIP = "Colours the example by how far the mixture on the left is from it"
_NAME_TIP = (
    "The example is called as shapes of the template are, so it is taken for these alone: that teaches them "
    "the most. Off, all shapes are estimated."
)
_NUMBER = 48.0


def summary(app: App) -> str:
    """What came of the step in a word."""
    if not app.fit.ready or not app.fit.examples or app.pages.fit.preview is None:
        return ""
    return "set by hand" if any(piece.weights for piece in app.fit.examples) else "estimated"


def draw(app: App) -> Way:
    """The step's contents."""
    fit_weights.refresh(app)
    made, piece = fit_weights.preview(app), shown_example(app)
    preparing(app)
    if piece is None:
        if made is not None:
            quiet_words("Without examples there is nothing to weigh: the template's motion is carried over.")
    else:
        quiet_words(_HELP)
        example_choice(app, piece)
        start = fit_weights.start_of(app, piece)
        if made is not None and start is not None:
            _mixture(app, piece, made, start)
    return Way("Next: make the shapes", "", made is not None, partial(fit_run.open_step, app, MAKE))


def preparing(app: App) -> None:
    """The transfer and the estimates while they are made, with Cancel; or why there are none."""
    job = app.jobs.of_kind(START_JOB)
    if job is not None:
        progress_row(app, job.fraction, job.doing, job.remaining_secs)
        if button_row(app, (("Cancel", "Stop transferring and estimating", True),)):
            fit_weights.stop(app)
    elif fit_weights.stopped(app):
        quiet_words("The template's shapes are not transferred yet.")
        if button_row(app, (("Try again", "Transfer the shapes and estimate the weights", True),)):
            fit_weights.again(app)


def example_choice(app: App, piece: Piece) -> None:
    """Which example is on show, where there are several."""
    examples, page = app.fit.examples, app.pages.fit
    if len(examples) < 2:
        return
    words = {str(other.key): f"{place}. {other.name}" for place, other in enumerate(examples, start=1)}
    place = examples.index(piece)
    side = imgui.get_frame_height() + 4 * unit()
    if icon_button(app, fonts.BACK, "previous", "The example before"):
        page.selected = examples[place - 1].key
    imgui.same_line(0, 4 * unit())
    room = imgui.get_content_region_avail().x - side
    page.selected = int(choice(app, "example", str(piece.key), words, "The example on show", room))
    imgui.same_line(0, 4 * unit())
    if icon_button(app, fonts.ON, "next", "The next example"):
        page.selected = examples[(place + 1) % len(examples)].key


def _mixture(app: App, piece: Piece, made: Preview, start: Start) -> None:
    page, rig = app.pages.fit, made.face.rig
    weights = fit_weights.weights_of(app, piece)
    key = ("away", made, start, tuple(sorted(weights.items())))
    away = page.keep(key, lambda: fit_weights.distances(rig, weights, start.placed))
    rms, diagonal = float(np.sqrt(np.mean(away.astype(np.float64) ** 2))), rig.neutral.diagonal
    page.heat = switch_row(app, "Difference as colours", page.heat, _HEAT_TIP)
    scale, name = shown_lengths(rig)
    largest = float(away.max(initial=0.0))
    row_label(
        app,
        f"{rms * scale:.2g} {name} apart (rms), {largest * scale:.2g} at most",
        imgui.get_content_region_avail().x,
        f"Root mean square over all vertices; {100 * rms / diagonal:.3f} % of the head's diagonal, at most "
        f"{100 * largest / diagonal:.2f} %",
        bright=False,
    )
    _by_name(app, piece, made, start)
    _sets(app)
    _search(app)
    matter, others = fit_weights.rows(app, piece, start)
    by_name = {shape.name: shape for shape in rig.controls}
    shown = [name for name in matter if found(by_name[name], page.search)]
    rest = [name for name in others if found(by_name[name], page.search)]
    imgui.begin_child("weights", ImVec2(0, max(imgui.get_content_region_avail().y, 200 * unit())))
    divider(app, f"In this example  {len(shown)}")
    if piece.weights:
        _reset(app, piece)
    for name in shown:
        _row(app, piece, made, start, name, weights.get(name, 0.0))
    divider(app, f"All others  {len(rest)}")
    _clipped(app, piece, made, start, rest)
    imgui.end_child()


def _by_name(app: App, piece: Piece, made: Preview, start: Start) -> None:
    """Where the file's name is that of shapes: whether the estimate is of these alone."""
    if not start.named and piece.by_name:
        return
    labels = [made.face.rig.shape(name).label for name in start.named]
    words = f"As its name says: {', '.join(labels)}" if labels else "As its name says"
    if switch_row(app, words, piece.by_name, _NAME_TIP) != piece.by_name:
        fit_weights.toggle_named(app, piece.key)


def _reset(app: App, piece: Piece) -> None:
    if imgui.button("Reset to the estimate", ImVec2(-1, 0)):
        fit_weights.reset(app, piece.key)
    tooltip("Takes back every weight set by hand for this example")


def _clipped(app: App, piece: Piece, made: Preview, start: Start, names: list[str]) -> None:
    clipper = imgui.ListClipper()
    clipper.begin(len(names), imgui.get_frame_height() + imgui.get_style().item_spacing.y)
    while clipper.step():
        for place in range(clipper.display_start, clipper.display_end):
            _row(app, piece, made, start, names[place], 0.0)


def _row(app: App, piece: Piece, made: Preview, start: Start, name: str, weight: float) -> None:
    """A weight 0..1; a right-click gives the estimate back."""
    scale, room, place = unit(), imgui.get_content_region_avail().x, imgui.get_cursor_screen_pos()
    shape = made.face.rig.shape(name)
    estimate, key = start.weights.get(name, 0.0), f"fit {piece.key} {name}"
    number = _NUMBER * scale
    label = max((room - number) * 0.47, 60 * scale)
    own = "\nSet by hand" if name in piece.weights else ""
    tip = (
        f"{shape.name} ({SET_TITLES.get(shape.set, plain_label(shape.set))}), estimated {estimate:.2f}{own}\n"
        "Drag, double-click to type, right-click for the estimate"
    )
    row_label(app, shape.label, label - 4 * scale, tip, bright=weight > 0.0)
    again = imgui.is_item_clicked(1)
    imgui.same_line(0, 4 * scale)
    new = slim_slider(app, key, weight, 0.0, 1.0, room - label - number, rest=estimate)
    again = again or imgui.is_item_clicked(1)
    held = imgui.is_item_active()
    imgui.same_line(0, 0)
    new = typed_number(app, key, new, 0.0, 1.0, number)
    if not held and pointed_at(place, room):
        app.on_face.glow = fit_weights.light(app, made.face.rig, name)
    if again:
        fit_weights.reset_weight(app, piece.key, name)
    elif new != weight:
        fit_weights.set_weight(app, piece.key, name, new)


def _sets(app: App) -> None:
    """Which sets of shapes may explain the examples, where there are several."""
    plan = app.fit
    assert plan.template is not None
    sets = list(dict.fromkeys(shape.set for shape in plan.template.rig.controls))
    if len(sets) < 2:
        return
    imgui.push_id("sets")
    right = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    for place, name in enumerate(sets):
        title = SET_TITLES.get(name, plain_label(name))
        if place:
            imgui.same_line(0, 4 * unit())
            if imgui.get_cursor_screen_pos().x + chip_width(title) > right:
                imgui.new_line()
        on = name not in plan.without
        may = "may" if on else "may not"
        tip = f"{title} {may} explain the examples; click to change. All of them get made anyway."
        if chip(app, title, tip, lit=on):
            fit_weights.toggle_set(app, name)
    imgui.pop_id()


def _search(app: App) -> None:
    page = app.pages.fit
    clear = imgui.get_frame_height() + 4 * unit() if page.search else 0.0
    imgui.set_next_item_width(imgui.get_content_region_avail().x - clear)
    _, page.search = imgui.input_text_with_hint("##find", f"{fonts.SEARCH}  Find a shape", page.search)
    if page.search:
        imgui.same_line(0, 4 * unit())
        if icon_button(app, fonts.CLOSE, "clear search", "Show all shapes"):
            page.search = ""
