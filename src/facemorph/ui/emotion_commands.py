"""Commands of the Emotion page: a part of the table of commands."""

from __future__ import annotations

from facemorph.ui import emotion, emotion_paths
from facemorph.ui.command import Command

_MENU = "Expression/Emotion map"
EMOTION = (
    Command("Emotion: to neutral", emotion.to_neutral, _MENU, enabled=emotion.moves,
            help="The cursor of the emotion map back to the middle"),
    Command("Emotion: record or stop", emotion_paths.toggle_record, _MENU, enabled=emotion.usable,
            checked=lambda app: app.pages.emotion.recorder is not None,
            help="Takes down where the cursor is dragged, with its times"),
    Command("Emotion: play or pause", emotion_paths.toggle_play, _MENU, enabled=emotion_paths.playable,
            checked=lambda app: app.pages.emotion.player.playing,
            help="Runs the cursor along the recorded path in its own time"),
)  # fmt: skip
