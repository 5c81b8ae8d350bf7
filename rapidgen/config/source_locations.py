"""Find the source location of a value of a checked configuration."""

from rapidgen.config.assemble import display_path, keys_of
from rapidgen.config.model import RobotConfig
from rapidgen.config.yaml_tree import MappingNode, Node, ScalarNode, SequenceNode
from rapidgen.diagnostics import Span

KeyPath = tuple[str | int, ...]


def place_of_value(config: RobotConfig, group: str, path: KeyPath, value: str) -> Span | None:
    """Return the place of a group's `value`, or None.

    A value from `--set` has no place.
    """
    data = next((data for name, data in config.inputs if name == config.path.name), None)
    if data is None:
        return None
    root, _ = keys_of(data, display_path(config.path))
    for complete in (("groups", group, *path), path):
        node = _at(root, complete)
        if isinstance(node, ScalarNode) and node.value == value:
            return node.span
    return None


def _at(root: Node, path: KeyPath) -> Node | None:
    node = root
    for part in path:
        if isinstance(node, MappingNode) and part in node.entries:
            node = node.entries[str(part)][1]
        elif isinstance(node, SequenceNode) and isinstance(part, int) and part < len(node.items):
            node = node.items[part]
        else:
            return None
    return node
