"""Pictures of the test head against kept ones, made by software OpenGL.

Tolerance: at most 1 pixel in 200 may differ by more than 24 of 255 in any channel (edges fall
differently between versions of Mesa), and all of them by at most 1.5 of 255 on average. A picture that
differs is written to golden/differences/ beside what was expected and the difference, eight times
enlarged in brightness.

To renew the kept pictures after a change that is meant, and after looking at them:

    FACEMORPH_RENEW_GOLDEN=1 pytest tests/gl/test_golden.py
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facemorph.core.glow import glow_of
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, Scene
from facemorph.gl import Offscreen, sheet
from tests.gl.heads import partner_rig

FOLDER = Path(__file__).parent / "golden"
SIZE = (200, 240)
POSE = {"smile": 1.0, "brows": 0.7, "jaw": 0.4}

PICTURES: dict[str, tuple[str, dict[str, float], Look]] = {
    "skin": ("front", POSE, Look()),
    "skin-neutral-left": ("left", {}, Look(background=(0.85, 0.86, 0.88, 1.0))),
    "clay": ("three-quarter", POSE, Look(shading="clay")),
    "wire": ("three-quarter", POSE, Look(shading="wire")),
    "normals": ("front", POSE, Look(shading="normals")),
    "heat": ("front", POSE, Look(shading="heat")),
    "skin-wire-transparent": ("-35,10", POSE, Look(wire=True, background=(0.0, 0.0, 0.0, 0.0))),
    "back-from-above": ("160,30", POSE, Look()),
}


@pytest.mark.parametrize("name", PICTURES)
def test_the_picture_is_the_kept_one(screen: Offscreen, head: Rig, name: str) -> None:
    if not screen.renderer.graphics.software:
        pytest.skip("the kept pictures are a software renderer's")
    camera, pose, look = PICTURES[name]
    compare(name, screen.render(head, pose, size=SIZE, camera=camera, look=look))


def scenes(head: Rig, partner: Rig) -> dict[str, tuple[str, Scene, Look]]:
    """What comes on top of a pose."""
    pose = Pose.of(POSE)
    below = np.exp(-(((head.neutral.positions[:, 1:2] + 4.5) / 2.5) ** 2))
    offsets = (below * head.neutral.positions * [0.16, 0.0, 0.06]).astype(np.float32)
    light = Look(background=(0.85, 0.86, 0.88, 1.0))
    return {
        "glow": ("front", Scene(pose, glow=glow_of(head, {"smile": 1.0})), Look()),
        "glow-clay": ("three-quarter", Scene(pose, glow=glow_of(head, {"brows": 1.0})), Look(shading="clay")),
        "partner-half": ("front", Scene(pose, offsets, partners=(Partner(partner, 0.5),)), light),
        "partner": ("front", Scene(pose, offsets, partners=(Partner(partner, 1.0),)), light),
        "difference": ("front", Scene(pose, offsets, reference=head.positions(pose)), Look(shading="heat")),
    }


@pytest.mark.parametrize("name", ["glow", "glow-clay", "partner-half", "partner", "difference"])
def test_the_scene_is_the_kept_one(screen: Offscreen, head: Rig, folder: Path, name: str) -> None:
    if not screen.renderer.graphics.software:
        pytest.skip("the kept pictures are a software renderer's")
    camera, scene, look = scenes(head, partner_rig(folder))[name]
    compare(name, screen.render(head, scene, size=SIZE, camera=camera, look=look))


def test_the_sheet_is_the_kept_one(screen: Offscreen, head: Rig) -> None:
    if not screen.renderer.graphics.software:
        pytest.skip("the kept pictures are a software renderer's")
    compare("sheet", sheet(screen, head, tile=(120, 140)))
    compare("sheet-heat", sheet(screen, head, tile=(160, 180), look=Look(shading="heat")))


def test_a_difference_is_noticed_and_written_down(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(f"{__name__}.FOLDER", folder)
    monkeypatch.delenv("FACEMORPH_RENEW_GOLDEN", raising=False)
    kept = np.full((40, 40, 4), 100, np.uint8)
    Image.fromarray(kept).save(folder / "one.png")
    compare("one", kept)
    moved = kept.copy()
    moved[:4, :10] += 60
    with pytest.raises(AssertionError, match="differences"):
        compare("one", moved)
    assert {path.name for path in (folder / "differences").iterdir()} == {
        "one-drawn.png",
        "one-kept.png",
        "one-difference.png",
    }


def compare(name: str, drawn: np.ndarray) -> None:
    """Hold `drawn` (H, W, 4) against the kept picture, or keep it where that is asked for."""
    path = FOLDER / f"{name}.png"
    if os.environ.get("FACEMORPH_RENEW_GOLDEN"):
        path.parent.mkdir(exist_ok=True)
        Image.fromarray(drawn).save(path, optimize=True)
        return
    kept = np.asarray(Image.open(path).convert("RGBA"))
    assert kept.shape == drawn.shape
    difference = np.abs(kept.astype(int) - drawn)
    far, mean = float(np.mean(difference.max(axis=2) > 24)), float(difference.mean())
    if far > 0.005 or mean > 1.5:
        _write_difference(name, kept, drawn, difference)
    assert far <= 0.005, f"{far:.2%} of the pixels differ; see {FOLDER / 'differences'}"
    assert mean <= 1.5, f"the pixels differ by {mean:.1f} on average; see {FOLDER / 'differences'}"


def _write_difference(name: str, kept: np.ndarray, drawn: np.ndarray, difference: np.ndarray) -> None:
    folder = FOLDER / "differences"
    folder.mkdir(exist_ok=True)
    shown = np.minimum(difference[..., :3] * 8, 255).astype(np.uint8)
    for kind, pixels in (("drawn", drawn), ("kept", kept), ("difference", shown)):
        Image.fromarray(pixels).save(folder / f"{name}-{kind}.png")
