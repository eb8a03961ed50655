"""Bake whole people into an assets folder."""

from pathlib import Path

from .hair_atlas import hair_picture
from .head import Body, Head
from .landmarks import find_landmarks
from .lash_pictures import brow_picture, lash_picture
from .mouth_textures import gum_picture, teeth_picture, tongue_picture
from .pack import write_shapes
from .parts_eyes_picture import eye_picture
from .people import PEOPLE, Person
from .recipes import EXPRESSIONS
from .regions import build_regions
from .skin_pictures import SkinPictures
from .source import Source
from .textures import Painter
from .write import frame_lines, layout_text, write_mtl, write_obj, write_toml

SKIN_SIZE = 2048
JPEG_QUALITY = 90
EYE_QUALITY = 90


class Bakery:
    """Prepares what all people share, then bakes them one by one."""

    def __init__(self, wheel: Path, skin_size: int = SKIN_SIZE):
        self._source = Source(wheel)
        self._head = Head(self._source)
        self._painter = Painter(self._head, skin_size)
        self._skin_pictures = SkinPictures(self._painter)
        self._neutral_layout = layout_text(self._head, textured=True)
        self._shape_layout = layout_text(self._head, textured=False)
        self._landmarks = find_landmarks(self._head)
        self._regions = build_regions(self._head)

    def bake(self, name: str, out: Path):
        person = PEOPLE[name]
        folder = out / name
        folder.mkdir(parents=True, exist_ok=True)
        body = Body(self._head, person)
        neutral = body.positions(body.shaper.shape(EXPRESSIONS["neutral"]))
        for expression, recipe in EXPRESSIONS.items():
            points = body.positions(body.shaper.shape(recipe))
            layout = self._shape_layout if recipe else self._neutral_layout
            write_obj(folder / f"{expression}.obj", f"{person.name}, {expression}", points, layout)
        write_shapes(folder / "shapes.npz", body, self._source.arkit_names(), self._regions)
        write_mtl(folder / "face.mtl", person)
        expressions = [name for name in EXPRESSIONS if name != "neutral"]
        wrinkles = self._skin_pictures.toml_lines(person)
        write_toml(
            folder / "face.toml",
            person,
            expressions,
            self._landmarks,
            wrinkles,
            frame_lines(neutral, self._landmarks),
        )
        self._pictures(person, body, folder)

    def _pictures(self, person: Person, body: Body, folder: Path):
        self._painter.skin(body).save(folder / "skin.jpg", quality=JPEG_QUALITY, optimize=True)
        self._skin_pictures.save(body, folder)
        eye = eye_picture(person.look)
        eye.save(folder / "eye.jpg", quality=EYE_QUALITY, subsampling=0, optimize=True)
        for name, paint in (("teeth", teeth_picture), ("gum", gum_picture), ("tongue", tongue_picture)):
            paint(person.look).save(folder / f"{name}.jpg", quality=JPEG_QUALITY, optimize=True)
        for name, paint in (("hair", hair_picture), ("brow", brow_picture), ("lash", lash_picture)):
            paint(person.look).save(folder / f"{name}.png", optimize=True)
