"""Map every pixel of the texture to a place on the mesh, once for all six people."""

import numpy as np
from scipy.ndimage import distance_transform_edt


class Raster:
    """For each covered pixel its triangle and weights; row 0 is the top of the picture (v = 1)."""

    def __init__(self, uv: np.ndarray, uv_triangles: np.ndarray, size: int):
        self.size = size
        self._owner = np.full((size, size), -1, np.int32)
        self._weights = np.zeros((size, size, 3), np.float32)
        corners = uv[uv_triangles] * size
        corners[..., 1] = size - corners[..., 1]
        for index, triangle in enumerate(corners):
            self._draw(index, triangle)
        self.covered = self._owner >= 0
        self.owner, self.weights = self._owner[self.covered], self._weights[self.covered]

    def _draw(self, index: int, triangle: np.ndarray):
        low = np.maximum(np.floor(triangle.min(0) - 0.5).astype(int), 0)
        high = np.minimum(np.ceil(triangle.max(0) + 0.5).astype(int), self.size)
        if (high <= low).any():
            return
        a, b, c = triangle
        area = (b[1] - c[1]) * (a[0] - c[0]) + (c[0] - b[0]) * (a[1] - c[1])
        if abs(area) < 1e-12:
            return
        x = np.arange(low[0], high[0]) + 0.5 - c[0]
        y = (np.arange(low[1], high[1]) + 0.5 - c[1])[:, None]
        first = ((b[1] - c[1]) * x + (c[0] - b[0]) * y) / area
        second = ((c[1] - a[1]) * x + (a[0] - c[0]) * y) / area
        weights = np.stack([first, second, 1 - first - second], -1)
        hit = (weights >= -1e-3).all(-1)
        window = np.s_[low[1] : high[1], low[0] : high[0]]
        self._owner[window][hit] = index
        self._weights[window][hit] = weights[hit]

    def sample(self, values: np.ndarray, triangles: np.ndarray) -> np.ndarray:
        """Vertex values (n,) or (n, k) interpolated at the covered pixels, (p,) or (p, k) float32."""
        at_corners = values.astype(np.float32)[triangles[self.owner]]
        weights = self.weights if values.ndim == 1 else self.weights[..., None]
        return (at_corners * weights).sum(1)

    def picture(self, colours: np.ndarray) -> np.ndarray:
        """(size, size, 3) bytes; the empty pixels take the nearest colour, so that seams never show."""
        image = np.zeros((self.size, self.size, 3), np.uint8)
        image[self.covered] = (np.clip(colours, 0, 1) * 255).astype(np.uint8)
        nearest = distance_transform_edt(~self.covered, return_distances=False, return_indices=True)
        return image[tuple(nearest)]
