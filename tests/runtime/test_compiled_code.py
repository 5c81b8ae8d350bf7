"""Compiled code beyond conformance programs: placeholders, constants."""

import pytest

from rapidgen.diagnostics import DiagnosticError
from tests.runtime.booting import boot


def _printed(text: str) -> list[str]:
    controller, printed = boot(text, cycle="once")
    with controller:
        controller.start_program()
        assert controller.run(max_time=10) == "finished"
    return printed


@pytest.mark.parametrize("text", ["@REFUND@", "b -= @OWN@", "@GLOBALS", "@REST@"])
def test_text_of_a_program_is_no_placeholder_of_the_compiler(text: str) -> None:
    source = f'PROC main()\nVAR string s;\ns := "{text}";\nTPWrite s;\nERROR\nTRYNEXT;\nENDPROC'
    assert _printed(source) == [text]


def test_late_call_accepts_named_and_optional_arguments() -> None:
    source = """
    PROC two(num a, num b \\num c)
      TPWrite ValToStr(a) + ValToStr(b) + ValToStr(c);
    ENDPROC
    PROC main()
      %"two"% 1, b:=2 \\c:=3;
      %"two"% a:=4, b:=5 \\c:=6;
    ENDPROC"""
    assert _printed(source) == ["123", "456"]


@pytest.mark.parametrize("arguments", ["1", "1, 2, 3", "1, c:=2", "1, 2 \\b:=3"])
def test_late_call_with_wrong_arguments(arguments: str) -> None:
    source = f"""
    PROC two(num a, num b \\num c)
    ENDPROC
    PROC main()
      %"two"% {arguments};
    ERROR
      IF ERRNO = ERR_CALLPROC TPWrite "does not fit";
      TRYNEXT;
    ENDPROC"""
    assert _printed(source) == ["does not fit"]


def test_record_constants_work_in_constant_expressions() -> None:
    source = """
    RECORD pair
      num a;
      pos p;
    ENDRECORD
    CONST pair first := [1, [2, 3, 4]];
    CONST pair both{2} := [first, [5, [6, 7, 8]]];
    CONST num last := both{2}.p.z + first.a * pi / pi;
    PROC main()
      CONST num sizes{2} := [2, 3];
      VAR num field{sizes{1}, sizes{2}};
      TPWrite ValToStr(last) + ValToStr(Dim(field, 2)) + ValToStr(both{1}.p);
    ENDPROC"""
    assert _printed(source) == ["93[2,3,4]"]


def test_initial_value_of_other_type_is_rejected_at_load() -> None:
    with pytest.raises(DiagnosticError, match="RG401: the value is bool, not num"):
        boot("VAR num a := TRUE;\nPROC main()\nENDPROC")


def test_conditional_argument_of_no_parameter_is_refused() -> None:
    controller, _ = boot("""
    PROC foo(\\num known)
    ENDPROC
    PROC bar(\\num x)
      foo \\unknown?x;
    ENDPROC
    PROC main()
      bar;
    ENDPROC""")
    with controller:
        controller.start_program()
        controller.run(max_time=1)
        fault = controller.task("T1").fault
        assert fault is not None
        assert "foo has no parameter unknown" in str(fault.arguments)
