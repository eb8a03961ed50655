"""Regions kept in a file come back as they were; a file that is none is refused and nothing is unpacked."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facemorph.core.rig import Rig
from facemorph.deform.regions import RegionSet, painted
from facemorph.errors import ControlsFileError, OutputError
from facemorph.io import read_regions, write_regions
from facemorph.io.regions_file import FORMAT
from tests.conftest import bumpy_grid


@pytest.fixture
def rig() -> Rig:
    return Rig.from_arrays(bumpy_grid(), {})


def thirds(rig: Rig) -> RegionSet:
    weights = np.random.default_rng(4).dirichlet(np.ones(4), rig.neutral.vertex_count).T[:3]
    return RegionSet(rig, ("brows", "Wangen und Kinn", "口"), weights.astype(np.float32))


def arrays(rig: Rig, **changes: object) -> dict[str, object]:
    """What a file of regions holds."""
    regions = thirds(rig)
    return {
        "format": np.array([FORMAT]),
        "vertices": np.int32(rig.neutral.vertex_count),
        "region_names": np.array(regions.names),
        "region_weights": np.ascontiguousarray(regions.weights),
        **changes,
    }


def test_what_is_written_is_read_bit_for_bit(rig: Rig, tmp_path: Path) -> None:
    regions = thirds(rig)
    write_regions(tmp_path / "some.npz", regions, rig)
    again = read_regions(tmp_path / "some.npz", rig)
    assert again.names == regions.names
    assert np.array_equal(again.weights, regions.weights)
    assert [path.name for path in tmp_path.iterdir()] == ["some.npz"]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
@given(strokes=st.lists(st.tuples(st.integers(0, 2), st.floats(-1.0, 1.0, width=32)), max_size=12))
def test_whatever_was_painted_can_be_opened_again(
    rig: Rig, tmp_path: Path, strokes: list[tuple[int, float]]
) -> None:
    weights = thirds(rig).weights
    fade = np.linspace(0.0, 1.0, rig.neutral.vertex_count, dtype=np.float32)
    for region, strength in strokes:
        weights = painted(weights, region, fade * np.float32(strength))
    kept = RegionSet(rig, ("a", "b", "c"), weights)
    write_regions(tmp_path / "some.npz", kept, rig)
    assert np.array_equal(read_regions(tmp_path / "some.npz", rig).weights, weights)


def test_a_face_of_another_topology_is_named(rig: Rig, tmp_path: Path) -> None:
    write_regions(tmp_path / "some.npz", thirds(rig), rig)
    other = Rig.from_arrays(bumpy_grid(5, 5), {})
    with pytest.raises(ControlsFileError, match=r"some\.npz is for a face of .* has 25\. Use a face of"):
        read_regions(tmp_path / "some.npz", other)


WRONG = [
    (lambda w: {"format": np.array(["facemorph regions 9"])}, "no file of regions"),
    (lambda w: {"format": np.int32(1)}, "no file of regions"),
    (lambda w: {"format": np.array([{}], object)}, "format"),
    (lambda w: {"vertices": np.array([1.5])}, "vertices"),
    (lambda w: {"region_names": np.array(["a", "b"])}, "region_weights"),
    (lambda w: {"region_names": np.array(["a", "b", "a"])}, "a name of its own"),
    (lambda w: {"region_names": np.array(["a", "b", "  "])}, "a name of its own"),
    (lambda w: {"region_names": np.array(["a", "b", "c\n\x1b[2J"])}, "a name of its own"),
    (lambda w: {"region_names": np.array(["a", "b", "c" * 65])}, "64 letters"),
    (lambda w: {"region_names": np.array([1, 2, 3])}, "texts"),
    (lambda w: {"region_names": np.array([], "U1"), "region_weights": w[:0]}, "a name of its own"),
    (lambda w: {"region_weights": w.astype(np.complex64)}, "complex64"),
    (lambda w: {"region_weights": (w * 255).astype(np.uint8)}, "region_weights"),
    (lambda w: {"region_weights": w.T.copy()}, "region_weights"),
    (lambda w: {"region_weights": w * np.float32(np.nan)}, "0 or more"),
    (lambda w: {"region_weights": w + np.float32(np.inf)}, "0 or more"),
    (lambda w: {"region_weights": -w}, "0 or more"),
    (lambda w: {"region_weights": w * 3}, "at most 1"),
]


@pytest.mark.parametrize(("change", "words"), WRONG)
def test_wrong_contents_are_refused_with_the_reason(rig: Rig, tmp_path: Path, change, words: str) -> None:
    path = tmp_path / "some.npz"
    np.savez(path, **arrays(rig, **change(np.ascontiguousarray(thirds(rig).weights))))
    with pytest.raises(ControlsFileError, match=words) as refused:
        read_regions(path, rig)
    assert "\n" not in str(refused.value)


def test_what_is_no_such_file_at_all_is_refused(rig: Rig, tmp_path: Path) -> None:
    (tmp_path / "text.npz").write_text("not a zip")
    (tmp_path / "empty.npz").touch()
    (tmp_path / "folder.npz").mkdir()
    np.savez(tmp_path / "fewer.npz", format=np.array([FORMAT]))
    whole = tmp_path / "whole.npz"
    write_regions(whole, thirds(rig), rig)
    (tmp_path / "cut.npz").write_bytes(whole.read_bytes()[:-40])
    damaged = bytearray(whole.read_bytes())
    damaged[len(damaged) // 2] ^= 0xFF
    (tmp_path / "damaged.npz").write_bytes(damaged)
    for name in ("text", "empty", "folder", "fewer", "cut", "damaged", "missing"):
        with pytest.raises(ControlsFileError, match=rf"{name}\.npz "):
            read_regions(tmp_path / f"{name}.npz", rig)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes of a name here")
def test_a_pipe_is_refused_without_waiting_for_it(rig: Rig, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.npz")
    with pytest.raises(ControlsFileError, match="no ordinary file"):
        read_regions(tmp_path / "pipe.npz", rig)


def test_a_file_that_claims_more_than_regions_can_need_is_not_unpacked(rig: Rig, tmp_path: Path) -> None:
    path = tmp_path / "bomb.npz"
    held = arrays(rig)
    del held["region_weights"]
    np.savez(path, **held)
    with (
        zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive,
        archive.open("region_weights.npy", "w") as f,
    ):
        np.lib.format.write_array_header_1_0(
            f, {"descr": "<f4", "fortran_order": False, "shape": (4, 1_000_000_000)}
        )
        f.write(bytes(1 << 20))
    with pytest.raises(ControlsFileError, match=r"claims 14\.9 GB"):
        read_regions(path, rig)


def test_a_file_that_cannot_be_written_leaves_the_old_one(rig: Rig, tmp_path: Path) -> None:
    path = tmp_path / "some.npz"
    write_regions(path, thirds(rig), rig)
    before = path.read_bytes()
    broken = thirds(rig)
    broken.weights = Failing()
    with pytest.raises(MemoryError):
        write_regions(path, broken, rig)
    assert path.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["some.npz"]
    with pytest.raises(OutputError, match="is a folder"):
        write_regions(tmp_path, thirds(rig), rig)


class Failing:
    """Weights that give out while they are written."""

    def __array__(self, *_: object, **__: object) -> np.ndarray:
        raise MemoryError
