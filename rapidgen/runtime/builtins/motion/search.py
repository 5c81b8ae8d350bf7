"""Moves that end at a signal or at contact; lead-through."""

from collections.abc import Callable
from dataclasses import dataclass, field

from rapidgen.axes.kinematics import Posture
from rapidgen.machine.scheduler import MS, S, WaitSet
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import Move
from rapidgen.runtime.builtins.motion.moves import cartesian_move, external_move, together
from rapidgen.runtime.builtins.motion.path import reason_of
from rapidgen.runtime.builtins.motion.targets import data_of, group_of, joint_target, rob_target
from rapidgen.runtime.builtins.motion.units import unit_axis, unit_group
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import planned
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

# -- Searches --------------------------------------------------------------------------------------
#
# SearchL, SearchC and SearchExtJ: moves that monitor a signal.
#
# Source: S4 datasys 2-SearchL. \Stop brakes hard, \PStop and \SStop brake on the path as a normal
# stop. Without a switch and with \Sup the robot continues to its target. The move ends in a stop
# point. The result is the TCP at the time of the signal change. In a step, a search without a hit
# stops the program; its handler does not receive the error.


_REASON = "search"
_NO_HIT = 194_906
"""Event; the number is ours."""


@dataclass(frozen=True, slots=True)
class _Edges:
    """Signal changes that count as a hit."""

    rising: bool
    falling: bool
    level: bool | None = None
    """A value that counts as a hit already at the start."""
    supervised: bool = False
    """A signal that is already 1 at the start is an error."""


@dataclass(slots=True)
class _Hits:
    group: MotionGroup
    edges: _Edges
    read: Callable[[], bool]
    halt: Callable[[], None] | None
    last: bool = False
    found: list[Posture] = field(default_factory=list)

    def changed(self) -> None:
        """Record a change of the monitored signal."""
        now = self.read()
        before, self.last = self.last, now
        if (now and not before and self.edges.rising) or (
            before and not now and self.edges.falling
        ):
            self.hit()

    def hit(self) -> None:
        """Record the position, and stop if the instruction requires it."""
        self.found.append(self.group.positions())
        if self.halt is not None and len(self.found) == 1:
            self.halt()


_EDGES = {
    "Flanks": _Edges(True, True),
    "PosFlank": _Edges(True, False),
    "NegFlank": _Edges(False, True),
    "HighLevel": _Edges(True, False, level=True),
    "LowLevel": _Edges(False, True, level=False),
}


def _edges(arguments: Arguments) -> _Edges:
    chosen = next((name for name in _EDGES if arguments[name]), None)
    return _Edges(True, False, supervised=True) if chosen is None else _EDGES[chosen]


def _source(signal: AnySignal | None, flag: Ref | None) -> tuple[WaitSet, Callable[[], bool]]:
    """Return the wait set of a search, and the function that reads it."""
    if signal is not None:
        source = signal.signal
        return source.changed, lambda: bool(source.value)
    if flag is None or flag.cell is None:
        raise RapidError("ERR_ARGNOTPER", "PersBool")
    cell = flag.cell
    return cell, lambda: bool(cell.v)


@by_name("SearchL", "SearchC", cost="move")
@planned
def search(task: Task, _name: str, arguments: Arguments) -> None:
    """Move, and store the TCP at the hit.

    Raises ERR_WHLSEARCH without a hit, and ERR_SIGSUPSEARCH.
    """
    group, move = cartesian_move(task, arguments)
    place = _first_hit(task, group, move, arguments)
    offsets = data_of(task, group).external_offset
    arguments["SearchPoint"].set(rob_target(group, place, move.carrier, offsets))


@by_name("SearchExtJ", cost="move")
@planned
def search_ext_j(task: Task, _name: str, arguments: Arguments) -> None:
    """Search with external axes; store the position of all axes."""
    group, move, offsets = external_move(task, arguments)
    place = _first_hit(task, group, move, arguments)
    arguments["SearchJointPos"].set(joint_target(group.map, place, offsets))


def _first_hit(task: Task, group: MotionGroup, expected: Move, arguments: Arguments) -> Posture:
    """Execute the move, stop it as requested, and return the first hit."""
    move = together(task, group, expected, arguments["ID"])
    edges, hard = _edges(arguments), bool(arguments["Stop"])
    change, read = _source(arguments["Signal"], arguments["PersBool"])
    halting = bool(hard or arguments["PStop"] or arguments["SStop"])
    hits = _Hits(
        group,
        edges,
        read,
        (lambda: group.stop(_REASON, quick=hard)) if halting else None,
        read(),
    )
    if edges.supervised and hits.last:
        raise RapidError("ERR_SIGSUPSEARCH")
    leg = group.enqueue(move)
    if edges.level is not None and hits.last == edges.level:
        hits.hit()
    change.add(hits.changed)
    try:
        if leg is not None:
            group.wait(
                task,
                leg,
                lambda: (
                    (leg.finished and group.is_settled)
                    or (halting and bool(hits.found) and group.is_settled)
                ),
            )
    finally:
        change.remove(hits.changed)
        if halting and hits.found:
            group.clear_path()
        group.start(_REASON)
    if not hits.found or (arguments["Sup"] and len(hits.found) > 1):
        if task.stepping:
            raise FatalError(_NO_HIT, "Search was not successful", f"{len(hits.found)} hits")
        raise RapidError("ERR_WHLSEARCH", f"{len(hits.found)} hits")
    return hits.found[0]


# -- Contact and lead-through ----------------------------------------------------------------------
#
# ContactL, lead-through, GetJointData.
#
# Sources: 3HAC050917 for ContactL and GetJointData, programs for their arguments [code yumipy];
# SetLeadThrough \On executes StopMove, \Off ClearPath and StartMove [manual, in public notes]. The
# model has no dynamics: torques are 0. A test simulates contact by
# `controller.motion.group(name).touch()`.


_LED = "LeadThrough"
_CONTACT = "contact"


@by_name("ContactL", cost="move")
@planned
def contact_l(task: Task, _name: str, arguments: Arguments) -> None:
    """Move linearly until contact; discard the rest of the line.

    ERR_CONTACTL: no contact before the target, with \\DesiredTorque [mem].
    """
    group, move = cartesian_move(task, _without_zone(arguments))
    touched: list[bool] = []

    def touch() -> None:
        touched.append(True)
        group.stop(_CONTACT, quick=True)

    leg = group.enqueue(together(task, group, move, arguments["ID"]))
    group.contacts.add(touch)
    try:
        if leg is not None:
            group.wait(task, leg, lambda: (leg.finished or bool(touched)) and group.is_settled)
    finally:
        group.contacts.remove(touch)
        if touched:
            group.clear_path()
            group.start(_CONTACT)
    if not touched and arguments["DesiredTorque"] is not None:
        raise RapidError("ERR_CONTACTL", "nothing was touched on the way")


def _without_zone(arguments: Arguments) -> dict[str, Value]:
    """Return the arguments without a zone.

    A stop point lets the program evaluate the contact.
    """
    return {name: value for name, value in arguments.items() if name != "Zone"}


@builtin("SetLeadThrough")
def set_lead_through(
    task: Task,
    on: bool | None,
    off: bool | None,
    no_stop: bool | None,
    no_start: bool | None,
    no_clear: bool | None,
) -> None:
    """Enable or disable lead-through."""
    group = group_of(task)
    data_of(task, group).extra[_LED] = not off
    if off:
        if not no_clear:
            group.clear_path()
        if not no_start:
            group.start(reason_of(task))
    elif not no_stop:
        group.stop(reason_of(task))


@builtin("IsLeadThrough")
def is_lead_through(task: Task, unit: Value, active: bool | None, _set: bool | None) -> bool:
    """Return True if lead-through is enabled.

    \\Active: also requires standstill, so that the robot can be moved by hand.
    """
    group = group_of(task) if unit is None else unit_group(task, unit)
    led = bool(data_of(task, group).extra.get(_LED))
    return led and (group.is_standing or not active)


@builtin("GetJointData")
def get_joint_data(
    task: Task,
    unit: Value,
    axis: float,
    position: Ref | None,
    speed: Ref | None,
    torque: Ref | None,
    outer_torque: Ref | None,
) -> None:
    """Return position and speed of an axis, in deg or mm and per second.

    Torques are 0 Nm. Raises ERR_AXIS_PAR.
    """
    group, joint = unit_axis(task, unit, axis)
    now = task.scheduler.now
    current, before = (_axis(group, joint.axis, time) for time in (now, now - MS))
    for where, value in (
        (position, current),
        (speed, (current - before) * S / MS if now < group.motion.end else 0.0),
        (torque, 0.0),
        (outer_torque, 0.0),
    ):
        if where is not None:
            where.set(value)


def _axis(group: MotionGroup, axis: str, time: int) -> float:
    robot, external = group.map.to_rapid(group.motion.posture(max(time, group.motion.since)))
    kind, _, number = axis.partition("_")
    return robot[int(number) - 1] if kind == "rax" else external["abcdef".index(number)]
