"""What can be done with regions: controls, the brush that paints them, files. Free of mouse and panels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.pose import NEUTRAL, State, state_of
from facemorph.core.rig import EXPRESSION, Rig
from facemorph.deform.regions import RegionControl, RegionSet, painted
from facemorph.deform.sides import midline
from facemorph.errors import FacemorphError
from facemorph.ui import files
from facemorph.ui.actions import tell_error
from facemorph.ui.paths import suffixed
from facemorph.ui.state import App

NAMES = ("brows", "eyes", "nose", "cheeks", "mouth", "jaw")


def region_set(app: App) -> RegionSet | None:
    """The regions in use: painted ones, or those that the face brings; None where there are none."""
    if app.painted is not None or app.rig is None:
        return app.painted
    return None if app.rig.regions is None else RegionSet.of(app.rig)


def names(app: App) -> tuple[str, ...]:
    """What the regions in use are called; a face without any gets Parke's."""
    present = region_set(app)
    return NAMES if present is None else present.names


def control(app: App, rig: Rig, name: str) -> RegionControl:
    """What a region is set to; one that was never touched goes from neutral to the first expression."""
    kept = app.controls.regions.get(name)
    if kept is not None:
        return kept
    shapes = rig.shapes_in(EXPRESSION)
    return RegionControl(target=state_of(shapes[0].name) if shapes else {})


def change(app: App, changed: Mapping[str, RegionControl]) -> None:
    """Set some regions."""
    app.controls = replace(app.controls, regions={**app.controls.regions, **changed})


def reset(app: App) -> None:
    """Every region at rest; what was painted stays."""
    app.controls = replace(app.controls, regions={})


def reset_one(app: App, name: str) -> None:
    """One region at rest."""
    left = {other: kept for other, kept in app.controls.regions.items() if other != name}
    app.controls = replace(app.controls, regions=left)


def moves(kept: RegionControl) -> bool:
    """Whether a region does anything."""
    return kept.moves_rigidly or any(kept.state().values())


def at_rest(app: App) -> bool:
    """Whether no region does anything."""
    return not any(moves(kept) for kept in app.controls.regions.values())


def state_name(state: State) -> str:
    """The expression that a state is, "" for a mixture."""
    if not state:
        return NEUTRAL
    ((name, weight), *more) = state.items()
    return name if weight == 1.0 and not more else ""


def begin_stroke(app: App, rig: Rig) -> None:
    """The brush is set down: paint on a copy until it is lifted."""
    present = region_set(app)
    empty = np.zeros((len(names(app)), rig.neutral.vertex_count), np.float32)
    app.lab.regions.stroke = empty if present is None else present.weights.copy()


def dab(app: App, rig: Rig, positions: Float32, centre: Float64) -> None:
    """One touch of the brush round `centre` (3,) on the shown surface (V, 3), and in the mirror if asked."""
    page = app.lab.regions
    assert page.stroke is not None
    brush = soft_disc(positions, centre, page.radius)
    if page.mirror:
        image = centre * (-1.0, 1.0, 1.0) + (2.0 * midline(rig), 0.0, 0.0)
        brush = np.maximum(brush, soft_disc(positions, image, page.radius))
    signed = brush * np.float32(-page.strength if page.takes else page.strength)
    page.stroke = painted(page.stroke, names(app).index(page.region), signed)


def end_stroke(app: App, rig: Rig) -> None:
    """The brush is lifted: what it painted is in use from now on."""
    page = app.lab.regions
    if page.stroke is not None:
        app.painted = RegionSet(rig, names(app), page.stroke)
    page.stroke = page.last_dab = None


def use(app: App, chosen: RegionSet | None) -> None:
    """Take other regions, or the face's own again; settings of regions that are no longer there go."""
    app.painted = chosen
    left = names(app)
    kept = {name: setting for name, setting in app.controls.regions.items() if name in left}
    if len(kept) < len(app.controls.regions):
        app.controls = replace(app.controls, regions=kept)


def save(app: App, path: Path) -> None:
    """Keep the regions in use in a file."""
    from facemorph.io import write_regions

    rig, present = app.rig, region_set(app)
    if rig is None or present is None:
        return
    files.keep(
        app,
        suffixed(path, ".npz"),
        "The regions were not saved",
        lambda goal: write_regions(goal, present, rig),
    )


def load(app: App, path: Path) -> None:
    """Take the regions kept in a file; the present ones stay where that fails."""
    from facemorph.io import read_regions

    if app.rig is None:
        return
    try:
        chosen = read_regions(path, app.rig)
    except FacemorphError as error:
        tell_error(app, "The regions were not opened", error)
        return
    use(app, chosen)
    app.messages.tell(f"Opened {path.name}: {', '.join(chosen.names)}.")


def soft_disc(positions: Float32, centre: Float64, radius: float) -> Float32:
    """1 at `centre` (3,), smoothly to 0 at `radius` (model units), (V,) float32."""
    away = np.linalg.norm(positions.astype(np.float64) - centre, axis=1) / max(radius, 1e-9)
    near = np.clip(1.0 - away, 0.0, 1.0)
    soft: Float32 = (near * near * (3.0 - 2.0 * near)).astype(np.float32)
    return soft


def light(app: App, name: str) -> Float32 | None:
    """Weights (V,) of a region as the face lights up for it: the same array while nothing changes."""
    page = app.lab.regions
    key = (
        (name, app.painted, app.rig, id(page.stroke))
        if page.stroke is not None
        else (name, app.painted, app.rig)
    )
    if app.rig is None or name not in names(app):
        return None
    if page.lit[0] != key:
        place, present = names(app).index(name), region_set(app)
        weights = page.stroke if page.stroke is not None else present.weights if present else None
        page.lit = (key, None if weights is None else np.ascontiguousarray(weights[place]))
    return page.lit[1]
