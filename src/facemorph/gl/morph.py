"""What a way of morphing promises, and what is kept of what it did."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from facemorph.core.arrays import Float32, Float64
from facemorph.core.blend import Blend
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.gl.programs import Programs
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl


class Morph(Protocol):
    """A way to fill a surface's morphed buffer; `vertices` (V, 6) are what it holds, None where unknown."""

    vertices: Float32 | None

    def update(self, pose: Pose, offsets: Float32 | None = None, *, exactly: bool) -> None:
        """Morph to `pose` plus `offsets` (V, 3)."""

    def bind(self, surface: Surface) -> None:
        """Fill `surface` from now on, of the same mesh."""

    def release(self) -> None:
        """Give back what the context holds."""


@dataclass
class Stats:
    """What was done since the face was loaded: frames drawn, how many had to morph, partners taken."""

    frames: int = 0
    morphs: int = 0
    partners: int = 0


@dataclass(frozen=True, eq=False)
class Shown:
    """What the morphed buffer holds."""

    pose: Pose
    coefficients: Float64
    offsets: Float32 | None
    exactly: bool
    face: Mapping[str, object]


def new_morph(
    path: str, ctx: moderngl.Context, programs: Programs, blend: Blend, rig: Rig, surface: Surface
) -> Morph:
    """The way that `path` names, "shader" or "cpu", to morph `rig` on `surface`. Raises `GraphicsError`."""
    if path == "shader":
        from facemorph.gl.morph_shader import ShaderMorph

        return ShaderMorph(ctx, programs, rig, surface)
    from facemorph.gl.morph_cpu import CpuMorph

    return CpuMorph(ctx, rig, surface, blend)
