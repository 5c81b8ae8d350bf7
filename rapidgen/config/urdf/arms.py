"""Find the arms of a description, their carriers and their grippers."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rapidgen.config.axis_sets import ROBOT_AXES
from rapidgen.config.geometry import IDENTITY, Line, apply, from_rpy, times
from rapidgen.config.recognition import Alignment, align
from rapidgen.config.urdf.graph import Graph
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.config.vectors import Vector, add
from rapidgen.diagnostics import Diagnostic, Span, error, refusal

MOST_MOVING = 120
_MAKERS = re.compile(
    r"(?<![a-z0-9])(kuka|kr_?\d+\w*|lwr_?\d*|lbr\w*|iiwa\d*|fanuc\w*|lrmate\w*|m\d+i[abd]\w*|crx?\d+i\w*|"
    r"ur\d+e?|motoman|yaskawa|mh\d+|sia\d+\w?|panda|fr3|franka|staubli|[tr]x2?_?\d{2,3}l?|kinova|kortex|"
    r"gen3|jaco\w*|mico\w*|[jm]\d[ns]\ds\d+|movo|xarm\w*|lite_?6|denso|vs_?\d{3,4}|nachi|comau|kawasaki|"
    r"rs0?\d{2}[nl]|doosan|hyundai|mecademic|meca_?500\w*|puma_?\d*|schunk|lwa\w*|baxter|sawyer|interbotix|"
    r"[prvw]x\d{3}s?|phantomx|pincher|open_?manipulator\w*|qarm|al5d|widowx|dobot|niryo|igus|aubo|elfin|"
    r"jaka|techman|tm\d+|flexiv|rizon\w*|robonaut|r2[bc]\w*|valkyrie|atlas|pr2|fetch|tiago|nao|"
    r"anymal|shadow(?:_?hand)?|robotiq|so_?10[01])(?![a-z0-9])",
    re.IGNORECASE,
)
_ABB = re.compile(r"abb|irb|crb|yumi|gofa|swifti", re.IGNORECASE)
_WORDS = re.compile(r"[/\\. -]|(?<=[a-z])(?=[A-Z])")
_DELTA = re.compile(r"irb[_ -]?(340|360|390)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Arm:
    """One robot of a description: its joints along the chain."""

    joints: tuple[UrdfJoint, ...]
    axes: tuple[str, ...]
    """Axis of each joint; empty: not known."""
    alignment: Alignment | None
    under: tuple[UrdfJoint, ...] = ()
    """Joints that carry the robot: a track, a gantry."""
    grippers: tuple[UrdfJoint, ...] = ()
    """Joints after the flange: grippers."""


@dataclass(frozen=True, slots=True)
class Cell:
    """All actuated parts of a description."""

    graph: Graph
    arms: tuple[Arm, ...]
    positioners: tuple[tuple[UrdfJoint, ...], ...] = ()
    names: tuple[str, ...] = ()
    """Names of the robot and its file."""
    around: tuple[str, ...] = ()
    """Folders of the file, packages of its meshes."""
    is_claimed: bool = False
    """True if a name, a folder or the user says that it is an ABB robot."""


def mentions_abb(*texts: str) -> bool:
    """True if a text names ABB or one of its robots."""
    return any(map(_ABB.search, texts))


def lines_of(graph: Graph, joints: Sequence[UrdfJoint]) -> list[Line]:
    """Return the axes of one chain's joints in space, all joints at 0."""
    place: Vector = (0.0, 0.0, 0.0)
    turned = IDENTITY
    result = {}
    for joint in graph.path_to(joints[-1].child):
        place = add(place, apply(turned, joint.xyz))
        turned = times(turned, from_rpy(joint.rpy))
        result[joint.name] = Line("", place, apply(turned, joint.axis), joint.kind == "prismatic")
    return [result[joint.name] for joint in joints]


def read_cell(graph: Graph, names: tuple[str, ...], message: Mapping[str, str]) -> Cell:
    """Return the arms of a checked description, and its positioners.

    `message` are the axes of joints that the user named, "" of a joint to ignore.
    """
    moving = [j for j in graph.robot.joints if j.is_actuated and message.get(j.name) != ""]
    if len(moving) > MOST_MOVING:
        raise refusal(
            "RG043",
            None,
            f"{len(moving)} joints move by themselves; a cell has at most {MOST_MOVING}",
            "give the description of the robot alone",
        )
    arms: list[Arm] = []
    remaining: list[tuple[UrdfJoint, ...]] = []
    for chain in graph.chains(moving):
        arm = _arm(graph, chain, names, message)
        if arm is None:
            remaining.append(chain)
        elif arm.joints not in [other.joints for other in arms]:
            arms.append(arm)
    of_arms = {j.name for arm in arms for j in arm.joints}
    positioners = []
    for chain in remaining:
        own = tuple(j for j in chain if j.kind not in ("floating", "planar"))
        above = {j.name for j in graph.ancestors(own[0])} if own else set()
        if own and not above & of_arms and not {j.name for j in own} & of_arms:
            positioners.append(own)
    complete = tuple(replace(arm, grippers=_gripper_joints(graph, arm, moving)) for arm in arms)
    return Cell(graph, complete, tuple(positioners), names)


def _gripper_joints(graph: Graph, arm: Arm, moving: Sequence[UrdfJoint]) -> tuple[UrdfJoint, ...]:
    own = {j.name for j in (*arm.joints, *arm.under)}
    last = arm.joints[-1].name
    return tuple(
        j for j in moving if j.name not in own and last in {a.name for a in graph.ancestors(j)}
    )


def _arm(
    graph: Graph, chain: Sequence[UrdfJoint], names: tuple[str, ...], message: Mapping[str, str]
) -> Arm | None:
    sound = [j for j in chain if j.kind not in ("floating", "planar") and not j.has_zero_axis]
    for count in (7, 6, 4, 3):
        for begin in range(len(sound) - count + 1):
            window = tuple(sound[begin : begin + count])
            result = align(lines_of(graph, window), *names)
            if result:
                return Arm(window, result.axes, result, tuple(sound[:begin]))
    inner = [j for j in sound if not message.get(j.name, "").startswith("eax")]
    # A fixed joint is not an axis if the others form an arm.
    able = _by_order([j for j in inner if not j.has_empty_range])
    arm = able if able and all(able.axes) else _by_order(inner)
    if arm is None:
        return None
    after = sound.index(arm.joints[-1])
    under = (j for j in sound[:after] if j not in arm.joints and not j.has_empty_range)
    return replace(arm, under=tuple(under))


def _by_order(chain: Sequence[UrdfJoint]) -> Arm | None:
    """Return an arm of an unknown variant.

    Only the axes of six turning joints, or of a SCARA, are unambiguous.
    """
    kinds = "".join("P" if j.kind == "prismatic" else "R" for j in chain)
    hit = re.search(r"R{6,}", kinds)
    if hit:
        joints = tuple(chain[hit.start() : hit.end()])
        under = tuple(chain[: hit.start()])
        if len(joints) == 6:
            return Arm(joints, ROBOT_AXES, None, under)
        return Arm(joints, ("",) * len(joints), None, under)
    hit = re.search(r"RRPR?", kinds)  # some exports omit a SCARA's axis 4
    if hit:
        joints = tuple(chain[hit.start() : hit.end()])
        return Arm(joints, ROBOT_AXES[: len(joints)], None, tuple(chain[: hit.start()]))
    hit = re.search(r"RR[RP]{2,}", kinds)
    if hit and hit[0].count("R") >= 3:
        joints = tuple(chain[hit.start() : hit.end()])
        return Arm(joints, ("",) * len(joints), None, tuple(chain[: hit.start()]))
    return None


def no_robot(cell: Cell, place: Span | None) -> Iterator[Diagnostic]:
    """Explain why a description has no suitable robot (RG059)."""
    graph = cell.graph
    message = " ".join(cell.names)
    maker = _other_maker(cell)
    if maker:
        yield error(
            "RG059",
            place,
            f"'{maker}' is no robot of ABB",
            "the driver is RAPID for ABB controllers; other makers' controllers do not run it",
        )
    elif _DELTA.search(message) or _is_parallel(graph):
        yield error(
            "RG059",
            place,
            "a delta robot: several arms move one flange, which is no chain of joints",
            "write its axes: `joints:` with rax_1 to rax_4, ranges and speeds, "
            "and `held_axes: [rax_5, rax_6]`",
        )
    elif mimic := _arms_mimic(cell):
        yield error(
            "RG042",
            mimic.span or place,
            f"joint '{mimic.name}' mimics '{mimic.mimic}' and drives no axis: too few joints "
            "are left for an arm",
            "take the <mimic> out where the joint is an axis",
        )
    elif cell.arms and not (cell.is_claimed or any(all(arm.axes) for arm in cell.arms)):
        most = max(len(arm.joints) for arm in cell.arms)
        yield error(
            "RG059",
            place,
            f"{most} joints in one chain match no known ABB arm, and no name contains ABB",
            "if it is an ABB robot, give its axes: --joint NAME=rax_1 for each; of a cell give the "
            "arm's end: --tip LINK",
        )
    elif not cell.arms:
        count = sum(len(chain) for chain in cell.positioners)
        yield error(
            "RG059",
            place,
            f"{count} joint{'s' if count != 1 else ''} and no robot: a positioner or a track alone"
            if count
            else "no joint of the description moves by itself",
            "it moves with the robot whose group it belongs to: read both in one description, or "
            "add its joints to the robot's configuration as eax_a..eax_f"
            if count
            else "give the top-level file of the robot",
        )


def _other_maker(cell: Cell) -> str:
    """Return a name of another maker, from robot, file, folders, packages.

    Empty if the name contains ABB, or if an arm has the axes of an ABB robot.
    """
    if any(arm.alignment for arm in cell.arms) or mentions_abb(*cell.names):
        return ""
    hit = _MAKERS.search(_words(cell.names))
    if not hit and not mentions_abb(*cell.around):
        hit = _MAKERS.search(_words(cell.around))
    return hit[0] if hit else ""


def _words(names: Iterable[str]) -> str:
    return " ".join(" ".join(_WORDS.split(name)) for name in names)


def _arms_mimic(cell: Cell) -> UrdfJoint | None:
    """Return a turning joint that mimics another, in an incomplete arm."""
    graph = cell.graph
    if any(arm.alignment or len(arm.joints) >= 6 or all(arm.axes) for arm in cell.arms):
        return None
    for joint in graph.robot.joints:
        around = sum(j.is_actuated for j in graph.path_to(joint.child))
        if joint.mimic and joint.kind != "prismatic" and around >= 2:
            return joint
    return None


def _is_parallel(graph: Graph) -> bool:
    """True for three or more actuated branches of two joints on one link."""
    moving = [j for j in graph.robot.joints if j.is_actuated]
    first: dict[str, set[str]] = {}
    for chain in graph.chains(moving):
        if len(chain) >= 2:
            first.setdefault(chain[0].parent, set()).add(chain[0].name)
    return any(len(of) >= 3 for of in first.values())
