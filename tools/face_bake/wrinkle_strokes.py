"""Where wrinkles run: across the direction in which the muscle below pulls.

Lines are points (s, y) of one side, in decimetres on the base head: s is the way around the head from the
middle of the face, about x in front; an outer corner of an eye sits at (0.50, 7.27), an alar wing at
(0.17, 6.88), a mouth corner at (0.27, 6.61), brows at 7.47.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Stroke:
    """A furrow, `width` to each side and of a `depth` 0..1, ending softly; skin bulges beside it.

    astray is how far it wanders from its line; `first` and `last` are how much of it fades in and out.
    """

    line: tuple
    width: float
    depth: float
    astray: float = 0.008
    first: float = 0.30
    last: float = 0.30


def _forehead() -> tuple[Stroke, ...]:
    """Frontalis pulls up: lines across, higher over the brows' middles, broken, finer between."""
    strokes = []
    for y, depth, reach, width in (
        (7.625, 0.42, 0.40, 0.0205),
        (7.705, 0.70, 0.50, 0.0250),
        (7.800, 0.66, 0.53, 0.0245),
        (7.890, 0.46, 0.46, 0.0220),
    ):
        arch = [(0.0, y - 0.022), (0.12, y), (0.26, y + 0.016), (0.40, y + 0.004), (reach, y - 0.034)]
        strokes.append(Stroke(tuple(arch), width, depth, 0.009, 0.0, 0.55))
    for s, y, length in ((0.06, 7.665, 0.15), (0.24, 7.755, 0.16), (0.10, 7.845, 0.14)):
        strokes.append(Stroke(((s, y), (s + 0.5 * length, y + 0.010), (s + length, y)), 0.0105, 0.38))
    return tuple(strokes)


FOREHEAD = _forehead()
# Corrugator pulls the brows together: short upright furrows between them, soft as folds are, with a
# shallow valley inside each brow's head; never quite alike.
FROWN = (
    Stroke(((0.082, 7.365), (0.071, 7.42), (0.068, 7.48), (0.080, 7.565)), 0.0200, 1.0, 0.005, 0.40, 0.60),
    Stroke(((0.128, 7.45), (0.124, 7.50), (0.136, 7.56)), 0.0170, 0.35, 0.005, 0.50, 0.60),
    Stroke(((0.110, 7.540), (0.165, 7.558), (0.23, 7.548)), 0.0210, 0.28, 0.006, 0.50, 0.60),
)
# Orbicularis oculi is a ring: its lines run out from the corner like spokes, and under the lid along it.
CROWS_FEET = (
    Stroke(((0.545, 7.325), (0.60, 7.375), (0.66, 7.440)), 0.0128, 0.52, 0.005, 0.2, 0.6),
    Stroke(((0.555, 7.290), (0.62, 7.310), (0.70, 7.345)), 0.0135, 0.71, 0.005, 0.2, 0.6),
    Stroke(((0.555, 7.255), (0.62, 7.245), (0.70, 7.235)), 0.0135, 0.75, 0.005, 0.2, 0.6),
    Stroke(((0.545, 7.220), (0.61, 7.185), (0.68, 7.140)), 0.0135, 0.64, 0.005, 0.2, 0.6),
    Stroke(((0.530, 7.190), (0.58, 7.140), (0.63, 7.075)), 0.0128, 0.45, 0.005, 0.2, 0.6),
    Stroke(((0.20, 7.200), (0.30, 7.160), (0.40, 7.165), (0.49, 7.205)), 0.0135, 0.45, 0.004),
    Stroke(((0.19, 7.165), (0.29, 7.115), (0.40, 7.115), (0.50, 7.150)), 0.0149, 0.34, 0.005),
    Stroke(((0.26, 7.070), (0.36, 7.060), (0.45, 7.085)), 0.0149, 0.19, 0.006),
)
# Levator labii alaeque nasi: across the bridge at the root, and slanting down its sides.
NOSE = (
    Stroke(((0.0, 7.335), (0.05, 7.340), (0.095, 7.358)), 0.0150, 0.55, 0.003, 0.0, 0.6),
    Stroke(((0.035, 7.275), (0.080, 7.235), (0.115, 7.175), (0.135, 7.110)), 0.0145, 0.55, 0.002, 0.4, 0.5),
    Stroke(((0.045, 7.205), (0.088, 7.160), (0.116, 7.100), (0.130, 7.040)), 0.0140, 0.50, 0.002, 0.4, 0.5),
    Stroke(((0.110, 7.260), (0.145, 7.205), (0.168, 7.140), (0.178, 7.070)), 0.0140, 0.40, 0.002, 0.4, 0.5),
)
# The cheek is pushed over the lip: one deep fold from the wing past the corner.
NASOLABIAL = (
    Stroke(
        ((0.190, 6.955), (0.225, 6.885), (0.290, 6.800), (0.340, 6.700), (0.352, 6.600), (0.340, 6.540)),
        0.0300, 0.60, 0.005, 0.45, 0.55,
    ),
    Stroke(((0.250, 6.900), (0.315, 6.810), (0.365, 6.710)), 0.0140, 0.22, 0.006, 0.4, 0.5),
)  # fmt: skip
# Crescents outside a corner that is drawn back.
SMILE = (
    Stroke(((0.395, 6.735), (0.415, 6.660), (0.410, 6.585), (0.385, 6.525)), 0.0180, 0.60, 0.006, 0.45, 0.45),
    Stroke(((0.455, 6.760), (0.478, 6.680), (0.470, 6.600)), 0.0210, 0.26, 0.006, 0.50, 0.50),
    Stroke(((0.302, 6.640), (0.312, 6.610), (0.306, 6.575)), 0.0090, 0.60, 0.002),
)
# From a corner that is drawn down.
MARIONETTE = (
    Stroke(((0.272, 6.612), (0.300, 6.535), (0.316, 6.440), (0.304, 6.320)), 0.0240, 0.40, 0.004, 0.10, 0.8),
)
# The crease between lower lip and chin; its boss is dimpled besides.
CHIN = (Stroke(((0.0, 6.437), (0.07, 6.432), (0.13, 6.405), (0.17, 6.36)), 0.0170, 0.75, 0.005, 0.0, 0.6),)
# Orbicularis oris closes like a purse: lines run out from the lips.
PURSE = tuple(
    Stroke(((s, 6.735 - 0.10 * s), (1.12 * s + 0.004, 6.810 - 0.14 * s)), 0.0075, depth, 0.003, 0.15, 0.6)
    for s, depth in ((0.022, 0.5), (0.062, 0.8), (0.098, 0.7), (0.136, 0.9), (0.172, 0.7), (0.206, 0.6))
)
