"""Tests of a RAPID program of one's own, by pytest alone: `pytest test_counting.py`."""

from pathlib import Path

HERE = Path(__file__).parent


def counting(virtual_controller):
    return virtual_controller(str(HERE / "counting.mod"), cell=str(HERE / "counting.yaml"))


def test_a_part_is_counted_once(virtual_controller):
    controller = counting(virtual_controller)
    controller.signals["diPart"] = 1
    controller.run_for(10)
    assert controller.task("T_ROB1")["counting:parts"] == 1
    assert controller.signals["doTaken"] == 1


def test_the_answer_is_taken_back(virtual_controller):
    controller = counting(virtual_controller)
    for level in (1, 0):
        controller.signals["diPart"] = level
        controller.run_for(1)
    assert controller.signals["doTaken"] == 0


def test_nobody_brings_a_part(virtual_controller):
    controller = counting(virtual_controller)
    controller.run_for(31)
    assert "ERR_WAIT_MAXTIME" in str(controller.task("T_ROB1").fault)
