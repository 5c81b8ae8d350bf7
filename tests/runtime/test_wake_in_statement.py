"""Events during a PERS access within a statement are handled."""

import pytest

from tests.runtime.booting import boot

WAITS = """
PERS num seconds := 1;
PERS bool go := FALSE;
VAR num n := 0;
VAR bool late;
PROC main()
{statement}
n := n + 1;
ENDPROC
"""
BUSY = """
PERS num seconds;
VAR num n := 0;
PROC main()
seconds := 1;
WHILE TRUE DO n := n + 1; ENDWHILE
ENDPROC
"""


@pytest.mark.parametrize(
    "statement", ["WaitTime seconds;", r"WaitUntil go \MaxTime:=seconds \TimeFlag:=late;"]
)
@pytest.mark.parametrize("ordered", ["stop", "PP to main"])
def test_stop_before_wait_is_handled(monkeypatch, statement, ordered):
    controller, _ = boot(
        WAITS.format(statement=statement),
        BUSY,
        schedule="random",
        switch_at_pers=True,
    )
    with controller:
        task, scheduler = controller.task("T1").rapid, controller.scheduler
        tossed = []

        def tosses() -> bool:
            if scheduler.running is task and not tossed:
                tossed.append(True)
                order = task.stop if ordered == "stop" else task.pp_to_main
                scheduler.at(scheduler.now - 1, order)
                return True
            return False

        monkeypatch.setattr(scheduler, "switches_here", tosses)
        task.start()
        controller.task("T2").rapid.start()
        controller.run_for(0.1)
        assert tossed
        if ordered == "PP to main":
            assert task.state == "ready"
            return
        assert task.state == "stopped"
        assert not task.events.due  # the routines of STOP had their turn
        task.start()
        controller.run_for(0.1)
        assert (task.state, task.held, task.events.due) == ("running", False, [])
        controller.run_for(1.5)
        assert controller.tasks["T1"]["m:n"] == 1
