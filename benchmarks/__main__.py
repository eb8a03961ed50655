"""`python -m benchmarks [reading|blending|frames|starting ...]`: measure and print tables in Markdown."""

from __future__ import annotations

import platform
import sys

from benchmarks import blending, fit, frames, methods, reading, starting

# Cold starts come first: a process inherits the peak memory of the one that starts it.
GROUPS = {
    "starting": starting.run,
    "reading": reading.run,
    "blending": blending.run,
    "frames": frames.run,
    "methods": methods.run,
    "fit": fit.run,
}


def main(names: list[str]) -> int:
    """Run the groups named, or all."""
    unknown = [name for name in names if name not in GROUPS]
    if unknown:
        print(f"no benchmark is called {unknown[0]!r}; there are: {', '.join(GROUPS)}", file=sys.stderr)
        return 2
    print(f"Medians of one run; Python {platform.python_version()} on {platform.machine()}.\n")
    for name in names or GROUPS:
        for table in GROUPS[name]():
            print(table.text(), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
