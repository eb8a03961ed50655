"""Between two people: the bilinear interpolation of shapes and expressions (thesis, 2.2, after Arai 1996).

    P = s1 (t1 Q11 + t2 Q12) + s2 (t1 Q21 + t2 Q22),   s1 + s2 = t1 + t2 = 1        (2.10)

Q_ij is person i with expression j. A person's face is linear in its coefficients, so t lives in the
pose, which all people share, and s lives here: a mixture of people, each with a weight, summing to 1.
Choosing a new expression (2.11)-(2.12) re-bases the pose; choosing a new person re-bases the mixture in
the same way: what is shown becomes the source, the new person the goal, s starts at 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.correctives import CORRECTIVE
from facemorph.core.correspondence import difference
from facemorph.core.facs import Sides
from facemorph.core.rig import Rig
from facemorph.deform.sides import SidedUnits
from facemorph.errors import CorrespondenceError, UnknownNameError


@dataclass(frozen=True)
class PeopleMix:
    """From a mixture of people to one person. Names are the caller's (built-in names, folders)."""

    source: Mapping[str, float]
    target: str
    s: float = 0.0

    def weights(self) -> dict[str, float]:
        """Each person's weight at the present s; they sum to 1."""
        names = dict.fromkeys([*self.source, self.target])
        mixed = {n: (1.0 - self.s) * self.source.get(n, 0.0) + (n == self.target) * self.s for n in names}
        return {name: weight for name, weight in mixed.items() if weight != 0.0}

    def rebased(self, target: str) -> PeopleMix:
        """The mixture shown becomes the source and `target` the goal, s = 0: no jump (2.11)."""
        return PeopleMix(self.weights(), target)

    def at(self, s: float) -> PeopleMix:
        """The same way at another s."""
        return replace(self, s=s)


class People:
    """Rigs of one topology, the first of which is the one that is drawn: bind once, call for every change.

    Raises `CorrespondenceError` where a rig's neutral does not correspond to the first's.
    """

    def __init__(self, rigs: Mapping[str, Rig]) -> None:
        self._rigs = dict(rigs)
        self._base = next(iter(self._rigs.values()))
        for name, rig in self._rigs.items():
            unlike = None if rig is self._base else difference(self._base.neutral, rig.neutral)
            if unlike is not None:
                hint = "Only faces of one topology can be mixed; the built-in people are."
                raise CorrespondenceError(name, unlike.problem, cause=unlike.cause, hint=hint)
        self._units: dict[int, SidedUnits] = {}
        self._index = {n: {s: k for k, s in enumerate(rig.names)} for n, rig in self._rigs.items()}

    def offsets(self, weights: Mapping[str, float], coefficients: Float64) -> Float32:
        """What the mixture adds to the first rig in a pose, (V, 3) float32.

        sum_i s_i (N_i + sum_k c_k delta_ik) - (N_1 + sum_k c_k delta_1k); `coefficients` (K,) are over the
        first rig's shapes. Raises `UnknownNameError` for a person or a moving shape that is not there.
        """
        active = [(self._base.names[k], float(coefficients[k])) for k in np.flatnonzero(coefficients)]
        total = np.zeros(self._base.neutral.positions.shape)
        for name, weight in weights.items():
            rig = self._rig(name)
            if rig is self._base:
                continue
            total += weight * (rig.neutral.positions - self._base.neutral.positions)
            for shape, coefficient in active:
                total += weight * coefficient * self._delta_difference(name, shape)
        return total.astype(np.float32)

    def sided_offsets(self, weights: Mapping[str, float], units: Mapping[int, Sides]) -> Float32:
        """What one-sided units add beyond the first rig's own, (V, 3): each person's sides of own units.

        sum_i s_i (u_i - u_1) with u_i person i's offsets of the units whose sides differ.
        """
        total = np.zeros(self._base.neutral.positions.shape)
        own = self._sided(self._base, units)
        for name, weight in weights.items():
            if self._rig(name) is not self._base:
                total += weight * (self._sided(self._rig(name), units) - own)
        return total.astype(np.float32)

    def _sided(self, rig: Rig, units: Mapping[int, Sides]) -> Float64:
        key = id(rig)
        if key not in self._units:
            self._units[key] = SidedUnits(rig)
        offsets = self._units[key](units).offsets
        shape = rig.neutral.positions.shape
        return np.zeros(shape) if offsets is None else offsets.astype(np.float64)

    def _delta_difference(self, name: str, shape: str) -> Float32:
        places, own = self._index[name], self._base.names.index(shape)
        if shape in places:
            difference_of_deltas: Float32 = self._rigs[name].deltas[places[shape]] - self._base.deltas[own]
            return difference_of_deltas
        # Whoever has no correctives moves straight: there is nothing of theirs to mix in.
        if self._base.shapes[own].set == CORRECTIVE:
            straight: Float32 = -self._base.deltas[own]
            return straight
        raise UnknownNameError(f"shape of {name}", shape, places)

    def _rig(self, name: str) -> Rig:
        if name not in self._rigs:
            raise UnknownNameError("person", name, self._rigs)
        return self._rigs[name]


def bilinear(key_frames: Sequence[Sequence[Float32]], s: float, t: float) -> Float32:
    """(2.10) as written; key_frames[i][j] (V, 3) is person i with expression j. The truth for `People`."""
    first, second = (
        (1.0 - t) * left.astype(np.float64) + t * right.astype(np.float64) for left, right in key_frames
    )
    mixed: Float64 = (1.0 - s) * first + s * second
    return mixed.astype(np.float32)
