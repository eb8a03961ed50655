"""What the commands do to the state: one short function each, free of menus and keys."""

from __future__ import annotations

import traceback
from dataclasses import replace

from facemorph.core.morph import Curve
from facemorph.core.picture import LEAST_LUMINANCE, MOST_LUMINANCE, LightRig, Shading
from facemorph.core.pose import Pose, state_of
from facemorph.deform.controls import Controls
from facemorph.errors import FacemorphError
from facemorph.ui.state import App
from facemorph.ui.words import label_of


def choose_expression(app: App, name: str) -> None:
    """The present face becomes the slider's source and `name` its goal; nothing jumps (2.11)."""
    app.playback.stop()
    if app.rig is None:
        return
    if app.pose.way_state() == state_of(name) and app.pose.t != 0.0:
        app.messages.tell(f"The face is already {label_of(app.rig, name).lower()}.")
        return
    app.pose = app.pose.rebased(name)


def start_from(app: App, name: str) -> None:
    """Set the slider's source by hand."""
    app.playback.stop()
    app.pose = replace(app.pose, source=state_of(name))


def set_slider(app: App, t: float) -> None:
    """Put the slider somewhere in 0..1."""
    app.playback.stop()
    app.pose = replace(app.pose, t=min(max(t, 0.0), 1.0))


def nudge_slider(app: App, step: float) -> None:
    """Move the slider by a step, to hundredths."""
    set_slider(app, round(app.pose.t + step, 4))


def set_curve(app: App, curve: Curve) -> None:
    """Choose how the slider eases, for now and for faces opened later."""
    app.pose = replace(app.pose, curve=curve)
    app.settings.curve = curve


def toggle_play(app: App) -> None:
    """Start or stop running the slider."""
    if app.playback.playing:
        app.playback.stop()
    elif app.expressions:
        app.playback.loop, app.playback.duration_secs = app.settings.loop, app.settings.duration_secs
        app.playback.start(app.pose.t)


def toggle_loop(app: App) -> None:
    """Run once, or there and back."""
    app.settings.loop = app.playback.loop = not app.settings.loop


def set_weight(app: App, name: str, weight: float) -> None:
    """Set what a shape adds to the face."""
    app.pose = app.pose.with_weight(name, weight)


def reset_weights(app: App) -> None:
    """Take every added shape out; the slider stays."""
    app.pose = replace(app.pose, weights={})


def reset_face(app: App) -> None:
    """Neutral again: no shapes added, every method at rest, the slider at its start from neutral."""
    app.stop_playing()
    app.pose = Pose(target=app.pose.target, curve=app.pose.curve)
    app.controls = Controls()


def toggle_shapes(app: App) -> None:
    """Take the added shapes out of the face, or put them back."""
    app.shapes_on = not app.shapes_on


def toggle_method(app: App, method: str) -> None:
    """Take one method out of the face, or put it back."""
    app.controls = replace(app.controls, off=app.controls.off ^ {method})


def toggle_correctives(app: App) -> None:
    """Let the face's correctives follow from its shapes, or leave them out."""
    if app.face is not None:
        rig = app.face.rig
        app.face = replace(app.face, rig=replace(rig, corrected=not rig.corrected))


def show_page(app: App, title: str) -> None:
    """Show one page of the panel on the right."""
    app.settings.right_page, app.settings.right_open, app.panels_hidden = title, True, False


def undo(app: App) -> None:
    """One step back."""
    snapshot = app.history.undo(app.snapshot())
    if snapshot is not None:
        app.restore(snapshot)


def redo(app: App) -> None:
    """One step forward."""
    snapshot = app.history.redo(app.snapshot())
    if snapshot is not None:
        app.restore(snapshot)


def set_shading(app: App, shading: Shading) -> None:
    """Choose what the surface shows."""
    app.look = replace(app.look, shading=shading)


def toggle_heat(app: App) -> None:
    """The heat map, or the skin again."""
    set_shading(app, "skin" if app.look.shading == "heat" else "heat")


def toggle_wire(app: App) -> None:
    """Polygon edges over the face."""
    app.look = replace(app.look, wire=not app.look.wire)


def set_smooth(app: App, smooth: str) -> None:
    """Choose how the surface is refined: "off", "1", "2" levels or "auto"."""
    app.settings.smooth_surface = smooth


def view_from(app: App, direction: str) -> None:
    """Look from a named direction, the whole face in sight."""
    app.turntable = False
    app.framing = direction


def frame_face(app: App) -> None:
    """The whole face in sight, from where the camera stands."""
    app.framing = f"{app.camera.azimuth_deg},{app.camera.elevation_deg}"


def toggle_turntable(app: App) -> None:
    """Let the camera go round the face."""
    app.turntable = not app.turntable


def set_light(app: App, light: LightRig) -> None:
    """Choose the lights around the face, for now and for the next start."""
    app.settings.light = light


def toggle_equal_luminance(app: App) -> None:
    """Light every face until its skin has the same luminance, or as it comes."""
    app.settings.equal_luminance = not app.settings.equal_luminance


def set_luminance(app: App, luminance: float) -> None:
    """The luminance that skin is brought to."""
    app.settings.luminance = min(max(luminance, LEAST_LUMINANCE), MOST_LUMINANCE)


def toggle_luminance_of(app: App) -> None:
    """Give each picture the luminance by itself, or the neutral face, whose exposure the others keep."""
    app.settings.luminance_of = "face" if app.settings.luminance_of == "picture" else "picture"


def toggle_theme(app: App) -> None:
    """Dark or light."""
    app.settings.theme = "light" if app.settings.theme == "dark" else "dark"


def toggle_left(app: App) -> None:
    """The faces panel."""
    app.settings.left_open = app.panels_hidden or not app.settings.left_open
    app.panels_hidden = False


def toggle_right(app: App) -> None:
    """The panel on the right."""
    app.settings.right_open = app.panels_hidden or not app.settings.right_open
    app.panels_hidden = False


def toggle_panels(app: App) -> None:
    """Nothing but the face, or the panels again."""
    app.panels_hidden = not app.panels_hidden


def toggle_wide(app: App) -> None:
    """Let sliders go below 0 and above 1."""
    app.settings.wide_weights = not app.settings.wide_weights


def toggle_keys(app: App) -> None:
    """The page of keys."""
    app.keys_open = not app.keys_open


def show_about(app: App) -> None:
    """Versions and credits."""
    app.about_open = True


def show_palette(app: App) -> None:
    """Find a command by its name."""
    app.palette.open, app.palette.fresh = True, True
    app.palette.words, app.palette.marked = "", 0


def ask_for(app: App, purpose: str) -> None:
    """Ask for a file: purpose is "open", "picture" or "mesh"."""
    app.chooser.purpose, app.chooser.path = purpose, ""
    app.chooser.fresh = True


def leave(app: App) -> None:
    """Shut the window."""
    app.quit = True


def tell_error(app: App, what: str, error: BaseException) -> None:
    """An error as a message: its own words where it was made for people, a traceback to copy where not."""
    if isinstance(error, FacemorphError):
        app.messages.fail(f"{what}. {error}")
        return
    details = "".join(traceback.format_exception(error))
    name = type(error).__name__
    app.messages.fail(
        f"{what}, because of a fault in facemorph ({name}). Please report it; Copy holds the details.",
        details,
    )
