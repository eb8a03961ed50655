"""The heat map's colours and legend: how far each vertex is from neutral, in a unit people know."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64, UInt8

# Stops of the ramp in OKLab's polar form: place, lightness, chroma, hue in degrees. From a quiet blue
# over green and yellow to red: hue tells the value even where light and shadow change the lightness.
_STOPS = (
    (0.00, 0.64, 0.070, 250.0),
    (0.22, 0.74, 0.100, 205.0),
    (0.45, 0.83, 0.150, 135.0),
    (0.65, 0.85, 0.160, 92.0),
    (0.82, 0.70, 0.180, 50.0),
    (1.00, 0.52, 0.205, 25.0),
)
_MM_PER = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4, "in": 25.4}
_NICE = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@dataclass(frozen=True, eq=False)
class Legend:
    """What a heat map's colours mean, for whoever draws it.

    title    what is measured: "Displacement" from neutral, or "Difference" from another surface
    unit     "mm", or "model units" where the face names no unit
    ticks    (place 0..1 along the bar, text) from the low end to the high
    colours  (n, 3) uint8 sRGB from the low end to the high
    high     distance at the high end in model units
    """

    title: str
    unit: str
    ticks: tuple[tuple[float, str], ...]
    colours: UInt8
    high: float


DISPLACEMENT, DIFFERENCE = "Displacement", "Difference"


def heat_legend(high: float, unit: str, title: str = DISPLACEMENT) -> Legend:
    """The legend of a map that ends at `high` model units, for a face measured in `unit` ("cm", or "")."""
    scale = _MM_PER.get(unit.casefold(), 1.0)
    shown_unit = "mm" if unit.casefold() in _MM_PER else "model units"
    end = high * scale
    step = _tick_step(end)
    values = [step * i for i in range(int(end / step + 1e-6) + 1)]
    ticks = tuple((value / end, _plain(value, step)) for value in values)
    return Legend(title, shown_unit, ticks, ramp(), high)


def nice_above(value: float) -> float:
    """The smallest round number (1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten) not below `value` > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return next((power * nice for nice in _NICE if power * nice >= value * (1.0 - 1e-6)), power * 10.0)


def heat_end(largest: float, unit: str, diagonal: float) -> float:
    """Where an automatic map ends, model units: the largest displacement rounded up in the shown unit.

    A face at rest gets a hundredth of its diagonal, so that the legend has something to say.
    """
    scale = _MM_PER.get(unit.casefold(), 1.0)
    value = largest if largest > diagonal * 1e-5 else diagonal * 0.01
    return nice_above(max(value, 1e-30) * scale) / scale


def ramp(count: int = 256) -> UInt8:
    """The colours from 0 to the end, (count, 3) uint8 sRGB."""
    place = np.linspace(0.0, 1.0, count)
    stops = np.array(_STOPS)
    hue = np.radians(stops[:, 3])
    a, b = stops[:, 2] * np.cos(hue), stops[:, 2] * np.sin(hue)
    lab = np.stack([np.interp(place, stops[:, 0], axis) for axis in (stops[:, 1], a, b)], axis=1)
    return (_srgb_from_oklab(lab) * 255.0 + 0.5).astype(np.uint8)


def _srgb_from_oklab(lab: Float64) -> Float64:
    """OKLab (n, 3) to sRGB 0..1 (Ottosson 2020, "A perceptual color space for image processing")."""
    roots = lab @ np.array(
        [
            [1.0, 1.0, 1.0],
            [0.3963377774, -0.1055613458, -0.0894841775],
            [0.2158037573, -0.0638541728, -1.2914855480],
        ]
    )
    linear = roots**3 @ np.array(
        [
            [4.0767416621, -1.2684380046, -0.0041960863],
            [-3.3077115913, 2.6097574011, -0.7034186147],
            [0.2309699292, -0.3413193965, 1.7076147010],
        ]
    )
    linear = np.clip(linear, 0.0, 1.0)
    encoded: Float64 = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return encoded


def _tick_step(end: float) -> float:
    """A round step that gives four to six ticks."""
    power = 10.0 ** math.floor(math.log10(end))
    return next(power * s for s in (0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 2.5) if end / (power * s) <= 5.0 + 1e-6)


def _plain(value: float, step: float) -> str:
    """A tick's number with as many decimals as the step needs; very small or large ones by exponent."""
    if value == 0.0:
        return "0"
    if step < 1e-4 or value >= 1e6:
        return f"{value:.3g}"
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:.{decimals + 1}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
