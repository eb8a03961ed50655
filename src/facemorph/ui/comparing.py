"""The same way by several methods: a vertex's path as t runs, and two scenes side by side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.morph import Curve, eased
from facemorph.core.pose import Pose, state_of
from facemorph.core.progress import Progress
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.core.scene import Scene
from facemorph.deform.control_points import rebuilding_vertices
from facemorph.deform.controls import METHODS, BoundControls, Controls
from facemorph.deform.rebuild import rebuilt
from facemorph.errors import FacemorphError
from facemorph.ui.actions import tell_error
from facemorph.ui.lab import Paths
from facemorph.ui.methods import OWN
from facemorph.ui.state import App
from facemorph.ui.words import METHOD_WORDS

SAMPLES = 81
LINEAR, COSINE, PRESENT, REBUILT = "Linear", "Cosine", "Present", "RBF rebuild"
WITHOUT = "Without "
REBUILD_POINTS = 40


def running(pose: Pose, controls: Controls, t: float) -> tuple[Pose, Controls]:
    """Everything that has a t at `t`: the slider, the regions, the people's way; the rest as it is set."""
    regions = {name: replace(kept, t=t) for name, kept in controls.regions.items()}
    return replace(pose, t=t), replace(controls, regions=regions, people=replace(controls.people, t=t))


def refresh_paths(app: App, rig: Rig, followed: int | str) -> None:
    """Have the paths of a vertex or of a shape's weight made for what is set now, if they are not yet."""
    page, pose, controls = app.lab.compare, app.shown_pose, app.controls
    asked = (rig, followed, *running(pose, controls, 0.0), app.painted, tuple(app.methods.people))
    if page.asked == asked:
        return
    page.asked = asked
    # The window's own binding is not for other threads: it keeps what it made last.
    bound = BoundControls(rig, OWN, dict(app.methods.people), app.painted)

    def work(progress: Progress) -> Paths:
        if isinstance(followed, int):
            return paths(rig, followed, pose, controls, bound, progress)
        return weight_paths(rig, followed, pose, controls, bound, progress)

    def done(made: Paths) -> None:
        page.paths = made

    def failed(error: BaseException) -> None:
        page.paths = None
        tell_error(app, "The paths were not compared", error)

    app.jobs.start("Following t", work, done, failed, kind="paths", quiet=True)


def paths(
    rig: Rig, vertex: int, pose: Pose, controls: Controls, bound: BoundControls, progress: Progress
) -> Paths:
    """What a vertex does as t runs 0..1: as everything is set now, and straight between its two ends.

    Present is the sum of all methods; linear is (2.5) from where that begins to where it ends, cosine the
    same with t eased (2.1). Speed is |dP/dt|, acceleration its change d|dP/dt|/dt, by differences.
    """

    def place(at: float) -> Float64:
        return _place(rig, vertex, *running(pose, controls, at), bound)

    t, ways = _ways(place, progress)
    distance = {name: np.linalg.norm(way - way[0], axis=1) for name, way in ways.items()}
    speed = {
        name: np.linalg.norm(np.gradient(way, t, axis=0, edge_order=2), axis=1) for name, way in ways.items()
    }
    acceleration = {name: np.gradient(values, t, edge_order=2) for name, values in speed.items()}
    return Paths(t, distance, speed, acceleration)


def weight_paths(
    rig: Rig, shape: str, pose: Pose, controls: Controls, bound: BoundControls, progress: Progress
) -> Paths:
    """What a shape's weight does as t runs 0..1, by the same three methods; speed and acceleration signed.

    The weight is the sum of what the slider, the shapes and every method add; regions and handles move the
    face without weights.
    """
    index = rig.names.index(shape)

    def weight(at: float) -> Float64:
        pose_then, controls_then = running(pose, controls, at)
        coefficients = bound(pose_then, controls_then).added_to(pose_then).coefficients(rig.names)
        return coefficients[index : index + 1]

    t, ways = _ways(weight, progress)
    value = {name: way[:, 0] for name, way in ways.items()}
    speed = {name: np.gradient(values, t, edge_order=2) for name, values in value.items()}
    acceleration = {name: np.gradient(values, t, edge_order=2) for name, values in speed.items()}
    return Paths(t, value, speed, acceleration)


def _ways(at_t: Callable[[float], Float64], progress: Progress) -> tuple[Float64, dict[str, Float64]]:
    """t (n,), and by method what `at_t` gives (n, d): as it is, and straight between its two ends."""
    t = np.linspace(0.0, 1.0, SAMPLES)
    found = []
    for place, at in enumerate(t):
        progress(place / SAMPLES, "Following t")
        found.append(at_t(float(at)))
    present = np.array(found)
    ways = {PRESENT: present}
    for name, curve in ((LINEAR, "linear"), (COSINE, "cosine")):
        e = np.array([eased(float(at), _CURVES[curve]) for at in t])[:, None]
        ways[name] = (1.0 - e) * present[0] + e * present[-1]
    return t, ways


def shapes_now(app: App, rig: Rig) -> dict[str, str]:
    """Shapes whose weight can be followed, with words: expressions, and what any page sets now."""
    pose, controls = app.shown_pose, app.controls
    moving = {*pose.names(), *(f"AU{number}" for number in controls.facs), *controls.emotion.weights()}
    moving |= {*controls.people.source, *controls.people.target}
    return {
        shape.name: shape.label for shape in rig.shapes if shape.set == EXPRESSION or shape.name in moving
    }


_CURVES: dict[str, Curve] = {"linear": "linear", "cosine": "cosine"}


def _place(rig: Rig, vertex: int, pose: Pose, controls: Controls, bound: BoundControls) -> Float64:
    contribution = bound(pose, controls)
    coefficients = rig.coefficients(contribution.added_to(pose))
    place: Float64 = rig.neutral.positions[vertex] + coefficients @ rig.deltas[:, vertex].astype(np.float64)
    return place if contribution.offsets is None else place + contribution.offsets[vertex]


def methods_now(app: App, rig: Rig) -> dict[str, str]:
    """What can be compared now, with words: the curves, the rebuild, the present face without a layer."""
    choices = {LINEAR: "Linear", COSINE: "Cosine", PRESENT: "As it is now"}
    if _target_name(app, rig):
        choices[REBUILT] = f"RBF, {REBUILD_POINTS} points"
    moving = _layers(app)
    return {
        **choices,
        **{f"{WITHOUT}{layer}": f"Without {METHOD_WORDS.get(layer, layer)}" for layer in moving},
    }


def _layers(app: App) -> list[str]:
    """The layers that are on and not at rest."""
    at_rest = Controls()
    on = [m for m in METHODS if app.controls.on(m) and getattr(app.controls, m) != getattr(at_rest, m)]
    return ["shapes", *on] if app.shapes_on and app.pose.weights else on


def refresh_scenes(app: App, rig: Rig) -> None:
    """Make the two scenes of the split view, unless nothing changed since."""
    page = app.lab.compare
    key = (
        app.face,
        app.shown_pose,
        app.controls,
        app.painted,
        page.left,
        page.right,
        tuple(app.methods.people),
    )
    if page.scenes is not None and page.kept == key:
        return
    page.kept = key
    try:
        left, right = scene_by(app, rig, page.left), scene_by(app, rig, page.right)
    except FacemorphError as error:
        page.scenes, page.split = None, False
        tell_error(app, "The two methods were not compared", error)
        return
    first = left.positions(rig)
    away = np.linalg.norm(right.positions(rig) - first, axis=1)
    page.difference = float(away.max(initial=0.0)), float(np.sqrt(np.mean(away**2)))
    page.scenes = (left, replace(right, reference=first))


def scene_by(app: App, rig: Rig, method: str) -> Scene:
    """The present pose by one of `methods_now`. Raises what the method raises."""
    pose, controls = app.shown_pose, app.controls
    if method in (LINEAR, COSINE):
        curve = _CURVES[method.lower()]
        regions = {name: replace(kept, curve=curve) for name, kept in controls.regions.items()}
        people = replace(controls.people, curve=curve)
        pose, controls = replace(pose, curve=curve), replace(controls, regions=regions, people=people)
    elif method.startswith(WITHOUT):
        layer = method.removeprefix(WITHOUT)
        if layer == "shapes":
            pose = replace(pose, weights={})
        else:
            controls = replace(controls, off=controls.off | {layer})
    elif method == REBUILT:
        return _rebuilt_scene(app, rig, pose)
    return app.methods.made(app.methods.bound(app), pose, controls)


def _target_name(app: App, rig: Rig) -> str:
    names = [name for name, weight in app.pose.target.items() if weight]
    return names[0] if len(names) == 1 and names[0] in rig.names else ""


def _rebuilt_scene(app: App, rig: Rig, pose: Pose) -> Scene:
    """The slider's way to the target as n points know it: e times the rebuilt displacement (2.13)."""
    way = np.float32(eased(pose.t, pose.curve)) * _rebuilt_way(app, rig, pose)
    still = replace(pose, target=pose.source, t=0.0)
    scene = app.methods.made(app.methods.bound(app), still, app.controls)
    return replace(scene, offsets=way if scene.offsets is None else scene.offsets + way)


def _rebuilt_way(app: App, rig: Rig, pose: Pose) -> Float32:
    """The displacement (V, 3) from the slider's source to its target, rebuilt; kept while both stay."""
    page, goal = app.lab.compare, _target_name(app, rig)
    key = (rig, pose.source, goal)
    kept, way = page.rebuilt
    if way is None or kept != key:
        source, target = rig.positions(dict(pose.source)), rig.positions(state_of(goal))
        vertices = rebuilding_vertices(rig, source, target, REBUILD_POINTS)
        result = rebuilt(rig, source, target, vertices)
        way = result.positions - source
        page.rebuilt = (key, way)
    return way
