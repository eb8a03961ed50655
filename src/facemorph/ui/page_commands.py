"""Commands that open the pages of the panel on the right: a part of the table of commands."""

from __future__ import annotations

from functools import partial

from facemorph.ui import actions
from facemorph.ui.command import Command
from facemorph.ui.state import App


def page_commands() -> tuple[Command, ...]:
    """One for each page, in the tabs' order."""
    # Not at the top: pages are drawn by modules that read the table.
    from facemorph.ui.panels import right_tabs

    return tuple(
        Command(
            tab.title,
            partial(actions.show_page, title=tab.title),
            "View/Page",
            checked=partial(_is_on_show, tab.title),
            help=tab.tip,
        )
        for tab in right_tabs()
    )


def _is_on_show(title: str, app: App) -> bool:
    return app.settings.right_page == title and app.settings.right_open and not app.panels_hidden
