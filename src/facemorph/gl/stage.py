"""`Stage`: a rig at one level of subdivision as it is drawn: its surface, the people on it, its pose."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, Scene
from facemorph.errors import GraphicsError
from facemorph.gl.drivers import Driver, uniforms_of
from facemorph.gl.form import Form
from facemorph.gl.morph import Morph, Shown
from facemorph.gl.scenes import partner_surface
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl


class Stage:
    """Holds what a frame draws, and brings it up to date where it changed.

    surface   with the partners' colours from when they are first asked for; `people` are their files' meshes
    shown     what the surface holds, or None before the first pose
    """

    def __init__(
        self, ctx: moderngl.Context, rig: Rig, form: Form, morph: Callable[[Rig, Surface], Morph]
    ) -> None:
        self._ctx, self._rig = ctx, rig
        self.surface = Surface(ctx, form)
        self.people: tuple[Mesh, ...] = ()
        self.shown: Shown | None = None
        self._followed: object = None
        try:
            self._morph = morph(rig, self.surface)
        except GraphicsError:
            self.surface.release()
            raise

    def take_partners(self, partners: Sequence[Partner]) -> bool:
        """Carry the colours of `partners`; True where the surface had to be made anew for that.

        Raises `CorrespondenceError` for a partner with other polygons.
        """
        rig = self._rig
        others = {p.rig.neutral: p.rig for p in partners if p.rig.neutral is not rig.neutral}
        if not others or others.keys() == set(self.people):
            return False
        made = partner_surface(self._ctx, rig, self.surface, tuple(others.values()))
        self._morph.bind(made)
        self.surface.release()
        self.surface, self.people, self.shown = made, tuple(others), None
        return True

    def update(self, scene: Scene, drivers: Sequence[Driver], *, exactly: bool) -> bool:
        """MORPH: only when a coefficient or the offsets changed since the last frame; True where it did."""
        coefficients = self._rig.coefficients(scene.pose)
        shown = self.shown
        if (
            shown is not None
            and shown.offsets is scene.offsets
            and np.array_equal(shown.coefficients, coefficients)
            and (shown.exactly or not exactly)
        ):
            return False
        self.shown = None
        self._morph.update(scene.pose, scene.offsets, exactly=exactly)
        face: Mapping[str, object] = uniforms_of(drivers, coefficients, scene.offsets)
        self.shown = Shown(scene.pose, coefficients, scene.offsets, exactly, face)
        self._followed = None
        return True

    def watch_insides(self, *, hurried: bool) -> None:
        """Let the surface know the pose, once insides may be left out; first asked for when it hurries."""
        vertices = self._morph.vertices
        if vertices is None:
            return
        if hurried:
            self.surface.find_shell()
        if self.surface.insides is not None and self._followed is not self.surface.insides:
            self.surface.insides.follow(vertices[:, :3], vertices[:, 3:])
            self._followed = self.surface.insides

    def release(self) -> None:
        """Give everything back to the context."""
        self._morph.release()
        self.surface.release()
