"""Process one group's `urdf:` section: read, map joints, complete."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import dropwhile, pairwise
from pathlib import Path

from rapidgen.config import schema
from rapidgen.config.axis_sets import ROBOT_AXES
from rapidgen.config.draft import GroupDraft, JointDraft
from rapidgen.config.model import ChainLink
from rapidgen.config.urdf import crosscheck, limits
from rapidgen.config.urdf.arms import MOST_MOVING
from rapidgen.config.urdf.expand import Request, expand
from rapidgen.config.urdf.graph import Graph, build_graph, check_axis
from rapidgen.config.urdf.mapping import infer, paste, unmapped
from rapidgen.config.urdf.packages import Packages
from rapidgen.config.urdf.robot import UrdfJoint, read_robot
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error, suggest

Found = list[Diagnostic]


def complete(
    draft: GroupDraft,
    value: schema.UrdfKeys,
    folder: Path,
    package_paths: Sequence[Path],
    elsewhere: frozenset[str],
    place: Span | None,
) -> tuple[Found, list[tuple[str, bytes]]]:
    """Complete `draft` from its URDF; return findings and files.

    `folder` is the base of relative paths; `elsewhere` are the joints that other groups drive.
    """
    return complete_from(draft, value, request(value, folder, package_paths, place), elsewhere)


def complete_from(
    draft: GroupDraft, value: schema.UrdfKeys, expected: Request, elsewhere: frozenset[str]
) -> tuple[Found, list[tuple[str, bytes]]]:
    """Complete a draft for an existing request."""
    place = expected.place
    try:
        description = expand(expected)
        robot = read_robot(description, place)
    except DiagnosticError as fault:
        return list(fault.diagnostics), []
    graph, result = build_graph(robot, place)
    result = [*description.found, *result]
    if any(d.severity is Severity.ERROR for d in result):
        return result, description.inputs
    candidates, faults = _candidates(graph, value, elsewhere, place)
    if len(candidates) > MOST_MOVING:
        many = f"{len(candidates)} joints move by themselves"
        faults.append(error("RG043", place, many, "name the arm's end with urdf.tip"))
    result += faults
    if not faults:
        result += _map(draft, graph, candidates, elsewhere, place)
        result += crosscheck.check_coupling(draft, robot, description.path.name, place)
    if not any(d.severity is Severity.ERROR for d in result):
        result += _fill(draft, graph, place)
        draft.ignored = tuple(j.name for j in _ignored(_path(graph, draft, value.tip or ""), draft))
        draft.names = (robot.name, description.path.name)
        draft.urdf_chain = chain(graph, draft, value.tip or "")
        if not draft.chain or any(j.sign < 0 or j.offset for j in draft.joints):
            # The chain has the URDF's sense, so that a model's signs do not apply.
            draft.chain = draft.urdf_chain
    return result, description.inputs


def request(
    value: schema.UrdfKeys, folder: Path, package_paths: Sequence[Path], place: Span | None
) -> Request:
    """Return the request, with paths relative to the configuration's folder."""
    path = folder / value.file
    explicit = {name: (folder / where).resolve() for name, where in value.packages.items()}
    return Request(
        path,
        Packages(explicit, [Path(p) for p in package_paths], path.resolve().parent),
        _texts(value.args),
        value.macro or "",
        _texts(value.macro_args),
        place,
    )


def _texts(values: Mapping[str, object]) -> dict[str, str]:
    return {
        name: str(value).lower() if isinstance(value, bool) else str(getattr(value, "text", value))
        for name, value in values.items()
    }


def _candidates(
    graph: Graph, value: schema.UrdfKeys, elsewhere: frozenset[str], place: Span | None
) -> tuple[list[UrdfJoint], Found]:
    """Return the actuated joints that concern this group."""
    robot = graph.robot
    names = [joint.name for joint in robot.joints]
    findings: Found = []
    for name in value.ignore_joints:
        if name not in names:
            meant = suggest(name, names)
            findings.append(error("RG043", place, f"ignore_joints: no joint '{name}'", meant))
    joints = [
        j
        for j in robot.joints
        if j.is_actuated and j.name not in value.ignore_joints and j.name not in elsewhere
    ]
    if value.tip:
        end = robot.joint(value.tip)
        link = end.child if end else value.tip
        if link not in robot.links:
            meant = suggest(value.tip, [*robot.links, *names])
            return [], [
                *findings,
                error("RG052", place, f"no link or joint '{value.tip}'", meant),
            ]
        path = {j.name for j in graph.path_to(link)}
        joints = [j for j in joints if j.name in path]
    for joint in joints:
        if joint.kind in ("floating", "planar"):
            findings.append(
                error(
                    "RG053",
                    joint.span or place,
                    f"joint '{joint.name}' is {joint.kind}; no controller axis is",
                    f"name it under urdf.ignore_joints, or make it fixed: [{joint.name}]",
                )
            )
        elif joint.has_zero_axis:
            findings.append(check_axis(joint, place))
    return joints, findings


def _map(
    draft: GroupDraft,
    graph: Graph,
    candidates: list[UrdfJoint],
    elsewhere: frozenset[str],
    place: Span | None,
) -> Found:
    """Map joints to axes: as configured, else inferred."""
    robot = graph.robot
    named = [joint for joint in draft.joints if robot.joint(joint.name)]
    if not named:
        mapping, result = infer(graph, candidates, place)
        if mapping and draft.joints:
            result += _rename(draft, mapping, place)
        elif mapping:
            draft.joints = [JointDraft(name, axis) for name, axis in mapping.items()]
        return result
    result = []
    for joint in draft.joints:
        result += _named(joint, graph, place)
    if result:
        return result
    if any(not joint.axis for joint in draft.joints):
        mapping, result = infer(graph, candidates, place)
        if any(d.severity is Severity.ERROR for d in result):
            return result
        _complete(draft, mapping)
    mapped = {joint.name for joint in draft.joints}
    left = [j for j in candidates if j.name not in mapped and not j.has_empty_range]
    if left:
        return [*result, unmapped(graph, left, place)]
    return [*result, *_order(draft, graph, place)]


def _complete(draft: GroupDraft, mapping: dict[str, str]) -> None:
    """Assign axes to joints with figures only.

    With them, unnamed joints get theirs.
    """
    for joint in draft.joints:
        joint.axis = joint.axis or mapping.get(joint.name, "")
    if all(mapping.get(joint.name) == joint.axis for joint in draft.joints):
        own = {joint.name: joint for joint in draft.joints}
        draft.joints = [own.get(name) or JointDraft(name, axis) for name, axis in mapping.items()]


def _rename(draft: GroupDraft, mapping: dict[str, str], place: Span | None) -> Iterator[Diagnostic]:
    """Give the model's joints the URDF's names, axis by axis."""
    by_axis = {axis: name for name, axis in mapping.items()}
    if set(by_axis) != {joint.axis for joint in draft.joints}:
        displayed = ", ".join(joint.axis for joint in draft.joints)
        yield error(
            "RG034",
            place,
            f"the model has the axes {displayed}; the URDF has {', '.join(mapping)}",
            "map them under `joints:`",
        )
        return
    names = {joint.name: by_axis[joint.axis] for joint in draft.joints}
    for joint in draft.joints:
        joint.name = names[joint.name]
    for chain in (draft.chain, *draft.positioners.values()):
        chain[:] = [
            ChainLink(
                names.get(link.joint, link.joint),
                link.xyz,
                link.rpy,
                link.axis,
                tuple((names.get(name, name), factor) for name, factor in link.follows),
            )
            for link in chain
        ]


def _named(joint: JointDraft, graph: Graph, place: Span | None) -> Iterator[Diagnostic]:
    known = graph.robot.joint(joint.name)
    if known is None:
        names = [j.name for j in graph.robot.joints]
        yield error(
            "RG034",
            place,
            f"the URDF has no joint '{joint.name}'",
            suggest(joint.name, names) or f"it has {', '.join(names[:20])}",
        )
        return
    if known.mimic:
        yield error(
            "RG042",
            known.span or place,
            f"joint '{joint.name}' mimics '{known.mimic}' and drives no axis",
            f"map '{known.mimic}' instead",
        )
    elif known.kind == "fixed":
        yield error(
            "RG034", known.span or place, f"joint '{joint.name}' is fixed", "map a joint that moves"
        )


def _order(draft: GroupDraft, graph: Graph, place: Span | None) -> Found:
    """Check that the robot axes are in one chain, in order.

    External axes may be anywhere.
    """
    by_axis = {joint.axis: graph.robot.joint(joint.name) for joint in draft.joints}
    robot_axes = [by_axis[axis] for axis in ROBOT_AXES if by_axis.get(axis)]
    findings: Found = []
    for before, after in pairwise(robot_axes):
        assert before is not None
        assert after is not None
        if before.name not in {j.name for j in graph.ancestors(after)}:
            axis = next(j.axis for j in draft.joints if j.name == after.name)
            findings.append(
                error(
                    "RG046",
                    after.span or place,
                    f"'{after.name}' cannot be {axis}: it does not hang on '{before.name}'",
                    "an axis on another branch or under the robot is external: eax_a..eax_f\n"
                    + paste(graph, [j for j in graph.robot.joints if j.is_actuated]),
                )
            )
    first = robot_axes[0] if robot_axes else None
    if first and not findings:
        below = {j.name for j in graph.ancestors(first)}
        moving = [j.name for j in draft.joints if j.name in below]
        if moving:
            findings.append(
                error(
                    "RG046",
                    place,
                    f"{', '.join(moving)} carries the robot: its base moves",
                    "positions that RAPID gives are in the frames of the controller, not of "
                    "the URDF's root",
                    severity=Severity.INFO,
                )
            )
    return findings


def _fill(draft: GroupDraft, graph: Graph, place: Span | None) -> Found:
    result: Found = []
    phrases: list[str] = []
    for joint in draft.joints:
        known = graph.robot.joint(joint.name)
        assert known is not None
        phrase = crosscheck.check_joint(joint, known, draft)
        phrases += [phrase] if phrase else []
        result += limits.fill(joint, known, place)
    return [*result, *crosscheck.differences(phrases, place)]


def _path(graph: Graph, draft: GroupDraft, tip: str) -> tuple[UrdfJoint, ...]:
    """Return all joints from the root to the flange."""
    by_axis = {joint.axis: joint.name for joint in draft.joints}
    last = next(
        (by_axis[axis] for axis in reversed(ROBOT_AXES) if axis in by_axis), draft.joints[-1].name
    )
    end = graph.robot.joint(last)
    assert end is not None
    return graph.path_to(tip if tip in graph.robot.links else graph.tip_link(end))


def _ignored(path: Sequence[UrdfJoint], draft: GroupDraft) -> tuple[UrdfJoint, ...]:
    """Return actuated joints of the arm that drive no axis."""
    axes = {joint.name: joint.axis for joint in draft.joints}
    arm = dropwhile(lambda joint: not axes.get(joint.name, "").startswith("rax"), path)
    return tuple(
        joint
        for joint in arm
        if joint.is_actuated and joint.name not in axes and not joint.has_empty_range
    )


def chain(graph: Graph, draft: GroupDraft, tip: str) -> list[ChainLink]:
    """Return the kinematic chain from root to flange, in the URDF's sense.

    A turning joint that mimics a mapped one follows it; a sliding one is fixed. Joints of the arm
    without an axis are fixed at their `held_axes` values.
    """
    mapped = {joint.name for joint in draft.joints}
    path = _path(graph, draft, tip)
    saved = dict(zip((j.name for j in _ignored(path, draft)), draft.held_axes, strict=False))
    made = []
    for joint in path:
        if saved.get(joint.name):
            made.append(ChainLink("", *joint.moved(saved[joint.name])))
        elif joint.name in mapped:
            made.append(ChainLink(joint.name, joint.xyz, joint.rpy, joint.axis))
        elif joint.mimic in mapped and joint.kind != "prismatic":
            follows = ((joint.mimic, joint.multiplier),)
            made.append(ChainLink("", joint.xyz, joint.rpy, joint.axis, follows))
        elif any(joint.xyz) or any(joint.rpy):
            made.append(ChainLink("", joint.xyz, joint.rpy))
    return made
