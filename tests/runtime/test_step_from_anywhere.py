"""A step is possible at any place, and a refusal has its reason."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.runtime.task.pointer import CannotStep

PROGRAM = """MODULE m
  PERS num n := 0;
  PROC main()
    WHILE TRUE DO
      n := n + 1;
      n := n + 10;
      WaitTime 0.5;
      n := n + 100;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def controller(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(PROGRAM)
    with VirtualController.from_files([path]) as controller:
        yield controller


def stepped(controller, count=3):
    """Lines before which the task stands after each of some steps."""
    task = controller.task("T_ROB1")
    lines = []
    for _ in range(count):
        task.step()
        controller.run_for(1.0)
        assert task.state == "stopped"
        lines.append(task.place.span.line)
    return lines


def test_after_a_stop_in_a_wait(controller):
    controller.run_for(0.1)
    controller.stop_program()
    assert stepped(controller) == [8, 4, 5]


def test_after_a_stop_before_the_first_statement(controller):
    controller.stop_program()
    controller.run_for(0.1)
    assert stepped(controller) == [5, 6, 7]


def test_right_after_pp_to_main(controller):
    """Routines are still being left then: the step waits for it."""
    controller.run_for(0.1)
    controller.stop_program()
    controller.pp_to_main()
    assert stepped(controller) == [5, 6, 7]


def test_a_running_program_is_to_be_stopped_first(controller):
    controller.run_for(0.1)
    with pytest.raises(CannotStep, match="stop it first"):
        controller.task("T_ROB1").step()


LOOP = """MODULE m
  PERS num n := 0;
  PROC main()
    FOR i FROM 1 TO 20000 DO
      n := i;
    ENDFOR
    n := -1;
  ENDPROC
ENDMODULE
"""


def test_in_the_pass_of_a_loop_after_a_stop_between_statements(tmp_path):
    """A FOR that is stopped between two passes goes on with the next one."""
    path = tmp_path / "m.mod"
    path.write_text(LOOP)
    with VirtualController.from_files([path]) as controller:
        controller.run_for(0.1)
        before = controller.task("T_ROB1")["m:n"]
        assert before > 100
        controller.stop_program()
        controller.run_for(0.1)
        stepped(controller, 2)
        assert before <= controller.task("T_ROB1")["m:n"] <= before + 3
