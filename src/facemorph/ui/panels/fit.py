"""The page Fit: a person's blendshapes from a template, a neutral and a few examples, step by step."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, imgui

from facemorph.core.rig import Rig, plain_label
from facemorph.ui import actions, fit_carry, fit_files, fit_run, fit_views, fit_wrap
from facemorph.ui.fit_page import EXAMPLES, MAKE_JOB, NEUTRAL, START_JOB, TEMPLATE, WRAP_JOB
from facemorph.ui.fit_plan import Piece
from facemorph.ui.fit_tool import PointsTool, TitlesTool
from facemorph.ui.panels import fit_points, fit_result, fit_weights
from facemorph.ui.panels.fit_rows import Step, Way, bright_button, piece_row, stepper, wrapped_text
from facemorph.ui.panels.rows import quiet_words
from facemorph.ui.panels.shapes import SET_TITLES
from facemorph.ui.panels.value_rows import button_row, choice
from facemorph.ui.state import App
from facemorph.ui.widgets import chip_width, colours, cut, right_edge, tooltip, unit

_INTRO = (
    "The template's shapes, made for another person: from a mesh of them at rest, and better with a few "
    "of their expressions."
)
_MANY = 4
_TEMPLATE_TIP = "The face whose shapes are copied: the person gets the same shapes under the same names"
_NEUTRAL_HELP = (
    "The person without expression, as a mesh. Drop a file on the window, or a folder with the neutral and "
    "expressions in it."
)
_EXAMPLES_HELP = (
    "The same person making faces, a file each. None is well: the template's motion is then carried over as "
    "it is. Two to four that mix only a few shapes each teach the most. A file called as shapes are, such as "
    "happy or AU1+AU4, is taken for these."
)


def draw(app: App) -> None:
    """The page's contents."""
    fit_files.refresh(app)
    fit_carry.refresh(app)
    imgui.align_text_to_frame_padding()
    width = chip_width("Start over")
    imgui.text_unformatted(
        cut("Make a person's blendshapes", imgui.get_content_region_avail().x - width - 8 * unit())
    )
    imgui.same_line(right_edge() - width)
    imgui.begin_disabled(not app.fit.pieces)
    if imgui.button("Start over"):
        fit_files.start_over(app)
    imgui.end_disabled()
    tooltip("Takes out the neutral and the examples; undo brings them back")
    imgui.spacing()
    page, steps = app.pages.fit, _steps(app)
    page.step = stepper(app, steps, page.step)
    if not steps[page.step].usable:
        page.step = next(place for place in reversed(range(page.step)) if steps[place].usable)
    below = imgui.get_frame_height() + 2 * imgui.get_style().item_spacing.y
    imgui.begin_child("fit page", ImVec2(0, -below))
    imgui.push_id(page.step)
    way = _BODIES[page.step](app)
    imgui.pop_id()
    imgui.end_child()
    _foot(app, way)
    fit_views.put(app)
    _tool(app)
    waits = (WRAP_JOB,) if page.step in (NEUTRAL, EXAMPLES) else (START_JOB, MAKE_JOB)
    app.on_face.tells = frozenset(waits)


def _tool(app: App) -> None:
    split = app.on_face.split
    if split is None:
        return
    points = fit_wrap.pointed_piece(app) is not None and not split.heat
    app.on_face.tool = PointsTool() if points else TitlesTool()


def _steps(app: App) -> tuple[Step, ...]:
    plan, page = app.fit, app.pages.fit
    ready, made = plan.ready, page.made is not None
    current = made and fit_run.is_current(app)
    fitting = plan.neutral is not None and plan.neutral.fitted is not None
    waiting = [piece for piece in plan.examples if piece.fitted is None]
    examples = f"{len(plan.examples)} of them" if plan.examples else "none"
    if waiting:
        examples = f"{len(waiting)} of {len(plan.examples)} to be mended"
    has = plan.template is not None
    first = "" if ready else "\nFirst a template, a neutral, and examples that all fit"
    before = "" if made else "\nFirst make the shapes"
    return (
        Step("Template", plan.template.title if plan.template else "", has, True, _TEMPLATE_TIP),
        Step("Neutral", plan.neutral.name if plan.neutral else "", fitting, has, "The person at rest"),
        Step("Examples", examples, (bool(plan.examples) and not waiting) or current, has,
             "The person's expressions, if there are some"),
        Step("Starting weights", fit_weights.summary(app), current, ready,
             f"Which of the template's shapes make up each example{first}"),
        Step("Make the shapes", fit_result.making_words(app), current, ready,
             f"The fit, and how it goes{first}"),
        Step("Result", fit_result.summary(app), current, made,
             f"The fitted person beside each example{before}"),
        Step("Save", page.saved, bool(page.saved), made,
             f"As a face folder that opens like any other{before}"),
    )  # fmt: skip


def _foot(app: App, way: Way) -> None:
    """Back, and the button that leads on."""
    page, scale = app.pages.fit, unit()
    if page.step > TEMPLATE:
        if imgui.button("Back"):
            page.step -= 1
        imgui.same_line(0, 6 * scale)
    if not way.words:
        return
    if way.calm:
        pressed = imgui.button(way.words, ImVec2(-1, 0))
        tooltip(way.tip)
    else:
        pressed = bright_button(app, way.words, way.tip, usable=way.usable)
    if pressed:
        way.go()


def _to_next(app: App, words: str, *, usable: bool) -> Way:
    def go() -> None:
        app.pages.fit.step += 1

    return Way(words, "", usable, go)


def _template(app: App) -> Way:
    plan = app.fit
    quiet_words(_INTRO)
    imgui.spacing()
    wrapped_text(f"{_TEMPLATE_TIP}:")
    choices = {f"builtin {name}": plain_label(name) for name in app.builtins}
    chosen = ""
    if plan.template is not None:
        face = plan.template
        chosen = f"builtin {face.source[0]}" if face.builtin else "chosen"
        if chosen == "chosen" or chosen not in choices:
            chosen, choices = "chosen", {"chosen": face.title, **choices}
    if app.face is not None and app.face is not plan.template and app.face.rig.controls:
        choices = {"open": f"The open face ({app.face.title})", **choices}
    now = choice(app, "template", chosen, choices or {"": "No face"}, "The face whose shapes are copied")
    if now != chosen and now == "open" and app.face is not None:
        fit_files.use_template(app, app.face)
    elif now != chosen and now.startswith("builtin "):
        fit_files.ask_template(app, [now.removeprefix("builtin ")], builtin=True)
    if button_row(
        app, (("Open a folder…", "Another face folder with shapes; you can also drop it here", True),)
    ):
        actions.ask_for(app, "fit template")
    if plan.template is None:
        quiet_words("Choose a face that has shapes.")
    else:
        quiet_words(_facts(plan.template.rig))
    return _to_next(app, "Next: the neutral", usable=plan.template is not None)


def _facts(rig: Rig) -> str:
    counts: dict[str, int] = {}
    for shape in rig.controls:
        counts[shape.set] = counts.get(shape.set, 0) + 1
    named = ", ".join(f"{count} {_set_words(name)}" for name, count in counts.items())
    return f"{rig.neutral.vertex_count:,} vertices; {named}."


def _set_words(name: str) -> str:
    title = SET_TITLES.get(name, plain_label(name))
    return title if title.split()[0].isupper() or title.startswith("AR") else title.lower()


def _neutral(app: App) -> Way:
    plan = app.fit
    piece = plan.neutral
    if piece is None:
        quiet_words(_NEUTRAL_HELP)
    imgui.spacing()
    if piece is not None:
        if piece_row(app, piece, selected=True, selectable=False) == "remove":
            fit_files.take_out(app, piece.key)
        _mending(app, piece)
    elif fit_files.reading(app):
        quiet_words("Reading…")
    words = "Another file…" if piece is not None else "Open…"
    if button_row(app, ((words, "The mesh of the person without expression", True),)):
        actions.ask_for(app, "fit neutral")
    usable = piece is not None and piece.fitted is not None
    return fit_points.way(app, piece) or _to_next(app, "Next: examples", usable=usable)


def _examples(app: App) -> Way:
    plan, page = app.fit, app.pages.fit
    if len(plan.examples) < 3:
        quiet_words(_EXAMPLES_HELP)
    imgui.spacing()
    shown, brief = fit_wrap.shown_example(app), len(plan.examples) > _MANY
    for piece in plan.examples:
        asked = piece_row(app, piece, selected=piece is shown, selectable=True, brief=brief)
        if asked == "select":
            page.selected = piece.key
        elif asked == "remove":
            fit_files.take_out(app, piece.key)
        if piece is shown:
            _mending(app, piece)
    if fit_files.reading(app):
        quiet_words("Reading…")
    if button_row(app, (("Add files…", "Meshes of the person's expressions; you can also drop them", True),)):
        actions.ask_for(app, "fit examples")
    if plan.neutral is None or plan.neutral.fitted is None:
        quiet_words("The neutral comes first: step 2.")
    elif plan.waiting:
        quiet_words("Mend the examples marked !, or take them out.")
    words = "Next: starting weights" if plan.examples else "Next, without examples"
    return fit_points.way(app, shown) or _to_next(app, words, usable=plan.ready)


def _mending(app: App, piece: Piece) -> None:
    """What can be done about a mesh that does not fit as it came."""
    standing = piece.finding.standing
    if standing == "order" and piece.fitted is None:
        tip = "Renumbers its vertices as in the template, by how they hang together; the file stays as it is"
        many = len(fit_files.disordered(app))
        words = "Put them in order" if many == 1 else f"Put all {many} in order"
        if button_row(app, ((words, tip, app.jobs.of_kind("fit order") is None),)):
            fit_files.put_in_order(app)
    elif standing == "other" and fit_wrap.pointed_piece(app) is piece:
        fit_points.draw(app, piece)
    elif standing == "unusable":
        wrapped_text("Mend it in your modelling program, or take another file.", colours(app).dim)


_BODIES: tuple[Callable[[App], Way], ...] = (
    _template,
    _neutral,
    _examples,
    fit_weights.draw,
    fit_result.draw_make,
    fit_result.draw_result,
    fit_result.draw_save,
)
