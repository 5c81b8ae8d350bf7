"""Scheduler: time, events and the one CPU of a controller.

All of one controller runs on one thread: events are plain callbacks that never wait, processes
(`process.py`) are greenlets. `now` is integer nanoseconds. On the virtual clock time passes only by
the costs of processes and by jumps to the next event. On the real clock the same accounting is
limited to the wall clock, and the operating system's sockets are served between slices.

Rules:

1. A running process counts down `b`, the nanoseconds until the next event, the end of its slice or
   of the run. `now` is therefore `deadline - b` while it runs, and compiled code needs one
   subtraction and one test for clock, preemption, traps and stops.
2. Events at the same time run in the order of their creation. Events before the end of a process's
   slice run first; an event at exactly that time runs after the process, however the time was
   divided (`_fire_before`). Runs are reproducible only with this order.
3. A change (`WaitSet.notify`) makes waiting processes ready in the order in which they began to
   wait; a process evaluates its condition again when it runs.
4. Random numbers come from seeded sources, one for each purpose, so that an additional draw for one
   purpose does not change the others.
5. Other threads may only call `post`.
"""

import heapq
import os
import random
import select
import selectors
import time
from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from itertools import count
from typing import Literal, Protocol, TypeAlias, get_args

import greenlet

# -- Scheduler -------------------------------------------------------------------------------------


ClockKind: TypeAlias = Literal["virtual", "real"]
Schedule: TypeAlias = Literal["round-robin", "random", "priorities"]
"""In turns; any, for any time; or the highest of random priorities, which `preempt` takes away (S.
Burckhardt et al., "A randomized scheduler with probabilistic guarantees", ASPLOS 2010)."""
AdvanceEnd: TypeAlias = Literal["time", "stop", "idle", "paused"]

MS = 1_000_000
S = 1_000_000_000
QUANTUM = 2 * MS
# Single-digit integers of CPython have the fastest subtraction. The limit is low enough to detect
# endless recursion before it costs much memory.
LONGEST_WAIT = 20 * MS
"""A process that waits for the CPU longer than that comes first, whatever its priority."""
_LARGEST_BUDGET = 50 * MS
_SERVE_EVERY = 2 * MS
CLOSED = "the controller is closed: make another one"
_LAG = 200 * MS
"""Real ns by which a busy machine may lag and then catch up."""


class Timer:
    """An event on the heap; `cancel()` removes its effect."""

    __slots__ = ("function", "time")

    def __init__(self, time: int, function: Callable[[], None]) -> None:
        self.time = time
        self.function: Callable[[], None] | None = function

    @property
    def active(self) -> bool:
        """True if the event is still to come."""
        return self.function is not None

    def cancel(self) -> None:
        """Cancel the event, if it has not happened yet."""
        self.function = None


class WaitSet:
    """A changing object; `notify()` wakes all that wait for it.

    They then evaluate their conditions again.
    """

    __slots__ = ("w",)

    def __init__(self) -> None:
        # Compiled code tests this list after every store into a PERS.
        self.w: list[Callable[[], None]] = []

    def add(self, wake: Callable[[], None]) -> None:
        """Call `wake` at every change until it is removed."""
        self.w.append(wake)

    def remove(self, wake: Callable[[], None]) -> None:
        """Undo one `add`."""
        self.w.remove(wake)

    def notify(self) -> None:
        """Wake all, in the order in which they were added."""
        for wake in tuple(self.w):
            wake()

    def __bool__(self) -> bool:
        return bool(self.w)


class Runnable(Protocol):
    """A process as the scheduler dispatches it, see `process.py`."""

    b: int
    """Nanoseconds until the next event that may concern it."""
    slice_end: int
    body: greenlet.greenlet | None

    def abandon(self) -> None:
        """End the greenlet at its current place."""


class Scheduler:
    """Clock, event heap, CPU, random sources of one controller.

    It belongs to the thread that steps it.
    """

    def __init__(
        self,
        *,
        clock: ClockKind = "virtual",
        seed: int = 0,
        speed: float = 1.0,
        quantum: int = QUANTUM,
        schedule: Schedule = "round-robin",
    ) -> None:
        for option, given, kind in (("clock", clock, ClockKind), ("schedule", schedule, Schedule)):
            if given not in get_args(kind):
                raise ValueError(f"{option}={given!r} is none of {', '.join(get_args(kind))}")
        self.clock: ClockKind = clock
        self.speed = speed
        self.quantum = quantum
        self.schedule: Schedule = schedule
        self.draw_from(seed)
        self.ready: deque[Runnable] = deque()
        self.running: Runnable | None = None
        self.deadline = 0
        self.switches = 0
        self.idle = 0
        """Nanoseconds in which no process was ready."""
        self._now = 0
        self._heap: list[tuple[int, int, Timer]] = []
        self._looks: list[tuple[int, int, Callable[[], None]]] = []
        self._serial = count()
        self._front: Runnable | None = None
        self._until: int | None = None
        self._stop: Callable[[], bool] | None = None
        self._stopping = False
        self._hub: greenlet.greenlet | None = None
        self._paused = False
        self._posted: deque[Callable[[], None]] = deque()
        self._selector: selectors.BaseSelector | None = None
        self._pipe: tuple[int, int] | None = None
        self._served_at = 0
        self.is_closed = False
        self._origin = (0, time.monotonic_ns())

    def draw_from(self, seed: int) -> None:
        """Use another seed from now on, for copies of one machine."""
        self.seed = seed
        self.rng = random.Random(f"{seed}")
        self._order = random.Random(f"{seed} schedule")
        self._priorities: dict[Runnable, float] = {}
        self._waiting: dict[Runnable, int] = {}
        self._preemptions: list[int] = []
        self._accesses = 0

    # -- time and events -------------------------------------------------------------------------

    @property
    def now(self) -> int:
        """Nanoseconds since the creation of the controller."""
        process = self.running
        return self._now if process is None else self.deadline - process.b

    def at(self, time_ns: int, function: Callable[[], None]) -> Timer:
        """Call `function` at a time, or at the next turn if it has passed."""
        timer = Timer(time_ns, function)
        heapq.heappush(self._heap, (time_ns, next(self._serial), timer))
        process = self.running
        if process is not None and time_ns < self.deadline:
            process.b -= self.deadline - time_ns
            self.deadline = time_ns
        return timer

    def after(self, delay_ns: int, function: Callable[[], None]) -> Timer:
        """Call `function` after a delay."""
        return self.at(self.now + max(0, delay_ns), function)

    def call_later_readonly(self, delay_ns: int, function: Callable[[], None]) -> None:
        """Call `function`, which only reads, after a delay, without effects.

        On the virtual clock it is called when time next stops at that time or later: it shortens no
        slice, keeps no controller busy and triggers no additional check of `stop()`.
        """
        time = self.now + max(0, delay_ns)
        if self.clock == "real":
            self.at(time, function)
        else:
            heapq.heappush(self._looks, (time, next(self._serial), function))

    def _look(self, end: int) -> None:
        """Call reading functions that are due up to `end`."""
        while self._looks and self._looks[0][0] <= end:
            when, _, function = heapq.heappop(self._looks)
            if when > self._now:
                self._now = when
            function()

    @property
    def paused(self) -> bool:
        """True if no time passes until `resume()`."""
        return self._paused

    def pause(self, process: Runnable | None = None) -> None:
        """Let no time pass; posted functions still run.

        `process` is the caller, between two of its statements: it continues at `resume()`.
        """
        self._paused = True
        if process is not None:
            self._front = process
            self.suspend(process)

    def resume(self) -> None:
        """Let time pass again from the pause."""
        if self._paused:
            self._paused = False
            self.rebase()
            self._wake_up()

    def post(self, function: Callable[[], None]) -> None:
        """Run `function` on the scheduler's thread.

        It is the only method for other threads.
        """
        self._posted.append(function)
        self._wake_up()

    def _wake_up(self) -> None:
        if self._pipe is not None:
            # A full pipe wakes the scheduler already.
            with suppress(BlockingIOError):
                os.write(self._pipe[1], b"\0")

    @property
    def selector(self) -> selectors.BaseSelector:
        """Selector for sockets of the operating system.

        The `data` of a key is called with the event mask.
        """
        if self._selector is None:
            self._selector = selectors.DefaultSelector()
            if self.clock == "real":
                self._pipe = os.pipe()
                os.set_blocking(self._pipe[0], False)
                os.set_blocking(self._pipe[1], False)
                self._selector.register(self._pipe[0], selectors.EVENT_READ, self._drain)
        return self._selector

    def close(self) -> None:
        """Release the operating system's handles; time no longer passes."""
        self.is_closed = True
        if self._selector is not None:
            self._selector.close()
            self._selector = None
        if self._pipe is not None:
            for handle in self._pipe:
                os.close(handle)
            self._pipe = None

    def close_processes(self, processes: Iterable[Runnable]) -> None:
        """Remove ready processes and end their greenlets.

        It runs on their thread. The garbage collector cannot see into a suspended greenlet: one
        that stays suspended keeps all objects of its frames.
        """
        self.ready.clear()
        self._front = None
        self._heap.clear()
        self._looks.clear()
        for process in processes:
            process.abandon()

    @property
    def preempted(self) -> Runnable | None:
        """The process that continues first when time passes again."""
        return self._front

    def next_event(self) -> int | None:
        """Return the time of the next active event."""
        heap = self._heap
        while heap and heap[0][2].function is None:
            heapq.heappop(heap)
        return heap[0][0] if heap else None

    # -- the loop --------------------------------------------------------------------------------

    def advance(
        self, until: int | None = None, stop: Callable[[], bool] | None = None
    ) -> AdvanceEnd:
        """Let time pass.

        Returns "time" at `until`, "stop" if `stop()` returned True after an event, "idle" if no
        process is ready and no event follows, "paused" while it is paused (both on the virtual
        clock only). RuntimeError: time passes already, or ended with `close`.
        """
        if self.is_closed:
            raise RuntimeError(CLOSED)
        if self._hub is not None:
            raise RuntimeError(
                "time passes already, and is let pass once more by what is called meanwhile: "
                "a condition only looks"
            )
        self._hub = greenlet.getcurrent()
        self._until, self._stop, self._stopping = until, stop, False
        try:
            return self._advance_real() if self.clock == "real" else self._advance_virtual()
        finally:
            # When a thread ends, a thread's greenlet that is still referenced is searched among all
            # objects. If it is not found because they are being collected at this time, greenlet
            # 3.5 frees it while it is in use, and the process crashes.
            self._hub = None

    def _advance_virtual(self) -> AdvanceEnd:
        until, stop = self._until, self._stop
        while True:
            if self._posted:
                self.run_posted()
            if self._stopping or (stop is not None and stop()):
                return "stop"
            if self._paused:
                return "paused"
            if until is not None and self._now >= until:
                return "time"
            if self._front is not None or self.ready:
                self._dispatch()
                continue
            ahead = self.next_event()
            if ahead is None or (until is not None and ahead > until):
                if until is None:
                    return "idle"
                self.idle += until - self._now
                self._look(until)
                self._now = until
                return "time"
            self.idle += max(0, ahead - self._now)
            self._fire(ahead, one=True)

    def _advance_real(self) -> AdvanceEnd:
        until, stop = self._until, self._stop
        # Created before posted functions run: later posts write to its pipe.
        _ = self.selector
        while True:
            if self._posted:
                if not self._paused:
                    self._come_up(self._wall())
                self.run_posted()
            if self._stopping or (stop is not None and stop()):
                return "stop"
            if self._paused:
                self._wait_paused()
                continue
            if until is not None and self._now >= until:
                return "time"
            busy = self._front is not None or bool(self.ready)
            wall = self._lagging_wall(self._now if busy else self.next_event())
            if busy and self._now <= wall + MS:
                if wall - self._served_at > _SERVE_EVERY:
                    self._serve(0.0)
                self._dispatch()
                continue
            ahead = self._now if busy else self.next_event()
            target = until if ahead is None else ahead if until is None else min(ahead, until)
            if target is None or wall < target:
                real = S * self.speed
                timeout = (target - wall) / real if target is not None and real else None
                self._serve(timeout)
                continue
            if wall - self._served_at > _SERVE_EVERY:
                self._serve(0.0)
            if not busy:
                self._fire(max(target, self._now))

    def _wait_paused(self) -> None:
        """Wait for posted functions; the sockets wait meanwhile."""
        assert self._pipe is not None
        if not self._posted:
            select.select([self._pipe[0]], [], [])
            self._drain(selectors.EVENT_READ)

    def _wall(self) -> int:
        start, wall = self._origin
        return start + int((time.monotonic_ns() - wall) * self.speed)

    def _lagging_wall(self, due: int | None) -> int:
        """Return the real clock minus lost time.

        A delay of this machine makes virtual time later, not faster: a burst would be time that the
        outside never had.
        """
        wall = self._wall()
        latest = wall if due is None else due + int(_LAG * self.speed)
        if wall <= latest:
            return wall
        self._origin = (latest, time.monotonic_ns())
        self._served_at -= wall - latest
        return latest

    def pace(self, speed: float) -> None:
        """Set virtual seconds per second; 0 stops time. Real clock only."""
        wall = self._wall()
        self._origin = (wall, time.monotonic_ns())
        self.speed = speed

    def rebase(self) -> None:
        """Tie the real clock to `now`, so that a pause is not caught up."""
        self._origin = (self._now, time.monotonic_ns())

    def _serve(self, timeout: float | None) -> None:
        events = self.selector.select(timeout)
        self._served_at = self._wall()
        if events:
            self._come_up(self._served_at)
            for key, mask in events:
                key.data(mask)

    def _come_up(self, wall: int) -> None:
        """Set `now` to the time of external input, not of the last event."""
        if self._front is None and not self.ready:
            ahead = self.next_event()
            self._now = max(self._now, wall if ahead is None else min(wall, ahead))

    def _drain(self, _mask: int) -> None:
        assert self._pipe is not None
        while True:
            try:
                if len(os.read(self._pipe[0], 4096)) < 4096:
                    return
            except BlockingIOError:
                return

    def run_posted(self) -> None:
        """Run functions posted by other threads, without time passing."""
        for _ in range(len(self._posted)):
            self._posted.popleft()()

    def _fire(self, end: int, *, one: bool = False) -> None:
        heap, stop = self._heap, self._stop
        while heap and heap[0][0] <= end:
            when, _, timer = heapq.heappop(heap)
            function = timer.function
            if function is None:
                continue
            timer.function = None
            if self._looks:
                self._look(when)
            if when > self._now:
                self._now = when
            function()
            if stop is not None and stop():
                self._stopping = True
            if one:
                return
        if self._looks:
            self._look(end)
        if end > self._now:
            self._now = end

    def _fire_before(self, end: int) -> None:
        """Run events before a process reaches `end`.

        Events at `end` itself follow after the process, however the time was divided.
        """
        if self._heap and self._heap[0][0] < end:
            self._fire(end - 1)
        if self._looks:
            self._look(end)
        if end > self._now:
            self._now = end

    def _dispatch(self) -> None:
        process = self._front
        if process is not None:
            self._front = None
        else:
            if len(self.ready) > 1:
                self._choose()
            process = self.ready.popleft()
            if self._waiting:
                self._waiting.pop(process, None)
            process.slice_end = self._now + self._slice()
        self.switches += 1
        self.grant(process)
        body = process.body
        assert body is not None
        if not body:  # not started: when it ends, the loop continues here
            body.parent = greenlet.getcurrent()
        try:
            body.switch()
        except greenlet.error as fault:
            self.running, self._front = None, process
            raise RuntimeError(
                "time is let pass by another thread than before: one thread steps a controller"
            ) from fault
        if self.running is process:  # the body returned while charged for
            self._now = self.deadline - process.b
            self.running = None

    def _choose(self) -> None:
        """Put the next process first."""
        if self.schedule == "random":
            self.ready.rotate(-self._order.randrange(len(self.ready)))
        elif self.schedule == "priorities":
            now, ready = self._now, self.ready
            for process in ready:
                if process not in self._priorities:
                    self._priorities[process] = self._order.random()
                self._waiting.setdefault(process, now)
            first = min(ready, key=self._waiting.__getitem__)
            if now - self._waiting[first] <= LONGEST_WAIT:
                first = max(ready, key=self._priorities.__getitem__)
            ready.rotate(-ready.index(first))

    def preempt(self, accesses: Iterable[int]) -> None:
        """Make the running process last at the n-th access to a PERS.

        It applies to schedules with priorities.
        """
        self._preemptions = sorted((self._accesses + n for n in accesses), reverse=True)

    def switches_here(self) -> bool:
        """Return True if a schedule switches at this access to a PERS."""
        if self.schedule == "priorities":
            self._accesses += 1
            due = self._preemptions
            if not due or self._accesses < due[-1] or self.running is None:
                return False
            due.pop()
            self._priorities[self.running] = min(self._priorities.values(), default=0.0) - 1
            return bool(self.ready)
        return self.schedule == "random" and bool(self.ready) and self._order.random() < 0.5

    def _slice(self) -> int:
        if self.schedule == "random":
            return self._order.randrange(1, self.quantum)
        return self.quantum

    # -- called by processes ---------------------------------------------------------------------

    def grant(self, process: Runnable) -> None:
        """Give the CPU to `process`.

        Its budget lasts until the next event that may concern it.
        """
        now = self._now
        limit = now + _LARGEST_BUDGET
        ahead = self.next_event()
        if ahead is not None and ahead < limit:
            limit = ahead
        if self._until is not None and self._until < limit:
            limit = self._until
        if (self.ready or self.clock == "real") and process.slice_end < limit:
            limit = process.slice_end
        self.deadline = limit
        process.b = limit - now
        self.running = process

    def catch_up(self, process: Runnable) -> bool:
        """Account for time spent by `process`; return True if it must yield."""
        end = self.deadline - process.b
        self.running = None
        self._fire_before(end)
        if self._posted:
            self.run_posted()
        over = end > process.slice_end
        if over and self.ready:
            self.ready.append(process)
            return True
        if over:
            process.slice_end = end + self._slice()
        until, stop = self._until, self._stop
        if (
            self._stopping
            or self._paused
            or (until is not None and end >= until)
            or (over and (self.clock == "real" or (stop is not None and stop())))
        ):
            self._front = process
            return True
        return False

    def suspend(self, process: Runnable) -> None:
        """Switch to the loop; return when `process` is dispatched again."""
        if self.running is process:
            end = self.deadline - process.b
            self.running = None
            self._fire_before(end)
        assert self._hub is not None
        self._hub.switch()


# -- Date and time ---------------------------------------------------------------------------------
#
# On the real clock date and time are the machine's. On the virtual clock they are a fixed day plus
# the virtual time, so that all runs are equal.


FIRST_DAY = datetime(2026, 1, 1, 8)


def date_time(scheduler: Scheduler) -> datetime:
    """Return the controller's date and time."""
    if scheduler.clock == "real":
        return datetime.now()
    return FIRST_DAY + timedelta(microseconds=scheduler.now // 1000)


# -- Synchronisation points ------------------------------------------------------------------------
#
# Where tasks of one controller wait for each other.


@dataclass(slots=True)
class SyncPoint:
    """Tasks at a synchronisation point."""

    members: frozenset[str]
    arrived: set[str] = field(default_factory=set)
    changed: WaitSet = field(default_factory=WaitSet)
    complete: bool = False


@dataclass(slots=True)
class SyncMoveGroup:
    """Tasks at a move of one \\ID, and their move times (s)."""

    times: dict[str, float] = field(default_factory=dict)
    changed: WaitSet = field(default_factory=WaitSet)
    longest: float | None = None
    """Known when all have come."""


class SyncPoints:
    """Synchronisation points of one controller with waiting tasks."""

    def __init__(self) -> None:
        self.points: dict[tuple[object, frozenset[str]], SyncPoint] = {}
        """WaitSyncTask and its like: by point and members."""
        self.moves: dict[tuple[frozenset[str], float], SyncMoveGroup] = {}
        """Moves of one \\ID: by partners and \\ID."""
        self.any_task = False
        """True in an inferred cell: unknown tasks are ignored."""
        self._together: dict[frozenset[str], int] = {}
        self._ended: list[tuple[int, int, frozenset[str]]] = []

    def begin_together(self, members: frozenset[str], now: int) -> None:
        """Note that tasks move synchronously from now (ns) on; harmless when they do already."""
        self._together.setdefault(members, now)

    def end_together(self, members: frozenset[str], now: int) -> None:
        """Note the end of synchronous movement; harmless without one."""
        since = self._together.pop(members, None)
        if since is not None:
            self._ended.append((since, now, members))

    def together(self, now: int) -> list[tuple[int, int, frozenset[str]]]:
        """Return intervals (ns) of synchronous movement so far, with the names of the tasks."""
        return [*self._ended, *((since, now, names) for names, since in self._together.items())]
