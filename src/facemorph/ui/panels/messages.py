"""Top right: messages that slide in, and the long work going on with its progress and Cancel."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from facemorph.ui import fonts
from facemorph.ui.jobs import Job
from facemorph.ui.layout import Layout
from facemorph.ui.messages import Message
from facemorph.ui.state import App
from facemorph.ui.theme import packed
from facemorph.ui.widgets import colours, icon_button, unit
from facemorph.ui.words import duration_words

_FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.always_auto_resize
)
SLIDE_SECS = 0.18
_WIDTH = 400.0


def draw(app: App, layout: Layout) -> None:
    """The notes, newest below, and the jobs under them."""
    app.messages.expire()
    view, scale = app.viewport, unit()
    width = min(_WIDTH * scale, max(view.width - 28 * scale, 160 * scale))
    right, y = view.x + view.width - 14 * scale, view.y + 12 * scale
    now = app.messages.clock()
    for message in list(app.messages.shown):
        arrived = min((now - message.born_secs) / SLIDE_SECS, 1.0)
        shift = (1.0 - arrived) ** 2 * 60 * scale
        y += _message(app, message, right - width + shift, y, width) + 8 * scale
    for job in app.jobs.shown():
        if job.kind in app.on_face.tells:
            continue
        y += _job(app, job, right - width, y, width) + 8 * scale


def sliding(app: App) -> bool:
    """Whether a message is still on its way in."""
    now = app.messages.clock()
    return any(now - message.born_secs < SLIDE_SECS for message in app.messages.shown)


def _begin(app: App, name: str, x: float, y: float, width: float) -> None:
    imgui.set_next_window_pos((x, y))
    imgui.set_next_window_size_constraints((width, 0), (width, 100000))
    imgui.push_style_color(imgui.Col_.window_bg, colours(app).popup)
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 6 * unit())
    imgui.push_style_var(imgui.StyleVar_.window_border_size, unit())
    imgui.begin(name, None, _FLAGS)
    imgui.pop_style_var(2)
    imgui.pop_style_color()


def _message(app: App, message: Message, x: float, y: float, width: float) -> float:
    c, scale = colours(app), unit()
    _begin(app, f"##message {id(message)}", x, y, width)
    side = imgui.get_frame_height()
    buttons = (2 * side + 2 * scale) if message.error else side
    place = imgui.get_cursor_screen_pos()
    if message.error:
        bar = imgui.get_window_pos()
        low = (bar.x + 4 * scale, bar.y + imgui.get_window_height())
        imgui.get_window_draw_list().add_rect_filled(bar, low, packed(c.error), 2 * scale)
    imgui.begin_group()
    imgui.dummy(ImVec2(0, 0))
    imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + width - 24 * scale - buttons - 8 * scale)
    imgui.text_unformatted(breakable(message.text))
    imgui.pop_text_wrap_pos()
    imgui.end_group()
    imgui.set_cursor_screen_pos((place.x + width - 24 * scale - buttons, place.y))
    if message.error:
        if icon_button(app, fonts.COPY, "copy", "Copy"):
            imgui.set_clipboard_text(message.copied)
        imgui.same_line(0, 2 * scale)
    if icon_button(app, fonts.CLOSE, "close", "Close"):
        app.messages.close(message)
    height = imgui.get_window_height()
    imgui.end()
    return float(height)


def breakable(text: str, longest: int = 36) -> str:
    """`text` with room for line breaks inside long words such as paths."""
    return " ".join(_broken(word, longest) for word in text.split(" "))


def _broken(word: str, longest: int) -> str:
    if len(word) <= longest:
        return word
    parts: list[str] = []
    while len(word) > longest:
        at = max(word.rfind(sign, 8, longest) for sign in "/\\_-.") + 1
        at = at if at > 0 else longest
        parts.append(word[:at])
        word = word[at:]
    return "\n".join([*parts, word])


def _job(app: App, job: Job, x: float, y: float, width: float) -> float:
    scale = unit()
    _begin(app, f"##job {id(job)}", x, y, width)
    cancel = imgui.calc_text_size("Cancel").x + 2 * imgui.get_style().frame_padding.x
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(f"{job.title}…")
    imgui.same_line(width - 12 * scale - cancel)
    if imgui.button("Cancel"):
        job.cancel()
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(0, 0))
    imgui.progress_bar(job.fraction, ImVec2(-1, 5 * scale), "")
    imgui.pop_style_var()
    left = job.remaining_secs
    words = [
        job.doing,
        f"{round(job.fraction * 100)} %",
        f"{duration_words(left)} left" if left is not None else "",
    ]
    imgui.push_text_wrap_pos(0.0)
    imgui.text_disabled("  ·  ".join(word for word in words if word))
    imgui.pop_text_wrap_pos()
    height = imgui.get_window_height()
    imgui.end()
    return float(height)
