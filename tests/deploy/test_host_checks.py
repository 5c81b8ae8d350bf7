"""`doctor HOST`: over the state port alone, against the driver on a virtual controller."""

from dataclasses import replace

import pytest

from rapidgen.cli.app import main
from rapidgen.cli.driver_query import hello
from rapidgen.client import Robot, Trajectory
from rapidgen.controller.controller import VirtualController
from rapidgen.deploy.command_run import desired_set
from rapidgen.deploy.doctor import _running
from rapidgen.deploy.host_checks import host_checks


@pytest.fixture
def served():
    with VirtualController.from_config("irb120", clock="real", ports="auto") as controller:
        controller.start()
        yield controller, controller.address(timeout=60)


def found(address, build_id=""):
    robot = Robot("irb120", address=address, watch=True)
    return {check.area: check for check in host_checks(robot, build_id, timeout=0.1)}


def test_host_without_configuration(served, capsys):
    _, address = served
    assert main(["doctor", address]) == 0
    shown = capsys.readouterr().out
    for text in (
        "the state port answers",
        "of rapidgen",
        "6: joint_1",
        "AUTO",
        "messages a second",
    ):
        assert text in shown


def test_states_that_need_an_act(served):
    controller, address = served
    assert found(address, "0" * 12)["build"].verdict == "warn"
    controller.call(lambda: controller.set_e_stop(True))
    check = found(address)["state"]
    assert (check.verdict, "EMERGENCY STOP" in check.found) == ("fail", True)
    assert check.help


def test_host_without_a_driver(capsys):
    assert main(["doctor", "127.0.0.1:1,2"]) == 1
    shown = capsys.readouterr().out
    assert "fail     driver" in shown
    assert "->" in shown


def test_motion_of_another_client_goes_on(served):
    """A connection to its motion or control port would end it."""
    _, address = served
    with Robot("irb120", address=address) as robot:
        robot.wait_until(lambda state: state.status.motion_possible == 1, timeout=10)
        here = robot.state.joints
        path = Trajectory.from_points([here, [v + 0.02 for v in here]], seconds=1.5)
        execution = robot.execute(path)
        assert found(address)["driver"].verdict == "ok"
        assert execution.result().deviation < 1e-3


def test_doctor_of_a_url_leaves_another_clients_motion_alone(served):
    _, address = served
    with Robot("irb120", address=address) as robot:
        robot.wait_until(lambda state: state.status.motion_possible == 1, timeout=10)
        here = robot.state.joints
        path = Trajectory.from_points([here, [v + 0.02 for v in here]], seconds=1.5)
        own = robot.address
        ports = {"motion": own.motion, "state": own.state, "control": own.control}
        desired = replace(desired_set("irb120"), generated={"groups": {"rob1": {"ports": ports}}})
        execution = robot.execute(path)
        checks = tuple(_running(own.host, desired, hello, lambda *_: None, 1.0))
        assert [check.area for check in checks] == ["driver", "ports", "ports"]
        assert execution.result().deviation < 1e-3


@pytest.mark.parametrize("words", [["irb120"], ["irb121"], ["irb120", "--to", "a b"]])
def test_missing_or_wrong_host_is_bad_usage(words, capsys):
    assert main(["doctor", *words]) == 2
    assert "error[RG" in capsys.readouterr().err
