"""Keys as people write them: `Ctrl+Shift+Z`, `Space`, `F1`."""

from __future__ import annotations

import sys
from dataclasses import dataclass

MODIFIERS = ("Ctrl", "Shift", "Alt")
# Where a text field is being typed into, these belong to the text.
_TEXT_EDITING = frozenset({"A", "C", "V", "X", "Y", "Z", "Left", "Right", "Home", "End"})


@dataclass(frozen=True)
class Chord:
    """A key with the modifiers held."""

    key: str
    ctrl: bool = False
    shift: bool = False
    alt: bool = False

    @classmethod
    def parse(cls, text: str) -> Chord:
        """`Ctrl+Shift+Z` as a chord."""
        *held, key = text.split("+")
        unknown = [word for word in held if word not in MODIFIERS]
        if unknown or not key:
            raise ValueError(f"no chord: {text!r}")
        return cls(key, "Ctrl" in held, "Shift" in held, "Alt" in held)

    @property
    def shown(self) -> str:
        """As menus show it; on a Mac the command key takes Ctrl's place."""
        ctrl = "Cmd" if sys.platform == "darwin" else "Ctrl"
        held = ((self.ctrl, ctrl), (self.shift, "Shift"), (self.alt, "Alt"))
        return "+".join([*(word for down, word in held if down), self.key])

    @property
    def typed(self) -> bool:
        """Whether a text field wants this chord for itself."""
        if self.key.startswith("F") and len(self.key) > 1:
            return False
        return not self.ctrl or self.key in _TEXT_EDITING
