"""fit, transfer, register: a person's blendshapes from files, and how well it went."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facemorph.cli.fit_words import fit_facts, fit_lines, peak_memory_mb, quality_facts, rounded, wrap_lines
from facemorph.errors import OptionError

if TYPE_CHECKING:
    from facemorph.core.progress import Progress
    from facemorph.core.rig import Rig
    from facemorph.fit.report import FitReport
    from facemorph.fitting import ExampleFile

_CLEARED = "\r\x1b[K"


class ExampleOption(argparse.Action):
    """--example begins an example; --weights and --landmarks after it belong to it."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        option_string: str | None = None,
    ) -> None:
        """Add to the example that is being described."""
        examples: list[dict[str, Any]] = namespace.examples
        if option_string == "--example":
            namespace.examples = [*examples, {"path": Path(str(values))}]
        elif examples and self.dest not in examples[-1]:
            namespace.examples = [*examples[:-1], {**examples[-1], self.dest: values}]
        elif not examples and self.dest == "landmarks" and namespace.landmarks is None:
            namespace.landmarks = Path(str(values))
        else:
            raise OptionError(
                f"{option_string} belongs to the --example before it, once each"
                + (", or once to the neutral before all examples." if self.dest == "landmarks" else ".")
            )


def fit(options: argparse.Namespace) -> int:
    """A person's rig from a template, a neutral and examples; and a report, where one is asked for."""
    from facemorph.fitting import ExampleFile

    examples = [_example(told) for told in options.examples]
    held_out = [ExampleFile(path) for path in options.held_out]
    if held_out and options.report is None:
        raise OptionError("--held-out says what --report measures the fit on; name a folder for that too.")
    if options.report is not None and not examples:
        raise OptionError("--report compares how examples are met; give at least one with --example.")
    shapes = None if options.shapes is None else _words("--shapes", options.shapes)
    return _made(options, examples, held_out, shapes=shapes, iterations=_iterations(options.iterations))


def transfer(options: argparse.Namespace) -> int:
    """A person's rig from a template and a neutral alone."""
    return _made(options, [], [])


def register(options: argparse.Namespace) -> int:
    """The template's topology on a scan."""
    from facemorph import api
    from facemorph.cli.values import checked_suffix
    from facemorph.fitting import register_file
    from facemorph.io import write_obj
    from facemorph.io.atomic import check_place

    output = checked_suffix(options.output, ".obj")
    _refuse_inputs(output, options.scan, Path(options.template))
    check_place(output.resolve().parent, output)
    template = api.load(options.template)
    with told_progress() as progress:
        found = register_file(template, options.scan, options.landmarks, progress=progress)
        write_obj(output, found.mesh)
    facts = {
        "vertices": found.mesh.vertex_count,
        **quality_facts(found.quality),
        "seconds": rounded(found.seconds),
        "peak_memory_mb": peak_memory_mb(),
        "output": str(output),
    }
    print(json.dumps(facts, ensure_ascii=False, indent=2) if options.json else "\n".join(wrap_lines(facts)))
    return 0


def _refuse_inputs(output: Path, scan: Path, template: Path) -> None:
    """The result must not take the place of what it is made of, nor become a part of it."""
    if output.is_dir():
        raise OptionError(f"{output} is a folder; the name of an OBJ to write is wanted.")
    for given, called in ((scan, "the scan"), (template, "the template")):
        if output.exists() and given.exists() and output.samefile(given):
            raise OptionError(f"{output} is {called} itself; name another file to write.")
    if template.is_dir() and template.resolve() in output.resolve().parents:
        raise OptionError(f"{output} lies in the template's folder, and would be taken for a shape of it.")


def _made(
    options: argparse.Namespace,
    examples: Sequence[ExampleFile],
    held_out: Sequence[ExampleFile],
    *,
    shapes: Sequence[str] | None = None,
    iterations: int = 10,
) -> int:
    """Read, fit, write and tell."""
    from facemorph.core.progress import part_of
    from facemorph.fitting import fit_person, read_person, report_on
    from facemorph.io import write_face

    report_folder: Path | None = getattr(options, "report", None)
    _refuse_taken(options.output, report_folder)
    clock = _Clock()
    template = _template(options.template)
    seconds = {"template": clock.lap()}
    with told_progress() as progress:
        person = read_person(
            template,
            options.neutral,
            examples,
            held_out,
            landmarks=options.landmarks,
            shapes=shapes,
            progress=part_of(progress, 0.0, 0.4),
        )
        result = fit_person(template, person, iterations=iterations, progress=part_of(progress, 0.4, 0.6))
        seconds |= {**person.seconds, **result.seconds}
        clock.lap()
        if report_folder is not None:
            report = report_on(template, person, iterations=iterations, progress=part_of(progress, 0.6, 0.95))
            seconds["report"] = clock.lap()
        result = replace(result, rig=_named(result.rig, options.output))
        write_face(result.rig, options.output, progress=part_of(progress, 0.95, 1.0))
        seconds["write"] = clock.lap()
        if report_folder is not None:
            _save_report(report_folder, report)
    facts = fit_facts(result, person.wrapped, seconds | {"total": clock.total()})
    _tell(options, facts | {"output": _as_source(options.output)}, report_folder)
    return 0


def _as_source(folder: Path) -> str:
    """The folder as a face to open: one called as a built-in face needs its place told."""
    from facemorph.resources import builtin_faces

    return os.path.join(os.curdir, folder) if str(folder) in builtin_faces() else str(folder)  # noqa: PTH118


def _tell(options: argparse.Namespace, facts: Mapping[str, Any], report: Path | None) -> None:
    if options.json:
        print(
            json.dumps({**facts, **({"report": str(report)} if report else {})}, ensure_ascii=False, indent=2)
        )
    else:
        print("\n".join([*fit_lines(facts), *([str(report)] if report else [])]))


def _example(told: Mapping[str, Any]) -> ExampleFile:
    from facemorph.cli.values import weights_from
    from facemorph.fitting import ExampleFile

    weights, pairs = told.get("weights"), told.get("landmarks")
    return ExampleFile(
        told["path"],
        None if weights is None else weights_from(_words("--weights", weights), "--weights"),
        None if pairs is None else Path(pairs),
    )


def _save_report(folder: Path, report: FitReport) -> None:
    from facemorph.fit.report_plots import PLOTS, save_plot
    from facemorph.io.atomic import new_folder

    with new_folder(folder) as stage:
        text = json.dumps(report.as_dict(), ensure_ascii=False, indent=2)
        (stage / "report.json").write_text(text + "\n", encoding="utf-8")
        for name, plot in PLOTS.items():
            save_plot(plot(report), stage / f"{name}.png")


def _template(source: str) -> Rig:
    from facemorph import api
    from facemorph.io import check_writable

    template = api.load(source)
    if not template.controls:
        raise OptionError(f"the template {source} has no shapes; a face folder is wanted.")
    check_writable(template)
    return template


def _refuse_taken(output: Path, report: Path | None) -> None:
    """Told before the work, not after it."""
    from facemorph.io.atomic import check_new

    check_new(output)
    if report is not None:
        check_new(report)
        if report.resolve() in (output.resolve(), *output.resolve().parents):
            raise OptionError(f"the face goes into {output}; --report needs a folder of its own.")


def _named(rig: Rig, folder: Path) -> Rig:
    """The rig called as its folder."""
    return replace(rig, info=replace(rig.info, name=folder.resolve().name or "face"))


def _words(option: str, text: str) -> list[str]:
    words = [word.strip() for word in text.split(",") if word.strip()]
    if not words:
        raise OptionError(f"{option} takes names with commas between them; there are none.")
    return words


def _iterations(text: str) -> int:
    if not text.isdecimal() or len(text) > 4 or not 1 <= int(text) <= 1000:
        raise OptionError(f"--iterations takes a whole number from 1 to 1000, not {text!r}.")
    return int(text)


@contextlib.contextmanager
def told_progress() -> Iterator[Progress]:
    """Progress on the terminal's last line, cleared in the end; silent where errors go into a file."""
    from facemorph.core.progress import silent

    if not sys.stderr.isatty():
        yield silent
        return
    try:
        yield _on_terminal
    finally:
        print(_CLEARED, end="", file=sys.stderr, flush=True)


def _on_terminal(fraction: float, doing: str) -> None:
    from facemorph.io.limits import shortened

    room = max(shutil.get_terminal_size().columns - 8, 20)
    print(f"{_CLEARED}{fraction:4.0%} {shortened(doing, room)}", end="", file=sys.stderr, flush=True)


class _Clock:
    """Seconds since it was made, and since the lap before."""

    def __init__(self) -> None:
        self._begun = self._last = time.perf_counter()

    def lap(self) -> float:
        before, self._last = self._last, time.perf_counter()
        return self._last - before

    def total(self) -> float:
        return time.perf_counter() - self._begun
