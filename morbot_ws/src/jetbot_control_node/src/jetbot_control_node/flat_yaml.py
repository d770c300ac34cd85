"""YAML as a file of parameters needs it: names, each with one plain value."""

from typing import Dict

import yaml

MAX_NAMES = 100  # more than any node has


class _Loader(yaml.SafeLoader):
    """Refuses lists, mappings and aliases inside the outermost node, tags, and more than MAX_NAMES names."""

    def compose_node(self, parent, index):
        event = self.peek_event()
        if parent and not isinstance(event, yaml.ScalarEvent) or getattr(event, "tag", None):
            raise yaml.MarkedYAMLError(problem="a parameter has one plain value", problem_mark=event.start_mark)
        if parent and len(parent.value) == MAX_NAMES:
            raise ValueError(f"it has more than {MAX_NAMES} names")
        return super().compose_node(parent, index)


def parse(content: bytes) -> Dict[str, object]:
    """Return the values by their names. Raise ValueError, with the reason in one line, for any other content."""
    try:
        loader = _Loader(content)
        node = loader.get_single_node()
        if not isinstance(node, yaml.MappingNode):
            raise ValueError("it holds no parameters")
        values = loader.construct_document(node)
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        mark = getattr(error, "problem_mark", None)
        reason = f"line {mark.line + 1}: {error.problem}" if mark else str(error).partition('\n')[0]
        raise ValueError(reason.rstrip(".")) from None
    names = [name.value for name, _ in node.value]
    for name in names:
        if name not in values:
            raise ValueError(f"{name} is not a name")
        if names.count(name) > 1:
            raise ValueError(f"it gives {name} twice")
        if values[name] in ("", None):
            raise ValueError(f"it gives {name} no value")
    return values
