"""Measurement of a stop from the joint messages of a second connection, and its prediction."""

import asyncio
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass

from rapidgen.client import AsyncRobot
from rapidgen.client.core.state import State
from rapidgen.config.model import Joint

STILL = {"revolute": 0.0002, "prismatic": 0.0001}
"""rad and m by which a joint at rest may appear to move."""
_BEFORE = 0.8
"""s before the cause in which the speed is measured, as the median between two messages."""


@dataclass(frozen=True, slots=True)
class StopFigures:
    """A measured stop: s after its cause, way of the joint since then, speed before.

    Way and speed are rad or m. Times are accurate to one joint message, `period` s.
    """

    seconds: float
    way: float
    speed: float
    period: float

    def limits(self, joint: Joint, reaction: float) -> tuple[float, float]:
        """Return the largest time, s, and way for which the stop counts as prompt.

        The controller may react for `reaction` s at the speed before, then it brakes at the
        configured acceleration; two joint messages are the uncertainty.
        """
        late = reaction + 2 * self.period
        seconds, way = self.predicted(joint)
        return late + seconds, late * self.speed + way

    def predicted(self, joint: Joint) -> tuple[float, float]:
        """Return time, s, and way of braking alone, at the configured acceleration."""
        rate = joint.stop_deceleration or joint.acceleration
        return self.speed / rate, self.speed**2 / (2 * rate)


class Watcher:
    """States of a robot since the start, from a connection that only reads."""

    def __init__(self, robot: AsyncRobot) -> None:
        self.robot = robot
        self.states: list[State] = [robot.state]

    async def follow(self) -> None:
        """Collect states until it is cancelled."""
        async for state in self.robot.states():
            self.states.append(state)

    @property
    def joints(self) -> tuple[float, ...]:
        """Newest joints, rad and m."""
        return self.states[-1].joints

    def measured(self, since: float, index: int, kind: str) -> StopFigures:
        """Measure a stop of one joint that was caused at `since`, s of the client's clock."""
        times = [state.time for state in self.states]
        values = [state.joints[index] for state in self.states]
        last, still = values[-1], STILL[kind]
        moving = [t for t, v in zip(times, values, strict=True) if abs(v - last) > still]
        # At rest with the first message that has the last position.
        rest = next((t for t in times if not moving or t > moving[-1]), times[-1])
        origin = _at(since, times, values)
        before = [
            abs(b - a) / (u - t)
            for t, u, a, b in zip(times, times[1:], values, values[1:], strict=False)
            if u > t and since - _BEFORE <= t <= since
        ]
        period = (times[-1] - times[0]) / max(1, len(times) - 1)
        speed = sorted(before)[len(before) // 2] if before else 0.0
        return StopFigures(max(0.0, rest - since), abs(last - origin), speed, period)

    def most_moved(self, since: float) -> float:
        """Return the largest change of any joint since a time, rad or m."""
        late = [state.joints for state in self.states if state.time >= since]
        if not late:
            return 0.0
        return max((max(c) - min(c) for c in zip(*late, strict=True)), default=0.0)


def _at(time: float, times: Sequence[float], values: Sequence[float]) -> float:
    """Return the value at a time, between two messages by interpolation."""
    for (t, a), (u, b) in zip(
        zip(times, values, strict=True), zip(times[1:], values[1:], strict=True), strict=False
    ):
        if t <= time < u:
            return a + (b - a) * (time - t) / (u - t)
    return values[0] if time < times[0] else values[-1]


@asynccontextmanager
async def watching(robot: AsyncRobot) -> AsyncIterator[Watcher]:
    """Connect a robot that only reads, and collect its states while the block runs."""
    async with robot:
        watcher = Watcher(robot)
        following = asyncio.ensure_future(watcher.follow())
        try:
            yield watcher
        finally:
            following.cancel()
            with suppress(asyncio.CancelledError):
                await following
