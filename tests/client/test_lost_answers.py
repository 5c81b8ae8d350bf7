"""No call raises before the robot stands, where the answer to an order is lost.

What was sent and not answered may begin at any moment: the client stops the robot, sees it stand,
and raises then.
"""

from contextlib import contextmanager

import numpy as np
import pytest
from both_clients import Simulated
from driven import booted, robot_of, wiggle
from fake_stream import StreamModel
from lossy import FAULTS, Proxy, alter_loop, cut, once, swallowed, wrong_direction

from rapidgen.client import (
    ConnectionLost,
    NotReady,
    Program,
    ProtocolError,
    RobotError,
    RobotTimeout,
    Timeouts,
    Trajectory,
)
from rapidgen.testing.asyncio_clock import VirtualLoop
from rapidgen.wire.simple_message.spec import Port

LONG = Trajectory.from_points([[0.0] * 6, [0.2] * 6, [0.4] * 6, [0.2] * 6, [0.0] * 6], seconds=2.0)
LOST = (ConnectionLost, ProtocolError, RobotTimeout)


@contextmanager
def lossy(alter, **timeouts):
    """A robot on the virtual clock with altered answers, and its controller."""
    controller, config = booted()
    group = config.groups[0]
    loop = VirtualLoop(controller)
    ports = {group.ports.motion: "motion", group.ports.state: "state"}
    open_ends = alter_loop(loop, {**ports, group.ports.control: "control"}, alter)
    with controller, Simulated(robot_of(config, timeouts=Timeouts(**timeouts)), loop) as robot:
        yield robot, controller
        for transport in open_ends:
            transport.abort()
        robot.sleep(0.1)


def stands(robot, controller):
    """True if the robot is at rest and stays so."""
    before = list(controller.positions().values())
    robot.sleep(3)
    return np.allclose(before, list(controller.positions().values()), atol=1e-6)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.__name__)
@pytest.mark.parametrize("mode", ["download", "stream"])
def test_the_robot_stands_when_execute_raises(fault, mode):
    kind = {"download": 11, "stream": 1302}[mode]
    with lossy(once("motion", fault, kind=kind)) as (robot, controller):
        with pytest.raises(LOST, match="the robot is at rest") as error:
            robot.execute(wiggle(robot), mode=mode)
        assert "then continue" in error.value.diagnostics[0].help
        assert stands(robot, controller)


def test_the_robot_stands_when_a_program_is_not_answered():
    with lossy(once("motion", cut, kind=1309)) as (robot, controller):
        target = robot.state.joints[0] + 0.3, *robot.state.joints[1:]
        with pytest.raises(LOST, match="the robot is at rest"):
            robot.run(Program().move_joints(target))
        assert stands(robot, controller)


@pytest.mark.parametrize("port", ["state", "motion"])
def test_the_robot_stands_when_result_raises(port):
    alive = []

    def alter(which, number, message):
        return message if which != port or not alive else cut(message)

    with lossy(alter) as (robot, controller):
        moving = robot.execute(wiggle(robot))
        robot.sleep(0.3)
        alive.append(True)
        link = robot._runner._by_port[Port.MOTION]
        if port == "motion":
            # Nothing comes there by itself.
            link.connection_lost(None)
        with pytest.raises(LOST, match="the robot is at rest"):
            moving.result()
        alive.clear()
        assert stands(robot, controller)
        link.transport.abort()


def test_stop_without_states_is_reported():
    silent = []

    def alter(which, number, message):
        return swallowed(message) if silent else message

    with lossy(alter, stop=1.0) as (robot, _):
        moving = robot.execute(wiggle(robot))
        silent.append(True)
        with pytest.raises(RobotTimeout, match="not known whether the robot is at rest") as error:
            moving.result()
        assert "emergency stop" in error.value.diagnostics[0].help


def test_without_progress_a_motion_ends_when_the_robot_stands_at_its_end():
    lost = []

    def alter(which, number, message):
        kind = int.from_bytes(message[4:8], "little")
        return b"" if lost and which == "state" and kind == 1301 else message

    for mode in ("download", "stream"):
        lost.clear()
        with lossy(alter) as (robot, controller):
            path = wiggle(robot)
            moving = robot.execute(path, mode=mode)
            lost.append(True)
            began = robot.time()
            result = moving.result()
            assert result.deviation < 1e-3
            assert robot.time() - began < path.duration + 5
            assert stands(robot, controller)


def test_without_progress_a_long_stand_on_the_way_is_not_stopped():
    """A wait of a program, and a dwell of a trajectory: the robot stands for 6 s elsewhere."""
    lost = []

    def alter(which, number, message):
        kind = int.from_bytes(message[4:8], "little")
        return b"" if lost and which == "state" and kind == 1301 else message

    for is_program in (True, False):
        lost.clear()
        with lossy(alter) as (robot, controller):
            here = robot.state.joints
            target, goal = ((here[0] + turn, *here[1:]) for turn in (0.2, 0.4))
            if is_program:
                moving = robot.run(Program().move_joints(target).wait(6).move_joints(goal))
            else:
                moving = robot.execute(Trajectory([0, 2, 8, 10], [here, target, target, goal]))
            lost.append(True)
            assert moving.result().deviation < 1e-3
            assert robot.state.joints[0] == pytest.approx(goal[0], abs=1e-3)
            assert stands(robot, controller)


def test_progress_is_asked_for_again():
    """A state server that has forgotten who asked for PROGRESS sends it after another HELLO."""
    report = {"lost": False, "hellos": 0}

    def alter(which, number, message):
        kind = int.from_bytes(message[4:8], "little")
        if which == "state" and kind == 1300:
            report["hellos"] += 1
            report["lost"] = False
        return b"" if report["lost"] and which == "state" and kind == 1301 else message

    with lossy(alter) as (robot, _):
        here = robot.state.joints
        path = Trajectory([0, 4], [here, (here[0] + 0.3, *here[1:])])
        moving = robot.execute(path)
        report["lost"] = True
        result = moving.result()
        assert (report["hellos"], report["lost"]) == (2, False)
        assert result.seconds == pytest.approx(4, abs=0.5)


def test_no_motion_begins_where_the_control_port_takes_a_connection_and_says_nothing():
    dead = []

    def alter(which, number, message):
        return b"" if dead and which == "control" else message

    with lossy(alter, reply=1.0) as (robot, controller):
        robot.sleep(2)
        dead.append(True)
        for _ in range(2):
            with pytest.raises(NotReady, match="STOP would not work") as error:
                robot.execute(wiggle(robot))
            assert "restart the controller" in error.value.diagnostics[0].help
        assert stands(robot, controller)
        dead.clear()
        robot.execute(wiggle(robot)).result()


@pytest.mark.parametrize("fault", [cut, swallowed, wrong_direction], ids=lambda f: f.__name__)
@pytest.mark.parametrize("mode", ["download", "stream"])
def test_both_clients_raise_when_the_robot_stands(fake, client, fault, mode):
    """Real sockets: an answer that is lost, and a robot that is on its way already."""
    kind = {"download": 11, "stream": 1302}[mode]
    controller = fake(control=True, stream=StreamModel(ring=100, preload=0.1, batch=20))
    proxy = Proxy(controller, once("motion", fault, kind=kind))
    try:
        with client(proxy.address) as robot:
            with pytest.raises(RobotError, match="the robot is at rest"):
                robot.execute(LONG, mode=mode)
            with controller.lock:
                assert controller.stops
                assert not controller._moving
                assert not controller.script.stream.is_moving
    finally:
        proxy.close()


@pytest.mark.parametrize(
    ("silent", "is_reached", "why"),
    [
        ({"motion", "control"}, True, "the controller did not answer STOP"),
        ({"state"}, True, "STOP was answered, and the robot was not observed at rest"),
        ({"state"}, False, "STOP was answered, and the state port stopped sending data"),
    ],
)
def test_unknown_stop_result_is_reported(silent, is_reached, why):
    lost = []

    def alter(which, number, message):
        return cut(message) if lost and which in silent else message

    with lossy(alter, stop=1.0) as (robot, controller):
        connect = robot._loop.create_connection

        async def create_connection(*arguments, **options):
            if lost and not is_reached:
                raise ConnectionRefusedError
            return await connect(*arguments, **options)

        robot._loop.create_connection = create_connection
        moving = robot.execute(wiggle(robot))
        robot.sleep(0.3)
        lost.append(True)
        if "motion" in silent:
            # Nothing comes there by itself.
            robot._runner._by_port[Port.MOTION].connection_lost(None)
        with pytest.raises(LOST, match="not known whether the robot is at rest") as error:
            moving.result()
        assert why in str(error.value)
        assert "emergency stop" in error.value.diagnostics[0].help
        # Where it is not seen to stand it may still slow down.
        robot.sleep(1.0)
        assert stands(robot, controller)
