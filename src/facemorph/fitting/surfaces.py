"""Surfaces from files: read and compared with the template, then those of another topology wrapped."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, part_of, silent
from facemorph.core.rig import Rig
from facemorph.errors import CorrespondenceError

if TYPE_CHECKING:
    from facemorph.core.landmark_pair import LandmarkPair
    from facemorph.fit.registration import Quality

_PAIRS_HELP = (
    "Name corresponding points with --landmarks, or wrap the template on it first, with `facemorph register`."
)
_ORDER_HELP = (
    "Put it into one folder with the template's neutral; `facemorph check FOLDER --repair OUT` puts it in "
    "that order."
)


@dataclass(frozen=True)
class ExampleFile:
    """An example expression: its mesh file, roughly which shapes make it up, and its own landmark pairs.

    weights    name -> 0..1; None estimates them
    landmarks  needed where the mesh is neither of the template's topology nor of the neutral's own
    """

    path: Path
    weights: Mapping[str, float] | None = None
    landmarks: Path | None = None


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh as its file has it, and pairs where its topology is neither the template's nor the neutral's.

    fits     it is of the template's topology
    follows  it is of the topology of the neutral's own scan
    """

    path: Path
    mesh: Mesh
    fits: bool
    follows: bool = False
    pairs: tuple[LandmarkPair, ...] = ()


def read_surfaces(
    template: Rig, neutral: Path, landmarks: Path | None, others: Sequence[ExampleFile], progress: Progress
) -> list[Surface]:
    """The neutral and the others, all read and compared before any is wrapped."""
    meshes = []
    for done, path in enumerate((neutral, *(other.path for other in others))):
        progress(done / (len(others) + 1), f"reading {path.name}")
        meshes.append(_mesh(path))
    own = [other.landmarks for other in others]
    if landmarks is None and sum(path is not None for path in own) == 1:
        landmarks = next(path for path in own if path is not None)
        if difference(template.neutral, meshes[0]) is not None:
            own = [None] * len(own)
    base = _surface(template, neutral, meshes[0], None, landmarks)
    scan = None if base.fits else base.mesh
    found = zip(others, meshes[1:], own, strict=True)
    return [base, *(_surface(template, other.path, mesh, scan, pairs) for other, mesh, pairs in found)]


def _mesh(path: Path) -> Mesh:
    from facemorph.io import read_mesh

    return read_mesh(path)


def _surface(template: Rig, path: Path, mesh: Mesh, scan: Mesh | None, landmarks: Path | None) -> Surface:
    """What is to be done with a mesh. Raises `CorrespondenceError` where nothing can be."""
    from facemorph.io.pairs_file import read_pairs

    unlike = difference(template.neutral, mesh)
    if unlike is None:
        return Surface(path, mesh, fits=True)
    if scan is not None and difference(scan, mesh) is None:
        return Surface(path, mesh, fits=False, follows=True)
    if landmarks is None:
        problem = unlike.problem.replace("the neutral", "the template")
        hint = _ORDER_HELP if unlike.cause == "order" else _PAIRS_HELP
        raise CorrespondenceError(f"{path}", problem, cause=unlike.cause, hint=hint)
    return Surface(path, mesh, fits=False, pairs=read_pairs(landmarks, template, mesh))


def check_examples(template: Rig, base: Surface, examples: Sequence[Surface]) -> None:
    """Raises `FitError` for a degenerate neutral and for examples that are the neutral over again."""
    from facemorph.fit.checks import check_example, check_triangles

    points = base.mesh.positions.astype(np.float64)
    if base.fits:
        check_triangles(points, template.triangles, f"{base.path}")
    for example in examples:
        if example.follows or (base.fits and example.fits):
            check_example(example.mesh.positions.astype(np.float64), points, f"{example.path}")


class Wrapping:
    """Brings surfaces to the template's topology.

    neutral    the neutral in it
    qualities  of what was wrapped: 0 is the neutral, 1 the first of the others
    """

    def __init__(
        self, template: Rig, base: Surface, shapes: Sequence[str] | None, progress: Progress
    ) -> None:
        self._template, self._base, self._shapes, self._progress = template, base, shapes, progress
        self.neutral = base.mesh
        self.qualities: dict[int, Quality] = {}
        self.seconds = 0.0

    def all(self, others: Sequence[Surface]) -> list[Mesh]:
        """The neutral, then the others in order."""
        begun = time.perf_counter()
        wanted = [n for n, surface in enumerate((self._base, *others)) if not surface.fits]
        parts = {
            n: part_of(self._progress, k / len(wanted), (k + 1) / len(wanted)) for k, n in enumerate(wanted)
        }
        if not self._base.fits:
            self.neutral = self._wrapped(0, self._base, self._template.neutral, parts[0])
        found = [
            self._brought(number, surface, parts.get(number, silent))
            for number, surface in enumerate(others, 1)
        ]
        self._place_unseen(found, [k for k, surface in enumerate(others) if not surface.fits])
        self.seconds = time.perf_counter() - begun
        return found

    def _brought(self, number: int, surface: Surface, progress: Progress) -> Mesh:
        if surface.fits:
            return surface.mesh
        if surface.follows:
            progress(0.0, f"following {surface.path.name}")
            return self._followed(surface.mesh)
        return self._wrapped(number, surface, self.neutral, progress)

    def _place_unseen(self, found: list[Mesh], chosen: Sequence[int]) -> None:
        """Put the parts that the scans of expressions have nothing of where their skin says that they are."""
        from facemorph.fit.unseen import with_likely_parts

        if not chosen:
            return
        self._progress(1.0, "placing what the scans do not show")
        placed = with_likely_parts(self._template, self.neutral, [found[k] for k in chosen], self._shapes)
        for k, positions in zip(chosen, placed, strict=True):
            found[k] = self.neutral.with_positions(positions)

    def _wrapped(self, number: int, surface: Surface, start: Mesh, progress: Progress) -> Mesh:
        from facemorph.fit.registration import register

        def told(part: float, doing: str) -> None:
            progress(part, f"{surface.path.name}: {doing}")

        found = register(start, surface.mesh, surface.pairs, progress=told)
        self.qualities[number] = found.quality
        return found.mesh

    def _followed(self, mesh: Mesh) -> Mesh:
        """The wrapped neutral after its scan moved to `mesh`."""
        from facemorph.fit.registration import followed

        return self.neutral.with_positions(followed(self.neutral, self._base.mesh, mesh))
