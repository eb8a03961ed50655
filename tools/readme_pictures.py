"""Make the pictures of the README in docs/: the window, an animated morph, a sheet, a heat map.

    python tools/readme_pictures.py

Everything is drawn by facemorph itself, off-screen; run it again when faces or window change.
"""

from __future__ import annotations

import itertools
import os
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.ui.harness import Offscreen as Window  # noqa: E402

import facemorph  # noqa: E402
from facemorph.api import export_positions  # noqa: E402
from facemorph.core.facs import Sides  # noqa: E402
from facemorph.core.morph import eased  # noqa: E402
from facemorph.core.scene import Partner, Scene  # noqa: E402
from facemorph.deform.controls import BoundControls, Controls, PeopleControl  # noqa: E402
from facemorph.deform.people import PeopleMix  # noqa: E402
from facemorph.deform.regions import RegionControl  # noqa: E402
from facemorph.gl import sheet  # noqa: E402
from facemorph.resources import builtin_faces  # noqa: E402
from facemorph.ui import emotion, fit_run  # noqa: E402
from facemorph.ui import people as people_page  # noqa: E402
from facemorph.ui.fit_page import NEUTRAL, RESULT, WEIGHTS  # noqa: E402
from facemorph.ui.run import open_dropped  # noqa: E402
from facemorph.ui.settings import Settings  # noqa: E402
from facemorph.ui.state import Face  # noqa: E402

DOCS = ROOT / "docs"
FRAMES_A_WAY = 14
HOLD_FRAMES = 5
FRAME_MS = 50
MORPH_SIZE = (400, 400)


def main() -> None:
    """All pictures, a path a line."""
    DOCS.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["FACEMORPH_CONFIG_DIR"] = os.environ["FACEMORPH_CACHE_DIR"] = folder
        window(DOCS / "window.png")
        pages(DOCS / "pages.png")
        fit(DOCS / "fit.png", Path(folder))
    rig = facemorph.load("mei")
    with facemorph.Offscreen() as screen:
        animation(screen, rig, DOCS / "morph.webp")
        six = sheet(screen, facemorph.load("zola"), tile=(300, 320))
        save(DOCS / "sheet.png", six)
        people(screen, DOCS / "people.png")
        look = facemorph.Look(shading="heat")
        heat = screen.render(rig, {"happy": 1.0}, size=(900, 560), camera="three-quarter", look=look)
        save(DOCS / "heat.png", heat)


def window(path: Path) -> None:
    """The window as it stands when Happy has been picked and the slider dragged."""
    with Window(facemorph.load("ada"), size=(1280, 800)) as screen:
        screen.app.pose = facemorph.Pose.between("neutral", "happy", 0.75, "cosine")
        screen.app.settings.hint_seen = True
        screen.frames(4)
        save(path, screen.pixels_now())


def pages(path: Path) -> None:
    """Four of the methods' pages, each in use, side by side."""
    steps = {"Emotion": _emotion, "People": _people, "Regions": _regions, "Compare": _compare}
    panels = []
    for title, step in steps.items():
        settings = Settings(hint_seen=True, right_page=title)
        rig = facemorph.load("ada")
        names, kept = tuple(builtin_faces()), Path(os.environ["FACEMORPH_CACHE_DIR"])
        with Window(None, (1280, 800), settings=settings, thumbnails=kept, builtins=names) as screen:
            screen.app.arriving = Face(rig, ("ada",), builtin=True)
            screen.frames(3)
            if title == "People":
                screen.until(lambda app=screen.app: len(app.face_pictures) == len(app.builtins))
            step(screen)
            screen.frames(40)
            panels.append(screen.pixels_now()[28:752, 904:])
    save(path, np.concatenate(panels, axis=1))


def fit(path: Path, folder: Path) -> None:
    """The page Fit with its result: Omar from Ada's shapes and three expressions that are not hers."""
    person = facemorph.load("omar")
    low, high = person.neutral.bounds
    at = (person.neutral.positions - low) / (high - low)
    # Omar's own way to move, smoothly other than Ada's: more on his left, less above.
    way = (0.8 + 0.5 * at[:, 0] - 0.25 * at[:, 1]).astype(np.float32)[:, None]
    folder = folder / "Robin"
    folder.mkdir()
    files = [folder / "neutral.obj"]
    facemorph.export(person, {}, files[0])
    for name, pose in {"shout": {"surprised": 0.8}, "frown": {"angry": 0.9}, "smile": {"happy": 0.9}}.items():
        moved = person.neutral.positions + way * (person.positions(pose) - person.neutral.positions)
        files.append(export_positions(person, moved, folder / f"{name}.obj"))
    settings = Settings(hint_seen=True, right_page="Fit")
    with Window(facemorph.load("ada"), (1280, 800), settings=settings) as screen:
        app = screen.app
        app.pages.fit.step = NEUTRAL
        open_dropped(app, [str(file) for file in files])
        screen.until(lambda: not app.jobs.running)
        app.pages.fit.step = WEIGHTS
        screen.until(lambda: fit_run.can_make(app))
        fit_run.make(app)
        screen.until(lambda: app.pages.fit.made is not None)
        app.pages.fit.step, app.pages.fit.heat = RESULT, True
        screen.frames(40)
        save(path, screen.pixels_now())


def _emotion(screen: Window) -> None:
    emotion.put(screen.app, 0.35, 0.75)


def _people(screen: Window) -> None:
    people_page.ask_builtin(screen.app, "kofi")
    screen.until(lambda: not screen.app.jobs.running)
    people_page.choose_target(screen.app, "happy")
    people_page.put(screen.app, 0.6, 0.4)


def _regions(screen: Window) -> None:
    app = screen.app
    control = RegionControl({}, {"angry": 1.0}, 0.8)
    app.controls = replace(app.controls, regions={"brows": control})
    screen.frames(2)


def _compare(screen: Window) -> None:
    app = screen.app
    app.pose = facemorph.Pose.between("neutral", "happy", 0.6, "cosine")
    app.controls = replace(app.controls, facs={26: Sides.both(0.4)})
    screen.frames(2)
    screen.click(450, 480)
    screen.until(lambda: app.lab.compare.paths is not None)


def animation(screen: facemorph.Offscreen, rig: facemorph.Rig, path: Path) -> None:
    """Neutral to happy, on to surprised, and back, as a WebP that loops."""
    stops = ["neutral", "happy", "surprised", "neutral"]
    pictures = []
    for start, end in itertools.pairwise(stops):
        steps = [eased(k / FRAMES_A_WAY, "cosine") for k in range(FRAMES_A_WAY)] + [1.0] * HOLD_FRAMES
        for t in steps:
            pose = facemorph.Pose.between(start, end, t)
            pixels = screen.render(rig, pose, size=MORPH_SIZE, camera="20,2")
            pictures.append(Image.fromarray(np.ascontiguousarray(pixels[..., :3])))
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=FRAME_MS, loop=0, quality=82)
    print(path.relative_to(ROOT))


def people(screen: facemorph.Offscreen, path: Path) -> None:
    """From Ada to Kofi while both begin to smile: the bilinear interpolation (2.10) with its skins."""
    rig, other = facemorph.load("ada"), facemorph.load("kofi")
    bound = BoundControls(rig, "ada", {"kofi": other})
    tiles = []
    for s in np.linspace(0.0, 1.0, 5):
        pose = facemorph.Pose.between("neutral", "happy", float(s))
        controls = Controls(people=PeopleControl(PeopleMix({"ada": 1.0}, "kofi", float(s))))
        scene = Scene.moved(pose, bound(pose, controls), [Partner(other, float(s))])
        tiles.append(screen.render(rig, scene, size=(300, 340), camera="-15,2"))
    save(path, np.concatenate(tiles, axis=1))


def save(path: Path, pixels: np.ndarray) -> None:
    """Write a picture without alpha."""
    Image.fromarray(np.ascontiguousarray(pixels[..., :3])).save(path, optimize=True)
    print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
