"""A path in time: the motion under way, how it is planned anew, braked and watched."""

from collections.abc import Callable, Sequence
from math import inf

from rapidgen.axes.kinematics import Posture
from rapidgen.config.model import Joint
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion.braking import AxisMotion, coast, moment_before, path_factor
from rapidgen.motion.motion import Motion
from rapidgen.motion.path import Path
from rapidgen.motion.pieces import Piece
from rapidgen.motion.settings import MotionSettings
from rapidgen.motion.speed_profile import Plan, SpeedProfile, brake, plan

MANUAL_REDUCED = 0.25
"""m/s of the TCP in manual mode with reduced speed."""
_STANDING = 1e-6
"""Path speed that counts as none: times are whole nanoseconds."""
_NOT_PLANNED: tuple[int, tuple[Piece, ...], Plan | None] = (-1, (), None)


class Drive:
    """Runs one path. What is on the path, and when to stop, is the business of `execution.py`."""

    __slots__ = (
        "_history",
        "_placed",
        "_plan",
        "_planned",
        "_scheduler",
        "motion",
        "observers",
        "override",
        "ramp",
        "reduced",
        "refresh",
        "refreshed",
        "settings",
        "tcp_limit",
    )

    def __init__(self, scheduler: Scheduler, settings: MotionSettings, start: Posture) -> None:
        self._scheduler = scheduler
        self.settings = settings
        self.override = 1.0
        """Of the controller, 0 to 1."""
        self.refresh = 1.0
        """Of the program (SpeedRefresh), 0 to 1."""
        self.refreshed = True
        """True if `refresh` applies to the newest move."""
        self.tcp_limit = inf
        """m/s of the TCP (SpeedLimCheckPoint)."""
        self.reduced = False
        """Manual mode with reduced speed."""
        self.ramp = 0.0
        """s in which acceleration builds up; may change at a standstill only."""
        self.observers: list[Callable[[Motion], None]] = []
        """Called with every new motion (the recorder)."""
        self.motion = Motion(scheduler.now, scheduler.now, SpeedProfile(0.0), (), start)
        self._placed = self.motion, self.motion.since, 0.0
        """The motion and the time of the place asked for last, and that place."""
        self._history: list[Motion] = []
        self._planned = _NOT_PLANNED
        """The plan found last: appending asks for it twice."""
        self._plan: Plan | None = None
        """The plan of the motion under way, if its law is that of a plan."""

    # -- where it is ------------------------------------------------------------------------

    def measured(self) -> Posture:
        """Axis values now, behind the commanded ones by the servo lag."""
        now = self._scheduler.now
        if not self._history:
            return self.motion.posture(now)
        then = now - round(self.settings.servo_lag * S)
        for motion in reversed((*self._history, self.motion)):
            if motion.since <= then:
                return motion.posture(then)
        return self._history[0].posture(then)

    def commanded(self) -> Posture:
        """Axis values now, as planned."""
        return self.motion.posture(self._scheduler.now)

    def reference(self) -> Posture:
        """Axis values now, as planned or as a guiding partner sends them."""
        return self.motion.reference(self._scheduler.now)

    def place(self) -> float:
        """Where the robot is on its path."""
        now, motion = self._scheduler.now, self.motion
        if self._placed[0] is not motion or self._placed[1] != now:
            self._placed = motion, now, motion.place(now)
        return self._placed[2]

    def behind(self) -> float:
        """Where on its path the mean begins that the robot follows."""
        return self.motion.behind(self._scheduler.now)

    def planned(self) -> tuple[float, float]:
        """Place and speed from which on the path may still be planned anew."""
        return self.motion.planned(self._scheduler.now)

    @property
    def goes_on(self) -> bool:
        """Whether the law has way left: it moves, or is about to after a moment's rest."""
        return self.planned()[0] < self.motion.law.place

    @property
    def settled(self) -> int:
        """When it stands and the settling time is over too, scheduler ns."""
        return self.motion.end + round(self.settings.settle * S)

    # -- planning ---------------------------------------------------------------------------

    def forget(self) -> None:
        """Speeds have changed: what was planned ahead does not hold."""
        self._planned = _NOT_PLANNED

    def plan(self, pieces: tuple[Piece, ...]) -> Plan | None:
        """The plan over pieces from the present state on; None: it is too fast for them."""
        now = self._scheduler.now
        planned_at, planned, result = self._planned
        if planned is pieces and planned_at == now:
            return result
        result = None
        if self._plan is not None:
            elapsed = (now - self.motion.start) / S
            result = self._plan.extended(pieces, elapsed, self.ramp, self._settings())
        if result is None:
            place, speed = self.planned()
            remaining = 0.0
            if speed < _STANDING:
                speed, remaining = 0.0, self._rest(place)
            result = plan(pieces, place, speed, *self._settings(), remaining)
        self._planned = now, pieces, result
        return result

    def _rest(self, place: float) -> float:
        """s until the robot stands, too, where the law does: nothing is planned before that."""
        now, motion = self._scheduler.now, self.motion
        if now >= motion.end or self.behind() >= place:
            return 0.0
        stood = (now - motion.start) / S - motion.law.time_at(place)
        return max(0.0, self.ramp - stood)

    def _settings(self) -> tuple[float, float, float]:
        """Cap, limit of the TCP and pause of a plan."""
        limit = min(self.tcp_limit, MANUAL_REDUCED if self.reduced else inf)
        cap = self.override * (self.refresh if self.refreshed else 1.0)
        return cap, limit, self.ramp

    def replan(self, path: Path) -> bool:
        """Go from the present state to the end of the path; False: it is there."""
        path.prune(self.behind())
        place, _ = self.planned()
        if not path.pieces or path.end <= place:
            return False
        result = self.plan(path.pieces)
        if result is None:
            # It brakes to a stop that cannot be taken back; then on from there.
            stop = self.motion.law
            onwards = plan(path.pieces, stop.place, 0.0, *self._settings())
            assert onwards is not None  # from rest every limit can be kept
            self.put(stop.then(onwards.law, self.ramp), self.motion.start, path)
            return True
        if result.continues:
            self.put(result.law, self.motion.start, path)
        else:
            self.run(result.law, path)
            result.law = self.motion.law  # with what is before it
        self._plan = result
        return True

    def brake(self, path: Path, joints: Sequence[Joint], *, quick: bool) -> None:
        """Slow down to a standstill on the path."""
        path.prune(self.behind())
        factor = path_factor(joints, self.settings.quick_factor) if quick else 1.0
        self.run(brake(path.pieces, *self.planned(), factor), path)

    def coast(self, path: Path, joints: Sequence[Joint]) -> None:
        """Stop each axis by its brake; the profile is the stop that the path should have had."""
        now, factor = self._scheduler.now, self.settings.quick_factor
        before = self.motion.posture(max(self.motion.since, moment_before(now)))
        stop = coast(now, self.commanded(), before, joints, factor)
        path.prune(self.behind())
        law = brake(path.pieces, *self.planned(), path_factor(joints, factor))
        self.run(law, path, stop)

    def run(self, law: SpeedProfile, path: Path, stop: AxisMotion | None = None) -> None:
        """Follow a profile from now on; the mean still contains the one before."""
        now = self._scheduler.now
        before = self.motion
        if now < before.end:
            law = law.after(before.law, (now - before.start) / S, self.ramp)
        self.put(law, now, path, None if stop is None else stop.posture(stop.end), stop)

    def put(
        self,
        law: SpeedProfile,
        start: int,
        path: Path,
        remaining: Posture | None = None,
        stop: AxisMotion | None = None,
    ) -> None:
        """A law that began at `start` and ends at a place of the path, unless at `remaining`."""
        if remaining is None:
            remaining = path.target if law.place >= path.end else path.at(law.place)
        now = self._scheduler.now
        self.forget()
        self._plan = None
        if self.settings.servo_lag > 0:
            old = now - round(self.settings.servo_lag * S)
            later = [m for m in self._history if m.since > old]
            recent = self._history[-len(later) - 1 :] if self._history else []
            self._history = [*recent, self.motion]
        legs = tuple(path.legs)
        self.motion = Motion(now, start, law, path.pieces, remaining, legs, self.ramp, stop)
        for observer in self.observers:
            observer(self.motion)
