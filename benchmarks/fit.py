"""A person's blendshapes: time and memory of transfer, fit and registration; errors beside simple ways."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from statistics import median

import numpy as np
from scipy.sparse import diags_array
from scipy.sparse.linalg import spsolve
from tests.fit.people import task
from tests.fit.scans import meshed_anew, skin_of

import facemorph
from benchmarks.harness import ROOT, Table, interleaved_ms, once_ms, process, python
from benchmarks.make_faces import head, shape
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit import example_based, transfer
from facemorph.fit.gradients import edge_matrix
from facemorph.fit.registration import register, shared_landmarks
from facemorph.fit.report import fit_report
from facemorph.fit.transferring import Transfer

# The paper's time for four examples and nine shapes, on its computer of 2015.
PAPER_SECS = 81.0
PAIRS = (("ada", "omar"), ("mei", "kofi"), ("zola", "ben"))
NINE = ("happy", "angry", "surprised", "disgusted", "AU4", "AU18", "AU20", "AU26", "AU43")


def run() -> list[Table]:
    """Four tables."""
    return [_speed(), _transfer(), _errors(), _registration()]


@dataclass(frozen=True)
class Work:
    """A template, another person's neutral (V, 3), four examples, and their weights."""

    template: Rig
    neutral: np.ndarray
    examples: list[np.ndarray]
    weights: list[dict[str, float]]


def work(vertices: int, shapes: int) -> Work:
    """A head of about so many vertices whose shapes are smooth bumps, and a warp of it as the person."""
    made = head(vertices)
    quads = made.quads
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]], made.caps]).astype(np.int32)
    mesh = Mesh.from_triangles(made.positions.astype(np.float32), triangles)
    names = [f"shape {k}" for k in range(shapes)]
    moved = {name: shape(made.positions, k).astype(np.float32) for k, name in enumerate(names)}
    rig = Rig.from_arrays(mesh, moved)
    neutral = _warped(made.positions)
    offsets = [1.2 * (_warped(made.positions + delta) - neutral) for delta in rig.deltas.astype(np.float64)]
    draw = np.random.default_rng(0)
    examples, weights = [], []
    for _ in range(4):
        mixed = draw.choice(shapes, max(3, shapes // 6), replace=False)
        row = {names[k]: float(draw.uniform(0.3, 1.0)) for k in mixed}
        examples.append(neutral + sum(row[names[k]] * offsets[k] for k in mixed))
        weights.append(row)
    return Work(rig, neutral, examples, weights)


def _warped(points: np.ndarray) -> np.ndarray:
    return points * (1.1, 1.0, 0.95) + 0.3 * np.sin(points[:, [1, 2, 0]] / 4.0)


_ALONE = """
from benchmarks.fit import work
from facemorph.fit import example_based
job = work({vertices}, {shapes})
example_based(job.template, job.neutral, job.examples, job.weights)
"""


def _peak_mb(vertices: int, shapes: int) -> float:
    """Of a process that does one fit and nothing else, its rig and imports included."""
    code = python(_ALONE.format(vertices=vertices, shapes=shapes))
    alone = process(code, {"PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "src")])})
    if alone.status:
        raise SystemExit(f"a fit failed:\n{alone.output}")
    return alone.peak_mb


def _speed() -> Table:
    columns = ("vertices", "shapes", "weights", "median s", "peak MB", "the paper's 81 s / this")
    table = Table("A fit to 4 examples, 10 iterations, transfer included", columns)
    for vertices, shapes in ((27_000, 9), (27_000, 52)):
        job = work(vertices, shapes)
        fit = partial(example_based, job.template, job.neutral, job.examples)
        works = {"given": partial(fit, job.weights), "estimated": fit}
        ms = interleaved_ms(works, times=3, warm=1)
        peak = _peak_mb(vertices, shapes)
        count = f"{job.template.neutral.vertex_count:,}"
        for weights, value in ms.items():
            ratio = f"{PAPER_SECS * 1e3 / value:.0f}x" if shapes == 9 else "–"
            table.add(count, str(shapes), weights, f"{value / 1e3:.2f}", f"{peak:.0f}", ratio)
    return table


def _transfer() -> Table:
    job = work(14_000, 52)
    count = job.template.neutral.vertex_count
    table = Table(f"Transfer of 52 shapes, {count:,} vertices", ("how", "median s", "time / facemorph's"))
    rows: dict[str, Callable[[], object]] = {
        "facemorph: factored once, all shapes at once": lambda: transfer(job.template, job.neutral),
        "scipy's spsolve for every shape, the edges given": _solved_anew(job),
    }
    (ours, value), (theirs, slow) = rows.items()
    quick = median(once_ms(value) for _ in range(5))
    anew = once_ms(slow)
    table.add(ours, f"{quick / 1e3:.2f}", "1.0x")
    table.add(theirs, f"{anew / 1e3:.2f}", f"{anew / quick:.1f}x")
    return table


def _solved_anew(job: Work) -> Callable[[], object]:
    """The same systems as transfer solves, one by one."""
    way = Transfer(job.template, job.neutral)
    edges = edge_matrix(job.template.triangles, job.template.neutral.vertex_count)
    system = (edges.T @ edges + diags_array(way.anchoring.still.astype(float))).tocsc()
    asked = way.motion.edges.astype(np.float64)
    sides = [np.stack([edges.T @ row.ravel() for row in one], axis=1) for one in asked]
    return lambda: [spsolve(system, side) for side in sides]


def _errors() -> Table:
    columns = ("method", "the examples, %", "/ transfer", "not seen, %", "/ transfer", "s")
    table = Table(
        "Errors on our own people, 9 shapes, 4 examples, weights off by 0.1 (medians of 3 pairs)", columns
    )
    reports = []
    for seed, (template, target) in enumerate(PAIRS, start=1):
        job = task(template, target, NINE, seed)
        unseen = np.tensordot(job.held_out, job.truth.deltas.astype(np.float64), 1)
        faces = {f"unseen {k}": job.neutral + one for k, one in enumerate(unseen)}
        reports.append(
            fit_report(job.template, job.neutral, job.examples, job.noisy, faces, alphas=(), noises=()).rows
        )
    for same in zip(*reports, strict=True):
        plain = [rows[1] for rows in reports]
        training = [row.training for row in same]
        unseen_errors = [row.held_out or 0.0 for row in same]
        against = [a / row.training for a, row in zip(training, plain, strict=True)]
        beside = [a / (row.held_out or 1.0) for a, row in zip(unseen_errors, plain, strict=True)]
        table.add(
            same[0].method,
            f"{median(training):.4f}",
            f"{median(against):.2f}",
            f"{median(unseen_errors):.4f}",
            f"{median(beside):.2f}",
            f"{median(row.seconds for row in same):.2f}",
        )
    return table


def _registration() -> Table:
    columns = ("template", "scan", "median s", "mean distance, %", "95 %, %", "turned over, %")
    table = Table("A template wrapped on another person's skin, meshed anew, 68 landmarks", columns)
    for template, target in PAIRS[:2]:
        rig, person = facemorph.load(template), facemorph.load(target)
        vertices, triangles = skin_of(person)
        scan = meshed_anew(person.neutral.positions[vertices].astype(float), triangles, 12_000)
        usual = {mark.name for mark in rig.info.landmarks if mark.ibug is not None}
        pairs = [pair for pair in shared_landmarks(rig, person) if pair.name in usual]
        runs = [register(rig.neutral, scan, pairs) for _ in range(3)]
        quality = runs[0].quality
        table.add(
            f"{template}, {rig.neutral.vertex_count:,} vertices",
            f"{target}, {scan.vertex_count:,} vertices",
            f"{median(sum(one.seconds.values()) for one in runs):.2f}",
            f"{quality.mean_percent:.4f}",
            f"{quality.p95_percent:.4f}",
            f"{quality.flipped_percent:.3f}",
        )
    return table
