"""What the window asks for files for: the words, the kinds of files, and what is done with the answer.

A purpose is added by one entry of the table. `state.Chooser.purpose` is its key.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from facemorph.ui import emotion_paths, files, fit_files, fit_run, fit_wrap, handles, people, regions
from facemorph.ui.state import App

Take = Callable[[App, list[Path]], None]
Ask = Literal["file", "files", "folder", "save"]


@dataclass(frozen=True)
class Purpose:
    """One thing that files are asked for.

    title     what stands over the chooser, and its help under that
    ask       one file, several, a folder, or a place for a new file
    kind      what the desktop's dialog calls such files
    suffixes  the first is added to a new file's name
    take      is given the paths chosen; one but for "files"
    called    what a new file is called at first; None for the open face's name
    """

    title: str
    help: str
    ask: Ask
    kind: str
    suffixes: tuple[str, ...]
    take: Take
    called: Callable[[App], str] | None = None

    @property
    def saving(self) -> bool:
        """Whether a new file is wanted."""
        return self.ask == "save"


def _first(take: Callable[[App, Path], object]) -> Take:
    """For what takes one path."""

    def taken(app: App, paths: list[Path]) -> None:
        take(app, paths[0])

    return taken


def _source(paths: list[Path]) -> list[str]:
    """What a face is loaded from: `face.toml` stands for its folder."""
    whole = len(paths) == 1 and paths[0].name == "face.toml"
    return [str(path) for path in ([paths[0].parent] if whole else paths)]


def _open(app: App, paths: list[Path]) -> None:
    files.open_source(app, _source(paths))


def _mix(app: App, paths: list[Path]) -> None:
    people.ask_files(app, _source(paths), anew=True)


_TAB = "Tab completes what you type."
_FOLDER = f"A folder with neutral.obj and its expressions. {_TAB}"
_FACE = (*files.MESH_SUFFIXES, ".toml")

PURPOSES: Mapping[str, Purpose] = MappingProxyType(
    {
        "open": Purpose(
            "Open face", f"A mesh file, or the folder of a face. {_TAB}", "files", "Meshes", _FACE, _open
        ),
        "folder": Purpose("Open face folder", _FOLDER, "folder", "Meshes", files.MESH_SUFFIXES, _open),
        "person": Purpose(
            "Another face", f"A mesh file or folder of a face to mix this one with. {_TAB}",
            "files", "Meshes", _FACE, _mix,
        ),
        "person folder": Purpose(
            "Folder of another face", _FOLDER, "folder", "Meshes", files.MESH_SUFFIXES, _mix
        ),
        "picture": Purpose(
            "Save picture", f"Where to save the picture (PNG). {_TAB}",
            "save", "PNG pictures", (".png",), _first(files.save_picture),
        ),
        "mesh": Purpose(
            "Export mesh", f"Where to save the morphed face (OBJ). {_TAB}",
            "save", "OBJ meshes", (".obj",), _first(files.export_mesh),
        ),
        "open points": Purpose(
            "Open points", f"A file of points (JSON). {_TAB}",
            "file", "Points", (".json",), _first(handles.load),
        ),
        "save points": Purpose(
            "Save points", f"Where to save the points (JSON). {_TAB}",
            "save", "Points", (".json",), _first(handles.save),
        ),
        "open regions": Purpose(
            "Open regions", f"A file of regions (NPZ). {_TAB}",
            "file", "Regions", (".npz",), _first(regions.load),
        ),
        "save regions": Purpose(
            "Save regions", f"Where to save the regions (NPZ). {_TAB}",
            "save", "Regions", (".npz",), _first(regions.save),
        ),
        "open path": Purpose(
            "Open path", f"A path over the emotion map (JSON). {_TAB}",
            "file", "Paths", (".json",), _first(emotion_paths.open_path),
        ),
        "save path": Purpose(
            "Save path", f"Where to save the path (JSON). {_TAB}",
            "save", "Paths", (".json",), _first(emotion_paths.save_path),
        ),
        "fit template": Purpose(
            "Template", f"The folder of a face with shapes. {_TAB}",
            "folder", "Meshes", files.MESH_SUFFIXES, fit_files.ask_template,
        ),
        "fit neutral": Purpose(
            "The person's neutral", f"A mesh of the person without expression. {_TAB}",
            "file", "Meshes", files.MESH_SUFFIXES, _first(fit_files.read_neutral),
        ),
        "fit examples": Purpose(
            "Examples", f"Meshes of the person's expressions, or a folder of them. {_TAB}",
            "files", "Meshes", files.MESH_SUFFIXES, fit_files.take_meshes,
        ),
        "open pairs": Purpose(
            "Open points", f"Points of the template and the same on the scan (CSV). {_TAB}",
            "file", "Points", (".csv",), _first(fit_wrap.load_pairs),
        ),
        "save pairs": Purpose(
            "Save points", f"Where to save the points (CSV). {_TAB}",
            "save", "Points", (".csv",), _first(fit_wrap.save_pairs),
        ),
        "save person": Purpose(
            "Save as a face folder", f"A new folder for the person; nothing is overwritten. {_TAB}",
            "save", "Face folder", ("",), _first(fit_run.save), fit_run.file_name,
        ),
    }
)  # fmt: skip
