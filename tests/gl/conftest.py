"""One context for all drawing tests of a process; they skip where no OpenGL can be had."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import moderngl
import pytest

from facemorph.core.rig import Rig
from facemorph.errors import GraphicsError
from facemorph.gl import Offscreen, Renderer, create_context
from tests.gl.heads import head_rig


@pytest.fixture(scope="session")
def ctx() -> Iterator[moderngl.Context]:
    """A standalone context."""
    try:
        made = create_context()
    except GraphicsError as error:
        pytest.skip(str(error))
    yield made
    made.release()


@pytest.fixture(autouse=True)
def _clean(request: pytest.FixtureRequest) -> Iterator[None]:
    """The shared context is current at each test's start, and no test leaves an error of OpenGL's behind."""
    if "ctx" not in request.fixturenames:
        yield
        return
    ctx = request.getfixturevalue("ctx")
    ctx.__enter__()
    ctx.detect_framebuffer(0).use()
    yield
    assert ctx.error == "GL_NO_ERROR"


@pytest.fixture(scope="session")
def head(tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """The test head with its texture."""
    return head_rig(tmp_path_factory.mktemp("head"))


@pytest.fixture
def screen(ctx: moderngl.Context) -> Iterator[Offscreen]:
    """Pictures by the shared context."""
    with Offscreen(ctx=ctx) as made:
        yield made


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A fresh folder."""
    return tmp_path


@pytest.fixture(params=["cpu", "shader"])
def renderer(ctx: moderngl.Context, head: Rig, request: pytest.FixtureRequest) -> Iterator[Renderer]:
    """A renderer of the test head, by each morph path."""
    made = Renderer(ctx, request.param)
    made.load(head)
    yield made
    made.release()
