"""Code of routines that the controllers of a process share."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.compiler import emitted, program
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec
from tests.runtime.booting import boot

KINDS = """
    RECORD pair
      num first;
      string second;
    ENDRECORD
    LOCAL VAR pair known := [1, "one"];
    LOCAL PERS num kept := 5;
    VAR num counted;
    VAR intnum watch;
    VAR bool trapped;
    VAR num wanted{3} := [1, 2, 3];

    TRAP changed
      trapped := TRUE;
    ENDTRAP
    PROC increase(VAR num value, INOUT num other, VAR pair whole)
      Incr value;
      other := other + value;
      whole.first := whole.first + 1;
    ENDPROC
    FUNC pair made(string text)
      CONST pair other := [7, "seven"];
      VAR pair result := [2, "two"];
      IF text = "other" RETURN other;
      result.second := text;
      RETURN result;
    ENDFUNC
    PROC main()
      VAR pair mine;
      VAR num third := 3;
      CONNECT watch WITH changed;
      IPers kept, watch;
      increase counted, kept, known;
      increase third, wanted{2}, mine;
      WaitTime 0.1;
      mine := made("other");
      mine.first := mine.first + 1;
      TPWrite mine.second + ValToStr(mine.first) + ValToStr(known) + ValToStr(made("mine"));
      TPWrite ValToStr(counted) + ValToStr(kept) + ValToStr(trapped) + ValToStr(wanted);
      TPWrite ValToStr(tool0.robhold) + ValToStr(ERR_DIVZERO);
      SetDO lamp, 1;
      %"last"% third;
    ENDPROC
    PROC last(num value)
      TPWrite ValToStr(10 / (value - value));
    ERROR (ERR_DIVZERO)
      TPWrite "handled";
      TRYNEXT;
    ENDPROC"""
PRINTED = ['seven8[2,"one"][2,"mine"]', "16TRUE[1,6,3]", "TRUE1053", "handled"]
DIVIDED = "PROC main()\nVAR num n := -7;\nTPWrite ValToStr(n DIV 2);\nENDPROC"


@pytest.fixture
def emissions(monkeypatch) -> list[str]:
    """Names of the routines that are emitted, beginning with none known."""
    emitted._known.cache_clear()
    result = []

    class Counted(program.RoutineCompiler):
        def compile(self):
            result.append(self.unit.routine.name)
            return super().compile()

    monkeypatch.setattr(program, "RoutineCompiler", Counted)
    return result


def _printed(*texts: str, **options) -> list[str]:
    controller, printed = boot(*texts, cycle="once", **options)
    with controller:
        controller.start_program()
        assert controller.run(max_time=10) == "finished"
    return printed


def test_a_second_controller_emits_nothing_and_behaves_as_the_first(emissions) -> None:
    lamp = (SignalSpec("lamp", "DO"),)
    one, printed = boot(KINDS, signals=lamp, cycle="once")
    with one:
        one.start_program()
        one.run(max_time=10)
        assert printed == PRINTED
        assert sorted(emissions) == ["changed", "increase", "last", "made", "main"]
        emissions.clear()
        other, printed = boot(KINDS, signals=lamp, cycle="once")
        with other:
            assert not other.io.signals["lamp"].value
            other.start_program()
            other.run(max_time=10)
            assert (emissions, printed) == ([], PRINTED)
            assert other.io.signals["lamp"].value
            space = other.rapid_tasks["T1"].program.space
            (module,) = other.rapid_tasks["T1"].program.modules.values()
            assert {v.module for v in space.values() if isinstance(v, Routine)} == {module}
            assert {v for v in space.values() if isinstance(v, LoadedModule)} == {module}
            # Each has values of its own.
            other.tasks["T1"]["counted"] = 9
            assert one.tasks["T1"]["counted"] == 1


def test_other_options_have_other_code() -> None:
    assert _printed(DIVIDED) == ["-3"]
    assert _printed(DIVIDED, dialect=Switches(integer_division="floor")) == ["-4"]
    assert _printed(DIVIDED) == ["-3"]


def _with_constant(value: int) -> list[str]:
    """Return what a program prints whose constant another module declares."""
    texts = ["PROC main()\nTPWrite ValToStr(given);\nENDPROC", f"CONST num given := {value};"]
    files = [
        ModuleFile(f"m{i}", f"m{i}.mod", f"MODULE m{i}\n{text}\nENDMODULE\n".encode())
        for i, text in enumerate(texts)
    ]
    printed: list[str] = []
    task = TaskSpec("T1", modules=tuple(files))
    with VirtualController(System("test", (task,)), autostart=False, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: printed.append(text))
        controller.start_program()
        controller.run(max_time=10)
    return printed


def test_code_depends_on_all_modules_of_a_task() -> None:
    assert [_with_constant(value) for value in (1, 2, 1)] == [["1"], ["2"], ["1"]]
