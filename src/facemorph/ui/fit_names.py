"""What an example's name says of it: `happy.obj` and `AU1+AU4 02.obj` tell which shapes they are."""

from __future__ import annotations

import re
from collections.abc import Iterable

from facemorph.core.rig import Shape

_BETWEEN = re.compile(r"[\s_+&,.()-]+")


def shapes_named(name: str, shapes: Iterable[Shape]) -> tuple[str, ...]:
    """Names of the shapes that an example is called by; none where any word of its name is no shape's.

    A shape is meant by its name or its label, in either case; numbers alone count for nothing.
    """
    known: dict[str, str] = {}
    for shape in shapes:
        for words in (shape.label, shape.name):
            known[_folded(words)] = shape.name
    whole = known.get(_folded(re.sub(r"[\s_.(-]*\d*\)?$", "", name))) or known.get(_folded(name))
    if whole is not None:
        return (whole,)
    parts = [part for part in _BETWEEN.split(name) if part and not part.isdigit()]
    found = [known.get(_folded(part)) for part in parts]
    named = tuple(dict.fromkeys(shape for shape in found if shape is not None))
    return named if parts and None not in found else ()


def _folded(words: str) -> str:
    return _BETWEEN.sub("", words).casefold()
