"""Headless Chromium, as one of the engines."""

from pathlib import Path

from .chromium import Chromium
from .engine import SCREEN, Engine


class Browser(Chromium, Engine):
    """folder: of its profile. language: the person's."""

    def __init__(self, folder: Path, language: str):
        super().__init__(folder, language)
        self.screen(*SCREEN)

    def hide(self):
        self.new_tab()

    def show(self):
        self.old_tab()
