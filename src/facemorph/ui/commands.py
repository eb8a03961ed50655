"""The table of commands: menus, keys, the palette and the F1 page are all made from it.

A command is added by one line here. `menu` is the path of menus it hangs in, "" for none; a new
`group` starts after a line. What depends on the face (expressions, recent files) is appended by
`commands`.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from facemorph.core.camera import DIRECTIONS
from facemorph.core.morph import CURVES
from facemorph.core.picture import LIGHT_RIGS, SHADINGS
from facemorph.core.pose import NEUTRAL, state_of
from facemorph.core.rig import plain_label
from facemorph.ui import actions, files
from facemorph.ui.chord import Chord
from facemorph.ui.command import Command, always, has_expressions, has_face, has_shapes
from facemorph.ui.emotion_commands import EMOTION
from facemorph.ui.method_commands import METHOD_COMMANDS
from facemorph.ui.page_commands import page_commands
from facemorph.ui.people_commands import PEOPLE
from facemorph.ui.state import App
from facemorph.ui.words import NEUTRAL_LABEL

MENUS = ("File", "Edit", "Expression", "View", "Help")
SHADING_WORDS = {
    "skin": "Skin",
    "clay": "Clay",
    "wire": "Wireframe",
    "normals": "Normals",
    "heat": "Heat map",
}
LIGHT_WORDS = {"studio": "Studio light", "window": "Window light", "flat": "Flat light"}
LIGHT_HELP = {
    "studio": "A portrait's: a large key light, some of it from the other side, a rim from behind",
    "window": "Large and soft, from one side",
    "flat": "Even, from the front, on a plain backdrop: for pictures in studies",
}
DIRECTION_WORDS = {
    "front": "Front",
    "three-quarter": "Three-quarter",
    "left": "Left side",
    "right": "Right side",
}


CURVE_HELP = {
    "linear": "Even speed: P(t) = (1 - t) P0 + t P1 (2.5)",
    "cosine": "Starts and ends gently: t' = (1 - cos(pi t)) / 2 (2.1, after Parke 1972)",
}


_EXPORTED = "Pictures show it; meshes are exported as the file has them"
SMOOTH_WORDS = {
    "off": ("Smooth surface off", "The file's own polygons"),
    "1": ("Smooth surface, level 1", f"Catmull-Clark once: four times the polygons. {_EXPORTED}"),
    "2": ("Smooth surface, level 2", f"Catmull-Clark twice: sixteen times the polygons. {_EXPORTED}"),
    "auto": ("Smooth surface automatically", "Level 1 where a graphics card's frames leave room for it"),
}


def _keys(text: str) -> tuple[Chord, ...]:
    return tuple(Chord.parse(part) for part in text.split())


def _shading_is(shading: str, app: App) -> bool:
    return app.look.shading == shading


def _smooth_is(smooth: str, app: App) -> bool:
    return app.settings.smooth_surface == smooth


def _light_is(light: str, app: App) -> bool:
    return app.settings.light == light


def _curve_is(curve: str, app: App) -> bool:
    return app.pose.curve == curve


def _builtin_is(name: str, app: App) -> bool:
    return app.face is not None and app.face.builtin and app.face.source == (name,)


def _target_is(name: str, app: App) -> bool:
    return app.pose.target == state_of(name)


FILE = (
    Command("Open face…", partial(actions.ask_for, purpose="open"), "File", _keys("Ctrl+O"),
            help="One mesh file, or a neutral together with its expressions"),
    Command("Open face folder…", partial(actions.ask_for, purpose="folder"), "File", _keys("Ctrl+Shift+O"),
            help="A folder with neutral.obj and its expressions"),
    Command("Make a person's blendshapes…", partial(actions.show_page, title="Fit"), "File", (), 1,
            help="From a template's shapes, a mesh of the person at rest and a few of their expressions"),
    Command("Save picture…", partial(actions.ask_for, purpose="picture"), "File", _keys("Ctrl+S"), 2,
            has_face, help="The face as you see it, as a PNG"),
    Command("Export mesh…", partial(actions.ask_for, purpose="mesh"), "File", _keys("Ctrl+E"), 2, has_face,
            help="The morphed face as an OBJ: same vertices, polygons and texture coordinates"),
    Command("Exit", actions.leave, "File", _keys("Ctrl+Q"), 9),
)  # fmt: skip

EDIT = (
    Command("Undo", actions.undo, "Edit", _keys("Ctrl+Z"), 0, lambda app: bool(app.history.undo_words),
            note=lambda app: app.history.undo_words, repeats=True),
    Command("Redo", actions.redo, "Edit", _keys("Ctrl+Shift+Z Ctrl+Y"), 0,
            lambda app: bool(app.history.redo_words), note=lambda app: app.history.redo_words, repeats=True),
    Command("Reset face", actions.reset_face, "Edit", _keys("Ctrl+R"), 1, has_shapes,
            help="Neutral again: no shapes added, every page at rest"),
    Command("Reset all shapes", actions.reset_weights, "Edit", (), 1, lambda app: bool(app.pose.weights),
            help="Takes out what the page Shapes adds; the slider and the other pages stay"),
    Command("Shapes on", actions.toggle_shapes, "Edit", (), 1, has_shapes, lambda app: app.shapes_on,
            help="Take what the page Shapes adds out of the face, and put it back"),
    Command("Weights below 0 and above 1", actions.toggle_wide, "Edit", (), 2, has_shapes,
            lambda app: app.settings.wide_weights,
            help="Exaggerate a shape, or run it backwards; the face may fold through itself"),
)  # fmt: skip

SLIDER = (
    Command("Play or pause", actions.toggle_play, "Expression", _keys("Space"), 2, has_expressions,
            lambda app: app.playback.playing, help="Runs the slider from the source to the goal"),
    Command("Loop", actions.toggle_loop, "Expression", _keys("L"), 2, has_expressions,
            lambda app: app.settings.loop, help="Plays there and back again, so that the face never jumps"),
    *(Command(f"{curve.capitalize()} motion", partial(actions.set_curve, curve=curve), "Expression", (), 3,
              has_expressions, partial(_curve_is, curve),
              help=CURVE_HELP[curve])
      for curve in CURVES),
    Command("Slider back by 0.01", partial(actions.nudge_slider, step=-0.01), "", _keys("Left"), 0,
            has_expressions, repeats=True),
    Command("Slider on by 0.01", partial(actions.nudge_slider, step=0.01), "", _keys("Right"), 0,
            has_expressions, repeats=True),
    Command("Slider back by 0.1", partial(actions.nudge_slider, step=-0.1), "", _keys("Shift+Left"), 0,
            has_expressions, repeats=True),
    Command("Slider on by 0.1", partial(actions.nudge_slider, step=0.1), "", _keys("Shift+Right"), 0,
            has_expressions, repeats=True),
    Command("Slider to 0", partial(actions.set_slider, t=0.0), "", _keys("Home"), 0, has_expressions),
    Command("Slider to 1", partial(actions.set_slider, t=1.0), "", _keys("End"), 0, has_expressions),
)  # fmt: skip

VIEW = (
    *(Command(DIRECTION_WORDS[name], partial(actions.view_from, direction=name), "View", (), 0, has_face)
      for name in DIRECTIONS),
    Command("Frame face", actions.frame_face, "View", _keys("F"), 0, has_face,
            help="The whole face in sight, from where you look"),
    Command("Turntable", actions.toggle_turntable, "View", _keys("T"), 0, has_face,
            lambda app: app.turntable),
    *(Command(SHADING_WORDS[name], partial(actions.set_shading, shading=name), "View", (), 1, has_face,
              partial(_shading_is, name)) for name in SHADINGS if name != "heat"),
    Command(SHADING_WORDS["heat"], actions.toggle_heat, "View", _keys("H"), 1, has_face,
            partial(_shading_is, "heat"),
            help="How far each point has moved from the neutral face; once more for the skin"),
    *(Command(words, partial(actions.set_smooth, smooth=name), "View/Smooth surface", (), 0, has_face,
              partial(_smooth_is, name), help=tip)
      for name, (words, tip) in SMOOTH_WORDS.items()),
    Command("Wireframe over the face", actions.toggle_wire, "View", _keys("W"), 2, has_face,
            lambda app: app.look.wire),
    Command("Correctives", actions.toggle_correctives, "View", (), 2,
            lambda app: app.rig is not None and bool(app.rig.correctives),
            lambda app: app.rig is not None and bool(app.rig.correctives) and app.rig.corrected,
            help="Shapes between shapes that keep jaw, lids and eyes on their ways; off, every face is the "
                 "plain sum of its shapes"),
    *(Command(LIGHT_WORDS[name], partial(actions.set_light, light=name), "View/Lights", (), 2, always,
              partial(_light_is, name), help=LIGHT_HELP[name]) for name in LIGHT_RIGS),
    Command("Equal luminance", actions.toggle_equal_luminance, "View/Lights", (), 3, always,
            lambda app: app.settings.equal_luminance,
            help="Lights are raised or lowered until every face's skin is equally bright: for pictures in "
                 "studies. How bright is set at the lower left of the face; saved pictures have it too"),
    Command("Equal luminance for each expression", actions.toggle_luminance_of, "View/Lights", (), 3,
            lambda app: app.settings.equal_luminance, lambda app: app.settings.luminance_of == "picture",
            help="Every picture is lit by itself. Off, the neutral face is, and its expressions keep "
                 "that light: they then differ by a few percent"),
    Command("Faces panel", actions.toggle_left, "View", (), 3, always,
            lambda app: app.settings.left_open and not app.panels_hidden),
    Command("Pages panel", actions.toggle_right, "View", (), 3, always,
            lambda app: app.settings.right_open and not app.panels_hidden),
    Command("Hide the panels", actions.toggle_panels, "View", _keys("Tab"), 3, always,
            lambda app: app.panels_hidden),
    Command("Light theme", actions.toggle_theme, "View", (), 4, always,
            lambda app: app.settings.theme == "light"),
)  # fmt: skip

HELP = (
    Command("Find a command…", actions.show_palette, "Help", _keys("Ctrl+K")),
    Command("Keys and mouse", actions.toggle_keys, "Help", _keys("F1")),
    Command("About facemorph", actions.show_about, "Help", (), 1),
)

STATIC = FILE + EDIT + SLIDER + VIEW + EMOTION + PEOPLE + METHOD_COMMANDS + HELP


def commands(app: App) -> tuple[Command, ...]:
    """Every command there is now, in the menus' order."""
    return (*_opening(app), *_expressions(app), *page_commands(), *STATIC)


def _expressions(app: App) -> tuple[Command, ...]:
    if app.face is None:
        return ()
    names = [(NEUTRAL, NEUTRAL_LABEL), *((shape.name, shape.label) for shape in app.expressions)]
    return tuple(
        Command(
            label.strip() or name,
            partial(actions.choose_expression, name=name),
            "Expression",
            _keys(str(place)) if place <= 7 else (),
            0,
            has_expressions,
            partial(_target_is, name),
            help="From the present face to this one; the slider starts again at 0 (2.11)",
        )
        for place, (name, label) in enumerate(names, start=1)
    )


def _opening(app: App) -> tuple[Command, ...]:
    builtin = [
        Command(
            plain_label(name),
            partial(files.open_builtin, name=name),
            "File/Built-in faces",
            checked=partial(_builtin_is, name),
        )
        for name in app.builtins
    ]
    recent = [
        Command(_recent_title(source), partial(files.open_source, source=tuple(source)), "File/Open recent")
        for source in app.settings.recent
    ]
    return (*builtin, *recent)


def _recent_title(source: list[str]) -> str:
    path = Path(source[0])
    shown = str(path) if len(str(path)) <= 48 else f"…/{path.parent.name}/{path.name}"
    return shown if len(source) == 1 else f"{shown} and {len(source) - 1} more"
