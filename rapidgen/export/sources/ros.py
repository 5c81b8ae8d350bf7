"""ROS trajectories in YAML: JointTrajectory, and MoveIt's RobotTrajectory.

The text is what `ros2 topic echo`, `rostopic echo` or a YAML dump of the message prints. Angles are
rad and lengths m, as in all messages of ROS. Only positions and times are used.
"""

from pathlib import Path

from rapidgen.config.yaml_tree import MappingNode, Node, ScalarNode, SequenceNode, parse
from rapidgen.diagnostics import Diagnostic, DiagnosticError
from rapidgen.export.sources.toolpath import JointPath, bad_source, read_text, reject

_KEYS = "joint_names and points, or joint_trajectory with them"


def read_ros(path: Path) -> JointPath:
    """Read a message. Raises DiagnosticError RG760 with all faults."""
    # `topic echo` ends a message with the separator of documents.
    text = read_text(path).rstrip()
    text = text.removesuffix("---").removeprefix("---")
    where = str(path)
    root, faults = parse(text, where)
    if faults:
        raise DiagnosticError(faults)
    message = _trajectory(root, where)
    names = [_text(node, where) for node in _items(message, "joint_names", where)]
    times: list[float] = []
    positions: list[tuple[float, ...]] = []
    lines: list[int] = []
    findings: list[Diagnostic] = []
    for number, point in enumerate(_items(message, "points", where)):
        try:
            row = tuple(_number(node) for node in _items(point, "positions", where))
            if len(row) != len(names):
                raise ValueError(f"{len(row)} positions for {len(names)} joints")
            times.append(_seconds(_entry(point, "time_from_start")))
        except ValueError as fault:
            message_text = f"point {number}: {fault}"
            findings.append(bad_source(where, point.span.line, message_text))
            continue
        positions.append(row)
        lines.append(point.span.line)
    if not findings and not positions:
        findings.append(bad_source(where, message.span.line, "the trajectory has no points"))
    reject(findings)
    return JointPath(tuple(times), tuple(positions), tuple(names), where, tuple(lines))


def _trajectory(root: Node, where: str) -> MappingNode:
    """Return the JointTrajectory of a message."""
    node = root
    listed = _entry(node, "trajectory")
    if isinstance(listed, SequenceNode):
        if len(listed.items) != 1:
            message = f"the message has {len(listed.items)} trajectories"
            reject([bad_source(where, listed.span.line, message, "save one of them")])
        node = listed.items[0]
    other = _entry(node, "multi_dof_joint_trajectory")
    points = _entry(other, "points") if other is not None else None
    if isinstance(points, SequenceNode) and points.items:
        message = "a path of joints with several degrees of freedom"
        reject([bad_source(where, points.span.line, message, "plan for the robot's own joints")])
    node = _entry(node, "joint_trajectory") or node
    if not isinstance(node, MappingNode) or "points" not in node.entries:
        reject([bad_source(where, root.span.line, "no JointTrajectory", _KEYS)])
    assert isinstance(node, MappingNode), "others are rejected"
    return node


def _entry(node: Node | None, key: str) -> Node | None:
    if isinstance(node, MappingNode) and key in node.entries:
        return node.entries[key][1]
    return None


def _items(node: Node, key: str, where: str) -> tuple[Node, ...]:
    found = _entry(node, key)
    if isinstance(found, SequenceNode):
        return found.items
    reject([bad_source(where, node.span.line, f"'{key}' is not a list", _KEYS)])
    return ()


def _text(node: Node, where: str) -> str:
    if isinstance(node, ScalarNode) and isinstance(node.value, str):
        return node.value
    reject([bad_source(where, node.span.line, "a joint's name is a text")])
    return ""


def _number(node: Node | None) -> float:
    if (
        isinstance(node, ScalarNode)
        and isinstance(node.value, int | float)
        and not isinstance(node.value, bool)
    ):
        value = float(node.value)
        if value - value == 0:
            return value
    raise ValueError("a value is not a finite number")


def _seconds(node: Node | None) -> float:
    for complete, part in (("secs", "nsecs"), ("sec", "nanosec")):
        if (whole := _entry(node, complete)) is not None:
            rest = _entry(node, part)
            return _number(whole) + (1e-9 * _number(rest) if rest is not None else 0.0)
    try:
        return _number(node)
    except ValueError:
        raise ValueError("time_from_start has neither sec nor secs") from None
