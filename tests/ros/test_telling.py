"""Published state: industrial_msgs' numbers, and blockers in words."""

import pytest
from ready import goal, station

from rapidgen.client import Trajectory
from rapidgen.client.core.state import Driver, State, Status
from rapidgen.ros.goals import FinalStatus
from rapidgen.ros.status_messages import (
    PERIOD,
    DiagnosticsFilter,
    Level,
    RobotHealth,
    health,
    no_link,
    robot_status,
    unknown_status,
)
from rapidgen.wire.simple_message.spec import Mode, Reason, TrajectoryState, TriState


def published(s):
    state = s.run(s.robot.next_state())
    state = s.run(s.robot.next_state())
    return robot_status(state.status), health(state, s.robot.driver, "controller")


@pytest.mark.parametrize(
    ("fault", "level", "text", "numbers"),
    [
        (lambda c: None, Level.OK, "ready", {"mode": 2, "motion_possible": 1, "e_stopped": 0}),
        (lambda c: c.set_e_stop(True), Level.ERROR, "emergency stop", {"e_stopped": 1}),
        (lambda c: c.set_mode("manual_reduced"), Level.WARN, "", {"mode": 1}),
        (lambda c: c.stop_program(), Level.WARN, "not executing", {"motion_possible": 0}),
    ],
)
def test_states_of_the_controller(fault, level, text, numbers):
    with station() as s:
        fault(s.controller)
        s.controller.run_for(1.0)
        status, result = published(s)
        assert result.level is level
        assert text in result.message
        assert {name: getattr(status, name) for name in numbers} == numbers


def state(trajectory=None, **status):
    known = {
        "drives": TriState.TRUE,
        "e_stopped": TriState.FALSE,
        "in_motion": TriState.FALSE,
        "motion_possible": TriState.TRUE,
        "mode": Mode.AUTO,
    }
    published = Status(**{**known, **status})
    return State(("joint_1",), (0.0,), (0.0,), published, 0.0, 25.0, 1, lambda: 0.0, trajectory)


ENDED = {
    "in_error": TriState.TRUE,
    "motion_possible": TriState.FALSE,
    "error": Reason.TASK_ENDED,
    "error_code": 53,
}


@pytest.mark.parametrize(
    ("trajectory", "status", "level", "text"),
    [
        (None, {}, Level.OK, "ready"),
        (None, {"in_motion": TriState.UNKNOWN}, Level.OK, "ready"),
        (TrajectoryState.MOVING, {"in_motion": TriState.TRUE}, Level.OK, "moving"),
        (TrajectoryState.DONE, {}, Level.OK, "ready"),
        (TrajectoryState.PAUSED, {}, Level.WARN, "paused"),
        (TrajectoryState.PAUSED, {"in_motion": TriState.TRUE}, Level.WARN, "paused"),
        (TrajectoryState.PAUSED, {"motion_possible": TriState.FALSE}, Level.WARN, "paused"),
        (TrajectoryState.DONE, {"motion_possible": TriState.FALSE}, Level.WARN, "not executing"),
        (TrajectoryState.PAUSED, {"mode": Mode.MANUAL}, Level.WARN, "manual mode"),
        (None, {"drives": TriState.FALSE, "mode": Mode.MANUAL}, Level.WARN, "motors are off"),
        (
            TrajectoryState.PAUSED,
            {"e_stopped": TriState.TRUE, "drives": TriState.FALSE},
            Level.ERROR,
            "emergency stop",
        ),
        (None, {name: TriState.UNKNOWN for name in ("drives", "e_stopped")}, Level.OK, "ready"),
        (None, ENDED, Level.ERROR, "has ended: restart the controller (a warm start)"),
        (TrajectoryState.PAUSED, {**ENDED, "e_stopped": TriState.TRUE}, Level.ERROR, "has ended"),
        (None, {**ENDED, "in_error": TriState.FALSE}, Level.WARN, "not executing"),
    ],
)
def test_what_hinders_the_robot_the_worst_first(trajectory, status, level, text):
    result = health(state(trajectory, **status), Driver(), "10.0.0.1")
    assert (result.level, text in result.message) == (level, True)
    assert result.values["address"] == "10.0.0.1"
    assert result.values.get("trajectory") == (trajectory.name if trajectory else None)
    words = {TriState.TRUE: "yes", TriState.FALSE: "no", TriState.UNKNOWN: "unknown"}
    assert result.values["drives"] == words[status.get("drives", TriState.TRUE)]
    assert result.values["emergency stop"] == words[status.get("e_stopped", TriState.FALSE)]


def test_a_paused_robot_is_not_ready():
    with station() as s:
        s.run(s.robot.execute(Trajectory([0, 4], [list(s.joints), [0.3] * 6])))
        s.controller.run_for(1.0)
        s.run(s.robot.pause())
        s.controller.run_for(1.0)
        _, result = published(s)
        assert (result.level, result.message) == (Level.WARN, "paused")
        s.run(s.robot.resume())
        s.controller.run_for(8.0)
        assert published(s)[1].message == "ready"


def test_a_refusal_stays_visible():
    with station() as s:
        check = s.robot._core.check

        def unchecked(trajectory, mode=None):
            made = check(trajectory, mode)
            made.wire[-1, 0] = 9.0
            return made

        s.robot._core.check = unchecked
        assert s.outcome(goal(0.0, 0.1)).status is FinalStatus.ABORTED
        status, result = published(s)
        assert status.in_error == 1
        assert status.error_code == 104
        assert "last refusal" in result.values


def test_without_a_link_nothing_is_known():
    status = unknown_status()
    assert {status.e_stopped, status.drives_powered, status.in_motion, status.mode} == {-1}
    assert no_link("no answer", "10.0.0.1").level is Level.STALE


READY = RobotHealth(Level.OK, "ready", {"address": "10.0.0.1:11000"})


def test_diagnostics_are_published_when_new_and_each_second():
    published = DiagnosticsFilter("/rapidgen 1")
    assert published.to_publish(READY, 0.0) is not None
    assert published.to_publish(READY, 0.5 * PERIOD) is None
    moving = RobotHealth(Level.OK, "moving", READY.values)
    assert published.to_publish(moving, 0.6 * PERIOD) is not None
    assert published.to_publish(moving, 1.7 * PERIOD) is not None


def test_another_node_on_the_robot_is_named_until_it_ends():
    published = DiagnosticsFilter("/rapidgen 1")
    published.to_publish(READY, 0.0)
    address = READY.values["address"]
    assert published.received(address, {"node": "/rapidgen 1"}, 0.1) == ""
    assert published.received("10.0.0.2:11000", {"node": "/other 2"}, 0.1) == ""
    assert published.received(address, {}, 0.1) == ""
    assert published.received(address, {"node": "/other 2"}, 0.1) == "/other 2"
    assert published.received(address, {"node": "/other 2"}, 0.2) == ""
    warned = published.to_publish(READY, 0.2)
    assert (warned.level, "/other" in warned.message) == (Level.WARN, True)
    stopped = RobotHealth(Level.ERROR, "an emergency stop is active", READY.values)
    assert published.to_publish(stopped, 0.3).message == stopped.message
    assert published.to_publish(READY, 0.2 + 3 * PERIOD).level is Level.OK
