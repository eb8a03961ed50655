"""Paint all pictures of a person; what does not depend on the person is prepared once."""

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

from .ageing import age_of
from .cage import HEAD, MOUTH
from .hair import growth
from .head import Body, Head
from .occlusion import visible_sky
from .paintkit import smoothstep
from .raster import Raster
from .skin import Canvas, paint_skin
from .source import mask_at
from .strips import catmull_rom

FAR = 9.0
# What the hair above leaves of the light on the scalp.
ROOT_LIGHT = 0.62
# What casts shade on the skin beside itself.
SOLIDS = ("eye_L", "eye_R", "teeth_upper", "teeth_lower", "hair")


class Painter:
    """Paints skins of one size."""

    def __init__(self, head: Head, size: int):
        self._lights: dict[Body, np.ndarray] = {}
        self._head, fine = head, head.fine
        self._triangles, uv_triangles = fine.triangles, fine.uv_triangles
        self._raster = Raster(fine.uv, uv_triangles, size)
        self._base = fine.operator @ head.source.base.points
        points = self._raster.sample(self._base, self._triangles)
        source_uv = self._raster.sample(fine.source_uv, uv_triangles)
        island = np.repeat(fine.island, 2)[self._raster.owner]
        upper, lower = (self._lid_distance(points, upper) for upper in (True, False))
        lips = np.clip(mask_at(head.source.mask("mpfb_lips.jpg"), 1.3, source_uv) * 1.25 - 0.12, 0, 1)
        ears = mask_at(head.source.mask("mpfb_ears.jpg"), 3, source_uv)
        lid_edge = self._raster.sample(fine.operator @ head.lids.edges(), self._triangles)
        outside, mouth = island == HEAD, (island == MOUTH).astype(np.float32)
        self._canvas = Canvas(points, lips * outside, ears * outside, mouth, upper, lower, lid_edge)

    def _lid_distance(self, points: np.ndarray, upper: bool) -> np.ndarray:
        """Distance (p,) to the edge of the upper or lower lids; only measured near the eyes."""
        base = self._head.source.base.points
        edge = [
            catmull_rom(len(lashes.lid), np.linspace(0, len(lashes.lid) - 1, 160)) @ base[lashes.lid]
            for lashes in self._head.lashes.rows
            if lashes.upper == upper
        ]
        distance = np.full(len(points), FAR, np.float32)
        near = (np.abs(points[:, 1] - 7.3) < 0.25) & (points[:, 2] > 1.1)
        distance[near] = cKDTree(np.concatenate(edge)).query(points[near])[0]
        return distance

    def skin(self, body: Body) -> Image.Image:
        """The skin of a person with the occlusion of the neutral face baked in."""
        colours = paint_skin(self._canvas, self.light(body), body.person.look, age_of(body.person))
        return Image.fromarray(self._raster.picture(colours))

    @property
    def canvas(self) -> Canvas:
        """What lies under each covered pixel."""
        return self._canvas

    @property
    def raster(self) -> Raster:
        """Where those pixels are."""
        return self._raster

    def light(self, body: Body) -> np.ndarray:
        """How much light reaches each covered pixel (p,) of the neutral, 0..1."""
        if body not in self._lights:
            self._lights = {body: self._light(body)}
        return self._lights[body]

    def _light(self, body: Body) -> np.ndarray:
        neutral = body.shaper.neutral
        blockers = body.solids(neutral, SOLIDS)
        skin = body.fine_skin(neutral)
        light = visible_sky(skin, self._triangles, blockers, self._head.fine.averaging())
        # Roots are painted dark already: shaded once more they would be black between the strands.
        light = np.maximum(light, ROOT_LIGHT * smoothstep(3, 12, growth(self._base, body.person.look)))
        return self._raster.sample(light, self._triangles)
