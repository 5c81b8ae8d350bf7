"""What is published of a state: industrial_msgs' numbers, and what hinders the robot in words."""

import pytest
from ready import goal, station

from rapidgen.ros.goals import Ending
from rapidgen.ros.telling import Level, health, no_link, robot_status, unknown_status


def told(s):
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
        status, found = told(s)
        assert found.level is level
        assert text in found.message
        assert {name: getattr(status, name) for name in numbers} == numbers


def test_a_refusal_stays_visible():
    with station() as s:
        check = s.robot._core.check

        def unchecked(trajectory, way=None):
            made = check(trajectory, way)
            made.wire[-1, 0] = 9.0
            return made

        s.robot._core.check = unchecked
        assert s.outcome(goal(0.0, 0.1)).status is Ending.ABORTED
        status, found = told(s)
        assert status.in_error == 1
        assert status.error_code == 104
        assert "last refusal" in found.values


def test_without_a_link_nothing_is_known():
    status = unknown_status()
    assert {status.e_stopped, status.drives_powered, status.in_motion, status.mode} == {-1}
    assert no_link("nobody answers", "10.0.0.1").level is Level.STALE
