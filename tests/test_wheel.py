"""The wheel holds all it needs: installed in a fresh environment outside the checkout, it draws."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile

import pytest

from facemorph.resources import builtin_faces
from tests.conftest import ROOT

pytestmark = pytest.mark.wheel
LARGEST_WHEEL_MB = 30


def run(*arguments: object, cwd: object = ROOT) -> str:
    environment = {k: v for k, v in os.environ.items() if k not in {"PYTHONPATH", "VIRTUAL_ENV"}}
    done = subprocess.run(
        [str(a) for a in arguments], cwd=cwd, env=environment, capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    out = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", out)
    (path,) = out.glob("*.whl")
    return path


def test_the_wheel_carries_shaders_and_faces_and_stays_small(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    for face in builtin_faces():
        assert f"facemorph/_data/faces/{face}/neutral.obj" in names
    for shader in (ROOT / "shaders").rglob("*.*"):
        assert f"facemorph/_data/shaders/{shader.relative_to(ROOT / 'shaders')}" in names
    assert wheel.stat().st_size < LARGEST_WHEEL_MB * 1e6


def test_an_installed_wheel_renders_without_the_checkout(wheel, tmp_path):
    run(sys.executable, "-m", "venv", tmp_path / "env")
    python = tmp_path / "env" / "bin" / "python"
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run(*pip, "--constraint", ROOT / "constraints.txt", wheel, cwd=tmp_path)
    facemorph = tmp_path / "env" / "bin" / "facemorph"
    run(facemorph, "render", "ada", "--to", "happy", "--size", "160x120", "-o", "x.png", cwd=tmp_path)
    assert (tmp_path / "x.png").stat().st_size > 2000
    assert run(facemorph, "faces", cwd=tmp_path).split()[0] == "ada"
    home = run(python, "-c", "import facemorph; print(facemorph.__file__)", cwd=tmp_path)
    assert str(tmp_path) in home
