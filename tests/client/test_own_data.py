"""`robot.data`: PERS of the cell's program, read and written at the robot."""

import pytest
from driven import BENT, complaints, driven

from rapidgen.client import NotSupported, Program, RequestRefused, Robot
from rapidgen.client.sync import CellData
from rapidgen.system.model import ModuleFile
from rapidgen.wire.simple_message.spec import Reason


def test_it_is_a_mapping_that_is_read_and_written_at_the_robot():
    held = {"cell:count": 3.0, "cell:recipe": "none"}
    data = CellData(tuple(held), held.__getitem__, held.__setitem__)
    data["cell:count"] = 4.0
    assert dict(data) == held == {"cell:count": 4.0, "cell:recipe": "none"}
    assert "cell:recipe" in data
    assert "cell:absent" not in data
    assert len(data) == 2


def test_without_a_connection_nothing_is_asked():
    robot = Robot("irb120")
    with pytest.raises(NotSupported, match="lists no datum"):
        robot.data["cell:count"]


DATA = {
    "data": {
        "cell:count": {"type": "num", "access": "write"},
        "cell:ready": {"type": "bool", "access": "write"},
        "cell:recipe": {"type": "string", "access": "write"},
        "cell:limit": {"type": "num"},
        "cell:absent": {"type": "num", "access": "write"},
        "cell:other": {"type": "bool"},
        "cell:passing": {"type": "num"},
    }
}
DATA_MODULE = b"""MODULE cell
    PERS num count := 3;
    PERS bool ready := FALSE;
    PERS string recipe := "none";
    PERS num limit := 0.5;
    PERS num other := 1;
    VAR num passing := 1;
ENDMODULE
"""


def with_data():
    return driven(overrides=DATA, modules=[ModuleFile("cell", "cell.mod", DATA_MODULE)])


def test_data_of_the_program_are_read_and_written():
    with with_data() as (robot, controller):
        own = controller.task("T_ROB1")
        assert robot.read_data("cell:count") == 3
        assert robot.write_data("cell:count", -1.5e30) == pytest.approx(-1.5e30)
        assert own["cell:count"] == pytest.approx(-1.5e30)
        for yes in (True, False):
            assert robot.write_data("cell:ready", yes) is yes
            assert own["cell:ready"] is yes
        for text in ("x" * 80, "é 7", ""):
            assert robot.write_data("cell:recipe", text) == text
            assert own["cell:recipe"] == text
        assert robot.read_data("cell:limit") == 0.5
        robot.move_to(BENT, speed=0.3)
        assert not complaints(controller)


def test_data_are_written_while_the_robot_moves_and_it_moves_on():
    with with_data() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        execution = robot.run(Program().move_linear(robot.pose.moved(z=0.1)))
        robot.sleep(0.5)
        for n in range(20):
            assert robot.write_data("cell:count", n) == n
        assert execution.result().deviation < 1e-4
        assert not complaints(controller)


@pytest.mark.parametrize(
    ("name", "reason"),
    [("cell:absent", "datum"), ("cell:other", "type"), ("cell:passing", "datum")],
)
def test_data_that_the_program_does_not_have_so_are_refused_the_others_work(name, reason):
    with with_data() as (robot, _):
        with pytest.raises(RequestRefused, match=reason) as refused:
            robot.read_data(name)
        assert refused.value.reason is Reason.NO_DATUM
        assert robot.read_data("cell:count") == 3


def test_data_that_are_not_listed_so_are_not_asked_for():
    with with_data() as (robot, controller):
        with pytest.raises(NotSupported, match="cell:count"):
            robot.read_data("cell:counts")
        with pytest.raises(NotSupported, match="reading only"):
            robot.write_data("cell:limit", 1.0)
        for name, value in (
            ("cell:count", float("nan")),
            ("cell:count", True),
            ("cell:count", None),
            ("cell:ready", 1),
            ("cell:recipe", "x" * 81),
            ("cell:recipe", "Ω"),
        ):
            with pytest.raises(ValueError, match=name):
                robot.write_data(name, value)
        assert controller.task("T_ROB1")["cell:limit"] == 0.5
