"""The layer rule: a module imports only from its own layer and from those to its right."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parent.parent / "src" / "facemorph"
LAYERS = [
    {"cli"},
    {"ui"},
    {"api", "fitting"},
    {"gl", "io"},
    {"fit"},
    {"deform"},
    {"core"},
    {"errors", "resources", "__init__", "__main__"},
]
RANK = {name: rank for rank, names in enumerate(LAYERS) for name in names}
ONLY_IN = {
    "moderngl": {"gl"},
    "glcontext": {"gl"},
    "imgui_bundle": {"ui"},
    "glfw": {"ui"},
    "trimesh": {"io"},
    "PIL": {"gl", "io"},
    "scipy": {"deform", "fit"},
    "threadpoolctl": {"fit"},
    "matplotlib": {"fit"},
}
# The package's front door looks at every layer, lazily.
FREE = {"__init__", "__main__"}

MODULES = sorted(PACKAGE.rglob("*.py"))


def layer_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def only_for_types(tree: ast.Module) -> set[ast.AST]:
    """What stands under `if TYPE_CHECKING`: never imported when the program runs."""
    blocks = [n for n in ast.walk(tree) if isinstance(n, ast.If) and ast.unparse(n.test) == "TYPE_CHECKING"]
    return {inner for block in blocks for part in block.body for inner in ast.walk(part)}


def imported(path: Path) -> set[str]:
    names: set[str] = set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    typing_only = only_for_types(tree)
    for node in ast.walk(tree):
        if node in typing_only:
            continue
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path.name} imports relatively"
            names.update(f"{node.module}.{alias.name}" for alias in node.names)
    return names


def at_start(path: Path) -> set[str]:
    """Top packages that importing the module alone pulls in."""
    names: set[str] = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Import):
            names.update(alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module.split(".")[0])
    return names


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_a_module_imports_only_from_its_own_layer_or_below(path):
    own = layer_of(path)
    for name in imported(path):
        top, *rest = name.split(".")
        assert own in ONLY_IN.get(top, {own}), f"{own} may not import {top}"
        if top == "facemorph" and rest and rest[0] in RANK and own not in FREE:
            other = rest[0]
            sideways = RANK[other] == RANK[own] and other != own and own in {"gl", "io"}
            assert RANK[other] >= RANK[own] and not sideways, f"{own} may not import facemorph.{other}"


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_slow_packages_are_imported_where_they_are_used(path):
    slow = {"trimesh", "scipy", "PIL", "platformdirs"} & at_start(path)
    assert not slow, f"{path.name} imports {', '.join(sorted(slow))} at start-up"


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_modules_stay_small(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 320
