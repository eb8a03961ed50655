"""Both morph paths put the reference's positions and normals into the buffer that is drawn."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
import pytest

from facemorph.core.blend import Blend
from facemorph.core.correctives import Corrective, Hat
from facemorph.core.normals import vertex_normals
from facemorph.core.pose import Pose
from facemorph.core.rig import FaceInfo, Rig, Shape
from facemorph.gl.morph import Morph
from facemorph.gl.morph_cpu import CpuMorph
from facemorph.gl.morph_shader import ShaderMorph
from facemorph.gl.programs import Programs
from facemorph.gl.rings import vertex_rings
from facemorph.gl.surface import Surface
from tests.gl.heads import many_shapes

ROOT = Path(__file__).resolve().parents[2]
COUNT = 24

POSES = {
    "neutral": Pose(),
    "one": Pose.of({"s3": 1.0}),
    "all, of both signs": Pose.of({f"s{k}": (-1.0) ** k * 0.4 for k in range(COUNT)}),
    "linear": Pose.between("s1", "s2", 0.3),
    "cosine": Pose.between("s1", "s2", 0.3, "cosine"),
    "cosine beyond the end": Pose.between("s1", "s2", 1.25, "cosine"),
    "mixtures, weights below 0 and above 1, and some added": Pose(
        {"s1": 1.0, "s4": -0.5}, {"s4": 1.7, "s9": 0.6}, 0.65, "cosine", {"s1": -0.4, "s20": 2.5}
    ),
}


class Bench:
    """A rig, its surface, and each morph path over it."""

    def __init__(self, ctx: moderngl.Context, rig: Rig) -> None:
        self._ctx = ctx
        self.rig = rig
        self.surface = Surface(ctx, rig.neutral)
        self._programs = Programs(ctx)
        self.paths: dict[str, Morph] = {
            "cpu": CpuMorph(ctx, rig, self.surface, Blend(rig.neutral.positions, rig.deltas)),
            "shader": ShaderMorph(ctx, self._programs, rig, self.surface),
            "shader, 5 layers": ShaderMorph(ctx, self._programs, rig, self.surface, max_layers=5),
        }

    def drawn(self, path: str, pose: Pose) -> tuple[np.ndarray, np.ndarray]:
        """Positions and normals (G, 3) that the passes would draw."""
        self.paths[path].update(pose, exactly=False)
        values = np.frombuffer(self.surface.morphed.read(), np.float32).reshape(-1, 6)
        return values[:, :3], values[:, 3:]

    def release(self) -> None:
        self._ctx.detect_framebuffer(0).use()
        for path in self.paths.values():
            path.release()
        self.surface.release()
        self._programs.release()


RULES = (
    Corrective("s21", ("s1", "s2")),
    Corrective("s22", hats=(Hat("s2"),)),
    Corrective("s23", ("s4",), (Hat("s9", -0.5, 0.4, 0.9),)),
)


@pytest.fixture(scope="module", params=[(), RULES], ids=["linear", "corrected"])
def bench(ctx: moderngl.Context, request: pytest.FixtureRequest) -> Iterator[Bench]:
    made = Bench(ctx, replace(many_shapes(COUNT), correctives=request.param))
    yield made
    made.release()


PATHS = ("cpu", "shader", "shader, 5 layers")


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("pose", POSES.values(), ids=POSES.keys())
def test_positions_are_the_references(bench: Bench, path: str, pose: Pose) -> None:
    positions, _ = bench.drawn(path, pose)
    wanted = bench.rig.positions(pose)[bench.surface.position_of]
    assert np.linalg.norm(positions - wanted, axis=1).max() < 1e-5 * bench.rig.neutral.diagonal


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("pose", POSES.values(), ids=POSES.keys())
def test_normals_are_those_of_the_morphed_surface(bench: Bench, path: str, pose: Pose) -> None:
    _, normals = bench.drawn(path, pose)
    wanted = bench.rig.normals(pose)[bench.surface.position_of]
    cosine = np.einsum("gi,gi->g", normals, wanted)
    within = cosine > np.cos(np.radians(2.0))
    assert within.mean() >= 0.99
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)


def test_blended_normals_would_not_do(bench: Bench) -> None:
    """The promise above is worth something: the neutral's normals break it."""
    pose = POSES["all, of both signs"]
    neutral, wanted = bench.rig.normals({}), bench.rig.normals(pose)
    within = np.einsum("vi,vi->v", neutral, wanted) > np.cos(np.radians(2.0))
    assert within.mean() < 0.9


@pytest.mark.parametrize("path", PATHS)
def test_copies_of_a_vertex_at_a_seam_have_one_normal(bench: Bench, path: str) -> None:
    _, normals = bench.drawn(path, POSES["all, of both signs"])
    of = bench.surface.position_of
    order = np.argsort(of, kind="stable")
    twins = np.flatnonzero(of[order][1:] == of[order][:-1])
    assert len(twins) > 20, "the test head has a texture seam"
    assert np.array_equal(normals[order[twins]], normals[order[twins + 1]])


def test_more_active_shapes_than_layers_take_several_passes(bench: Bench) -> None:
    morph = bench.paths["shader, 5 layers"]
    assert isinstance(morph, ShaderMorph)
    before = morph.passes
    morph.update(POSES["all, of both signs"], exactly=False)
    assert morph.passes - before == -(-(COUNT + len(bench.rig.correctives)) // 5)


def test_dragging_the_slider_uploads_no_weights(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    morph = bench.paths["shader"]
    assert isinstance(morph, ShaderMorph)
    morph.update(Pose.between("s1", "s2", 0.1), exactly=False)
    written: list[int] = []
    original = ShaderMorph._write_table
    monkeypatch.setattr(
        ShaderMorph, "_write_table", lambda self, rows: (written.append(1), original(self, rows))
    )
    for t in (0.2, 0.5, 0.9):
        morph.update(Pose.between("s1", "s2", t, "cosine"), exactly=False)
    assert not written
    morph.update(Pose.between("s1", "s3", 0.9), exactly=False)
    assert written


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("scale", [1e-7, 1e7])
def test_tiny_and_huge_models_have_normals_too(ctx: moderngl.Context, path: str, scale: float) -> None:
    small = many_shapes(2)
    mesh = small.neutral.with_positions(small.neutral.positions * np.float32(scale))
    bench = Bench(ctx, Rig(mesh, small.shapes, small.deltas * np.float32(scale), FaceInfo("scaled")))
    _, normals = bench.drawn(path, Pose.of({"s0": 0.5}))
    wanted = vertex_normals(small.positions({"s0": 0.5}), small.triangles)[bench.surface.position_of]
    assert (np.einsum("gi,gi->g", normals, wanted) > np.cos(np.radians(2.0))).mean() >= 0.99
    bench.release()


@pytest.mark.parametrize("path", PATHS)
def test_a_rig_without_shapes_is_its_neutral(ctx: moderngl.Context, path: str) -> None:
    mesh = many_shapes(1).neutral
    bench = Bench(ctx, Rig(mesh, (), np.zeros((0, mesh.vertex_count, 3), np.float32)))
    positions, _ = bench.drawn(path, Pose())
    assert np.array_equal(positions, mesh.positions[bench.surface.position_of])
    bench.release()


def test_hundreds_of_shapes_are_no_limit(ctx: moderngl.Context) -> None:
    few = many_shapes(10)
    count = 400
    deltas = np.concatenate([few.deltas * np.float32(0.05)] * (count // 10))
    shapes = tuple(Shape(f"s{k}", f"s{k}") for k in range(count))
    rig = Rig(few.neutral, shapes, deltas)
    surface, programs = Surface(ctx, rig.neutral), Programs(ctx)
    morph = ShaderMorph(ctx, programs, rig, surface, max_layers=64)
    pose = Pose.of({f"s{k}": 0.5 for k in range(count)})
    morph.update(pose, exactly=False)
    positions = np.frombuffer(surface.morphed.read(), np.float32).reshape(-1, 6)[:, :3]
    wanted = rig.positions(pose)[surface.position_of]
    assert np.linalg.norm(positions - wanted, axis=1).max() < 1e-5 * rig.neutral.diagonal
    ctx.detect_framebuffer(0).use()
    for held in (morph, surface, programs):
        held.release()


def test_rings_hold_every_triangle_around_a_vertex_turning_its_way() -> None:
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    rings, corners = vertex_rings(triangles, 5)
    around = {v: {tuple(c) for c in corners[s : s + n].tolist()} for v, (s, n) in enumerate(rings.tolist())}
    assert around == {0: {(1, 2), (2, 3)}, 1: {(2, 0)}, 2: {(0, 1), (3, 0)}, 3: {(0, 2)}, 4: set()}


@pytest.mark.skipif("MESA_GL_VERSION_OVERRIDE" in os.environ, reason="this is the inner run")
def test_all_of_it_holds_under_plain_gl_3_3(ctx: moderngl.Context) -> None:
    if "mesa" not in str(ctx.info["GL_VERSION"]).lower():
        pytest.skip("only Mesa can be held to a version")
    files = ["tests/gl/test_morph_paths.py", "tests/gl/test_shadings.py", "tests/gl/test_scenes.py"]
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-n", "0", *files],
        cwd=ROOT,
        env={**os.environ, "MESA_GL_VERSION_OVERRIDE": "3.3"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-1000:]


@pytest.mark.skipif("MESA_GL_VERSION_OVERRIDE" not in os.environ, reason="only under a held version")
def test_the_version_is_held(ctx: moderngl.Context) -> None:
    assert ctx.version_code == 330
