"""Medians, subprocesses and tables, shared by the benchmarks."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent


@dataclass
class Table:
    """One table of results: a title, what its ratio is against, and a row for each measurement."""

    title: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]] = field(default_factory=list)

    def add(self, *cells: str) -> None:
        """Another row."""
        self.rows.append(cells)

    def text(self) -> str:
        """The table as Markdown."""
        lines = [f"### {self.title}", "", row_text(self.columns), row_text(["---"] * len(self.columns))]
        return "\n".join([*lines, *(row_text(row) for row in self.rows), ""])


def row_text(cells: object) -> str:
    """One Markdown row."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"  # type: ignore[attr-defined]


def median_ms(work: Callable[[], object], times: int = 15, warm: int = 2) -> float:
    """Median wall time of `work` in milliseconds, after some runs that do not count."""
    for _ in range(warm):
        work()
    return median(once_ms(work) for _ in range(times))


def interleaved_ms(
    works: dict[str, Callable[[], object]], times: int = 15, warm: int = 2
) -> dict[str, float]:
    """Medians of several works taken in turn, so that a busy moment hits all of them alike."""
    for _ in range(warm):
        for work in works.values():
            work()
    seen: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(times):
        for name, work in works.items():
            seen[name].append(once_ms(work))
    return {name: median(values) for name, values in seen.items()}


def once_ms(work: Callable[[], object]) -> float:
    """Wall time of one run in milliseconds."""
    start = time.perf_counter()
    work()
    return (time.perf_counter() - start) * 1e3


@dataclass(frozen=True)
class Run:
    """A finished process: wall seconds, seconds of all processors, peak memory in MB, status and output."""

    seconds: float
    cpu_seconds: float
    peak_mb: float
    status: int
    output: str


def process(arguments: list[str], environment: dict[str, str] | None = None) -> Run:
    """Run a process and measure it; its peak memory comes from the kernel's own account."""
    # Some peers leave files of their own where they run.
    with tempfile.TemporaryDirectory() as elsewhere:
        start = time.perf_counter()
        child = subprocess.Popen(
            arguments,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=elsewhere,
            env={**os.environ, "PYTHONPATH": str(ROOT), **(environment or {})},
        )
        output = child.stdout.read() if child.stdout else ""
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.perf_counter() - start
    return Run(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, child.returncode, output)


def median_run(arguments: list[str], times: int = 5, environment: dict[str, str] | None = None) -> Run:
    """The run whose wall time is the median of several, after one that does not count: it fills caches."""
    process(arguments, environment)
    runs = sorted((process(arguments, environment) for _ in range(times)), key=lambda run: run.seconds)
    chosen = runs[len(runs) // 2]
    if chosen.status:
        raise SystemExit(f"{' '.join(arguments)} failed:\n{chosen.output}")
    return chosen


def python(code: str) -> list[str]:
    """The command that runs `code` with this interpreter."""
    return [sys.executable, "-c", code]


def have(package: str) -> bool:
    """Whether a peer is installed; without it its rows are left out and that is said."""
    return find_spec(package) is not None
