"""What fit, transfer and register tell of their work, as facts for JSON and in lines for people."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from facemorph.fit import FitResult
    from facemorph.fit.registration import Quality


def fit_facts(
    result: FitResult, wrapped: Mapping[str, Quality], seconds: Mapping[str, float]
) -> dict[str, Any]:
    """What `--json` tells of a fit."""
    from facemorph.fit.residual import unexplained

    rig, poor = result.rig, {example.name for example in unexplained(result)}
    return {
        "vertices": rig.neutral.vertex_count,
        "shapes": len(rig.shapes),
        "diagonal": rig.neutral.diagonal,
        "unit": rig.info.unit,
        "examples": [
            {
                "name": example.name,
                "rms": example.rms,
                "rms_percent": example.rms_percent,
                "largest": example.largest,
                "largest_percent": example.largest_percent,
                "unexplained": example.name in poor,
                "weights": {name: round(weight, 6) for name, weight in example.weights.items()},
            }
            for example in result.examples
        ],
        "history": [
            {"alpha": turn.alpha, "lambda": turn.lambda_, "rms_percent": turn.rms_percent}
            for turn in result.history
        ],
        "wrapped": {name: quality_facts(quality) for name, quality in wrapped.items()},
        "seconds": rounded(seconds),
        "peak_memory_mb": peak_memory_mb(),
    }


def fit_lines(facts: Mapping[str, Any]) -> list[str]:
    """The same for people, the folder last."""
    lines = []
    for name, quality in facts["wrapped"].items():
        lines += [f"{name} wrapped: {line}" for line in wrap_lines(quality)]
    for example in facts["examples"]:
        largest = sorted(example["weights"].items(), key=lambda item: -item[1])[:5]
        made = ", ".join(f"{name} {weight:.2f}" for name, weight in largest) or "no shape"
        lines.append(
            f"{example['name']}: off by {example['rms_percent']:.3f} % of the diagonal (largest "
            f"{example['largest_percent']:.2f} %); {made}"
            + ("; the template's shapes cannot make all of it" if example["unexplained"] else "")
        )
    lines.append(f"{facts['shapes']} shapes in {facts['seconds']['total']:.1f} s")
    return [*lines, facts["output"]]


def quality_facts(quality: Quality) -> dict[str, Any]:
    """How well a template lies on a scan."""
    return {
        "mean": quality.mean,
        "mean_percent": quality.mean_percent,
        "p95": quality.p95,
        "p95_percent": quality.p95_percent,
        "largest": quality.largest,
        "largest_percent": quality.largest_percent,
        "judged_percent": quality.judged_percent,
        "flipped": len(quality.flipped),
        "crossed": len(quality.crossed),
        "triangles": quality.triangles,
    }


def wrap_lines(facts: Mapping[str, Any]) -> list[str]:
    """The same for people, the file last where there is one."""
    lines = [
        f"from the scan's surface {facts['mean_percent']:.4f} % of the diagonal on average, 95 % of the "
        f"vertices within {facts['p95_percent']:.3f} %, the largest {facts['largest_percent']:.2f} %; "
        f"the scan has surface under {facts['judged_percent']:.0f} % of the skin",
        f"{facts['flipped']:,} of {facts['triangles']:,} triangles flipped, {facts['crossed']:,} vertices "
        "through a lip or lid",
    ]
    return [*lines, facts["output"]] if "output" in facts else lines


def rounded(seconds: Mapping[str, float]) -> dict[str, float]:
    """Times by stage, to the millisecond."""
    return {stage: round(value, 3) for stage, value in seconds.items()}


def peak_memory_mb() -> float | None:
    """The most memory this process had, in MB; None where the system does not say."""
    try:
        import resource
    except ImportError:
        return None
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # Linux counts in kilobytes, macOS in bytes.
    return round(most / (2**20 if sys.platform == "darwin" else 2**10), 1)
