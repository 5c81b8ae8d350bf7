"""Streaming topics on the virtual clock, without ROS: what moves the robot, and what does not."""

import asyncio

import numpy as np
from streamed import streamed

from rapidgen.ros.twist_motion import TwistMotion


def tcp(s):
    return np.array(TwistMotion(s.group, s.streamer._twist.envelope).tcp(s.joints)[0])


def test_twist_moves_the_tcp_and_ends_with_its_messages():
    """The robot stops 0.1 s after the last message (issue text), with what braking takes."""

    async def use(s):
        await s.every(0.02, 1.5, lambda: s.twist(0, 0, -0.02, 0, 0, 0))
        assert s.streamer.is_moving, s.record.reports
        begin, place = s.loop.time(), tcp(s)
        await s.every(0.02, 1.0, lambda: s.twist(0, 0, -0.02, 0, 0, 0))
        passed, moved = s.loop.time() - begin, tcp(s) - place
        assert abs(moved[2] + 0.02 * passed) < 5e-4
        assert np.abs(moved[:2]).max() < 2e-4
        last = s.loop.time()
        rest = await s.at_rest()
        assert s.loop.time() - last < 0.8
        await asyncio.sleep(1.0)
        assert np.abs(s.joints - rest).max() < 1e-3

    streamed(use)
