"""The reference formulas of morphing; `shaders/lib/morph.glsl` carries the same names.

Every linear way to move a face ends here: coefficients (K,) over K deltas, one weighted sum.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.errors import OptionError

Curve = Literal["linear", "cosine"]
CURVES: tuple[Curve, ...] = get_args(Curve)


def checked_curve(name: str) -> Curve:
    """`name` as a `Curve`. Raises `OptionError` naming the choices."""
    for curve in CURVES:
        if name == curve:
            return curve
    raise OptionError(f"no easing curve is called {name!r}. There are: {', '.join(CURVES)}.")


def eased(t: float, curve: Curve) -> float:
    """Position on the way from source to target after easing.

    linear: t (2.5). cosine: (1 - cos(pi t)) / 2 for 0 <= t <= 1 (thesis, 2.1, after Parke 1972).
    Outside 0..1 the cosine would turn back, so there it goes on as t does, which keeps it monotonic
    and continuous.
    """
    if curve == "linear" or not 0.0 <= t <= 1.0:
        return t
    return float(0.5 - 0.5 * np.cos(np.pi * t))


def mixed_coefficients(
    source: Float64, target: Float64, added: Float64, t: float, curve: Curve = "linear"
) -> Float64:
    """Coefficients (K,) on the way from `source` to `target`, plus what other controls add, each (K,).

    c_k = (1 - e) source_k + e target_k + added_k with e = eased(t), which is (2.5) written on
    coefficients: both end states are sums over the same deltas.
    """
    e = eased(t, curve)
    return (1.0 - e) * source + e * target + added


def morphed_positions(neutral: Float32, deltas: Float32, coefficients: Float64) -> Float32:
    """positions = neutral + sum_k c_k delta_k. neutral (V, 3), deltas (K, V, 3), coefficients (K,) -> (V, 3).

    Sums in float64: this is what the GLSL and the fast paths are measured against.
    """
    active = np.flatnonzero(coefficients)
    total = neutral.astype(np.float64)
    for k in active:
        total += float(coefficients[k]) * deltas[k].astype(np.float64)
    return total.astype(np.float32)
