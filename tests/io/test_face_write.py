"""A face written as a folder and opened again is the same face; what goes wrong leaves nothing behind."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import facemorph
from facemorph.core.correctives import Corrective, Hat
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.rig import FaceInfo, Landmark, Regions, Rig, Shape
from facemorph.core.wrinkles import Wrinkle
from facemorph.errors import JobCancelledError, OutputError
from facemorph.io import check_folder, load_rig, write_face
from facemorph.io.atomic import new_folder
from tests.conftest import bumpy_grid

ODD_NAMES = (
    "NEUTRAL", "Neutral.obj", "con", "CON.x", "nul", "lpt1", "a/b", "a\\b", "a_b", "../../up", "/etc/passwd",
    "..", ".", "...", ".hidden", "C:\\x", "trailing.", "-o", "smile=1,2", '"quoted"', "back\\slash\\",
    "tab\there", "line\nbreak", "del\x7f", "straße", "STRASSE", "\u00e9", "e\u0301", "\u00c5", "\u212b",
    "happy", "Happy", "HAPPY", "happy-2", "日本語", "𠀀" * 80, "face.toml", "shapes.npz", "neutral.mtl",
    "x" * 1000, "y" * 81, "y" * 82, "#hash", "[table]", "{x}", "𝄞", " padded ", "a\u2028b",
    "zero\u200bwidth", "%41", "~", "$HOME", "*?<>|:",
)  # fmt: skip


def rig_of(shapes: dict[str, str], mesh: Mesh | None = None, seed: int = 3) -> Rig:
    """A curved sheet with random shapes: name -> set."""
    mesh = mesh or bumpy_grid(5, 6)
    draw = np.random.default_rng(seed)
    deltas = draw.normal(scale=0.2, size=(len(shapes), mesh.vertex_count, 3)).astype(np.float32)
    deltas[draw.random(deltas.shape[:2]) < 0.4] = 0.0
    return Rig(mesh, tuple(Shape(n, f"The {n}".strip(), s) for n, s in shapes.items()), deltas)


def whole_rig() -> Rig:
    """One with everything that a face folder can hold."""
    rig = rig_of(
        {"happy": "expression", "AU1": "facs", "sad": "expression", "jawOpen": "arkit", "fix": "corrective"}
    )
    weights = np.zeros((2, rig.neutral.vertex_count), np.uint8)
    weights[0], weights[1, ::2] = 100, 155
    return replace(
        rig,
        info=FaceInfo(
            'Ann "the" \\ Example', "Two\nlines.", "Somebody", "CC0", "mm",
            (Landmark("nose tip", 7, "9.3", 30), Landmark("chin", 3)),
            ((-1.0, -1.25, -0.5), (1.0, 0.1, 1e-3)),
        ),
        regions=Regions(("brows", "mouth"), weights),
        correctives=(
            Corrective("fix", ("happy", "AU1"), (Hat("jawOpen", 0.1, 0.4, 0.9),)),
            Corrective("fix", (), (Hat("sad"),)),
        ),
        wrinkles=(
            Wrinkle("feet, left", "green", (0.1, 0.2, 0.3, 0.4), 0.05, 0.1, {"AU1": 1.0, "not here": 0.5}),
        ),
    )  # fmt: skip


def assert_same(found: Rig, rig: Rig) -> None:
    """The same face: everything by name, positions and deltas to a hundred-thousandth of the diagonal."""
    assert sorted(found.names) == sorted(rig.names)
    order = [found.names.index(name) for name in rig.names]
    assert [found.shapes[k] for k in order] == list(rig.shapes)
    within = 1e-5 * rig.neutral.diagonal
    np.testing.assert_array_equal(found.neutral.positions, rig.neutral.positions)
    np.testing.assert_allclose(found.deltas[order], rig.deltas, atol=within)
    np.testing.assert_array_equal(found.neutral.corner_vertices, rig.neutral.corner_vertices)
    np.testing.assert_array_equal(found.neutral.polygon_starts, rig.neutral.polygon_starts)
    assert found.info == rig.info
    assert found.correctives == rig.correctives
    assert found.wrinkles == rig.wrinkles
    assert (found.regions is None) == (rig.regions is None)
    if rig.regions is not None and found.regions is not None:
        assert found.regions.names == rig.regions.names
        np.testing.assert_array_equal(found.regions.weights, rig.regions.weights)


def kept(rig: Rig, folder: Path) -> Rig:
    """Written and opened again."""
    assert write_face(rig, folder) == folder
    return load_rig(folder, cache=False)


def left(folder: Path) -> list[str]:
    """What lies in a folder, temporary things too."""
    return sorted(path.name for path in folder.iterdir())


def test_a_face_with_everything_is_the_same_when_opened_again(tmp_path: Path) -> None:
    rig = whole_rig()
    assert_same(kept(rig, tmp_path / "new" / "ann"), rig)
    assert left(tmp_path / "new") == ["ann"]
    assert left(tmp_path / "new" / "ann") == [
        "face.toml",
        "happy.obj",
        "neutral.obj",
        "sad.obj",
        "shapes.npz",
    ]


def test_a_face_that_was_opened_and_written_again_is_still_the_same(tmp_path: Path) -> None:
    first = kept(whole_rig(), tmp_path / "1")
    assert_same(kept(first, tmp_path / "2"), first)


def test_what_is_written_is_well_by_the_check_of_folders(tmp_path: Path) -> None:
    rig = whole_rig()
    write_face(replace(rig, deltas=rig.deltas * np.float32(0.01)), tmp_path / "ann")
    assert not check_folder(tmp_path / "ann").findings


@pytest.mark.parametrize(
    "shapes",
    [
        {},
        {"happy": "expression"},
        {"AU1": "facs", "AU2": "facs"},
        {"one": "", "two": "a set of its own"},
        {"fix": "corrective"},
    ],
    ids=["none", "expressions", "units", "odd sets", "correctives"],
)
def test_faces_of_few_shapes_are_kept(tmp_path: Path, shapes: dict[str, str]) -> None:
    rig = rig_of(shapes)
    assert_same(kept(rig, tmp_path / "face"), rig)


def test_regions_are_kept_without_any_shape(tmp_path: Path) -> None:
    rig = replace(rig_of({}), regions=whole_rig().regions)
    assert_same(kept(rig, tmp_path / "face"), rig)


@pytest.mark.parametrize("sort", ["expression", "facs"])
def test_shapes_may_have_any_name_and_no_name_leads_out_of_the_folder(tmp_path: Path, sort: str) -> None:
    rig = rig_of(dict.fromkeys(ODD_NAMES, sort))
    assert_same(kept(rig, tmp_path / "a" / "face"), rig)
    assert left(tmp_path) == ["a"]
    assert left(tmp_path / "a") == ["face"]
    files = left(tmp_path / "a" / "face")
    assert len(files) == (len(ODD_NAMES) + 2 if sort == "expression" else 3)
    assert len({name.casefold() for name in files}) == len(files)
    assert all(len(name.encode()) < 256 and not name.startswith(".") for name in files)
    assert not {name.split(".")[0].casefold() for name in files} & {"con", "nul", "lpt1"}


@pytest.mark.parametrize("name", ["", "  ", "a\0", "\udcff", "x" * 1025])
@pytest.mark.parametrize("sort", ["expression", "facs"])
def test_a_name_that_no_file_can_hold_is_told_before_anything_is_written(
    tmp_path: Path, name: str, sort: str
) -> None:
    with pytest.raises(OutputError, match="cannot be kept"):
        write_face(rig_of({name: sort}), tmp_path / "a" / "face")
    assert not left(tmp_path)


def test_deltas_that_are_no_numbers_are_told_by_the_name_of_their_shape(tmp_path: Path) -> None:
    rig = rig_of({"happy": "expression", "AU1": "facs"})
    rig.deltas[1, 3, 0] = np.nan
    with pytest.raises(OutputError, match=r"'AU1' .*no finite numbers"):
        write_face(rig, tmp_path / "face")
    assert not left(tmp_path)


@pytest.mark.parametrize(
    ("info", "told"),
    [
        (FaceInfo("ann", unit="furlong"), "unit must be one of"),
        (FaceInfo("ann", credit="x" * 5000), "credit is longer"),
        (FaceInfo("ann", frame=((0.0, 0.0, 0.0), (1.0, -1.0, 1.0))), "frame"),
        (FaceInfo("ann", landmarks=(Landmark("chin", -1),)), "vertex -1"),
    ],
)
def test_what_could_not_be_opened_again_is_not_written(tmp_path: Path, info: FaceInfo, told: str) -> None:
    with pytest.raises(OutputError, match=told) as error:
        write_face(replace(rig_of({"happy": "expression"}), info=info), tmp_path / "face")
    assert ".facemorph-" not in str(error.value)
    assert not left(tmp_path)


def test_a_corrective_with_two_hats_is_refused(tmp_path: Path) -> None:
    rig = rig_of({"a": "facs", "b": "facs", "fix": "corrective"})
    rule = Corrective("fix", (), (Hat("a"), Hat("b")))
    with pytest.raises(OutputError, match="2 hats"):
        write_face(replace(rig, correctives=(rule,)), tmp_path / "face")
    assert not left(tmp_path)


def test_numbers_of_arrays_are_kept_as_numbers(tmp_path: Path) -> None:
    rig = rig_of({"happy": "expression"})
    marks = (Landmark("chin", np.int64(4), None, np.int32(8)),)  # type: ignore[arg-type]
    area = tuple(np.float32([0.1, 0.2, 0.3, 0.4]))
    wrinkle = Wrinkle("w", "red", area, np.float64(0.1), 0, {"happy": np.float32(0.7)})  # type: ignore[arg-type]
    found = kept(replace(rig, info=FaceInfo("ann", landmarks=marks), wrinkles=(wrinkle,)), tmp_path / "face")
    assert found.info.landmarks == (Landmark("chin", 4, None, 8),)
    assert found.wrinkles == (Wrinkle("w", "red", (0.1, 0.2, 0.3, 0.4), 0.1, 0.0, {"happy": 0.7}),)


def test_a_folder_with_anything_in_it_is_refused_and_stays_as_it_is(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    folder.mkdir()
    (folder / ".hidden").write_text("mine")
    with pytest.raises(OutputError, match="is not empty, and nothing is overwritten"):
        write_face(whole_rig(), folder)
    assert left(folder) == [".hidden"]
    (tmp_path / "file").write_text("mine")
    with pytest.raises(OutputError, match="is a file, and nothing is overwritten"):
        write_face(whole_rig(), tmp_path / "file")
    with pytest.raises(OutputError, match="file is no folder"):
        write_face(whole_rig(), tmp_path / "file" / "face")
    assert (tmp_path / "file").read_text() == "mine"
    assert left(tmp_path) == ["face", "file"]


def test_an_empty_folder_is_filled_and_stays_the_same_folder(tmp_path: Path) -> None:
    folder = tmp_path / "face"
    folder.mkdir(mode=0o750)
    before = folder.stat()
    rig = whole_rig()
    assert_same(kept(rig, folder), rig)
    assert (folder.stat().st_ino, folder.stat().st_mode) == (before.st_ino, before.st_mode)
    assert left(folder) == ["face.toml", "happy.obj", "neutral.obj", "sad.obj", "shapes.npz"]


def test_a_link_to_an_empty_folder_is_followed(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "there")
    write_face(whole_rig(), tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert "face.toml" in left(tmp_path / "there")


@pytest.mark.parametrize("empty", [False, True])
@pytest.mark.parametrize("when", [0.0, 0.3, 0.7, 0.8, 1.0])
@pytest.mark.parametrize("error", [JobCancelledError, KeyboardInterrupt, OSError(28, "No space left")])
def test_work_that_is_stopped_leaves_nothing(tmp_path: Path, when: float, error, empty: bool) -> None:
    folder = tmp_path / "new" / "face"
    if empty:
        folder.mkdir(parents=True)

    def progress(part: float, doing: str) -> None:
        if part >= when:
            raise error

    with pytest.raises(error if isinstance(error, type) else OutputError):
        write_face(whole_rig(), folder, progress=progress)
    assert left(tmp_path) == (["new"] if empty else [])
    assert not empty or not left(folder)


def test_what_someone_puts_there_meanwhile_is_not_overwritten(tmp_path: Path) -> None:
    for name, before in (("new", False), ("empty", True)):
        folder = tmp_path / name
        if before:
            folder.mkdir()

        def theirs(out: Path = folder) -> bool:
            out.mkdir(exist_ok=True)
            (out / "face.toml").write_text("theirs")
            return True

        with pytest.raises(OutputError, match="not empty any more"), new_folder(folder, theirs) as stage:
            (stage / "face.toml").write_text("ours")
        assert left(folder) == ["face.toml"]
        assert (folder / "face.toml").read_text() == "theirs"
    assert left(tmp_path) == ["empty", "new"]


def test_a_move_that_fails_half_way_is_taken_back(tmp_path: Path, monkeypatch) -> None:
    rename = Path.rename

    def failing(self: Path, target: Path) -> Path:
        if target.name == "second.obj" and target.parent == tmp_path:
            raise OSError(5, "Input/output error")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", failing)
    rig = rig_of({"first": "expression", "second": "expression"})
    with pytest.raises(OutputError, match="input/output error"):
        write_face(rig, tmp_path)
    assert not left(tmp_path)


def test_progress_rises_to_one_and_says_what_is_written(tmp_path: Path) -> None:
    told: list[tuple[float, str]] = []
    write_face(whole_rig(), tmp_path / "ann", progress=lambda part, doing: told.append((part, doing)))
    parts = [part for part, _ in told]
    assert parts == sorted(parts)
    assert parts[0] == 0.0
    assert parts[-1] == 1.0
    assert {"writing happy.obj", "writing neutral.obj", "writing shapes.npz"} <= {doing for _, doing in told}


def textured(folder: Path, *names: str) -> Mesh:
    """A sheet with a material for each name of a picture."""
    mesh = bumpy_grid(4, 4)
    materials = {}
    for number, name in enumerate(names):
        Image.new("RGB", (4, 4), (number * 40, 0, 255)).save(folder / name, "PNG")
        materials[f"part {number}"] = Material(f"part {number}", texture=folder / name)
    polygons = np.arange(mesh.polygon_count, dtype=np.int32) % len(names)
    return replace(mesh, materials=materials, materials_used=Labels(tuple(materials), polygons))


def test_pictures_are_copied_whatever_they_are_called(tmp_path: Path) -> None:
    (tmp_path / "from").mkdir()
    names = ("skin.png", "face.toml", "shapes.npz", "neutral.mtl")
    mesh = textured(tmp_path / "from", *names)
    rig = rig_of({"happy": "expression", "AU1": "facs"}, mesh)
    found = kept(rig, tmp_path / "face")
    assert_same(found, rig)
    for name, material in mesh.materials.items():
        copy = found.neutral.materials[name].texture
        assert copy is not None
        assert copy.parent == tmp_path / "face"
        assert copy.read_bytes() == material.texture.read_bytes()
    assert mesh.materials_used is not None
    assert found.neutral.materials_used is not None
    np.testing.assert_array_equal(found.neutral.materials_used.index, mesh.materials_used.index)


def test_a_picture_called_as_a_mesh_does_not_become_a_shape(tmp_path: Path) -> None:
    (tmp_path / "from").mkdir()
    mesh = textured(tmp_path / "from", "neutral.obj", "happy.obj", "grin.ply")
    for shapes in ({"happy": "expression"}, {"AU1": "facs"}):
        rig = rig_of(shapes, mesh)
        assert_same(kept(rig, tmp_path / next(iter(shapes))), rig)


def test_a_person_of_ours_is_the_same_and_looks_the_same(tmp_path: Path) -> None:
    rig = facemorph.load("mei")
    found = kept(rig, tmp_path / "mei")
    assert_same(found, rig)
    pose = {"happy": 0.8, "jawOpen": 0.4}
    pictures = [facemorph.render(face, pose, size=(200, 200)).astype(int) for face in (rig, found)]
    assert pictures[0].std() > 10
    assert np.abs(pictures[0] - pictures[1]).mean() < 0.05


def test_the_folder_opens_after_it_was_moved_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "from").mkdir()
    rig = rig_of({"happy": "expression"}, textured(tmp_path / "from", "skin.png"))
    write_face(rig, tmp_path / "face")
    (tmp_path / "from" / "skin.png").unlink()
    (tmp_path / "face").rename(tmp_path / "moved")
    found = load_rig(tmp_path / "moved", cache=False)
    assert found.neutral.materials["part 0"].texture == tmp_path / "moved" / "skin.png"


@pytest.mark.parametrize("size", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_deltas_are_kept_to_a_part_of_the_diagonal_in_any_unit(tmp_path: Path, size: float) -> None:
    rig = rig_of({"happy": "expression", "AU1": "facs", "still": "facs", "fine": "facs"})
    deltas = rig.deltas * np.array([1.0, 1.0, 0.0, 1e-4], np.float32)[:, None, None]
    scaled = replace(
        rig,
        neutral=rig.neutral.with_positions(rig.neutral.positions * np.float32(size)),
        deltas=deltas * np.float32(size),
    )
    found = kept(scaled, tmp_path / "face")
    off = np.abs(found.deltas - scaled.deltas).max(axis=(1, 2)) / scaled.neutral.diagonal
    assert (off < [1e-6, 1e-5, 1e-12, 2e-8]).all()


def test_only_vertices_that_move_take_room_in_the_file_of_shapes(tmp_path: Path) -> None:
    rig = rig_of({"AU1": "facs"}, bumpy_grid(40, 40))
    rig.deltas[0, 5:] = 0.0
    write_face(rig, tmp_path / "face")
    with np.load(tmp_path / "face" / "shapes.npz", allow_pickle=False) as arrays:
        assert set(arrays["index"].tolist()) <= set(range(5))
        assert arrays["delta"].dtype == np.int16
