"""What a check of a face folder found."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

Level = Literal["error", "warning"]


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong ("error": the face does not load, or not as meant) or looks so ("warning").

    file     the file's name in the folder, or the folder's own
    kind     a short key: unreadable, not-finite, vertices, polygons, order, folder, key, unlisted, neutral,
             left-out, texture, stray-vertices, degenerate, winding, empty, duplicate, scale, turned, moved,
             collapsed, folded, stray-movement
    message  in plain words, which say from where numbers are counted
    """

    level: Level
    file: str
    kind: str
    message: str


@dataclass(frozen=True)
class Report:
    """The findings on a face folder, in order: the folder, the neutral, then each shape.

    vertices and polygons are the neutral's, 0 where it could not be read; shapes those that correspond.
    """

    folder: str
    vertices: int
    polygons: int
    shapes: tuple[str, ...]
    findings: tuple[Finding, ...]

    @property
    def ok(self) -> bool:
        """Whether there is no error; there may be warnings."""
        return not any(finding.level == "error" for finding in self.findings)

    def lines(self) -> list[str]:
        """The report as text: one finding a line, then what was looked at."""
        found = [f"{finding.level:<8}{finding.file}: {finding.message}" for finding in self.findings]
        return [*found, self._summary()]

    def as_dict(self) -> dict[str, Any]:
        """The report for JSON."""
        return {**asdict(self), "shapes": list(self.shapes), "ok": self.ok,
                "findings": [asdict(finding) for finding in self.findings]}  # fmt: skip

    def _summary(self) -> str:
        errors = sum(finding.level == "error" for finding in self.findings)
        counts = f"{_counted(errors, 'error')}, {_counted(len(self.findings) - errors, 'warning')}"
        size = f"{self.vertices:,} vertices, {self.polygons:,} polygons"
        verdict = counts if self.findings else "all is well"
        return f"{self.folder}: {_counted(len(self.shapes), 'shape')} on {size}; {verdict}."


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
