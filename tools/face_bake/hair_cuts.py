"""The haircuts by name, as people.py asks for them."""

from .hair_long import AFRO, FRINGE_BOB, SIDE_PART
from .hair_short import FADE, QUIFF, RECEDING

STYLES = {
    "side part": SIDE_PART,
    "fringe bob": FRINGE_BOB,
    "afro": AFRO,
    "quiff": QUIFF,
    "receding": RECEDING,
    "fade": FADE,
}
