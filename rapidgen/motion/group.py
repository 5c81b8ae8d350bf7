"""One motion group in time: runs its path, holds the program at the right moments, stops.

The scheduler is asked for one event at a time (a release, a deadline, a standstill), so a robot
costs a few events a move, and nothing at all while it stands.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, inf

from rapidgen.axes.kinematics import Kinematics, MovingFrame
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.machine.io import IOSystem
from rapidgen.machine.log import EventLog
from rapidgen.machine.scheduler import S, Scheduler, Timer, WaitSet
from rapidgen.motion import events, ways
from rapidgen.motion.corners import zone_entry
from rapidgen.motion.drive import Drive
from rapidgen.motion.legs import Leg
from rapidgen.motion.limits import limits_now, ramp_now, tool_frame
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import Move, Posture
from rapidgen.motion.path import Path
from rapidgen.motion.pathevents import PathEvents
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.punctuality import Punctuality
from rapidgen.motion.settings import MotionSettings
from rapidgen.motion.timelaw import TimeLaw
from rapidgen.motion.waiter import Waiter
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.values import Record

_BRAKES = "brakes"
"""The stop that holds while the brakes bring the robot to rest."""


@dataclass(frozen=True, slots=True)
class _Level:
    """What StorePath puts aside."""

    path: Path
    motion: Motion
    events: PathEvents


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
        self.kinematics = Kinematics.of(config)
        """None: the model has no geometry, so it moves in joints only."""
        self._frames = {p.unit.lower(): MovingFrame.of(config, p.chain) for p in config.positioners}
        self.changed = WaitSet()
        """Notified when a move is released or finished, and when motion begins or ends."""
        self._scheduler = scheduler
        self._log = log
        self._io = io
        self._stops: dict[str, None] = {}
        self._timer: Timer | None = None
        self._commit = inf
        self._events = PathEvents()
        self._stored: list[_Level] = []
        self._release = inf
        self._was_standing = True
        self._punctuality = Punctuality()
        self._concurrent = 0
        self._limited = False
        self._settled: Motion | None = None
        """The motion whose settling was told."""
        self.modal = ModalSettings()
        self.inactive: set[str] = set()
        """External axes of deactivated units (DeactUnit)."""
        self.tool: Record | None = None
        """tooldata of the last move, None before the first."""
        self.work_object: Record | None = None
        """wobjdata of the last move, None before the first or when it had none."""
        self.listeners: list[Callable[[Move], None]] = []
        """Called with every move that the program asks for."""
        start = tuple(min(max(0.0, j.lower), j.upper) for j in config.joints)
        self._path = Path(start)
        self._drive = Drive(scheduler, settings, start)
        self._report(True)
        io.report("MechUnitActive", 1, config.mechanical_unit)

    # -- where it is ------------------------------------------------------------------------

    @property
    def settings(self) -> MotionSettings:
        """Assumptions that are switches."""
        return self._drive.settings

    @settings.setter
    def settings(self, value: MotionSettings) -> None:
        self._drive.settings = value

    @property
    def observers(self) -> list[Callable[[Motion], None]]:
        """Called with every new motion (the recorder)."""
        return self._drive.observers

    def positions(self) -> Posture:
        """Axis values now, as measured: controller axes, rad and m, wire order."""
        return self._drive.measured()

    def commanded(self) -> Posture:
        """Axis values now, as planned: ahead of `positions` by the servo lag."""
        return self._drive.commanded()

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
        self._begin(Path(tuple(posture)))

    @property
    def motion(self) -> Motion:
        """The motion under way, or the last one."""
        return self._drive.motion

    @property
    def is_standing(self) -> bool:
        """Whether no axis moves."""
        return self._scheduler.now >= self._drive.motion.end

    @property
    def is_settled(self) -> bool:
        """Whether it stands and the settling time is over too."""
        return self._scheduler.now >= self._drive.settled

    @property
    def legs(self) -> tuple[Leg, ...]:
        """Moves on the path that are not finished; the first is the one under way."""
        self._settle()
        return tuple(self._path.legs)

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
        """Speed override of the program (SpeedRefresh), 0 to 1."""
        return self._drive.refresh

    @refresh.setter
    def refresh(self, value: float) -> None:
        self._drive.refresh = value
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
        return self._limited

    @speed_limited.setter
    def speed_limited(self, value: bool) -> None:
        self._limited = value
        self.limit_point()

    def limit_point(self) -> None:
        """The TCP's limit may have changed: it holds at once; those of axes for new moves."""
        self._drive.tcp_limit = self.modal.point_limit if self._limited else inf
        self._change_speed()

    def _change_speed(self) -> None:
        self._drive.forget()
        if self._drive.override * self._drive.refresh == 0.0:
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

    def whole_time(self, move: Move) -> float:
        """s from standstill or the corner before to the end of a move, were it the next one."""
        self._check(move)
        path = self._path
        if ways.goes_nowhere(self.config, self.kinematics, move, path.target):
            return 0.0
        from_rest = path.tail is None or path.tail.stops
        if self.is_standing:
            self._drive.ramp = ramp_now(self.settings, self.modal)
        make = ways.make(self.config, self.kinematics, self.settings, self._limits())
        way = make(path.target, move, from_rest)
        rests = from_rest + move.zone.fine
        return way.duration + rests * (0.5 / (way.duration * way.strength) + self._drive.ramp / 2)

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
        self._drive.refreshed = self.settings.refresh_timed or move.time is None
        waits = self.settings.zero_length == "wait" and move.time is not None
        if ways.goes_nowhere(self.config, self.kinematics, move, path.target) and not waits:
            return self._stay(move)
        fixed, _ = self._drive.planned()
        if self._braking():
            fixed = max(fixed, self.motion.law.place)
        path.prune(self._drive.place())
        if self.is_standing:
            self._drive.ramp = ramp_now(self.settings, self.modal)
        limits = self._limits()
        make = ways.make(self.config, self.kinematics, self.settings, limits)
        standing = self.is_standing
        leg, failed = path.extend(move, make, self._drive.law, limits, fixed, self.kinematics)
        self._events.add(leg)
        if standing and not self._stops:
            leg.began = self._scheduler.now / S
        if failed:
            events.corner_failure(self._log, self.name, path.legs[-2].move)
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
        return limits_now(
            self.config,
            self.kinematics,
            self.settings,
            self.modal,
            self.tool,
            self._drive.ramp,
            limited=self._limited,
        )

    def moving_frame(self, unit: str) -> MovingFrame | None:
        """The user frame of a unit that carries work objects; None: not known."""
        return self._frames.get(unit.lower())

    def geometry(self) -> Kinematics:
        """The group's kinematics. FatalError: its model has none."""
        return ways.require(self.config, self.kinematics)

    # -- stops ------------------------------------------------------------------------------

    @property
    def stop_reasons(self) -> tuple[str, ...]:
        """Who keeps the robot from moving."""
        return tuple(self._stops)

    def stop(self, reason: str, *, quick: bool = False, brakes: bool = False) -> None:
        """Slow down on the path and stay until `start` of the same reason. The path is kept.

        `quick`: harder. `brakes`: each axis comes to rest by itself, off the path; the way back
        to where it should have stopped is then the first of the path.
        """
        self._settle()
        self._stops[reason] = None
        if _BRAKES in self._stops:
            return
        if brakes and not self.is_standing:
            self._stops[_BRAKES] = None
            self._punctuality.look(self._path.legs, self.motion, self._scheduler.now)
            self._drive.coast(self._path, self.config.joints)
            self._rearm()
        elif self._drive.planned()[1] > 0.0:
            self._brake(quick)
        self._settle()

    def start(self, reason: str) -> None:
        """Take a stop back; the robot goes on when it was the last one.

        A robot that is off its path returns to it first, on a joint line.
        """
        self._settle()
        self._stops.pop(reason, None)
        if not self._stops:
            self._replan()
        self._settle()

    @property
    def off_path(self) -> tuple[float, float]:
        """How far (m, rad of the TCP) a standing robot is from where its path goes on."""
        way = self._path.way_back(self._drive.place())
        if way is None:
            return 0.0, 0.0
        return ways.apart(self.config, self.kinematics, self.settings, way, tool_frame(self.tool))

    def jog(self, posture: Posture) -> None:
        """Put a standing robot elsewhere by hand; it returns to its path before it goes on.

        A path that is done is dropped. ValueError: the robot moves.
        """
        if not self.is_standing:
            raise ValueError("the robot moves")
        if not self.legs:
            self.jump(posture)
            return
        self._come_back(tuple(posture), self.motion.law.place)
        self._settle()

    def _come_back(self, here: Posture, place: float) -> None:
        """The path goes on at a place, and the robot stands elsewhere."""
        place = self._path.regain(here, place, self._limits())
        if not self._path.pieces:
            self._path.target = here
        self._drive.put(TimeLaw(place), self._scheduler.now, self._path, here)
        self._rearm()

    def clear_path(self) -> None:
        """Drop what is left of the path; a moving robot brakes on it first."""
        self._settle()
        if self._drive.planned()[1] > 0.0 and not self._braking():
            self._brake(False)
        motion, path = self.motion, self._path
        lost = path.cut(motion.law.place)
        if motion.coast is None:
            self._drive.put(motion.law, motion.start, path, path.target)
        else:
            self._path = Path(motion.rest)
            now, rest = self._scheduler.now, motion.rest
            self._drive.put(TimeLaw(0.0), now, self._path, rest, motion.coast)
        self._rearm()
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
        self._path.prune(self._drive.place())
        self._stored.append(_Level(self._path, self.motion, self._events))
        self._events = PathEvents()
        self._stops.pop(reason, None)
        self._begin(Path(self.motion.rest))

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
        self._come_back(here, level.motion.law.place)
        self._settle()

    def reset(self) -> None:
        """PP to main: no path, no stops by programs, default speeds."""
        self.clear_path()
        for level in self._stored:
            self._finish(list(level.path.legs), cleared=True)
        self._stored.clear()
        for reason in self.stop_reasons:
            if reason.startswith(("move task", "other task")):
                del self._stops[reason]
        self.modal = ModalSettings()
        self._drive.refresh, self._drive.tcp_limit = 1.0, inf
        self._concurrent = 0
        self._change_speed()

    def _braking(self) -> bool:
        """Whether the law that runs is a way to a stop that may lie short of the path's end."""
        return bool(self._stops) or self.motion.law.place < self._path.end - 1e-9

    def _brake(self, quick: bool) -> None:
        self._punctuality.look(self._path.legs, self.motion, self._scheduler.now)
        self._drive.brake(self._path, quick)
        self._rearm()

    def _replan(self) -> None:
        """Go from the present state to the end of the path."""
        self._punctuality.look(self._path.legs, self.motion, self._scheduler.now)
        self._drive.replan(self._path)
        self._rearm()

    def _begin(self, path: Path) -> None:
        """A path that begins where the robot stands."""
        self._path = path
        self._drive.put(TimeLaw(0.0), self._scheduler.now, path)
        self._rearm()
        self._settle()

    # -- deadlines --------------------------------------------------------------------------

    def _rearm(self) -> None:
        """Find out what happens next on the present motion, and ask for that event."""
        start, law = self.motion.start / S, self.motion.law
        tail = self._path.tail
        self._commit = self._release = inf
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            self._commit = start + min(law.last_braking(), law.time_at(zone_entry(tail)))
            self._release = self._commit - self.settings.planning_lead
        self._schedule()

    def _schedule(self) -> None:
        now, motion = self._scheduler.now, self.motion
        times = [motion.end, self._drive.settled]
        tail = self._path.tail
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            if not tail.released:
                times.append(ceil(self._release * S))
            times.append(ceil(self._commit * S))
        for leg in self._path.legs:
            if leg.stops:
                times.append(ceil(motion.time_at(leg.end) * S))
                break
        times += [ceil(when * S) for when in self._events.times(motion)]
        ahead = [time for time in times if time > now]
        due = min(ahead, default=None)
        if self._timer is not None:
            if self._timer.active and self._timer.time == due:
                return
            self._timer.cancel()
        self._timer = None if due is None else self._scheduler.at(due, self._settle)

    def _settle(self) -> None:
        """Bring everything up to the present time."""
        now = self._scheduler.now / S
        changed = False
        tail = self._path.tail
        if tail is not None and not (tail.stops or tail.finished or self._stops):
            # In ns, as these times were asked for: now in s may lie a bit before them.
            if not tail.released and self._scheduler.now >= ceil(self._release * S):
                tail.released = changed = True
            if self._scheduler.now >= ceil(self._commit * S):
                tail.committed = tail.released = changed = True
                events.corner_failure(self._log, self.name, tail.move)
        self._events.fire(self.motion, now)
        # Off the path nothing is reached, wherever on it the robot should be.
        if self.motion.coast is None and (done := self._path.passed(self._drive.place())):
            self._finish(done, cleared=False)
            changed = True
        standing = self.is_standing
        if standing != self._was_standing:
            self._was_standing = standing
            self._report(standing)
            if standing:
                self._punctuality.report(self._log, self.name)
            changed = True
        if self.is_settled and self._settled is not self.motion:
            self._settled = self.motion
            changed = True
        self._schedule()
        if changed:
            self.changed.notify()
        if standing and _BRAKES in self._stops:
            self._brakes_off()

    def _brakes_off(self) -> None:
        """The brakes have done: the way back is the first of the path."""
        del self._stops[_BRAKES]
        if self.motion.coast is not None:
            self._come_back(self.motion.rest, self.motion.law.place)
        if not self._stops:
            self._replan()
        self._settle()

    def _finish(self, legs: list[Leg], *, cleared: bool) -> None:
        for leg in legs:
            leg.finished = not cleared
            leg.cleared = cleared
            if not cleared:
                self._punctuality.finished(leg, self.motion)
        if legs and cleared:
            self.changed.notify()

    def _report(self, standing: bool) -> None:
        self._io.report("MechUnitNotMoving", int(standing), self.config.mechanical_unit)
