"""Puts shaders and faces into the wheel; an editable install reads them from the checkout instead."""

from __future__ import annotations

from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BundledData(BuildHookInterface):  # type: ignore[misc]
    """The folders outside `src/` that travel with the package."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Map each folder to its place in the package."""
        if version == "standard":
            build_data["force_include"]["shaders"] = "facemorph/_data/shaders"
            build_data["force_include"]["assets/faces"] = "facemorph/_data/faces"
