"""What tests share: small faces made here, the built-in faces, and the folder of real and tricky files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(autouse=True, scope="session")
def _own_folders(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Tests neither read nor write the settings and the cache of whoever runs them."""
    os.environ["FACEMORPH_CACHE_DIR"] = str(tmp_path_factory.mktemp("cache"))
    os.environ["FACEMORPH_CONFIG_DIR"] = str(tmp_path_factory.mktemp("config"))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The folder of real and tricky files beside the project; skips where it is not there."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the folder of shared test data is not beside the project")
    return folder


def bumpy_grid(rows: int = 9, columns: int = 11) -> Mesh:
    """A curved sheet of quads, for laws that hold on any surface."""
    v, u = np.mgrid[0 : 1 : rows * 1j, 0 : 1 : columns * 1j]
    positions = np.stack([u * 4 - 2, v * 3 - 1.5, np.sin(3 * u) * np.cos(2 * v)], axis=-1).reshape(-1, 3)
    index = np.arange(rows * columns).reshape(rows, columns)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    return Mesh.from_polygons(positions.astype(np.float32), quads)


@pytest.fixture
def small_rig() -> Rig:
    """A curved sheet with three shapes of local support."""
    mesh = bumpy_grid()
    rng = np.random.default_rng(7)
    shapes = {}
    for name in ("happy", "sad", "jawOpen"):
        offsets = rng.normal(scale=0.1, size=mesh.positions.shape).astype(np.float32)
        offsets[rng.random(len(offsets)) < 0.5] = 0.0
        shapes[name] = mesh.positions + offsets
    return Rig.from_arrays(mesh, shapes)
