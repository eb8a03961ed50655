"""Deformation transfer bound once: a template's shapes on another person's neutral.

In edge form: the template's gradients act on the target's edges, and one sparse system, the same for
every shape, finds the vertices (Sumner and Popovic 2004; see `gradients` and `solver`).
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import Rig
from facemorph.fit.align import Similarity, similarity
from facemorph.fit.checks import check_triangles
from facemorph.fit.gradients import Motion, carried_motion
from facemorph.fit.parts import Anchoring, anchoring
from facemorph.fit.riding import Riding
from facemorph.fit.solver import VertexSolver


class Transfer:
    """A template and a target neutral of its topology, in the template's place and size.

    neutral  (V, 3) float64, the target carried to the template by `way`, a similarity: gradients do
             not commute with turning the target alone
    """

    def __init__(self, template: Rig, neutral: Float64) -> None:
        """Raises `FitError` where triangles of either have no area."""
        self.template = template
        source = template.neutral.positions.astype(np.float64)
        check_triangles(source, template.triangles, "the template")
        check_triangles(neutral, template.triangles, "the neutral")
        # By the skin alone: a long haircut against a short one would turn and shrink the whole head.
        skin = self.anchoring.main
        self.way: Similarity = similarity(neutral[skin], source[skin])
        self.neutral = self.way.points(neutral)

    @cached_property
    def motion(self) -> Motion:
        """The template's motion on the target's edges, D* and q."""
        source = self.template.neutral.positions.astype(np.float64)
        return carried_motion(source, self.template.deltas, self.neutral, self.template.triangles)

    @cached_property
    def anchoring(self) -> Anchoring:
        """Which vertices the template never moves, and which parts hang on nothing."""
        return anchoring(self.template.triangles, self.template.deltas, self.template.neutral.diagonal)

    @cached_property
    def solver(self) -> VertexSolver:
        """The system that makes vertices of edges."""
        return VertexSolver(self.template.triangles, self.anchoring)

    @cached_property
    def planes(self) -> Float64:
        """The transferred shapes as offsets from `neutral`, (K, 3, V) float64: a plane a coordinate."""
        found = self.solver.solve(self.motion.edges, self.template.deltas.transpose(0, 2, 1))
        Riding(self.template, self.anchoring).carry(found, self.template.deltas)
        return found

    @property
    def offsets(self) -> Float64:
        """The same with vertices first, (V, 3, K)."""
        return self.planes.transpose(2, 1, 0)

    def deltas(self, offsets: Float64) -> Float32:
        """Offsets (V, 3, K) in the template's place as deltas (K, V, 3) in the target's."""
        back = self.way.inverse()
        made = np.empty((offsets.shape[2], *self.neutral.shape), np.float32)
        for delta, plane in zip(made, offsets.transpose(2, 0, 1), strict=True):
            delta[:] = back.offsets(plane)
        return made

    def prepared(self, progress: Progress = silent) -> Transfer:
        """Everything worked out, telling the progress. Returns itself."""
        progress(0.05, "working out how the template's triangles deform")
        _ = self.motion
        progress(0.6, "factoring the system of vertices")
        _ = self.solver
        progress(0.7, "placing the vertices")
        _ = self.planes
        return self
