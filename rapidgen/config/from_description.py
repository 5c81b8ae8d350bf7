"""Create a configuration text from a robot description.

Open values are marked `???`.
"""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from rapidgen.config import schema
from rapidgen.config.axis_sets import ROBOT_AXES
from rapidgen.config.consistency import is_mirror
from rapidgen.config.draft import DescriptionChoices, JointDraft
from rapidgen.config.model import ChainLink
from rapidgen.config.placeholders import OPEN
from rapidgen.config.recognition import Alignment
from rapidgen.config.truncation import limit_findings
from rapidgen.config.urdf import limits
from rapidgen.config.urdf.arms import Arm, Cell, mentions_abb, no_robot, read_cell
from rapidgen.config.urdf.crosscheck import COUPLED, SERIAL
from rapidgen.config.urdf.expand import expand
from rapidgen.config.urdf.graph import build_graph, check_axis
from rapidgen.config.urdf.group import request
from rapidgen.config.urdf.robot import UrdfJoint, read_robot
from rapidgen.config.urdf.source import macros, read_xml
from rapidgen.config.variant_library import Variant, family
from rapidgen.config.yaml_text import yaml_flow, yaml_text
from rapidgen.diagnostics import DiagnosticError, Severity, refusal, suggest

_PACKAGE = re.compile(r"package://([\w-]+)")
_SIDE = re.compile(r"(?:^|_|rob|arm)([lr])(?:_|\d|$)|(?=left|right)([lr])")
_EXTERNAL = tuple(f"eax_{letter}" for letter in "abcdef")


@dataclass(slots=True)
class JointLine:
    """One joint of the generated file."""

    name: str
    axis: str
    keys: list[str] = field(default_factory=list)
    comment: str = ""
    is_known: bool = False
    """True if a known variant has its figures."""

    def text(self, width: int) -> str:
        """Return the line as written to the file."""
        keys = ", ".join([f"axis: {self.axis}", *self.keys])
        body = f"{yaml_text(self.name)}: {{{keys}}}"
        return f"{body:<{width}}  # {self.comment}" if self.comment else body


@dataclass(slots=True)
class GroupText:
    """One group of the generated file."""

    name: str
    head: list[str]
    joints: list[JointLine]
    tail: list[str]
    tasks: list[str]
    family: str


def describe(
    urdf: Path,
    folder: Path,
    package_paths: Sequence[Path],
    value: schema.UrdfKeys,
    answers: DescriptionChoices,
) -> tuple[schema.UrdfKeys, list[GroupText], Mapping[str, Path]]:
    """Return the groups of a description, and the packages used.

    Raises DiagnosticError for a text without description, tree or ABB robot.
    """
    value = _with_macro(urdf, value)
    expected = request(value, folder, package_paths, None)
    description = expand(expected)
    robot = read_robot(description, None)
    graph, result = build_graph(robot, None)
    names = (robot.name, description.path.name)
    axes_of_joints = {**dict.fromkeys(answers.ignore, ""), **answers.joints}
    around = (*description.path.resolve().parts[-5:-1], *_PACKAGE.findall(description.text))
    claimed = bool(axes_of_joints or answers.tips) or mentions_abb(
        *names, *around, description.text
    )
    cell = replace(read_cell(graph, names, axes_of_joints), around=around, is_claimed=claimed)
    faults = [d for d in result if d.severity is Severity.ERROR]
    # Joints after the end of an arm belong to a gripper and are left out.
    left = {*answers.ignore, *(joint.name for arm in cell.arms for joint in arm.grippers)}
    faults += [
        check_axis(joint, None)
        for joint in robot.joints
        if joint.is_actuated and joint.has_zero_axis and joint.name not in left
    ]
    refused = list(no_robot(cell, None))
    if refused and refused[0].message.startswith("a delta"):
        faults = refused
    if faults or refused:
        raise DiagnosticError(limit_findings(faults or refused))
    _check_names(cell, answers)
    arms = _chosen(cell, answers)
    groups = [_group(cell, arm, arms, number, answers) for number, arm in enumerate(arms)]
    return value, groups, expected.packages.used


def _with_macro(urdf: Path, value: schema.UrdfKeys) -> schema.UrdfKeys:
    """Return the request with the robot's macro, for a file of macros only."""
    text, _ = read_xml(urdf)
    defined = macros(text)
    if value.macro or not defined or "<link" in text.split("<xacro:macro", 1)[0]:
        return value
    outside = text
    for part in text.split("<xacro:macro")[1:]:
        outside = outside.replace(part.split("</xacro:macro>")[0], "")
    if "<link" in outside or any(f"<xacro:{m.name}" in outside for m in defined):
        return value
    if "<xacro:include" in outside and any(
        f"<xacro:{word}" in outside for word in ("irb", "crb", "abb", "robot")
    ):
        return value
    robots = [m for m in defined if m.joints >= 4]
    return replace(value, macro=robots[0].name) if len(robots) == 1 else value


def _check_names(cell: Cell, answers: DescriptionChoices) -> None:
    names = [joint.name for joint in cell.graph.robot.joints]
    links = list(cell.graph.robot.links)
    for name in (*answers.joints, *answers.ignore, *filter(None, answers.ranges)):
        if name not in names:
            raise refusal(
                "RG020", None, f"the description has no joint '{name}'", suggest(name, names)
            )
    for tip in answers.tips:
        if tip not in links and tip not in names:
            known = [*links, *names]
            raise refusal("RG052", None, f"no link or joint '{tip}'", suggest(tip, known))


def _chosen(cell: Cell, answers: DescriptionChoices) -> list[Arm]:
    """Return the arms that the tips lead to, else all."""
    if not answers.tips:
        return list(cell.arms)
    made = []
    for tip in answers.tips:
        joint = cell.graph.robot.joint(tip)
        path = {j.name for j in cell.graph.path_to(joint.child if joint else tip)}
        made += [arm for arm in cell.arms if arm.joints[-1].name in path and arm not in made]
    if not made:
        raise refusal(
            "RG052",
            None,
            f"no arm leads to {', '.join(answers.tips)}",
            "name the link at the arm's end",
        )
    return made


def _group(
    cell: Cell, arm: Arm, arms: Sequence[Arm], number: int, answers: DescriptionChoices
) -> GroupText:
    head, tail = [], []
    variant = arm.alignment.variant if arm.alignment else None
    own_family = family(*cell.names)
    same = variant is not None and (not own_family or own_family == variant.family)
    if arm.alignment and variant:
        others = "".join(f", or {name}" for name in arm.alignment.others[:3])
        message = f"This is an {variant.name}{others}, by its axes in space."
        if arm.alignment.rough:
            message = (
                f"By its name an {variant.name}; some of its axes are up to 10 mm off. Check it."
            )
        if not same:
            message = f"Its axes lie as those of an {variant.name}; the file calls it {own_family}."
        head.append(f"# {message}")
    else:
        head.append("# No known variant has these axes: check every line against the data sheet.")
        if not cell.is_claimed:
            head.append("# The description does not name ABB.")
    in_use = {*answers.joints.values(), *(("eax_a",) if "eax_a" in arm.axes else ())}
    free = [axis for axis in _EXTERNAL if axis not in in_use]
    mapped = [(joint, axis) for joint, axis in zip(arm.joints, arm.axes, strict=True)]
    mapped += [(joint, "") for joint in arm.under]
    if number == 0:
        mapped += [(joint, "") for chain in cell.positioners for joint in chain]
    lines = []
    external = {j.name for j in arm.under} | {j.name for c in cell.positioners for j in c}
    for place, (joint, inferred) in enumerate(mapped):
        if joint.name in answers.ignore:
            continue
        axis = answers.joints.get(joint.name) or inferred
        if not axis and joint.name in external and free:
            axis = free.pop(0)
        signs = arm.alignment
        aligned = signs if signs and place < len(arm.joints) else None
        lines.append(
            _line(joint, axis, aligned, place, variant if same and aligned else None, answers)
        )
    lines.sort(key=lambda line: (line.axis.startswith("eax"), line.axis == OPEN, line.axis))
    coupling, why = _coupling(arm, variant if same else None, cell.names, answers)
    tail.append(f"coupling: {coupling:<18}# {why}")
    if variant and any(line.is_known for line in lines):
        tail.append(f'source: {{limits: "{variant.name} of robots/variants.json"}}')
    if answers.held_axes:
        tail.append(f"held_axes: {yaml_flow(answers.held_axes)}")
    elif arm.axes == ROBOT_AXES[:3] and not any(line.axis == "rax_4" for line in lines):
        tail.append("held_axes: [rax_4]      # not in the description: held at its position")
    if number == 0:
        tail += _positioners(cell)
    tip = cell.graph.tip_link(arm.joints[-1])
    own = {line.name for line in lines} | set(answers.ignore)
    needs_tip = any(
        j.is_actuated and not j.has_empty_range and j.name not in own
        for j in cell.graph.robot.joints
    )
    name = _name(arm, arms, number)
    return GroupText(
        name,
        [*head, *([f"tip: {yaml_text(tip)}"] if needs_tip else [])],
        lines,
        tail,
        _tasks(name, arms, variant if same else None),
        own_family or (variant.family if variant else ""),
    )


def _name(arm: Arm, arms: Sequence[Arm], number: int) -> str:
    if len(arms) == 2 and len(arm.joints) == 7:
        sides = [_side(a.joints[0].name) for a in arms]
        if sorted(sides) == ["l", "r"]:
            return f"rob_{sides[number]}"
    return f"rob{number + 1}"


def _side(name: str) -> str:
    """Return l or r from a joint name of one of two arms.

    Examples: joint_1_l, robl_joint_1, left_1.
    """
    hit = _SIDE.search(name.lower())
    return (hit[1] or hit[2]) if hit else ""


def _tasks(name: str, arms: Sequence[Arm], variant: Variant | None) -> list[str]:
    """Return non-default task and unit names: both arms of a YuMi."""
    if name in ("rob_l", "rob_r"):
        arm = name[-1].upper()
        return [f"task: T_ROB_{arm}", f"mechanical_unit: ROB_{arm}"]
    if variant is None or variant.family != "14000" or len(arms) != 2:
        return []
    return [
        f"task: {OPEN}              # the left arm's is T_ROB_L, the right one's T_ROB_R",
        f"mechanical_unit: {OPEN}   # ROB_L or ROB_R",
    ]


def _line(
    joint: UrdfJoint,
    axis: str,
    aligned: Alignment | None,
    place: int,
    variant: Variant | None,
    answers: DescriptionChoices,
) -> JointLine:
    line = JointLine(joint.name, axis or OPEN)
    draft = JointDraft(joint.name, axis or "rax_1")
    if joint.kind == "prismatic":
        line.keys.append("unit: mm")
    if aligned:
        draft.sign, offset = aligned.signs[place], aligned.offsets[place]
        if draft.sign < 0:
            line.keys.append("sign: -1" if aligned.certain else f"sign: {OPEN}")
        if abs(offset) > 1e-9:
            draft.offset = round(math.degrees(offset), 3)
            line.keys.append(f"offset: {draft.offset:g}")
    known = variant.axis(axis) if variant and axis else None
    is_linear = joint.kind == "prismatic"
    unit = "mm" if is_linear else "deg"
    result = limits.fill(draft, joint, None)
    bad = {d.code for d in result if d.severity is not Severity.INFO}
    lower, upper, speed = draft.lower, draft.upper, draft.speed
    endless = joint.kind == "continuous"
    range_of_file = lower is not None and upper is not None and not endless and "RG041" not in bad
    mirrored = bool(known and is_mirror((lower, upper), (known.lower, known.upper)))
    comments = []
    message = answers.ranges.get(joint.name)
    if (
        message is None
        and not range_of_file
        and not is_linear
        and (not known or known.lower is None)
    ):
        message = answers.ranges.get("")
    if message:
        line.keys += [f"lower: {message[0]:g}", f"upper: {message[1]:g}"]
        comments.append("range as given")
    elif known and known.lower is not None and (not range_of_file or mirrored):
        line.keys += [f"lower: {known.lower:g}", f"upper: {known.upper:g}"]
        line.is_known = True
        comments += ["mirrored in the file"] if mirrored else []
    elif not range_of_file:
        line.keys += [f"lower: {OPEN}", f"upper: {OPEN}"]
        comments.append("turns without end in the file" if endless else "no range in the file")
    else:
        comments.append(f"{_round(lower):g}..{_round(upper):g} {unit}")
    placeholder = speed is not None and "speed" in draft.unsure
    if speed is None or placeholder or (known and known.speed and speed > known.speed * 1.01):
        figure = known.speed if known and known.speed else answers.speed
        line.keys.append(f"speed: {figure:g}" if figure else f"speed: {OPEN}")
        line.is_known = line.is_known or bool(known and known.speed)
        if known and known.speed and speed is not None:
            comments.append(f"the file says {speed:.4g} {unit}/s")
    else:
        comments.append(f"{speed:.4g} {unit}/s")
    line.comment = ", ".join(part for part in comments if part)
    return line


def _round(value: float | None) -> float:
    return math.floor((value or 0) * 100 + 0.5) / 100


def _coupling(
    arm: Arm, variant: Variant | None, names: tuple[str, ...], answers: DescriptionChoices
) -> tuple[str, str]:
    if answers.coupling is not None:
        return f"{answers.coupling:g}", "as given"
    if variant:
        source = f"{variant.name}: {dict(variant.sources)['coupling']}"
        if variant.coupling is not None and "coupling" not in variant.unsure:
            return f"{variant.coupling:g}", source
        return OPEN, f"{source}; no other source, check it"
    known = family(*names)
    if known in COUPLED:
        return "1", f"IRB {known} couples axes 2 and 3: axis 3 = joint_3 + joint_2"
    if known in SERIAL:
        return "0", f"IRB {known} is a serial robot"
    if any(joint.kind == "prismatic" for joint in arm.joints):
        return "0", "a SCARA couples nothing"
    return OPEN, "1 where a rod couples axes 2 and 3, 0 for a serial robot"


def _positioners(cell: Cell) -> list[str]:
    """Return external units, with the frame of their work objects."""
    if not cell.positioners:
        return []
    units = [f"STN_{n}" for n in range(1, len(cell.positioners) + 1)]
    lines = [
        f"external_units: [{', '.join(units)}]   # as the controller calls them",
        "positioners:",
    ]
    for unit, chain in zip(units, cell.positioners, strict=True):
        lines.append(f"  {unit}:")
        names = {j.name for j in chain}
        for joint in cell.graph.path_to(chain[-1].child):
            moved = joint.name in names
            if moved or any(joint.xyz) or any(joint.rpy):
                link = ChainLink(joint.name if moved else "", joint.xyz, joint.rpy, joint.axis)
                lines.append(f"    - {_step(link)}")
    return lines


def _step(link: ChainLink) -> str:
    parts = [f"joint: {yaml_text(link.joint)}"] if link.joint else []
    if any(link.xyz):
        parts.append(f"xyz: [{', '.join(f'{v * 1000:.6g}' for v in link.xyz)}]")
    if any(link.rpy):
        parts.append(f"rpy: [{', '.join(f'{math.degrees(v):.9g}' for v in link.rpy)}]")
    if link.joint:
        parts.append(f"axis: [{', '.join(f'{v:.9g}' for v in link.axis)}]")
    return "{" + ", ".join(parts) + "}"
