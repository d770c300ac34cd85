"""What a screen reader gets of a page, and which of the rules for accessible pages it breaks."""

import os
from pathlib import Path
from typing import List, NamedTuple, Sequence

import pytest

AXE = Path(__file__).parents[2] / ".ci/js/node_modules/axe-core/axe.min.js"
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
AUDIT = """const [tags, but, done] = arguments, rules = but ? {[but]: {enabled: false}} : {};
axe.run({runOnly: tags, rules, preload: false, resultTypes: ["violations"]}).then(({violations}) => done(
    violations.flatMap(({id, help, nodes}) => nodes.map(({target, failureSummary}) =>
        [id, help, target.join(" "), failureSummary]))));"""
SILENT = "generic", "none", "InlineTextBox"  # roles of which nothing is said
STATES = ("disabled", "checked", "pressed", "expanded", "selected", "invalid", "focused")


class Node(NamedTuple):
    """What a screen reader says of an element or a text; state: those of STATES that it has."""

    role: str
    name: str
    description: str
    value: str
    state: List[str]


def violations(page, but: str = "", rules: Sequence[str] = RULES) -> List[str]:
    """Return the rules of axe-core that a page breaks in its present state, with the elements; skip without it.

    but: a rule that is not checked; rules: these alone, or all with such a tag.
    """
    if not AXE.is_file():
        assert os.environ.get("CI") != "true", "axe-core is missing"
        pytest.skip("axe-core is not installed: npm ci --prefix .ci/js")
    if not page.run("return 'axe' in window"):
        page.run(AXE.read_text())
    return [f"{rule}: {target}: {meaning}: {summary}"
            for rule, meaning, target, summary in page.driver.execute_async_script(AUDIT, rules, but)]


def tree(page) -> List[Node]:
    """Return what a screen reader finds on a page, from its beginning to its end."""
    nodes = {node["nodeId"]: node for node in page.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]}

    def within(number):
        node = nodes[number]
        own = [] if node["ignored"] or node["role"]["value"] in SILENT else [_node(node)]
        return own + [each for child in node["childIds"] if child in nodes for each in within(child)]
    return within(next(iter(nodes)))


def _node(node):
    role, name, description, value = (str(node.get(key, {}).get("value", ""))
                                      for key in ("role", "name", "description", "value"))
    properties = {each["name"]: each["value"].get("value") for each in node.get("properties", [])}
    state = [key for key in STATES if properties.get(key) not in (None, False, "false")]
    return Node(role, name, description, value, state)
