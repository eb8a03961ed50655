"""The haircuts: where the hair of each parts, how it falls, how full it is, and which locks break it up.

A haircut is a sheet of hair around the skull (`hair_shell.py`) and locks along it (`hair_locks.py`).
Columns of the sheet run from the parting (or the crown) to the tips; their place c goes from 0 at the
face's left over the back of the head (0.5) to 1 at the face's right.
"""

from dataclasses import dataclass

# Elevation of the hairline by azimuth from the front (0) to the nape (180), degrees around the skull.
WOMAN_LINE = (
    *((0, 22.5), (14, 23), (26, 21), (36, 14), (45, 5), (53, -4), (61, -10), (69, -18), (74, -22)),
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
OVERLAP = 4.0


@dataclass(frozen=True)
class Locks:
    """Locks that are alike; pairs are ranges that a lock's own value is drawn from.

    share: of the locks of their kind; c, t: where on the sheet the lock begins; reach: how far on it goes, in t, where negative runs towards
    the parting; lift: above the sheet at root and tip, dm; width: dm; drift: sideways in c;
    wave: how far it swings, dm; roll: degrees about its own line; fall: how much its free end hangs, dm.
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
    sheet's length a strand is long; gloss: how much it shines.
    """

    wave: float = 0.3
    curl: float = 0.0
    contrast: float = 1.0
    ragged: float = 0.10
    strand: float = 1.0
    gloss: float = 1.0


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
    soft: tuple = ((0, 5.0), (180, 5.0))
    scalp: float = 0.96
    texture: Texture = Texture()


def between(pairs: tuple, at: float) -> float:
    """Piecewise linear."""
    for (a, low), (b, high) in zip(pairs, pairs[1:], strict=False):
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


SIDE_PART = Style(
    parting=((0.28, 25), (0.27, 45), (0.22, 75), (0.10, 115)),
    columns=(
        (0.00, 0.00, 52, -4, 6.06, 0.022),
        (0.05, 0.03, 62, -4, 6.02, 0.075),
        (0.20, 0.40, 98, -4, 5.97, 0.120),
        (0.35, 0.90, 140, -4, 5.95, 0.130),
        (0.50, 1.00, 180, -4, 5.94, 0.135),
        (0.64, 0.90, 220, -4, 5.95, 0.130),
        (0.80, 0.42, 262, -4, 5.97, 0.125),
        (0.90, 0.08, 290, -4, 6.02, 0.115),
        (0.97, 0.02, 303, -4, 6.06, 0.070),
        (1.00, 0.00, 309, -4, 6.10, 0.022),
    ),
    profile=((0, 0.55), (0.12, 0.82), (0.28, 1.0), (0.6, 1.0), (1.0, 0.9)),
    lumps=(0.016, 3.0),
    under=0.10,
    body=(
        Locks(62, (0.03, 0.97), (0.02, 0.30), (0.62, 0.80), wave=(0.01, 0.03), width=(0.20, 0.34)),
        Locks(48, (0.03, 0.97), (0.45, 0.62), (0.38, 0.52), wave=(0.01, 0.04), width=(0.18, 0.30)),
    ),
    wisps=(
        Locks(
            16,
            (0.0, 0.06),
            (0.0, 0.25),
            (0.6, 0.9),
            wave=(0.01, 0.05),
            width=(0.10, 0.22),
            drift=(-0.02, 0.015),
        ),
        Locks(
            24,
            (0.93, 1.0),
            (0.0, 0.25),
            (0.6, 0.9),
            wave=(0.01, 0.05),
            width=(0.10, 0.22),
            drift=(-0.015, 0.02),
        ),
        Locks(
            17,
            (0.0, 1.0),
            (0.0, 0.5),
            (0.4, 0.6),
            tip_lift=(0.02, 0.05),
            wave=(0.02, 0.05),
            width=(0.14, 0.24),
        ),
    ),
    hairline=WOMAN_LINE,
    texture=Texture(wave=0.5),
)
FRINGE_BOB = Style(
    parting=((0.0, 78), (0.0, 92), (0.0, 106)),
    columns=(
        (0.00, 0.00, -5, -6, 7.53, 0.085),
        (0.09, 0.00, 32, -6, 7.53, 0.085),
        (0.115, 0.02, 40, -6, 7.50, 0.060),
        (0.14, 0.06, 50, -4, 6.42, 0.050),
        (0.17, 0.15, 60, -4, 6.36, 0.075),
        (0.27, 0.50, 95, -4, 6.32, 0.105),
        (0.50, 1.00, 180, -4, 6.26, 0.125),
        (0.73, 0.50, 265, -4, 6.32, 0.105),
        (0.83, 0.15, 300, -4, 6.36, 0.075),
        (0.86, 0.06, 310, -4, 6.42, 0.050),
        (0.885, 0.02, 320, -6, 7.50, 0.060),
        (0.91, 0.00, 328, -6, 7.53, 0.085),
        (1.00, 0.00, 365, -6, 7.53, 0.085),
    ),
    profile=((0, 0.55), (0.12, 0.95), (0.35, 1.1), (0.8, 1.0), (1.0, 0.75)),
    lumps=(0.008, 3.0),
    under=0.16,
    body=(
        Locks(50, (0.15, 0.85), (0.02, 0.30), (0.64, 0.72), width=(0.22, 0.36)),
        Locks(30, (0.15, 0.85), (0.50, 0.60), (0.38, 0.42), width=(0.20, 0.30)),
        Locks(30, (-0.0, 0.11), (0.25, 0.5), (0.48, 0.58), width=(0.16, 0.26), drift=(-0.006, 0.006)),
    ),
    wisps=(
        Locks(26, (0.89, 1.0), (0.25, 0.5), (0.48, 0.58), width=(0.14, 0.24), drift=(-0.006, 0.006)),
        Locks(10, (0.10, 0.16), (0.2, 0.5), (0.5, 0.6), width=(0.12, 0.2), drift=(-0.004, 0.004)),
        Locks(10, (0.84, 0.90), (0.2, 0.5), (0.5, 0.6), width=(0.12, 0.2), drift=(-0.004, 0.004)),
        Locks(19, (0.0, 1.0), (0.0, 0.6), (0.35, 0.4), tip_lift=(0.01, 0.03), width=(0.14, 0.22)),
    ),
    hairline=WOMAN_LINE,
    texture=Texture(wave=0.12, contrast=0.8, ragged=0.05),
)
QUIFF = Style(
    parting=((0.05, 112), (0.04, 120), (0.03, 128)),
    columns=cropped(
        MAN_LINE,
        ((0, -1), (45, 0), (60, 0), (70, -16), (80, -20), (86, 0), (108, -4), (180, -9)),
        ((0, 0.19), (30, 0.17), (46, 0.09), (60, 0.042), (90, 0.036), (130, 0.050), (180, 0.055)),
        ((0, 0), (60, 0.2), (120, 0.8), (180, 1)),
    ),
    profile=((0, 0.7), (0.25, 0.9), (0.6, 1.0), (0.82, 1.1), (0.93, 0.8), (1.0, 0.15)),
    lumps=(0.030, 5.0),
    gap=0.002,
    body=(
        Locks(30, (0.14, 0.86), (0.05, 0.45), (0.25, 0.4), tip_lift=(0.01, 0.03), width=(0.2, 0.3)),
        Locks(
            40,
            (0.0, 0.13),
            (0.45, 0.95),
            (-0.36, -0.24),
            tip_lift=(0.03, 0.07),
            drift=(0.0, 0.05),
            wave=(0, 0.02),
        ),
        Locks(
            40,
            (0.87, 1.0),
            (0.45, 0.95),
            (-0.36, -0.24),
            tip_lift=(0.03, 0.07),
            drift=(0.0, 0.05),
            wave=(0, 0.02),
        ),
    ),
    wisps=(
        Locks(
            18,
            (0.0, 0.12),
            (0.86, 1.0),
            (-0.26, -0.16),
            tip_lift=(0.03, 0.08),
            drift=(0.0, 0.03),
            width=(0.12, 0.2),
        ),
        Locks(
            18,
            (0.88, 1.0),
            (0.86, 1.0),
            (-0.26, -0.16),
            tip_lift=(0.03, 0.08),
            drift=(0.0, 0.03),
            width=(0.12, 0.2),
        ),
        Locks(29, (0.14, 0.86), (0.6, 0.8), (0.18, 0.22), tip_lift=(0.0, 0.012), width=(0.14, 0.24)),
    ),
    hairline=MAN_LINE,
    taper=((0, 0.95), (40, 0.8), (60, 0.45), (180, 0.5)),
    soft=((0, 6), (60, 8), (90, 14), (180, 18)),
    texture=Texture(wave=0.5, contrast=1.15, ragged=0.35, strand=0.3),
)
RECEDING = Style(
    parting=((0.0, 70), (0.0, 95), (0.0, 125)),
    columns=cropped(
        RECEDING_LINE,
        ((0, 0), (60, 0), (70, -16), (80, -20), (86, 0), (108, -4), (180, -9)),
        ((0, 0.075), (30, 0.065), (48, 0.045), (62, 0.035), (90, 0.034), (130, 0.045), (180, 0.05)),
        ((0, 0), (60, 0.3), (120, 0.8), (180, 1)),
    ),
    profile=((0, 1.0), (0.6, 1.0), (0.85, 0.6), (1.0, 0.14)),
    lumps=(0.012, 4.0),
    body=(
        Locks(50, (0.0, 0.13), (0.95, 0.55), (-0.5, -0.3), tip_lift=(0.005, 0.03)),
        Locks(50, (0.87, 1.0), (0.95, 0.55), (-0.5, -0.3), tip_lift=(0.005, 0.03)),
        Locks(10, (0.12, 0.88), (0.05, 0.45), (0.25, 0.4), tip_lift=(0.01, 0.02), width=(0.2, 0.3)),
    ),
    wisps=(
        Locks(20, (0.0, 0.11), (1.0, 0.9), (-0.3, -0.2), tip_lift=(0.01, 0.03), width=(0.14, 0.22)),
        Locks(20, (0.89, 1.0), (1.0, 0.9), (-0.3, -0.2), tip_lift=(0.01, 0.03), width=(0.14, 0.22)),
        Locks(25, (0.14, 0.86), (0.6, 0.8), (0.18, 0.25), tip_lift=(0.0, 0.01), width=(0.14, 0.24)),
    ),
    hairline=RECEDING_LINE,
    gap=0.002,
    taper=((0, 0.9), (40, 0.8), (60, 0.5), (180, 0.5)),
    soft=((0, 9), (60, 9), (90, 16), (180, 20)),
    scalp=0.85,
    texture=Texture(wave=0.3, contrast=1.05, ragged=0.4, strand=0.35),
)
FADE = Style(
    parting=((0.0, 45), (0.0, 85), (0.0, 135)),
    columns=cropped(
        MAN_LINE,
        ((0, 0), (30, 0), (42, -4), (55, -18), (70, -44), (100, -30), (140, -50), (180, -55)),
        ((0, 0.13), (40, 0.11), (60, 0.07), (90, 0.05), (130, 0.06), (180, 0.07)),
        ((0, 0), (45, 0.15), (90, 0.5), (135, 0.85), (180, 1)),
    ),
    profile=((0, 1.0), (0.55, 1.0), (0.85, 0.75), (1.0, 0.10)),
    lumps=(0.012, 6.0),
    body=(
        Locks(
            110,
            (0.0, 1.0),
            (0.0, 0.8),
            (0.10, 0.2),
            root_lift=(-0.03, -0.01),
            tip_lift=(0.02, 0.05),
            width=(0.2, 0.3),
            roll=(-20, 20),
        ),
    ),
    wisps=(
        Locks(
            65,
            (0.0, 1.0),
            (0.3, 0.85),
            (0.08, 0.14),
            root_lift=(-0.02, 0),
            tip_lift=(0.01, 0.04),
            width=(0.16, 0.24),
            roll=(-20, 20),
        ),
    ),
    hairline=MAN_LINE,
    taper=((0, 0.95), (40, 0.8), (60, 0.4), (180, 0.4)),
    soft=((0, 5), (40, 6), (62, 20), (80, 12), (100, 14), (115, 30), (180, 40)),
    scalp=0.94,
    gap=0.002,
    texture=Texture(curl=7.0, ragged=0.4, gloss=0.25),
)
AFRO = Style(
    parting=((0.0, 78), (0.0, 100), (0.0, 140)),
    columns=cropped(
        WOMAN_LINE,
        ((0, 1), (60, 1), (70, -6), (78, -8), (82, 3), (100, 3), (110, -6), (140, -9), (180, -9)),
        ((0, 0.4), (180, 0.4)),
        ((0, 0), (60, 0.2), (110, 0.6), (180, 1)),
    ),
    profile=((0, 1.0), (0.60, 1.0), (0.76, 0.94), (0.89, 0.70), (1.0, 0.06)),
    lumps=(0.05, 3.5),
    gap=0.002,
    ball=1.16,
    body=(
        Locks(
            110,
            (0.0, 1.0),
            (0.12, 0.9),
            (0.10, 0.16),
            root_lift=(-0.05, -0.02),
            tip_lift=(0.03, 0.06),
            width=(0.32, 0.46),
            roll=(-20, 20),
        ),
    ),
    wisps=(
        Locks(
            30,
            (0.0, 1.0),
            (0.2, 0.9),
            (0.08, 0.13),
            root_lift=(-0.05, -0.02),
            tip_lift=(0.04, 0.08),
            width=(0.24, 0.36),
            roll=(-25, 25),
        ),
        Locks(
            8,
            (0.0, 0.03),
            (0.1, 0.8),
            (0.10, 0.14),
            root_lift=(-0.02, 0.0),
            tip_lift=(0.03, 0.05),
            width=(0.3, 0.4),
        ),
        Locks(
            8,
            (0.97, 1.0),
            (0.1, 0.8),
            (0.10, 0.14),
            root_lift=(-0.02, 0.0),
            tip_lift=(0.03, 0.05),
            width=(0.3, 0.4),
        ),
        Locks(
            25,
            (0.0, 1.0),
            (0.88, 0.97),
            (0.05, 0.10),
            root_lift=(-0.02, 0),
            tip_lift=(0.02, 0.06),
            width=(0.2, 0.3),
            roll=(-30, 30),
        ),
    ),
    hairline=WOMAN_LINE,
    texture=Texture(curl=13.0, ragged=0.10, gloss=0.25),
)
STYLES = {
    "side part": SIDE_PART,
    "fringe bob": FRINGE_BOB,
    "quiff": QUIFF,
    "receding": RECEDING,
    "fade": FADE,
    "afro": AFRO,
}
