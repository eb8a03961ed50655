"""`Command`: one thing the user can do, and the conditions that many of them share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from facemorph.ui.chord import Chord
from facemorph.ui.state import App


def always(app: App) -> bool:
    """Nothing stands in the way."""
    return True


def has_face(app: App) -> bool:
    """A face is open."""
    return app.face is not None


def has_shapes(app: App) -> bool:
    """The face has something to morph to."""
    return app.face is not None and bool(app.face.rig.shapes)


def has_expressions(app: App) -> bool:
    """The slider has somewhere to go."""
    return bool(app.expressions)


@dataclass(frozen=True)
class Command:
    """One thing the user can do. `title` may depend on the state; `keys` are alternatives."""

    title: str
    action: Callable[[App], None]
    menu: str = ""
    keys: tuple[Chord, ...] = ()
    group: int = 0
    enabled: Callable[[App], bool] = always
    checked: Callable[[App], bool] | None = None
    note: Callable[[App], str] | None = None
    help: str = ""
    repeats: bool = False

    def full_title(self, app: App) -> str:
        """The title with what it would act on: `Undo: slider to 0.62`."""
        note = self.note(app) if self.note else ""
        return f"{self.title}: {note}" if note else self.title

    def run(self, app: App) -> None:
        """Do it, if it can be done now."""
        if self.enabled(app):
            self.action(app)
