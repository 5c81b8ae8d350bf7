"""What the shipped models are, in a line each."""

from dataclasses import asdict, dataclass

from rapidgen._json import Members
from rapidgen.config.load import load_config
from rapidgen.config.registry import find_shipped, shipped_names
from rapidgen.config.tree import MappingNode, ScalarNode, decode, parse, read_bytes


@dataclass(frozen=True, slots=True)
class ShippedModel:
    """One shipped model; `groups` are (name, number of joints)."""

    name: str
    description: str
    controller: str
    generations: tuple[int, ...]
    groups: tuple[tuple[str, int], ...]
    unsure: bool

    def as_json(self) -> Members:
        """Plain data."""
        return {**asdict(self), "groups": {name: joints for name, joints in self.groups}}


def shipped_models() -> tuple[ShippedModel, ...]:
    """All shipped models, by name."""
    return tuple(_model(name) for name in shipped_names())


def _model(name: str) -> ShippedModel:
    config = load_config(name)
    return ShippedModel(
        name,
        model_description(name),
        config.controller,
        config.generations,
        tuple((group.name, len(group.joints)) for group in config.groups),
        any(d.code == "RG016" for d in config.diagnostics),
    )


def model_description(name: str) -> str:
    """The line that a shipped model says of itself."""
    path = find_shipped(name)
    root, _ = parse(decode(read_bytes(path, str(path)), str(path)), str(path))
    assert isinstance(root, MappingNode)
    entry = root.entries.get("description")
    return str(entry[1].value) if entry and isinstance(entry[1], ScalarNode) else ""
