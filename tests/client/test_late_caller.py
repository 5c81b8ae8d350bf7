"""A delayed caller's thread during a motion, and unread sockets."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from driven import caller_comes_late, complaints, driven

from rapidgen.client import MotionFailed, StopFailed, Trajectory
from rapidgen.client.core.robot import Core
from rapidgen.client.core.state import Progress
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.flows.motion import until
from rapidgen.client.flows.stop import _until_standing
from rapidgen.wire.simple_message.spec import Port, Reason, TrajectoryState, TriState

LATE = 2.5
"""s after which all is over."""
THERE_AND_BACK = Trajectory([0, 0.6, 1.2], [[0.0] * 6, [0.1] * 6, [0.0] * 6])


@pytest.mark.parametrize("plain", [False, True], ids=["ours", "plain"])
def test_a_motion_is_seen_that_is_over_before_its_caller_looks(monkeypatch, plain):
    with driven(plain=plain) as (robot, controller):
        caller_comes_late(monkeypatch, LATE)
        result = robot.execute(THERE_AND_BACK, mode="download").result()
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
        requested = robot.later.execute(THERE_AND_BACK, mode="download")
        robot.sleep(1.9)
        holds = False
        assert prompt(robot._core, Port.STATE, bytes(held))
        assert robot._run(requested.result().result()).deviation < 1e-4


@pytest.mark.parametrize("mode", ["download", "stream"])
def test_the_result_tells_how_it_ended_whenever_the_caller_looks(monkeypatch, mode):
    path = Trajectory([0, 9], [[0.0] * 6, [0.1] * 6])
    with driven() as (robot, controller):
        caller_comes_late(monkeypatch, LATE)
        requested = robot.later.execute(path, mode=mode)
        while not robot.state.is_moving:
            robot.sleep(0.1)
        controller.set_e_stop(True)
        execution = requested.result()
        with pytest.raises(MotionFailed) as failed:
            robot._run(execution.result())
        assert failed.value.reason is Reason.EMERGENCY_STOP


def test_late_caller_after_stop_sees_robot_at_rest(monkeypatch):
    with driven() as (robot, _):
        core = robot._core
        waiting = _until_standing(core)
        wait = next(waiting)
        robot.sleep(1)
        assert wait.until()
        moving = replace(core.state_port.status, in_motion=TriState.TRUE)
        monkeypatch.setattr(StatePort, "status", moving)
        monkeypatch.setattr(StatePort, "is_still", lambda *_: False)
        with pytest.raises(StopIteration) as end:
            waiting.send(True)
        assert end.value.value.joints == robot.state.joints
        # Without a connection the position is unknown.
        unseen = _until_standing(core)
        next(unseen)
        core.state_open = False
        with pytest.raises(StopFailed):
            unseen.send(True)


def test_progress_that_is_undone_before_the_caller_looks_counts():
    """As a stream that starves, by a state that is older than the controller's last reply."""
    motion = SimpleNamespace(is_over=False, longest=1.0, progress_marker=1)
    motion.progress = Progress(TrajectoryState.MOVING, total=1)
    waiting = until(SimpleNamespace(override=1.0), motion, lambda: False)
    wait = next(waiting)
    motion.progress_marker = 2
    assert wait.until()
    motion.progress_marker = 1
    wait = waiting.send(True)
    assert not wait.until()
    with pytest.raises(StopIteration) as end:
        waiting.send(False)
    assert end.value.value is False
