"""The caller's thread gets no time while the robot moves, or nobody reads what it tells."""

import pytest
from driven import caller_comes_late, complaints, driven

from rapidgen.client import MotionFailed, Trajectory
from rapidgen.client.core.robot import Core
from rapidgen.wire.simple_message.spec import Port, Reason

LATE = 2.5
"""s after which all is over."""
THERE_AND_BACK = Trajectory([0, 0.6, 1.2], [[0.0] * 6, [0.1] * 6, [0.0] * 6])


@pytest.mark.parametrize("plain", [False, True], ids=["ours", "plain"])
def test_a_motion_is_seen_that_is_over_before_its_caller_looks(monkeypatch, plain):
    with driven(plain=plain) as (robot, controller):
        caller_comes_late(monkeypatch, LATE)
        result = robot.execute(THERE_AND_BACK, way="download").result()
        assert result.deviation < 1e-4
        assert 0.9 < result.seconds < 2.0
        assert not complaints(controller)


def test_each_state_counts_where_many_come_at_once(monkeypatch):
    with driven(plain=True) as (robot, _):
        prompt, held, holds = Core.received, bytearray(), True

        def received(core, port, data):
            if not holds or port is not Port.STATE:
                return prompt(core, port, data)
            held.extend(data)
            return True

        monkeypatch.setattr(Core, "received", received)
        asked = robot.later.execute(THERE_AND_BACK, way="download")
        robot.sleep(1.9)
        holds = False
        assert prompt(robot._core, Port.STATE, bytes(held))
        assert robot._run(asked.result().result()).deviation < 1e-4


@pytest.mark.parametrize("way", ["download", "stream"])
def test_the_result_tells_how_it_ended_whenever_the_caller_looks(monkeypatch, way):
    path = Trajectory([0, 9], [[0.0] * 6, [0.1] * 6])
    with driven() as (robot, controller):
        caller_comes_late(monkeypatch, LATE)
        asked = robot.later.execute(path, way=way)
        while not robot.state.is_moving:
            robot.sleep(0.1)
        controller.set_e_stop(True)
        execution = asked.result()
        with pytest.raises(MotionFailed) as failed:
            robot._run(execution.result())
        assert failed.value.reason is Reason.EMERGENCY_STOP
