"""A language that nobody speaks: its words are in brackets, and 40 % longer than the English ones.

A text without brackets is English that is not translated; what is longer must not be cut off, nor cover another.
"""

import json
import re
from contextlib import contextmanager
from typing import Iterator

from languages import keys, messages

KNOWN = ["jetbot", "ms", "rad", "Ben", "Ada", "Maximilian", "STOP", "http", "KQ", "MX"]  # in each language
SPEAK = """if (location.protocol === "http:") {
    const pseudo = %s, fetch = window.fetch;
    localStorage.setItem("language", "de");
    window.fetch = (url, ...more) => String(url).endsWith("/languages/de.json")
        ? Promise.resolve(new Response(JSON.stringify(pseudo))) : fetch(url, ...more);
}"""


def stretch(english: str) -> str:
    """Return a sentence in the pseudo-language, in each of its forms: with its own letters again, backwards."""
    def longer(form):
        letters = re.sub(r"\{\w+\}|%\d|[^a-z ]", "", form.lower())[::-1]
        return f"[{form} {letters[:max(1, len(form) * 2 // 5 - 2)].strip()}]"
    return "|".join(map(longer, english.split("|")))


@contextmanager
def spoken(page) -> Iterator[None]:
    """Let the pages that a browser opens in this context speak the pseudo-language."""
    said = {key: stretch(key) for key in {*keys("de"), *messages("en").values()} - {"STOP"}}
    devtools = page.driver.execute_cdp_cmd
    devtools("Network.enable", {})
    devtools("Network.setBlockedURLs", {"urls": ["*/msg/de.js"]})
    script = devtools("Page.addScriptToEvaluateOnNewDocument", {"source": SPEAK % json.dumps(said)})
    try:
        yield
    finally:
        devtools("Page.removeScriptToEvaluateOnNewDocument", script)
        devtools("Network.setBlockedURLs", {"urls": []})
        page.run("localStorage.removeItem('language')")
        page.errors()  # of the file that was not loaded
