"""Short notes for the user: news that goes by itself, errors that stay until they are read."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

NEWS_SECS = 5.0
MOST_SHOWN = 5


@dataclass(frozen=True, eq=False)
class Message:
    """`text` is for people; `details` (a traceback, say) is copied with it but not shown."""

    text: str
    error: bool
    born_secs: float
    details: str = ""

    @property
    def copied(self) -> str:
        """What the copy button puts on the clipboard."""
        return f"{self.text}\n\n{self.details}" if self.details else self.text


@dataclass
class Messages:
    """The messages on show, oldest first."""

    clock: Callable[[], float] = time.monotonic
    shown: list[Message] = field(default_factory=list)

    def tell(self, text: str) -> None:
        """News: gone after a few seconds."""
        self._add(Message(text, False, self.clock()))

    def fail(self, text: str, details: str = "") -> None:
        """An error: stays until the user closes it."""
        self._add(Message(text, True, self.clock(), details))

    def close(self, message: Message) -> None:
        """Take one message away."""
        self.shown = [other for other in self.shown if other is not message]

    def expire(self) -> None:
        """Take away the news that has been up long enough."""
        now = self.clock()
        self.shown = [m for m in self.shown if m.error or now - m.born_secs < NEWS_SECS]

    def next_change_secs(self) -> float | None:
        """Seconds until a message goes by itself, or None."""
        now = self.clock()
        return min((max(m.born_secs + NEWS_SECS - now, 0.0) for m in self.shown if not m.error), default=None)

    def _add(self, message: Message) -> None:
        # The same complaint twice tells nothing new: the newer one takes the older one's place.
        others = [m for m in self.shown if m.text != message.text]
        self.shown = [*others, message][-MOST_SHOWN:]
