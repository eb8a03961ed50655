"""Files: meshes and faces in, meshes and pictures out. One format a module."""

from facemorph.io.load import load_rig
from facemorph.io.obj_write import write_obj
from facemorph.io.png import write_png
from facemorph.io.read import read_mesh

__all__ = ["load_rig", "read_mesh", "write_obj", "write_png"]
