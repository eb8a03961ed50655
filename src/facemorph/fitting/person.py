"""A person from files, and what is made of it: a rig, a report, a template wrapped on a scan."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, part_of, silent
from facemorph.core.rig import Rig
from facemorph.errors import FitError
from facemorph.fitting.surfaces import ExampleFile, Wrapping, check_examples, read_surfaces

if TYPE_CHECKING:
    from facemorph.fit import FitResult
    from facemorph.fit.registration import Quality, Registered
    from facemorph.fit.report import FitReport

# The part of reading files in reading and wrapping them.
_READING = 0.3


@dataclass(frozen=True, eq=False)
class Person:
    """A person as `facemorph.fit` wants it: surfaces of the template's topology, by their files' names.

    weights  of each example, None where they are to be estimated
    shapes   names of those that may explain the examples; None is all
    wrapped  how well the template lies on every surface that was of another topology
    seconds  "read", and "register" where surfaces were wrapped
    """

    neutral: Mesh
    examples: Mapping[str, Mesh]
    held_out: Mapping[str, Mesh]
    weights: Sequence[Mapping[str, float]] | None
    shapes: Sequence[str] | None
    wrapped: Mapping[str, Quality] = field(default_factory=dict)
    seconds: Mapping[str, float] = field(default_factory=dict)


def read_person(
    template: Rig,
    neutral: Path,
    examples: Sequence[ExampleFile] = (),
    held_out: Sequence[ExampleFile] = (),
    *,
    landmarks: Path | None = None,
    shapes: Sequence[str] | None = None,
    progress: Progress = silent,
) -> Person:
    """Read a person's meshes, and wrap the template on those of another topology.

    held_out   expressions that no fit sees, for `report_on`
    landmarks  pairs of the template and the neutral, where that has a topology of its own; where None, the
               only ones that an example names
    shapes     shapes, or whole sets of them, that may explain the examples; None is all

    Everything that can be told before the long work is. Expressions of the neutral scan's own topology
    follow it; others are wrapped by landmarks of their own, around the person's neutral.
    Raises `MeshFileError`, `ControlsFileError`, `CorrespondenceError`, `FitError`, `UnknownNameError`; what
    `progress` raises passes through.
    """
    from facemorph.fit.checks import check_triangles

    used = None if shapes is None else _named_shapes(template, shapes)
    weights = _weights(template, examples, used)
    check_triangles(template.neutral.positions.astype(np.float64), template.triangles, "the template")
    begun = time.perf_counter()
    base, *others = read_surfaces(
        template, neutral, landmarks, [*examples, *held_out], part_of(progress, 0, _READING)
    )
    check_examples(template, base, others[: len(examples)])
    reading = time.perf_counter() - begun
    wrapping = Wrapping(template, base, used, part_of(progress, _READING, 1.0))
    surfaces = wrapping.all(others)
    names = _free_names([example.path.stem for example in (*examples, *held_out)], base.path.stem)
    seconds = {"read": reading} | ({"register": wrapping.seconds} if wrapping.qualities else {})
    qualities = {
        name: wrapping.qualities[number]
        for number, name in enumerate((base.path.stem, *names))
        if number in wrapping.qualities
    }
    found = list(zip(names, surfaces, strict=True))
    progress(1.0, "read")
    return Person(
        wrapping.neutral, dict(found[: len(examples)]), dict(found[len(examples) :]),
        weights, used, qualities, seconds,
    )  # fmt: skip


def fit_person(
    template: Rig, person: Person, *, iterations: int = 10, progress: Progress = silent
) -> FitResult:
    """`facemorph.fit.example_based` of what was read; without examples, plain transfer."""
    from facemorph.fit import example_based

    return example_based(
        template,
        person.neutral,
        person.examples,
        person.weights,
        iterations=iterations,
        shapes=person.shapes,
        progress=progress,
    )


def report_on(
    template: Rig, person: Person, *, iterations: int = 10, progress: Progress = silent
) -> FitReport:
    """`facemorph.fit.report.fit_report` of what was read."""
    from facemorph.fit.report import fit_report

    return fit_report(
        template,
        person.neutral,
        person.examples,
        person.weights,
        person.held_out,
        iterations=iterations,
        shapes=person.shapes,
        progress=progress,
    )


def register_file(template: Rig, scan: Path, landmarks: Path, *, progress: Progress = silent) -> Registered:
    """The template's topology wrapped on the surface in `scan`. Raises as `read_person` does."""
    from facemorph.fit.registration import register
    from facemorph.io import read_mesh
    from facemorph.io.pairs_file import read_pairs

    progress(0.0, f"reading {scan.name}")
    mesh = read_mesh(scan)
    pairs = read_pairs(landmarks, template, mesh)
    return register(template.neutral, mesh, pairs, progress=part_of(progress, 0.1, 1.0))


def _weights(
    template: Rig, examples: Sequence[ExampleFile], shapes: Sequence[str] | None
) -> list[Mapping[str, float]] | None:
    """Those given, checked. Raises `FitError`, `UnknownNameError`."""
    from facemorph.fit.checks import MOST_EXAMPLES, used_shapes, weight_rows

    if len(examples) > MOST_EXAMPLES:
        raise FitError(f"at most {MOST_EXAMPLES} examples are taken, not {len(examples)}; four are plenty.")
    lacking = [example for example in examples if example.weights is None]
    if lacking and len(lacking) < len(examples):
        raise FitError(f"give starting weights for every example, or for none; {lacking[0].path} has none.")
    given = [example.weights for example in examples if example.weights is not None]
    if given:
        weight_rows(used_shapes(template, shapes), given, [str(example.path) for example in examples])
    return given or None


def _named_shapes(template: Rig, words: Sequence[str]) -> list[str]:
    """The shapes that names, or the names of whole sets, mean."""
    sets = {shape.set for shape in template.controls}
    names: list[str] = []
    for word in words:
        if word in sets and word not in template.names:
            names += [shape.name for shape in template.controls if shape.set == word]
        else:
            names.append(template.shape(word).name)
    return names


def _free_names(stems: Sequence[str], neutral: str) -> list[str]:
    """The names of files as names of surfaces, none twice and none the neutral's."""
    names = [neutral]
    for stem in stems:
        number, free = 2, stem
        while free in names:
            free, number = f"{stem} {number}", number + 1
        names.append(free)
    return names[1:]
