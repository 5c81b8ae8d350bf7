"""A link on the virtual clock: it says why it waits, comes back, and tells nothing twice."""

import asyncio
from itertools import pairwise

import pytest
from linked import cell
from ready import goal

from rapidgen.client.errors import NotReady
from rapidgen.ros.goal_execution import ActiveGoal
from rapidgen.ros.goals import Code, FinalStatus


def test_a_link_comes_back_and_executes_the_first_goal():
    """A ROS-Industrial node loses the first goal after a restart."""

    async def tried(c):
        (first,) = await c.moving(0)
        await asyncio.sleep(0.5)
        states_before = len(c.records[0].states)
        c.controller.power_loss()
        finished = await first
        await c.linked(False)
        lost, refused = len(c.records[0].states), await c.links[0].follow(*_goal(c))
        await asyncio.sleep(0.5)
        assert len(c.records[0].states) == lost >= states_before > 5
        assert c.records[0].health[-1].message.startswith("no link to the robot: ")
        await c.linked(True)
        c.controller.set_motors(True)
        c.controller.start_program()
        await c.robots[0].wait_until(lambda state: state.status.motion_possible == 1, 30.0)
        return finished, refused, await c.links[0].follow(*_goal(c))

    with cell("irb120") as c:
        finished, refused, done = c.run(tried(c))
        assert (finished.status, finished.code) == (
            FinalStatus.ABORTED,
            Code.PATH_TOLERANCE_VIOLATED,
        )
        assert (refused.status, refused.code) == (FinalStatus.ABORTED, Code.INVALID_GOAL)
        assert refused.text.startswith("no link to the robot: ")
        assert done.status is FinalStatus.SUCCEEDED, done.text
        stamps = [states.stamp for states in c.records[0].states]
        assert all(before < after for before, after in pairwise(stamps))
        assert sum("connected to" in note for note in c.records[0].notes) == 2


def _goal(c):
    here = c.robots[0].state.joints
    requested = goal(here, [value + 0.05 for value in here])
    return requested, lambda _: None, ActiveGoal()


def test_resume_only_where_it_still_stands():
    async def tried(c):
        (under,) = await c.moving(0)
        await c.links[0].pause()
        stood = c.links[0]._paused_at
        assert stood == c.robots[0].state.joints
        # As if it had been jogged: no link to a simulator can do that in a pause.
        c.links[0]._paused_at = tuple(value + 0.1 for value in stood)
        with pytest.raises(NotReady, match=r"moved by 0\.1000"):
            await c.links[0].resume()
        await asyncio.sleep(1.0)
        assert c.robots[0].state.joints == pytest.approx(stood, abs=1e-6)
        c.links[0]._paused_at = stood
        await c.links[0].resume()
        return await under

    with cell("irb120") as c:
        assert c.run(tried(c)).status is FinalStatus.SUCCEEDED


def test_stop_ends_a_goal_that_was_accepted_before_it():
    """The goal is executed by another thread of the node, which may come to it later."""
    with cell("irb120") as c:
        (link,), (robot,) = c.links, c.robots
        accepted = ActiveGoal(link.stops)
        c.run(link.stop())
        here = robot.state.joints
        requested = goal(here, [value + 0.1 for value in here], names=robot.group.names)
        outcome = c.run(link.follow(requested, lambda _: None, accepted))
        assert outcome.status is FinalStatus.ABORTED
        assert "before it started" in outcome.text
        later = c.run(link.follow(requested, lambda _: None, ActiveGoal(link.stops)))
        assert later.status is FinalStatus.SUCCEEDED
