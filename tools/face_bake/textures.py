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
SOLIDS = ("eye_L", "eye_R", "teeth_upper", "teeth_lower")
# Hair leaves at least so much light on bare skin: it stays where it is while the skin below it moves.
BESIDE_HAIR, HAIR_SOFTENED = 0.80, 8


class Painter:
    """Paints skins of one size."""

    def __init__(self, head: Head, size: int):
        self._lights: dict[Body, tuple[np.ndarray, np.ndarray]] = {}
        self._head, fine = head, head.fine
        self._triangles, uv_triangles = fine.triangles, fine.uv_triangles
        self._raster = Raster(fine.uv, uv_triangles, size)
        self._base = fine.operator @ head.source.base.points
        points = self._raster.sample(self._base, self._triangles)
        source_uv = self._raster.sample(fine.source_uv, uv_triangles)
        island = np.repeat(fine.island, 2)[self._raster.owner]
        upper, lower = (self._lid_distance(points, upper) for upper in (True, False))
        lips = np.clip(mask_at(head.source.mask("mpfb_lips.jpg"), 2.0, source_uv) * 1.25 - 0.12, 0, 1)
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
        light, beside_hair = self._both_lights(body)
        colours = paint_skin(self._canvas, light, beside_hair, body.person.look, age_of(body.person))
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
        """How much light reaches each covered pixel (p,) of the neutral, 0..1, were there no hair."""
        return self._both_lights(body)[0]

    def _both_lights(self, body: Body) -> tuple[np.ndarray, np.ndarray]:
        """That light, and the share (p,) of it that hair leaves on bare skin."""
        if body not in self._lights:
            self._lights = {body: self._light(body)}
        return self._lights[body]

    def _light(self, body: Body) -> tuple[np.ndarray, np.ndarray]:
        neutral, averaging = body.shaper.neutral, self._head.fine.averaging()
        skin = body.fine_skin(neutral)
        bare, below = (
            visible_sky(skin, self._triangles, body.solids(neutral, solids), averaging)
            for solids in (SOLIDS, (*SOLIDS, "hair"))
        )
        share = np.maximum(below / np.maximum(bare, 1e-3), BESIDE_HAIR)
        for _ in range(HAIR_SOFTENED):
            share = averaging @ share
        # The scalp is as dark as its roots are painted: shaded once more it would be black between strands.
        inside = smoothstep(3, 12, growth(self._base, body.person.look))
        light = bare + (np.minimum(bare, ROOT_LIGHT) - bare) * inside
        share = share + (1 - share) * inside
        return tuple(self._raster.sample(values, self._triangles) for values in (light, share))
