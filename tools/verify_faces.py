"""Check an assets folder of baked faces: python tools/verify_faces.py [FOLDER]; exits 1 on a fault."""

import argparse
import re
import sys
import tomllib
import zlib
from pathlib import Path

import numpy as np

from verify_eyes import check_eyes

PEOPLE = ("ada", "ben", "mei", "kofi", "zola", "omar")
STATES = ("neutral", "happy", "sad", "angry", "surprised", "disgusted", "afraid")
GROUPS = [
    "skin",
    "mouth",
    "eye_L",
    "eye_R",
    "tears",
    "teeth_upper",
    "gums_upper",
    "teeth_lower",
    "gums_lower",
    "tongue",
    "lashes",
    "brows",
    "hair",
    "hair_locks",
]
PICTURES = ("skin.jpg", "eye.jpg", "teeth.jpg", "gum.jpg", "tongue.jpg", "lash.png", "brow.png", "hair.png")
SKIN_MAPS = ("relief.jpg", "roughness.jpg", "wrinkles.jpg")
LARGEST_SKIN_MAPS = 0.7e6
REGIONS = ["brows", "eyes", "nose", "cheeks", "mouth", "jaw"]
MEGABYTE = 1e6
LARGEST_FOLDER, LARGEST_ZIPPED = 56 * MEGABYTE, 30 * MEGABYTE
# Square centimetres: a real lash tip has about 0.0005, a collapsed triangle in a neutral face none.
SMALLEST_AREA = 1e-7
FACS_COUNT, ARKIT_COUNT = 34, 52


class Report:
    """Collects faults while checks go on."""

    def __init__(self):
        self.faults = []

    def require(self, condition: bool, fault: str):
        if not condition:
            self.faults.append(fault)


def split_obj(text: str) -> tuple[str, str]:
    """The part with the vertices, and the tail from the first texture coordinate or group on."""
    start = min(place for place in (text.find("\nvt "), text.find("\ng ")) if place > 0) + 1
    return text[:start], text[start:]


def bare_tail(tail: str) -> str:
    """The neutral's tail without texture coordinates: what every shape's file ends with."""
    lines = [line for line in tail.splitlines(keepends=True) if not line.startswith("vt ")]
    return "".join(re.sub(r"/\d+", "", line) if line.startswith("f ") else line for line in lines)


def read_points(text: str) -> np.ndarray:
    return np.array([line.split()[1:4] for line in text.splitlines() if line.startswith("v ")], float)


def read_triangles(tail: str) -> np.ndarray:
    """Triangles (t, 3) of the polygons of three or four corners."""
    faces = [line.split()[1:] for line in tail.splitlines() if line.startswith("f ")]
    corners = [[int(corner.split("/")[0]) - 1 for corner in face] for face in faces]
    return np.array([[face[0], face[k], face[k + 1]] for face in corners for k in range(1, len(face) - 1)])


def triangles_by_group(tail: str) -> dict[str, np.ndarray]:
    """Triangles (t, 3) of each group."""
    groups = (group.split("\n", 1) for group in ("\n" + tail).split("\ng ")[1:])
    return {name: read_triangles(faces) for name, faces in groups}


def check_shapes(folder: Path, report: Report, points: dict, tail: str, triangles: np.ndarray):
    """Points of every state, all over the same polygons."""
    bare = bare_tail(tail)
    for state in STATES:
        path = folder / f"{state}.obj"
        if not path.is_file():
            report.require(False, f"{path}: missing")
            continue
        head, own_tail = split_obj(path.read_text(encoding="ascii"))
        points[state] = read_points(head)
        wanted = tail if state == "neutral" else bare
        report.require(own_tail == wanted, f"{path}: its tail differs from the first file's")
        report.require(len(points[state]) == triangles.max() + 1, f"{path}: vertex count")
        report.require(bool(np.isfinite(points[state]).all()), f"{path}: not all numbers")
    corners = points["neutral"][triangles]
    edges = corners[:, 1:] - corners[:, :1]
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / 2
    flat = int((area <= SMALLEST_AREA).sum())
    report.require(flat == 0, f"{folder}: {flat} flat triangles")


def check_units(folder: Path, report: Report, vertices: int):
    with np.load(folder / "shapes.npz", allow_pickle=False) as data:
        units = {key: data[key] for key in data.files}
    starts, index, sets = units["starts"], units["index"].astype(int), units["sets"].tolist()
    header = int(units["format"]), int(units["vertices"])
    report.require(header == (1, vertices), f"{folder}: shapes.npz header {header}")
    counts = sets.count("facs"), sets.count("arkit")
    report.require(counts == (FACS_COUNT, ARKIT_COUNT), f"{folder}: {counts} units")
    report.require(len(set(units["names"].tolist())) == len(sets), f"{folder}: a unit's name twice")
    report.require(starts[-1] == len(index) == len(units["delta"]), f"{folder}: offsets do not add up")
    for k, name in enumerate(units["names"].tolist()):
        own = index[starts[k] : starts[k + 1]]
        fine = len(own) > 0 and bool((np.diff(own) > 0).all()) and own[-1] < vertices
        report.require(fine, f"{folder}: vertices of {name}")
    weights = units["region_weights"].astype(int)
    report.require(units["region_names"].tolist() == REGIONS, f"{folder}: region names")
    report.require(weights.shape == (len(REGIONS), vertices), f"{folder}: region sizes")
    report.require(weights.sum(0).max() <= 255, f"{folder}: regions claim more than everything")
    report.require((weights.max(1) >= 250).all(), f"{folder}: a region nowhere full")


def check_description(folder: Path, report: Report, vertices: int) -> list:
    data = tomllib.loads((folder / "face.toml").read_text(encoding="utf-8"))
    marks = data["landmarks"]
    report.require(all(0 <= mark["vertex"] < vertices for mark in marks), f"{folder}: landmark out of range")
    numbers = [mark["ibug"] for mark in marks if "ibug" in mark]
    report.require(sorted(numbers) == list(range(68)), f"{folder}: the 68 points are not all there")
    points = [mark["mpeg4"] for mark in marks if "mpeg4" in mark]
    report.require(len(points) == len(set(points)), f"{folder}: an MPEG-4 point twice")
    names = [entry["name"] for entry in data["expressions"]]
    report.require(names == list(STATES[1:]), f"{folder}: expressions {names}")
    for entry in data["expressions"]:
        report.require((folder / entry["file"]).is_file(), f"{folder}: {entry['file']} is missing")
    for picture in PICTURES:
        report.require((folder / picture).is_file(), f"{folder}: {picture} is missing")
    check_skin_maps(folder, report, data.get("wrinkles", []))
    return marks


def check_skin_maps(folder: Path, report: Report, wrinkles: list):
    """The skin's further pictures are small; each wrinkle lies in them and follows shapes that there are."""
    paths = [folder / name for name in SKIN_MAPS]
    missing = [path.name for path in paths if not path.is_file()]
    report.require(not missing, f"{folder}: {missing} are missing")
    size = sum(path.stat().st_size for path in paths if path.is_file())
    report.require(size <= LARGEST_SKIN_MAPS, f"{folder}: the skin's maps are {size} bytes")
    material = (folder / "face.mtl").read_text(encoding="ascii")
    report.require(all(name in material for name in SKIN_MAPS), f"{folder}: face.mtl names not all maps")
    with np.load(folder / "shapes.npz", allow_pickle=False) as data:
        known = {*STATES, *data["names"].tolist()}
    report.require(len(wrinkles) == 20, f"{folder}: {len(wrinkles)} wrinkles")
    for wrinkle in wrinkles:
        u0, v0, u1, v1 = wrinkle["area"]
        report.require(0 < u0 < u1 < 1 and 0 < v0 < v1 < 1, f"{folder}: area of {wrinkle['name']}")
        strange = [name for name in wrinkle["shapes"] if name not in known]
        report.require(not strange, f"{folder}: {wrinkle['name']} follows {strange}")


def check_person(folder: Path, report: Report, tail: str, triangles: np.ndarray) -> list:
    """Check one folder, print its row, and return its landmarks."""
    points = {}
    check_shapes(folder, report, points, tail, triangles)
    vertices = len(points["neutral"])
    check_units(folder, report, vertices)
    marks = check_description(folder, report, vertices)
    check_eyes(folder, report, points, triangles_by_group(tail))
    travel = max(np.linalg.norm(p - points["neutral"], axis=1).max() for p in points.values())
    size = sum(path.stat().st_size for path in folder.iterdir()) / MEGABYTE
    low, high = points["neutral"].min(0), points["neutral"].max(0)
    print(
        f"{folder.name:6}{vertices:9}{len(triangles):11}{tail.count(chr(10) + 'vt ') + 1:8}{len(marks):11}"
        f"{high[1] - low[1]:11.1f}{travel:13.2f}{size:8.2f}"
    )
    return marks


def check_folder(folder: Path, report: Report):
    first = folder / PEOPLE[0] / "neutral.obj"
    if not first.is_file():
        report.require(False, f"{first}: missing")
        return
    tail = split_obj(first.read_text(encoding="ascii"))[1]
    triangles = read_triangles(tail)
    groups = [line.split()[1] for line in tail.splitlines() if line.startswith("g ")]
    report.require(groups == GROUPS, f"groups {groups}")
    print("person vertices  triangles     uvs  landmarks  height cm  farthest cm      MB")
    marks = [check_person(folder / name, report, tail, triangles) for name in PEOPLE]
    report.require(all(mark == marks[0] for mark in marks), "the landmarks differ between people")
    files = [path for path in folder.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files)
    zipped = sum(len(zlib.compress(path.read_bytes())) for path in files)
    print(f"all together {size / MEGABYTE:.1f} MB, {zipped / MEGABYTE:.1f} MB zipped")
    report.require(size <= LARGEST_FOLDER, "too large")
    report.require(zipped <= LARGEST_ZIPPED, "too large when zipped")


def main() -> int:
    parser = argparse.ArgumentParser(description="Check baked faces.")
    parser.add_argument("folder", type=Path, nargs="?", default=Path("assets/faces"))
    report = Report()
    check_folder(parser.parse_args().folder, report)
    for fault in report.faults:
        print(f"FAULT {fault}")
    print(f"{len(report.faults)} faults" if report.faults else "no faults")
    return 1 if report.faults else 0


if __name__ == "__main__":
    sys.exit(main())
