"""`LandmarkPair`: one place of a scan and the vertex of a template that it belongs to."""

from __future__ import annotations

from dataclasses import dataclass

MOST_PAIRS = 2_000


@dataclass(frozen=True)
class LandmarkPair:
    """The vertex of the template, counted from 0, and its place on the scan, in the scan's unit."""

    vertex: int
    point: tuple[float, float, float]
    name: str = ""

    def __str__(self) -> str:
        return f"{self.name!r} (vertex {self.vertex})" if self.name else f"of vertex {self.vertex}"
