"""A part of the page Fit: the same points shown on the template and on a scan, and the wrapping with them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from imgui_bundle import ImVec2, imgui

from facemorph.ui import actions, fit_landmarks, fit_views, fit_wrap, fonts
from facemorph.ui.fit_page import WRAP_JOB
from facemorph.ui.fit_plan import Piece
from facemorph.ui.panels.fit_rows import Way, wrapped_text
from facemorph.ui.panels.rows import quiet_words
from facemorph.ui.panels.value_rows import button_row
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, cut, icon_button, tab_chips, tooltip, unit
from facemorph.ui.words import duration_words

if TYPE_CHECKING:
    from facemorph.fit.registration import Quality

_HELP = (
    "The template can be wrapped around it. Click the ringed point of the left face on the right face. Drag "
    "a dot on the right to mend it, right-click takes it away. Left and right are the person's own."
)
_VIEWS = (
    ("Points", "Both surfaces with their points"),
    ("Wrapped", "The template wrapped around the scan, coloured by its distance from it"),
)
_TURNS = (
    ("Turn x", "Turn the scan by a quarter about the axis from left to right"),
    ("Turn y", "Turn the scan by a quarter about the upright axis"),
    ("Turn z", "Turn the scan by a quarter about the axis from back to front"),
)
_WRAP_TIP = "Lays the template's surface on the scan's"
_MOST_ROWS, _KNOWS_BY_NOW = 5, 6
_GOOD_PERCENT = 0.1


def draw(app: App, piece: Piece) -> None:
    """Points, Wrap, and what came of it."""
    page = app.pages.fit
    if piece.quality is not None:
        page.shows_wrap = tab_chips(app, _VIEWS, "Wrapped" if page.shows_wrap else "Points") == "Wrapped"
        if page.shows_wrap:
            _quality(app, piece)
            return
    if len(piece.pairs) < _KNOWS_BY_NOW:
        quiet_words(_HELP)
    _wanted(app, piece)
    _state(app, piece)
    _list(app, piece)
    _files(app, piece)
    if len(piece.pairs) < 3:
        wrapped_text("If the scan lies or looks the other way:", colours(app).dim)
        pressed = button_row(app, tuple((words, tip, True) for words, tip in _TURNS))
        for axis, (words, _) in enumerate(_TURNS):
            if pressed == words:
                fit_wrap.turn(app, piece, axis)


def _wanted(app: App, piece: Piece) -> None:
    """What is asked for now, and a way past it."""
    wanted = fit_wrap.wanted_vertex(app, piece)
    imgui.spacing()
    if wanted is None:
        wrapped_text("Click a point on the left face, then the same point on the right face.")
        return
    place, c = imgui.get_cursor_screen_pos(), colours(app)
    radius = 6 * unit()
    middle = (place.x + radius + 2 * unit(), place.y + imgui.get_frame_height() / 2)
    imgui.get_window_draw_list().add_circle(middle, radius, packed(c.accent_bright), thickness=2 * unit())
    imgui.indent(22 * unit())
    own = fit_wrap.chosen_vertex(app) is not None
    word = "Not this one" if own else "Skip"
    width = imgui.calc_text_size(word).x + 2 * imgui.get_style().frame_padding.x
    room = imgui.get_content_region_avail().x - width - 8 * unit()
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(cut(fit_landmarks.words_of(wanted[1], wanted[0]), room))
    imgui.same_line(imgui.get_cursor_pos_x() + room + 8 * unit())
    if imgui.button(word):
        fit_wrap.skip(app, piece)
    tooltip("Ask for the next named point" if own else "Pass over this point: it cannot be seen on the scan")
    imgui.unindent(22 * unit())


def _list(app: App, piece: Piece) -> None:
    """The points there are, the last first."""
    if not piece.pairs:
        return
    row = imgui.get_frame_height() + imgui.get_style().item_spacing.y
    height = min(len(piece.pairs), _MOST_ROWS) * row + 6 * unit()
    imgui.push_style_color(imgui.Col_.child_bg, colours(app).field)
    imgui.begin_child("points", ImVec2(0, height))
    imgui.pop_style_color()
    gone = None
    for number in reversed(range(len(piece.pairs))):
        pair = piece.pairs[number]
        imgui.push_id(number)
        side = imgui.get_frame_height()
        imgui.align_text_to_frame_padding()
        room = imgui.get_content_region_avail().x - side - 40 * unit()
        imgui.text_disabled(f" {number + 1}")
        imgui.same_line(34 * unit())
        imgui.text_unformatted(cut(fit_landmarks.words_of(pair.name, pair.vertex), room))
        imgui.same_line(imgui.get_content_region_avail().x + imgui.get_cursor_pos_x() - side)
        if icon_button(app, fonts.CLOSE, "remove", "Take this point away"):
            gone = number
        imgui.pop_id()
    imgui.end_child()
    if gone is not None:
        fit_wrap.remove_point(app, piece, gone)


def _files(app: App, piece: Piece) -> None:
    pressed = button_row(
        app,
        (
            ("Undo last", "Takes the last point away (Ctrl+Z)", bool(piece.pairs)),
            ("Clear", "Takes all points away", bool(piece.pairs)),
            ("Open…", "Points kept in a file (CSV)", True),
            ("Save…", "Keep the points in a file (CSV)", bool(piece.pairs)),
        ),
    )
    if pressed == "Undo last":
        fit_wrap.remove_point(app, piece, len(piece.pairs) - 1)
    elif pressed == "Clear":
        fit_wrap.remove_all(app, piece)
    elif pressed == "Open…":
        actions.ask_for(app, "open pairs")
    elif pressed == "Save…":
        actions.ask_for(app, "save pairs")


def _state(app: App, piece: Piece) -> None:
    """How far one is: enough points, or work going on; wrapping again, where it was done once."""
    job = app.jobs.of_kind(WRAP_JOB)
    if job is not None:
        progress_row(app, job.fraction, job.doing, job.remaining_secs)
        return
    doubt = fit_wrap.doubt(app, piece)
    words = doubt or fit_landmarks.enough_words(len(piece.pairs))
    wrapped_text(words, colours(app).error if doubt else colours(app).dim)
    if piece.quality is not None and button_row(
        app, (("Wrap again", _WRAP_TIP, fit_wrap.can_wrap(app, piece)),)
    ):
        fit_wrap.wrap(app, piece)


def way(app: App, piece: Piece | None) -> Way | None:
    """What leads on while a scan waits to be wrapped; None where nothing does."""
    if piece is None or fit_wrap.pointed_piece(app) is not piece:
        return None
    job = app.jobs.of_kind(WRAP_JOB)
    if job is not None:
        return Way("Cancel", "Stop; the points stay", True, job.cancel, calm=True)
    if piece.quality is not None:
        return None
    usable = fit_wrap.can_wrap(app, piece)
    return Way("Wrap the template around it", _WRAP_TIP, usable, partial(fit_wrap.wrap, app, piece))


def progress_row(app: App, fraction: float, doing: str, left_secs: float | None) -> None:
    """How far work is, what it does, how long it still takes."""
    imgui.spacing()
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(0, 0))
    imgui.progress_bar(fraction, ImVec2(-1, 6 * unit()), "")
    imgui.pop_style_var()
    left = f"{duration_words(left_secs)} left" if left_secs is not None else ""
    words = [doing, f"{round(fraction * 100)} %", left]
    wrapped_text("  ·  ".join(word for word in words if word), colours(app).dim)


def _quality(app: App, piece: Piece) -> None:
    """How well the template lies on the scan, in numbers and in words."""
    quality = piece.quality
    assert quality is not None
    scale, name = fit_views.shown_lengths(fit_views.scan_face(app, piece).rig)
    rows = (
        ("mean", quality.mean, quality.mean_percent),
        ("95 % within", quality.p95, quality.p95_percent),
        ("largest", quality.largest, quality.largest_percent),
    )
    imgui.spacing()
    heads = ("Distance to the scan", name, "% of the head")
    if imgui.begin_table("quality", len(heads), imgui.TableFlags_.sizing_stretch_prop):
        imgui.table_next_row()
        for title in heads:
            imgui.table_next_column()
            imgui.text_disabled(title)
        for words, value, percent in rows:
            imgui.table_next_row()
            for text in (words, f"{value * scale:.2g}", f"{percent:.3f}"):
                imgui.table_next_column()
                imgui.text_unformatted(text)
        imgui.end_table()
    flipped, count = len(quality.flipped), quality.triangles
    wrapped_text(f"Flipped triangles: {flipped:,} of {count:,} ({quality.flipped_percent:.2f} %).")
    wrapped_text(_verdict(quality), colours(app).dim)
    quiet_words("What the scan lacks, such as eyes, teeth or hair, comes from the template.")


def _verdict(quality: Quality) -> str:
    if quality.mean_percent > _GOOD_PERCENT:
        return "Where it is red the template is off: points there help. Then wrap it again."
    if quality.flipped_percent > _GOOD_PERCENT:
        return "It lies well; some triangles are turned over, most often at lids and lips: points there help."
    return "It lies well."
