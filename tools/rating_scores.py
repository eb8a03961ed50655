"""How a rating study came out: answers against the key, as a confusion table and shares right."""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from facemorph.core.pose import NEUTRAL
from facemorph.errors import OptionError

KEY_COLUMNS = ("number", "page", "face", "emotion", "intensity", "view")
NONE = "-"
# What people write for a built-in face's expressions.
_WORDS = {
    "neutral": ("neutral", "none", "calm"),
    "happy": ("happy", "happiness", "joy", "smile"),
    "sad": ("sad", "sadness"),
    "angry": ("angry", "anger"),
    "surprised": ("surprised", "surprise"),
    "disgusted": ("disgusted", "disgust"),
    "afraid": ("afraid", "fear", "scared", "fearful"),
}


@dataclass(frozen=True)
class Tile:
    """What a numbered picture shows: `number` from 1 on, its page, and the truth about it."""

    number: int
    page: int
    face: str
    emotion: str
    intensity: float
    view: str


@dataclass(frozen=True)
class Rated:
    """A tile and what somebody called it; `NONE` where they gave no answer."""

    tile: Tile
    answer: str

    @property
    def right(self) -> bool:
        """Whether the emotion was named."""
        return self.answer == self.tile.emotion


def read_key(path: Path) -> list[Tile]:
    """The tiles of a key.csv. Raises `OptionError` for a file that is none."""
    rows = _rows(path)
    if not rows or tuple(rows[0]) != KEY_COLUMNS:
        raise OptionError(f"{path}: a key begins with the line {','.join(KEY_COLUMNS)}; this one does not.")
    try:
        tiles = [
            Tile(int(n), int(page), face, emotion, float(i), view)
            for n, page, face, emotion, i, view in rows[1:]
        ]
    except ValueError:
        raise OptionError(f"{path}: a line of the key is broken; make the sheets again.") from None
    if len({tile.number for tile in tiles}) != len(tiles):
        raise OptionError(f"{path}: a number stands twice in the key; make the sheets again.")
    return tiles


def read_answers(path: Path, tiles: Sequence[Tile]) -> dict[int, str]:
    """Label by number of one rater's file: lines number,label; a heading and empty labels are passed over.

    Raises `OptionError` for a number or a label that the key does not know, and for a number given twice.
    """
    known = {tile.number for tile in tiles}
    # Raters may be told that a face can be neutral though none is shown.
    labels = _labels([*(tile.emotion for tile in tiles), NEUTRAL])
    answers: dict[int, str] = {}
    for line, row in enumerate(_rows(path), start=1):
        cells = [cell.strip() for cell in row]
        if not any(cells) or (line == 1 and not cells[0].isdecimal()):
            continue
        if len(cells) < 2 or not cells[0].isdecimal() or int(cells[0]) not in known:
            raise OptionError(
                f"{path}:{line}: an answer is number,label with a number of the key; not {','.join(row)!r}."
            )
        if not cells[1]:
            continue
        number, label = int(cells[0]), labels.get(cells[1].casefold())
        if label is None:
            raise OptionError(
                f"{path}:{line}: no emotion is {cells[1]!r}: {', '.join(sorted(set(labels.values())))}."
            )
        if number in answers:
            raise OptionError(f"{path}:{line}: {number} was answered before.")
        answers[number] = label
    return answers


def rated(tiles: Sequence[Tile], answers: dict[int, str]) -> list[Rated]:
    """Every tile with its answer, or `NONE`."""
    return [Rated(tile, answers.get(tile.number, NONE)) for tile in tiles]


def interval(right: int, of: int) -> tuple[float, float]:
    """Wilson's 95 % interval of a share (Wilson 1927, eq. 4)."""
    z = 1.959964
    middle = (right + z * z / 2.0) / (of + z * z)
    half = z * math.sqrt(right * (of - right) / of + z * z / 4.0) / (of + z * z)
    return max(middle - half, 0.0), min(middle + half, 1.0)


def report(ratings: Sequence[Rated]) -> list[str]:
    """The lines to print: shares right by intensity, view and face, and the confusion table."""
    emotions = list(dict.fromkeys(rating.tile.emotion for rating in ratings))
    lines = [f"{'':16}{'right':>12}{'share':>9}   95 % interval"]
    lines.append(_share("all", ratings))
    for title, of in _GROUPS:
        for value in sorted({of(r.tile) for r in ratings}, key=str, reverse=title == "intensity"):
            lines.append(_share(f"{title} {value}", [r for r in ratings if of(r.tile) == value]))
    lines.append(f"Guessing among {len(emotions)} labels would be right in {1.0 / len(emotions):.0%}.")
    return [*lines, "", *_confusion(ratings, emotions)]


_GROUPS: tuple[tuple[str, Callable[[Tile], str]], ...] = (
    ("intensity", lambda tile: f"{tile.intensity:g}"),
    ("view", lambda tile: tile.view),
    ("face", lambda tile: tile.face),
)


def _share(title: str, ratings: Sequence[Rated]) -> str:
    right, of = sum(rating.right for rating in ratings), len(ratings)
    low, high = interval(right, of)
    return f"{title:<20}{f'{right}/{of}':>8}{right / of:>9.0%}   {low:.0%} to {high:.0%}"


def _confusion(ratings: Sequence[Rated], emotions: Sequence[str]) -> list[str]:
    count = Counter((rating.tile.emotion, rating.answer) for rating in ratings)
    answers = {rating.answer for rating in ratings}
    columns = [*emotions, *(extra for extra in (NEUTRAL, NONE) if extra in answers - set(emotions))]
    width = max(len(name) for name in (*columns, "shown / named")) + 2
    head = "shown / named".ljust(width) + "".join(name.rjust(width) for name in columns)
    rows = [
        shown.ljust(width) + "".join(str(count[shown, named]).rjust(width) for named in columns)
        for shown in emotions
    ]
    return [head, *rows]


def _labels(emotions: Iterable[str]) -> dict[str, str]:
    return {word: emotion for emotion in emotions for word in (emotion.casefold(), *_WORDS.get(emotion, ()))}


def _rows(path: Path) -> list[list[str]]:
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            return [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise OptionError(f"{path}: cannot be read ({error}).") from error
