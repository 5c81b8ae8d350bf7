"""Statements inside each other, deeper than Python nests them."""

import pytest

from tests.runtime.booting import boot

KINDS = {
    "while": ("WHILE n < 1 DO\n", "ENDWHILE\n"),
    "for": ("FOR i{} FROM 1 TO 1 DO\n", "ENDFOR\n"),
    "if": ("IF n < 1 THEN\n", "ENDIF\n"),
    "test": ("TEST n\nCASE 0:\n", "ENDTEST\n"),
    "failing": ("WHILE 1 / (2 - n) < 1 DO\n", "ENDWHILE\n"),
    "goto": ("again{}:\n WHILE n < 1 DO\n", "ENDWHILE\n IF n < 0 GOTO again{};\n"),
}
HANDLERS = {"none": "", "error": "ERROR\n TRYNEXT;\n", "undo": "UNDO\n n := 0;\n"}


def nested(kind: str, depth: int, body: str) -> str:
    opening, closing = KINDS[kind]
    return (
        "".join(opening.format(i) for i in range(depth))
        + body
        + "".join(closing.format(i) for i in reversed(range(depth)))
    )


def run(text: str, **options: object):
    controller, printed = boot(text, cycle="once", **options)
    with controller:
        controller.start_program()
        controller.run(max_time=10)
        return printed, controller.task("T1").fault, controller.now


@pytest.mark.parametrize("handler", HANDLERS)
@pytest.mark.parametrize("depth", [5, 24, 60, 95])
@pytest.mark.parametrize("kind", KINDS)
def test_depth(kind: str, depth: int, handler: str) -> None:
    text = (
        f"PROC main()\n VAR num n := 0;\n{nested(kind, depth, 'n := n + 1;')}"
        f' TPWrite "done " + ValToStr(n);\n{HANDLERS[handler]}ENDPROC'
    )
    printed, fault, now = run(text)
    assert (printed, fault) == (["done 1"], None)
    assert run(text, accounting="statement") == (printed, fault, now)


@pytest.mark.parametrize("depth", [5, 24, 60])
def test_leaving_from_deep_inside(depth: int) -> None:
    """RETURN in body and handler; RETRY, TRYNEXT and EXIT."""
    text = f"""
  VAR num g := 0;
  PROC main()
    TPWrite ValToStr(give());
    leave;
    TPWrite ValToStr(fails());
    handled;
    caught;
    {nested("for", depth, "EXIT;")}
    TPWrite "never";
  ENDPROC
  FUNC num give()
    {nested("for", depth, f"IF i{depth - 1} = 1 RETURN i0 + i{depth - 1};")}
    RETURN 0;
  ENDFUNC
  PROC leave()
    VAR num n := 0;
    {nested("while", depth, "RETURN;")}
    TPWrite "never";
  ENDPROC
  FUNC num fails()
    VAR num z;
    {nested("for", depth, "z := 1 / z;")}
    RETURN 0;
  ERROR
    {nested("for", depth, "RETURN 7;")}
  ENDFUNC
  PROC handled()
    VAR num z;
    {nested("for", depth, 'z := 1 / z; TPWrite "divided " + ValToStr(z);')}
  ERROR
    {nested("for", depth, "z := z + 1; RETRY;")}
  ENDPROC
  PROC caught()
    raising;
  ERROR (5)
    TPWrite "caught " + ValToStr(ERRNO);
    {nested("for", depth, "g := g + 1; IF g = 1 RETRY; TPWrite ValToStr(g); TRYNEXT;")}
  ENDPROC
  PROC raising()
    {nested("for", depth, "deeper;")}
  ERROR
    RAISE;
  ENDPROC
  PROC deeper()
    RAISE 5;
  ERROR
    {nested("for", depth, "RAISE;")}
  ENDPROC
"""
    printed, fault, _ = run(text)
    assert printed == ["2", "7", "divided 1", "caught 5", "caught 5", "2"]
    assert fault is None


def test_a_fault_deep_inside_names_each_routine_once() -> None:
    text = (
        f"PROC main()\n{nested('for', 30, 'inner;')}ENDPROC\n"
        f"PROC inner()\n VAR num z;\n{nested('for', 30, 'z := 1 / z;')}ENDPROC"
    )
    _, fault, _ = run(text)
    assert [(p.routine, p.span.line) for p in fault.stack] == [("main", 33), ("inner", 96)]


def test_long_jump_to_a_point_deep_inside() -> None:
    """[K §7.2]"""
    text = (
        f'PROC main()\n{nested("for", 30, "a;")} TPWrite "end";\n'
        'ERROR (5)\n TPWrite "here";\n TRYNEXT;\nENDPROC\n'
        'PROC a()\n b;\nERROR\n TPWrite "no";\n TRYNEXT;\nENDPROC\n'
        "PROC b()\n RAISE 5;\nERROR\n RAISE;\nENDPROC"
    )
    assert run(text)[:2] == (["here", "end"], None)


def test_too_many_jumps_are_rejected_with_message() -> None:
    body = nested("while", 40, "GOTO out;")
    text = f'PROC main()\n VAR num n;\n{body} TPWrite "no";\n out:\n TPWrite "out";\nENDPROC'
    printed, fault, _ = run(text)
    assert printed == ["out"] or "nested too deeply" in fault.arguments[0]


@pytest.mark.parametrize("kind", ["for", "while", "if", "test"])
@pytest.mark.parametrize("depth", [1, 3, 24])
def test_the_faulty_statement_is_tried_again(kind: str, depth: int) -> None:
    """[S4 overview 3-23]; the rest: conformance/restart."""
    body = "waste := 1 / good; n := n + 1; TPWrite ValToStr(n);"
    controller, printed = boot(
        f"PERS num good := 0;\nPROC main()\n VAR num n := 0;\n VAR num waste;\n"
        f'{nested(kind, depth, body)}TPWrite "end";\nENDPROC',
        cycle="once",
    )
    with controller:
        controller.start_program()
        controller.run(max_time=10)
        assert (controller.task("T1").state, printed) == ("error", [])
        controller.task("T1")["good"] = 1
        controller.start_program()
        controller.run(max_time=10)
        assert (controller.task("T1").fault, printed) == (None, ["1", "end"])
