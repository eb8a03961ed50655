"""Parts of the page Fit: the fit with its progress, what came of it, and saving it as a face."""

from __future__ import annotations

import itertools
from dataclasses import replace
from functools import partial

import numpy as np
from imgui_bundle import imgui

from facemorph.fit.result import Example, Iteration
from facemorph.ui import actions, fit_run, fit_views, fit_weights
from facemorph.ui.fit_page import MAKE_JOB, RESULT, SAVE, Made
from facemorph.ui.panels.fit_points import progress_row
from facemorph.ui.panels.fit_rows import Way, wrapped_text
from facemorph.ui.panels.fit_weights import preparing
from facemorph.ui.panels.messages import breakable
from facemorph.ui.panels.rows import quiet_words
from facemorph.ui.panels.value_rows import Value, button_row, switch_row, value_row
from facemorph.ui.plots import Line, plot
from facemorph.ui.state import App
from facemorph.ui.theme import faded
from facemorph.ui.widgets import colours, cut, tooltip, unit

_HEAT_TIP = "Colours the example by how far the fitted face is from it"
_ITERATIONS_TIP = "How often shapes and weights are found in turn. Ten are plenty, four nearly do."
_PLAIN_TIP = "rms of plain deformation transfer, with the weights that suit it best: what the fit improves on"
_LONG = 8
_ADD = "Add it as a new shape"
_TABLE = imgui.TableFlags_.sizing_stretch_prop | imgui.TableFlags_.row_bg


def making_words(app: App) -> str:
    """How the step stands, in a word or two."""
    job = app.jobs.of_kind(MAKE_JOB)
    if job is not None:
        return f"{round(job.fraction * 100)} %"
    made = app.pages.fit.made
    if made is None:
        return ""
    return f"{sum(made.result.seconds.values()):.1f} s" if fit_run.is_current(app) else "to be made again"


def summary(app: App) -> str:
    """What came of it in a few words."""
    made = app.pages.fit.made
    if made is None or not made.result.examples:
        return "" if made is None else f"{len(made.result.rig.controls)} shapes"
    return f"{max(e.rms_percent for e in made.result.examples):.2f} % off at most"


def draw_make(app: App) -> Way:
    """The fit: what it will do, then how it goes."""
    fit_weights.refresh(app)
    plan, page = app.fit, app.pages.fit
    job = app.jobs.of_kind(MAKE_JOB)
    quiet_words(_doing(app))
    if plan.examples and job is None:
        row = Value("iterations", "Iterations", plan.iterations, 1.0, 20.0, _ITERATIONS_TIP, 10.0, 0)
        iterations = round(value_row(app, row))
        if iterations != plan.iterations:
            app.fit = replace(plan, iterations=iterations)
    if job is not None:
        progress_row(app, job.fraction, job.doing, job.remaining_secs)
    else:
        preparing(app)
    told = tuple(page.told) if job is not None else ()
    if job is None and page.made is not None and fit_run.is_current(app):
        told = page.made.result.history
    if told:
        _plot(app, told, plan.iterations)
    if job is not None:
        return Way("Cancel", "Stop; nothing of it is kept", True, partial(fit_run.cancel, app), calm=True)
    if fit_run.is_current(app):
        quiet_words("Made. Change a weight, or the examples, and it can be made again.")
        return Way("Next: the result", "", True, partial(fit_run.open_step, app, RESULT))
    word = "Make again" if page.made is not None else "Make the shapes"
    tip = "The window can be used meanwhile"
    return Way(word, tip, fit_run.can_make(app), partial(fit_run.make, app))


def _doing(app: App) -> str:
    plan = app.fit
    assert plan.template is not None
    count = len(plan.template.rig.controls)
    if not plan.examples:
        return f"Carries the {count} shapes of {plan.template.title} over to the person as they are."
    many = len(plan.examples)
    words = "the example" if many == 1 else f"the {many} examples"
    return (
        f"Carries the {count} shapes of {plan.template.title} over to the person, then bends them so that "
        f"they make {words}. Shapes that no example uses stay as they were carried over."
    )


def _plot(app: App, told: tuple[Iteration, ...], steps: int) -> None:
    """The error, iteration by iteration."""
    turns = np.arange(1, len(told) + 1, dtype=np.float64)
    line = Line("error", turns, np.array([turn.rms_percent for turn in told]), dots=True)
    height = 190 * unit()
    plot(app, "iterations", "iteration", "error, %", (line,), height=height, legend=False, steps=steps)
    tooltip("How far the fitted shapes are from all examples, rms in percent of the head's diagonal")


def draw_result(app: App) -> Way:
    """The person beside the example, and the errors."""
    page, made = app.pages.fit, app.pages.fit.made
    if made is None:
        quiet_words("Nothing is made yet.")
        return Way("", "", False, lambda: None)
    if not fit_run.is_current(app):
        wrapped_text("The plan has changed since this was made; step 5 makes it again.")
    if made.result.examples:
        _table(app, made)
        page.heat = switch_row(app, "Distance as colours", page.heat, _HEAT_TIP)
        shown = fit_views.shown_result(app)
        if shown is not None:
            _remaining(app, made, shown)
    else:
        quiet_words(f"{len(made.result.rig.controls)} shapes were carried over from the template.")
    return Way("Next: save", "", True, partial(fit_run.open_step, app, SAVE))


def _table(app: App, made: Made) -> None:
    """A line an example: rms, largest, in percent, and what plain transfer leaves. A click shows it."""
    (scale, unit_name), page = fit_views.shown_lengths(made.face.rig), app.pages.fit
    shown = fit_views.shown_result(app)
    keys = {piece.name: piece.key for piece in app.fit.examples}
    heads = (
        ("Example", "Click one to see it; ! marks those that the template cannot make"),
        ("rms", f"Root mean square distance to the example over all vertices, {unit_name}"),
        ("max", f"The largest distance, {unit_name}"),
        ("%", "The root mean square in percent of the head's diagonal"),
        ("transfer", f"{_PLAIN_TIP}, {unit_name}"),
    )
    imgui.push_style_color(imgui.Col_.table_row_bg_alt, faded(colours(app).field, 0.5))
    if imgui.begin_table("errors", len(heads), _TABLE):
        for place, (title, _) in enumerate(heads):
            imgui.table_setup_column(title, imgui.TableColumnFlags_.none, 1.0 if place else 1.7)
        imgui.table_next_row()
        for place, (title, tip) in enumerate(heads):
            imgui.table_next_column()
            imgui.text_disabled(f"{title}, {unit_name}" if place == 1 and unit_name == "mm" else title)
            tooltip(tip)
        plain = {example.name: example for example in made.plain}
        # What all names begin with tells nothing, and leaves no room for the rest.
        shared = _shared(tuple(plain))
        for example in made.result.examples:
            name = example.name if len(shared) < _LONG else f"…{example.name[len(shared) :]}"
            name = f"! {name}" if fit_run.is_poor(example) else name
            imgui.table_next_row()
            imgui.table_next_column()
            words = cut(name, imgui.get_content_region_avail().x)
            flags = imgui.SelectableFlags_.span_all_columns
            pressed = imgui.selectable(f"{words}##{example.name}", example is shown, flags)[0]
            tooltip(_told(example, plain[example.name]))
            if pressed and example.name in keys:
                page.selected = keys[example.name]
            other = plain[example.name]
            for text in (
                f"{example.rms * scale:.2g}",
                f"{example.largest * scale:.2g}",
                f"{example.rms_percent:.3f}",
                f"{other.rms * scale:.2g}",
            ):
                imgui.table_next_column()
                imgui.text_unformatted(text)
        imgui.end_table()
    imgui.pop_style_color()


def _shared(names: tuple[str, ...]) -> str:
    """What several names begin with, at least a letter shorter than each."""
    alike = zip(*(name[:-1] for name in names), strict=False)
    same = itertools.takewhile(lambda letters: len(set(letters)) == 1, alike)
    return "".join(letters[0] for letters in same) if len(names) > 1 else ""


def _told(example: Example, plain: Example) -> str:
    return (
        f"{example.name}\nrms {example.rms_percent:.3f} % of the head's diagonal, at most "
        f"{example.largest_percent:.3f} %\nPlain transfer: rms {plain.rms_percent:.3f} %, at most "
        f"{plain.largest_percent:.3f} %"
    )


def _remaining(app: App, made: Made, example: Example) -> None:
    """What is left of an example that the template's shapes cannot make."""
    plain = next((other for other in made.plain if other.name == example.name), None)
    if plain is not None and plain.rms > 0.0 and example.rms > 0.0:
        share = 100.0 * example.rms / plain.rms
        wrapped_text(f"{example.name}: {share:.0f} % of what plain transfer leaves.", colours(app).dim)
    added = next((shape for name, shape in made.added if name == example.name), "")
    if added:
        wrapped_text(f"What was left of it is the new shape {added!r}.")
        if button_row(app, (("Take the new shape out", "The example is then as far off as before", True),)):
            fit_run.take_shape_out(app, example.name)
        return
    if not fit_run.is_poor(example):
        return
    scale, name = fit_views.shown_lengths(made.face.rig)
    wrapped_text(
        f"The template cannot make this expression: up to {example.largest * scale:.2g} {name} "
        f"({example.largest_percent:.1f} % of the head) stay between the two. The colours show where."
    )
    page = app.pages.fit
    if page.shape_for != example.name:
        page.shape_for, page.shape_name = example.name, fit_run.shape_name(made, example)
    imgui.align_text_to_frame_padding()
    imgui.text_disabled("Name")
    imgui.same_line()
    imgui.set_next_item_width(imgui.get_content_region_avail().x)
    _, page.shape_name = imgui.input_text("##shape", page.shape_name)
    tooltip("What the new shape is called")
    tip = "What is left becomes one more shape of the person, at 1 in this example"
    if button_row(app, ((_ADD, tip, bool(page.shape_name.strip())),)):
        fit_run.add_shape(app, example, page.shape_name)


def draw_save(app: App) -> Way:
    """Name, folder, and opening it."""
    page, made = app.pages.fit, app.pages.fit.made
    if made is None:
        quiet_words("Nothing is made yet.")
        return Way("", "", False, lambda: None)
    quiet_words(
        "A folder with the neutral, every shape and face.toml. It opens in facemorph like any other face."
    )
    imgui.align_text_to_frame_padding()
    imgui.text_disabled("Name")
    imgui.same_line()
    imgui.set_next_item_width(imgui.get_content_region_avail().x)
    _, page.name = imgui.input_text("##name", page.name)
    tooltip("What the face is called in the window")
    if not fit_run.is_current(app):
        wrapped_text("The plan has changed since this was made; step 5 makes it again.")
    ask = partial(actions.ask_for, app, "save person")
    if not page.saved:
        return Way("Save as a face folder…", "A new folder; nothing is overwritten", True, ask)
    quiet_words(f"Saved in {breakable(page.saved)}")
    if button_row(app, (("Save once more…", "In another new folder", True),)):
        ask()
    tip = "In place of the open face, on the page Shapes; this page keeps what it has"
    return Way("Open it now", tip, True, partial(fit_run.open_saved, app))
