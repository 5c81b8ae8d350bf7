"""Clients that are dropped without `close()`, and clients in a forked process."""

import asyncio
import gc
import os
import threading
import warnings

import pytest

from rapidgen.client import AsyncRobot, ConnectionLost, Robot, Trajectory

LONG = Trajectory.from_points([[0.0] * 6, [0.5] * 6], seconds=5)
DROPS = 28


def resources():
    return len(os.listdir("/proc/self/fd")), threading.active_count()


def dropped(drop):
    """The categories of the warnings of a call."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        drop()
        gc.collect()
    return [warning.category for warning in caught]


def test_dropped_robots_free_descriptors_and_threads(fake, patient, comes):
    controller = fake(control=True)
    before = resources()

    def run_the_cell_again():
        robot = None
        for _ in range(DROPS):
            robot = Robot(controller.address, timeouts=patient()).connect()
        assert robot.is_connected
        del robot

    assert dropped(run_the_cell_again) == [ResourceWarning] * DROPS
    assert comes(lambda: resources() == before)


def test_dropped_async_robots_free_descriptors(fake, patient, comes):
    controller = fake(control=True)
    before = resources()

    async def run():
        for _ in range(DROPS):
            await AsyncRobot(controller.address, timeouts=patient()).connect()
            gc.collect()
        while controller._clients:
            await asyncio.sleep(0)

    assert dropped(lambda: asyncio.run(run())) == [ResourceWarning] * DROPS
    assert comes(lambda: resources() == before)


def test_dropped_robot_stops_its_motion(fake, patient, comes):
    controller = fake(control=True)

    def drop():
        Robot(controller.address, timeouts=patient()).connect().execute(LONG)

    assert dropped(drop) == [RuntimeWarning]
    assert comes(lambda: controller.stops)


def test_dropped_async_robot_stops_its_motion(fake, patient, comes):
    controller = fake(control=True)

    async def run():
        robot = await AsyncRobot(controller.address, timeouts=patient()).connect()
        await robot.execute(LONG)
        del robot
        gc.collect()
        while not controller.stops:
            await asyncio.sleep(0)

    assert dropped(lambda: asyncio.run(run())) == [RuntimeWarning]


def test_execution_keeps_the_robot_of_its_motion(fake, patient):
    controller = fake(control=True)
    short = Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=0.5)

    def drop():
        execution = Robot(controller.address, timeouts=patient()).connect().execute(short)
        gc.collect()
        assert execution.result().points == 2

    assert dropped(drop) == [ResourceWarning]
    assert not controller.stops


def test_closed_robot_is_dropped_silently(fake, patient):
    controller = fake(control=True)

    def drop():
        with Robot(controller.address, timeouts=patient()):
            pass
        Robot(controller.address)

    assert dropped(drop) == []


def in_child(function):
    """The exit code of a fork that runs a function; 0 if it returns."""
    with warnings.catch_warnings():
        # Python 3.12 and later warn of a fork in a process with threads.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if not child:
        code = 1
        try:
            function()
            code = 0
        finally:
            os._exit(code)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status)


def test_close_in_a_fork_leaves_the_parents_motion(fake, patient):
    controller = fake(control=True)
    with Robot(controller.address, timeouts=patient()) as robot:
        execution = robot.execute(Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=1))
        connections = controller.connections

        def child():
            with pytest.raises(ConnectionLost, match="forked"):
                execution.result()
            with pytest.raises(ConnectionLost, match="forked"):
                robot.next_state()
            with pytest.raises(ConnectionLost, match="forked"):
                robot.execute(LONG)
            assert not robot.is_connected
            assert not [fd for fd in descriptors if os.path.exists(f"/proc/self/fd/{fd}")]
            robot.close()

        descriptors = [channel.socket.fileno() for channel in robot._runner._by_port.values()]
        assert in_child(child) == 0
        assert execution.result().points == 2
        assert controller.connections == connections
        assert not controller.stops


def test_stop_in_a_fork_sends_stop(fake, patient):
    controller = fake(control=True)
    with Robot(controller.address, timeouts=patient()) as robot:
        robot.execute(LONG)
        connections = controller.connections

        def child():
            assert robot.stop() is None
            robot.close()

        assert in_child(child) == 0
        assert controller.stops
        assert controller.connections == connections + 1
        robot.stop()


def test_fork_of_an_async_robot_leaves_the_parents_motion(fake, patient):
    controller = fake(control=True)

    async def run():
        async with AsyncRobot(controller.address, timeouts=patient()) as robot:
            short = Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=1)
            execution = await robot.execute(short)

            transports = [link.transport for link in robot._runner._by_port.values()]
            descriptors = [each.get_extra_info("socket").fileno() for each in transports]

            def child():
                assert not robot.is_connected
                kinds = {os.readlink(f"/proc/self/fd/{number}") for number in descriptors}
                assert kinds == {os.devnull}
                asyncio.new_event_loop().run_until_complete(robot.close())

            assert in_child(child) == 0
            assert (await execution.result()).points == 2
            assert not controller.stops

    asyncio.run(run())
