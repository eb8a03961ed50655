"""Templates wrapped on scans of 12,000 vertices by 68 landmarks: time, distance, folds.

Scans are skins of the built-in people meshed anew. Templates are the people as they are (8,000 vertices laid
on the scan, as many riding along), and their skins meshed anew: 10,000 vertices in triangles at random,
which fold more easily than a modeller's.
"""

from __future__ import annotations

import numpy as np
from tests.fit.scans import meshed_anew, skin_of

import facemorph
from benchmarks.harness import Table
from facemorph.core.mesh import Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.rig import Rig
from facemorph.core.triangles import triangulated
from facemorph.fit.registration import LandmarkPair, register

PAIRS = (("ada", "omar"), ("zola", "ben"), ("mei", "kofi"))
TEMPLATE, SCAN = 10_000, 12_000


def run() -> list[Table]:
    """One table, two rows for each pair of people."""
    columns = ("template on scan", "vertices", "s", "mean %", "95 %, %", "largest %", "flipped %", "crossed")
    table = Table(f"Registration on {SCAN:,} vertices, 68 landmarks, % of the diagonal", columns)
    for template, scan in PAIRS:
        for anew in (False, True):
            surface, pairs, goal = case(template, scan, anew=anew)
            found = register(surface, goal, pairs)
            quality = found.quality
            table.add(
                f"{template} on {scan}" + (", meshed anew" if anew else ""),
                f"{surface.vertex_count:,}",
                f"{sum(found.seconds.values()):.2f}",
                f"{quality.mean_percent:.4f}",
                f"{quality.p95_percent:.4f}",
                f"{quality.largest_percent:.3f}",
                f"{quality.flipped_percent:.3f}",
                str(len(quality.crossed)),
            )
    return [table]


def case(template: str, scan: str, *, anew: bool) -> tuple[Mesh, list[LandmarkPair], Mesh]:
    """A template's mesh, pairs with a scan, and the scan."""
    first, second = facemorph.load(template), facemorph.load(scan)
    goal = _anew(second, SCAN, 2)
    surface = _anew(first, TEMPLATE, 1) if anew else first.neutral
    places = {mark.ibug: mark.vertex for mark in second.info.landmarks if mark.ibug is not None}
    rest = first.neutral.positions
    normals = vertex_normals(rest, first.triangles)
    own = vertex_normals(surface.positions, triangulated(surface).vertices)
    pairs = []
    for mark in first.info.landmarks:
        if mark.ibug is not None:
            # The nearest vertex of the same side: a landmark of one lip must not fall on the other.
            turned = np.linalg.norm(own - normals[mark.vertex], axis=1)
            away = np.linalg.norm(surface.positions - rest[mark.vertex], axis=1) + 0.5 * turned
            x, y, z = second.neutral.positions[places[mark.ibug]].astype(float).tolist()
            pairs.append(LandmarkPair(int(np.argmin(away)), (x, y, z), mark.name))
    return surface, pairs, goal


def _anew(rig: Rig, count: int, seed: int) -> Mesh:
    vertices, triangles = skin_of(rig)
    return meshed_anew(rig.neutral.positions[vertices].astype(np.float64), triangles, count, seed)
