"""Ways to a context, what is said when there is none, and shaders that are missing or broken."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import moderngl
import pytest

from facemorph.core.rig import Rig
from facemorph.errors import GraphicsError
from facemorph.gl import Offscreen, create_context, describe
from facemorph.gl import context as contexts
from facemorph.gl.doctor import examine
from facemorph.gl.programs import Programs, read_source
from facemorph.resources import data_folder


@pytest.mark.parametrize("key", sorted({way.key for way in contexts.ways()}))
def test_each_way_draws_when_it_is_there(monkeypatch: pytest.MonkeyPatch, head: Rig, key: str) -> None:
    monkeypatch.setenv(contexts.FORCE, key)
    try:
        screen = Offscreen()
    except GraphicsError as error:
        pytest.skip(str(error))
    with screen:
        pixels = screen.render(head, {"smile": 1.0}, size=(64, 64))
        again = screen.render(head, {"smile": 1.0}, size=(64, 64))
    assert pixels[30, 32, 0] > 80
    assert (pixels == again).all()


def test_a_forced_way_that_nobody_knows_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(contexts.FORCE, "vulkan")
    with pytest.raises(GraphicsError, match=r"vulkan.*osmesa"):
        create_context()


def test_no_way_at_all_says_what_was_tried_and_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def none() -> moderngl.Context:
        raise OSError("no such library")

    broken = (contexts.Way("First", "a", none), contexts.Way("Second", "b", none))
    monkeypatch.setattr(contexts, "ways", lambda: broken)
    monkeypatch.delenv(contexts.FORCE, raising=False)
    with pytest.raises(GraphicsError) as refused:
        create_context()
    message = str(refused.value)
    for word in ("First (no such library)", "Second", "libegl1", "Fedora", "Arch", "macOS", "Windows"):
        assert word in message
    assert "\n" not in message


def test_what_a_context_is_can_be_told(ctx: moderngl.Context) -> None:
    graphics = describe(ctx)
    assert graphics.renderer in "\n".join(graphics.lines())
    assert graphics.morph == ("cpu" if graphics.software else "shader")
    assert graphics.max_layers >= 256


@pytest.mark.parametrize(
    ("name", "software"),
    [
        ("llvmpipe (LLVM 15.0.6, 256 bits)", True),
        ("softpipe", True),
        ("Google SwiftShader", True),
        ("GDI Generic", True),
        ("NVIDIA GeForce RTX 3060/PCIe/SSE2", False),
        ("Mesa Intel(R) UHD Graphics 620 (KBL GT2)", False),
        ("Apple M2", False),
        ("AMD Radeon RX 6600 (radeonsi)", False),
    ],
)
def test_software_is_told_from_hardware(ctx: moderngl.Context, name: str, software: bool) -> None:
    other = SimpleNamespace(info={**ctx.info, "GL_RENDERER": name}, max_samples=4)
    assert describe(other).software is software  # type: ignore[arg-type]


def test_the_doctor_tries_every_way() -> None:
    report = examine()
    assert [finding.way for finding in report.findings] == [way.name for way in contexts.ways()]
    for finding in report.findings:
        assert finding.works is (finding.problem == "")
    assert report.works is not bool(report.hint)


def test_the_doctor_survives_when_nothing_works(monkeypatch: pytest.MonkeyPatch) -> None:
    def none() -> moderngl.Context:
        raise OSError("no such library")

    monkeypatch.setattr("facemorph.gl.doctor.ways", lambda: (contexts.Way("EGL", "egl", none),))
    report = examine()
    assert not report.works
    assert "no such library" in report.findings[0].problem
    assert "libegl1" in report.hint


def write(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text)
    return folder


def test_includes_are_taken_once_and_lines_keep_their_origin(folder: Path) -> None:
    write(
        folder,
        a__vert='#version 330 core\n#include "b.glsl"\n#include "b.glsl"\nvoid main() {}\n',
        b__glsl="// b\nfloat b;\n",
    )
    source = read_source(folder, "a.vert", ["SWITCH"])
    assert source.text.splitlines() == [
        "#version 330 core",
        "#define SWITCH",
        "// b",
        "float b;",
        "void main() {}",
    ]
    assert [source.place(line) for line in (1, 4, 5)] == ["a.vert:1", "b.glsl:2", "a.vert:4"]


def test_what_is_repeated_is_written_out_with_its_number_and_keeps_its_lines(folder: Path) -> None:
    write(folder, a__vert="#version 330 core\n#repeat THINGS\nfloat a@;\nint b@;\n#end\nvoid main() {}\n")
    source = read_source(folder, "a.vert", ["THINGS 2"])
    assert source.text.splitlines() == [
        "#version 330 core", "#define THINGS 2", "float a0;", "int b0;", "float a1;", "int b1;",
        "void main() {}",
    ]  # fmt: skip
    assert [source.place(line) for line in (3, 6, 7)] == ["a.vert:3", "a.vert:4", "a.vert:6"]
    assert "a0" not in read_source(folder, "a.vert").text, "none without a count"


def test_a_missing_include_names_who_asked(folder: Path) -> None:
    write(folder, a__vert='#version 330 core\n\n#include "gone.glsl"\n')
    with pytest.raises(GraphicsError, match=r"a\.vert:3.*gone\.glsl"):
        read_source(folder, "a.vert")


def test_an_include_cannot_leave_the_shaders(folder: Path) -> None:
    inner = folder / "shaders"
    inner.mkdir()
    (folder / "secret.glsl").write_text("secret")
    write(inner, a__vert='#include "../secret.glsl"\n')
    with pytest.raises(GraphicsError, match="secret"):
        read_source(inner, "a.vert")


def test_a_compile_error_names_the_included_file_and_line(ctx: moderngl.Context, folder: Path) -> None:
    write(
        folder,
        a__vert="#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n",
        a__frag='#version 330 core\n#include "b.glsl"\nout vec4 c;\nvoid main() { c = vec4(broken()); }\n',
        b__glsl="// fine\nfloat broken() {\n    return nothing;\n}\n",
    )
    with pytest.raises(GraphicsError, match=r"b\.glsl:3.*nothing"):
        Programs(ctx, folder).get("a.vert", "a.frag")


def test_shaders_that_do_not_fit_together_are_told(ctx: moderngl.Context, folder: Path) -> None:
    write(
        folder,
        a__vert="#version 330 core\nout vec3 n;\nvoid main() { n = vec3(1.0); gl_Position = n.xyzz; }\n",
        a__frag="#version 330 core\nin vec2 n;\nout vec4 c;\nvoid main() { c = vec4(n, 0.0, 1.0); }\n",
    )
    with pytest.raises(GraphicsError, match=r"a\.vert"):
        Programs(ctx, folder).get("a.vert", "a.frag")


def test_the_glsl_has_the_formulas_of_the_reference_by_their_names() -> None:
    text = (data_folder("shaders") / "lib" / "morph.glsl").read_text(encoding="utf-8")
    for name in ("eased", "mixed_coefficient", "morphed_position"):
        assert f" {name}(" in text
