"""Light inside the mouth in GLSL is what numpy says, and faces without lips' points are drawn as before."""

from __future__ import annotations

import shutil
from pathlib import Path

import moderngl
import numpy as np
import pytest

from facemorph.core.mouth_light import APERTURE, Aperture, mouth_light
from facemorph.core.rig import FaceInfo, Landmark, Rig
from facemorph.gl.mouth_driver import MouthOpening
from facemorph.gl.programs import Programs
from facemorph.resources import data_folder

PROBE = """#version 330 core
#include "lib/mouth_light.glsl"
uniform vec3 towards_key;
in vec3 place;
in vec3 facing;
out vec2 share;
void main() {
    share = mouth_light(place, facing, towards_key);
}
"""


def lips(seed: int, opening: float) -> np.ndarray:
    """Eight places along lips that no two mouths share."""
    rng = np.random.default_rng(seed)
    turn = np.pi - 2.0 * np.pi * np.arange(APERTURE) / APERTURE
    edge = np.stack([2.5 * np.cos(turn), opening * np.sin(turn), 3.0 + 1.2 * np.abs(np.sin(turn))], -1)
    return edge + rng.normal(0.0, 0.06, edge.shape)


@pytest.mark.parametrize("opening", [0.0, 0.4, 1.8])
def test_both_sides_agree(ctx: moderngl.Context, folder: Path, opening: float) -> None:
    rng = np.random.default_rng(7)
    places = rng.uniform((-2.5, -3.0, -4.0), (2.5, 2.0, 5.0), (500, 3))
    facing = rng.standard_normal((500, 3))
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    key = np.array([-0.5, 0.6, 0.62]) / np.linalg.norm([-0.5, 0.6, 0.62])
    aperture = Aperture.between(lips(3, opening), np.array([0.0, 0.0, 1.0]))

    shutil.copytree(data_folder("shaders") / "lib", folder / "lib")
    (folder / "probe.vert").write_text(PROBE, encoding="utf-8")
    program = Programs(ctx, folder).get("probe.vert", capture=("share",))
    program["aperture"].write(aperture.edge.astype("f4").tobytes())
    program["aperture_centre"].value = tuple(aperture.centre)
    program["aperture_normal"].value = tuple(aperture.normal)
    program["aperture_size"].value = aperture.size
    program["towards_key"].value = tuple(key)
    source = ctx.buffer(np.concatenate([places, facing], 1).astype("f4").tobytes())
    result = ctx.buffer(reserve=500 * 8)
    screen = ctx.simple_framebuffer((4, 4))
    screen.use()
    ctx.vertex_array(program, [(source, "3f 3f", "place", "facing")]).transform(result, moderngl.POINTS)
    shares = np.frombuffer(result.read(), "f4").reshape(500, 2)
    assert shares == pytest.approx(mouth_light(aperture, places, facing, key), abs=2e-3)
    for thing in (source, result, screen):
        thing.release()


def test_the_opening_follows_the_lips(head: Rig) -> None:
    marks = tuple(Landmark(f"lip {n}", 40 + 7 * n, None, 60 + n) for n in range(APERTURE))
    rig = Rig(head.neutral, head.shapes, head.deltas, FaceInfo("Marked", landmarks=marks))
    coefficients = np.array([0.5, 0.0, 1.0])
    expected = rig.neutral.positions[[m.vertex for m in marks]] + sum(
        c * d[[m.vertex for m in marks]] for c, d in zip(coefficients, rig.deltas, strict=True)
    )
    told = MouthOpening(rig).uniforms(coefficients, None)
    assert told["aperture_centre"] == pytest.approx(
        Aperture.between(expected, np.array([0.0, 0.0, 1.0])).centre
    )
    assert told["aperture_size"] > 0.0


def test_a_face_without_those_points_says_so(head: Rig) -> None:
    assert MouthOpening(head).uniforms(np.zeros(3), None) == {"aperture_size": 0.0}
