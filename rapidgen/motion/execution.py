"""One path in time: what is due now, and when to look again.

The scheduler is asked for one event at a time (a release, a deadline, a standstill), so a robot
costs a few events a move, and nothing at all while it stands.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf

from rapidgen.axes.kinematics import Posture
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.scheduler import S, Scheduler, Timer, WaitSet
from rapidgen.motion import events
from rapidgen.motion.braking import GuidedStep
from rapidgen.motion.corners import zone_entry
from rapidgen.motion.drive import Drive
from rapidgen.motion.legs import Leg
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import Move
from rapidgen.motion.path import Path
from rapidgen.motion.path_events import PathEvents
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.planner import Planner
from rapidgen.motion.speed_profile import SpeedProfile
from rapidgen.motion.timing_monitor import TimingMonitor


@dataclass(frozen=True, slots=True)
class StoredPath:
    """A path that another one interrupts, and how far it has come."""

    path: Path
    motion: Motion
    events: PathEvents


class PathExecution:
    """Runs the path of one group."""

    __slots__ = (
        "_commit",
        "_events",
        "_log",
        "_name",
        "_planner",
        "_punctuality",
        "_refreshed",
        "_release",
        "_report",
        "_scheduler",
        "_settled",
        "_timer",
        "_was_standing",
        "at_rest",
        "changed",
        "drive",
        "path",
        "stops",
    )

    def __init__(
        self,
        scheduler: Scheduler,
        log: EventLog,
        planner: Planner,
        start: Posture,
        report: Callable[[bool], None],
    ) -> None:
        """`report` is called with whether the robot stands, whenever that changes."""
        self._scheduler = scheduler
        self._log = log
        self._name = planner.config.name
        self._planner = planner
        self._report = report
        self.path = Path(start)
        self.drive = Drive(scheduler, planner.settings, start)
        self.stops: dict[str, None] = {}
        """Reasons of the stops in force."""
        self.changed = WaitSet()
        """Notified when a move is released or finished, and when motion begins or ends."""
        self.at_rest: Callable[[], None] | None = None
        """Called once when the robot stands."""
        self._events = PathEvents()
        self._punctuality = TimingMonitor()
        self._refreshed: Leg | None = None
        """The leg that SpeedRefresh holds for, where it does not last."""
        self._timer: Timer | None = None
        self._commit = self._release = inf
        """Scheduler s at which the end of the path becomes a stop; of the program going on."""
        self._was_standing = True
        self._settled: Motion | None = None
        """The motion whose settling has been notified."""

    @property
    def motion(self) -> Motion:
        """The motion under way, or the last one."""
        return self.drive.motion

    @property
    def is_standing(self) -> bool:
        """Whether no axis moves."""
        return self._scheduler.now >= self.drive.motion.end

    @property
    def is_settled(self) -> bool:
        """Whether it stands and the settling time is over too."""
        return self._scheduler.now >= self.drive.settled

    def _braking(self) -> bool:
        """Whether the law that runs is a way to a stop that may lie short of the path's end."""
        return bool(self.stops) or self.motion.law.place < self.path.end - 1e-9

    # -- the path ---------------------------------------------------------------------------

    def limits(self) -> AxisLimits:
        """Limits for moves that are planned now. AccSet changes the ramp at a standstill only."""
        if self.is_standing:
            self.drive.ramp = self._planner.ramp
        return self._planner.limits(self.drive.ramp)

    def append(self, move: Move) -> Leg:
        """Put a move on the path. MotionFault: it cannot be made, the path is as it was."""
        path, drive = self.path, self.drive
        fixed, _ = drive.planned()
        if self._braking():
            fixed = max(fixed, self.motion.law.place)
        path.prune(drive.behind())
        limits, at_rest = self.limits(), self.is_standing
        make = self._planner.way_maker(limits)
        leg, failed = path.extend(move, make, drive.plan, limits, fixed, self._planner.kinematics)
        self._events.add(leg)
        if at_rest and not self.stops:
            leg.began = self._scheduler.now / S
        if failed:
            self._warn_of_corner(path.legs[-2].move)
        if not self.stops:
            self.replan()
        return leg

    def _warn_of_corner(self, move: Move) -> None:
        if self._planner.modal.corner_warning:
            events.corner_failure(self._log, self._planner.config.task, move)

    def stay(self, move: Move) -> Leg | None:
        """A move to where the path ends: a stop point makes the end a stop. Its events are due
        there, all at once (S4 datasys 2-TriggL-3)."""
        tail = self.path.tail
        if tail is None or tail.finished:
            for event in move.events:
                event.act()
            return None
        self._events.add_at_end(tail, move.events)
        tail.committed |= move.zone.fine
        self._rearm()
        return tail

    def begin(self, path: Path) -> None:
        """A path that begins where the robot stands."""
        self.path = path
        self._refreshed = None
        self.drive.put(SpeedProfile(0.0), self._scheduler.now, path)
        self._rearm()
        self.settle()

    def guide(self, posture: Posture, time: float, reference: Posture | None) -> None:
        """Leave the path for a step of externally guided motion; the path begins at its end."""
        now = self._scheduler.now
        step = GuidedStep(now, self.drive.commanded(), posture, round(time * S), reference)
        self.path = Path(posture)
        self._refreshed = None
        self.drive.put(SpeedProfile(0.0), now, self.path, posture, step)
        self._rearm()
        self.settle()

    def brake_guided(self) -> None:
        """End externally guided motion: each axis slows down by itself."""
        self.coast()
        self.path = Path(self.motion.rest)
        self._rearm()
        self.settle()

    def clear(self) -> None:
        """Drop what is left of the path; a moving robot brakes on it first."""
        if self.drive.goes_on and not self._braking():
            self.brake(quick=False)
        motion, path = self.motion, self.path
        lost = path.cut(motion.law.place)
        if motion.coast is None:
            self.drive.put(motion.law, motion.start, path, path.target)
        else:
            self.path = Path(motion.rest)
            self.path.left_at(path.target)
            now, remaining = self._scheduler.now, motion.rest
            self.drive.put(SpeedProfile(0.0), now, self.path, remaining, motion.coast)
        self._rearm()
        self.finish(lost, cleared=True)

    def store(self) -> StoredPath:
        """The path as it is, for `restore`; another one is to `begin`."""
        self.path.prune(self.drive.behind())
        aside = StoredPath(self.path, self.motion, self._events)
        self._events = PathEvents()
        return aside

    def restore(self, aside: StoredPath, current: Posture) -> None:
        """Drop this path for one that was put aside; the robot stands at `current`."""
        self.finish(list(self.path.legs), cleared=True)
        self.path, self._events = aside.path, aside.events
        self.come_back(current, aside.motion.law.place)

    def come_back(self, current: Posture, place: float) -> None:
        """The path goes on at a place, and the robot stands elsewhere."""
        place = self.path.distance_to_path(current, place, self._planner.limits(self.drive.ramp))
        if not self.path.pieces:
            self.path.target = current
        self.drive.put(SpeedProfile(place), self._scheduler.now, self.path, current)
        self._rearm()

    def finish(self, legs: list[Leg], *, cleared: bool) -> None:
        """Legs are passed, or taken off the path."""
        behind = next(iter(self.path.legs), None)
        for leg, following in pairwise((*legs, behind)):
            assert leg is not None
            leg.finished = not cleared
            leg.cleared = cleared
            if not cleared:
                self._punctuality.finished(leg, following, self.motion)
        if legs and cleared:
            self.changed.notify()

    # -- the motion -------------------------------------------------------------------------

    def replan(self) -> None:
        """Go from the present state to the end of the path."""
        self._punctuality.look(self.path.legs, self.motion, self.drive.place())
        self.drive.replan(self.path)
        self._rearm()

    def brake(self, *, quick: bool) -> None:
        """Slow down to a standstill on the path."""
        self._punctuality.look(self.path.legs, self.motion, self.drive.place())
        self.drive.brake(self.path, self._planner.config.joints, quick=quick)
        self._rearm()

    def coast(self) -> None:
        """Stop each axis by its brake, off the path."""
        self._punctuality.look(self.path.legs, self.motion, self.drive.place())
        self.drive.coast(self.path, self._planner.config.joints)
        self._rearm()

    # -- deadlines --------------------------------------------------------------------------

    def _rearm(self) -> None:
        """Find out what happens next on the present motion, and ask for that event."""
        start, law = self.motion.start / S, self.motion.law
        tail = self.path.tail
        self._commit = self._release = inf
        if tail is not None and not (tail.stops or tail.finished or self.stops):
            self._commit = start + min(law.last_braking(), law.time_at(zone_entry(tail)))
            self._release = self._commit - self._planner.settings.planning_lead
        self._schedule()

    def _schedule(self) -> None:
        now, motion = self._scheduler.now, self.motion
        times = [motion.end, self.drive.settled]
        tail = self.path.tail
        if tail is not None and not (tail.stops or tail.finished or self.stops):
            if not tail.released:
                times.append(ceil(self._release * S))
            times.append(ceil(self._commit * S))
        self._find_refreshed()
        if self._refreshed is not None:
            times.append(ceil(motion.time_at(self._refreshed.end) * S))
        legs = self.path.legs
        stop = next((leg for leg in legs if leg.committed or leg.move.zone.fine), None)
        if stop is not None:
            times.append(ceil(motion.time_at(stop.end) * S))
        times += [ceil(when * S) for when in self._events.times(motion)]
        ahead = [time for time in times if time > now]
        due = min(ahead, default=None)
        if self._timer is not None:
            if self._timer.active and self._timer.time == due:
                return
            self._timer.cancel()
        self._timer = None if due is None else self._scheduler.at(due, self.settle)

    def refresh(self, value: float) -> None:
        """SpeedRefresh, 0 to 1, of the leg under way, or of all from now on; 0 always lasts."""
        self.drive.refresh, self._refreshed = value, None
        self.drive.forget()

    def _find_refreshed(self) -> None:
        """The leg under way, or the first one to come, is the one that SpeedRefresh holds for."""
        drive = self.drive
        if (
            self._refreshed is None
            and 0.0 < drive.refresh < 1.0
            and not drive.settings.refresh_lasts
        ):
            place = drive.place()
            self._refreshed = next((leg for leg in self.path.legs if leg.end > place), None)

    def _end_refresh(self) -> None:
        """The leg that SpeedRefresh holds for is over: as fast as programmed again."""
        leg = self._refreshed
        if leg is None or not (leg.finished or leg.cleared or leg.end <= self.drive.place() + 1e-6):
            return
        self._refreshed, self.drive.refresh = None, 1.0
        self.drive.forget()
        if not self.stops:
            self.replan()

    def settle(self) -> None:
        """Bring everything up to the present time."""
        now = self._scheduler.now / S
        changed = False
        tail = self.path.tail
        if tail is not None and not (tail.stops or tail.finished or self.stops):
            # In ns, as these times were asked for: now in s may lie a bit before them.
            if not tail.released and self._scheduler.now >= ceil(self._release * S):
                tail.released = changed = True
            if self._scheduler.now >= ceil(self._commit * S):
                tail.committed = tail.late = tail.released = changed = True
                self._warn_of_corner(tail.move)
        self._events.fire(self.motion, now)
        self._end_refresh()
        # Off the path nothing is reached, wherever on it the robot should be.
        if self.motion.coast is None and (done := self.path.passed(self.drive.place())):
            self.finish(done, cleared=False)
            changed = True
        standing = self.is_standing
        if standing != self._was_standing:
            self._was_standing = standing
            self._report(standing)
            if standing:
                self._punctuality.report(self._log, self._name)
            changed = True
        if self.is_settled and self._settled is not self.motion:
            self._settled = self.motion
            changed = True
        self._schedule()
        if changed:
            self.changed.notify()
        if standing and self.at_rest is not None:
            act, self.at_rest = self.at_rest, None
            act()
