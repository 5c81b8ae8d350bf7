"""Event routines (CAB_EXEC_HOOKS), and starting and stopping around them."""

from dataclasses import replace

import pytest

from rapidgen.controller import VirtualController
from rapidgen.runtime.switches import Switches
from rapidgen.system.model import EventRoutine, System
from tests.runtime.booting import system

EVENTS = ("POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET")
ROUTINES = "".join(
    f'PROC on_{e}()\n TPWrite "{e} " + ValToStr(EventType()) + ValToStr(ExecLevel());\nENDPROC\n'
    for e in EVENTS
)
MAIN = 'PROC main()\n TPWrite "main";\n WaitTime 1;\n TPWrite "end";\n WaitTime 100;\nENDPROC\n'


def boot(*texts: str, events=None, specs=None, **options):
    """A controller whose tasks T1, T2... hook every event, and what TPWrite prints."""
    tasks = {f"T{i}": text for i, text in enumerate(texts, start=1)}
    base = system(tasks, **(specs or {}))
    hooks = tuple(
        EventRoutine(f"on_{event}", event, task) for task in tasks for event in events or EVENTS
    )
    controller = VirtualController(replace(base, events=hooks), autostart=False, **options)
    printed: list[str] = []
    controller.operator.subscribe(lambda _, text: printed.append(text))
    return controller, printed


def test_stop_and_restart() -> None:
    """CAB_EXEC_HOOKS [code]; numbers of EventType and ExecLevel [DB]."""
    controller, printed = boot(ROUTINES + MAIN)
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.run_for(1)
        assert printed == ["POWER_ON 12", "START 22", "main", "STOP 32"]
        controller.start_program()
        controller.run_for(1.2)
        # The wait begins anew [S4 overview 5-23].
        assert printed[4:] == ["RESTART 52", "end"]


def test_power_on_needs_no_start() -> None:
    controller, printed = boot(ROUTINES + MAIN)
    with controller:
        controller.run_for(1)
        assert printed == ["POWER_ON 12"]
        assert controller.task("T1").state == "ready"
        controller.start_program()
        controller.run_for(0.1)
        assert printed == ["POWER_ON 12", "START 22", "main"]


def test_what_power_on_stored_is_there_at_start() -> None:
    text = (
        "VAR num v := 0;\nPROC on_POWER_ON()\n v := 5;\nENDPROC\n"
        "PROC main()\n TPWrite ValToStr(v);\nENDPROC"
    )
    controller, printed = boot(text, events=("POWER_ON",), cycle="once")
    with controller:
        controller.run_for(1)
        controller.start_program()
        controller.run_for(1)
        assert printed == ["5"]


@pytest.mark.parametrize("run", [True, False])
def test_emergency_stop_is_a_quick_stop(run: bool) -> None:
    """[mem], switch e_stop_routines"""
    controller, printed = boot(ROUTINES + MAIN, dialect=Switches(e_stop_routines=run))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.perform("e-stop")
        controller.run_for(1)
        assert printed[3:] == (["QSTOP 42"] if run else [])
        # It stands already: a second stop is no event.
        controller.stop_program()
        controller.run_for(1)
        assert len(printed) == 3 + run


@pytest.mark.parametrize("statement", ["Stop;", "Break;"])
def test_stop_from_inside(statement: str) -> None:
    """Stop runs the STOP routines of all NORMAL tasks [mem]; the next start goes on behind it
    [S4 2-Stop-1, 2-Break-1]."""
    main = f'PROC main()\n {statement}\n TPWrite "on";\n WaitTime 9;\nENDPROC\n'
    other = ROUTINES.replace('TPWrite "', 'TPWrite "other ') + "PROC main()\n WaitTime 9;\nENDPROC"
    controller, printed = boot(ROUTINES + main, other, events=("STOP", "RESTART"))
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert sorted(printed) == ["STOP 32", "other STOP 32"]
        controller.start_program()
        controller.run_for(1)
        assert sorted(printed[2:]) == ["RESTART 52", "on", "other RESTART 52"]


@pytest.mark.parametrize("stops", [False, True])
def test_stop_in_an_event_routine_leaves_it(stops: bool) -> None:
    """It begins anew at the next event [S4 2-Stop-1]; STOP routines are a switch [mem]."""
    text = (
        'PROC on_START()\n TPWrite "begun";\n Stop;\n TPWrite "never";\nENDPROC\n'
        'PROC on_STOP()\n TPWrite "stop";\nENDPROC\nPROC main()\n TPWrite "main";\nENDPROC'
    )
    dialect = Switches(event_stops=stops)
    controller, printed = boot(text, events=("START", "STOP"), cycle="once", dialect=dialect)
    with controller:
        controller.start_program()
        controller.run_for(1)
        seen = ["begun", "stop"] if stops else ["begun"]
        assert (printed, controller.task("T1").state) == (seen, "stopped")
        controller.start_program()
        controller.run_for(1)
        assert printed == [*seen, "main"]


def test_a_start_waits_for_the_stop_routine() -> None:
    text = (
        'PROC on_STOP()\n WaitTime 1;\n TPWrite "stopped";\nENDPROC\n'
        'PROC on_RESTART()\n TPWrite "again";\nENDPROC\n'
        'PROC main()\n WaitTime 0.7;\n TPWrite "main";\n WaitTime 9;\nENDPROC'
    )
    controller, printed = boot(text, events=("STOP", "RESTART"))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.run_for(0.2)
        controller.start_program()
        controller.run_for(0.5)
        assert printed == []
        controller.run_for(2)
        assert printed == ["stopped", "again", "main"]


def test_a_stop_during_the_stop_routine_is_a_stop_of_what_was_started_meanwhile() -> None:
    text = (
        'PROC on_STOP()\n WaitTime 1;\n TPWrite "stopped";\nENDPROC\n'
        'PROC main()\n WaitTime 0.7;\n TPWrite "main";\nENDPROC'
    )
    controller, printed = boot(text, events=("STOP",))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.run_for(0.2)
        controller.start_program()
        controller.run_for(0.2)
        controller.stop_program()
        controller.run_for(5)
        assert printed == ["stopped", "stopped"]
        assert controller.task("T1").state == "stopped"


def test_interrupts_are_lost_in_a_stop_routine_and_wait_in_a_start_routine() -> None:
    """[S4 overview 4-39]"""
    text = """
  VAR intnum i;
  PERS num p := 0;
  PROC on_STOP()
    p := p + 1;
    WaitTime 0.1;
  ENDPROC
  PROC on_RESTART()
    p := p + 1;
    WaitTime 0.1;
    TPWrite "restart";
  ENDPROC
  TRAP t
    TPWrite "trap";
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    WaitTime 1;
    TPWrite "main";
    WaitTime 9;
  ENDPROC
"""
    controller, printed = boot(text, events=("STOP", "RESTART"))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.run_for(1)
        assert (printed, controller.task("T1")["p"]) == ([], 1)
        controller.start_program()
        controller.run_for(1.3)
        assert printed == ["restart", "trap", "main"]


def test_an_error_in_an_event_routine_is_not_for_the_handlers_of_the_program() -> None:
    """Levels are left by long jumps only [K §7.2]."""
    text = (
        "PROC on_STOP()\n RAISE 7;\nERROR\n RAISE;\nENDPROC\n"
        "PROC main()\n WaitTime 9;\nERROR\n TPWrite ValToStr(ERRNO);\n TRYNEXT;\nENDPROC"
    )
    controller, printed = boot(text, events=("STOP",))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.run_for(0.1)
        assert (printed, controller.task("T1").state) == ([], "error")
    jump = text.replace("ERROR\n TPW", "ERROR (7)\n TPW")
    controller, printed = boot(jump, events=("STOP",))
    with controller:
        controller.start_program()
        controller.run_for(0.5)
        controller.stop_program()
        controller.start_program()
        controller.run_for(0.1)
        assert printed == ["7"]


@pytest.mark.parametrize("run", [True, False])
def test_a_fault_stops_the_other_normal_tasks(run: bool) -> None:
    """Their STOP routines run; its own is a switch, fault_routines [mem]."""
    faulty = ROUTINES + "PROC main()\n WaitTime 1;\n RAISE 7;\nENDPROC"
    other = ROUTINES.replace('TPWrite "', 'TPWrite "other ') + "PROC main()\n WaitTime 9;\nENDPROC"
    controller, printed = boot(
        faulty, other, events=("STOP", "QSTOP"), dialect=Switches(fault_routines=run)
    )
    with controller:
        controller.start_program()
        controller.run_for(2)
        assert sorted(printed) == ["STOP 32"] * run + ["other STOP 32"]
        assert [t.state for t in controller.tasks.values()] == ["error", "stopped"]


def test_background_tasks_run_no_stop_routine() -> None:
    controller, printed = boot(ROUTINES + MAIN, specs={"T1": {"type": "SEMISTATIC"}})
    with controller:
        controller.start_program()
        controller.run_for(0.1)
        del printed[:]
        controller.stop_program()
        controller.run_for(0.1)
        assert printed == []


def test_power_loss() -> None:
    """No STOP routine; POWER_ON when it is back; SEMISTATIC begins anew, NORMAL waits for a
    start [manual IPACV]."""
    background = ROUTINES.replace('TPWrite "', 'TPWrite "b ') + "PROC main()\n WaitTime 9;\nENDPROC"
    controller, printed = boot(ROUTINES + MAIN, background, specs={"T2": {"type": "SEMISTATIC"}})
    with controller:
        controller.start_program()
        controller.run_for(0.1)
        del printed[:]
        controller.perform("power-loss")
        controller.run_for(0.5)
        assert printed == ["POWER_ON 12", "b POWER_ON 12", "b RESET 62", "b START 22"]
        assert [t.state for t in controller.tasks.values()] == ["stopped", "running"]


def test_power_loss_before_the_first_statement() -> None:
    controller, printed = boot(
        "PROC on_START()\nENDPROC\nPROC main()\n WaitTime 9;\nENDPROC",
        'PROC on_START()\nENDPROC\nPROC main()\n TPWrite "b main";\n WaitTime 9;\nENDPROC',
        events=("START",),
        specs={"T2": {"type": "SEMISTATIC"}},
    )
    with controller:
        controller.start_program()
        controller.perform("power-loss")
        controller.run_for(0.5)
        assert printed == ["b main"]
        assert [t.state for t in controller.tasks.values()] == ["stopped", "running"]


def test_start_right_behind_pp_to_main() -> None:
    text = (
        'PROC main()\n TPWrite "main " + ValToStr(n);\n n := 2;\n inner;\nENDPROC\n'
        'PROC inner()\n WaitTime 9;\nUNDO\n WaitTime 0.5;\n TPWrite "undo";\nENDPROC'
    )
    controller, printed = boot(
        "VAR num n := 1;\n" + ROUTINES + text, events=("RESET", "START", "STOP")
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        controller.stop_program()
        controller.pp_to_main()
        controller.start_program()
        controller.run_for(1)
        assert printed == ["START 22", "main 1", "undo", "RESET 62", "START 22", "main 1"]
        assert controller.task("T1").state == "running"


def test_a_stop_takes_a_start_behind_pp_to_main_back() -> None:
    controller, printed = boot('PROC main()\n TPWrite "main";\n WaitTime 9;\nENDPROC')
    with controller:
        controller.start_program()
        controller.run_for(0.1)
        controller.pp_to_main()
        controller.start_program()
        controller.stop_program()
        controller.run_for(1)
        assert (printed, controller.task("T1").state) == (["main"], "ready")


def test_start_main_by_a_signal() -> None:
    from rapidgen.system.model import SignalSpec, SystemInput

    base = system({"T1": MAIN}, signals=(SignalSpec("di", "DI"),))
    whole = replace(base, inputs=(SystemInput("StartMain", "di"),))
    printed: list[str] = []
    with VirtualController(whole) as controller:
        controller.operator.subscribe(lambda _, text: printed.append(text))
        controller.run_for(0.5)
        controller.signals["di"] = 1
        controller.run_for(0.5)
        assert printed == ["main", "main"]


def test_routines_of_all_motion_tasks() -> None:
    """-AllMotionTask [code]"""
    base = system({"T1": MAIN, "T2": ROUTINES + MAIN}, T2={"motion": True})
    hooks = (EventRoutine("on_START", "Start", "", True), EventRoutine("nobody", "START", "T2"))
    printed: list[str] = []
    with VirtualController(System("s", base.tasks, events=hooks), autostart=False) as controller:
        controller.operator.subscribe(lambda task, text: printed.append(f"{task} {text}"))
        controller.start_program()
        controller.run_for(0.1)
    assert printed == ["T1 main", "T2 START 22", "T2 main"]
