"""The speed of several groups on the virtual clock: of all that move, or of none."""

import asyncio
from contextlib import contextmanager

import pytest
from driven import booted, robot_of
from ready import goal

from rapidgen.client.address import Address
from rapidgen.client.errors import NotReady, RequestRefused, RobotTimeout
from rapidgen.ros.following import Policy, UnderWay
from rapidgen.ros.goals import Ending
from rapidgen.ros.keeping import RobotLink, set_speeds
from rapidgen.testing.asyncio_clock import VirtualLoop


class Quiet:
    """A `Public` that publishes nothing."""

    def joint_states(self, states):
        pass

    def status(self, status, health):
        pass

    def note(self, text):
        pass


def _address(ports):
    return Address("controller", ports.motion, ports.state, ports.control)


class Cell:
    """Two arms of one controller, each with its link."""

    def __init__(self, controller, config, loop):
        self.controller, self.loop = controller, loop
        self.groups = config.groups
        self.robots = [
            robot_of(config, group, feedback=True, address=_address(group.ports))
            for group in config.groups
        ]
        self.links = [
            RobotLink(lambda robot=robot: robot, Policy(), loop.time, Quiet())
            for robot in self.robots
        ]

    async def up(self):
        self.running = [asyncio.ensure_future(link.run()) for link in self.links]
        while not all(link.is_up for link in self.links):
            await asyncio.sleep(0.1)

    async def down(self):
        for running in self.running:
            running.cancel()
        await asyncio.gather(*self.running, return_exceptions=True)

    async def moving(self, *numbers):
        """Goals of 4 s; back when these arms move."""
        goals = []
        for number in numbers:
            names = self.robots[number].group.names
            here = self.robots[number].state.joints
            asked = goal(here, [value + 0.1 for value in here], seconds=4.0, names=names)
            following = self.links[number].follow(asked, lambda _: None, UnderWay())
            goals.append(asyncio.ensure_future(following))
        for number in numbers:
            await self.robots[number].wait_until(lambda state: state.is_moving, 10.0)
        return goals

    @property
    def speeds(self):
        return [round(link.speed) for link in self.links]


@contextmanager
def cell():
    controller, config = booted("irb14000")
    loop = VirtualLoop(controller)
    with controller:
        made = Cell(controller, config, loop)
        loop.run_until_complete(made.up())
        try:
            yield made
        finally:
            loop.run_until_complete(made.down())
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.close()


def test_all_that_move_are_slower_and_one_that_stands_is_no_fault():
    async def tried(c):
        with pytest.raises(RequestRefused, match="no trajectory is under way"):
            await set_speeds(c.links, 50)
        goals = await c.moving(0)
        await set_speeds(c.links, 50)
        assert c.speeds == [50, 100]
        goals += await c.moving(1)
        await set_speeds(c.links, 40)
        assert c.speeds == [40, 40]
        return await asyncio.gather(*goals)

    with cell() as c:
        ends = c.loop.run_until_complete(tried(c))
        assert [end.status for end in ends] == [Ending.SUCCEEDED] * 2


def test_none_is_changed_where_one_refuses():
    async def tried(c):
        goals = await c.moving(0, 1)
        await set_speeds(c.links, 60)

        async def held_up(percent):
            raise RobotTimeout.because("RG603", "no reply")

        c.robots[1].set_speed = held_up
        with pytest.raises(RobotTimeout):
            await set_speeds(c.links, 50)
        assert c.speeds == [60, 60]
        return await asyncio.gather(*goals)

    with cell() as c:
        ends = c.loop.run_until_complete(tried(c))
        assert [end.status for end in ends] == [Ending.SUCCEEDED] * 2


def test_none_is_changed_where_one_has_no_link():
    async def tried(c):
        goals = await c.moving(0)
        c.running[1].cancel()
        await asyncio.gather(c.running[1], return_exceptions=True)
        with pytest.raises(NotReady, match="no link"):
            await set_speeds(c.links, 50)
        assert round(c.links[0].speed) == 100
        return await asyncio.gather(*goals)

    with cell() as c:
        c.loop.run_until_complete(tried(c))
