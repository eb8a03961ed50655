"""The choice of an RBF kernel."""

from __future__ import annotations

from imgui_bundle import imgui

from facemorph.core.rig import Rig
from facemorph.deform.rbf import KERNELS, Kernel
from facemorph.ui.panels.rows import divider
from facemorph.ui.panels.value_rows import Value, switch_row, unit_words, value_row
from facemorph.ui.state import App
from facemorph.ui.widgets import tab_chips, tooltip

KERNEL_WORDS: dict[Kernel, str] = {"r": "r", "r3": "r^3", "r5": "r^5", "multiquadric": "√(r²+c²)"}
KERNEL_TIPS: dict[Kernel, str] = {
    "r": "Biharmonic, g(r) = r: calm far from the points; the usual choice (2.13)",
    "r3": "Polyharmonic, g(r) = r^3: smoother between the points, swings further beyond them (2.13)",
    "r5": "Polyharmonic, g(r) = r^5: smoother still, and wild far from the points (2.13)",
    "multiquadric": "Multiquadric, g(r) = √(r² + c²): c rounds the field off near the points (2.13)",
}


def kernel_rows(app: App, rig: Rig, key: str, kernel: Kernel, c: float | None) -> tuple[Kernel, float | None]:
    """The choice of kernel, and c where it is the multiquadric; None is c by the points' own distance."""
    imgui.push_id(key)
    divider(app, "Kernel g(r)")
    tooltip("How a point's motion fades with the distance r from it (2.13)")
    words = tuple((KERNEL_WORDS[name], KERNEL_TIPS[name]) for name in KERNELS)
    chosen = tab_chips(app, words, KERNEL_WORDS[kernel])
    kernel = next(name for name in KERNELS if KERNEL_WORDS[name] == chosen)
    if kernel == "multiquadric":
        c = _c_rows(app, rig, key, c)
    imgui.pop_id()
    return kernel, c


def _c_rows(app: App, rig: Rig, key: str, c: float | None) -> float | None:
    tip = "c as long as the mean distance from a point to its nearest neighbour"
    automatic = switch_row(app, "c by the points' distance", c is None, tip)
    if automatic:
        return None
    largest = round(rig.neutral.diagonal / 4.0, 1) or 1.0
    value = largest / 10.0 if c is None else c
    row = Value(
        f"{key} c", f"c, {unit_words(rig)}", value, 0.0, largest, "0 gives the kernel r", largest / 10
    )
    return value_row(app, row)
