"""What a fit gives back: the person's rig, the weights found, and how well it explains the examples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.rig import Rig


@dataclass(frozen=True)
class Iteration:
    """One turn of steps A and B: what they were weighed by, and the error after it.

    alpha, lambda_  regularisation of steps A and B, lambda_ in percent (see `example_based`)
    rms_percent     root mean square distance to the examples, in percent of the neutral's diagonal
    """

    alpha: float
    lambda_: float
    rms_percent: float


@dataclass(frozen=True, eq=False)
class Example:
    """How one example came out.

    weights    shape name -> weight, those that are not 0
    offsets    (V, 3) float32, the example, put where the neutral is, less the rig in these weights, target's
               unit
    """

    name: str
    weights: Mapping[str, float]
    offsets: Float32
    diagonal: float

    @property
    def distances(self) -> Float64:
        """How far each vertex is off, (V,)."""
        return np.asarray(np.linalg.norm(self.offsets.astype(np.float64), axis=1))

    @property
    def rms(self) -> float:
        """Root mean square distance in the target's unit."""
        return float(np.sqrt(np.mean(self.distances**2)))

    @property
    def largest(self) -> float:
        """Largest distance in the target's unit."""
        return float(self.distances.max(initial=0.0))

    @property
    def worst_percent(self) -> float:
        """What one vertex in five hundred is further off than, in percent of the neutral's diagonal.

        What no shape explains is small and stands out: a puffed cheek, not the whole face.
        """
        return 100.0 * float(np.percentile(self.distances, 99.8)) / self.diagonal

    @property
    def rms_percent(self) -> float:
        """Root mean square distance in percent of the neutral's diagonal."""
        return 100.0 * self.rms / self.diagonal

    @property
    def largest_percent(self) -> float:
        """Largest distance in percent of the neutral's diagonal."""
        return 100.0 * self.largest / self.diagonal


@dataclass(frozen=True, eq=False)
class FitResult:
    """A person's rig made from a template and examples.

    rig       all shapes of the template, for this person
    examples  one entry an example, in the order given
    history   one entry an iteration; empty where there were no examples
    seconds   time by stage: "transfer" and "fit"
    """

    rig: Rig
    examples: tuple[Example, ...] = ()
    history: tuple[Iteration, ...] = ()
    seconds: Mapping[str, float] = field(default_factory=dict)

    @property
    def weights(self) -> tuple[Mapping[str, float], ...]:
        """Each example's weights by shape, those that are not 0."""
        return tuple(example.weights for example in self.examples)

    @property
    def residuals(self) -> Float32:
        """How far each vertex of each example is off, (m, V), target's unit."""
        if not self.examples:
            return np.zeros((0, self.rig.neutral.vertex_count), np.float32)
        return np.stack([example.distances for example in self.examples]).astype(np.float32)
