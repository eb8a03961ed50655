"""What describes a haircut: where the hair parts, how it falls, how full it is, and which locks break it up.

A haircut is a sheet of hair around the skull (`hair_shell.py`) and locks along it (`hair_locks.py`).
Columns of the sheet run from the parting (or the crown) to the tips; their place c goes from 0 at the
face's left over the back of the head (0.5) to 1 at the face's right.
"""

from dataclasses import dataclass
from itertools import pairwise

# Elevation of the hairline by azimuth from the front (0) to the nape (180), degrees around the skull.
WOMAN_LINE = (
    *((0, 22.5), (14, 23), (26, 21), (36, 18), (45, 9), (53, -2), (61, -10), (69, -18), (74, -22)),
    *((80, -12), (100, -14), (108, -28), (118, -40), (140, -47), (180, -50)),
)
MAN_LINE = (
    *((0, 24), (12, 25), (24, 24), (33, 18), (42, 10), (50, 2), (57, -5), (64, -14), (69, -27), (81, -31)),
    *((86, -12), (100, -14), (108, -28), (118, -40), (140, -48), (180, -52)),
)
RECEDING_LINE = (
    *((0, 31), (8, 32), (16, 38), (25, 43), (33, 40), (40, 27), (47, 13), (54, 2), (60, -6), (66, -16)),
    *((71, -27), (81, -30), (86, -12), (100, -14), (108, -28), (118, -40), (140, -48), (180, -52)),
)
# Sideburns that end at the ear's top.
FADE_LINE = (
    *((0, 24), (12, 25), (24, 24), (33, 18), (42, 10), (50, 2), (57, -4), (64, -10), (69, -16), (81, -18)),
    *((86, -12), (100, -14), (108, -28), (118, -40), (140, -48), (180, -52)),
)
# By so many degrees the two ends of a sheet that goes all around reach over each other.
OVERLAP = 4.0


@dataclass(frozen=True)
class Locks:
    """Locks that are alike; pairs are ranges that a lock's own value is drawn from.

    share: of the locks of their kind; c, t: where on the sheet the lock begins; reach: how far on it goes,
    in t, where negative runs towards the parting; root_lift, tip_lift: above the sheet, dm; width: dm;
    drift: sideways in c; wave: how far it swings, dm; roll: degrees about its own line; fall: how much its
    free end hangs, dm.
    """

    share: float
    c: tuple
    t: tuple
    reach: tuple
    root_lift: tuple = (0.004, 0.015)
    tip_lift: tuple = (0.005, 0.03)
    width: tuple = (0.16, 0.26)
    drift: tuple = (-0.02, 0.02)
    wave: tuple = (0.0, 0.01)
    roll: tuple = (-5, 5)
    fall: tuple = (0.0, 0.0)


@dataclass(frozen=True)
class Texture:
    """How strands are painted: wave 0..1 or, with curl, coils of so many pixels' radius.

    contrast: between strands; ragged: share of the sheet in which its tips end; strand: how much of the
    sheet's length a strand is long; gloss: how much it shines; cover: opacity of the sheet between strands;
    density: of the strands in locks.
    """

    wave: float = 0.3
    curl: float = 0.0
    contrast: float = 1.0
    ragged: float = 0.10
    strand: float = 1.0
    gloss: float = 1.0
    cover: float = 1.0
    density: float = 1.0


@dataclass(frozen=True)
class Style:
    """parting: pairs (x in dm, angle over the head: 0 the front, 90 the top, 180 the back), front to back.

    columns: rows (c, place on the parting 0..1, azimuth, elevation of the tip or of where the hair starts
    to hang, height of the tips or 0 for hair that does not hang, fullness in dm).
    profile: pairs (t, share of the fullness); lumps: unevenness in dm and its frequency per dm; under: how
    far the ends of hanging hair turn in, dm; gap: how far the halves of the parting stand apart, dm; ball:
    the radius that a head of coils is grown to, dm, or 0; taper: pairs (azimuth, t from where on it thins).
    body, wisps: locks, from the innermost to the outermost; texture: how the strands are painted.
    hairline: pairs (azimuth, elevation) on the scalp, which hair grows inside of; soft: pairs (azimuth,
    degrees that it takes to close); scalp: how much of the skin it then covers.
    """

    parting: tuple
    columns: tuple
    profile: tuple
    lumps: tuple
    body: tuple
    wisps: tuple
    hairline: tuple
    under: float = 0.0
    gap: float = 0.004
    ball: float = 0.0
    taper: tuple = ((0, 1.0), (180, 1.0))
    soft: tuple = ((0, 8.0), (180, 8.0))
    scalp: float = 0.96
    texture: Texture = Texture()


def between(pairs: tuple, at: float) -> float:
    """Piecewise linear."""
    for (a, low), (b, high) in pairwise(pairs):
        if at <= b:
            return low + (high - low) * max(at - a, 0) / (b - a)
    return pairs[-1][1]


def cropped(line: tuple, beyond: tuple, fullness: tuple, along: tuple, steps: int = 48) -> tuple:
    """Columns all around whose tips lie at the hairline.

    beyond: pairs (azimuth, degrees that tips reach over the hairline); fullness: pairs (azimuth, dm);
    along: pairs (azimuth, place on the parting).
    """
    rows = []
    for k in range(steps + 1):
        # The last column reaches a little over the first, or skin would show between the two.
        azimuth = -OVERLAP + (360 + 2 * OVERLAP) * k / steps
        a = abs(min(azimuth, 360 - azimuth))
        elevation = between(line, a) - between(beyond, a)
        rows.append((k / steps, between(along, a), azimuth, elevation, 0, between(fullness, a)))
    return tuple(rows)
