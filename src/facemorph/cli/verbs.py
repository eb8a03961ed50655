"""What each verb does: read, call the library once, print."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

from facemorph.errors import DisplayError, OptionError

DEFAULT_FACE = "ada"


def view(options: argparse.Namespace) -> int:
    """Open the window; where there is no display, write pictures if a folder for them is named."""
    from facemorph.cli.values import weights_from
    from facemorph.ui import run

    weights = weights_from(options.weights)
    try:
        return run(_source(options), weights)
    except DisplayError as error:
        if options.without_display is None:
            raise
        return _pictures_instead(str(error), options)


def _pictures_instead(why: str, options: argparse.Namespace) -> int:
    from facemorph import api

    print(f"{why} Drawing pictures into {options.without_display}/ instead.", file=sys.stderr)
    for path in api.save_expressions(api.load(_source(options)), options.without_display):
        print(path)
    return 0


def _source(options: argparse.Namespace) -> str | list[str]:
    """What to open: the default face, one name or folder, or several files."""
    named: list[str] = options.face
    return named if len(named) > 1 else next(iter(named), DEFAULT_FACE)


def faces(options: argparse.Namespace) -> int:
    """A line for each built-in face, its name first."""
    from facemorph.io import read_face_info
    from facemorph.resources import builtin_faces

    for name, folder in builtin_faces().items():
        info = read_face_info(folder)
        print(f"{name:<6}{info.name}: {info.description} ({info.licence})")
    return 0


def info(options: argparse.Namespace) -> int:
    """Counts, parts and shapes of a face or a single mesh file."""
    from facemorph import api

    facts = api.facts(api.load(options.face))
    if options.json:
        print(json.dumps(facts, ensure_ascii=False, indent=2))
        return 0
    for key, value in facts.items():
        if value not in ("", []):
            print(f"{key.replace('_', ' '):<12}{_in_words(value)}")
    return 0


def _in_words(value: object) -> str:
    if isinstance(value, list) and all(isinstance(item, float) for item in value):
        return " x ".join(f"{item:.6g}" for item in value)
    if isinstance(value, list):
        return f"{len(value)}: {', '.join(str(item) for item in value)}"
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def check(options: argparse.Namespace) -> int:
    """Whether a folder's shapes correspond and are sound; 1 where they are not."""
    from facemorph.io import check_folder, repair_folder

    report = check_folder(options.folder)
    if options.json:
        print(json.dumps(report.as_dict(), ensure_ascii=False, indent=2))
    else:
        print("\n".join(report.lines()))
    if options.repair is not None:
        print("\n".join(repair_folder(options.folder, options.repair).lines()), file=sys.stderr)
    return 0 if report.ok else 1


def render(options: argparse.Namespace) -> int:
    """Draw a picture or a sheet and write it."""
    from facemorph import api
    from facemorph.cli.scenes import rig_and_scene
    from facemorph.cli.values import checked_suffix, look_from
    from facemorph.core.camera import direction_angles
    from facemorph.core.picture import picture_size
    from facemorph.gl import Offscreen, sheet

    output = checked_suffix(options.output, ".png")
    look = look_from(options)
    direction_angles(options.camera)
    size = picture_size(options.size) if options.size else None
    rig, scene = rig_and_scene(options)
    if options.sheet and (scene.offsets is not None or scene.pose.names()):
        raise OptionError("--sheet shows every expression at full strength; leave out the options of a pose.")
    with Offscreen() as screen:
        if options.sheet:
            pixels = sheet(screen, rig, tile=size or (320, 320), camera=options.camera, look=look)
        else:
            pixels = screen.render(rig, scene, size=size or (1280, 800), camera=options.camera, look=look)
        for problem in screen.problems:
            print(problem, file=sys.stderr)
    api.save_picture(output, pixels)
    return _wrote(output)


def export(options: argparse.Namespace) -> int:
    """Write the posed face as an OBJ."""
    from facemorph import api
    from facemorph.cli.scenes import rig_and_scene
    from facemorph.cli.values import checked_suffix

    output = checked_suffix(options.output, ".obj")
    rig, scene = rig_and_scene(options)
    api.export(rig, scene, output)
    return _wrote(output)


def rbf(options: argparse.Namespace) -> int:
    """Rebuild an expression from control points and tell the error."""
    from facemorph import api
    from facemorph.cli.values import checked_suffix
    from facemorph.core.pose import parsed_number
    from facemorph.deform.rbf import checked_kernel

    asked = None if options.kernel is None else checked_kernel(options.kernel)
    c = None if options.c is None else parsed_number(options.c, "--c")
    output = checked_suffix(options.output, ".obj") if options.output else None
    rig = api.load(options.face)
    points = api.control_points(rig, options.source, options.target, options.points, asked or "r", c)
    kernel, c = asked or points.kernel, points.c if c is None and asked is None else c
    if c is not None and kernel != "multiquadric":
        raise OptionError(f"--c belongs to the kernel multiquadric, not to {kernel}.")
    vertices = np.array(points.vertices(), np.int32)
    result = api.rebuild(rig, options.source, options.target, vertices, kernel, c)
    facts = {
        "face": rig.info.name,
        "from": options.source,
        "to": options.target,
        "points": len(vertices),
        "kernel": kernel,
        "rms_percent": result.rms_percent,
        "max_percent": result.max_percent,
        "bind_ms": result.bind_secs * 1e3,
        "drag_ms": result.drag_secs * 1e3,
    }
    if output is not None:
        api.export_positions(rig, result.positions, output)
        facts["output"] = str(output)
    print(json.dumps(facts, ensure_ascii=False) if options.json else _rbf_words(facts))
    return 0


def _rbf_words(facts: dict[str, object]) -> str:
    lines = [
        "{face}, {from} to {to}, {points} points, kernel {kernel}",
        "rms error {rms_percent:.4f} % of the diagonal, largest {max_percent:.4f} %",
        "forming the matrix {bind_ms:.1f} ms, a drag {drag_ms:.2f} ms",
    ]
    if "output" in facts:
        lines.append("{output}")
    return "\n".join(lines).format(**facts)


def _wrote(path: Path) -> int:
    print(path)
    return 0


def doctor(options: argparse.Namespace) -> int:
    """What works on this machine; 1 where nothing can draw."""
    from facemorph.cli.doctor import examination, in_lines

    facts = examination()
    print(json.dumps(facts, indent=2) if options.json else "\n".join(in_lines(facts)))
    return 0 if facts["can_draw"] else 1
