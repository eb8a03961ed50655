"""Drawing with OpenGL 3.3: contexts, the renderer, pictures, picking. moderngl appears here only."""

from __future__ import annotations

from facemorph.gl.context import create_context, wrap_window_context
from facemorph.gl.describe import Graphics, describe
from facemorph.gl.heat import Legend, heat_legend
from facemorph.gl.legend import with_legend
from facemorph.gl.mipmaps import texture_of
from facemorph.gl.offscreen import Offscreen, render
from facemorph.gl.picking import Pick, pick
from facemorph.gl.renderer import Renderer
from facemorph.gl.sheet import sheet

__all__ = [
    "Graphics",
    "Legend",
    "Offscreen",
    "Pick",
    "Renderer",
    "create_context",
    "describe",
    "heat_legend",
    "pick",
    "render",
    "sheet",
    "texture_of",
    "with_legend",
    "wrap_window_context",
]
