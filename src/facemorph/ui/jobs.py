"""Long work beside the window: worker threads that tell their progress and can be cancelled."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, TypeVar

from facemorph.core.progress import Progress
from facemorph.errors import JobCancelledError

T = TypeVar("T")
# Work shorter than this shows no progress: it would only flicker.
SHOWN_AFTER_SECS = 0.3


@dataclass(eq=False)
class Job:
    """One piece of work: `fraction` 0..1 done, and what it is `doing`."""

    title: str
    kind: str
    future: Future[Any] = field(default_factory=Future)
    fraction: float = 0.0
    doing: str = ""
    started_secs: float = field(default_factory=time.monotonic)
    done: Callable[[Any], None] = lambda result: None
    failed: Callable[[BaseException], None] = lambda error: None
    quiet: bool = False
    _cancelled: threading.Event = field(default_factory=threading.Event)

    def progress(self, fraction: float, doing: str) -> None:
        """The `Progress` that the work is given; called from the worker's thread."""
        if self._cancelled.is_set():
            raise JobCancelledError(f"{self.title}: cancelled.")
        self.fraction, self.doing = min(max(fraction, 0.0), 1.0), doing

    def cancel(self) -> None:
        """Ask the work to stop; it does at its next word about progress."""
        self._cancelled.set()
        self.future.cancel()

    @property
    def cancelled(self) -> bool:
        """Somebody asked the work to stop; its result is not wanted any more."""
        return self._cancelled.is_set()

    @property
    def elapsed_secs(self) -> float:
        """How long the work has been going on."""
        return time.monotonic() - self.started_secs

    @property
    def remaining_secs(self) -> float | None:
        """How long it still takes, judged by the way so far; None while that says too little."""
        if self.fraction < 0.05:
            return None
        return self.elapsed_secs * (1.0 - self.fraction) / self.fraction


class Jobs:
    """The work going on. `wake` is called from worker threads when one ends; it must be thread-safe."""

    def __init__(self, wake: Callable[[], None] = lambda: None) -> None:
        self.wake = wake
        self.running: list[Job] = []
        self._threads: ThreadPoolExecutor | None = None

    def start(
        self,
        title: str,
        work: Callable[[Progress], T],
        done: Callable[[T], None],
        failed: Callable[[BaseException], None],
        *,
        kind: str = "",
        quiet: bool = False,
    ) -> Job:
        """Run `work(progress)` in a thread; `done(result)` or `failed(error)` follow in `finish`.

        Work of the same non-empty `kind` that still runs is cancelled first. `quiet` work is never shown.
        """
        for other in self.running:
            if kind and other.kind == kind:
                other.cancel()
        if self._threads is None:
            self._threads = ThreadPoolExecutor(max_workers=3, thread_name_prefix="facemorph")
        job = Job(title, kind, done=done, failed=failed, quiet=quiet)
        job.future = self._threads.submit(work, job.progress)
        job.future.add_done_callback(lambda _future: self.wake())
        self.running.append(job)
        return job

    def finish(self) -> None:
        """Hand over what has ended; called by the window's thread once a frame."""
        ended = [job for job in self.running if job.future.done()]
        self.running = [job for job in self.running if job not in ended]
        for job in ended:
            error = CancelledError() if job.future.cancelled() else job.future.exception()
            if job.cancelled or isinstance(error, CancelledError | JobCancelledError):
                continue
            if error is None:
                job.done(job.future.result())
            else:
                job.failed(error)

    def shown(self) -> list[Job]:
        """Work long enough under way to be worth a progress bar."""
        return [job for job in self.running if not job.quiet and job.elapsed_secs > SHOWN_AFTER_SECS]

    def of_kind(self, kind: str) -> Job | None:
        """The work of one kind that is wanted still, or None."""
        return next((job for job in self.running if job.kind == kind and not job.cancelled), None)

    def close(self) -> None:
        """Cancel everything; nothing is waited for here."""
        for job in self.running:
            job.cancel()
        self.running.clear()
        if self._threads is not None:
            self._threads.shutdown(wait=False, cancel_futures=True)
            self._threads = None
