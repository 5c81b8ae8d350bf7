"""Start after an error: the faulty statement is tried again [S4 overview 3-23]."""

import pytest

from rapidgen.runtime.switches import Switches
from tests.runtime.booting import boot
from tests.runtime.test_nesting import nested

DATA = "PERS num bad := {};\nVAR num waste;\nVAR num one{{1}};\n"
FAILS = (
    "PROC fails()\n waste := one{1 + bad};\nENDPROC\n"
    "FUNC num value(num v)\n waste := one{1 + bad};\n RETURN v;\nENDFUNC\n"
)


def made(text: str, *, mends: int = 1, **options: object):
    """A program in which `fails` and `value` fail while `bad` is not 0."""
    return boot(f"{DATA.format(mends)}{text}\n{FAILS}", cycle="once", **options)


def retried(text: str, *, mends: int = 1, **options: object) -> list[str]:
    """What a program prints, `-` for each stop; each start makes `bad` one less."""
    controller, printed = made(text, mends=mends, **options)
    with controller:
        task = controller.task("T1")
        controller.start_program()
        controller.run(max_time=10)
        while task.state == "error":
            assert task.fault is not None
            printed.append("-")
            task["bad"] = task["bad"] - 1
            assert controller.start_program()
            controller.run(max_time=10)
            assert len(printed) < 50
        assert task.state == "finished"
        assert task.fault is None
        return printed


def test_the_statement_is_tried_again_and_variables_are_kept() -> None:
    text = """
  VAR num global := 1;
  PROC main()
    VAR num n := 5;
    VAR pos p := [1,2,3];
    VAR num list{3} := [1,2,3];
    CONST num c := 4;
    n := 6;
    p.x := 7;
    list{2} := 8;
    global := 9;
    fails;
    TPWrite ValToStr(n) + ValToStr(p.x) + ValToStr(list{2}) + ValToStr(global) + ValToStr(c);
  ENDPROC
"""
    assert retried(text) == ["-", "67894"]
    assert retried(text, mends=3) == ["-", "-", "-", "67894"]


@pytest.mark.parametrize("kind", ["for", "while", "if", "test"])
@pytest.mark.parametrize("depth", [1, 3, 24])
def test_inside_of_anything(kind: str, depth: int) -> None:
    body = "fails; n := n + 1; TPWrite ValToStr(n);"
    text = f'PROC main()\n VAR num n := 0;\n{nested(kind, depth, body)}TPWrite "end";\nENDPROC'
    printed = retried(text)
    assert printed[1:] == ["1", "end"]


def test_loops_go_on_behind_the_pass() -> None:
    text = """
  PROC main()
    VAR num w := 0;
    FOR i FROM 1 TO 3 DO
      FOR j FROM 3 TO 1 STEP -1 DO
        IF i = 2 AND j = 2 fails;
        TPWrite ValToStr(i) + ValToStr(j);
      ENDFOR
      TPWrite "i";
    ENDFOR
    FOR i FROM 0.5 TO 2 DO
      WHILE w < i DO
        w := w + 1;
        IF i = 1.5 fails;
        TPWrite "w" + ValToStr(w);
      ENDWHILE
    ENDFOR
    TPWrite "end";
  ENDPROC
"""
    assert " ".join(retried(text)) == "13 12 11 i 23 - 22 21 i 33 32 31 i w1 w2 end"
    assert " ".join(retried(text, mends=2)) == "13 12 11 i 23 - - 22 21 i 33 32 31 i w1 w2 end"


def test_every_routine_of_the_stack_goes_on() -> None:
    text = """
  PROC main()
    VAR num r;
    FOR i FROM 1 TO 2 DO
      middle i, \\back:=r;
      TPWrite "main " + ValToStr(i) + ValToStr(r);
    ENDFOR
  ENDPROC
  PROC middle(num a, \\INOUT num back)
    VAR num k;
    k := a * 10;
    TPWrite "value " + ValToStr(1 + twice(k) + 1);
    back := k;
    TPWrite "middle " + ValToStr(k);
  ERROR
    RAISE;
  ENDPROC
  FUNC num twice(num v)
    VAR num own;
    own := v;
    TPWrite "twice";
    own := value(own) + own;
    RETURN own;
  ENDFUNC
"""
    printed = retried(text)
    assert printed == [
        "twice", "-", "value 22", "middle 10", "main 110",
        "twice", "value 42", "middle 20", "main 220",
    ]  # fmt: skip


def test_a_call_that_is_not_made_again_changes_no_other_call() -> None:
    text = """
  PROC main()
    IF bad > 0 inner "first";
    inner "second";
  ENDPROC
  PROC inner(string s)
    fails;
    TPWrite s;
  ENDPROC
"""
    assert retried(text) == ["-", "first", "second"]


def test_late_bound_calls_go_on() -> None:
    text = """
  PROC main()
    %"inner"% 5;
    TPWrite "main";
  ENDPROC
  PROC inner(num n)
    TPWrite "inner";
    fails;
    TPWrite ValToStr(n);
  ENDPROC
"""
    assert retried(text) == ["inner", "-", "5", "main"]


def test_recursion_goes_on() -> None:
    text = """
  PROC main()
    TPWrite ValToStr(sum(4));
  ENDPROC
  FUNC num sum(num n)
    IF n = 0 RETURN value(0);
    RETURN n + sum(n - 1);
  ENDFUNC
"""
    assert retried(text) == ["-", "10"]


def test_a_failing_store_leaves_its_target() -> None:
    text = """
  PROC main()
    VAR num x := 3E38;
    VAR num y := 2;
    IF bad = 0 y := 1;
    x := x * y * (2 - (1 * factor()));
    TPWrite ValToStr(x);
  ENDPROC
  FUNC num factor()
    IF bad > 0 RETURN 0;
    RETURN 1.5;
  ENDFUNC
"""
    assert retried(text)[1:] == ["3E+38"]


def test_undo_waits_until_the_pointer_is_moved() -> None:
    """It runs when a routine is aborted [K §7.4]; the program only stands."""
    text = """
  PROC main()
    outer;
  ENDPROC
  PROC outer()
    inner;
    TPWrite "outer";
  UNDO
    TPWrite "undo outer";
  ENDPROC
  PROC inner()
    VAR num n := 3;
    fails;
    TPWrite "inner";
  UNDO
    TPWrite "undo inner " + ValToStr(n);
  ENDPROC
"""
    assert retried(text) == ["-", "inner", "outer"]
    controller, printed = made(text)
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert printed == []
        controller.pp_to_main()
        controller.run_for(1)
        assert printed == ["undo inner 3", "undo outer"]
        assert controller.task("T1").state == "ready"
        controller.task("T1")["bad"] = 0
        controller.start_program()
        controller.run_for(1)
        assert printed[2:] == ["inner", "outer"]


def test_interrupts_stay_ordered() -> None:
    """A stop keeps them [S4 overview 4-24]; what happens meanwhile is lost [S4 overview 4-39]."""
    text = """
  VAR intnum i;
  PERS num p := 0;
  TRAP t
    TPWrite "trap " + ValToStr(p);
  ENDTRAP
  PROC main()
    CONNECT i WITH t;
    IPers p, i;
    fails;
    p := 2;
    WaitTime 1;
  ENDPROC
"""
    assert retried(text) == ["-", "trap 2"]


def test_moves_go_on() -> None:
    from rapidgen.config import load_config

    text = (
        "CONST jointtarget j := [[20,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "PROC main()\n fails;\n MoveAbsJ j, v1000, fine, tool0;\n TPWrite ValToStr(CJointT());\n"
        "ENDPROC"
    )
    printed = retried(text, robots=load_config("irb120").groups, specs={"T1": {"motion": True}})
    assert printed[1].startswith("[[20,0,0,0,")


CANNOT = {
    "goto": "PROC main()\n VAR num n;\n again:\n fails;\n IF n > 1 GOTO again;\nENDPROC\n",
    "handler": "PROC main()\n fails;\nERROR\n fails;\n TRYNEXT;\nENDPROC\n",
    "trap": "VAR intnum i;\nTRAP t\n fails;\nENDTRAP\n"
    "PROC main()\n CONNECT i WITH t;\n ITimer 0.1, i;\n WaitTime 1;\nENDPROC\n",
}


@pytest.mark.parametrize("text", CANNOT.values(), ids=CANNOT)
def test_where_it_cannot_go_on_it_starts_from_main_only(text: str) -> None:
    controller, _ = made(text)
    with controller:
        task = controller.task("T1")
        controller.start_program()
        controller.run_for(2)
        assert task.state == "error"
        task["bad"] = 0
        controller.start_program()
        controller.run_for(2)
        assert task.state == "error"
        assert any("PP to main" in t for e in controller.log for t in e.texts)
        controller.pp_to_main()
        controller.start_program()
        controller.run_for(2)
        assert task.state == "finished"


def test_main_only() -> None:
    """switch after_error"""
    controller, _ = boot(
        "PROC main()\n RAISE 7;\nENDPROC", dialect=Switches(after_error="main"), cycle="once"
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert controller.start_program()
        controller.run_for(1)
        assert controller.task("T1").state == "error"
        assert [e.code for e in controller.log].count(40_199) == 1
