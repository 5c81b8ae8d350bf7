"""The world of a cell: its robots with their link shapes, tools, objects and zones as a scene.

`build_world` takes a checked cell file and the configurations of the robots. What cannot be checked
is listed in `World.unchecked`; no result of a check leaves this list out.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.mapping import JointMap
from rapidgen.collision.draft import Carrier, Draft, cell_shape, link_shapes, pose_of
from rapidgen.collision.pairs import body_pairs, special_pairs, zone_pairs, zone_shapes
from rapidgen.collision.robot import (
    MotionMismatch,
    RobotFrames,
    frames_of_chain,
    frames_of_description,
    shapes_on_node,
    stations_of,
)
from rapidgen.collision.scene import Body, Scene
from rapidgen.collision.shapes import Array, Shape, sphere
from rapidgen.collision.tree import WORLD, Tree
from rapidgen.config.cell import (
    CellDescription,
    CellRobotKeys,
    Thing,
)
from rapidgen.config.load import load_config
from rapidgen.config.model import GroupConfig
from rapidgen.config.registry import is_path, shipped_names
from rapidgen.config.urdf.visual_trees import Tree as Description
from rapidgen.config.urdf.visual_trees import tree_of_file, trees
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error, suggest

_TCP = "tcp"
NOT_SEEN = (
    "hoses and cables, people, what is not in the cell file, deviations of the real robot and of "
    "its corners from the planned path"
)


@dataclass(frozen=True, slots=True)
class RobotSource:
    """A robot of the world: its configuration and, if it has one, its description."""

    group: GroupConfig
    description: Description | None = None


@dataclass(frozen=True, eq=False)
class World:
    """A scene of one or more robots.

    `columns` are the columns of each robot's joints in the scene's values, by the group's name.
    """

    scene: Scene
    columns: Mapping[str, slice]
    maps: Mapping[str, JointMap]
    unchecked: tuple[str, ...]
    """Sentences on what a check does not see."""
    allowed: Mapping[frozenset[str], str]
    """Reasons of pairs that may touch."""
    diagnostics: tuple[Diagnostic, ...] = ()
    home: Mapping[str, Sequence[float]] = field(default_factory=dict)
    """Controller axis values at the start, by group."""
    time_tolerance: float | None = None
    """s between the clocks of two robots; None: the default of `prove_timing`."""
    cell: CellDescription = field(default_factory=CellDescription)
    special: Mapping[frozenset[str], float] = field(default_factory=dict)
    """Clearances in m of pairs that the cell file names."""
    held: Mapping[str, str] = field(default_factory=dict)
    """Tools that hold parts, by part (`gripping.attach`)."""

    def values(self, postures: Mapping[str, Array]) -> Array:
        """Return values (n, columns) of controller axis values (n, joints) by group.

        A robot that is not named stands at its start.
        """
        count = max((len(rows) for rows in postures.values()), default=1)
        result = np.zeros((count, self.scene.tree.columns))
        for name, part in self.columns.items():
            rows = postures.get(name)
            if rows is None:
                rows = np.array([self.home[name]], dtype=np.float64)
            result[:, part] = self.to_urdf(name, rows)
        return result

    def to_urdf(self, name: str, rows: Array) -> Array:
        """Convert controller axis values (n, joints) of a group to URDF values."""
        mapped = self.maps[name]
        result = rows.copy()
        axes = [joint.axis for joint in mapped.joints]
        if mapped.coupling:
            second, third = axes.index("rax_2"), axes.index("rax_3")
            result[:, third] -= mapped.coupling * result[:, second]
        sign = np.array([joint.sign for joint in mapped.joints], dtype=np.float64)
        offset = np.array([joint.offset for joint in mapped.joints])
        converted: Array = sign * (result - offset)
        return converted


def sources_of(
    cell: CellDescription, groups: Sequence[GroupConfig], paths: Mapping[str, Path] | None = None
) -> tuple[RobotSource, ...]:
    """Return the robots with the descriptions of their configurations.

    `paths` are configurations by group, where they are known; else the cell file names them.
    Raises DiagnosticError for a configuration that `load_config` would not accept.
    """
    result = []
    for group in groups:
        path = (paths or {}).get(group.name)
        keys = _keys_of(cell, group)
        if path is None and is_path(keys.model):
            path = Path(keys.model)
        found = trees(path) if path is not None else {}
        description = found.get(group.name)
        if description is None:
            names = {joint.name for joint in group.joints}
            description = next(
                (t for t in found.values() if names <= {j.name for j in t.graph.robot.joints}),
                None,
            )
        result.append(RobotSource(group, description))
    return tuple(result)


def other_groups(cell: CellDescription, own: Sequence[GroupConfig] = ()) -> list[GroupConfig]:
    """Return the robots of a cell file, without those of the tasks of `own`.

    A configuration with one robot serves any task; a name that is taken is replaced by the task's.
    Raises DiagnosticError for a configuration that `load_config` does not accept.
    """
    taken, tasks = {group.name for group in own}, {group.task.casefold() for group in own}
    result = []
    for task, keys in cell.robots.items():
        is_known = is_path(keys.model) or keys.model in shipped_names()
        if task.casefold() in tasks or not is_known:
            continue
        groups = load_config(keys.model).groups
        chosen = [group for group in groups if group.task.casefold() == task.casefold()]
        for group in chosen or groups[: len(groups) == 1]:
            name = task.casefold().removeprefix("t_") if group.name in taken else group.name
            result.append(replace(group, task=task, name=name))
            taken.add(name)
    return result


def build_world(
    cell: CellDescription,
    robots: Sequence[RobotSource],
    home: Mapping[str, Sequence[float]] | None = None,
) -> World:
    """Return the world of a cell.

    `home` has axis values by group that replace the starts of the cell file.
    Raises DiagnosticError (RG825 to RG833) with all faults, and ModuleNotFoundError without coal
    if the cell has meshes. The names of links have the group's name before them if there are
    several robots.
    """
    draft = Draft(parts=frozenset(grip.part for grip in cell.attach))
    keys = {robot.group.name: _keys_of(cell, robot.group) for robot in robots}
    stands = _stands(robots)
    bases = _bases(cell, stands, draft)
    for stand, base in zip(stands, bases, strict=True):
        shared: dict[str, str] = {}
        for robot in stand:
            foreign = frozenset(
                joint.name for other in stand if other is not robot for joint in other.group.joints
            )
            place = _Place(base, len(robots) > 1, foreign, shared)
            _add_robot(cell, robot, keys[robot.group.name], place, draft)
    tasks = {robot.group.task.casefold() for robot in robots}
    draft.unchecked += [
        f"robot of {task}: no model is known"
        for task in cell.robots
        if task.casefold() not in tasks
    ]
    for thing in cell.things:
        _add_thing(cell, thing, draft)
    zones = {
        name: Body(f"zone {name}", WORLD, zone_shapes(zone), role="zone")
        for name, zone in cell.zones.items()
    }
    allowed, special = special_pairs(cell, draft)
    if any(d.severity is Severity.ERROR for d in draft.findings):
        raise DiagnosticError(draft.findings)
    columns = max((part.stop for part in draft.columns.values()), default=0)
    tree = Tree(draft.nodes, columns)
    pairs = list(body_pairs(cell, draft, tree, allowed, special))
    first = len(draft.bodies)
    for index, (name, zone) in enumerate(cell.zones.items()):
        draft.bodies.append(zones[name])
        pairs += zone_pairs(name, zone, first + index, draft)
    if any(d.severity is Severity.ERROR for d in draft.findings):
        raise DiagnosticError(draft.findings)
    if not pairs:
        draft.report(
            "RG824",
            "nothing can be checked: no two bodies with shapes can change their distance",
            "give the robot's links or tools shapes, and the cell `things:`",
        )
        raise DiagnosticError(draft.findings)
    scene = Scene(tree, draft.bodies, pairs)
    starts = {robot.group.name: _home(keys[robot.group.name], robot.group) for robot in robots}
    world = World(
        scene,
        draft.columns,
        {robot.group.name: JointMap.of(robot.group) for robot in robots},
        (*draft.unchecked, NOT_SEEN),
        allowed,
        tuple(draft.findings),
        {**starts, **(home or {})},
        cell.collision.time_tolerance if cell.collision is not None else None,
        cell,
        special,
    )
    return replace(world, diagnostics=(*world.diagnostics, *home_overlaps(world)))


def home_overlaps(world: World) -> Iterator[Diagnostic]:
    """Yield a warning for each pair that overlaps at the start (RG823)."""
    scene = world.scene
    if not scene.pairs:
        return
    for number, far in enumerate(scene.body_distances(world.values({}))[0].tolist()):
        if far <= 0:
            one, other = scene.names(number)
            yield error(
                "RG823",
                None,
                f"{one} and {other} overlap by {1000 * abs(far):.1f} mm in the home position",
                "correct the shapes or their places; if they may touch, write "
                f"collision: {{pairs: {{{one} - {other}: {{allowed: REASON}}}}}}",
                severity=Severity.WARNING,
            )


def _keys_of(cell: CellDescription, group: GroupConfig) -> CellRobotKeys:
    for task, robot in cell.robots.items():
        if task.casefold() == group.task.casefold():
            return robot
    return CellRobotKeys()


def _home(keys: CellRobotKeys, group: GroupConfig) -> tuple[float, ...]:
    if len(keys.start) != len(group.joints):
        return tuple(min(max(0.0, joint.lower), joint.upper) for joint in group.joints)
    return tuple(
        value * (np.pi / 180 if joint.kind == "revolute" else 0.001)
        for value, joint in zip(keys.start, group.joints, strict=True)
    )


def _stands(robots: Sequence[RobotSource]) -> list[list[RobotSource]]:
    """Return the robots by stand: the arms of one description stand together."""
    stands: list[list[RobotSource]] = []
    for robot in robots:
        for stand in stands:
            if any(_is_together(robot, other) for other in stand):
                stand.append(robot)
                break
        else:
            stands.append([robot])
    return stands


def _is_together(one: RobotSource, other: RobotSource) -> bool:
    """True for two arms that are in one description, with joints of their own."""
    if one.description is None or other.description is None:
        return False
    own, others = ({joint.name for joint in robot.group.joints} for robot in (one, other))
    known = {joint.name for joint in one.description.graph.robot.joints}
    return not own & others and own | others <= known


def _bases(
    cell: CellDescription, stands: Sequence[Sequence[RobotSource]], draft: Draft
) -> list[frames.Pose]:
    """Return the base of each stand; several stands need them (RG828)."""
    known = {task.casefold(): pose_of(base) for task, base in cell.bases.items()}
    result = []
    for stand in stands:
        own = [task for robot in stand if (task := robot.group.task.casefold()) in known]
        result.append(known[own[0]] if own else frames.IDENTITY)
        if not own and len(stands) > 1:
            task = stand[0].group.task
            draft.report(
                "RG828",
                f"{task} has no base, and the cell has {len(stands)} robots",
                f"robots: {{{task}: {{base: {{position: [X, Y, Z]}}}}}} places it in the world",
            )
    return result


@dataclass(frozen=True, slots=True)
class _Place:
    """A robot among others.

    `foreign` are joints of arms in the same description, `shared` the links that an arm of it has
    in the world already, with the names of their bodies.
    """

    base: frames.Pose
    several: bool
    foreign: frozenset[str]
    shared: dict[str, str]

    def prefix(self, group: GroupConfig) -> str:
        """Return what stands before the names of its bodies."""
        return f"{group.name}/" if self.several else ""


def _add_robot(
    cell: CellDescription, robot: RobotSource, keys: CellRobotKeys, place: _Place, draft: Draft
) -> None:
    group, prefix = robot.group, place.prefix(robot.group)
    if not group.chain:
        draft.report(
            "RG824",
            f"{group.name} has no kinematic chain, so nothing of it is checked",
            "give it a model or a URDF",
        )
        return
    column = max((part.stop for part in draft.columns.values()), default=0)
    draft.columns[group.name] = slice(column, column + len(group.joints))
    description = robot.description
    if keys.shapes not in ("urdf", "none"):
        description = _description_file(keys.shapes, cell.folder, draft)
    if keys.shapes == "none":
        description = None
    made: RobotFrames | None = None
    if description is not None:
        graph = description.graph
        try:
            made = frames_of_description(group, graph, place.base, len(draft.nodes), column)
        except MotionMismatch:
            draft.report(
                "RG831",
                f"the description of {group.name} moves otherwise than its configuration",
                "use a URDF of this robot with the configuration's joint names",
            )
    links: Mapping[str, tuple[Shape, ...]] = {}
    if made is None or description is None:
        made = frames_of_chain(group, place.base, len(draft.nodes), column)
        draft.unchecked.append(f"links of {group.name}: no shapes, only its tools are checked")
        draft.report(
            "RG824",
            f"the links of {group.name} have no shapes and are not checked",
            "give the configuration a `urdf:` with meshes, or `shapes: FILE.urdf` in the cell "
            "file; `rapidgen fit-shapes` makes one",
            Severity.WARNING,
        )
        chosen = list(made.links)
    else:
        graph = description.graph
        chosen = [
            link
            for link in made.links
            if link not in place.shared
            and not any(joint.name in place.foreign for joint in graph.path_to(link))
        ]
        links = link_shapes(group, description, chosen, draft)
    draft.nodes += made.nodes
    for name in chosen:
        node, pose = made.links[name]
        own = links.get(name, ())
        draft.carriers[prefix + name] = Carrier(node, pose, group.name)
        if own:
            shapes = shapes_on_node(own, pose)
            draft.bodies.append(Body(prefix + name, node, shapes, group.name, "link"))
        if node == WORLD:
            place.shared[name] = prefix + name
    draft.neighbours |= {
        frozenset(place.shared.get(name, prefix + name) for name in pair)
        for pair in made.neighbours
    }
    _add_stations(group, made, column, place, draft)
    _add_tools(cell, group, keys, place, made, draft)


def _add_stations(
    group: GroupConfig, made: RobotFrames, column: int, place: _Place, draft: Draft
) -> None:
    """Add the user frames of positioners as carriers of objects."""
    prefix, first = place.prefix(group), len(draft.nodes)
    nodes, stations = stations_of(group, place.base, first, column)
    moving = {index: node for index, node in enumerate(made.nodes, first - len(made.nodes))}
    for unit, (node, pose) in stations.items():
        joint = nodes[node - first].name if node != WORLD else ""
        together = frozenset(
            prefix + link
            for link, (own, _) in made.links.items()
            if own in moving and moving[own].name == joint
        )
        name = unit if unit not in draft.carriers else prefix + unit
        draft.carriers[name] = Carrier(node, pose, "", together)
    draft.nodes += nodes


def _add_thing(cell: CellDescription, thing: Thing, draft: Draft) -> None:
    """Add an object, on what it is fixed to (RG847)."""
    shape = cell_shape(thing.shape, cell.folder, thing.name, draft)
    carrier = Carrier(WORLD, frames.IDENTITY)
    if thing.on:
        known = list(draft.carriers)
        if thing.on not in draft.carriers:
            draft.report(
                "RG847",
                f"{thing.name} is on '{thing.on}', which is no link and no positioner",
                suggest(thing.on, known) or f"names of this cell: {', '.join(known[:30])}",
            )
            return
        carrier = draft.carriers[thing.on]
    if shape is None:
        return
    if shape.kind == "half_space" and carrier.node != WORLD:
        draft.report(
            "RG832",
            f"{thing.name} is a half-space on {thing.on}, which moves",
            "use a box; half-spaces stand in the world",
        )
        return
    shapes = shapes_on_node((shape,), carrier.pose)
    role: Literal["link", "object"] = "link" if carrier.owner else "object"
    draft.bodies.append(Body(thing.name, carrier.node, shapes, carrier.owner, role))
    draft.neighbours |= {frozenset((thing.name, link)) for link in carrier.together}


def _description_file(name: str, folder: Path, draft: Draft) -> Description | None:
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()) or not path.is_file():
        draft.report("RG829", f"shapes: {name} is not in the cell file's folder or below")
        return None
    try:
        return tree_of_file(path)
    except DiagnosticError as fault:
        draft.findings += fault.diagnostics
        return None


def _add_tools(
    cell: CellDescription,
    group: GroupConfig,
    keys: CellRobotKeys,
    place: _Place,
    made: RobotFrames,
    draft: Draft,
) -> None:
    """Add tools at the flange, and a point for the TCP of zones."""
    node, flange = made.flange
    prefix = place.prefix(group)
    names = keys.mounted
    if names is None:
        names = [] if place.several else list(cell.tool_shapes)
    for name in names:
        if name not in cell.tool_shapes:
            help = suggest(name, list(cell.tool_shapes)) or f"tools: {{{name}: {{shapes: [...]}}}}"
            draft.report("RG829", f"mounted: {name} is no tool with shapes", help)
            continue
        shapes = [
            shape
            for one in cell.tool_shapes[name]
            if (shape := cell_shape(one, cell.folder, name, draft)) is not None
        ]
        body = Body(prefix + name, node, shapes_on_node(shapes, flange), group.name, "tool")
        draft.bodies.append(body)
    if not names:
        draft.unchecked.append(f"tools of {group.name}: none has shapes")
    if any(_TCP in zone.of for zone in cell.zones.values()):
        tools = {tool.name: tool for tool in cell.tools}
        tool = tools[names[0]] if names and names[0] in tools else group.tool
        point = sphere(
            0.0, frames.compose(flange, pose_of(tool.frame) if tool.held else frames.IDENTITY)
        )
        draft.bodies.append(Body(prefix + _TCP, node, (point,), group.name, "zone"))
