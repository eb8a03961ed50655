"""Meshes that no `face.toml` explains: which is the neutral, and what the others are called."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from facemorph.core.pose import NEUTRAL
from facemorph.errors import FaceFolderError
from facemorph.io.limits import reason
from facemorph.io.names import composed, listed, natural_key
from facemorph.io.read import is_mesh

EXPRESSION_ORDER = ("happy", "sad", "angry", "surprised", "disgusted", "afraid")
_NEUTRAL_WORD = re.compile(r"(?<![^\W_])neutral(?![^\W_])", re.IGNORECASE)
_EXPRESSION_WORD = re.compile(rf"(?<![^\W_])({'|'.join(EXPRESSION_ORDER)})(?![^\W_])", re.IGNORECASE)


def plain_meshes(folder: Path, *, none_is_well: bool = False) -> list[Path]:
    """The meshes that lie in a folder, hidden ones apart. Raises `FaceFolderError` where there is none."""
    try:
        files = sorted(
            p for p in folder.iterdir() if is_mesh(p) and not p.name.startswith(".") and p.is_file()
        )
    except OSError as error:
        raise FaceFolderError(f"{folder} cannot be read: {reason(error)}.") from error
    if not files and not none_is_well:
        raise FaceFolderError(f"{folder} holds no mesh. A face is neutral.obj and a mesh for each shape.")
    return files


def is_called_neutral(path: Path) -> bool:
    """Whether a file's name has the word neutral in it."""
    return _NEUTRAL_WORD.search(path.stem) is not None


def shapes_of(neutral: Path, files: Sequence[Path], where: str) -> dict[str, Path]:
    """The files but the neutral by name, the known expressions first, then as people count.

    Raises `FaceFolderError` where two have one name.
    """
    shapes: dict[str, Path] = {}
    folded: dict[str, Path] = {NEUTRAL: neutral}
    for path in files:
        if path.resolve() == neutral.resolve():
            continue
        name = composed(path.stem)
        if name.casefold() in folded:
            raise FaceFolderError(
                f"in {where}, {folded[name.casefold()].name} and {path.name} would both be the shape "
                f"{name!r}. Rename one, or take it away."
            )
        folded[name.casefold()] = shapes[name] = path
    return {name: shapes[name] for name in sorted(shapes, key=_place_in_order)}


def neutral_among(files: Sequence[Path], where: str, otherwise: Path | None) -> Path:
    """The neutral among `files`: the one called so, else `otherwise`, else the only one.

    Raises `FaceFolderError` where that leaves none, or several, or the only one is called as an expression.
    """
    called = [path for path in files if path.stem.casefold() == NEUTRAL]
    called = called or [path for path in files if _NEUTRAL_WORD.search(path.stem)]
    if len(called) == 1:
        return called[0]
    if called:
        names = listed([path.name for path in called])
        raise FaceFolderError(f"in {where}, {names} are all called neutral; one neutral is needed.")
    if otherwise is not None:
        return otherwise
    if len(files) == 1:
        return _only(files[0], where)
    names = listed([path.name for path in files])
    raise FaceFolderError(
        f"{where} has {len(files)} meshes ({names}), but none is called neutral. Rename the neutral face to "
        f"neutral{files[0].suffix.lower()}, or name the files with it first."
    )


def _only(path: Path, where: str) -> Path:
    word = _EXPRESSION_WORD.search(path.stem)
    if word is not None:
        raise FaceFolderError(
            f"the only mesh in {where} is {path.name}, called as an expression; a neutral is needed. "
            f"Add neutral{path.suffix.lower()}, rename this one to it, or name the file itself to see it."
        )
    return path


def _place_in_order(name: str) -> tuple[int, tuple[tuple[int, int, str], ...]]:
    folded = name.casefold()
    known = EXPRESSION_ORDER.index(folded) if folded in EXPRESSION_ORDER else len(EXPRESSION_ORDER)
    return known, natural_key(name)
