"""The shader path: the sum and the exact normals made on the graphics card, in GL 3.3.

Deltas lie in a texture array, a layer a shape. For each vertex a vertex shader adds up the ACTIVE shapes
only; it knows their source, target and added weights, so that dragging the slider changes one uniform.
The sums go as points into a float texture; from there a second pass makes each drawn vertex's normal
from the triangles around it and feeds both back into the buffer that is drawn.

Memory is bounded: the array has at most as many layers as fit in `MEMORY` bytes and as OpenGL has, and
at least one; layers are filled when a shape first becomes active, and the least recently used one makes
room. More active shapes than layers are added in several passes, each starting from the one before, so
that there is no limit to how many may be active. Correctives are worked out in the shader too.

Of a refined surface the neutral, the offsets and each layer are refined as they are filled; as refining is
linear, a frame then costs what one of a mesh of that many vertices does.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.gl.grids import grid_size, list_texture, padded
from facemorph.gl.programs import Programs
from facemorph.gl.rule_rows import row_width, rule_rows
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl

MEMORY = 256 * 1024 * 1024
_CURVES = {"linear": 0, "cosine": 1}
_BASE, _DELTAS, _ACTIVE, _RULES, _POSITIONS, _RINGS, _RING_CORNERS = range(7)


@dataclass(frozen=True, eq=False)
class _Item:
    """What a pass adds: a shape by its source, target and added weight (3,), or by a rule's row."""

    shape: int
    row: Float32
    rule: bool = False


class ShaderMorph:
    """Fills a surface's morphed buffer from a pose. `passes` counts morphing passes drawn.

    vertices  None: only the card knows positions and normals
    """

    vertices: Float32 | None = None

    def __init__(
        self,
        ctx: moderngl.Context,
        programs: Programs,
        rig: Rig,
        surface: Surface,
        *,
        max_layers: int | None = None,
    ) -> None:
        self._ctx = ctx
        self._rig = rig
        self._offsets: Float32 | None = None
        self._largest = int(ctx.info["GL_MAX_TEXTURE_SIZE"])
        self._mesh, self._refined = surface.mesh, surface.form.refined
        self._count = self._mesh.vertex_count
        self._size = grid_size(self._count, self._largest)
        self._layers = self._layer_count(max_layers)
        self._layer_of: OrderedDict[int, int] = OrderedDict()
        self._listed: tuple[bytes, ...] = ()
        self._items: list[_Item] = []
        self.passes = 0
        self._make_textures(surface)
        self._make_arrays(programs, surface)

    def _layer_count(self, asked: int | None) -> int:
        a_layer = self._size[0] * self._size[1] * 16
        possible = min(int(self._ctx.info["GL_MAX_ARRAY_TEXTURE_LAYERS"]), MEMORY // a_layer)
        return max(min(possible, len(self._rig.shapes), asked or possible), 1)

    def _make_textures(self, surface: Surface) -> None:
        ctx, size = self._ctx, self._size
        nearest = (ctx.NEAREST, ctx.NEAREST)
        self._base = np.ones((self._count, 4), np.float32)
        self._base[:, :3] = self._mesh.positions
        self._neutral = list_texture(ctx, self._base, "f4", self._largest)
        self._results = [ctx.texture(size, 4, dtype="f4") for _ in range(2)]
        self._targets = [ctx.framebuffer([texture]) for texture in self._results]
        self._deltas = ctx.texture_array((*size, self._layers), 3, dtype="f4")
        self._active = ctx.texture((self._layers, 1), 4, dtype="f4")
        self._deltas.filter = nearest
        self._rule_width = row_width(self._rig)
        self._rules = ctx.texture((self._rule_width, self._layers), 4, dtype="f4")
        for texture in (*self._results, self._active, self._rules):
            texture.filter = nearest
        rings, corners = surface.form.rings
        self._rings = list_texture(ctx, rings, "i4", self._largest)
        self._ring_corners = list_texture(ctx, corners, "i4", self._largest)

    def _make_arrays(self, programs: Programs, surface: Surface) -> None:
        self._sum = programs.get("morph_positions.vert", "morph_positions.frag")
        self._fill = programs.get("morph_drawn.vert", capture=("position", "normal"))
        self._points = self._ctx.vertex_array(self._sum, [])
        self._copies: moderngl.VertexArray | None = None
        self._position_of: moderngl.Buffer | None = None
        self.bind(surface)

    def _take_programs(self) -> None:
        """Set what a morph of another size, with which the programs are shared, has set for itself."""
        _set(
            self._sum,
            base_positions=_BASE,
            deltas=_DELTAS,
            active_shapes=_ACTIVE,
            rules=_RULES,
            grid_size=self._size,
        )
        span = self._rig.neutral.diagonal or 1.0
        _set(
            self._fill, positions=_POSITIONS, rings=_RINGS, ring_corners=_RING_CORNERS, per_length=1.0 / span
        )

    def bind(self, surface: Surface) -> None:
        """Fill `surface` from now on, whose vertices are the same mesh's, split otherwise."""
        self._unbind()
        self._surface = surface
        drawn = np.ascontiguousarray(surface.position_of, np.int32)
        self._position_of = self._ctx.buffer(drawn.tobytes() or b"\0" * 4)
        self._copies = self._ctx.vertex_array(self._fill, [(self._position_of, "1i", "position_of")])

    def _unbind(self) -> None:
        for held in (self._copies, self._position_of):
            if held is not None:
                held.release()

    def update(self, pose: Pose, offsets: Float32 | None = None, *, exactly: bool) -> None:
        """Morph to `pose` plus `offsets` (V, 3).

        The sum is always made in full here, so `exactly` changes nothing.
        """
        self._take_programs()
        self._start_from(offsets)
        self._list_shapes(pose)
        _set(self._sum, t=float(pose.t), curve=_CURVES[pose.curve])
        self._ctx.enable_only(self._ctx.NOTHING)
        base = self._neutral
        for step in range(max(-(-len(self._items) // self._layers), 1)):
            base = self._add_pass(base, step)
        self._fill_drawn(base)

    def _start_from(self, offsets: Float32 | None) -> None:
        """The texture where the sum starts: neutral, plus the offsets where there are any."""
        if offsets is self._offsets:
            return
        neutral = self._mesh.positions
        self._base[:, :3] = neutral if offsets is None else neutral + self._refined(offsets)
        self._neutral.write(padded(self._base, self._size))
        self._offsets = offsets

    def _list_shapes(self, pose: Pose) -> None:
        """Which shapes are active and with which weights, and which correctives may be on."""
        names = self._rig.names
        states = [Pose.of(state).coefficients(names) for state in (pose.source, pose.target, pose.weights)]
        listed = tuple(state.tobytes() for state in states)
        if listed == self._listed:
            return
        self._listed = listed
        weights: Float64 = np.stack(states, axis=1)
        active = np.flatnonzero(weights.any(axis=1))
        self._items = [_Item(int(k), weights[k].astype(np.float32)) for k in active]
        self._items += [_Item(k, row, rule=True) for k, row in rule_rows(self._rig, weights)]
        self._table_step = -1

    def _add_pass(self, base: moderngl.Texture, step: int) -> moderngl.Texture:
        """Add one table's worth of shapes to `base`; returns the texture of the sums."""
        items = self._items[step * self._layers : (step + 1) * self._layers]
        if self._table_step != step:
            self._write_table(items)
            self._table_step = step
        ruled = sum(item.rule for item in items)
        _set(self._sum, active_count=len(items) - ruled, rule_count=ruled)
        base.use(_BASE)
        self._deltas.use(_DELTAS)
        self._active.use(_ACTIVE)
        self._rules.use(_RULES)
        self._targets[step % 2].use()
        if self._count:
            self._points.render(self._ctx.POINTS, vertices=self._count)
        self.passes += 1
        return self._results[step % 2]

    def _write_table(self, items: list[_Item]) -> None:
        """Shapes first, then rules: texels (source, target, added, layer), and a row for each rule."""
        shapes = np.zeros((self._layers, 4), np.float32)
        rules = np.zeros((self._layers, self._rule_width, 4), np.float32)
        wanted = [item.shape for item in items]
        count = sum(not item.rule for item in items)
        for i, item in enumerate(items):
            layer = self._layer(item.shape, wanted)
            if item.rule:
                rules[i - count] = item.row
                rules[i - count, 0, 1] = layer
            else:
                shapes[i] = *item.row, layer
        self._active.write(shapes.tobytes())
        if count < len(items):
            self._rules.write(rules.tobytes())

    def _layer(self, k: int, wanted: list[int]) -> int:
        """The layer that holds shape k, filled now if it was in none."""
        if k not in self._layer_of:
            layer = len(self._layer_of)
            if layer >= self._layers:
                oldest = next(shape for shape in self._layer_of if shape not in wanted)
                layer = self._layer_of.pop(oldest)
            data = padded(self._refined(self._rig.deltas[k]), self._size)
            self._deltas.write(data, viewport=(0, 0, layer, *self._size, 1))
            self._layer_of[k] = layer
        self._layer_of.move_to_end(k)
        return self._layer_of[k]

    def _fill_drawn(self, positions: moderngl.Texture) -> None:
        positions.use(_POSITIONS)
        self._rings.use(_RINGS)
        self._ring_corners.use(_RING_CORNERS)
        # Nothing is drawn, but without a framebuffer bound the feedback is wrong on some drivers; and
        # it must not be the one whose texture is read.
        other = self._targets[0] if positions is not self._results[0] else self._targets[1]
        other.use()
        if self._surface.drawn_count:
            assert self._copies is not None
            self._copies.transform(
                self._surface.morphed, self._ctx.POINTS, vertices=self._surface.drawn_count
            )

    def release(self) -> None:
        """Give back what the context holds."""
        self._unbind()
        self._points.release()
        for target in self._targets:
            target.release()
        for texture in (
            *self._results,
            self._neutral,
            self._active,
            self._rules,
            self._rings,
            self._ring_corners,
        ):
            texture.release()
        self._deltas.release()


def _set(program: moderngl.Program, **values: object) -> None:
    for name, value in values.items():
        program[name].value = value  # type: ignore[union-attr]
