"""One motion group in time: runs its path, holds the program at the right moments, stops.

The kernel is asked for one event at a time (a release, a deadline, a standstill), so a robot
costs a few events a move, and nothing at all while it stands.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import ceil, inf
from typing import Protocol

from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import MotionGroup as GroupConfig
from rapidgen.virtual.errors import FatalError, RapidError
from rapidgen.virtual.io import IOSystem
from rapidgen.virtual.kernel import Kernel, S, Timer, WaitSet
from rapidgen.virtual.log import EventLog
from rapidgen.virtual.motion import events, ways
from rapidgen.virtual.motion.corners import zone_entry
from rapidgen.virtual.motion.legs import Leg
from rapidgen.virtual.motion.modal import ModalSettings
from rapidgen.virtual.motion.motion import Motion
from rapidgen.virtual.motion.moves import (
    NO_WAY,
    From,
    Move,
    PathEvent,
    Posture,
)
from rapidgen.virtual.motion.path import Path
from rapidgen.virtual.motion.pieces import AxisLimits, Piece
from rapidgen.virtual.motion.punctuality import Punctuality
from rapidgen.virtual.motion.settings import MotionSettings
from rapidgen.virtual.motion.timelaw import TimeLaw, brake, plan
from rapidgen.virtual.values import Record

MANUAL_REDUCED = 0.25
"""m/s of the TCP in manual mode with reduced speed."""


_NOT_PLANNED: tuple[int, tuple[Piece, ...], TimeLaw | None] = (-1, (), None)


class Waiter(Protocol):
    """What a task can do for a move."""

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until the predicate holds."""


@dataclass(frozen=True, slots=True)
class _Level:
    """What StorePath puts aside."""

    path: Path
    motion: Motion
    events: list[tuple[Leg, PathEvent]]


class MotionGroup:
    """One mechanical unit group: its path, its position and its stops."""

    def __init__(
        self,
        config: GroupConfig,
        kernel: Kernel,
        log: EventLog,
        io: IOSystem,
        settings: MotionSettings,
    ) -> None:
        self.config = config
        self.name = config.name
        self.settings = settings
        self.map = JointMap.of(config)
        self.kinematics = Kinematics.of(config)
        """None: the model has no geometry, so it moves in joints only."""
        self.changed = WaitSet()
        """Notified when a move is released or finished, and when motion begins or ends."""
        self._kernel = kernel
        self._log = log
        self._io = io
        self._stops: dict[str, None] = {}
        self._override = 1.0
        self._refresh = 1.0
        self._reduced = False
        self._timer: Timer | None = None
        self._due = inf
        self._commit = inf
        self._events: list[tuple[Leg, PathEvent]] = []
        self._stored: list[_Level] = []
        self._release = inf
        self._was_standing = True
        self._punctuality = Punctuality()
        self._concurrent = 0
        self._settled = 0
        self.modal = ModalSettings()
        self.inactive: set[str] = set()
        """External axes of deactivated units (DeactUnit)."""
        self.tool: Record | None = None
        """tooldata of the last move, None before the first."""
        self.work_object: Record | None = None
        """wobjdata of the last move, None before the first or when it had none."""
        self.observers: list[Callable[[Motion], None]] = []
        """Called with every new motion (the recorder)."""
        self.listeners: list[Callable[[Move], None]] = []
        """Called with every move that the program asks for."""
        start = tuple(min(max(0.0, j.lower), j.upper) for j in config.joints)
        self._path = Path(start)
        self._motion = Motion(kernel.now, kernel.now, TimeLaw(0.0), (), start)
        self._history: list[Motion] = []
        self._planned = _NOT_PLANNED
        """The law found last: appending asks for it twice."""
        self._report(True)
        io.report("MechUnitActive", 1, config.mechanical_unit)

    # -- where it is ------------------------------------------------------------------------

    def positions(self) -> Posture:
        """Axis values now, as measured: controller axes, rad and m, wire order."""
        now = self._kernel.now
        if not self._history:
            return self._motion.posture(now)
        then = now - round(self.settings.servo_lag * S)
        for motion in reversed((*self._history, self._motion)):
            if motion.since <= then:
                return motion.posture(then)
        return self._history[0].posture(then)

    def commanded(self) -> Posture:
        """Axis values now, as planned: ahead of `positions` by the servo lag."""
        return self._motion.posture(self._kernel.now)

    def joint_target(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """`robax` and `extax` now, deg and mm, 9E9 where there is no axis."""
        return self.map.to_rapid(self.positions())

    @property
    def path_target(self) -> Posture:
        """Where the path ends: the start of the next move."""
        return self._path.target

    def with_active(self, posture: Posture) -> Posture:
        """A target whose deactivated external axes stay where the path ends."""
        if not self.inactive:
            return posture
        ends = self.path_target
        return tuple(
            end if joint.axis in self.inactive else value
            for joint, value, end in zip(self.config.joints, posture, ends, strict=True)
        )

    def use(self, tool: Record, work_object: Record | None) -> None:
        """Tool and work object of the move that follows are the active ones from now on."""
        self.tool = tool.copy()
        self.work_object = work_object.copy() if work_object is not None else None

    def jump(self, posture: Posture) -> None:
        """Put the standing robot elsewhere (a test, a restored state). The path is dropped."""
        self._finish(self._path.cut(self._path.end), cleared=True)
        self._path = Path(tuple(posture))
        self._set_motion(TimeLaw(0.0), self._kernel.now)
        self._settle()

    @property
    def motion(self) -> Motion:
        """The motion under way, or the last one."""
        return self._motion

    @property
    def is_standing(self) -> bool:
        """Whether no axis moves."""
        return self._kernel.now >= self._end

    @property
    def is_settled(self) -> bool:
        """Whether it stands and the settling time is over too."""
        return self._kernel.now >= self._end + round(self.settings.settle * S)

    @property
    def legs(self) -> tuple[Leg, ...]:
        """Moves on the path that are not finished; the first is the one under way."""
        self._settle()
        return tuple(self._path.legs)

    @property
    def _end(self) -> int:
        return self._motion.start + ceil(self._motion.law.duration * S)

    # -- speed ------------------------------------------------------------------------------

    @property
    def override(self) -> float:
        """Speed override of the controller, 0 to 1."""
        return self._override

    @override.setter
    def override(self, value: float) -> None:
        if not 0.0 <= value <= 1.0:
            raise ValueError("the speed override is 0 to 1")
        self._override = value
        self._change_speed()

    @property
    def refresh(self) -> float:
        """Speed override of the program (SpeedRefresh), 0 to 1."""
        return self._refresh

    @refresh.setter
    def refresh(self, value: float) -> None:
        self._refresh = value
        self._change_speed()

    @property
    def reduced(self) -> bool:
        """Manual mode with reduced speed: the TCP moves at 250 mm/s at most."""
        return self._reduced

    @reduced.setter
    def reduced(self, value: bool) -> None:
        if value != self._reduced:
            self._reduced = value
            self._change_speed()

    def _change_speed(self) -> None:
        self._planned = _NOT_PLANNED
        if self._override * self._refresh == 0.0:
            self.stop("override")
        elif "override" in self._stops:
            self.start("override")
        elif not self._stops:
            self._settle()
            self._replan()
            self._settle()

    # -- moving -----------------------------------------------------------------------------

    def move(self, task: Waiter, move: Move) -> None:
        """Put a move on the path and hold the task as its zone asks for.

        A stop point lets the program go on when the robot stands there; a fly-by point some
        time before the path could no longer be changed into a corner. ERR_ROBLIMIT or
        FatalError 50027: outside the axis ranges. ERR_CONC_MAX: too many \\Conc in a row.
        """
        leg = self.enqueue(move)
        if leg is None or move.concurrent:
            return
        if move.zone.fine:
            self.wait(task, leg, lambda: leg.finished and self.is_settled)
            if move.dwell > 0:
                task.wait_for(lambda: False, on=(), timeout=move.dwell)
        else:
            self.wait(task, leg, lambda: leg.released or leg.finished)

    def enqueue(self, move: Move) -> Leg | None:
        """Put a move on the path without holding anybody; None when the robot is there."""
        self._check(move)
        for listener in self.listeners:
            listener(move)
        self._settle()
        leg = self._append(move)
        self._settle()
        return leg

    def wait(self, task: Waiter, leg: Leg, ready: Callable[[], bool]) -> None:
        """Hold a task until `ready()`, or until the leg is taken off the path."""
        hang = self.settings.cleared_move == "hang"
        task.wait_for(lambda: ready() or (leg.cleared and not hang), on=(self.changed,))

    def wait_standing(self, task: Waiter) -> None:
        """Hold the task until the robot stands."""
        self._settle()
        task.wait_for(lambda: self.is_settled, on=(self.changed,))

    def _check(self, move: Move) -> None:
        if move.concurrent:
            self._concurrent += 1
            if self._concurrent > self.settings.conc_limit:
                self._concurrent = 0
                raise RapidError("ERR_CONC_MAX")
        else:
            self._concurrent = 0
        ways.check_range(self.config, self.settings, move)

    def _append(self, move: Move) -> Leg | None:
        path = self._path
        waits = self.settings.zero_length == "wait" and move.time is not None
        if ways.goes_nowhere(self.config, self.kinematics, move, path.target) and not waits:
            return self._stay(move)
        place, _ = self._state()
        fixed = place
        if self._braking():
            fixed = max(fixed, self._motion.law.place)
        path.prune(place)
        limits = self._limits()
        make = ways.make(self.config, self.kinematics, self.settings, limits)
        standing = self.is_standing
        leg, failed = path.extend(move, make, self._law, limits, fixed, self.kinematics)
        self._events += [(leg, event) for event in move.events]
        if standing and not self._stops:
            leg.began = self._kernel.now / S
        if failed:
            self._corner_failure(path.legs[-2])
        if not self._stops:
            self._replan()
        return leg

    def _stay(self, move: Move) -> Leg | None:
        """A move to where the path ends: a stop point makes the end a stop, else nothing."""
        tail = self._path.tail
        if not move.zone.fine:
            return tail
        if tail is None or tail.finished:
            return None
        tail.committed = True
        self._rearm()
        return tail

    def _limits(self) -> AxisLimits:
        """What the axes may do under the settings of now (AccSet, PathAccLim)."""
        joints, modal = self.config.joints, self.modal
        return AxisLimits(
            [j.speed for j in joints],
            [j.acceleration * modal.acceleration for j in joints],
            self.settings.corner_share,
            modal.path_acceleration,
        )

    def geometry(self) -> Kinematics:
        """The group's kinematics. FatalError: its model has none."""
        return ways.require(self.config, self.kinematics)

    # -- stops ------------------------------------------------------------------------------

    @property
    def stop_reasons(self) -> tuple[str, ...]:
        """Who keeps the robot from moving."""
        return tuple(self._stops)

    def stop(self, reason: str, *, quick: bool = False) -> None:
        """Brake on the path and stay until `start` of the same reason. The path is kept."""
        self._settle()
        self._stops[reason] = None
        place, speed = self._state()
        if speed > 0.0:
            self._brake(place, speed, quick)
        self._settle()

    def start(self, reason: str) -> None:
        """Take a stop back; the robot goes on when it was the last one."""
        self._settle()
        self._stops.pop(reason, None)
        if not self._stops:
            self._replan()
        self._settle()

    def clear_path(self) -> None:
        """Drop what is left of the path; a moving robot brakes on it first."""
        self._settle()
        place, speed = self._state()
        if speed > 0.0 and not self._braking():
            self._brake(place, speed, False)
        lost = self._path.cut(self._motion.law.place)
        self._move_by(self._motion.law, self._motion.start, self._path.target)
        self._finish(lost, cleared=True)
        self._settle()

    @property
    def path_level(self) -> int:
        """1 on the original path, one more for each StorePath."""
        return 1 + len(self._stored)

    def store_path(self, task: Waiter, reason: str) -> None:
        """Put the path aside and begin an empty one where the robot stands.

        Without a stop the move under way first comes to its end; with one the robot stays in
        mid-path (S4 datasys StorePath). Stops of `reason` are put aside, too.
        """
        if reason not in self._stops:
            task.wait_for(lambda: self.is_settled, on=(self.changed,))
        else:
            self.wait_standing(task)
        place, _ = self._state()
        self._path.prune(place)
        self._stored.append(_Level(self._path, self._motion, self._events))
        self._path = Path(self._motion.rest)
        self._events = []
        self._stops.pop(reason, None)
        self._set_motion(TimeLaw(0.0), self._kernel.now)
        self._settle()

    def restore_path(self, reason: str) -> None:
        """Bring the stored path back; nothing moves until `start(reason)`.

        A robot that stands elsewhere returns to the path on a joint line first.
        """
        if not self._stored:
            raise FatalError(events.NOT_ALLOWED, "No path is stored")
        self._settle()
        here = self.positions()
        level = self._stored.pop()
        self._finish(list(self._path.legs), cleared=True)
        self._path, self._events = level.path, level.events
        self._stops[reason] = None
        place = level.motion.law.place
        if self._path.regain(here, level.motion.rest, place, self._limits()):
            place = self._path.pieces[0].start
        self._move_by(TimeLaw(place), self._kernel.now, here)
        self._settle()

    def reset(self) -> None:
        """PP to main: no path, no stops by programs, default speeds."""
        self.clear_path()
        for level in self._stored:
            self._finish(list(level.path.legs), cleared=True)
        self._stored.clear()
        for reason in ("move task", "other task"):
            self._stops.pop(reason, None)
        self.modal = ModalSettings()
        self._refresh = 1.0
        self._concurrent = 0
        self._change_speed()

    def _braking(self) -> bool:
        """Whether the law that runs is a way to a stop that may lie short of the path's end."""
        return bool(self._stops) or self._motion.law.place < self._path.end - 1e-9

    def _brake(self, place: float, speed: float, quick: bool) -> None:
        factor = self.settings.quick_factor if quick else 1.0
        self._path.prune(place)
        self._set_motion(brake(self._path.pieces, place, speed, factor), self._kernel.now)

    # -- time laws --------------------------------------------------------------------------

    def _state(self) -> tuple[float, float]:
        return self._motion.law.state((self._kernel.now - self._motion.start) / S)

    def _law(self, pieces: tuple[Piece, ...]) -> TimeLaw | None:
        now = self._kernel.now
        planned_at, planned, law = self._planned
        if planned is pieces and planned_at == now:
            return law
        place, speed = self._state()
        limit = MANUAL_REDUCED if self._reduced else inf
        law = plan(pieces, place, speed, self._override * self._refresh, limit)
        self._planned = now, pieces, law
        return law

    def _replan(self) -> None:
        """Go from the present state to the end of the path."""
        place, _ = self._state()
        path = self._path
        path.prune(place)
        if not path.pieces or path.end <= place:
            self._rearm()
            return
        law = self._law(path.pieces)
        if law is None:
            # It brakes to a stop that cannot be taken back; then on from there.
            self._set_motion(self._motion.law.then(self._law_from_rest()), self._motion.start)
        else:
            self._set_motion(law, self._kernel.now)

    def _law_from_rest(self) -> TimeLaw:
        limit = MANUAL_REDUCED if self._reduced else inf
        place = self._motion.law.place
        law = plan(self._path.pieces, place, 0.0, self._override * self._refresh, limit)
        assert law is not None  # from rest every limit can be kept
        return law

    def _set_motion(self, law: TimeLaw, start: int) -> None:
        path = self._path
        self._punctuality.look(self._path.legs, self._motion, self._kernel.now)
        rest = path.target if law.place >= path.end else path.at(law.place)
        self._move_by(law, start, rest)

    def _move_by(self, law: TimeLaw, start: int, rest: Posture) -> None:
        now = self._kernel.now
        self._planned = _NOT_PLANNED
        if self.settings.servo_lag > 0:
            old = now - round(self.settings.servo_lag * S)
            later = [m for m in self._history if m.since > old]
            kept = self._history[-len(later) - 1 :] if self._history else []
            self._history = [*kept, self._motion]
        legs = tuple((leg.end, leg.move) for leg in self._path.legs)
        self._motion = Motion(now, start, law, self._path.pieces, rest, legs)
        for observer in self.observers:
            observer(self._motion)
        self._rearm()

    # -- deadlines --------------------------------------------------------------------------

    def _rearm(self) -> None:
        """Find out what happens next on the present motion, and ask for that event."""
        start, law = self._motion.start / S, self._motion.law
        tail = self._path.tail
        self._commit = self._release = inf
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            self._commit = start + min(law.last_braking(), law.time_at(zone_entry(tail)))
            self._release = self._commit - self.settings.planning_lead
        self._schedule()

    def _schedule(self) -> None:
        now = self._kernel.now
        start, law = self._motion.start, self._motion.law
        times = [self._end] if now < self._end else []
        settled = self._end + round(self.settings.settle * S)
        if now < settled:
            times.append(settled)
        tail = self._path.tail
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            if not tail.released:
                times.append(ceil(self._release * S))
            times.append(ceil(self._commit * S))
        for leg in self._path.legs:
            if leg.stops:
                times.append(start + ceil(law.time_at(leg.end) * S))
                break
        times += [ceil(when * S) for when in map(self._when, self._events) if when < inf]
        ahead = [time for time in times if time > now]
        due = min(ahead, default=None)
        if self._timer is not None:
            if self._timer.active and self._timer.time == due:
                return
            self._timer.cancel()
        self._timer = None if due is None else self._kernel.at(due, self._settle)

    def _settle(self) -> None:
        """Bring everything up to the present time."""
        now = self._kernel.now / S
        changed = False
        tail = self._path.tail
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            if not tail.released and now >= self._release:
                tail.released = changed = True
            if now >= self._commit:
                tail.committed = tail.released = changed = True
                self._corner_failure(tail)
        if self._events:
            self._fire_events()
        place, _ = self._state()
        done = self._path.passed(place)
        if done:
            self._finish(done, cleared=False)
            changed = True
        standing = self.is_standing
        if standing != self._was_standing:
            self._was_standing = standing
            self._report(standing)
            if standing:
                self._punctuality.report(self._log, self.name)
            changed = True
        if standing and self._settled != self._motion.start:
            self._settled = self._motion.start
            changed = True
        self._schedule()
        if changed:
            self.changed.notify()

    def _when(self, entry: tuple[Leg, PathEvent]) -> float:
        """Kernel time (s) of an event on the present motion; infinite when it stops short."""
        leg, event = entry
        law, start = self._motion.law, self._motion.start / S
        place = leg.end
        if event.where in (From.END, From.START):
            length = leg.way.measure.tcp
            share = min(1.0, event.amount / length) if length > NO_WAY else 0.0
            way = share * (leg.end - leg.begin)
            place = leg.begin + way if event.where is From.START else leg.end - way
        early = event.lag + (event.amount if event.where is From.BEFORE_END else 0.0)
        if law.place < place - 1e-9:
            return inf
        return start + law.time_at(place) - early

    def _fire_events(self) -> None:
        now = self._kernel.now / S
        due = [entry for entry in self._events if self._when(entry) <= now]
        self._events = [e for e in self._events if e not in due and not e[0].cleared]
        for _, event in due:
            event.act()

    def _finish(self, legs: list[Leg], *, cleared: bool) -> None:
        for leg in legs:
            leg.finished = not cleared
            leg.cleared = cleared
            if not cleared:
                self._punctuality.finished(leg, self._motion)
        if legs and cleared:
            self.changed.notify()

    def _corner_failure(self, leg: Leg) -> None:
        where = leg.move.place() if leg.move.place is not None else None
        self._log.warning(
            events.CORNER_PATH_FAILURE,
            "Corner path failure",
            f"{self.name}: the corner is executed as a stop point"
            + (f" ({where})" if where else ""),
            "the next move was not planned in time",
        )

    def _report(self, standing: bool) -> None:
        self._io.report("MechUnitNotMoving", int(standing), self.config.mechanical_unit)
