"""Links of a controller on the virtual clock, and what they publish."""

import asyncio
from contextlib import contextmanager
from functools import partial

from driven import booted, robot_of
from ready import goal

from rapidgen.client.address import Address
from rapidgen.ros.goal_execution import ActiveGoal, Policy
from rapidgen.ros.robot_link import RobotLink
from rapidgen.testing.asyncio_clock import VirtualLoop


class Record:
    """A `LinkListener` that keeps what is published."""

    def __init__(self):
        self.states, self.health, self.notes, self.reports = [], [], [], []

    def joint_states(self, states):
        self.states.append(states)

    def status(self, status, health):
        self.health.append(health)

    def note(self, text):
        self.notes.append(text)

    def streaming(self, report):
        self.reports.append(report)


def _address(ports):
    return Address("controller", ports.motion, ports.state, ports.control)


class Cell:
    """The motion groups of one controller, each with its link and its records."""

    def __init__(self, controller, config, loop):
        self.controller, self.loop = controller, loop
        self.config, self.groups = config, config.groups
        self.robots = [None for _ in config.groups]
        self.records = [Record() for _ in config.groups]
        self.links = [
            RobotLink(partial(self._make, number), Policy(), loop.time, received)
            for number, received in enumerate(self.records)
        ]

    def _make(self, number):
        group = self.groups[number]
        made = robot_of(self.config, group, feedback=True, address=_address(group.ports))
        self.robots[number] = made
        return made

    def run(self, coroutine):
        return self.loop.run_until_complete(coroutine)

    async def up(self):
        self.running = [asyncio.ensure_future(link.run()) for link in self.links]
        await self.linked(True)

    async def linked(self, is_up):
        while any(link.is_up != is_up for link in self.links):
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
            requested = goal(here, [value + 0.1 for value in here], seconds=4.0, names=names)
            following = self.links[number].follow(requested, lambda _: None, ActiveGoal())
            goals.append(asyncio.ensure_future(following))
        for number in numbers:
            await self.robots[number].wait_until(lambda state: state.is_moving, 10.0)
        return goals

    @property
    def speeds(self):
        return [round(link.speed) for link in self.links]


@contextmanager
def cell(name):
    controller, config = booted(name)
    loop = VirtualLoop(controller)
    with controller:
        made = Cell(controller, config, loop)
        made.run(made.up())
        try:
            yield made
        finally:
            made.run(made.down())
            made.run(loop.shutdown_asyncgens())
            loop.close()
