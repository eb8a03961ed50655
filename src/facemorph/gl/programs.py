"""GLSL programs from the files in `shaders/`: `#include`, definitions, and errors that name file and line.

GLSL 3.3 cannot loop over textures. What a shader does for each of a number of them stands between
`#repeat NAME` and `#end`, once: it is written out as often as the definition `NAME COUNT` says (not at all
without one), with the number, from 0 on, in place of each `@`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING

from facemorph.errors import GraphicsError
from facemorph.resources import data_folder

if TYPE_CHECKING:
    import moderngl

_REPEAT = re.compile(r"\s*#repeat\s+(\w+)\s*$")
_INCLUDE = re.compile(r'\s*#include\s+"([^"]+)"\s*$')
# Mesa and Intel say 0:12(5), NVIDIA 0(12), Apple and AMD "ERROR: 0:12".
_PLACE = re.compile(r"\b0[:(](\d+)\)?[^\n]*")
_STAGE = re.compile(r"^(vertex_shader|geometry_shader|fragment_shader)\s*$", re.MULTILINE)


@dataclass(frozen=True)
class Source:
    """A shader's text with every include in place, and for each of its lines the file and line it is from."""

    text: str
    origin: tuple[tuple[str, int], ...]

    def place(self, line: int) -> str:
        """`file:line` of the text's 1-based `line`."""
        if not 1 <= line <= len(self.origin):
            return f"line {line}"
        name, number = self.origin[line - 1]
        return f"{name}:{number}"


class Programs:
    """The programs of one context, each compiled when it is first asked for."""

    def __init__(self, ctx: moderngl.Context, folder: Path | None = None) -> None:
        self._ctx = ctx
        self._folder = folder or data_folder("shaders")
        self._made: dict[tuple[object, ...], moderngl.Program] = {}

    def get(
        self,
        vertex: str,
        fragment: str | None = None,
        geometry: str | None = None,
        *,
        define: Sequence[str] = (),
        capture: Sequence[str] = (),
    ) -> moderngl.Program:
        """The program of these files; `define` switches parts on, `capture` names what is fed back.

        Raises `GraphicsError` that names file and line.
        """
        key = (vertex, fragment, geometry, tuple(define), tuple(capture))
        if key not in self._made:
            names = {"vertex_shader": vertex, "geometry_shader": geometry, "fragment_shader": fragment}
            sources = {
                stage: read_source(self._folder, name, define) for stage, name in names.items() if name
            }
            self._made[key] = self._compiled(sources, capture)
        return self._made[key]

    def _compiled(self, sources: Mapping[str, Source], capture: Sequence[str]) -> moderngl.Program:
        import moderngl

        texts = {stage: source.text for stage, source in sources.items()}
        try:
            return self._ctx.program(**texts, varyings=tuple(capture))  # type: ignore[arg-type]
        except moderngl.Error as error:
            raise GraphicsError(_explained(str(error), sources)) from error

    def release(self) -> None:
        """Give every program back to the context."""
        for program in self._made.values():
            program.release()
        self._made.clear()


def read_source(folder: Path, name: str, define: Sequence[str] = ()) -> Source:
    """The shader `name` of `folder`, `#include "..."` resolved from the folder's top, each file once.

    `define` adds `#define NAME`, or `#define NAME COUNT`, after the version line. Raises `GraphicsError`
    on a missing file.
    """
    lines: list[str] = []
    origin: list[tuple[str, int]] = []
    seen: set[str] = set()

    def take(wanted: str, asked_by: str) -> None:
        if wanted in seen:
            return
        seen.add(wanted)
        for number, line in _repeated(_lines_of(folder, wanted, asked_by), define):
            included = _INCLUDE.match(line) if "#include" in line else None
            if included:
                take(included[1], f"{wanted}:{number}")
                continue
            lines.append(line)
            origin.append((wanted, number))
            if line.startswith("#version"):
                for switch in define:
                    lines.append(f"#define {switch}")
                    origin.append((wanted, number))

    take(name, "")
    return Source("\n".join(lines) + "\n", tuple(origin))


def _repeated(lines: Sequence[str], define: Sequence[str]) -> Iterator[tuple[int, str]]:
    """The lines with their numbers from 1 on, what is to be repeated written out."""
    counts = dict(switch.split() for switch in define if " " in switch)
    numbered = iter(enumerate(lines, start=1))
    for number, line in numbered:
        block = _REPEAT.match(line) if "#repeat" in line else None
        if not block:
            yield number, line
            continue
        inside = list(takewhile(lambda item: item[1].strip() != "#end", numbered))
        for i in range(int(counts.get(block[1], "0"))):
            yield from ((n, text.replace("@", str(i))) for n, text in inside)


def _lines_of(folder: Path, name: str, asked_by: str) -> list[str]:
    path = (folder / name).resolve()
    inside = path.is_relative_to(folder.resolve())
    try:
        if inside:
            return path.read_text(encoding="utf-8").splitlines()
    except OSError:
        pass
    where = f"{asked_by} includes" if asked_by else "the program needs"
    raise GraphicsError(f"{where} the shader {name!r}, which is not in {folder}. Reinstall facemorph.")


def _explained(log: str, sources: Mapping[str, Source]) -> str:
    """The driver's first complaint with our file and line in place of its own."""
    stage = _STAGE.search(log)
    place = _PLACE.search(log)
    if stage and place and stage[1] in sources:
        return f"{sources[stage[1]].place(int(place[1]))}: the shader does not compile: {place[0].strip()}"
    files = ", ".join(dict.fromkeys(source.origin[0][0] for source in sources.values() if source.origin))
    told = " ".join(log.split())
    return f"{files}: the shaders do not link: {told}"
