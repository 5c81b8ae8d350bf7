"""Map joints to controller axes, inferred only if unambiguous.

Six turning joints in one chain whose names end in 1 to 6 in that order are rax_1..rax_6. Everything
else is an error that lists the candidates and the lines to paste.
"""

import re
from collections.abc import Sequence

from rapidgen.config.axis_sets import ROBOT_AXES
from rapidgen.config.placeholders import OPEN
from rapidgen.config.urdf.arms import read_cell
from rapidgen.config.urdf.graph import Graph
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

_NUMBER = re.compile(r"^(?P<prefix>.*?)(?P<number>\d+)(?P<suffix>\D{0,12})$")
_GRIPPER_STROKE = 0.1
_MOST_LINES = 24
_USUAL = ("joint_", "joint", "j", "axis", "axis_", "a")


def number_of(name: str) -> tuple[str, int, str] | None:
    """Return prefix, number and suffix of a joint's name.

    `arm_joint_3_l` is (arm_joint_, 3, _l).
    """
    hit = _NUMBER.match(name)
    return (hit["prefix"], int(hit["number"]), hit["suffix"]) if hit else None


def infer(
    graph: Graph, joints: Sequence[UrdfJoint], place: Span | None
) -> tuple[dict[str, str], list[Diagnostic]]:
    """Return axes by joint name, or findings.

    `joints` are actuated and not ignored.
    """
    if not joints:
        return {}, [
            error(
                "RG031",
                place,
                "the description has no joint that moves by itself",
                "is this the top-level file of the robot?",
            )
        ]
    chains = graph.chains(joints)
    problem = _shape(graph, joints, chains, place) or _numbers(graph, chains[0], place)
    if problem:
        return {}, [problem]
    mapping = {joint.name: axis for joint, axis in zip(chains[0], ROBOT_AXES, strict=True)}
    parts = number_of(chains[0][0].name)
    assert parts is not None
    findings: list[Diagnostic] = []
    if parts[0].lower() not in _USUAL or parts[2]:
        table = ", ".join(f"{name} = {axis}" for name, axis in mapping.items())
        findings.append(
            error(
                "RG036",
                place,
                f"joint names have a prefix or suffix; read as {table}",
                "write the mapping under `joints:` to settle it",
                severity=Severity.WARNING,
            )
        )
    return mapping, findings


def paste(graph: Graph, joints: Sequence[UrdfJoint], *, ignore: Sequence[str] = ()) -> str:
    """Return YAML lines with the mapping, by chain order and arm shape.

    An ambiguous line is a placeholder, which is rejected until filled in (RG022).
    """
    axes: dict[str, str] = {}
    signs: dict[str, str] = {}
    for arm in read_cell(graph, (), {}).arms:
        axes.update({j.name: axis for j, axis in zip(arm.joints, arm.axes, strict=True)})
        if arm.alignment:
            for j, way in zip(arm.joints, arm.alignment.signs, strict=True):
                if way < 0:
                    signs[j.name] = f", sign: {way if arm.alignment.certain else OPEN}"
    lines = ["joints:   # check every line against the robot; unused joints: urdf.ignore_joints"]
    for joint in joints:
        if joint.name in ignore:
            continue
        unit = ", unit: mm" if joint.kind == "prismatic" else ""
        sign = signs.get(joint.name, "")
        name = joint.name if re.fullmatch(r"\w+", joint.name) else f'"{joint.name}"'
        lines.append(f"  {name}: {{axis: {axes.get(joint.name) or OPEN}{unit}{sign}}}")
        if len(lines) > _MOST_LINES:
            lines.append(f"  # and {len(joints) - _MOST_LINES} more")
            break
    return "\n".join(lines)


def _shape(
    graph: Graph,
    joints: Sequence[UrdfJoint],
    chains: tuple[tuple[UrdfJoint, ...], ...],
    place: Span | None,
) -> Diagnostic | None:
    """Report too many, too few or branching joints."""
    own = {joint.name for joint in joints}
    arms = [a for a in read_cell(graph, (), {}).arms if own >= {j.name for j in a.joints}]
    if len(arms) > 1:
        tips = [graph.tip_link(arm.joints[-1]) for arm in arms]
        displayed = ", ".join(tips[:6]) + (", ..." if len(tips) > 6 else "")
        return error(
            "RG052",
            place,
            f"{len(arms)} robots are in one description (tips: {displayed})",
            f"add\n  urdf:\n    tip: {tips[0]}\none group for each robot, each with its own task",
            label="which of them is this group?",
        )
    gripper = next((j for j in joints if _is_gripper(graph, j)), None)
    if gripper and len(joints) > 6:
        return error(
            "RG044",
            gripper.span or place,
            f"'{gripper.name}' looks like a gripper",
            f"add\n  urdf:\n    ignore_joints: [{gripper.name}]\n"
            + paste(graph, joints, ignore=[gripper.name]),
            label="moves less than 0.1 m after the arm",
        )
    still = [j for j in joints if j.lower is not None and j.lower == j.upper]
    if still and len(joints) > 6:
        names = ", ".join(j.name for j in still)
        return error(
            "RG043",
            still[0].span or place,
            f"{len(joints)} joints move by themselves; {names} cannot be a controller axis",
            f"add\n  urdf:\n    ignore_joints: [{names}]",
            label="its range is 0..0",
        )
    if len(joints) > 6 and (outside := _outside(graph, joints)):
        names = ", ".join(j.name for j in outside)
        return error(
            "RG046",
            outside[0].span or place,
            f"{names}: an external axis on or under the robot?",
            "map it to eax_a, eax_b, ... in the order of the controller:\n" + paste(graph, joints),
            label="not one of the robot's six",
        )
    if len(joints) == 7 and len(chains) == 1:
        return error(
            "RG045",
            place,
            "seven joints in one chain: which one is the seventh axis?",
            paste(graph, joints),
            label="controllers call it eax_a, and names of joints often number it otherwise",
        )
    if len(joints) > 6:
        return error(
            "RG043",
            place,
            f"{len(joints)} joints move by themselves; a robot has six axes",
            "name the others under urdf.ignore_joints, or map all:\n" + paste(graph, joints),
            label=", ".join(j.name for j in joints[:12]),
        )
    if len(joints) == 4 and not any(j.mimic for j in graph.path_to(joints[-1].child)):
        return error(
            "RG050",
            place,
            "four joints: a SCARA or a palletiser?",
            "a SCARA has rax_1, rax_2, rax_3, rax_4; a palletiser rax_1, rax_2, rax_3, rax_6:\n"
            + paste(graph, joints),
        )
    mimics = [j for j in graph.path_to(joints[-1].child) if j.mimic]
    if mimics and len(joints) < 6:
        return error(
            "RG042",
            mimics[0].span or place,
            f"joint '{mimics[0].name}' mimics '{mimics[0].mimic}' and drives no axis: "
            f"{len(joints)} joints are left for the axes of the arm",
            "take the <mimic> out where the joint is an axis",
            label="not an axis",
        )
    if len(joints) < 6 or len(chains) > 1:
        return error(
            "RG034",
            place,
            f"cannot infer the axes of {len(joints)} joints in {len(chains)} chain(s)",
            paste(graph, joints),
            label=", ".join(j.name for j in joints[:12]),
        )
    return None


def unmapped(graph: Graph, left: Sequence[UrdfJoint], place: Span | None) -> Diagnostic:
    """Report the joints that a given mapping omits."""
    first = left[0]
    names = ", ".join(joint.name for joint in left[:_MOST_LINES])
    code, what = "RG043", f"{names}: neither mapped nor ignored"
    if _is_gripper(graph, first):
        code, what = "RG044", f"'{first.name}' looks like a gripper: neither mapped nor ignored"
    return error(
        code,
        first.span or place,
        what,
        f"add\n  urdf:\n    ignore_joints: [{names}]\nor map it under `joints:`",
        label="moves by itself",
    )


def _is_gripper(graph: Graph, joint: UrdfJoint) -> bool:
    if joint.kind != "prismatic" or joint.lower is None or joint.upper is None:
        return False
    after = sum(j.is_actuated and j.kind != "prismatic" for j in graph.ancestors(joint))
    return after >= 4 and 0 < joint.upper - joint.lower < _GRIPPER_STROKE


def _outside(graph: Graph, joints: Sequence[UrdfJoint]) -> list[UrdfJoint]:
    """Return joints that are not among six turning ones of one chain.

    Their names must be numbered 1 to 6.
    """
    numbers = {j.name: parts[1] if (parts := number_of(j.name)) else 0 for j in joints}
    six = [j for j in joints if 1 <= numbers[j.name] <= 6 and _turns(j)]
    if sorted(numbers[j.name] for j in six) != [1, 2, 3, 4, 5, 6]:
        return []
    last = max(six, key=lambda j: len(graph.ancestors(j)))
    arm = {a.name for a in (*graph.ancestors(last), last)}
    if not all(j.name in arm for j in six):
        return []
    return [j for j in joints if j not in six and numbers[j.name] != 7]


def _turns(joint: UrdfJoint) -> bool:
    return joint.kind in ("revolute", "continuous")


def _numbers(graph: Graph, chain: Sequence[UrdfJoint], place: Span | None) -> Diagnostic | None:
    """Check that the names of six joints in one chain count 1 to 6."""
    sliding = next((j for j in chain if not _turns(j)), None)
    if sliding:
        return error(
            "RG034",
            sliding.span or place,
            f"cannot infer the axis of '{sliding.name}': it is {sliding.kind}",
            paste(graph, chain),
        )
    parts = [number_of(joint.name) for joint in chain]
    numbers = [p[1] if p else None for p in parts]
    if numbers == [1, 2, 3, 4, 5, 6] and len({(p[0], p[2]) for p in parts if p}) == 1:
        return None
    if numbers == [1, 2, 3, 4, 5, 6]:
        spelt = [(p[0], p[2]) for p in parts if p]
        usual = max(spelt, key=spelt.count)
        odd = next(j for j, own in zip(chain, spelt, strict=True) if own != usual)
        like = next(j for j, own in zip(chain, spelt, strict=True) if own == usual)
        return error(
            "RG034",
            odd.span or place,
            f"cannot infer the axis of '{odd.name}': it is not spelt like '{like.name}'",
            paste(graph, chain),
        )
    if sorted(n or 0 for n in numbers) == [1, 2, 3, 4, 5, 6]:
        index = next((i for i, n in enumerate(numbers) if n != i + 1), 0)
        return error(
            "RG034",
            chain[index].span or place,
            f"cannot infer the axis of '{chain[index].name}': it is number {index + 1} in the "
            f"chain and says {numbers[index]}",
            paste(graph, chain),
        )
    displayed = ", ".join(joint.name for joint in chain)
    return error(
        "RG035",
        place,
        f"the numbers in the joint names are not 1 to 6: {displayed}",
        paste(graph, chain),
        label="the number in a name need not be the axis",
    )
