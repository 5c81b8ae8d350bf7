"""Tracers of statements, and the duration of tracing."""

import pytest

from rapidgen.controller import VirtualController

PROGRAM = """MODULE m
  PERS num total := 0;
  PROC main()
    WHILE TRUE DO
      total := total + 1;
      WaitTime 1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
ADDS = 5


@pytest.fixture
def controller(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(PROGRAM)
    with VirtualController.from_files([path], tracing=True) as result:
        yield result


def hears(controller, *, enough=lambda line: False):
    lines = []

    def statement(task, routine, node):
        lines.append(routine.module.tree.source.line(node.first))
        return enough(lines[-1])

    controller.statements.listen(statement)
    return lines


def test_tracer_can_drop_a_statement(controller):
    received = hears(controller, enough=lambda line: line == ADDS)
    controller.run_for(10.5)
    assert received.count(ADDS) == 1
    assert received.count(ADDS + 1) == 11


def test_later_tracer_receives_all_statements(controller):
    first = hears(controller, enough=lambda line: True)
    controller.run_for(2.5)
    second = hears(controller)
    controller.run_for(2)
    assert second.count(ADDS) == 2
    third = hears(controller)
    controller.run_for(2)
    assert (second.count(ADDS), third.count(ADDS)) == (4, 2)
    assert len(first) < len(second) + 5


def test_action_waits_for_dropped_statement(controller):
    hears(controller, enough=lambda line: True)
    controller.run_for(2.5)
    came = []
    task = next(iter(controller.rapid_tasks))
    for count in (2, 4):
        controller.before_statement(task, "m", ADDS, count, lambda: came.append(controller.now))
    controller.run_for(10)
    assert came == pytest.approx([4, 6], abs=0.01)
    controller.before_statement(task, "m", ADDS, 1, lambda: came.append(controller.now))
    controller.run_for(10)
    assert came[2:] == pytest.approx([13], abs=0.01)
