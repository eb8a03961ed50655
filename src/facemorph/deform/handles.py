"""Handles: control points on the face that are dragged, and anchors that hold what should stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.rig import Rig
from facemorph.deform.rbf import Kernel, RbfField
from facemorph.errors import DeformError

Vector = tuple[float, float, float]
STILL: Vector = (0.0, 0.0, 0.0)
# Corners of a box round the face, this much larger than it, keep far parts in place.
_CAGE = 1.15


@dataclass(frozen=True)
class Handle:
    """A control point at a vertex, moved by so much (model units); an anchor stays where it is."""

    vertex: int
    moved: Vector = STILL
    anchor: bool = False


@dataclass(frozen=True)
class HandleSet:
    """All handles of a face, with the kernel that spreads their motion.

    caged   hold the corners of a box around the face too, so that fewer than four handles can be solved
            and what is far from all of them stays
    """

    handles: tuple[Handle, ...] = ()
    kernel: Kernel = "r"
    c: float | None = None
    caged: bool = True

    def vertices(self) -> tuple[int, ...]:
        """Where the handles are."""
        return tuple(handle.vertex for handle in self.handles)

    def with_handle(self, handle: Handle) -> HandleSet:
        """One more handle, or the one at that vertex changed."""
        others = tuple(h for h in self.handles if h.vertex != handle.vertex)
        return replace(self, handles=(*others, handle))

    def without(self, vertex: int) -> HandleSet:
        """Without the handle at a vertex."""
        return replace(self, handles=tuple(h for h in self.handles if h.vertex != vertex))

    def moved(self, vertex: int, by: Vector) -> HandleSet:
        """The handle at a vertex dragged to another displacement; the order of handles stays."""
        changed = tuple(replace(h, moved=by) if h.vertex == vertex else h for h in self.handles)
        return replace(self, handles=changed)

    def at_rest(self) -> HandleSet:
        """Every handle back where it rests."""
        return replace(self, handles=tuple(replace(h, moved=STILL) for h in self.handles))


class BoundHandles:
    """Handles of one rig. The matrix is formed again only when points, kernel or c change."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._key: tuple[object, ...] | None = None
        self._field: RbfField | None = None

    def __call__(self, handles: HandleSet) -> Float32 | None:
        """Offsets (V, 3), or None where no handle is moved. Raises `DeformError`."""
        if not any(any(handle.moved) for handle in handles.handles):
            return None
        field = self._bound(handles)
        moves = np.zeros((len(field.points), 3))
        for place, handle in enumerate(handles.handles):
            moves[place] = STILL if handle.anchor else handle.moved
        return field(moves)

    def _bound(self, handles: HandleSet) -> RbfField:
        key = (handles.vertices(), handles.kernel, handles.c, handles.caged)
        if self._field is None or key != self._key:
            points = self._points(handles)
            self._field = RbfField(points, self._rig.neutral.positions, handles.kernel, handles.c)
            self._key = key
        return self._field

    def _points(self, handles: HandleSet) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        vertices = np.array(handles.vertices(), np.int64)
        if len(vertices) and not 0 <= vertices.min() <= vertices.max() < self._rig.neutral.vertex_count:
            count = self._rig.neutral.vertex_count
            raise DeformError(f"a handle stands at vertex {vertices.max()}, but the face has {count:,}.")
        points = self._rig.neutral.positions[vertices].astype(np.float64)
        return np.concatenate([points, self._cage()]) if handles.caged else points

    def _cage(self) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        low, high = self._rig.neutral.bounds.astype(np.float64)
        middle, half = (low + high) / 2.0, np.maximum((high - low) / 2.0, 1e-6) * _CAGE
        corners = np.stack(np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij"), -1).reshape(-1, 3)
        cage: np.ndarray[tuple[int, int], np.dtype[np.float64]] = middle + corners * half
        return cage


def mirrored(rig: Rig, vertex: int, middle: float) -> int:
    """The vertex nearest to the mirror image of `vertex` across the plane x = `middle`."""
    image = rig.neutral.positions[vertex].astype(np.float64)
    image[0] = 2.0 * middle - image[0]
    distances = ((rig.neutral.positions - image) ** 2).sum(axis=1)
    return int(np.argmin(distances))


def mirrored_vector(vector: Sequence[float]) -> Vector:
    """A displacement seen in the mirror."""
    return (-vector[0], vector[1], vector[2])
