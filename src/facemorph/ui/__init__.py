"""The window. `run` opens it; everything else here is its own business."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path


def run(
    source: str | Path | Sequence[str | Path] | None = None, weights: Mapping[str, float] | None = None
) -> int:
    """Open the window on a face and stay until it is shut; gives the exit status 0.

    source   a built-in's name, a folder, a mesh file, or several files; None for the first built-in
    weights  shape name -> weight to start with

    Raises `DisplayError` where there is no screen, `GraphicsError` where OpenGL is missing, and what
    `io.load_rig` raises when the first face cannot be read.
    """
    from facemorph.ui.run import run_window

    return run_window(source, weights or {})
