"""Pictures for a rating study, and its scores: do people name the emotions that the faces show?

    python tools/rating_sheet.py make --out study --seed 1
    python tools/rating_sheet.py score study/key.csv answers.csv [more answers ...]

`make` writes unlabelled, numbered pages in random order, an empty answer sheet and the key. docs/rating.md
says how to run a study with them, and what it can show.
"""

from __future__ import annotations

import argparse
import csv
import io
import itertools
import json
import math
import random
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

import facemorph
from facemorph.core.arrays import UInt8
from facemorph.core.camera import direction_angles
from facemorph.core.picture import LIGHT_RIGS, LUMINANCE, Look, checked_light, checked_luminance
from facemorph.core.pose import NEUTRAL, Pose
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError, OptionError, OutputError
from facemorph.gl.labels import as_image, font
from facemorph.io.atomic import replacing
from rating_framing import face_camera, face_points
from rating_scores import KEY_COLUMNS, Tile, rated, read_answers, read_key, report

FACES = ("ada", "ben", "mei", "kofi", "zola", "omar")
EMOTIONS = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
INTENSITIES = ("1", "0.5", "0.25")
VIEWS = ("front", "three-quarter")
MOST_TILES = 3000
TILE = (400, 440)
STRIP = 34
PAPER, INK = 255, 0


def tiles_of(
    faces: Sequence[str],
    emotions: Sequence[str],
    intensities: Sequence[float],
    views: Sequence[str],
    per_page: int,
    seed: int,
) -> list[Tile]:
    """Every combination once, neutral at intensity 0 once a face and view; shuffled by `seed`, numbered."""
    shown = [
        (face, emotion, intensity, view)
        for face, emotion, view in itertools.product(faces, emotions, views)
        for intensity in ((0.0,) if emotion == NEUTRAL else intensities)
    ]
    if not 1 <= len(shown) <= MOST_TILES:
        raise OptionError(f"a study has 1 to {MOST_TILES} pictures; these choices make {len(shown)}.")
    random.Random(seed).shuffle(shown)
    return [Tile(number, 1 + (number - 1) // per_page, *what) for number, what in enumerate(shown, start=1)]


def pictures(
    tiles: Sequence[Tile], rigs: dict[str, Rig], emotions: Sequence[str], look: Look
) -> Iterator[tuple[Tile, UInt8]]:
    """Each tile with its picture, face by face: loading one costs more than drawing it.

    A face has one camera a view, so that its size tells nothing.
    """
    with facemorph.Offscreen() as screen:
        for (face, view), group in itertools.groupby(sorted(tiles, key=_face_and_view), key=_face_and_view):
            rig = rigs[face]
            camera = face_camera(rig, face_points(rig, emotions), view, TILE[0] / TILE[1])
            for tile in group:
                pose = Pose.between(NEUTRAL, tile.emotion, tile.intensity or 1.0)
                yield tile, screen.render(rig, pose, size=TILE, camera=camera, look=look)


def _face_and_view(tile: Tile) -> tuple[str, str]:
    return tile.face, tile.view


def pages(tiles: Sequence[Tile], drawn: Iterator[tuple[Tile, UInt8]], per_page: int) -> list[UInt8]:
    """The pages (H, W, 4), pictures in rows with their numbers below."""
    columns = math.ceil(math.sqrt(per_page * 1.25))
    width, height = TILE[0], TILE[1] + STRIP
    first = {tile.page: tile.number for tile in reversed(tiles)}
    on_page = {page: sum(tile.page == page for tile in tiles) for page in first}
    made = {
        page: np.full((math.ceil(count / columns) * height, columns * width, 4), PAPER, np.uint8)
        for page, count in on_page.items()
    }
    for tile, pixels in drawn:
        row, column = divmod(tile.number - first[tile.page], columns)
        made[tile.page][row * height :][: TILE[1], column * width :][:, :width] = pixels
    return [_numbered(made[page], first[page], on_page[page], columns) for page in sorted(made)]


def _numbered(pixels: UInt8, first: int, count: int, columns: int) -> UInt8:
    from PIL import ImageDraw

    picture = as_image(pixels)
    pen, letters = ImageDraw.Draw(picture), font(20.0)
    for place in range(count):
        row, column = divmod(place, columns)
        at = ((column + 0.5) * TILE[0], row * (TILE[1] + STRIP) + TILE[1] + STRIP / 2)
        pen.text(at, str(first + place), font=letters, fill=(INK, INK, INK, 255), anchor="mm")
    return np.asarray(picture, np.uint8)


def make(options: argparse.Namespace) -> int:
    """Write the study's pages, answer sheet and key into a new folder."""
    faces, emotions, views = (_words(text) for text in (options.faces, options.emotions, options.views))
    intensities = [_intensity(word) for word in _words(options.intensities)]
    for view in views:
        direction_angles(view)
    if not 1 <= options.per_page <= 60:
        raise OptionError(f"a page holds 1 to 60 pictures, not {options.per_page}.")
    luminance = None if options.equal_luminance is None else checked_luminance(options.equal_luminance)
    look = Look(light=checked_light(options.light), luminance=luminance, luminance_of="picture")
    tiles = tiles_of(faces, emotions, intensities, views, options.per_page, options.seed)
    out: Path = options.out
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise OutputError(f"{out} is there already; name a new folder, so that no study is written over.")
    rigs = {face: facemorph.load(face) for face in faces}
    for face, emotion in itertools.product(faces, set(emotions) - {NEUTRAL}):
        rigs[face].shape(emotion)
    out.mkdir(parents=True, exist_ok=True)
    for number, page in enumerate(
        pages(tiles, pictures(tiles, rigs, emotions, look), options.per_page), start=1
    ):
        _tell(facemorph.save_picture(out / f"page-{number:02}.png", page))
    _tell(_write(out / "answers.csv", _table([("number", "label"), *((tile.number, "") for tile in tiles)])))
    key = [(t.number, t.page, t.face, t.emotion, f"{t.intensity:g}", t.view) for t in tiles]
    _tell(_write(out / "key.csv", _table([KEY_COLUMNS, *key])))
    asked = {name: value for name, value in vars(options).items() if name not in ("run", "out")}
    study = {"facemorph": facemorph.__version__, "pictures": len(tiles), "labels": emotions, **asked}
    _tell(_write(out / "study.json", json.dumps(study, indent=1) + "\n"))
    print(f"{len(tiles)} pictures on {tiles[-1].page} pages. Keep key.csv from who answers.")
    return 0


def score(options: argparse.Namespace) -> int:
    """Print how the answers of one or several raters compare with the key."""
    tiles = read_key(options.key)
    ratings = [each for path in options.answers for each in rated(tiles, read_answers(path, tiles))]
    print(f"{len(options.answers)} rater(s), {len(tiles)} pictures")
    print("\n".join(report(ratings)))
    return 0


def _words(text: str) -> list[str]:
    words = list(dict.fromkeys(word.strip() for word in text.split(",") if word.strip()))
    if not words:
        raise OptionError("a list of names with commas between them is wanted; this one is empty.")
    return words


def _intensity(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not 0.0 < value <= 1.0:
        raise OptionError(f"an intensity is a number above 0, to 1; not {word!r}.")
    return value


def _table(rows: Sequence[Sequence[object]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def _write(path: Path, text: str) -> Path:
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def _tell(path: Path) -> None:
    print(path)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description="Make a rating study of the faces, or score one.")
    verbs = parser.add_subparsers(required=True, metavar="make|score")
    one = verbs.add_parser("make", help="write pages of unlabelled pictures, an answer sheet and the key")
    one.set_defaults(run=make)
    one.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="a new folder")
    one.add_argument("--seed", type=int, default=1, help="of the random order (default: 1)")
    one.add_argument("--faces", default=",".join(FACES), help="built-in faces or folders (default: all six)")
    one.add_argument(
        "--emotions", default=",".join(EMOTIONS), help="expressions, neutral too (default: the six)"
    )
    one.add_argument("--intensities", default=",".join(INTENSITIES), help="(default: 1,0.5,0.25)")
    one.add_argument("--views", default=",".join(VIEWS), help="(default: front,three-quarter)")
    one.add_argument("--light", default="flat", help=f"{', '.join(LIGHT_RIGS)} (default: flat)")
    one.add_argument(
        "--equal-luminance", nargs="?", type=float, const=LUMINANCE, metavar="Y", help="of the skin"
    )
    one.add_argument("--per-page", type=int, default=12, metavar="N", help="pictures a page (default: 12)")
    two = verbs.add_parser("score", help="print a confusion table and the share right per intensity")
    two.set_defaults(run=score)
    two.add_argument("key", type=Path, metavar="KEY", help="the study's key.csv")
    two.add_argument(
        "answers", type=Path, nargs="+", metavar="ANSWERS", help="a rater's lines of number,label"
    )
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the tool; an error a person caused is one line."""
    options = _parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except FacemorphError as error:
        print(f"rating_sheet: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    raise SystemExit(main())
