"""A rig's correctives as rows of texels, from which `shaders/lib/morph.glsl` works out their weights.

A row's first texel is (number of factors, layer of the shape, 0, 0); then come two for each factor: the
source, target and added weight of the shape that it follows with 1 for a hat and 0 for a product, and
the hat's (start, peak, end, 0).
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.correctives import Corrective
from facemorph.core.rig import Rig


def row_width(rig: Rig) -> int:
    """Texels that the longest rule takes."""
    return 1 + 2 * max((len(rule.drivers) for rule in rig.correctives), default=0)


def rule_rows(rig: Rig, weights: Float64) -> list[tuple[int, Float32]]:
    """The shape and the row (row_width, 4) of each rule that may be on.

    weights   (K, 3) source, target and added weight of each shape; a rule over one that has none is off
    """
    if not rig.corrected:
        return []
    index = {name: k for k, name in enumerate(rig.names)}
    width = row_width(rig)
    return [
        (index[rule.shape], _row(rule, index, weights, width))
        for rule in rig.correctives
        if all(weights[index[name]].any() for name in rule.drivers)
    ]


def _row(rule: Corrective, index: dict[str, int], weights: Float64, width: int) -> Float32:
    row = np.zeros((width, 4), np.float32)
    row[0, 0] = len(rule.drivers)
    factors = [(name, None) for name in rule.product] + [(hat.over, hat) for hat in rule.hats]
    for place, (name, hat) in enumerate(factors):
        row[1 + 2 * place, :3] = weights[index[name]]
        if hat is not None:
            row[1 + 2 * place, 3] = 1.0
            row[2 + 2 * place, :3] = hat.start, hat.peak, hat.end
    return row
