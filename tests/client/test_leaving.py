"""Motions of callers that end early, and their log entries."""

import asyncio
import logging
import warnings
from contextlib import suppress

import pytest
from driven import driven, wave

from rapidgen.client import AsyncRobot, Cell, Robot, StopFailed, Trajectory

LONG = Trajectory.from_points([[0.0] * 6, [0.5] * 6], seconds=5)


def stands(controller):
    """True if no part of the robot moves now."""
    axes = controller.motion.group("rob1").positions
    before = axes()
    controller.run_for(0.3)
    return axes() == before


def moving(robot, controller):
    execution = robot.execute(LONG)
    robot.sleep(1.5)
    assert controller.motion.group("rob1").positions()[0] > 0.01
    return execution


def test_a_cancelled_result_ends_when_the_robot_stands():
    with driven() as (robot, controller):
        waiting = moving(robot, controller).later.result()
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            waiting.result()
        assert stands(controller)


def test_a_cancelled_append_ends_when_the_robot_stands():
    with driven() as (robot, controller):
        stream = robot.stream()
        points = list(wave(4000))
        waiting = stream.later.append(*zip(*points, strict=True))
        robot.sleep(3)
        assert not stream.is_over
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            waiting.result()
        assert stands(controller)


def test_who_cancels_twice_does_not_wait():
    with driven() as (robot, controller):
        waiting = moving(robot, controller).later.result()
        waiting.cancel()
        robot.sleep(0)
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            waiting.result()
        assert not stands(controller)
        robot.stop()


def test_a_stop_that_fails_is_louder_than_a_cancellation(fake, patient):
    controller = fake(answer_stop=False)

    async def run():
        robot = await AsyncRobot(controller.address, timeouts=patient(stop=0.1)).connect()
        waiting = asyncio.ensure_future((await robot.execute(LONG)).result())
        await robot.next_state()
        waiting.cancel()
        with pytest.raises(StopFailed):
            await waiting
        with suppress(StopFailed):
            await robot.close()

    asyncio.run(run())


def test_ctrl_c_returns_when_the_robot_stands(fake, patient, monkeypatch):
    with Robot(fake().address, timeouts=patient()) as robot:
        execution = robot.execute(LONG)
        wait = robot._runner.guard.wait

        def interrupt(timeout=None):
            monkeypatch.setattr(robot._runner.guard, "wait", wait)
            raise KeyboardInterrupt

        monkeypatch.setattr(robot._runner.guard, "wait", interrupt)
        with pytest.raises(KeyboardInterrupt):
            execution.result()
        assert execution.is_over
        assert not robot.state.is_moving


def test_block_end_before_motion_end_is_reported(fake, patient):
    controller = fake()
    with (
        pytest.warns(RuntimeWarning, match=r"0 of 2 points.*result\(\)") as report,
        Robot(controller.address, timeouts=patient()) as robot,
    ):
        robot.execute(LONG)
    assert report[0].filename == __file__
    assert controller.stops
    with pytest.warns(RuntimeWarning, match="left: the robot"):
        _cell(fake, patient)

    async def run():
        async with AsyncRobot(fake().address, timeouts=patient()) as robot:
            await robot.execute(LONG)

    with pytest.warns(RuntimeWarning, match="0 of 2 points") as report:
        asyncio.run(run())
    assert report[0].filename == __file__


def _cell(fake, patient):
    with Cell({"left": Robot(fake().address, timeouts=patient())}) as cell:
        cell.execute({"left": LONG})


def test_a_block_that_ends_well_or_by_an_error_says_nothing_more(fake, patient):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with Robot(fake().address, timeouts=patient()) as robot:
            robot.execute(LONG.scaled(20)).result()
        robot = Robot(fake().address, timeouts=patient()).connect()
        robot.execute(LONG)
        robot.__exit__(LookupError)


def test_the_log_tells_what_was_done(connected, caplog):
    caplog.set_level(logging.INFO, "rapidgen.client")
    with connected(control=True) as (robot, controller):
        robot.execute(LONG.scaled(20)).result()
        robot.execute(Trajectory.from_points([[0.5] * 6, [0.0] * 6], seconds=5))
        robot.stop()
    where = str(controller.address)
    assert {record.name for record in caplog.records} == {"rapidgen.client"}
    messages = [record.getMessage().partition(": ")[2] for record in caplog.records]
    assert all(where.split(",")[0] in record.getMessage() for record in caplog.records)
    assert messages[0].startswith("connected: rapidgen 0.1.0, build 0123456789ab, AUTO, motors on")
    assert "2 points by download were accepted" in messages
    assert any(text.startswith("done in") for text in messages)
    assert "STOP over the control port" in messages
    assert messages[-1] == "closed"
    assert {record.levelno for record in caplog.records} == {logging.INFO}


def test_unobserved_failure_is_logged(connected, caplog, comes):
    with connected(control=True) as (robot, controller):
        robot.execute(LONG)
        controller.drop("state")
        assert comes(lambda: any(r.levelno == logging.WARNING for r in caplog.records))
        assert "no states arrive from the robot" in caplog.text
