"""The world of a cell: its robots with their link shapes, tools, objects and zones as a scene.

`build_world` takes a checked cell file and the configurations of the robots. What cannot be checked
is listed in `World.unchecked`; no result of a check leaves this list out.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.mapping import JointMap
from rapidgen.collision.hulls import hull_vertices
from rapidgen.collision.meshes import MeshFault, is_open, triangles_of
from rapidgen.collision.robot import (
    MotionMismatch,
    RobotFrames,
    frames_of_chain,
    frames_of_description,
    shapes_on_node,
)
from rapidgen.collision.scene import Body, Pair, Scene
from rapidgen.collision.shapes import Array, Shape, box, capsule, cylinder, half_space, hull, sphere
from rapidgen.collision.srdf import read_srdf
from rapidgen.collision.tree import WORLD, Node, Tree
from rapidgen.config.cell import (
    AllowedKeys,
    CellDescription,
    CellRobotKeys,
    CellShape,
    CollisionKeys,
    ZoneKeys,
)
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.config.registry import is_path
from rapidgen.config.urdf.visual_trees import Tree as Description
from rapidgen.config.urdf.visual_trees import tree_of_file, trees
from rapidgen.config.urdf.visuals import NoMesh, Visual, mesh_in_folder
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error, suggest

_LARGE, _SMALL = 10.0, 0.1
"""Size of a robot's largest mesh over that of its chain, outside of which its unit is doubtful."""
_PAIR = re.compile(r"\s+-\s+")
_EVERYTHING = "all"
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


@dataclass(slots=True, eq=False)
class _Draft:
    """Parts of a world while it is made."""

    nodes: list[Node] = field(default_factory=list)
    bodies: list[Body] = field(default_factory=list)
    findings: list[Diagnostic] = field(default_factory=list)
    unchecked: list[str] = field(default_factory=list)
    neighbours: set[frozenset[str]] = field(default_factory=set)
    columns: dict[str, slice] = field(default_factory=dict)

    def report(
        self, code: str, message: str, help: str = "", severity: Severity = Severity.ERROR
    ) -> None:
        self.findings.append(error(code, None, message, help, severity=severity))


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
    draft = _Draft()
    keys = {robot.group.name: _keys_of(cell, robot.group) for robot in robots}
    if len(robots) > 1:
        _require_bases(cell, robots, draft)
    for robot in robots:
        _add_robot(cell, robot, keys[robot.group.name], len(robots) > 1, draft)
    for thing in cell.things:
        shape = _shape(thing.shape, cell.folder, thing.name, draft)
        if shape is not None:
            draft.bodies.append(Body(thing.name, WORLD, (shape,)))
    zones = {
        name: Body(f"zone {name}", WORLD, _zone_shapes(zone), role="zone")
        for name, zone in cell.zones.items()
    }
    allowed, special = _special_pairs(cell, draft)
    if any(d.severity is Severity.ERROR for d in draft.findings):
        raise DiagnosticError(draft.findings)
    columns = max((part.stop for part in draft.columns.values()), default=0)
    tree = Tree(draft.nodes, columns)
    pairs = list(_pairs(cell, draft, tree, allowed, special))
    first = len(draft.bodies)
    for index, (name, zone) in enumerate(cell.zones.items()):
        draft.bodies.append(zones[name])
        pairs += _zone_pairs(name, zone, first + index, draft)
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


def _base(cell: CellDescription, group: GroupConfig) -> frames.Pose:
    for task, base in cell.bases.items():
        if task.casefold() == group.task.casefold():
            return base.position, base.orientation
    return frames.IDENTITY


def _require_bases(cell: CellDescription, robots: Sequence[RobotSource], draft: _Draft) -> None:
    known = {task.casefold() for task in cell.bases}
    for robot in robots:
        if robot.group.task.casefold() not in known:
            task = robot.group.task
            draft.report(
                "RG828",
                f"{task} has no base, and the cell has {len(robots)} robots",
                f"robots: {{{task}: {{base: {{position: [X, Y, Z]}}}}}} places it in the world",
            )


def _add_robot(
    cell: CellDescription, robot: RobotSource, keys: CellRobotKeys, several: bool, draft: _Draft
) -> None:
    group = robot.group
    prefix = f"{group.name}/" if several else ""
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
    base = _base(cell, group)
    made: RobotFrames | None = None
    if description is not None:
        try:
            made = frames_of_description(group, description.graph, base, len(draft.nodes), column)
        except MotionMismatch:
            draft.report(
                "RG831",
                f"the description of {group.name} moves otherwise than its configuration",
                "use a URDF of this robot with the configuration's joint names",
            )
    if made is None or description is None:
        made = frames_of_chain(group, base, len(draft.nodes), column)
        draft.unchecked.append(f"links of {group.name}: no shapes, only its tools are checked")
        draft.report(
            "RG824",
            f"the links of {group.name} have no shapes and are not checked",
            "give the configuration a `urdf:` with meshes, or `shapes: FILE.urdf` in the cell "
            "file; `rapidgen fit-shapes` makes one",
            Severity.WARNING,
        )
        links: Mapping[str, tuple[Shape, ...]] = {}
    else:
        links = _link_shapes(group, description, draft)
    draft.nodes += made.nodes
    for name, (node, pose) in made.links.items():
        own = links.get(name, ())
        if own:
            shapes = shapes_on_node(own, pose)
            draft.bodies.append(Body(prefix + name, node, shapes, group.name, "link"))
    draft.neighbours |= {frozenset(prefix + name for name in pair) for pair in made.neighbours}
    _add_tools(cell, group, keys, several, made, draft)


def _description_file(name: str, folder: Path, draft: _Draft) -> Description | None:
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
    several: bool,
    made: RobotFrames,
    draft: _Draft,
) -> None:
    """Add tools at the flange, and a point for the TCP of zones."""
    node, flange = made.flange
    names = keys.mounted
    if names is None:
        names = [] if several else list(cell.tool_shapes)
    for name in names:
        if name not in cell.tool_shapes:
            help = suggest(name, list(cell.tool_shapes)) or f"tools: {{{name}: {{shapes: [...]}}}}"
            draft.report("RG829", f"mounted: {name} is no tool with shapes", help)
            continue
        shapes = [
            shape
            for one in cell.tool_shapes[name]
            if (shape := _shape(one, cell.folder, name, draft)) is not None
        ]
        prefix = f"{group.name}/" if several else ""
        body = Body(prefix + name, node, shapes_on_node(shapes, flange), group.name, "tool")
        draft.bodies.append(body)
    if not names:
        draft.unchecked.append(f"tools of {group.name}: none has shapes")
    if any(_TCP in zone.of for zone in cell.zones.values()):
        tools = {tool.name: tool for tool in cell.tools}
        tool = tools[names[0]] if names and names[0] in tools else group.tool
        place = _pose(tool.frame) if tool.held else frames.IDENTITY
        point = sphere(0.0, frames.compose(flange, place))
        prefix = f"{group.name}/" if several else ""
        draft.bodies.append(Body(prefix + _TCP, node, (point,), group.name, "zone"))


def _pose(placement: Placement) -> frames.Pose:
    return placement.position, placement.orientation


def _link_shapes(
    group: GroupConfig, description: Description, draft: _Draft
) -> dict[str, tuple[Shape, ...]]:
    """Return shapes of links in their frames: `<collision>`, else the hull of `<visual>`."""
    result: dict[str, tuple[Shape, ...]] = {}
    from_visuals = []
    largest = 0.0
    for link in description.graph.robot.links:
        visuals = description.collisions.get(link, ())
        if not visuals:
            visuals = description.visuals.get(link, ())
            from_visuals += [link] if visuals else []
        shapes = []
        for visual in visuals:
            shape = _of_visual(visual, link, draft)
            if shape is None:
                continue
            if shape.kind == "hull":
                largest = max(largest, 2 * shape.bounding_sphere()[1])
            shapes.append(shape)
        if shapes:
            result[link] = tuple(shapes)
        else:
            draft.unchecked.append(f"link {link} of {group.name}: no shape")
    if from_visuals:
        draft.report(
            "RG824",
            f"{len(from_visuals)} links of {group.name} have no <collision>: "
            f"{', '.join(from_visuals[:12])}",
            "the convex hulls of their visuals are used; parts that are not drawn are not checked",
            Severity.WARNING,
        )
    if largest > 0:
        _check_size(group, largest, draft)
    return result


def _check_size(group: GroupConfig, largest: float, draft: _Draft) -> None:
    """Report meshes whose size does not fit the chain (RG826)."""
    chain = sum(float(np.linalg.norm(step.xyz)) for step in group.chain)
    if not chain or _SMALL / 5 * chain < largest < _LARGE * chain:
        return
    factor = "0.001 0.001 0.001" if largest > chain else "1000 1000 1000"
    draft.report(
        "RG826",
        f"the largest mesh of {group.name} is {largest:.3g} m long, its kinematic chain "
        f"{chain:.3g} m",
        f'is its unit wrong? <mesh ... scale="{factor}"/> in the description corrects it',
    )


def _of_visual(visual: Visual, link: str, draft: _Draft) -> Shape | None:
    pose = (visual.xyz, frames.from_rpy(*visual.rpy))
    match visual.kind, visual.size:
        case "box", (x, y, z):
            return box(x, y, z, pose)
        case "cylinder", (radius, length):
            return cylinder(radius, length, pose)
        case "sphere", (radius,):
            return sphere(radius, pose)
    if visual.mesh is None:
        draft.report("RG827", f"mesh of {link}: {visual.fault}", "correct the description")
        return None
    return _hull_of(visual.mesh, np.array(visual.size), pose, link, draft)


def _hull_of(
    path: Path, scale: Array, pose: frames.Pose, owner: str, draft: _Draft
) -> Shape | None:
    try:
        triangles = triangles_of(path)
        points = np.unique(triangles.reshape(-1, 3), axis=0) * scale
        vertices = hull_vertices(points)
    except (MeshFault, ValueError) as why:
        draft.report(
            "RG827", f"mesh {path.name} of {owner} cannot be used: {why}", "export it again"
        )
        return None
    if is_open(triangles):
        draft.report(
            "RG827",
            f"mesh {path.name} of {owner} is open",
            "its convex hull is used, which closes it",
            Severity.INFO,
        )
    return hull(vertices, pose, path.name)


def _shape(shape: CellShape, folder: Path, owner: str, draft: _Draft) -> Shape | None:
    """Return a shape of the cell file (RG825, RG827)."""
    pose = _pose(shape.frame)
    match shape.kind, shape.size:
        case "box", (x, y, z):
            return box(x, y, z, pose)
        case "cylinder", (radius, length):
            return cylinder(radius, length, pose)
        case "capsule", (radius, length):
            return capsule(radius, length, pose)
        case "sphere", (radius,):
            return sphere(radius, pose)
        case "half_space", (x, y, z):
            return half_space(frames.rotate(pose[1], (x, y, z)), pose[0])
    try:
        path = mesh_in_folder(shape.mesh, folder)
    except NoMesh as why:
        draft.report("RG827", f"mesh of {owner}: {why}", "put it into the cell file's folder")
        return None
    if not shape.scale:
        draft.report("RG825", f"mesh of {owner} has no unit", "add `unit: mm` or `unit: m`")
        return None
    return _hull_of(path, np.full(3, shape.scale), pose, owner, draft)


def _zone_shapes(zone: ZoneKeys) -> tuple[Shape, ...]:
    """Return the box to keep out of, or the six half-spaces around one to keep inside."""
    low = np.array(zone.box.low) / 1000
    high = np.array(zone.box.high) / 1000
    x, y, z = ((low + high) / 2).tolist()
    if zone.keep == "out":
        a, b, c = np.abs(high - low).tolist()
        return (box(a, b, c, ((x, y, z), frames.UNIT)),)
    sides = []
    for axis in np.eye(3):
        for normal, corner in ((axis, low), (-axis, high)):
            u, v, w = corner.tolist()
            sides.append(half_space(normal.tolist(), (u, v, w)))
    return tuple(sides)


def _zone_pairs(name: str, zone: ZoneKeys, index: int, draft: _Draft) -> list[Pair]:
    """Return pairs of a zone with the bodies that it concerns (RG829)."""
    moving = [(i, b) for i, b in enumerate(draft.bodies[:index]) if b.owner]
    result = []
    for word in zone.of:
        chosen = [
            i
            for i, b in moving
            if (word == _EVERYTHING and b.role != "zone") or word in (b.name, b.name.split("/")[-1])
        ]
        # The base of a robot does not move.
        chosen = [i for i in chosen if draft.bodies[i].node != WORLD or word != _EVERYTHING]
        if not chosen and word != _EVERYTHING:
            names = [b.name for _, b in moving]
            draft.report("RG829", f"zone {name}: no '{word}' moves", suggest(word, names))
        result += [Pair(i, index, 0.0) for i in chosen]
    return result


def _special_pairs(
    cell: CellDescription, draft: _Draft
) -> tuple[dict[frozenset[str], str], dict[frozenset[str], float]]:
    """Return reasons of allowed pairs, and clearances in m of others (RG829, RG833)."""
    keys = cell.collision or CollisionKeys()
    names = [body.name for body in draft.bodies]
    allowed: dict[frozenset[str], str] = {}
    special: dict[frozenset[str], float] = {}
    for text, value in keys.pairs.items():
        parts = _PAIR.split(text.strip())
        unknown = [part for part in parts if part not in names]
        if len(parts) != 2 or unknown:
            wrong = unknown[0] if unknown else text
            help = suggest(wrong, names) or f"bodies of this cell: {', '.join(names[:30])}"
            draft.report("RG829", f"collision.pairs: '{text}': no body '{wrong}'", help)
            continue
        if isinstance(value, AllowedKeys):
            allowed[frozenset(parts)] = value.allowed
        else:
            special[frozenset(parts)] = value / 1000
    if keys.srdf:
        for one, other, reason in read_srdf(cell.folder, keys.srdf):
            allowed.setdefault(frozenset((one, other)), f"SRDF: {reason}")
    return allowed, special


def _pairs(
    cell: CellDescription,
    draft: _Draft,
    tree: Tree,
    allowed: Mapping[frozenset[str], str],
    special: Mapping[frozenset[str], float],
) -> Iterator[Pair]:
    """Yield pairs of bodies that can change their distance, without neighbours.

    Neighbours are bodies of one robot that a joint connects, or that hang on the same node or on
    parent and child.
    """
    keys = cell.collision or CollisionKeys()
    clearance, own_clearance = keys.clearance / 1000, keys.self_clearance / 1000
    for i, one in enumerate(draft.bodies):
        for j, other in enumerate(draft.bodies[i + 1 :], i + 1):
            names = frozenset((one.name, other.name))
            if one.node == other.node or "zone" in (one.role, other.role) or names in allowed:
                continue
            is_own = bool(one.owner) and one.owner == other.owner
            if is_own and (
                names in draft.neighbours or _are_neighbours(tree, one.node, other.node)
            ):
                continue
            standard = own_clearance if is_own else clearance
            yield Pair(i, j, special.get(names, standard))


def _are_neighbours(tree: Tree, a: int, b: int) -> bool:
    def parent(node: int) -> int:
        return WORLD if node == WORLD else tree.nodes[node].parent

    return parent(a) == b or parent(b) == a
