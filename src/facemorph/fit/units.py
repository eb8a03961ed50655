"""In which unit a person's meshes are: heads are alike in size, so their size tells it."""

from __future__ import annotations

MM_PER = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
# Heads differ in size by so much at most; sizes further apart are told in another unit.
_ALIKE = 1.3


def unit_of(template_unit: str, scale: float) -> str:
    """The unit of a head that is `scale` times smaller than a template in a unit: mm, cm, m, in, or ""."""
    size = MM_PER.get(template_unit, 0.0) * scale
    fitting = {unit: max(size / mm, mm / size) for unit, mm in MM_PER.items()} if size > 0.0 else {}
    best = min(fitting, key=lambda unit: fitting[unit], default="")
    return best if best and fitting[best] <= _ALIKE else ""
