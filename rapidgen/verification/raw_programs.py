"""A raw client that sends programs, and equivalent RAPID programs."""

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

from rapidgen.axes.frames import Pose
from rapidgen.config.model import RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.motion.moves import MoveFrames
from rapidgen.runtime.builtins.motion.targets import rob_target
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.runtime.values import Value
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths, words_frame
from rapidgen.verification.messages import (
    PROGRAM,
    RawInstruction,
    RawModal,
    RawReason,
    RawStreamFlag,
)
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import Position
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.testbench import Bench

BEGIN, END, WHOLE = RawStreamFlag.BEGIN, RawStreamFlag.END, RawStreamFlag.WHOLE
ALL = BEGIN | END | WHOLE
_KINDS = (RawInstruction.MOVE_J, RawInstruction.MOVE_L, RawInstruction.MOVE_ABSJ)
HAND = "hand", "hand.mod"
"""Module with the same moves: name and file."""
_WORDS = 245
"""Maximum number of instruction words in one message."""
_NAMES = {
    RawInstruction.MOVE_ABSJ: "MoveAbsJ",
    RawInstruction.MOVE_J: "MoveJ",
    RawInstruction.MOVE_L: "MoveL",
    RawInstruction.MOVE_C: "MoveC",
}


@dataclass(frozen=True, slots=True)
class RawMove:
    """A move: joints at its end (rad, m), their pose, and `via` on a circle.

    Every instruction contains `speed` (m/s), `turn` of the tool and of rotary external axes
    (rad/s), `linear` of linear external axes (m/s) and `zone` (m, rad; None: a stop point).
    `frames` are the numbers of tool and work object; `marks` are signals on the path: number,
    value, kind, place.
    """

    kind: RawInstruction
    joints: Position
    pose: Pose | None
    via: Pose | None = None
    speed: float = 0.15
    zone: float | None = 0.005
    frames: tuple[int, int] | None = None
    marks: tuple[tuple[float, ...], ...] = ()
    turn: float = 2.0
    linear: float = 1.0

    @property
    def speeds(self) -> tuple[float, ...]:
        """Return speeddata: TCP, orientation, linear and rotary external axes."""
        return self.speed, self.turn, self.linear, self.turn

    @property
    def zones(self) -> tuple[float, ...]:
        """Return zonedata after finep."""
        size = self.zone or 0.0
        return size, 1.5 * size, 1.5 * size, 3 * size, 1.5 * size, 3 * size

    @property
    def words(self) -> list[int]:
        """Return the words on the wire."""
        first = self.kind | RawModal.SPEED | RawModal.ZONE
        values = [*self.speeds, float(self.zone is None), *self.zones]
        if self.frames is not None:
            first |= RawModal.FRAMES
            values += self.frames
        if self.marks:
            first |= RawModal.SIGNALS
            values += [len(self.marks), *(value for marker in self.marks for value in marker)]
        for pose in (self.via, self.pose):
            if pose is not None:
                values += [*pose[0], *pose[1]]
        return [int(first), *millionths([*values, *self.joints])]


Item: TypeAlias = RawMove | Sequence[int]
"""An instruction of a program: a move, or the words of any other one."""


def words(item: Item) -> list[int]:
    """Return the words of an item on the wire."""
    return item.words if isinstance(item, RawMove) else list(item)


class Programmer:
    """Send programs one after the other to the motion server."""

    def __init__(self, bench: Bench, link: RawLink | None = None) -> None:
        self.bench = bench
        self.link = link if link is not None else bench.motion()
        self.number = 0

    def send(
        self, items: Sequence[Item], flags: RawStreamFlag = ALL, start: Position | None = None
    ) -> messages.RawContent:
        """Send a program in several messages.

        Returns the last reply, or the first rejection.
        """
        self.number += 1
        parts = [words(item) for item in items]
        values, own, at = millionths(self.bench.position if start is None else start), flags, 0
        for number, part in enumerate(parts, 1):
            values += part
            last = number == len(parts)
            if not last and len(values) + len(parts[number]) <= _WORDS:
                continue
            reply = self.say(values, number - at, own if last else own & ~END, first=at)
            values, own, at = [], flags & ~BEGIN, number
            if isinstance(reply, messages.RawPointsRefused):
                break
        return reply

    def batch(self, items: Sequence[Item], flags: RawStreamFlag, first: int) -> messages.RawContent:
        """Send a further batch of the present program and return the reply."""
        values = [word for item in items for word in words(item)]
        return self.say(values, len(items), flags, first=first)

    def say(
        self, values: Sequence[int], count: int, flags: RawStreamFlag, first: int = 0
    ) -> messages.RawContent:
        """Send a batch of any words and return the reply."""
        self.link.send(words_frame(self.number, first, count, values, flags, number=PROGRAM))
        return self.link.reply(PROGRAM, 5)

    def takes(self, what: str, orders: Sequence[RawMove], flags: RawStreamFlag = ALL) -> int:
        """Send a program, check that it is accepted, and return its number.

        The number is that of its trajectory.
        """
        reply = self.send(orders, flags)
        if not isinstance(reply, messages.RawPointsAccepted) or reply.accepted != len(orders):
            raise CheckFailed(f"{what}: {len(orders)} instructions are right, the reply is {reply}")
        return reply.trajectory

    def refused(self, reply: messages.RawContent, reason: RawReason, index: int, what: str) -> None:
        """Check that a reply rejects that instruction for that reason."""
        if not isinstance(reply, messages.RawPointsRefused):
            raise CheckFailed(f"{what}: wanted {reason.name}, the reply is {reply}")
        if (reply.reason, reply.point) != (reason, index):
            raise CheckFailed(f"{what}: wanted {reason.name} at {index}, the reply is {reply}")


def orders(bench: Bench, count: int, chance: random.Random) -> list[RawMove]:
    """Return moves near a pose without singularity, the last a stop point."""
    middle = bent(bench)
    failures = [RawMove(RawInstruction.MOVE_ABSJ, middle, None, zone=None)]
    poses = computes(bench)
    for number in range(1, count):
        joints = near(bench, middle, chance)
        kind = chance.choice(_KINDS) if poses else RawInstruction.MOVE_ABSJ
        pose = None if kind is RawInstruction.MOVE_ABSJ else reached(bench, joints)
        zone = chance.choice((0.002, 0.005, 0.01)) if number + 1 < count else None
        failures.append(RawMove(kind, joints, pose, None, chance.choice((0.1, 0.15)), zone))
    return failures


def computes(bench: Bench) -> bool:
    """True if the controller gives the motion server the pose of joints."""
    known = bench.motion_group.kinematics is not None
    return known and bench.setting.dialect.calc_in_background


def kinds_with_marks(bench: Bench) -> tuple[RawInstruction, ...]:
    """Return the moves on whose path signals may be set.

    For a SCARA, joint moves go to joint targets.
    """
    joint_moves = (RawInstruction.MOVE_J, RawInstruction.MOVE_ABSJ)
    lines = (RawInstruction.MOVE_L, RawInstruction.MOVE_C)
    return lines if bench.motion_group.map.two_sided else (*joint_moves, *lines)


def bent(bench: Bench) -> Position:
    """Return a position with every rotary axis off zero, within limits."""
    return tuple(
        (joint.lower + joint.upper) / 2
        if joint.kind == "prismatic"
        else max(joint.lower, min(joint.upper, 0.35)) * 0.9
        for joint in bench.group.joints
    )


def near(bench: Bench, middle: Position, chance: random.Random) -> Position:
    """Return a position some centimetres away."""
    joints = zip(bench.group.joints, middle, strict=True)
    return tuple(
        round(
            value + chance.uniform(-1, 1) * (0.08 if joint.kind == "prismatic" else 0.15),
            6,
        )
        for joint, value in joints
    )


def target_of(bench: Bench, joints: Position) -> Value:
    """Return the robtarget of joints, computed by the controller."""
    group, tool, wobj = bench.motion_group, bench.group.tool.frame, bench.group.work_object
    assert group.kinematics is not None
    carrier = MoveFrames(
        tool=(tool.position, tool.orientation),
        object=(wobj.user_frame.position, wobj.user_frame.orientation),
    )
    return rob_target(group, joints, carrier, NO_OFFSETS)


def reached(bench: Bench, joints: Position) -> Pose:
    """Return the pose of joints in m, as on the wire."""
    target = target_of(bench, joints)
    t, q = target.trans, target.rot
    return (
        (round(t.x / 1000, 6), round(t.y / 1000, 6), round(t.z / 1000, 6)),
        (round(q.q1, 6), round(q.q2, 6), round(q.q3, 6), round(q.q4, 6)),
    )


@lru_cache(maxsize=4)
def called(config: RobotConfig, name: str) -> System:
    """Return a system in which a user program calls the driver.

    The program of one task does nothing.
    """
    config = replace(config, call_main=False)
    system = make_system(config, build(config))
    hand = ModuleFile(*HAND, _hand("").encode())
    tasks = tuple(
        replace(task, modules=(*task.modules, hand)) if task.name == name else task
        for task in system.tasks
    )
    return in_its_cell(replace(system, tasks=tasks), config)


def by_hand(bench: Bench, program: Sequence[RawMove]) -> None:
    """Execute these moves as RAPID on a controller from `called`."""
    module = ModuleFile(*HAND, in_rapid(bench, program).encode())
    bench.replace_module(bench.group.task, module)


def in_rapid(bench: Bench, program: Sequence[RawMove]) -> str:
    """Return a module whose `main` makes these moves."""
    moves = (_statement(bench, order) for order in program)
    # Time to bring the robot to the start position.
    return _hand("".join(f"        {line}\n" for line in ("WaitTime 1;", *moves, "Stop;")))


def _hand(body: str) -> str:
    return f"MODULE hand\n    PROC main()\n{body}    ENDPROC\nENDMODULE\n"


def _statement(bench: Bench, order: RawMove) -> str:
    degrees = 57.29577951308232
    tcp, turn, linear, rotary = order.speeds
    speed = _list((tcp * 1000, turn * degrees, linear * 1000, rotary * degrees))
    a, b, c, d, e, f = order.zones
    sizes = (a * 1000, b * 1000, c * 1000, d * degrees, e * 1000, f * degrees)
    zone = "fine" if order.zone is None else f"[FALSE,{_list(sizes)[1:]}"
    tail = f"{speed},{zone},{bench.group.tool.name}\\WObj:={bench.group.work_object.name};"
    robot, external = bench.motion_group.map.to_rapid(order.joints)
    by_joints = order.kind is RawInstruction.MOVE_J and bench.motion_group.map.two_sided
    if order.pose is None or by_joints:
        return f"MoveAbsJ [{_list(robot)},{_list(external)}]\\NoEOffs,{tail}"
    target = target_of(bench, order.joints)
    places = [_target(pose, target) for pose in (order.via, order.pose) if pose is not None]
    return f"{_NAMES[order.kind]} {','.join(places)},{tail}"


def _target(pose: Pose, like: Value) -> str:
    place = _list([1000 * value for value in pose[0]])
    conf, external = like.robconf, like.extax
    turned = _list((conf.cf1, conf.cf4, conf.cf6, conf.cfx))
    return f"[{place},{_list(pose[1])},{turned},{_list(external.values())}]"


def _list(values: Sequence[float]) -> str:
    return "[" + ",".join(f"{value:.9G}" for value in values) + "]"
