"""Addresses, targets, changes of status, the public surface, cells on the scripted controller."""

import asyncio
import re
from concurrent.futures import ThreadPoolExecutor

import pytest

import rapidgen.client
from rapidgen.client import (
    AsyncCell,
    AsyncRobot,
    Cell,
    ConnectionFailed,
    ConnectionLost,
    InvalidTrajectory,
    MotionFailed,
    Robot,
    RobotError,
    Status,
    Trajectory,
    TrajectoryRefused,
)
from rapidgen.client.address import Address, parse_address
from rapidgen.client.connect_target import groups_of, resolve
from rapidgen.config.model import Ports
from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer.state_lines import changes, error_text
from rapidgen.wire.simple_message.spec import Mode, Port, Reason, TriState

PATH = Trajectory.from_points([[0.0] * 6, [0.1] * 6, [0.2] * 6], seconds=0.15)
LONG = PATH.scaled(0.05)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("10.0.0.1", Address("10.0.0.1", 11000, 11002, 11001)),
        ("robot.lab:12000", Address("robot.lab", 12000, 12002, 12001)),
        ("10.0.0.1:12000,13000", Address("10.0.0.1", 12000, 13000, 0)),
        ("10.0.0.1:12000,13000,14000", Address("10.0.0.1", 12000, 13000, 14000)),
        ("10.0.0.1:12000,12002,0", Address("10.0.0.1", 12000, 12002, 0)),
        ("[::1]:1,3", Address("::1", 1, 3, 2)),
        ("10.0.0.1:65533", Address("10.0.0.1", 65533, 65535, 65534)),
    ],
)
def test_addresses(text, expected):
    assert parse_address(text) == expected
    assert parse_address(str(expected)) == expected


@pytest.mark.parametrize(
    "text", ["", ":1", "a:b", "a:1,2,3,4", "a:1,2,70000", "a:0", "a:70000", "a:1:2", "a b:,"]
)
def test_addresses_that_are_none(text):
    with pytest.raises(DiagnosticError, match="RG607"):
        parse_address(text)


def test_ports_of_the_configuration_are_the_default():
    own = Ports(21000, 20000, 21002)
    assert parse_address("a", own) == Address("a", 21000, 21002, 20000)
    # moved by the same amount, the control port is too; else it is unknown
    assert parse_address("a:22000,22002", own).control == 21000
    assert parse_address("a:22000,23000", own).control == 0
    with pytest.raises(ConnectionFailed, match=r"the control port of .* is unknown"):
        parse_address("a:22000,23000", own).port(Port.CONTROL)


@pytest.mark.parametrize(
    ("host", "is_loopback"),
    [("127.0.0.1", True), ("127.9.9.9", True), ("::1", True), ("localhost", True),
     ("10.0.0.1", False), ("0.0.0.0", False), ("localhost.example", False)],
)  # fmt: skip
def test_loopback(host, is_loopback):
    assert Address(host).is_loopback is is_loopback


def test_targets():
    address, group = resolve("irb120", None, "")
    assert (address.host, group.name) == ("127.0.0.1", "rob1")
    assert resolve("10.0.0.1", None, "") == (Address("10.0.0.1"), None)
    assert len(groups_of("irb14000")) == 2
    with pytest.raises(DiagnosticError, match="which motion group"):
        resolve("irb14000", None, "")
    with pytest.raises(DiagnosticError, match="RG608"):
        resolve("irb120", None, "rob2")
    with pytest.raises(DiagnosticError, match="no shipped name"):
        resolve("irb12", "10.0.0.1", "")


def test_changes_of_status_in_words():
    before = Status(drives=TriState.TRUE, mode=Mode.AUTO, in_motion=TriState.FALSE)
    after = Status(
        drives=TriState.FALSE,
        e_stopped=TriState.TRUE,
        mode=Mode.MANUAL,
        in_motion=TriState.TRUE,
        in_error=TriState.TRUE,
        error_code=204,
        error=Reason.JOINT_LIMIT,
        error_joint=2,
    )
    assert changes(before, before) == []
    assert changes(before, after) == [
        "motors off",
        "emergency stop",
        "began to move",
        "manual mode",
        "error: a joint is outside its limits (joint 2)",
    ]
    assert "error gone" in changes(after, before)
    assert error_text(Status(in_error=TriState.TRUE, error_code=9)) == "error 9"


def test_exported_members():
    assert sorted(rapidgen.client.__all__) == rapidgen.client.__all__
    for name in rapidgen.client.__all__:
        assert getattr(rapidgen.client, name).__doc__


def test_the_tree_of_exceptions_is_the_one_that_is_drawn():
    from rapidgen.client import errors

    drawn = set(re.findall(r"[\u2500 ] (\w+)  +\w", errors.__doc__))
    kinds = {
        name
        for name, kind in vars(errors).items()
        if isinstance(kind, type) and issubclass(kind, RobotError) and not name.startswith("_")
    }
    assert drawn == kinds


@pytest.fixture
def cell_of(fake, patient):
    """Makes a cell of scripted controllers, and tells them."""

    def make(*scripts):
        controllers = [fake(**script) for script in scripts]
        robots = {str(i): Robot(c.address, timeouts=patient()) for i, c in enumerate(controllers)}
        return Cell(robots), controllers

    return make


class TestCells:
    def test_start_together_and_arrive(self, cell_of):
        with cell_of({}, {"rapidgen": False})[0] as cell:
            results = cell.execute({"0": PATH, "1": PATH}).result()
        assert all(result.deviation < 1e-5 for result in results.values())

    def test_the_faults_of_all_before_a_byte_is_sent(self, cell_of):
        cell, controllers = cell_of({}, {})
        far = Trajectory.from_points([[0.0] * 6, [9.0] * 6], seconds=99)
        with cell:
            with pytest.raises(InvalidTrajectory) as error:
                cell.execute({"0": far, "1": far})
            assert len(error.value.diagnostics) == 12
            with pytest.raises(KeyError, match="no robot of this cell is called '2'"):
                cell.execute({"2": PATH})
        assert [c.frames for c in controllers] == [[], []]

    def test_cell_with_one_refusal_stops_all(self, cell_of):
        cell, controllers = cell_of({}, {"refuse": (5, 0, 1)})
        with cell:
            with pytest.raises(TrajectoryRefused):
                cell.execute({"0": LONG, "1": LONG})
            assert controllers[0].stops
            assert not controllers[0]._moving

    @pytest.mark.parametrize("failing", ["fails", "lost"])
    def test_one_fails_and_all_are_stopped(self, cell_of, failing):
        cell, controllers = cell_of({}, {"ends_at": 0.02} if failing == "fails" else {})
        with cell:
            execution = cell.execute({"0": LONG, "1": LONG})
            if failing == "lost":
                controllers[1].drop("state")
            with pytest.raises(MotionFailed if failing == "fails" else ConnectionLost):
                execution.result()
            assert execution.is_over
            assert controllers[0].stops

    def test_ctrl_c_before_all_are_waited_for_stops_all(self, cell_of, monkeypatch):
        cell, controllers = cell_of({}, {})
        hand_in = ThreadPoolExecutor.submit

        def submit(pool, *arguments):
            monkeypatch.setattr(ThreadPoolExecutor, "submit", hand_in)
            raise KeyboardInterrupt

        with cell:
            execution = cell.execute({"0": LONG, "1": LONG})
            monkeypatch.setattr(ThreadPoolExecutor, "submit", submit)
            with pytest.raises(KeyboardInterrupt):
                execution.result()
            assert [len(c.stops) > 0 for c in controllers] == [True, True]

    def test_async(self, fake, patient):
        controllers = [fake(), fake(ends_at=0.02)]

        async def main():
            robots = {
                str(i): AsyncRobot(c.address, timeouts=patient()) for i, c in enumerate(controllers)
            }
            async with AsyncCell(robots) as cell:
                await (await cell.execute({"0": PATH})).result()
                await (await cell.execute({"0": PATH.reversed()})).result()
                execution = await cell.execute({"0": LONG, "1": LONG})
                with pytest.raises(MotionFailed):
                    await execution.result()
                assert execution.is_over
                assert controllers[0].stops

        asyncio.run(main())
