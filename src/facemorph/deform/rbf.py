"""Radial basis functions: a few control points move, the whole face follows smoothly (thesis, 2.3).

Each coordinate of the displacement field is

    F(p) = sum_i a_i g(|p - x_i|) + c0 + c1 x + c2 y + c3 z                        (2.13)

with G A = F (2.14), G the (n + 4) square matrix of kernel values and the affine part, and the surface
moves by G' A (2.15). Everything but the control points' displacements depends on where the points are
alone, so M = G' G^-1 is formed once: a drag is the one product M h.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float32, Float64
from facemorph.errors import DeformError, OptionError

Kernel = Literal["r", "r3", "r5", "multiquadric"]
KERNELS: tuple[Kernel, ...] = get_args(Kernel)
# Control points nearer to each other than this part of their spread are one point to the solver.
COINCIDENT = 1e-6
# A condition number beyond which a solution in float64 has fewer than about three digits.
SINGULAR = 1e13
_CHUNK_ROWS = 2048
# Products of at most so many multiplications are not shared out to BLAS threads, which cost a drag ten
# times as much as the product itself as soon as another core is busy.
_ONE_THREAD_PRODUCT = 250_000


def checked_kernel(name: str) -> Kernel:
    """`name` as a `Kernel`. Raises `OptionError` naming the choices."""
    for kernel in KERNELS:
        if name == kernel:
            return kernel
    raise OptionError(f"no RBF kernel is called {name!r}. There are: {', '.join(KERNELS)}.")


class RbfField:
    """The field of n control points over V positions: bind once, call for every drag.

    points     (n, 3), where the control points rest, model units
    positions  (V, 3), the surface at rest
    kernel     r (biharmonic), r3 and r5 (polyharmonic), multiquadric: sqrt(r^2 + c^2)
    c          the multiquadric's shape in model units; None takes the mean distance to the nearest point

    exactly    keep the matrix in float64: twice the memory and the time of a drag

    Coordinates are centred and scaled before solving, in float64; the matrix is float32. Raises
    `DeformError` for fewer than four points, points in one plane, coincident points, or a system that
    cannot be solved.
    """

    def __init__(
        self,
        points: Float64,
        positions: Float32,
        kernel: Kernel = "r",
        c: float | None = None,
        *,
        exactly: bool = False,
    ) -> None:
        self.points = _checked_points(points)
        centre, scale = self.points.mean(axis=0), spread(self.points)
        local = (self.points - centre) / scale
        _refuse_coincident(local)
        shape = nearest_mean(local) if c is None else _checked_shape(c) / scale
        self.c = float(shape * scale)
        kernel_of = kernel_function(kernel, shape)
        inverse = inverted(system_of(local, kernel_of))[:, : len(local)]
        surface = (positions.astype(np.float64) - centre) / scale
        dtype = np.float64 if exactly else np.float32
        self.matrix = _evaluated(surface, local, kernel_of, inverse, dtype)

    def __call__(self, displacements: Float64) -> Float32:
        """Offsets (V, 3) for the control points' displacements (n, 3), model units (2.15)."""
        moves = np.ascontiguousarray(displacements, self.matrix.dtype)
        result: NDArray[Any] = np.empty((len(self.matrix), 3), self.matrix.dtype)
        rows = max(_ONE_THREAD_PRODUCT // max(moves.size, 1), 1)
        for start in range(0, len(result), rows):
            np.matmul(self.matrix[start : start + rows], moves, out=result[start : start + rows])
        return result


def kernel_function(kernel: Kernel, c: float) -> Callable[[Float64], Float64]:
    """g(r) of a kernel over arrays of distances; `c` is the multiquadric's alone."""
    powers = {"r": 1, "r3": 3, "r5": 5}
    if kernel in powers:
        power = powers[kernel]
        return lambda r: r**power
    return lambda r: np.sqrt(r * r + c * c)


def distances(a: Float64, b: Float64) -> Float64:
    """Distances between points a (m, 3) and b (n, 3), (m, n); by differences, so that equal points give 0."""
    squares = np.zeros((len(a), len(b)))
    apart = np.empty_like(squares)
    for axis in range(3):
        np.subtract(a[:, axis, None], b[None, :, axis], out=apart)
        np.multiply(apart, apart, out=apart)
        squares += apart
    return np.sqrt(squares, out=squares)


def system_of(points: Float64, kernel_of: Callable[[Float64], Float64]) -> Float64:
    """G of (2.14): [[g(|xi - xj|), 1 x y z], [its affine part transposed, 0]], (n + 4, n + 4)."""
    n = len(points)
    matrix = np.zeros((n + 4, n + 4))
    matrix[:n, :n] = kernel_of(distances(points, points))
    matrix[:n, n:] = np.c_[np.ones(n), points]
    matrix[n:, :n] = matrix[:n, n:].T
    return matrix


def inverted(system: Float64) -> Float64:
    """G^-1. Raises `DeformError` where the condition number is beyond `SINGULAR`."""
    try:
        inverse = np.asarray(np.linalg.inv(system), np.float64)
        condition = float(np.linalg.norm(system, 1) * np.linalg.norm(inverse, 1))
    except np.linalg.LinAlgError:
        condition = np.inf
    if not condition < SINGULAR:
        raise DeformError(
            "these control points make a system that cannot be solved: too near each other for this kernel. "
            "Move them apart, take some away, or choose the kernel r."
        )
    return inverse


def _evaluated(
    surface: Float64,
    points: Float64,
    kernel_of: Callable[[Float64], Float64],
    inverse: Float64,
    dtype: type[np.float32] | type[np.float64],
) -> NDArray[np.float32 | np.float64]:
    """G' G^-1 of (2.15), (V, n), in chunks so that memory stays bounded."""
    result: NDArray[np.float32 | np.float64] = np.empty((len(surface), len(points)), dtype)
    for start in range(0, len(surface), _CHUNK_ROWS):
        rows = surface[start : start + _CHUNK_ROWS]
        values = kernel_of(distances(rows, points)) @ inverse[:-4]
        values += rows @ inverse[-3:]
        values += inverse[-4]
        result[start : start + _CHUNK_ROWS] = values
    return result


def _checked_points(points: Float64) -> Float64:
    points = np.asarray(points, np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise DeformError(f"control points must be (n, 3) finite numbers, not {points.shape}.")
    if len(points) < 4:
        raise DeformError(f"RBF needs at least 4 control points, and there are {len(points)}.")
    centred = points - points.mean(axis=0)
    sizes = np.linalg.svd(centred, compute_uv=False)
    if sizes[2] < 1e-7 * sizes[0]:
        raise DeformError("the control points lie in one plane; put one more outside of it.")
    return points


def spread(points: Float64) -> float:
    """Root mean square distance of points (n, 3) from their middle."""
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))


def _refuse_coincident(local: Float64) -> None:
    apart = distances(local, local)
    np.fill_diagonal(apart, np.inf)
    i, j = np.unravel_index(int(np.argmin(apart)), apart.shape)
    if apart[i, j] < COINCIDENT:
        raise DeformError(
            f"control points {min(i, j) + 1} and {max(i, j) + 1} are at one place; take one away."
        )


def nearest_mean(local: Float64) -> float:
    """Mean distance of points (n, 3) to their nearest neighbour."""
    apart = distances(local, local)
    np.fill_diagonal(apart, np.inf)
    return float(apart.min(axis=1).mean())


def _checked_shape(c: float) -> float:
    if not (np.isfinite(c) and c >= 0.0):
        raise OptionError(f"the multiquadric's c is a length of 0 or more, not {c}.")
    return float(c)
