"""Windows for the tests of the interface."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from facemorph.core.rig import Rig
from facemorph.errors import GraphicsError
from facemorph.gl import create_context
from tests.ui.harness import Offscreen, ball_rig


@pytest.fixture(scope="session")
def rig() -> Rig:
    """A ball with expressions, FACS units and ARKit shapes."""
    return ball_rig()


@pytest.fixture(scope="session")
def opengl() -> None:
    """Skips where no OpenGL context can be had."""
    try:
        create_context().release()
    except GraphicsError as error:
        pytest.skip(str(error))


@pytest.fixture
def window(opengl: None, rig: Rig) -> Iterator[Offscreen]:
    """The whole window at 1280 x 800 with the ball in it, at rest."""
    with Offscreen(rig) as shown:
        yield shown


@pytest.fixture
def obj_face(tmp_path: Path) -> Path:
    """A folder with a neutral and a smile that can be opened."""
    from facemorph.io import write_obj

    small = ball_rig(("happy",), (), (), rings=6)
    folder = tmp_path / "small"
    folder.mkdir()
    write_obj(folder / "neutral.obj", small.neutral)
    write_obj(folder / "happy.obj", small.posed({"happy": 1.0}))
    return folder
