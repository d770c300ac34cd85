"""Headless Chromium, as one of the engines."""

from pathlib import Path

from .chromium import Chromium
from .engine import HOLD_BACK, SCREEN, Engine


class Browser(Chromium, Engine):
    """folder: of its profile. language: the person's."""

    def __init__(self, folder: Path, language: str):
        super().__init__(folder, language)
        self.screen(*SCREEN)
        self._devtools("Page.addScriptToEvaluateOnNewDocument", source=HOLD_BACK)

    def hide(self):
        self.new_tab()

    def show(self):
        self.old_tab()
