"""Schedules x stops x faults: does what was executed stay a prefix of what was asked?

One seed decides everything: which task runs when, what the clients do and when, and what
happens to the controller. The oracle looks at the robot alone, so it judges any driver that
speaks simple_message on the group's motion port:

- a robot that stands moves only after a whole trajectory has been sent to it;
- while it moves, it is on the way through the points of the newest trajectories;
- a trajectory that nothing disturbed is executed to its last point, or not at all;
- afterwards, whatever happened, a good client moves the robot.
"""

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import TextIO

from rapidgen.config.model import MotionGroup, RobotConfig, TrajectoryPolicy
from rapidgen.proving.bench import FAILURES, Bench, Setting, distance, off
from rapidgen.proving.link import STOP, Link, Point, Position
from rapidgen.proving.model import Broken, Finding
from rapidgen.system.model import System
from rapidgen.virtual.tracing import Trace

_CORNER = 0.08
"""rad or m by which zones and a change of trajectory may lead off the straight way."""


@dataclass(frozen=True, slots=True)
class Explored:
    """What one seed did; `finding` when it broke the invariant."""

    seed: int
    plan: str
    finding: Finding | None


def explore(
    group: MotionGroup,
    system: System,
    seed: int,
    *,
    capacity: int = 1000,
    takes_over: bool = True,
    silence: float = 4.0,
    trace: TextIO | None = None,
) -> Explored:
    """Run one seed; the same one gives the same history.

    `silence`: s after which a new client may expect to be served. `trace` gets a line for each
    statement of RAPID and for each step of the history.
    """
    config = RobotConfig(
        name=system.name,
        path=Path("-"),
        controller="virtual",
        robotware=system.robotware,
        groups=(group,),
        trajectory=replace(TrajectoryPolicy(), capacity=capacity),
    )
    setting = Setting(seed=seed, random_schedule=True, switch_at_pers=seed % 2 == 0)
    bench = Bench(config, system, replace(setting, coverage=trace is not None))
    if trace is not None:
        Trace(bench.controller, trace)
    walk = _Walk(bench, random.Random(f"{seed} walk"), takes_over, silence, trace)
    try:
        walk.go()
        bench.healthy()
    except FAILURES as error:
        found = Finding(seed, str(error), "\n".join(walk.plan), bench.log())
        return Explored(seed, "\n".join(walk.plan), found)
    finally:
        bench.close()
    return Explored(seed, "\n".join(walk.plan), None)


class _Walk:
    """One random history of clients and controller."""

    def __init__(
        self,
        bench: Bench,
        chance: random.Random,
        takes_over: bool,
        silence: float,
        trace: TextIO | None = None,
    ) -> None:
        self.bench = bench
        self.chance = chance
        self.takes_over = takes_over
        self.silence = silence
        self.trace = trace
        self.plan: list[str] = []
        self.link: Link | None = None

    def go(self) -> None:
        """Some steps, then the question whether a good client is served."""
        self.bench.run(1)
        for _ in range(self.chance.randrange(2, 6)):
            step = self.chance.choice(
                (
                    self._whole,
                    self._whole,
                    self._stopped,
                    self._stopped,
                    self._over_capacity,
                    self._interrupted,
                    self._superseded,
                    self._vanishes,
                )
            )
            step()
        self._good_client()

    def _say(self, text: str) -> None:
        self.plan.append(f"{self.bench.now:12.6f} {text}")
        if self.trace is not None:
            self.trace.write(f"{self.plan[-1]}\n")

    # -- steps ----------------------------------------------------------------------------------

    def _connect(self) -> Link:
        if self.link is None or self.link.lost:
            self._say("connect")
            self.link = self.bench.motion()
        return self.link

    def _points(self, count: int) -> list[Point]:
        return self.bench.wave(count, duration=self.chance.uniform(0.15, 0.4))

    def _send(self, link: Link, data: bytes) -> None:
        """In pieces of any size, with pauses now and then."""
        while data:
            size = self.chance.choice((len(data), self.chance.randrange(1, 200)))
            link.send(data[:size])
            data = data[size:]
            if data and self.chance.random() < 0.2:
                self.bench.run(self.chance.uniform(0, 0.05))

    def _whole(self) -> None:
        link = self._connect()
        points = self._points(self.chance.randrange(3, 15))
        self._say(f"send {len(points)} points")
        self._executed_or_refused(link, points)

    def _over_capacity(self) -> None:
        capacity = self.bench.config.trajectory.capacity
        if capacity > 300:
            return
        link = self._connect()
        points = self.bench.wave(capacity + self.chance.randrange(1, 4), duration=0.15, size=0.02)
        self._say(f"send {len(points)} points, {capacity} is the capacity")
        self._executed_or_refused(link, points)

    def _executed_or_refused(self, link: Link, points: Sequence[Point]) -> None:
        """Nothing disturbs it: it reaches its last point, or nothing moves."""
        start, since = self.bench.position, self.bench.now
        self._send(link, self.bench.download(points))
        self.bench.run(15 + 1.5 * sum(d for _, d in points[1:]))
        end = self.bench.position
        moved = any(distance(p, start) > 1e-3 for t, p in self.bench.track if t >= since)
        if moved and distance(end, points[-1][0]) > 1e-3:
            raise Broken(
                f"a trajectory of {len(points)} points that nothing disturbed ended "
                f"{distance(end, points[-1][0]):.3f} rad before its last point"
            )
        self.bench.followed([start, *(p for p, _ in points)], since=since, corner=_CORNER)

    def _stopped(self) -> None:
        link = self._connect()
        points = self._points(self.chance.randrange(4, 15))
        wait = self.chance.choice((0.0, self.chance.uniform(0, 0.1), self.chance.uniform(0, 2)))
        self._say(f"send {len(points)} points, STOP {wait * 1000:.1f} ms later")
        start, since = self.bench.position, self.bench.now
        before = len(link.frames)
        self._send(link, self.bench.download(points))
        self.bench.run(wait)
        link.send(STOP)
        self.bench.until(lambda: len(link.frames) > before or link.lost, 5, "STOP is answered")
        self.bench.wait_until_standing(10)
        self.bench.followed([start, *(p for p, _ in points)], since=since, corner=_CORNER)
        self.bench.stays(self.chance.uniform(0.5, 2), "it was stopped")

    def _interrupted(self) -> None:
        link = self._connect()
        points = self._points(self.chance.randrange(4, 15))
        wait = self.chance.choice((self.chance.uniform(0, 0.15), self.chance.uniform(0, 2)))
        action = self.chance.choice(("stop", "stop pp-to-main", "e-stop", "motors-off"))
        self._say(f"send {len(points)} points, {action} {wait * 1000:.1f} ms later, start again")
        self._send(link, self.bench.download(points))
        self.bench.run(wait)
        for part in action.split():
            self.bench.controller.perform(part)
            self.bench.run(0.3)
        self.bench.wait_until_standing(10)
        self.bench.run(self.chance.uniform(0, 1))
        for again in ("reset-e-stop", "motors-on", "start"):
            self.bench.controller.perform(again)
        self.bench.stays(3, f"the program was started after {action}; nobody asked for motion")

    def _superseded(self) -> None:
        link = self._connect()
        first = self._points(self.chance.randrange(6, 15))
        self._say(f"send {len(first)} points and, on the way, others")
        start, since = self.bench.position, self.bench.now
        self._send(link, self.bench.download(first))
        self.bench.run(self.chance.uniform(0, 1.5))
        here = self.bench.position
        second = [(here, 10.0), *self._points(4)[1:]]
        self._send(link, self.bench.download(second))
        self.bench.run(25)
        end = self.bench.position
        on_first = _nearest(end, [start, *(p for p, _ in first)])
        if distance(end, second[-1][0]) > 1e-3 and on_first > _CORNER:
            raise Broken("the robot ended neither on the old trajectory nor at the new one's end")
        for when, seen in self.bench.track:
            ways = [start, *(p for p, _ in first), here, *(p for p, _ in second)]
            if when >= since and _nearest(seen, ways) > 2 * _CORNER:
                raise Broken(f"at {when:.3f} s the robot was on the way to nowhere")

    def _vanishes(self) -> None:
        link = self._connect()
        how = self.chance.choice(("silent", "fin", "reset", "download"))
        self._say(f"the client is gone: {how}")
        if how == "download":
            data = self.bench.download(self._points(6))
            link.send(data[: self.chance.randrange(1, len(data) - 68)])
        if how in ("fin", "download"):
            link.close()
        elif how == "reset":
            link.close(abort=True)
        self.link = None
        self.bench.stays(self.chance.uniform(0, 1), f"its client is gone ({how})")

    def _good_client(self) -> None:
        """Whatever happened: a client that comes now is served, and moves the robot."""
        old, self.link = self.link, None
        if old is not None and not old.lost and self.chance.random() < 0.5:
            old.close()
        self.bench.run(self.silence)
        link = self._connect()
        self.bench.run(self.silence)
        for attempt in range(2):
            points = self._points(4)
            self._say("a good client's trajectory")
            link.send(self.bench.download(points))
            self.bench.run(12)
            if distance(self.bench.position, points[-1][0]) < 1e-3:
                return
            if attempt == 0:
                # What was under way may have been in its way; now nothing is.
                self.bench.wait_until_standing(30)
        raise Broken("in the end a good client's trajectory does not move the robot")


def _nearest(seen: Position, path: Sequence[Position]) -> float:
    return min(off(seen, a, b) for a, b in pairwise(path))
