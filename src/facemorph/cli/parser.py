"""The verbs, their options, and the words that `--help` shows for them."""

from __future__ import annotations

import argparse
import difflib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

from facemorph import __version__
from facemorph.cli import fit_parser, verbs
from facemorph.core.camera import DIRECTIONS
from facemorph.core.morph import CURVES
from facemorph.core.picture import LIGHT_RIGS, LUMINANCE, SHADINGS
from facemorph.deform.rbf import KERNELS
from facemorph.errors import OptionError
from facemorph.resources import builtin_faces

FACE_HELP = "a built-in face (ada), a folder, or mesh files of which the first is the neutral"
SIGNED_OPTIONS = ("--emotion", "--camera", "--t", "--s", "--c")
VERBS = ("view", "faces", "info", "check", "render", "export", "rbf", "fit", "transfer", "register", "doctor")


class Parser(argparse.ArgumentParser):
    """An argument parser whose complaints are one line, like every other error here."""

    def error(self, message: str) -> NoReturn:
        """Raise `OptionError` in place of printing the usage and leaving."""
        raise OptionError(f"{message} (`{self.prog} --help` lists what there is).")


def parsed(arguments: Sequence[str]) -> argparse.Namespace:
    """The options, with `verb` the function to call. Without a verb, the window opens."""
    general = {"-h", "--help", "--version"}
    if not arguments or arguments[0] not in {*VERBS, *general}:
        _refuse_misspelt(arguments[0] if arguments else "")
        arguments = ["view", *arguments]
    return _parser().parse_args(_with_signed_values(arguments))


def _refuse_misspelt(word: str) -> None:
    """A word that is no face but nearly a verb was meant as one. Raises `OptionError`."""
    close = difflib.get_close_matches(word, VERBS, n=1, cutoff=0.7)
    if close and word not in builtin_faces() and not Path(word).exists():
        raise OptionError(f"no verb or face is called {word!r}. Did you mean {close[0]!r}?")


def _with_signed_values(arguments: Sequence[str]) -> list[str]:
    """`--emotion -0.3,0.4` as one word: argparse takes `-0.3,0.4` and `-1e-3` for options."""
    joined: list[str] = []
    for word in arguments:
        if joined and joined[-1] in SIGNED_OPTIONS and word[:1] == "-" and word[1:2] in set("0123456789."):
            joined[-1] = f"{joined[-1]}={word}"
        else:
            joined.append(word)
    return joined


def _parser() -> Parser:
    parser = Parser(
        prog="facemorph",
        description="View, morph and export 3D facial expressions. Without a verb, opens the window.",
    )
    parser.add_argument("--version", action="version", version=f"facemorph {__version__}")
    adders = parser.add_subparsers(metavar="VERB", required=True, parser_class=Parser)
    _view(adders.add_parser("view", help="open the window"))
    _faces(adders.add_parser("faces", help="list the built-in faces, a line each"))
    _info(adders.add_parser("info", help="say what a face or a mesh file holds"))
    _check(adders.add_parser("check", help="check a whole set of shapes"))
    _render(adders.add_parser("render", help="draw a picture without a window"))
    _export(adders.add_parser("export", help="write a morphed face as a mesh"))
    _rbf(adders.add_parser("rbf", help="rebuild an expression from control points, and say how well"))
    fit_parser.add_verbs(adders.add_parser, _verb)
    _doctor(adders.add_parser("doctor", help="say what works on this machine and what is missing"))
    return parser


def _verb(
    parser: argparse.ArgumentParser, function: Callable[[argparse.Namespace], int], description: str
) -> None:
    parser.set_defaults(verb=function)
    parser.description = description


def _view(parser: Parser) -> None:
    _verb(parser, verbs.view, "Open the window on a face (ada, where none is named).")
    parser.add_argument("face", nargs="*", metavar="FACE", help=FACE_HELP)
    _set_option(parser)
    parser.add_argument(
        "--without-display",
        metavar="FOLDER",
        type=Path,
        help="where there is no display, write pictures of the expressions into FOLDER instead",
    )


def _faces(parser: Parser) -> None:
    _verb(parser, verbs.faces, "List the built-in faces: name, who it is, shapes, licence.")


def _info(parser: Parser) -> None:
    _verb(parser, verbs.info, "Say what a face or a mesh file holds: counts, parts, shapes, size.")
    parser.add_argument("face", nargs="+", metavar="FACE", help=FACE_HELP)
    _json_option(parser)


def _check(parser: Parser) -> None:
    _verb(
        parser,
        verbs.check,
        "Check a folder of shapes: do they correspond, and are they sound? Status 1 where they are not.",
    )
    parser.add_argument("folder", metavar="FACE", help="a folder, or a built-in face (ada)")
    parser.add_argument(
        "--repair",
        metavar="OUT",
        type=Path,
        help="write a copy of the face into the new folder OUT, shapes whose vertices stand in another order "
        "put right, and files that cannot be read left out",
    )
    _json_option(parser)


def _render(parser: Parser) -> None:
    _verb(parser, verbs.render, "Draw a face in a pose, or a sheet of all its expressions, as a PNG.")
    parser.add_argument("face", nargs="*", metavar="FACE", help=FACE_HELP)
    _pose_options(parser)
    parser.add_argument(
        "--sheet", action="store_true", help="every expression, labelled; --size is one tile's"
    )
    parser.add_argument(
        "--camera",
        default="front",
        metavar="VIEW",
        help=f"{', '.join(DIRECTIONS)}, or AZIMUTH,ELEVATION in degrees (default: front)",
    )
    parser.add_argument(
        "--size", metavar="WxH", help="in pixels (default: 1280x800; a sheet's tile: 320x320)"
    )
    parser.add_argument(
        "--shading", default="skin", metavar="NAME", help=f"{', '.join(SHADINGS)} (default: skin)"
    )
    _setting_options(parser)
    parser.add_argument(
        "--subdivision",
        default="0",
        metavar="N",
        help="smooth the surface by N levels of Catmull-Clark, 0 to 2 (default: 0, just as the file has it)",
    )
    _output_option(parser, "PNG")


def _setting_options(parser: Parser) -> None:
    parser.add_argument(
        "--light", default="studio", metavar="NAME", help=f"{', '.join(LIGHT_RIGS)} (default: studio)"
    )
    parser.add_argument(
        "--background",
        metavar="COLOUR",
        help="RRGGBB in hexadecimal, or transparent (default: dark; the light flat: mid grey)",
    )
    parser.add_argument(
        "--equal-luminance",
        dest="luminance",
        nargs="?",
        const=str(LUMINANCE),
        metavar="Y",
        help="expose so that the skin's mean luminance is this part of white's, for every face alike "
        f"(default: {LUMINANCE}); a face's expressions are exposed as its neutral is",
    )
    parser.add_argument(
        "--per-picture", action="store_true", help="with --equal-luminance: expose each expression by itself"
    )


def _export(parser: Parser) -> None:
    _verb(
        parser,
        verbs.export,
        "Write a face in a pose as an OBJ: order, polygons, groups, uvs kept; normals of the new surface.",
    )
    parser.add_argument("face", nargs="*", metavar="FACE", help=FACE_HELP)
    _pose_options(parser)
    _output_option(parser, "OBJ")


def _rbf(parser: Parser) -> None:
    _verb(
        parser,
        verbs.rbf,
        "Rebuild expression B from A by radial basis functions that know only how n control points move, "
        "and print the error against the true B in percent of the face's diagonal.",
    )
    parser.add_argument("face", nargs="+", metavar="FACE", help=FACE_HELP)
    parser.add_argument(
        "--from", dest="source", default="neutral", metavar="A", help="expression to start from"
    )
    parser.add_argument("--to", dest="target", required=True, metavar="B", help="expression to rebuild")
    parser.add_argument(
        "--points", default="40", metavar="N|FILE", help="so many points, or a file of points (default: 40)"
    )
    parser.add_argument("--kernel", metavar="NAME", help=f"{', '.join(KERNELS)} (default: r, or the file's)")
    parser.add_argument("--c", metavar="C", help="the multiquadric's c, in the face's unit")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="an OBJ of the rebuilt face to write"
    )
    _json_option(parser)


def _doctor(parser: Parser) -> None:
    _verb(
        parser,
        verbs.doctor,
        "Say what works on this machine and what is missing. Status 1 if it cannot draw.",
    )
    _json_option(parser)


def _pose_options(parser: Parser) -> None:
    parser.add_argument(
        "--from", dest="source", default="neutral", metavar="A", help="expression to start from"
    )
    parser.add_argument("--to", dest="target", metavar="B", help="expression to go to")
    parser.add_argument(
        "--t",
        type=str,
        metavar="T",
        help="how far from A to B, 0 to 1, beyond it extrapolates (default: 1 with --to)",
    )
    parser.add_argument(
        "--curve", default="linear", metavar="NAME", help=f"{' or '.join(CURVES)} (default: linear)"
    )
    _set_option(parser)
    parser.add_argument(
        "--linear",
        action="store_true",
        help="leave out the face's correctives: the plain sum of its shapes",
    )
    parser.add_argument(
        "--au",
        dest="units",
        action="append",
        default=[],
        metavar="UNIT=VALUE",
        help="add a FACS unit, as 12=0.8, L12=0.4 for the person's left alone, or units as AU1+4+15",
    )
    parser.add_argument(
        "--emotion",
        metavar="X,Y",
        help="a place on the emotion map: happy up, angry down, sad right, afraid left",
    )
    parser.add_argument(
        "--bilinear",
        nargs=2,
        metavar=("FACE1,FACE2", "EXPRESSION1,EXPRESSION2"),
        help="between two people (--s) and two expressions (--t), in place of FACE, --from and --to",
    )
    parser.add_argument("--s", metavar="S", help="how far from FACE1 to FACE2, 0 to 1 (default: 0)")


def _set_option(parser: Parser) -> None:
    parser.add_argument(
        "--set",
        dest="weights",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="add a shape with a weight, as jawOpen=0.5; may be given several times; below 0 and above 1 too",
    )


def _json_option(parser: Parser) -> None:
    parser.add_argument("--json", action="store_true", help="print as JSON")


def _output_option(parser: Parser, kind: str) -> None:
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help=f"the {kind} to write"
    )
