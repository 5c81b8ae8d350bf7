"""What survives a move of the program pointer, a service routine, a warm start
[S4 overview 4-24]."""

from copy import copy

import pytest

from rapidgen.config import load_config
from rapidgen.motion.modal import ModalSettings
from rapidgen.runtime.task.pointer import CannotStep
from tests.runtime.booting import boot

PROGRAM = """
  CONST num c := 1;
  VAR num v := 1;
  PERS num p := 1;
  PERS num bell := 0;
  VAR intnum i;
  VAR iodev f;
  TRAP t
    TPWrite "trap";
  ENDTRAP
  PROC main()
    VAR num own := 3;
    CONNECT i WITH t;
    IPers bell, i;
    Open "HOME:/x.txt", f \\Write;
    v := 2;
    p := 2;
    own := 4;
    WaitTime 5;
    TPWrite "behind " + show() + ValToStr(own);
    ring;
  ENDPROC
  PROC ring()
    bell := bell + 1;
    WaitTime 1;
    Write f, "x";
    TPWrite "written";
  ERROR
    TPWrite "closed";
    TRYNEXT;
  ENDPROC
  PROC routine()
    TPWrite "routine " + show();
    ring;
  ENDPROC
  PROC service()
    v := v + 10;
    TPWrite "service " + show() + ValToStr(ExecLevel()) + ValToStr(EventType());
  ENDPROC
  FUNC string show()
    RETURN ValToStr(c) + ValToStr(v) + ValToStr(p);
  ENDFUNC
"""


def stopped():
    """A program that stands in its wait of 5 s."""
    controller, printed = boot(PROGRAM, cycle="once")
    controller.start_program()
    controller.run_for(1)
    controller.stop_program()
    controller.run_for(0.1)
    return controller, controller.task("T1"), printed


def test_pp_to_a_routine() -> None:
    controller, task, printed = stopped()
    with controller:
        task.pp_to_routine("routine")
        controller.run_for(0.1)
        assert task.state == "ready"
        controller.start_program()
        controller.run_for(9)
        # Variables anew, persistents as they were, no interrupt, no open file.
        assert printed == ["routine 112", "closed", "written"]
        assert task.state == "finished"
        controller.start_program()
        controller.run_for(9)
        assert printed[3] == "behind 1224"
        with pytest.raises(CannotStep):
            task.pp_to_routine("nobody")


def test_pp_to_a_statement() -> None:
    controller, task, printed = stopped()
    with controller:
        with pytest.raises(CannotStep):
            task.pp_to_statement(3)
        assert task.place is not None
        here = task.place.span.line
        task.pp_to_statement(here + 1)
        controller.run_for(0.1)
        assert task.place.span.line == here + 1
        controller.start_program()
        controller.run_for(3)
        assert printed == ["behind 1224", "trap", "written"]


def test_a_service_routine_changes_nothing() -> None:
    controller, task, printed = stopped()
    with controller:
        task.call_service("service")
        controller.run_for(1)
        assert (printed, task.state) == (["service 112220"], "stopped")
        controller.start_program()
        controller.run_for(9)
        assert printed[1:] == ["behind 11224", "trap", "written"]
        task.call_service("service")
        controller.run_for(1)
        assert (printed[-1], task.state) == ("service 122220", "finished")
        controller.start_program()
        with pytest.raises(CannotStep):
            task.call_service("service")


def test_a_warm_start_keeps_data_and_interrupts() -> None:
    controller, task, printed = stopped()
    with controller:
        controller.perform("power-loss")
        controller.run_for(1)
        assert task.state == "stopped"
        controller.perform("motors-on")
        controller.start_program()
        controller.run_for(9)
        assert printed == ["behind 1224", "trap", "closed", "written"]


@pytest.mark.parametrize("move", ["routine", "statement"])
def test_the_path_is_gone(move: str) -> None:
    targets = "".join(
        f"CONST jointtarget {name} := [[{angle},0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        for name, angle in (("a", 60), ("b", -60))
    )
    text = (
        f"{targets}PROC main()\n VelSet 50, 1000;\n MoveAbsJ a, v200, fine, tool0;\n"
        " there;\nENDPROC\nPROC there()\n MoveAbsJ b, v1000, fine, tool0;\nENDPROC"
    )
    controller, _ = boot(
        text, robots=load_config("irb120").groups, specs={"T1": {"motion": True}}, cycle="once"
    )
    with controller:
        task, group = controller.task("T1"), controller.motion.group("rob1")
        controller.start_program()
        controller.run_for(1)
        controller.stop_program()
        controller.run_for(1)
        settings = copy(group.modal)
        assert settings != ModalSettings()
        assert 0.05 < group.positions()[0] < 1
        assert task.place is not None
        if move == "routine":
            task.pp_to_routine("there")
        else:
            task.pp_to_statement(task.place.span.line + 1)
        controller.start_program()
        highest = group.positions()[0]
        controller.run_for(0.05)
        while task.state == "running":
            controller.run_for(0.05)
            assert group.positions()[0] <= highest + 1e-6
        assert group.positions()[0] == pytest.approx(-1.0472, abs=1e-3)
        assert group.modal == settings
