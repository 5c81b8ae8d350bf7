"""Statement by statement [K §6, S4 overview 4-39 to 4-42]."""

from dataclasses import replace

import pytest

from rapidgen.controller import VirtualController
from rapidgen.runtime.switches import Switches
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.system.model import EventRoutine, ModuleFile, System, TaskSpec
from tests.runtime.booting import boot, system


class Stepper:
    """A program and its task."""

    def __init__(self, text: str, **options: object) -> None:
        self.controller, self.printed = boot(text, **{"cycle": "once", **options})
        self.task = self.controller.task("T1")

    def __enter__(self) -> "Stepper":
        return self

    def __exit__(self, *_: object) -> None:
        self.controller.close()

    def step(self, **how: bool) -> str:
        """One step; the line where the task stands then, or its state."""
        self.task.step(**how)
        self.controller.run_until(lambda: self.task.state != "running", timeout=30)
        self.controller.run_for(0.1)
        return self.line() if self.task.state == "stopped" else self.task.state

    def line(self) -> str:
        place = self.task.place
        assert place is not None
        return f"{place.routine} {place.span.line}"


PROGRAM = """
  PROC main()
    VAR num n;
    n := 1;
    FOR i FROM 1 TO 2 DO
      n := n + i;
      IF n > 3 THEN
        TPWrite "more";
      ENDIF
    ENDFOR
    inner n;
    TPWrite ValToStr(n);
  ENDPROC
  PROC inner(num a)
    TPWrite "inner";
    WaitTime 1;
  ENDPROC
"""


def test_forward() -> None:
    with Stepper(PROGRAM) as s:
        lines = [s.step() for _ in range(13)]
        assert lines == [
            "main 6", "main 7", "main 8", "main 7", "main 8", "main 9", "main 12",
            "inner 16", "inner 17", "main 13", "finished",
            "main 6", "main 7",
        ]  # fmt: skip
        assert s.printed == ["more", "inner", "4"]


def test_over_a_call() -> None:
    with Stepper(PROGRAM) as s:
        lines = [s.step(over=True) for _ in range(9)]
        assert lines[6:] == ["main 12", "main 13", "finished"]


def test_from_where_a_running_program_was_stopped() -> None:
    with Stepper(PROGRAM) as s:
        s.controller.start_program()
        s.controller.run_for(0.5)
        with pytest.raises(CannotStep):
            s.task.step()
        s.controller.stop_program()
        s.controller.run_for(0.1)
        # The wait begins anew.
        assert s.line() == "inner 17"
        assert s.step() == "main 13"
        assert s.step() == "finished"
        assert s.printed == ["more", "inner", "4"]


def test_start_goes_on_behind_a_step() -> None:
    with Stepper(PROGRAM) as s:
        for _ in range(4):
            s.step()
        s.controller.start_program()
        s.controller.run_for(3)
        assert (s.task.state, s.printed) == ("finished", ["more", "inner", "4"])


def test_steps_take_the_time_of_the_program() -> None:
    text = "PROC main()\n WaitTime 1;\n WaitTime 0.5;\nENDPROC"
    times = []
    for stepwise in (False, True):
        with Stepper(text, accounting="statement") as s:
            if not stepwise:
                s.controller.start_program()
            while s.task.state != "finished":
                if stepwise and s.task.state != "running":
                    s.task.step()
                before = s.controller.now
                s.controller.run_until(lambda s=s: s.task.state != "running")
                times.append(s.controller.now - before)
    assert times[0] == pytest.approx(1.50001, abs=2e-5)
    assert sum(times[1:]) == pytest.approx(times[0], abs=3e-5)


def test_no_interrupts() -> None:
    """They are lost [S4 overview 4-39]."""
    text = """
  VAR intnum i;
  PERS num p := 0;
  TRAP t
    TPWrite "trap";
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    p := 1;
    WaitTime 1;
    p := 2;
    WaitTime 1;
  ENDPROC
"""
    with Stepper(text) as s:
        for _ in range(4):
            s.step()
        assert s.printed == []
        s.controller.start_program()
        s.controller.run_for(3)
        assert s.printed == ["trap"]


def test_nostepin_runs_as_a_whole() -> None:
    """[S4 overview 4-8, K §9.1]"""
    hidden = (
        'MODULE h(NOSTEPIN)\nPROC helper()\n TPWrite "1";\n back;\n TPWrite "2";\nENDPROC\n'
        "ENDMODULE"
    )
    user = (
        'MODULE m\nPROC main()\n helper;\n TPWrite "3";\nENDPROC\n'
        'PROC back()\n TPWrite "b";\nENDPROC\nENDMODULE'
    )
    files = tuple(
        ModuleFile(name, name, text.encode()) for name, text in (("h", hidden), ("m", user))
    )
    base = System("s", (TaskSpec("T1", modules=files),))
    with VirtualController(base, autostart=False, cycle="once") as controller:
        seen = []
        task = controller.task("T1")
        while task.state != "finished":
            task.step()
            controller.run_for(1)
            if task.state == "stopped":
                seen.append(task.place.routine)
        assert seen == ["back", "main"]


def test_step_event() -> None:
    base = system({"T1": "PROC on()\n TPWrite ValToStr(EventType());\nENDPROC\n" + PROGRAM})
    whole = replace(base, events=(EventRoutine("on", "STEP", "T1"),))
    printed: list[str] = []
    with VirtualController(whole, autostart=False, cycle="once") as controller:
        controller.operator.subscribe(lambda _, text: printed.append(text))
        for _ in range(3):
            controller.task("T1").step()
            controller.run_for(1)
    assert printed == ["7", "7", "7"]


BACK = """
  VAR num g := 0;
  VAR num args := 0;
  VAR intnum i;
  TRAP t
  ENDTRAP
  PROC main()
    VAR num n := 1;
    n := 2;
    CONNECT i WITH t;
    does value(n), g;
    empty;
    plain value(5);
    IF n = 2 THEN
      n := 3;
      empty;
    ENDIF
    TPWrite "end";
    TPWrite "really";
  ENDPROC
  FUNC num value(num v)
    args := args + 1;
    RETURN v;
  ENDFUNC
  PROC does(num a, INOUT num b)
    VAR num k := 10;
    b := b + a;
    TPWrite "does";
  BACKWARD
    TPWrite "does back " + ValToStr(k);
    b := b - a;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC empty()
    TPWrite "empty";
  BACKWARD
  ENDPROC
  PROC plain(num a)
    TPWrite "plain";
  ENDPROC
"""


def refusals(s: Stepper) -> list[str]:
    return [e.texts[0] for e in s.controller.log if e.code == 40_700]


def test_backward() -> None:
    """Assignments and CONNECT: nothing; a call: its handler; back out of a list: not [K §6]."""
    with Stepper(BACK) as s:
        for _ in range(4):
            s.step(over=True)
        assert s.line() == "main 14"
        assert s.task["g"] == 2
        s.printed.clear()
        assert s.step(back=True) == "main 13"
        assert s.printed == []
        assert s.step(back=True) == "main 12"
        assert (s.printed, s.task["g"], s.task["args"]) == (["does back 10"], 0, 2)
        assert s.step(back=True) == "main 11"
        assert s.step(back=True) == "main 10"
        assert refusals(s) == []
        assert s.step(back=True) == "main 10"
        assert refusals(s) == ["it stands at the top of a statement list"]
        # CONNECT was executed before: it is not undone by going back.
        assert s.step() == "main 11"


def test_what_cannot_be_executed_backward() -> None:
    """No handler: refused, with the arguments evaluated [K §6]; nothing but simple statements."""
    with Stepper(BACK) as s:
        for _ in range(5):
            s.step(over=True)
        assert s.line() == "main 15"
        args = s.task["args"]
        assert s.step(back=True) == "main 15"
        assert refusals(s) == ["plain has no BACKWARD handler"]
        assert s.task["args"] == args + 1
        for _ in range(3):
            s.step(over=True)
        assert s.line() == "main 19"
        assert s.step(back=True) == "main 19"
        assert refusals(s)[1:] == ["the statement before cannot be executed backward"]
        s.step()
        assert s.step(back=True) == "main 20"
        assert refusals(s)[2:] == ["TPWrite is not executed backward"]
        assert s.step() == "finished"


def test_inside_of_an_if() -> None:
    with Stepper(BACK) as s:
        for _ in range(7):
            s.step(over=True)
        assert s.line() == "main 17"
        assert s.step(back=True) == "main 16"
        assert s.step(back=True) == "main 16"
        assert s.step() == "main 17"


def test_an_error_in_a_backward_handler_is_nobodys() -> None:
    """[K §7.1]"""
    text = """
  PROC main()
    work;
    TPWrite "next";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
  PROC work()
    TPWrite "work";
  BACKWARD
    RAISE 7;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
"""
    with Stepper(text) as s:
        s.step(over=True)
        assert s.step(back=True) == "error"
        assert s.printed == ["work"]
        assert s.task.fault is not None
        s.controller.start_program()
        s.controller.run_for(1)
        assert s.printed == ["work", "next"]


def test_after_an_error() -> None:
    text = (
        "PERS num z := 0;\nPROC main()\n VAR num n;\n n := 5;\n n := n / z;\n"
        " TPWrite ValToStr(n);\nENDPROC"
    )
    with Stepper(text) as s:
        s.step()
        assert s.step() == "error"
        assert s.step(back=True) == "main 5"
        s.task["z"] = 2
        assert [s.step(), s.step(), s.step()] == ["main 6", "main 7", "finished"]
        assert s.printed == ["2.5"]


def test_why_not() -> None:
    text = "PROC main()\n RAISE 5;\nERROR\n WaitTime 5;\n TRYNEXT;\nENDPROC"
    with Stepper(text) as s:
        s.controller.perform("e-stop")
        with pytest.raises(CannotStep, match="emergency"):
            s.step()
        s.controller.perform("reset-e-stop")
        s.controller.perform("motors-on")
        with pytest.raises(CannotStep):
            s.step(back=True)
        s.controller.start_program()
        s.controller.run_for(1)
        s.controller.stop_program()
        s.controller.run_for(1)
        with pytest.raises(CannotStep, match="handler"):
            s.step()
        s.controller.start_program()
        s.controller.run_for(9)
        assert s.task.state == "finished"


def test_a_move_ends_before_the_step_does() -> None:
    """[mem] each step is a stop point"""
    from rapidgen.config import load_config

    text = (
        "CONST jointtarget a := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "CONST jointtarget b := [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "PROC main()\n MoveAbsJ a, v1000, z50, tool0;\n MoveAbsJ b, v1000, z50, tool0;\nENDPROC"
    )
    options = {"robots": load_config("irb120").groups, "specs": {"T1": {"motion": True}}}
    with Stepper(text, **options) as s:
        s.step()
        group = s.controller.motion.group("rob1")
        assert group.positions()[0] == pytest.approx(0.349066, abs=1e-4)
        s.controller.run_for(1)
        assert group.is_standing
        s.step()
        s.controller.run_for(3)
        assert group.positions()[0] == pytest.approx(0, abs=1e-4)


def test_trigg_in_a_step_sets_its_signal_and_runs_no_trap() -> None:
    """[S4 2-TriggL-3]"""
    from rapidgen.config import load_config
    from rapidgen.system.model import SignalSpec

    text = (
        "CONST robtarget a := [[350,0,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "CONST robtarget b := [[350,150,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "VAR triggdata io;\nVAR triggdata int;\nVAR intnum i;\n"
        'TRAP t\n TPWrite "trap";\nENDTRAP\n'
        "PROC main()\n CONNECT i WITH t;\n TriggInt int, 50, i;\n"
        " TriggIO io, 50 \\DOp:=lamp, 1;\n MoveJ a, v1000, fine, tool0;\n"
        " TriggL b, v200, io \\T2:=int, fine, tool0;\n WaitTime 1;\nENDPROC"
    )
    options = {
        "robots": load_config("irb120").groups,
        "specs": {"T1": {"motion": True}},
        "signals": (SignalSpec("lamp", "DO"),),
    }
    with Stepper(text, **options) as s:
        for _ in range(4):
            s.step()
        assert s.controller.signals["lamp"] == 0
        assert s.step() == "main 16"
        assert (s.controller.signals["lamp"], s.printed) == (1, [])
    with Stepper(text, **options) as s:
        s.controller.start_program()
        s.controller.run_for(9)
        assert (s.controller.signals["lamp"], s.printed) == (1, ["trap"])


def test_a_search_without_a_hit_stops_a_step() -> None:
    """[S4 2-SearchL-5, "Instruction forward"]: the program stops; no handler gets the error."""
    from rapidgen.config import load_config
    from rapidgen.system.model import SignalSpec

    text = (
        "CONST robtarget a := [[350,0,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "CONST robtarget b := [[350,50,450],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "VAR robtarget found;\n"
        "PROC main()\n MoveJ a, v1000, fine, tool0;\n"
        " SearchL \\Stop, sensor, found, b, v200, tool0;\n"
        'ERROR\n TPWrite "handled";\n TRYNEXT;\nENDPROC'
    )
    options = {
        "robots": load_config("irb120").groups,
        "specs": {"T1": {"motion": True}},
        "signals": (SignalSpec("sensor", "DI"),),
    }
    with Stepper(text, **options) as s:
        s.step()
        assert s.step() == "error"
        assert (s.task.fault.event, s.printed) == (49_906, [])
    with Stepper(text, **options) as s:
        s.controller.start_program()
        s.controller.run_for(9)
        assert s.printed == ["handled"]


WAY = """
  CONST robtarget a := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home, v1000, z50, tool0;
    MoveL Offs(a,0,100,0), v500, z20, tool0;
    MoveC Offs(a,50,150,0), Offs(a,0,200,0), v500, z20, tool0;
    MoveJ Offs(a,-50,0,-50), v1000, z50, tool0;
    WaitTime 1;
  ENDPROC
"""


def moving(text: str, **options: object) -> Stepper:
    """A stepper with an IRB 120."""
    from rapidgen.config import load_config

    robots = load_config("irb120").groups
    return Stepper(text, robots=robots, specs={"T1": {"motion": True}}, **options)


def tcp(s: Stepper) -> tuple[float, ...]:
    """mm"""
    group = s.controller.motion.group("rob1")
    return tuple(1000 * v for v in group.geometry().forward(group.positions())[0])


def test_moves_are_driven_back_on_their_way() -> None:
    """[S4 2-SearchL-6] backward a move carries out the movement, with the shape it has."""
    with moving(WAY) as s:
        group = s.controller.motion.group("rob1")
        stood = [group.positions()]
        for _ in range(4):
            s.step()
            stood.append(group.positions())
        assert s.line() == "main 10"
        ways = []
        for k in (3, 2, 1, 0):
            place: list[tuple[float, ...]] = []
            s.task.step(back=True)
            while s.task.state == "running":
                s.controller.run_for(0.01)
                place.append(tcp(s))
            assert group.positions() == pytest.approx(stood[k], abs=1e-6)
            assert s.line() == f"main {6 + k}"
            ways.append(place)
        assert refusals(s) == []
        # The circle through (50, 150) about (0, 150), and the line with x and z as they were.
        for x, y, _ in ways[1]:
            assert (x - 364.354) ** 2 + (y - 150) ** 2 == pytest.approx(50**2, rel=1e-2)
        for x, _, z in ways[2]:
            assert (x, z) == pytest.approx((364.354, 594), abs=0.05)
        assert s.step() == "main 7"
        assert group.positions() == pytest.approx(stood[1], abs=1e-6)


def test_a_move_that_was_not_stepped_is_not_driven_back() -> None:
    with moving(WAY) as s:
        s.controller.start_program()
        s.controller.run_until(lambda: s.task.place is not None and s.line() == "main 10")
        s.controller.stop_program()
        s.controller.run_for(2)
        before = tcp(s)
        assert s.step(back=True) == "main 10"
        assert refusals(s)[0].startswith("MoveJ: where it began is not known")
        assert tcp(s) == before


def test_a_move_is_not_driven_back_from_elsewhere() -> None:
    with moving(WAY) as s:
        for _ in range(2):
            s.step()
        group = s.controller.motion.group("rob1")
        group.jog(tuple(v + 0.01 for v in group.positions()))
        before = group.positions()
        assert s.step(back=True) == "main 8"
        assert refusals(s)[0].startswith("MoveL: where it began is not known")
        assert group.positions() == before


def test_moves_are_not_driven_back_by_the_other_dialect() -> None:
    with moving(WAY, dialect=Switches(moves_back=False)) as s:
        for _ in range(2):
            s.step()
        before = tcp(s)
        assert s.step(back=True) == "main 8"
        assert refusals(s) == ["MoveL is not executed backward"]
        assert tcp(s) == before


def test_events_of_a_move_are_not_repeated_backward() -> None:
    """[S4 2-TriggL] "no trigger activities at all are carried out" """
    from rapidgen.system.model import SignalSpec

    text = WAY.replace(
        "MoveL Offs(a,0,100,0), v500, z20, tool0",
        "MoveLDO Offs(a,0,100,0), v500, z20, tool0, lamp, 1",
    )
    with moving(text, signals=(SignalSpec("lamp", "DO"),)) as s:
        for _ in range(2):
            s.step()
        assert s.controller.signals["lamp"] == 1
        s.controller.signals["lamp"] = 0
        assert s.step(back=True) == "main 7"
        assert s.controller.signals["lamp"] == 0
