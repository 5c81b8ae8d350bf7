"""A goal executor and its robot on the virtual clock.

Goals are awaited; the controller runs on the same clock.
"""

from contextlib import contextmanager

import numpy as np
from driven import booted, robot_of

from rapidgen.ros.goal_execution import ActiveGoal, GoalExecutor, Policy
from rapidgen.ros.goals import Goal, Point
from rapidgen.testing.asyncio_clock import VirtualLoop

NAMES = tuple(f"joint_{n}" for n in range(1, 7))


class Station:
    """One robot with its executor, and the published data."""

    def __init__(self, controller, robot, loop, policy):
        self.controller, self.robot, self.loop = controller, robot, loop
        self.notes, self.fed = [], []
        self.follower = GoalExecutor(robot, policy, loop.time, self.notes.append)

    def follow(self, goal, under=None):
        return self.follower.follow(goal, self.fed.append, under or ActiveGoal())

    def run(self, coroutine):
        return self.loop.run_until_complete(coroutine)

    def outcome(self, goal):
        return self.run(self.follow(goal))

    @property
    def _group(self):
        return next(iter(self.controller.motion.groups.values()))

    def slow_down(self, override):
        """As on the pendant: this client does not know of it."""
        self._group.override = override

    @property
    def joints(self):
        return np.array(self._group.positions()[:6])

    @property
    def stands(self):
        return self._group.is_standing


@contextmanager
def station(policy=None, name="irb120", **options):
    controller, config = booted(name, **options)
    loop = VirtualLoop(controller)
    with controller:
        robot = robot_of(config, feedback=True)
        loop.run_until_complete(robot.connect())
        try:
            yield Station(controller, robot, loop, policy or Policy())
        finally:
            loop.run_until_complete(robot.close())
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.close()


def goal(*rows, seconds=1.0, names=NAMES, **report):
    """Points `seconds` apart, the first where the robot stands; a number is all six joints."""
    points = [
        Point(n * seconds, [row] * len(names) if np.isscalar(row) else list(row))
        for n, row in enumerate(rows)
    ]
    return Goal(names, points, **report)
