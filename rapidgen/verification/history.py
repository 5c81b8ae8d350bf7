"""One random history of clients, network and controller.

A history is a sequence of random steps with an invariant that is checked in each. A step sends a
trajectory, a stream or a command, and disturbs it at a random time or at a random statement of the
driver. After the steps the history checks that the driver serves a well-behaved client.

Rules:

- All random choices come from the history's generator, so that a seed replays it.
- Each step has a seed of its own. Removing earlier steps does not change its choices, and the
  minimizer relies on that.
- A step judges the robot's recorded track, the messages and the orders of the motion task; it never
  reads variables of the driver.
- A step that leaves a client silently sets `left_silently`, because the driver may serve the next
  client late.
"""

import random
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TextIO

from rapidgen.verification import messages
from rapidgen.verification.instruction_hooks import Order, watched_orders
from rapidgen.verification.messages import RawReason
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import SETTLED, Point, Position, distance, off
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.schedule import Disturbance, TaskSchedule
from rapidgen.verification.stream import BEGIN, END, NONE, Streamer
from rapidgen.verification.testbench import Bench

PREEMPTIONS = 4
"""Preemptions in a step, under priorities."""
CORNER = 0.08
"""rad or m by which zones and a change of trajectory may leave the straight path."""


class History:
    """One random history of clients and controller."""

    def __init__(
        self,
        bench: Bench,
        schedule: TaskSchedule,
        silence: float,
        trace: TextIO | None,
    ) -> None:
        self.bench = bench
        self.schedule = schedule
        self.step = Disturbance("", "", None, "")
        self.chance = random.Random(f"{schedule.seed} walk")
        self.silence = silence
        self.trace = trace
        self.plan: list[str] = []
        self.streams = 0
        self.link: RawLink | None = None
        self.left_silently = False
        """A client left without closing: the driver may serve the next one late."""
        self.orders: list[Order] = []

    def go(self) -> None:
        """Run some steps, then check that the driver serves a new client."""
        self.orders = watched_orders(self.bench)
        self.bench.run(1)
        rules = self.bench.setting.faults.network
        if rules:
            self._say(f"the network: {rules[0].do} {rules[0].direction}")
        for step in self.schedule.steps:
            self.step = step
            # The random choices of a step do not depend on the steps before it.
            self.chance = random.Random(f"{step.seed} step")
            self._preempt()
            STEPS[step.name](self)
        self.good_client()

    def _preempt(self) -> None:
        """Schedule preemptions at accesses to a PERS, most of them soon."""
        if self.schedule.order == "priorities":
            chance = random.Random(f"{self.schedule.seed} {self.step.seed} preemptions")
            scheduler = self.bench.controller.scheduler
            scheduler.preempt(round(10 ** chance.uniform(0, 3.3)) for _ in range(PREEMPTIONS))

    def _say(self, text: str) -> None:
        self.plan.append(f"{self.bench.now:12.6f} {text}")
        if self.trace is not None:
            self.trace.write(f"{self.plan[-1]}\n")

    # -- parts of steps --------------------------------------------------------------------------

    def _connect(self) -> RawLink:
        if self.link is None or self.link.lost:
            self._say("connect")
            self.link = self.bench.motion()
        return self.link

    def _points(self, count: int) -> list[Point]:
        shortest = max(0.15, 1.05 * self.bench.config.trajectory.min_segment)
        size = self.chance.choice((0.06, 0.06, 0.01, 0.003))
        duration = self.chance.uniform(shortest, shortest + 0.25)
        return self.bench.wave(count, duration=duration, size=size)

    def _send(self, link: RawLink, data: bytes) -> None:
        """Send in pieces of random size, with pauses now and then."""
        while data:
            size = self.chance.choice((len(data), self.chance.randrange(1, 200)))
            link.send(data[:size])
            data = data[size:]
            if data and self.chance.random() < 0.2:
                self.bench.run(self.chance.uniform(0, 0.05))

    def _disturbed(
        self, link: RawLink, data: bytes, act: Callable[[], None], what: str, *, after: bool
    ) -> None:
        """Send `data` and call `act` at a random time or driver statement.

        `after`: not before all of `data` is sent.
        """
        if self.step.where is None:
            wait = self.chance.choice(
                (0.0, self.chance.uniform(0, 0.15), self.chance.uniform(0, 2))
            )
            self._say(f"... and {what} {wait * 1000:.1f} ms later")
            self._send(link, data)
            self.bench.run(wait)
            act()
            return
        came: list[bool] = []
        sent = not after

        def once() -> None:
            if not came:
                came.append(True)
                act()

        def reached() -> None:
            if sent:
                once()

        self._at_a_statement(reached, what)
        self._send(link, data)
        sent = True
        self.bench.controller.run_until(lambda: bool(came), timeout=3)
        once()

    def _at_a_statement(self, act: Callable[[], None], what: str) -> None:
        """Call `act` before a random statement of the driver, which may then last."""
        assert self.step.where is not None
        place, count, busy = self.step.where.place, self.step.where.count, self.step.where.busy
        where = f"{place.module}:{place.line} in {place.task}"
        self._say(f"... and {what} at {where}, pass {count}, {busy} ms there")

        def reached() -> None:
            act()
            for _ in range(busy):
                # The task continues slowly while the others go on.
                self.bench.controller.rapid_tasks[place.task].charge(1_000_000)

        self.bench.controller.before_statement(place.task, place.module, place.line, count, reached)

    def _comes_to(self, place: Position, seconds: float) -> None:
        """Wait until the robot is at `place` for a second, or for `seconds`.

        If no command is pending, nothing can interrupt the motion.
        """
        end = self.bench.now + seconds
        self.bench.run(1)
        while self.bench.now < end:
            if self.bench.standing and distance(self.bench.position, place) < SETTLED:
                self.bench.run(1)
                return
            self.bench.run(0.1)

    def _on_the_way(self, path: Sequence[Position], since: float) -> None:
        self.bench.followed(path, since=since, corner=CORNER)

    # -- steps ----------------------------------------------------------------------------------

    def whole(self) -> None:
        """Send an undisturbed trajectory."""
        link = self._connect()
        points = self._points(self.chance.randrange(3, 15))
        self._say(f"send {len(points)} points")
        if self.step.where is not None:
            self._at_a_statement(lambda: None, "a pause")
        self._executed_or_refused(link, points)

    def over_capacity(self) -> None:
        """Send more points than the driver's capacity, where it has one."""
        capacity = self.bench.config.trajectory.capacity
        if capacity > 300:
            return
        link = self._connect()
        points = self.bench.wave(capacity + self.chance.randrange(1, 4), duration=0.15, size=0.02)
        self._say(f"send {len(points)} points, {capacity} is the capacity")
        self._executed_or_refused(link, points)

    def _executed_or_refused(self, link: RawLink, points: Sequence[Point]) -> None:
        """Check that the robot reaches the last point, or does not move."""
        start, since = self.bench.position, self.bench.now
        self._send(link, self.bench.download(points))
        self._comes_to(points[-1][0], 15 + 1.5 * sum(d for _, d in points[1:]))
        end = self.bench.position
        moved = any(distance(p, start) > 1e-3 for t, p in self.bench.track if t >= since)
        if moved and distance(end, points[-1][0]) > 1e-3:
            raise CheckFailed(
                f"a trajectory of {len(points)} points that nothing disturbed ended "
                f"{distance(end, points[-1][0]):.3f} rad before its last point"
            )
        self._on_the_way([start, *(p for p, _ in points)], since)

    def stopped(self) -> None:
        """Send STOP at any moment, sometimes with a new trajectory in one packet."""
        link = self._connect()
        points = self._points(self.chance.randrange(4, 15))
        self._say(f"send {len(points)} points")
        start, since = self.bench.position, self.bench.now
        before = len(link.frames)
        stop = STOP + STOP if self.step.act == "two STOP" else STOP
        sent: list[float] = []

        def stop_now() -> None:
            link.at_once(stop)
            sent.append(self.bench.now)

        self._disturbed(link, self.bench.download(points), stop_now, self.step.act, after=True)
        self.bench.until(lambda: len(link.frames) > before or link.lost, 5, "STOP is answered")
        answered = self.bench.now
        self.bench.wait_until_standing(10)
        self._on_the_way([start, *(p for p, _ in points)], since)
        assert_no_move_follows(self.orders, sent[0], answered)
        self.bench.assert_at_rest(self.chance.uniform(0.5, 2), "it was stopped")

    def interrupted(self) -> None:
        """Stop the program or the motors, and start it again."""
        link = self._connect()
        if self.left_silently:
            # The driver can only know that data it reads after Start was sent after Start.
            self.bench.run(self.silence)
            self.left_silently = False
        points = self._points(self.chance.randrange(4, 15))
        action = self.step.act
        self._say(f"send {len(points)} points")
        first, *more = action.split()
        perform = self.bench.controller.perform
        data = self.bench.download(points)
        self._disturbed(link, data, lambda: perform(first), action, after=False)
        for part in more:
            self.bench.run(0.3)
            perform(part)
        self.bench.run(0.3)
        self.bench.wait_until_standing(10)
        self.bench.run(self.chance.uniform(0, 1))
        self._say("... and start again")
        self.bench.start_again()
        self.bench.assert_at_rest(
            3, f"the program was started after {action}; no client asked for motion"
        )

    def superseded(self) -> None:
        """Send a new trajectory while the old one is executed."""
        link = self._connect()
        first = self._points(self.chance.randrange(6, 15))
        self._say(f"send {len(first)} points and, on the way, others")
        start, since = self.bench.position, self.bench.now
        self._send(link, self.bench.download(first))
        self.bench.run(self.chance.uniform(0, 1.5))
        current = self.bench.position
        second = [(current, 10.0), *self._points(4)[1:]]
        self._send(link, self.bench.download(second))
        self._comes_to(second[-1][0], 25)
        end = self.bench.position
        on_first = _nearest(end, [start, *(p for p, _ in first)])
        if distance(end, second[-1][0]) > 1e-3 and on_first > CORNER:
            raise CheckFailed(
                "the robot ended neither on the old trajectory nor at the new one's end"
            )
        paths = list(pairwise([start, *(p for p, _ in first), current, *(p for p, _ in second)]))
        for when, seen in self.bench.track:
            if when >= since and all(off(seen, a, b) > 2 * CORNER for a, b in paths):
                raise CheckFailed(f"at {when:.3f} s the robot was on the way to nowhere")

    def vanishes(self) -> None:
        """Leave with or without closing, or in the middle of a download."""
        link = self._connect()
        how = self.chance.choice(("silent", "fin", "reset", "download"))
        self.left_silently |= how == "silent"
        self._say(f"the client is gone: {how}")
        if how == "download":
            data = self.bench.download(self._points(6))
            link.send(data[: self.chance.randrange(1, len(data) - 68)])
        if how in ("fin", "download"):
            link.close()
        elif how == "reset":
            link.close(abort=True)
        self.link = None
        self.bench.assert_at_rest(self.chance.uniform(0, 1), f"its client is gone ({how})")

    def streamed(self) -> None:
        """Stream with random pauses, and end normally or by STOP on the control port."""
        link = self._connect()
        self.streams += 1
        stream = Streamer(self.bench, link, number=self.streams)
        points = [(p, max(d, 0.15)) for p, d in self._points(self.chance.randrange(10, 60))]
        points[0] = (points[0][0], 0.2)
        ending = self.chance.choice(("whole", "whole", "STOP", "pause", "hole", "leaves", "stop"))
        self._say(f"stream {len(points)} points, {ending}")
        start, since, accepted = self.bench.position, self.bench.now, 0
        cut = len(points) if ending in ("whole", "pause") else self.chance.randrange(5, len(points))
        while stream.sent < cut and not link.lost:
            size = min(self.chance.randrange(1, 15), cut - stream.sent, max(1, stream.room))
            flags = BEGIN if not stream.sent else NONE
            flags |= END if stream.sent + size == len(points) else NONE
            reply = stream.put(points[stream.sent : stream.sent + size], flags)
            if not isinstance(reply, messages.RawPointsAccepted):
                break
            accepted = reply.accepted
            self.bench.run(self.chance.choice((0.0, 0.05, self.chance.uniform(0, 3))))
        last = points[max(0, accepted - 1)][0]
        self._end_stream(ending, stream, points[cut : cut + 3], last)
        self.bench.wait_until_standing(30)
        self._on_the_way([start, *(p for p, _ in points[: stream.sent])], since)
        end = self.bench.position
        if ending in ("whole", "pause", "hole") and accepted and distance(end, last) > 1e-3:
            raise CheckFailed(
                f"{accepted} points of a stream were accepted, the robot ended "
                f"{distance(end, last):.4f} rad off the last of them"
            )
        self.bench.assert_at_rest(self.chance.uniform(0.3, 2), f"its stream is over: {ending}")

    def _end_stream(
        self, ending: str, stream: Streamer, more: Sequence[Point], last: Position
    ) -> None:
        """End a stream, or disturb it before the `last` accepted point."""
        control = self.bench.control()
        if ending == "STOP":
            control.stop(5)
        elif ending == "pause":
            self.bench.run(self.chance.uniform(0, 1.5))
            if isinstance(control.ask(messages.RawPause(1), 5), messages.RawAcknowledged):
                self.bench.wait_until_standing(5)
                self.bench.assert_at_rest(self.chance.uniform(0, 2), "it is paused")
                control.ask(messages.RawPause(0), 5)
            self._comes_to(last, 12)
        elif ending == "hole" and more:
            stream.say(stream.frame(more, NONE, first=stream.sent + 1))
            stream.refused(RawReason.SEQUENCE_GAP, "a batch after a hole")
            self._comes_to(last, 12)
        elif ending == "leaves":
            stream.link.close(abort=self.chance.random() < 0.5)
            self.link = None
        elif ending == "stop":
            self.bench.controller.perform("stop")
            self.bench.wait_until_standing(10)
            self.bench.run(self.chance.uniform(0, 1))
            self.bench.controller.perform("start")
            self.bench.assert_at_rest(3, "the program was stopped in a stream and started again")
        else:
            self._comes_to(last, 12)
        control.close()

    def controlled(self) -> None:
        """Download, and send STOP on the control port at any time or statement."""
        link, control = self._connect(), self.bench.control()
        points = self._points(self.chance.randrange(4, 15))
        self._say(f"send {len(points)} points")
        start, since = self.bench.position, self.bench.now
        data = self.bench.download(points)
        self._disturbed(link, data, lambda: control.at_once(STOP), self.step.act, after=False)
        self.bench.until(lambda: bool(control.frames) or control.lost, 5, "STOP is answered")
        # STOP does not apply to data that arrives completely after it. Replies to STOPs of earlier
        # steps do not count for this one.
        link.read()
        link.stop(5)
        self.bench.wait_until_standing(10)
        self._on_the_way([start, *(p for p, _ in points)], since)
        self.bench.assert_at_rest(self.chance.uniform(0.5, 2), "it was stopped")
        control.close()

    def good_client(self) -> None:
        """Check that the driver serves a new client, which moves the robot."""
        old, self.link = self.link, None
        if old is not None and not old.lost and self.chance.random() < 0.5:
            old.close()
        self.bench.run(min(1, self.silence))
        link = self._connect()
        for attempt in range(2):
            points = self.bench.wave(4, duration=0.4)
            self._say("a good client's trajectory")
            link.send(self.bench.download(points))
            self._comes_to(points[-1][0], 12 + self.silence)
            if distance(self.bench.position, points[-1][0]) < 1e-3:
                return
            if attempt == 0:
                # The previous step may have blocked the client; now nothing does.
                self.bench.wait_until_standing(30)
        raise CheckFailed("in the end a good client's trajectory does not move the robot")


def assert_no_move_follows(orders: Sequence[Order], sent: float, answered: float) -> None:
    """Check that a free robot gets no move after a stop for a STOP."""
    stops = [
        order.time
        for order in orders
        if order.instruction == "StopMove" and sent <= order.time <= answered
    ]
    over = stops[-1] if stops else answered
    for order in orders:
        if order.time > over and order.free and order.instruction != "StopMove":
            raise CheckFailed(
                f"STOP was sent at {sent:.4f} s, the robot was stopped at {over:.4f} s, set "
                f"free, and got {order.instruction} of the old trajectory at {order.time:.4f} s"
            )


def _nearest(seen: Position, path: Sequence[Position]) -> float:
    return min(off(seen, a, b) for a, b in pairwise(path))


STEPS: dict[str, Callable[[History], None]] = {
    "whole": History.whole,
    "stopped": History.stopped,
    "over-capacity": History.over_capacity,
    "interrupted": History.interrupted,
    "superseded": History.superseded,
    "vanishes": History.vanishes,
    "streamed": History.streamed,
    "controlled": History.controlled,
}
"""The steps of a history, by name."""
PAIRED = ("streamed", "controlled")
"""Steps of a paired client, for drivers that stream."""
