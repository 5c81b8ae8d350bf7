"""One motion group: what a program and its controller may ask of a robot.

Moves, stops with their reasons, speeds, paths put aside. What happens when on the path is the
business of `execution.py`, how a move becomes a way that of `planner.py`.
"""

from collections.abc import Callable, Iterable
from math import inf
from typing import Protocol

from rapidgen.axes.kinematics import Kinematics, MovingFrame, Posture
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import Scheduler, WaitSet
from rapidgen.motion.execution import PathExecution, StoredPath
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.legs import Leg
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import Move
from rapidgen.motion.path import Path
from rapidgen.motion.planner import Planner
from rapidgen.motion.settings import MotionSettings

_BRAKES = "brakes"
"""The stop that holds while the brakes bring the robot to rest."""


class MotionWaiter(Protocol):
    """What a group needs of a program: RAPID tasks do it, and Python functions in tests."""

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until the predicate holds."""


class MotionGroup:
    """One mechanical unit group: its path, its position and its stops."""

    def __init__(
        self,
        config: GroupConfig,
        scheduler: Scheduler,
        log: EventLog,
        io: IOSystem,
        settings: MotionSettings,
    ) -> None:
        self.config = config
        self.name = config.name
        self.map = JointMap.of(config)
        self.planner = Planner(config, settings)
        self._frames = {p.unit.lower(): MovingFrame.of(config, p.chain) for p in config.positioners}
        self._io = io
        self._stored: list[StoredPath] = []
        self._concurrent = 0
        self.inactive: set[str] = {
            axis for unit in config.units if not unit.active for axis in unit.axes
        }
        """External axes of deactivated units (DeactUnit)."""
        self.listeners: list[Callable[[Move], None]] = []
        """Called with every move that the program asks for."""
        self.contacts = WaitSet()
        """Notified when the robot touches something (`touch`)."""
        self.on_reset: list[Callable[[], None]] = []
        """Called when the modal settings are reset (PP to main)."""
        start = tuple(min(max(0.0, j.lower), j.upper) for j in config.joints)
        self._execution = PathExecution(scheduler, log, self.planner, start, self._report)
        self._drive = self._execution.drive
        self._stops = self._execution.stops
        self._report(True)
        io.report("MechUnitActive", 1, config.mechanical_unit)

    def _report(self, at_rest: bool) -> None:
        self._io.report("MechUnitNotMoving", int(at_rest), self.config.mechanical_unit)

    # -- what it is -------------------------------------------------------------------------

    @property
    def settings(self) -> MotionSettings:
        """Assumptions that are switches."""
        return self.planner.settings

    @settings.setter
    def settings(self, value: MotionSettings) -> None:
        self.planner.settings = self._drive.settings = value

    @property
    def modal(self) -> ModalSettings:
        """What moves that are executed from now on obey."""
        return self.planner.modal

    @property
    def kinematics(self) -> Kinematics | None:
        """None: the model has no geometry, so it moves in joints only."""
        return self.planner.kinematics

    def geometry(self) -> Kinematics:
        """The group's kinematics. MotionFault NO_GEOMETRY: its model has none."""
        return self.planner.geometry()

    def moving_frame(self, unit: str) -> MovingFrame | None:
        """The user frame of a unit that carries work objects; None: not known."""
        return self._frames.get(unit.lower())

    # -- where it is ------------------------------------------------------------------------

    @property
    def observers(self) -> list[Callable[[Motion], None]]:
        """Called with every new motion (the recorder)."""
        return self._drive.observers

    @property
    def changed(self) -> WaitSet:
        """Notified when a move is released or finished, and when motion begins or ends."""
        return self._execution.changed

    def positions(self) -> Posture:
        """Axis values now, as measured: controller axes, rad and m, wire order."""
        return self._drive.measured()

    def commanded(self) -> Posture:
        """Axis values now, as planned: ahead of `positions` by the servo lag."""
        return self._drive.commanded()

    def reference(self) -> Posture:
        """Axis values to which the robot is ordered: `commanded`, or those of a guiding partner."""
        return self._drive.reference()

    @property
    def path_target(self) -> Posture:
        """Where the path ends: the start of the next move."""
        return self._execution.path.target

    def with_active(self, posture: Posture) -> Posture:
        """A target whose deactivated external axes stay where the path ends."""
        if not self.inactive:
            return posture
        ends = self.path_target
        return tuple(
            end if joint.axis in self.inactive else value
            for joint, value, end in zip(self.config.joints, posture, ends, strict=True)
        )

    @property
    def motion(self) -> Motion:
        """The motion under way, or the last one."""
        return self._drive.motion

    @property
    def is_standing(self) -> bool:
        """Whether no axis moves."""
        return self._execution.is_standing

    @property
    def is_settled(self) -> bool:
        """Whether it stands and the settling time is over too."""
        return self._execution.is_settled

    @property
    def legs(self) -> tuple[Leg, ...]:
        """Moves on the path that are not finished; the first is the one under way."""
        self._execution.settle()
        return tuple(self._execution.path.legs)

    @property
    def off_path(self) -> tuple[float, float]:
        """How far (m, rad of the TCP) a standing robot is from where its path goes on.

        With `cleared_distance` "counts" also from where one that was cleared would have.
        """
        path, place = self._execution.path, self._drive.place()
        way = path.way_back(place)
        if way is None and self.settings.cleared_distance == "counts":
            way = path.end_and_rest_positions(place)
        return (0.0, 0.0) if way is None else self.planner.apart(*way)

    def jump(self, posture: Posture) -> None:
        """Put the standing robot elsewhere (a test, a restored state). The path is dropped."""
        path = self._execution.path
        self._execution.finish(path.cut(path.end), cleared=True)
        self._execution.begin(Path(tuple(posture)))

    def jog(self, posture: Posture) -> None:
        """Put a standing robot elsewhere by hand; it returns to its path before it goes on.

        A path that is done is dropped. ValueError: the robot moves.
        """
        if not self.is_standing:
            raise ValueError("the robot moves")
        if not self.legs:
            self.jump(posture)
            return
        self._execution.come_back(tuple(posture), self.motion.law.place)
        self._execution.settle()

    def guide(self, posture: Posture, time: float, reference: Posture | None = None) -> None:
        """Go to a posture at constant axis speeds within a time in s (externally guided motion).

        `reference` is where the partner wants the robot to be; recordings and views show it.
        It is called anew when that time is over; the robot otherwise stays there. ValueError: a
        path is under way.
        """
        if self.legs:
            raise ValueError("a path is under way")
        self._execution.guide(tuple(posture), time, reference)

    def brake_guided(self) -> None:
        """Bring a guided robot to rest, each axis by itself."""
        if not self.is_standing and self.motion.coast is not None:
            self._execution.brake_guided()

    def touch(self) -> None:
        """The robot touches something (a test): ContactL stops."""
        self.contacts.notify()

    # -- speed ------------------------------------------------------------------------------

    @property
    def override(self) -> float:
        """Speed override of the controller, 0 to 1."""
        return self._drive.override

    @override.setter
    def override(self, value: float) -> None:
        if not 0.0 <= value <= 1.0:
            raise ValueError("the speed override is 0 to 1")
        self._drive.override = value
        self._change_speed()

    @property
    def refresh(self) -> float:
        """Speed override of the program (SpeedRefresh), 0 to 1.

        Set while the robot stands it has an effect by `refresh_standing` only.
        """
        return self._drive.refresh

    @refresh.setter
    def refresh(self, value: float) -> None:
        held = "override" in self._stops
        if self.is_standing and not held and not self.settings.refresh_standing:
            return
        self._execution.settle()
        self._execution.refresh(value)
        self._change_speed()

    @property
    def reduced(self) -> bool:
        """Manual mode with reduced speed: the TCP moves at 250 mm/s at most."""
        return self._drive.reduced

    @reduced.setter
    def reduced(self, value: bool) -> None:
        if value != self._drive.reduced:
            self._drive.reduced = value
            self._change_speed()

    @property
    def speed_limited(self) -> bool:
        """Whether the limits of SpeedLimAxis and SpeedLimCheckPoint hold (input LimitSpeed)."""
        return self.planner.speed_limited

    @speed_limited.setter
    def speed_limited(self, value: bool) -> None:
        self.planner.speed_limited = value
        self.limit_point()

    def limit_point(self) -> None:
        """The TCP's limit may have changed: it holds at once; those of axes for new moves."""
        self._drive.tcp_limit = self.modal.point_limit if self.speed_limited else inf
        self._change_speed()

    def _change_speed(self) -> None:
        self._drive.forget()
        if self._drive.override * self._drive.refresh == 0.0:
            self.stop("override")
        elif "override" in self._stops:
            self.start("override")
        elif not self._stops:
            self._execution.settle()
            self._execution.replan()
            self._execution.settle()

    # -- moving -----------------------------------------------------------------------------

    def move(self, waiter: MotionWaiter, move: Move) -> None:
        """Put a move on the path and hold the program as its zone asks for.

        A stop point lets the program go on when the robot stands there; a fly-by point some
        time before the path could no longer be changed into a corner. MotionFault: the move
        is refused.
        """
        leg = self.enqueue(move)
        if leg is None or move.concurrent:
            return
        if move.zone.fine:
            self.wait(waiter, leg, lambda: leg.finished and self.is_settled)
            if move.dwell > 0:
                waiter.wait_for(lambda: False, on=(), timeout=move.dwell)
        else:
            self.wait(waiter, leg, lambda: leg.released or leg.finished)

    def enqueue(self, move: Move) -> Leg | None:
        """Put a move on the path without waiting; None if the robot is at its target."""
        self._check(move)
        for listener in self.listeners:
            listener(move)
        execution = self._execution
        execution.settle()
        self._drive.refreshed = self.settings.refresh_timed or move.time is None
        waits = self.settings.zero_length == "wait" and move.time is not None
        if self.planner.has_zero_length(move, self.path_target) and not waits:
            leg = execution.stay(move)
        else:
            leg = execution.append(move)
        execution.settle()
        return leg

    def whole_time(self, move: Move) -> float:
        """s from standstill or the corner before to the end of a move, were it the next one."""
        self._check(move)
        path = self._execution.path
        if self.planner.has_zero_length(move, path.target):
            return 0.0
        from_rest = path.tail is None or path.tail.stops
        make = self.planner.way_maker(self._execution.limits())
        way = make(path.target, move, from_rest)
        rests = from_rest + move.zone.fine
        return way.duration + rests * (0.5 / (way.duration * way.strength) + self._drive.ramp / 2)

    def wait(self, waiter: MotionWaiter, leg: Leg, ready: Callable[[], bool]) -> None:
        """Hold a program until `ready()`, or until the leg is taken off the path."""
        hang = self.settings.cleared_move == "hang"
        waiter.wait_for(lambda: ready() or (leg.cleared and not hang), on=(self.changed,))

    def wait_standing(self, waiter: MotionWaiter) -> None:
        """Hold a program until the robot stands."""
        self._execution.settle()
        waiter.wait_for(lambda: self.is_settled, on=(self.changed,))

    def _check(self, move: Move) -> None:
        if move.concurrent:
            self._concurrent += 1
            if self._concurrent > self.settings.conc_limit:
                self._concurrent = 0
                raise MotionFault(FaultReason.TOO_MANY_CONCURRENT)
        else:
            self._concurrent = 0
        self.planner.check_range(move)

    # -- stops ------------------------------------------------------------------------------

    @property
    def stop_reasons(self) -> tuple[str, ...]:
        """Return the reasons of the stops in force."""
        return tuple(self._stops)

    def stop(self, reason: str, *, quick: bool = False, brakes: bool = False) -> None:
        """Slow down on the path and stay until `start` of the same reason. The path is kept.

        `quick`: harder. `brakes`: each axis comes to rest by itself, off the path; the way back
        to where it should have stopped is then the first of the path.
        """
        execution = self._execution
        execution.settle()
        self._stops[reason] = None
        if _BRAKES in self._stops:
            return
        if brakes and not self.is_standing:
            self._stops[_BRAKES] = None
            execution.at_rest = self._brakes_off
            execution.coast()
        elif self._drive.goes_on:
            execution.brake(quick=quick)
        execution.settle()

    def start(self, reason: str) -> None:
        """Take a stop back; the robot goes on when it was the last one.

        A robot that is off its path returns to it first, on a joint line.
        """
        self._execution.settle()
        self._stops.pop(reason, None)
        if not self._stops:
            self._execution.replan()
        self._execution.settle()

    def _brakes_off(self) -> None:
        """The brakes have done: the way back is the first of the path."""
        del self._stops[_BRAKES]
        if self.motion.coast is not None:
            self._execution.come_back(self.motion.rest, self.motion.law.place)
        if not self._stops:
            self._execution.replan()
        self._execution.settle()

    def clear_path(self) -> None:
        """Drop what is left of the path; a moving robot brakes on it first."""
        self._execution.settle()
        self._execution.clear()
        self._execution.settle()

    def release(self, reason: str) -> None:
        """Take a stop back without moving: what is left of the path goes, and is forgotten."""
        self.clear_path()
        self._execution.path.forget()
        self.start(reason)

    @property
    def path_level(self) -> int:
        """1 on the original path, one more for each StorePath."""
        return 1 + len(self._stored)

    def store_path(self, waiter: MotionWaiter, reason: str) -> None:
        """Put the path aside and begin an empty one where the robot stands.

        Without a stop the move under way first comes to its end; with one the robot stays in
        mid-path (S4 datasys StorePath). Stops of `reason` are put aside, too.
        """
        if reason in self._stops:
            self._execution.settle()
        waiter.wait_for(lambda: self.is_settled, on=(self.changed,))
        self._stored.append(self._execution.store())
        self._stops.pop(reason, None)
        self._execution.begin(Path(self.motion.rest))

    def restore_path(self, reason: str) -> None:
        """Bring the stored path back; nothing moves until `start(reason)`.

        A robot that stands elsewhere returns to the path on a joint line first. MotionFault
        NOTHING_STORED: there is none.
        """
        if not self._stored:
            raise MotionFault(FaultReason.NOTHING_STORED)
        self._execution.settle()
        current = self.positions()
        self._stops[reason] = None
        self._execution.restore(self._stored.pop(), current)
        self._execution.settle()

    def reset(self) -> None:
        """PP to main: no path, no stops by programs, default speeds."""
        self.clear_path()
        self._execution.path.forget()
        for aside in self._stored:
            self._execution.finish(list(aside.path.legs), cleared=True)
        self._stored.clear()
        for reason in self.stop_reasons:
            if reason.startswith(("move task", "other task")):
                del self._stops[reason]
        self.planner.modal = ModalSettings()
        for listener in self.on_reset:
            listener()
        self._execution.refresh(1.0)
        self._drive.tcp_limit = inf
        self._concurrent = 0
        self._change_speed()
