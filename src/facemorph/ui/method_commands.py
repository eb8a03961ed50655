"""Commands of the pages FACS, Handles and Regions: a part of the table of commands."""

from __future__ import annotations

from functools import partial

from facemorph.core.facs import PROTOTYPES, Sides, units_text
from facemorph.ui import actions, handles, regions, units
from facemorph.ui.command import Command, has_face
from facemorph.ui.state import App


def _has_prototype(emotion: str, app: App) -> bool:
    return bool(set(PROTOTYPES[emotion]) & set(units.available(app)))


def _prototype_text(emotion: str) -> str:
    return units_text({number: Sides.both(1.0) for number in PROTOTYPES[emotion]})


def _has_points(app: App) -> bool:
    return bool(app.controls.handles.handles)


def _has_moved_points(app: App) -> bool:
    return not handles.at_rest(app)


def _has_regions(app: App) -> bool:
    return regions.region_set(app) is not None


FACS = (
    *(Command(f"FACS: {emotion}", partial(units.set_prototype, emotion=emotion), "Expression/FACS units",
              enabled=partial(_has_prototype, emotion),
              help=f"{_prototype_text(emotion)}, in place of the units there are (2.1.2)")
      for emotion in PROTOTYPES),
    Command("FACS: copy units", units.copy_units, "Expression/FACS units", enabled=units.has_units,
            help="The units of the present face as text, such as AU1+4+15"),
    Command("FACS: paste units", units.paste_units, "Expression/FACS units", enabled=units.has_units,
            help="Units from the clipboard's text, in place of those there are"),
    Command("FACS: reset", units.reset_units, "Expression/FACS units", enabled=units.has_moving_units,
            help="Every unit at rest; the other pages stay"),
)  # fmt: skip

HANDLES = (
    Command("Handles: open points…", partial(actions.ask_for, purpose="open points"), "Expression/Handles",
            enabled=has_face, help="Points kept in a file, in place of those there are"),
    Command("Handles: save points…", partial(actions.ask_for, purpose="save points"), "Expression/Handles",
            enabled=_has_points, help="Keep the points in a file (JSON)"),
    Command("Handles: reset", handles.back_to_rest, "Expression/Handles", enabled=_has_moved_points,
            help="Every point back to where it rests; the points stay"),
    Command("Handles: clear", handles.clear, "Expression/Handles", enabled=_has_points,
            help="Take all points away"),
)  # fmt: skip

REGIONS = (
    Command("Regions: open regions…", partial(actions.ask_for, purpose="open regions"), "Expression/Regions",
            enabled=has_face, help="Regions kept in a file, in place of those there are"),
    Command("Regions: save regions…", partial(actions.ask_for, purpose="save regions"), "Expression/Regions",
            enabled=_has_regions, help="Keep the regions in a file (NPZ)"),
    Command("Regions: reset", regions.reset, "Expression/Regions",
            enabled=lambda app: bool(app.controls.regions),
            help="Every region at rest; what was painted stays"),
    Command("Regions: unpaint", partial(regions.use, chosen=None), "Expression/Regions",
            enabled=lambda app: app.painted is not None,
            help="The face's own regions again"),
)  # fmt: skip

METHOD_COMMANDS = FACS + HANDLES + REGIONS
