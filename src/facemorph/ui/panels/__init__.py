"""The window's parts, one a module. A new one is added to one of these tuples and appears.

`PARTS` are drawn every frame, in order. A side's `TABS` share its panel; with one entry there is a
title and no tab bar.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from facemorph.ui.layout import Layout
from facemorph.ui.state import App


@dataclass(frozen=True)
class Tab:
    """A page of a side panel: its words, what draws it, whether it moves the face now, what it is for."""

    title: str
    draw: Callable[[App], None]
    moves_face: Callable[[App], bool] = lambda app: False
    tip: str = ""


Part = Callable[[App, Layout], None]


def left_tabs() -> tuple[Tab, ...]:
    """Where things come from."""
    from facemorph.ui.panels import faces

    return (Tab("Faces", faces.draw),)


def right_tabs() -> tuple[Tab, ...]:
    """The pose, in layers: each page is one method and adds to the sum."""
    from facemorph.ui.panels import compare, emotion, facs, fit, handles, people, regions, shapes

    return (
        Tab("Shapes", shapes.draw, shapes.moves_face, "Every shape of the face, added on top"),
        Tab("FACS", facs.draw, facs.moves_face, "Single movements that add up to expressions (2.1.2)"),
        Tab("Emotion", emotion.draw, emotion.moves_face, "A cursor among expressions mixes them (2.1.2)"),
        Tab("People", people.draw, people.moves_face, "Between two people and two expressions (2.2)"),
        Tab("Handles", handles.draw, handles.moves_face, "Points on the face that are dragged: RBF (2.3)"),
        Tab("Regions", regions.draw, regions.moves_face, "Parts of the face, each on its own way (Parke)"),
        Tab("Compare", compare.draw, tip="Paths, speeds and pictures of several methods side by side"),
        Tab("Fit", fit.draw, tip="Make another person's blendshapes from this face's and a few examples"),
    )


def parts() -> tuple[Part, ...]:
    """Everything on the window, in drawing order."""
    from facemorph.ui import on_face
    from facemorph.ui.panels import (
        about,
        bottom_bar,
        chooser,
        keys,
        luminance,
        menu_bar,
        messages,
        overlay,
        palette,
        sides,
    )

    return (
        menu_bar.draw,
        bottom_bar.draw,
        on_face.clear,
        sides.draw,
        overlay.draw,
        luminance.draw,
        messages.draw,
        keys.draw,
        about.draw,
        chooser.draw,
        palette.draw,
    )
