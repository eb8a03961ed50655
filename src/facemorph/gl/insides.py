"""`Insides`: whether anything of a shell's insides can be seen in a frame, so that they need no drawing.

Where nobody looks in through a rim (its cap is drawn, invisibly, behind the outsides, and counted), the
insides of a shell are hidden; `gl.shell` tells why. As a surface may pass through itself the wrong way, that
is not believed but watched: frames of full quality draw the insides all the same and count what is seen of
them, as do the first and every sixteenth frame that would leave them out. A face of which once something
was seen so is drawn from both sides for good.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.camera import Camera
from facemorph.gl.shell import outwardness

if TYPE_CHECKING:
    import moderngl

# Of what normals point outwards at rest, so much must be left in a pose.
_STILL_OUTWARD = 0.5
# Where a surface turns away from the eye, front and back are as near as depth can tell: so many samples of
# a picture, and a share of them, may pass for seen.
_STRAY_SAMPLES, _STRAY_SHARE = 8, 1e-5
_WATCHED_EVERY = 16


class Insides:
    """Of one surface. `trusted` once what should be hidden was seen to be; never again where it was not."""

    def __init__(self, ctx: moderngl.Context, positions: Float32, normals: Float32) -> None:
        self._seen = ctx.query(samples=True)
        self._leak = ctx.query(samples=True)
        self._watched = 0
        self._unwatched = 0
        self.trusted: bool | None = None
        self._at_rest = outwardness(positions, normals)
        self.follow(positions, normals)

    def follow(self, positions: Float32, normals: Float32) -> None:
        """Take the pose to be drawn: positions and normals (V, 3)."""
        box = np.array([[axis.min(), axis.max()] for axis in positions.T], np.float64)
        self._corners: Float64 = np.stack(np.meshgrid(*box, [1.0], indexing="ij"), axis=-1).reshape(-1, 4)
        self._outward = outwardness(positions, normals) > _STILL_OUTWARD * self._at_rest > 0.0

    def may_be_hidden(self, camera: Camera, aspect: float) -> bool:
        """Whether it is worth looking: the pose is not inside out, and the near plane cuts nothing open."""
        if self._watched:
            self.trusted = self.trusted is not False and self._leak.samples <= _stray(self._watched)
            self._watched = 0
        if self.trusted is False or not self._outward:
            return False
        clip = self._corners @ camera.clip_from_model(aspect).T
        return bool((clip[:, 2] > -clip[:, 3]).all())

    def looked_into(self, caps: moderngl.VertexArray, first: int, count: int, samples: int) -> bool:
        """Whether a cap is seen past what is drawn into so many samples; GL's masks are set by the caller."""
        if not count:
            return False
        with self._seen:
            caps.render(vertices=count, first=first)
        return bool(self._seen.samples > _stray(samples))

    def may_be_left_out(self, *, hurried: bool) -> bool:
        """Whether hidden insides need not be drawn this time; where they are, do it `watching`."""
        self._unwatched += 1
        if hurried and self.trusted and self._unwatched < _WATCHED_EVERY:
            return True
        self._unwatched = 0
        return False

    def watching(self, samples: int) -> moderngl.Query:
        """In a `with`: what is drawn meanwhile should be hidden, and tells when it is not."""
        self._watched = samples
        return self._leak


def _stray(samples: int) -> float:
    """How many of a picture's samples may be seen by chance."""
    return _STRAY_SAMPLES + _STRAY_SHARE * samples
