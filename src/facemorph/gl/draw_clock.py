"""How long a graphics card draws at a frame, asked so late that nothing waits for the answer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import moderngl


class DrawClock:
    """`secs` is how long the frame before the last took; None until that is known."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._query = ctx.query(time=True)
        self._asked = False
        self.secs: float | None = None

    @contextmanager
    def running(self) -> Iterator[None]:
        """What is drawn inside is timed."""
        if self._asked:
            self.secs = self._query.elapsed * 1e-9
        with self._query:
            yield
        self._asked = True
