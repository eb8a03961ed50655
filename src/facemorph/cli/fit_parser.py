"""The options of fit, transfer and register."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from facemorph.cli import fitting
from facemorph.cli.fitting import ExampleOption

_TEMPLATE_HELP = "the rig whose shapes are wanted: a built-in face (ada) or a face folder"
_PAIRS_HELP = "points of TEMPLATE and where they are on the mesh, needed where that has another topology"
_PAIRS_FORMAT = (
    "PAIRS is a table (CSV, UTF-8, commas) whose first line names its columns: template, which is a vertex "
    'of TEMPLATE counted from 0, the name of one of its landmarks, or "ibug 30" for number 30, from 0, of '
    "the usual 68; and either scan, a vertex of the mesh counted from 0, or x, y and z in the mesh's unit; a "
    "column name may be added. Three pairs at least; the usual 68 are best."
)

Verb = Callable[[argparse.ArgumentParser, Callable[[argparse.Namespace], int], str], None]


def add_verbs(add: Callable[..., argparse.ArgumentParser], verb: Verb) -> None:
    """Add the three verbs with their options."""
    _fit(add("fit", help="make a person's blendshapes from examples"), verb)
    _transfer(add("transfer", help="make a person's blendshapes from a neutral alone"), verb)
    _register(add("register", help="wrap a template's topology on a scan"), verb)


def _fit(parser: argparse.ArgumentParser, verb: Verb) -> None:
    parser.epilog = _PAIRS_FORMAT
    verb(
        parser,
        fitting.fit,
        "Make all of TEMPLATE's shapes for another person, from that person's neutral and a few example "
        "expressions, and write them as a face folder. Few examples mixing few shapes each work best.",
    )
    _template_and_neutral(parser)
    parser.add_argument(
        "--example",
        action=ExampleOption,
        dest="example",
        metavar="MESH",
        help="an expression of that person; may be given several times, four are plenty, none is transfer",
    )
    parser.add_argument(
        "--weights",
        action=ExampleOption,
        dest="weights",
        metavar="NAME=VALUE,...",
        help="roughly which shapes make up the example before it, each from 0 to 1, as "
        '"happy=0.8,jawOpen=0.3"; for every example or for none, then they are estimated',
    )
    parser.add_argument(
        "--landmarks",
        action=ExampleOption,
        dest="landmarks",
        metavar="PAIRS",
        help=f"{_PAIRS_HELP}: of the neutral where given before all examples or only once, else of the "
        "example before it; examples of the neutral's own topology need none",
    )
    parser.set_defaults(examples=[], landmarks=None)
    parser.add_argument(
        "--shapes",
        metavar="NAME,...",
        help="shapes or sets of shapes (expression, facs, arkit) that may explain the examples; all are made "
        "(default: all)",
    )
    parser.add_argument(
        "--report",
        type=Path,
        metavar="FOLDER",
        help="also compare with plain transfer, copied deltas and PCA, over alpha and against noise in the "
        "weights: a new folder with report.json and plots",
    )
    parser.add_argument(
        "--held-out",
        action="append",
        default=[],
        type=Path,
        metavar="MESH",
        help="with --report: an expression of that person that no fit sees; may be given several times",
    )
    parser.add_argument(
        "--iterations",
        default="10",
        metavar="N",
        help="turns of fitting shapes and weights, 1 to 1000 (default: 10)",
    )
    _output(parser)


def _transfer(parser: argparse.ArgumentParser, verb: Verb) -> None:
    parser.epilog = _PAIRS_FORMAT
    verb(
        parser,
        fitting.transfer,
        "Make all of TEMPLATE's shapes for another person by deformation transfer, from that person's "
        "neutral alone, and write them as a face folder.",
    )
    _template_and_neutral(parser)
    parser.add_argument("--landmarks", type=Path, metavar="PAIRS", help=_PAIRS_HELP)
    _output(parser)


def _register(parser: argparse.ArgumentParser, verb: Verb) -> None:
    parser.epilog = _PAIRS_FORMAT
    verb(
        parser,
        fitting.register,
        "Wrap TEMPLATE's neutral, with its topology, on the surface in SCAN, and say how close it lies.",
    )
    parser.add_argument("template", metavar="TEMPLATE", help="a built-in face (ada), a face folder or a mesh")
    parser.add_argument("scan", type=Path, metavar="SCAN", help="a mesh file of any topology")
    parser.add_argument(
        "--landmarks",
        type=Path,
        required=True,
        metavar="PAIRS",
        help="points of TEMPLATE and where they are on SCAN",
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="the OBJ to write")
    parser.add_argument(
        "--json", action="store_true", help="print as JSON: distances, triangles flipped, times by stage"
    )


def _template_and_neutral(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("template", metavar="TEMPLATE", help=_TEMPLATE_HELP)
    parser.add_argument(
        "--neutral", type=Path, required=True, metavar="MESH", help="the other person's neutral face"
    )


def _output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="FOLDER",
        help="a new or empty folder for the face",
    )
    parser.add_argument(
        "--json",
        action="store_true",
        help="print as JSON: errors and weights of each example, times by stage, peak memory",
    )
