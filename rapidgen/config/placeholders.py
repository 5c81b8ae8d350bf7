"""Placeholders: a value "???" is rejected with its place (RG022)."""

from rapidgen.config.validate import shown
from rapidgen.config.yaml_tree import MappingNode, Node, ScalarNode, SequenceNode
from rapidgen.diagnostics import Diagnostic, error

OPEN = '"???"'
"""As written: without quotes it would begin a key between braces."""


def extract_placeholders(root: MappingNode) -> tuple[MappingNode, list[Diagnostic]]:
    """Return the tree without placeholders, and a finding for each."""
    findings: list[Diagnostic] = []

    def walk(node: Node, path: tuple[str, ...]) -> Node | None:
        if isinstance(node, MappingNode):
            entries = {}
            for key, (place, value) in node.entries.items():
                saved = walk(value, (*path, key))
                if saved is not None:
                    entries[key] = (place, saved)
            return MappingNode(entries, node.span)
        if isinstance(node, SequenceNode):
            items = [walk(item, (*path, str(n))) for n, item in enumerate(node.items, 1)]
            return SequenceNode(tuple(item for item in items if item is not None), node.span)
        if isinstance(node, ScalarNode) and node.value == OPEN[1:-1]:
            findings.append(
                error(
                    "RG022",
                    node.span,
                    f"'{shown(root, path)}' is open",
                    "put the figure of your robot's data sheet or controller there",
                    label="to be filled in",
                )
            )
            return None
        return node

    made = walk(root, ())
    assert isinstance(made, MappingNode)
    return made, findings
