"""A person's own blendshapes: transferred from a template, fitted to examples, wrapped on scans.

result = facemorph.fit.example_based(template, neutral, {"smile": smile}, [{"mouthSmileLeft": 0.8}])
result.rig, result.weights, result.residuals, result.history
"""

from facemorph.fit.example_based import example_based, transfer
from facemorph.fit.residual import unexplained, with_residual
from facemorph.fit.result import Example, FitResult, Iteration

__all__ = [
    "Example",
    "FitResult",
    "Iteration",
    "example_based",
    "transfer",
    "unexplained",
    "with_residual",
]
