"""A link whose robot is guided in lock-step with a controller on the virtual clock."""

import asyncio
from contextlib import contextmanager
from functools import partial

import numpy as np
from driven import booted, robot_of
from linked import Record

import rapidgen.client.egm
from rapidgen.axes.mapping import JointMap
from rapidgen.client.address import Address
from rapidgen.client.egm import AsyncEgmSession, Envelope
from rapidgen.client.egm.exchange import PartnerExchange
from rapidgen.ros.goal_execution import ActiveGoal, Policy
from rapidgen.ros.goals import Point
from rapidgen.ros.robot_link import RobotLink
from rapidgen.ros.stream_commands import (
    CommandReader,
    JointCommand,
    StreamSettings,
    TrajectoryCommand,
    TwistCommand,
)
from rapidgen.testing.asyncio_clock import VirtualLoop
from rapidgen.testing.egm import _LockStepLoop, controller_clock

EGM = "robots/examples/irb120_egm-rw6.yaml"
HOME = (0.0, 0.0, 0.0, 0.0, 0.5, 0.0)
AT_REST = 1e-4
"""rad in 0.1 s"""
NAMES = tuple(f"joint_{n}" for n in range(1, 7))


class _Session(AsyncEgmSession):
    """A session without a process."""

    async def __aenter__(self):
        return self

    async def close(self):
        self._loop.close()


class Station:
    """One link, its records, and the commands of a client."""

    def __init__(self, controller, config, loop, **settings):
        self.controller, self.loop, self.group = controller, loop, config.groups[0]
        self.record = Record()
        self.robot = None
        self.references = []
        """Of each state of a session."""

        def make():
            ports = self.group.ports
            address = Address("controller", ports.motion, ports.state, ports.control)
            self.robot = robot_of(config, self.group, feedback=True, address=address)
            return self.robot

        stream = StreamSettings(self.group, CommandReader.of(self.group), **settings)
        self.link = RobotLink(make, Policy(), loop.time, self.record, stream=stream)
        measured = self.link.measured

        def noted(state):
            self.references.append(state.reference)
            measured(state)

        self.link.measured = noted

    def listen(self, config, *, fraction, step, timeout, **_):
        envelope = Envelope.of(self.group, fraction, step)
        exchange = PartnerExchange(JointMap.of(self.group), envelope, timeout)
        connect = partial(_LockStepLoop, self.controller, "ROS_EGM", exchange)
        return _Session(envelope, "joints", connect, controller_clock(self.controller))

    # A client

    def twist(self, *values, frame="base_link", stamp=0.0):
        self.link.command("twist_commands", TwistCommand(stamp, frame, values))

    def positions(self, *values, **given):
        self.link.command("position_commands", JointCommand(values, **given))

    def velocities(self, *values, **given):
        self.link.command("velocity_commands", JointCommand(velocities=values, **given))

    def trajectory(self, *points, names=NAMES, stamp=0.0):
        rows = [Point(*point) for point in points]
        self.link.command("joint_trajectory", TrajectoryCommand(names, rows, stamp))

    async def every(self, period, seconds, send):
        """Send again and again; return the joints that the axes had, one row a period."""
        rows = []
        for _ in range(round(seconds / period)):
            send()
            await asyncio.sleep(period)
            rows.append(self.joints)
        return np.array(rows)

    def goal(self, goal):
        return asyncio.ensure_future(self.link.follow(goal, lambda _: None, ActiveGoal()))

    # What the robot does

    @property
    def joints(self):
        return np.array(self.controller.motion.groups["rob1"].positions()[:6])

    @property
    def streamer(self):
        return self.link._streamer

    @property
    def reports(self):
        return [report for report in self.record.reports if report.code]

    async def open(self):
        """Wait until a session executes commands."""
        while self.streamer._session is None:
            await asyncio.sleep(0.004)

    async def at_rest(self):
        """Wait until the axes stand, apart from the end of the gain; return the joints."""
        before = self.joints
        while True:
            await asyncio.sleep(0.1)
            if np.abs(before - self.joints).max() < AT_REST:
                return before
            before = self.joints


@contextmanager
def station(name=EGM, overrides=None, **settings):
    controller, config = booted(name, overrides=overrides)
    loop = VirtualLoop(controller)
    with controller:
        made = Station(controller, config, loop, **settings)
        original, rapidgen.client.egm.listen_async = rapidgen.client.egm.listen_async, made.listen
        running = loop.create_task(made.link.run())
        try:
            yield made
        finally:
            running.cancel()
            loop.run_until_complete(asyncio.gather(running, return_exceptions=True))
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.close()
            rapidgen.client.egm.listen_async = original


def streamed(use, name=EGM, **settings):
    """Run `use(station)` with a connected link."""
    with station(name, **settings) as made:

        async def main():
            while not made.link.is_up:
                await asyncio.sleep(0.1)
            await use(made)

        made.loop.run_until_complete(main())
