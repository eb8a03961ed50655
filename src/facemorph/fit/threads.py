"""One thread for matrix products: several wait for each other where cores are few or busy."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class _Limit:
    """The limit is the process's, so all threads share one: the first in sets it, the last out lifts it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._inside = 0
        self._limits: Any = None

    def enter(self) -> None:
        """Somebody begins."""
        from threadpoolctl import threadpool_limits

        with self._lock:
            if not self._inside:
                self._limits = threadpool_limits(limits=1, user_api="blas")
            self._inside += 1

    def leave(self) -> None:
        """Somebody ends."""
        with self._lock:
            self._inside -= 1
            if not self._inside:
                self._limits.restore_original_limits()


# There is one of it in a process, as there is one BLAS.
_LIMIT = _Limit()


@contextmanager
def one_thread() -> Iterator[None]:
    """Matrix products use one thread while anybody is inside; after the last, as many as before."""
    _LIMIT.enter()
    try:
        yield
    finally:
        _LIMIT.leave()
