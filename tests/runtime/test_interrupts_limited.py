"""When traps come, how many may wait, and which survive a stop."""

import pytest

from tests.runtime.booting import boot


def test_a_trap_comes_2_to_30_ms_later() -> None:
    """[K §8.1]"""
    text = """
  VAR intnum i;
  PERS num p := 0;
  VAR clock c;
  PERS num least := 99;
  PERS num most := 0;
  TRAP t
    VAR num seconds;
    seconds := ClkRead(c \\HighRes);
    IF seconds < least least := seconds;
    IF seconds > most most := seconds;
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    FOR k FROM 1 TO 100 DO
      ClkReset c;
      ClkStart c;
      p := p + 1;
      WaitTime 0.1;
      ClkStop c;
    ENDFOR
  ENDPROC
"""
    controller, _ = boot(text, cycle="once")
    with controller:
        controller.start_program()
        controller.run(max_time=60)
        least, most = controller.task("T1")["least"], controller.task("T1")["most"]
        assert 0.002 <= least < 0.005
        assert 0.025 < most < 0.0305


@pytest.mark.parametrize(("events", "state"), [(30, "running"), (31, "error")])
def test_a_queue_holds_30(events: int, state: str) -> None:
    """[S4 datasys 1-intnum-2]"""
    text = (
        "VAR intnum i;\nPERS num p := 0;\nTRAP t\nENDTRAP\nPROC main()\n CONNECT i WITH t;\n"
        f" IPers p, i;\n IDisable;\n FOR k FROM 1 TO {events} DO\n p := p + 1;\n ENDFOR\n"
        " WaitTime 1;\n IEnable;\n WaitTime 1;\nENDPROC"
    )
    controller, _ = boot(text, cycle="once")
    with controller:
        controller.start_program()
        controller.run_for(1.5)
        assert controller.task("T1").state == state


@pytest.mark.parametrize(("order", "kept"), [("\\Single,", False), ("\\SingleSafe,", True)])
def test_safe_orders_survive_a_stop(order: str, kept: bool) -> None:
    """[S4 overview 4-39]; \\SingleSafe waits until the program goes on (RobotWare manuals)."""
    text = (
        'VAR intnum i;\nPERS num p := 0;\nTRAP t\n TPWrite "trap";\nENDTRAP\nPROC main()\n'
        f" CONNECT i WITH t;\n IPers {order} p, i;\n WaitTime 5;\nENDPROC"
    )
    controller, printed = boot(text, cycle="once")
    with controller:
        controller.start_program()
        controller.run_for(1)
        controller.stop_program()
        controller.run_for(1)
        controller.task("T1")["p"] = 1
        controller.run_for(1)
        assert printed == []
        controller.start_program()
        controller.run_for(1)
        assert printed == ["trap"] * kept
