"""The command line: verbs, each one call of the library. Only here and in the window is anything printed."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Sequence

from facemorph.errors import FacemorphError

STATUS_REFUSED = 2
STATUS_INTERRUPTED = 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns its exit status. An error a person caused is one line, and status 2."""
    from facemorph.cli.parser import parsed

    _print_any_letter()
    try:
        options = parsed(sys.argv[1:] if argv is None else list(argv))
        status = int(options.verb(options))
        sys.stdout.flush()
        return status
    except FacemorphError as error:
        return _refused(str(error))
    except MemoryError:
        return _refused("there is not enough memory for this.")
    except BrokenPipeError:
        # Whoever read our output has enough; what is still buffered goes nowhere, without a traceback.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return STATUS_REFUSED
    except OSError as error:
        return _refused(f"{error.filename or 'the system'}: {error.strerror or error}.")
    except KeyboardInterrupt:
        return STATUS_INTERRUPTED


def _print_any_letter() -> None:
    """Names that the terminal's encoding lacks are printed escaped, and stop nothing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _refused(problem: str) -> int:
    line = " ".join(problem.split())
    print(f"facemorph: {line}", file=sys.stderr)
    return STATUS_REFUSED
