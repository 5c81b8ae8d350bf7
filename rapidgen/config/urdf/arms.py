"""The arms of a description: which joints are an arm's axes, what carries it, what hangs on it."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from rapidgen.config.axis_sets import ROBOT_AXES
from rapidgen.config.geometry import IDENTITY, Line, apply, from_rpy, times
from rapidgen.config.recognition import Alignment, align
from rapidgen.config.urdf.graph import Graph
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.config.vectors import Vector, add
from rapidgen.diagnostics import Diagnostic, Span, error, refusal

MOST_MOVING = 120
_MAKERS = re.compile(
    r"(?<![a-z0-9])(kuka|kr_?\d+|iiwa|fanuc|lrmate|m\d+i[abd]|ur\d+e?|motoman|yaskawa|panda|fr3|franka|staubli|"
    r"tx2?_?\d+|kinova|gen3|jaco|xarm\d?|denso|vs_?\d{3}|nachi|comau|kawasaki|doosan|hyundai)(?![a-z0-9])",
    re.IGNORECASE,
)
_DELTA = re.compile(r"irb[_ -]?(340|360|390)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Arm:
    """One robot of a description: its joints along the chain with what is known of them."""

    joints: tuple[UrdfJoint, ...]
    axes: tuple[str, ...]
    """As the joints; empty: not known."""
    alignment: Alignment | None
    under: tuple[UrdfJoint, ...] = ()
    """Joints that carry the robot: a track, a gantry."""
    behind: tuple[UrdfJoint, ...] = ()
    """Joints that hang on it: grippers."""


@dataclass(frozen=True, slots=True)
class Cell:
    """All that moves in a description."""

    graph: Graph
    arms: tuple[Arm, ...]
    positioners: tuple[tuple[UrdfJoint, ...], ...] = ()
    names: tuple[str, ...] = field(default=())


def lines_of(graph: Graph, joints: Sequence[UrdfJoint]) -> list[Line]:
    """The axes of joints of one chain in space, all joints at 0."""
    place: Vector = (0.0, 0.0, 0.0)
    turned = IDENTITY
    found = {}
    for joint in graph.path_to(joints[-1].child):
        place = add(place, apply(turned, joint.xyz))
        turned = times(turned, from_rpy(joint.rpy))
        found[joint.name] = Line("", place, apply(turned, joint.axis), joint.kind == "prismatic")
    return [found[joint.name] for joint in joints]


def read_cell(graph: Graph, names: tuple[str, ...]) -> Cell:
    """The arms of a checked description, and the positioners beside them."""
    moving = [j for j in graph.robot.joints if j.is_actuated]
    if len(moving) > MOST_MOVING:
        raise refusal(
            "RG043",
            None,
            f"{len(moving)} joints move by themselves; a cell has at most {MOST_MOVING}",
            "give the description of the robot alone",
        )
    arms: list[Arm] = []
    rest: list[tuple[UrdfJoint, ...]] = []
    for chain in graph.chains(moving):
        arm = _arm(graph, chain, names)
        if arm is None:
            rest.append(chain)
        elif arm.joints not in [other.joints for other in arms]:
            arms.append(arm)
    of_arms = {j.name for arm in arms for j in arm.joints}
    positioners = []
    for chain in rest:
        own = tuple(j for j in chain if j.kind not in ("floating", "planar"))
        above = {j.name for j in graph.ancestors(own[0])} if own else set()
        if own and not above & of_arms and not {j.name for j in own} & of_arms:
            positioners.append(own)
    whole = tuple(replace(arm, behind=_behind(graph, arm, moving)) for arm in arms)
    return Cell(graph, whole, tuple(positioners), names)


def _behind(graph: Graph, arm: Arm, moving: Sequence[UrdfJoint]) -> tuple[UrdfJoint, ...]:
    own = {j.name for j in (*arm.joints, *arm.under)}
    last = arm.joints[-1].name
    return tuple(
        j for j in moving if j.name not in own and last in {a.name for a in graph.ancestors(j)}
    )


def _arm(graph: Graph, chain: Sequence[UrdfJoint], names: tuple[str, ...]) -> Arm | None:
    sound = [j for j in chain if j.kind not in ("floating", "planar")]
    for count in (7, 6, 4):
        for begin in range(len(sound) - count + 1):
            window = tuple(sound[begin : begin + count])
            found = align(lines_of(graph, window), *names)
            if found:
                return Arm(window, found.axes, found, tuple(sound[:begin]))
    return _by_order(sound)


def _by_order(chain: Sequence[UrdfJoint]) -> Arm | None:
    """An arm of no known variant: only six turning joints, or a SCARA's, tell their axes."""
    kinds = "".join("P" if j.kind == "prismatic" else "R" for j in chain)
    hit = re.search(r"R{6,}", kinds)
    if hit:
        joints = tuple(chain[hit.start() : hit.end()])
        under = tuple(chain[: hit.start()])
        if len(joints) == 6:
            return Arm(joints, ROBOT_AXES, None, under)
        return Arm(joints, ("",) * len(joints), None, under)
    hit = re.search(r"RRPR?", kinds)  # some exports leave a SCARA's axis 4 out
    if hit:
        joints = tuple(chain[hit.start() : hit.end()])
        return Arm(joints, ROBOT_AXES[: len(joints)], None, tuple(chain[: hit.start()]))
    hit = re.search(r"RR[RP]{2,}", kinds)
    if hit and hit[0].count("R") >= 3:
        joints = tuple(chain[hit.start() : hit.end()])
        return Arm(joints, ("",) * len(joints), None, tuple(chain[: hit.start()]))
    return None


def no_robot(cell: Cell, place: Span | None) -> Iterator[Diagnostic]:
    """Why a description holds no robot that a driver could be made for (RG059)."""
    graph = cell.graph
    said = " ".join(cell.names)
    maker = _MAKERS.search(re.sub(r"[/\\.]", " ", said))
    if maker and not re.search(r"abb|irb|yumi|gofa", said, re.IGNORECASE):
        yield error(
            "RG059",
            place,
            f"'{maker[0]}' is no robot of ABB",
            "the driver is RAPID for ABB controllers; other makers' controllers do not run it",
        )
    elif _DELTA.search(said) or _is_parallel(graph):
        yield error(
            "RG059",
            place,
            "a delta robot: several arms move one flange, and no chain of joints tells how",
            "say its axes by hand: `joints:` with rax_1 to rax_4, ranges and speeds, "
            "and `keep: [rax_5, rax_6]`",
        )
    elif mimic := _arms_mimic(cell):
        yield error(
            "RG042",
            mimic.span or place,
            f"joint '{mimic.name}' mimics '{mimic.mimic}' and is no axis of its own: too few are "
            "left for an arm",
            "take the <mimic> out where the joint is an axis",
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


def _arms_mimic(cell: Cell) -> UrdfJoint | None:
    """A turning joint that follows another one where an arm has too few of its own."""
    graph = cell.graph
    if any(arm.alignment or len(arm.joints) >= 6 or all(arm.axes) for arm in cell.arms):
        return None
    for joint in graph.robot.joints:
        around = sum(j.is_actuated for j in graph.path_to(joint.child))
        if joint.mimic and joint.kind != "prismatic" and around >= 2:
            return joint
    return None


def _is_parallel(graph: Graph) -> bool:
    """Three or more moving branches of two joints and more that begin on one link."""
    moving = [j for j in graph.robot.joints if j.is_actuated]
    first: dict[str, set[str]] = {}
    for chain in graph.chains(moving):
        if len(chain) >= 2:
            first.setdefault(chain[0].parent, set()).add(chain[0].name)
    return any(len(of) >= 3 for of in first.values())
