"""A recorded path over the emotion map as a small JSON file, with the poles that stood round it.

{"format": "facemorph emotion path 1",
 "poles": [{"name": "happy", "angle_deg": 90.0}, ...], "samples": [[0.0, 0.1, 0.25], ...]}

A sample is seconds since the start, x, y.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from facemorph.core.emotion import Pole, emotion_weights
from facemorph.core.emotion_path import MOST_SAMPLES, EmotionPath, Sample
from facemorph.errors import ControlsFileError, MeshFileError, OptionError
from facemorph.io.atomic import replacing
from facemorph.io.limits import NAME_BYTES, plain_size, read_bytes

FORMAT = "facemorph emotion path 1"
MOST_POLES = 360
_LARGEST_FILE = 4 << 20


def write_emotion_path(path: str | Path, recorded: EmotionPath, poles: Sequence[Pole]) -> None:
    """Keep a path, whole or not at all. Raises `OutputError`."""
    content = {
        "format": FORMAT,
        "poles": [{"name": pole.name, "angle_deg": pole.angle_deg} for pole in poles],
        "samples": [[round(value, 6) for value in sample] for sample in recorded.samples],
    }
    with replacing(Path(path)) as temporary:
        temporary.write_text(json.dumps(content) + "\n", encoding="utf-8")


def read_emotion_path(path: str | Path) -> tuple[EmotionPath, tuple[Pole, ...]]:
    """The path kept in a file, and its poles. Raises `ControlsFileError` where it is none."""
    path = Path(path)
    content = _content(path)
    poles, samples = content.get("poles"), content.get("samples")
    if not isinstance(poles, list) or len(poles) > MOST_POLES:
        raise ControlsFileError(f"{path}: `poles` must be a list of at most {MOST_POLES} poles.")
    if not isinstance(samples, list) or len(samples) > MOST_SAMPLES:
        raise ControlsFileError(f"{path}: `samples` must be a list of at most {MOST_SAMPLES:,} samples.")
    ring = tuple(_pole(path, place, row) for place, row in enumerate(poles, 1))
    try:
        emotion_weights(1.0, 0.0, ring)
        return EmotionPath(tuple(_sample(path, place, row) for place, row in enumerate(samples, 1))), ring
    except OptionError as error:
        raise ControlsFileError(f"{path}: {error}") from error


def _content(path: Path) -> dict[str, Any]:
    if not path.is_file():
        problem = "is no file" if path.exists() else "does not exist"
        raise ControlsFileError(f"{path} {problem}; a recorded path (.json) was expected.")
    try:
        content = json.loads(read_bytes(path, _LARGEST_FILE))
    except MeshFileError as error:
        raise ControlsFileError(
            f"{path} {error.problem}; a recorded path takes less than {plain_size(_LARGEST_FILE)}."
        ) from error
    except (ValueError, RecursionError) as error:
        raise ControlsFileError(f"{path} is no recorded path: it is not JSON.") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise ControlsFileError(f'{path} is no recorded path: it does not say "format": "{FORMAT}".')
    return content


def _pole(path: Path, place: int, row: object) -> Pole:
    name = row.get("name") if isinstance(row, dict) else None
    angle = row.get("angle_deg") if isinstance(row, dict) else None
    if not isinstance(name, str) or not 0 < len(name) <= NAME_BYTES or not _is_number(angle, 360.0):
        raise ControlsFileError(
            f"{path}: pole {place} must be an object with a `name` and an `angle_deg` from -360 to 360."
        )
    return Pole(name, float(angle))  # type: ignore[arg-type]


def _sample(path: Path, place: int, row: object) -> Sample:
    if not isinstance(row, list) or len(row) != 3 or not all(_is_number(value, 1e6) for value in row):
        raise ControlsFileError(f"{path}: sample {place} must be three numbers: seconds, x, y.")
    secs, x, y = (float(value) for value in row)
    return (secs, x, y)


def _is_number(value: object, largest: float) -> bool:
    # Bounds hold off nan, infinity, and integers too large for a float.
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= largest
