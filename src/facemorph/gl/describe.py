"""What an OpenGL context is: for About, for `facemorph doctor`, and for choosing the morph path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import moderngl

# OpenGL that runs on the CPU says so in its renderer's name.
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software", "gdi generic", "basic render")


@dataclass(frozen=True)
class Graphics:
    """A context's own words, whether it runs on the CPU, and which morph path suits it."""

    version: str
    renderer: str
    vendor: str
    software: bool
    morph: str
    max_layers: int
    max_texture: int
    max_samples: int

    def lines(self) -> list[str]:
        """One `name: value` a line, for people."""
        kind = "on the CPU" if self.software else "on a graphics card"
        return [
            f"OpenGL: {self.version}",
            f"renderer: {self.renderer} ({kind})",
            f"vendor: {self.vendor}",
            f"morphing: {self.morph} path",
            f"most: texture {self.max_texture}, array layers {self.max_layers}, samples {self.max_samples}",
        ]


def describe(ctx: moderngl.Context) -> Graphics:
    """What `ctx` is and can."""
    info = ctx.info
    renderer = str(info["GL_RENDERER"])
    software = any(word in renderer.casefold() for word in _SOFTWARE)
    return Graphics(
        version=str(info["GL_VERSION"]),
        renderer=renderer,
        vendor=str(info["GL_VENDOR"]),
        software=software,
        morph="cpu" if software else "shader",
        max_layers=int(info["GL_MAX_ARRAY_TEXTURE_LAYERS"]),
        max_texture=int(info["GL_MAX_TEXTURE_SIZE"]),
        max_samples=int(ctx.max_samples),
    )
