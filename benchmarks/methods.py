"""RBF set-up and drag beside scipy, and a frame of the window's scene with every method active."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import RBFInterpolator

import facemorph
from benchmarks.harness import Table, interleaved_ms
from benchmarks.make_faces import head
from facemorph.core.camera import Camera
from facemorph.core.facs import Sides
from facemorph.core.picture import Look
from facemorph.core.pose import Pose, state_of
from facemorph.core.scene import Partner, Scene
from facemorph.deform.controls import BoundControls, Controls, EmotionControl, PeopleControl
from facemorph.deform.handles import Handle, HandleSet
from facemorph.deform.people import PeopleMix
from facemorph.deform.rbf import RbfField
from facemorph.deform.regions import RegionControl
from facemorph.gl import Renderer, create_context

SIZE = (1280, 800)


def run() -> list[Table]:
    """Two tables."""
    return [_rbf(), _every_method()]


def _rbf() -> Table:
    positions = head(27_000).positions.astype(np.float32)
    rng = np.random.default_rng(0)
    columns = ("points", "set-up ms", "drag ms", "scipy, set-up and drag in one, ms", "scipy's time / a drag")
    table = Table(f"RBF, kernel r, on {len(positions):,} vertices", columns)
    for count in (40, 100, 250):
        points = positions[rng.choice(len(positions), count, replace=False)].astype(np.float64)
        field = RbfField(points, positions)
        moves = rng.normal(size=(count, 3))
        works = {
            "bind": lambda p=points: RbfField(p, positions),
            "drag": lambda f=field, m=moves: f(m),
            "scipy": lambda p=points, m=moves: RBFInterpolator(p, m, kernel="linear", degree=1)(positions),
        }
        ms = interleaved_ms(works, times=7, warm=1)
        ratio = f"{ms['scipy'] / ms['drag']:.0f}x"
        table.add(str(count), f"{ms['bind']:.1f}", f"{ms['drag']:.2f}", f"{ms['scipy']:.0f}", ratio)
    return table


def _every_method() -> Table:
    rig, other = facemorph.load("ada"), facemorph.load("kofi")
    renderer = Renderer(create_context())
    renderer.load(rig)
    camera = Camera.framing(rig.neutral.bounds, "front", SIZE[0] / SIZE[1])
    bound = BoundControls(rig, "ada", {"kofi": other})
    controls = _controls()
    step = iter(range(10**9))

    def frame(setting: Controls, partner: bool) -> object:
        moving = Pose.between("neutral", "happy", (next(step) % 20) / 20)
        colours = [Partner(other, 0.4)] if partner else []
        renderer.draw(
            Scene.moved(moving, bound(moving, setting), colours), camera, Look(), SIZE, quality="fast"
        )
        return renderer.read()

    def dragged() -> object:
        handles = controls.handles.moved(500, (0.0, (next(step) % 20) / 20, 0.0))
        return frame(replace(controls, handles=handles), True)

    times = interleaved_ms(
        {
            "slider alone": lambda: frame(Controls(), False),
            "every method active, slider moves": lambda: frame(controls, True),
            "every method active, a handle is dragged": dragged,
        }
    )
    table = Table(f"A frame of ada, {rig.neutral.vertex_count:,} vertices, 1280x800", ("what", "median ms"))
    for name, ms in times.items():
        table.add(name, f"{ms:.1f}")
    return table


def _controls() -> Controls:
    places = tuple(range(0, 8000, 80))
    moved = {500: (0.0, 0.4, 0.2)}
    handles = HandleSet(tuple(Handle(v, moved.get(v, (0.0, 0.0, 0.0))) for v in sorted({*places, 500})))
    return Controls(
        facs={1: Sides.both(0.3), 12: Sides(0.6, 0.2)},
        emotion=EmotionControl(0.2, 0.3),
        people=PeopleControl(PeopleMix({"ada": 1.0}, "kofi", 0.4), {}, state_of("sad"), 0.2),
        handles=handles,
        regions={"brows": RegionControl(target={"surprised": 1.0}, t=0.5, turn_deg=(0.0, 0.0, 5.0))},
    )
