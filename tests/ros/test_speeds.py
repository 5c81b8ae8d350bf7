"""The speed of several groups on the virtual clock: of all that move, or of none."""

import asyncio

import pytest
from linked import cell

from rapidgen.client.errors import NotReady, RequestRefused, RobotTimeout
from rapidgen.ros.goals import FinalStatus
from rapidgen.ros.robot_link import set_speeds


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

    with cell("irb14000") as c:
        ends = c.run(tried(c))
        assert [end.status for end in ends] == [FinalStatus.SUCCEEDED] * 2


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

    with cell("irb14000") as c:
        ends = c.run(tried(c))
        assert [end.status for end in ends] == [FinalStatus.SUCCEEDED] * 2


def test_none_is_changed_where_one_has_no_link():
    async def tried(c):
        goals = await c.moving(0)
        c.running[1].cancel()
        await asyncio.gather(c.running[1], return_exceptions=True)
        with pytest.raises(NotReady, match="no link"):
            await set_speeds(c.links, 50)
        assert round(c.links[0].speed) == 100
        return await asyncio.gather(*goals)

    with cell("irb14000") as c:
        c.run(tried(c))
