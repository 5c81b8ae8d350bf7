"""A session of streaming without externally guided motion, over the client's stream.

It has the surface of an EGM session: its frames are made here, one for each point of the stream,
from what the partner would answer. The controller executes a point about 0.6 s after it was sent.
Therefore the TCP is not faster than 50 mm/s: a point that would be farther gets more time.
"""

import asyncio
import math
from collections import deque
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager

from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.client.aio import AsyncRobot
from rapidgen.client.egm import AsyncEgmSession, EgmState, Envelope, TcpLimits
from rapidgen.client.egm.exchange import Order, PartnerExchange
from rapidgen.config.model import GroupConfig
from rapidgen.ros.twist_motion import TwistMotion
from rapidgen.wire.egm.codec import encode_robot
from rapidgen.wire.egm.values import AxisPositions, RobotMessage

CAP = 0.05
"""m/s of the TCP."""
_PLANNED = 0.8 * CAP
"""m/s between points: a controller that catches up on a delay is up to 15 % faster for a moment."""
_PARTS = 5
"""Frames for one point: braking and limits are finer than the distance of points."""
_SEEN = 1e-3
"""rad or m by which a joint must move so that its delay is measured."""
_RELEASE = (6, 15)


@asynccontextmanager
async def delayed(
    robot: AsyncRobot, group: GroupConfig, speed: float, measured: Callable[[float], None]
) -> "AsyncIterator[AsyncEgmSession]":
    """Stream points to the robot while the block lasts; then it stands.

    `speed` is the share of the speeds; `measured` is called with the delay, s, of each motion.
    Raises RobotError.
    """
    limits = Envelope.of(group, speed, tcp=TcpLimits(speed=CAP))
    feed = _Feed(robot, group, limits, measured)
    now = asyncio.get_running_loop().time
    session = AsyncEgmSession(limits, "joints", feed.connect, now)
    feeding = asyncio.ensure_future(feed.run())
    try:
        await session.wait_until_guided()
        yield session
    finally:
        await feed.end()
        # Its errors say why the robot does not follow.
        await feeding


class _Feed:
    """Points of a stream from the answers to made frames."""

    port = 0

    def __init__(
        self,
        robot: AsyncRobot,
        group: GroupConfig,
        limits: Envelope,
        measured: Callable[[float], None],
    ) -> None:
        self._robot, self._measured = robot, measured
        self._map = JointMap.of(group)
        self._tcp = TwistMotion(group, limits).tcp
        self._exchange = PartnerExchange(self._map, limits, math.inf)
        self._period = robot.group.policy.min_segment
        self._ending = False
        self._sequence = 0
        self._sent: deque[tuple[float, tuple[float, ...]]] = deque(maxlen=50)

    def connect(
        self, receive: Callable[[EgmState], None], receive_end: Callable[[], None]
    ) -> "_Feed":
        """Return this as the loop of a session."""
        self._receive, self._receive_end = receive, receive_end
        return self

    def post(self, order: Order) -> None:
        """Execute an order with the next point."""
        self._exchange.execute(order)

    def wait_started(self) -> None:
        """Begin at once."""

    def close(self) -> None:
        """End with the block."""

    async def end(self) -> None:
        """Send no more points; the robot slows down first."""
        self._ending = True

    async def run(self) -> None:
        """Send points until the end. Raises RobotError."""
        loop = asyncio.get_running_loop()
        stream, time = self._robot.stream(fallback=False), 0.0
        last = self._robot.state.joints
        try:
            await stream.append([time], [last])
            due = loop.time()
            while True:
                joints = self._advance()
                distance = math.dist(self._tcp(joints)[0], self._tcp(last)[0])
                span = max(self._period, distance / _PLANNED)
                time += span
                await stream.append([time], [joints])
                self._measure(loop.time(), joints, last)
                self._receive(self._exchange.state())
                if self._ending and joints == last:
                    break
                last, due = joints, due + span
                await asyncio.sleep(max(0.0, due - loop.time()))
            await stream.end()
            await stream.result()
        finally:
            self._receive_end()
            # After a fault the robot must not execute what is left.
            await stream.cancel()

    def _advance(self) -> tuple[float, ...]:
        """Return the joints of the next point."""
        now = asyncio.get_running_loop().time()
        if self._ending:
            self._exchange.target = None
        for _ in range(_PARTS):
            self._sequence += 1
            milliseconds = round(self._sequence * self._period * 1000 / _PARTS)
            axes = self._axes(self._robot.state.joints)
            message = RobotMessage(
                self._sequence, milliseconds, axes, axes, True, "running", True, False
            )
            self._exchange.answer(encode_robot(message, _RELEASE), now)
        assert self._exchange.reference is not None
        return self._exchange.reference.positions

    def _axes(self, joints: Sequence[float]) -> AxisPositions:
        robax, extax = self._map.to_rapid(self._map.to_controller(joints))
        return AxisPositions(robax, tuple(value for value in extax if value < ABSENT / 2))

    def _measure(self, now: float, joints: tuple[float, ...], last: tuple[float, ...]) -> None:
        """Compare what the robot has reached with what was sent."""
        here = self._robot.state.joints
        change = [abs(a - b) for a, b in zip(joints, last, strict=True)]
        axis = change.index(max(change))
        self._sent.append((now, joints))
        if change[axis] < _SEEN:
            return
        for (_, before), (at, after) in zip(self._sent, list(self._sent)[1:], strict=False):
            low, high = sorted((before[axis], after[axis]))
            if high - low >= _SEEN and low <= here[axis] <= high:
                self._measured(now - at)
                return
