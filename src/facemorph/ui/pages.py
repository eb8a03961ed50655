"""What the pages of the methods keep for themselves: no part of the face, and of no step of undo."""

from __future__ import annotations

from dataclasses import dataclass, field

from facemorph.ui.emotion_page import EmotionPage
from facemorph.ui.fit_page import FitPage
from facemorph.ui.people_page import PeoplePage


@dataclass
class Pages:
    """The FACS page: the set shown, the unit whose balance is open, balances of units at rest.

    emotion   what the Emotion page keeps
    people    what the People page keeps
    fit       what the Fit page keeps
    """

    set: str = "FACS"
    unit_open: int = 0
    balances: dict[int, float] = field(default_factory=dict)
    emotion: EmotionPage = field(default_factory=EmotionPage)
    people: PeoplePage = field(default_factory=PeoplePage)
    fit: FitPage = field(default_factory=FitPage)
