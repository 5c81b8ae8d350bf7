"""Visuals of a configuration's robots: trees of their descriptions."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rapidgen.config.assemble import assemble
from rapidgen.config.layers import Overrides
from rapidgen.config.schema import UrdfKeys
from rapidgen.config.urdf.expand import Request, expand
from rapidgen.config.urdf.graph import Graph, build_graph
from rapidgen.config.urdf.group import request
from rapidgen.config.urdf.robot import read_robot
from rapidgen.config.urdf.visuals import Visual, visuals
from rapidgen.config.validate import validate
from rapidgen.diagnostics import DiagnosticError, Severity


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """A description: its joints, and the visuals of its links by name."""

    graph: Graph
    visuals: Mapping[str, tuple[Visual, ...]]
    collisions: Mapping[str, tuple[Visual, ...]] = field(default_factory=dict)
    """Collision geometry of the links that have some."""


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
            made[requested] = _tree(expected, assembly.path.parent)
        result[name] = made[requested]
    return result


def tree_of_file(path: Path) -> Tree:
    """Return the description in a URDF or xacro file.

    Raises DiagnosticError if it is none.
    """
    return _tree(request(UrdfKeys(path.name), path.parent, (), None), path.parent)


def _tree(expected: Request, folder: Path) -> Tree:
    description = expand(expected)
    graph, faults = build_graph(read_robot(description, None), None)
    if any(fault.severity is Severity.ERROR for fault in faults):
        raise DiagnosticError(faults)
    drawn = visuals(description, expected.packages, folder)
    return Tree(graph, drawn, visuals(description, expected.packages, folder, "collision"))
