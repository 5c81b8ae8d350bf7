"""Visuals of a configuration's robots: trees of their descriptions."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rapidgen.config.assemble import assemble
from rapidgen.config.layers import Overrides
from rapidgen.config.urdf.expand import expand
from rapidgen.config.urdf.graph import Graph, build_graph
from rapidgen.config.urdf.group import request
from rapidgen.config.urdf.robot import read_robot
from rapidgen.config.urdf.visuals import Visual, visuals
from rapidgen.config.validate import validate


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """A description: its joints, and the visuals of its links by name."""

    graph: Graph
    visuals: Mapping[str, tuple[Visual, ...]]


def trees(path: Path, overrides: Overrides = ()) -> dict[str, Tree]:
    """Return the descriptions of a configuration, by group.

    `load_config` must accept the configuration; groups with the same request share one description.
    """
    assembly = assemble(path, overrides)
    made: dict[str, Tree] = {}
    result: dict[str, Tree] = {}
    for name, keys in validate(assembly.root).configuration.groups.items():
        if keys.urdf is None:
            continue
        expected = request(keys.urdf, assembly.path.parent, (), None)
        requested = repr(
            (expected.path, expected.arguments, expected.macro, expected.macro_arguments)
        )
        if requested not in made:
            description = expand(expected)
            graph, _ = build_graph(read_robot(description, None), None)
            drawn = visuals(description, expected.packages, assembly.path.parent)
            made[requested] = Tree(graph, drawn)
        result[name] = made[requested]
    return result
