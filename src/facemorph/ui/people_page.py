"""What the People page keeps for itself: people chosen from files, and the pictures of its corners."""

from __future__ import annotations

from dataclasses import dataclass, field

from facemorph.core.mesh import Mesh

MOST_LISTED = 6
Corner = tuple[int, int]  # s and t, each 0 or 1
# The head, who is in the mixture, the expression, whether colours are mixed: what a picture depends on.
PictureKey = tuple[Mesh, tuple[tuple[Mesh, float], ...], tuple[tuple[str, float], ...], bool]


@dataclass
class PeoplePage:
    """Kept while other faces are opened, so that a person once chosen stays on the list.

    files     what was chosen from files, newest last: its paths -> what it is called in a mixture
    loading   who is being read now, "" for nobody
    wanted    the pictures that the page shows, by corner; said anew every frame
    pictures  textures, filled by `corner_pictures`
    """

    files: dict[tuple[str, ...], str] = field(default_factory=dict)
    loading: str = ""
    wanted: dict[Corner, PictureKey] = field(default_factory=dict)
    pictures: dict[PictureKey, int] = field(default_factory=dict)

    def remember(self, paths: tuple[str, ...], name: str) -> None:
        """Put a person at the list's end; the oldest go."""
        self.files.pop(paths, None)
        self.files[paths] = name
        while len(self.files) > MOST_LISTED:
            del self.files[next(iter(self.files))]
