"""Commands of the People page: a part of the table of commands."""

from __future__ import annotations

from functools import partial

from facemorph.ui import actions, people
from facemorph.ui.command import Command, has_face

_MENU = "Expression/People"
PEOPLE = (
    Command("People: another face…", partial(actions.ask_for, purpose="person"), _MENU, enabled=has_face,
            help="Mix the face with somebody from a file of yours (2.10)"),
    Command("People: another face's folder…", partial(actions.ask_for, purpose="person folder"), _MENU,
            enabled=has_face, help="Mix the face with somebody from a folder of yours (2.10)"),
    Command("People: swap", people.swap, _MENU, enabled=people.can_swap,
            help="Both people change places; the face stays as it is"),
    Command("People: start again", people.start_again, _MENU, enabled=people.can_start_again,
            help="From the face itself again, s is 0; the expression stays"),
    Command("People: reset", people.reset, _MENU, enabled=people.moves,
            help="The face itself without expression, and nobody to mix it with"),
    Command("People: skin too", people.toggle_skins, _MENU, enabled=has_face,
            checked=lambda app: app.controls.people.skins,
            help="The colours of skin and eyes blend along s as well (2.1.2)"),
)  # fmt: skip
