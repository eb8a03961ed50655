"""Files: meshes and faces in, meshes and pictures out. One format a module."""

from facemorph.io.check import check_folder
from facemorph.io.face_toml import read_face_info
from facemorph.io.face_write import check_writable, write_face
from facemorph.io.handles_file import read_handles, write_handles
from facemorph.io.load import load_rig
from facemorph.io.obj_write import write_obj
from facemorph.io.pairs_file import read_pairs, write_pairs
from facemorph.io.png import write_png
from facemorph.io.read import read_mesh
from facemorph.io.regions_file import read_regions, write_regions
from facemorph.io.repair import Repair, repair_folder
from facemorph.io.report import Finding, Report

__all__ = [
    "Finding",
    "Repair",
    "Report",
    "check_folder",
    "check_writable",
    "load_rig",
    "read_face_info",
    "read_handles",
    "read_mesh",
    "read_pairs",
    "read_regions",
    "repair_folder",
    "write_face",
    "write_handles",
    "write_obj",
    "write_pairs",
    "write_png",
    "write_regions",
]
