"""Several errors in one text: each at its place, without follow-ups."""

import pytest

from rapidgen.diagnostics import Severity
from rapidgen.rapid import check, parse
from rapidgen.rapid.syntax.walk import walk


def places(text):
    return [(d.span.line, d.code) for d in parse(text).diagnostics]


def routine(body):
    return f"MODULE m\nPROC p()\n{body}\nENDPROC\nENDMODULE\n"


def test_five_errors_are_five_diagnostics_at_their_lines():
    body = """a := 1
b := (2;
c := 3 + ;
IF a = 1 THEN
    d := ;
ENDIF
Foo 1 2;
g := 7;"""
    result = parse(routine(body)).diagnostics
    assert [(d.span.line, d.code) for d in result] == [
        (4, "RG201"),  # the ';' missing before b
        (4, "RG201"),
        (5, "RG201"),
        (7, "RG201"),
        (9, "RG201"),
    ]


def test_message_names_token_expectation_and_blocks():
    result = parse(routine("FOR i FROM 1 TO 3 DO\n    a := ;\nENDFOR")).diagnostics
    assert len(result) == 1
    assert result[0].message == "met ';', expected an expression"
    assert "FOR (line 3), PROC (line 2), MODULE (line 1)" in result[0].notes[0]
    assert result[0].help == "write an expression here, or remove this"
    assert result[0].related[0].span.line == 3


def test_nothing_can_be_taken_out_at_the_end_of_a_file():
    (result,) = parse("MODULE m\n").diagnostics
    assert result.help == "write ENDMODULE here"


@pytest.mark.parametrize(
    ("body", "help_text"),
    [
        ("IF a == 1 a := 2;", "compares with one `=`"),
        ("WHILE a == 1 DO\nENDWHILE", "compares with one `=`"),
        ("a += 1;", "RAPID has no `+=`: write a := a + ...;"),
        ("a++;", "Incr a;"),
        ("a--;", "Decr a;"),
        ("// note", "a comment begins with `!`"),
        ("/* note */", "a comment begins with `!`"),
        ("# note", "a comment begins with `!`"),
        ("s := 'text';", "double quotes"),
        ("b := a && c;", "RAPID writes AND"),
        ("b := a || c;", "RAPID writes OR"),
        ("a := b ^ 2;", "Pow(a, b)"),
        ("IF a != 1 THEN\nENDIF", "RAPID's unequal is `<>`"),
        ("IF a = 1 THEN\nELSE IF a = 2 THEN\nENDIF", "ELSEIF is one word"),
    ],
)
def test_foreign_syntax_has_rapid_help(body, help_text):
    assert any(help_text in result.help for result in parse(routine(body)).diagnostics)


@pytest.mark.parametrize(
    "body", ["a := b / ;", "a := 1 + + 2;", "IF a = 1 THEN\nELSE\nIF a = 2 THEN\nENDIF"]
)
def test_other_syntax_error_has_general_help(body):
    result = parse(routine(body)).diagnostics
    assert result
    for one in result:
        assert not any(word in one.help for word in ("RAPID", "comment", "one word"))


@pytest.mark.parametrize(
    ("body", "help_text"),
    [
        (
            "MoveL p1 v100, fine, tool0;",
            "a ',' is missing between two arguments, perhaps before 'v100'",
        ),
        ("a := Offs(p, 1 2, 3);", "a ',' is missing between two arguments, perhaps before '2'"),
        ('TPWrite "a" "b";', "a ',' is missing between two arguments, perhaps before '\"b\"'"),
        ("a := [1 [2]];", "a ',' is missing between two arguments, perhaps before '['"),
        # At the beginning of a line it is more likely the semicolon.
        ("Foo 1\nBar 2;", "perhaps the one before has none"),
        ("a := 1\nb := 2;", "perhaps the one before has none"),
        ("a := 1 b := 2;", "perhaps the one before has none"),
    ],
)
def test_missing_comma_differs_from_missing_semicolon(body, help_text):
    (result,) = parse(routine(body)).diagnostics
    assert help_text in result.help


@pytest.mark.parametrize(
    "body",
    [
        "a = 1;",
        "a{2} = 1;",
        "a.b == 1;",
        "IF a = 1 a = 2;",
        "VAR num b = 2;",
        "MoveL p, v100, fine, tool0 \\WObj=wobj0;",
        "a := ASin(1 \\Unit = 2);",
    ],
)
def test_equals_sign_for_assignment_is_reported(body):
    (result,) = parse(routine(body)).diagnostics
    assert (result.span.line, result.code) == (3, "RG201")
    assert result.message.startswith("met '=', expected ")
    assert result.help == "write `:=` where a value is given; `=` compares"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("a := 1\nb := 2;", [(4, "RG201")]),
        ("Foo();", [(3, "RG201")]),
        ("IF a = 1 THEN\n    b := 1;", [(5, "RG202")]),
        ("FOR i FROM 1 TO 2 DO\n    IF a = 1 THEN\n        b := 1;\nENDFOR", [(6, "RG202")]),
        ("IF a = 1 THEN\nENDWHILE\nb := 1;", [(4, "RG201")]),
        ("WHILE a = 1 DO\nENDIF\nENDWHILE", [(4, "RG203")]),
        ("ENDIF", [(3, "RG203")]),
        ("IF a = 1\n    b := 1;\nELSE\n    b := 2;\nENDIF", [(5, "RG203")]),
        ("IF a b THEN\n    c := 1;\nELSE\n    c := 2;\nENDIF", [(3, "RG201")]),
        ("IF a = THEN\n    c := 1;\nENDIF", [(3, "RG201")]),
        ("WHILE a = 1\n    b := 1;\nENDWHILE", [(4, "RG201")]),
        ("FOR i FROM 1 TO DO\n    b := 1;\nENDFOR", [(3, "RG201")]),
        ("FOR i 1 TO 3 DO\n    b := 1;\nENDFOR", [(3, "RG201")]),
        ("TEST a\nCASE 1\n    b := 1;\nENDTEST", [(5, "RG201")]),
        ("TEST a b\nCASE 1:\n    b := 1;\nENDTEST", [(3, "RG201")]),
        ("CASE 1:\n    b := 1;\nENDTEST", [(3, "RG203")]),
        ('a := "abc;\nb := 1;', [(3, "RG207")]),
        ("a := 12ab;\nb := 1;", [(3, "RG205")]),
        ("a := default + 1;\nb := 1;", [(3, "RG201")]),
        ("VAR num for;\nb := 1;", [(3, "RG201")]),
        (";\nb := 1;", [(3, "RG201")]),
        ("a := b[1];\nb := 1;", [(3, "RG201")]),
        ("MoveL p1 v100, z10, tool0;\nb := 1;", [(3, "RG201")]),
        ("IF a = 1 THEN\n    b := 1;\nELSEIF THEN\n    b := 2;\nENDIF", [(5, "RG201")]),
        ("RETURN 1 2;\nb := 1;", [(3, "RG201")]),
        ("GOTO 1;\nb := 1;", [(3, "RG201")]),
        ("CONNECT i t;\nb := 1;", [(3, "RG201")]),
        ("CONNECT 1 WITH t;\nb := 1;", [(3, "RG201")]),
        ("a.b c;\nb := 1;", [(3, "RG201")]),
        ("<EXP>\nb := 1;", [(3, "RG201")]),
        ('%"p";\nb := 1;', [(3, "RG201")]),
        ("IF a = 1 b: c := 1;", [(3, "RG201")]),
        ("FOR i FROM\nb := 1;\nENDFOR", [(4, "RG201")]),
        ("TEST a\nDEFAULT:\nCASE 1:\nENDTEST", [(5, "RG201")]),
        ("TEST a\nDEFAULT:\nDEFAULT:\nENDTEST", [(5, "RG201")]),
        ("TEST a\nDEFAULT\nb := 1;\nENDTEST", [(5, "RG201")]),
        ("IF a THEN\nELSEIF a b THEN\nENDIF", [(4, "RG201")]),
        ("IF a THEN\nELSE\nELSEIF b THEN\nENDIF", [(5, "RG201")]),
        ("IF a THEN\nIF b THEN\nENDIF\nENDFOR\nc := 1;\nENDIF", [(6, "RG203")]),
        ("VAR num a{*};\nb := 1;", [(3, "RG201")]),
        ("VAR num a{1;\nb := 1;", [(3, "RG201")]),
        ("VAR num a b;\nc := 1;", [(3, "RG201")]),
    ],
)
def test_single_mistake_gives_single_error(body, expected):
    assert places(routine(body)) == expected


def test_a_routine_without_its_end_does_not_spoil_the_next():
    text = "MODULE m\nPROC a()\n    x := 1;\nPROC b()\n    y := ;\nENDPROC\nENDMODULE\n"
    assert places(text) == [(4, "RG202"), (5, "RG201")]
    assert [r.name for r in parse(text).routines] == ["a", "b"]


def test_wrong_header_keeps_the_body():
    text = "MODULE m\nPROC a(num x num y)\n    x := 1;\nENDPROC\nPROC b()\nENDPROC\nENDMODULE\n"
    assert places(text) == [(2, "RG201")]
    assert [(r.name, len(r.body)) for r in parse(text).routines] == [("a", 1), ("b", 0)]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("VAR num a b;", [(2, "RG201")]),
        ("RECORD r\nnum x{3\nENDRECORD", [(3, "RG201"), (4, "RG201")]),
        ("PROC p(num a{*,})\nENDPROC", [(2, "RG201")]),
        ("PROC p(num a{*)\nENDPROC", [(2, "RG201")]),
        ("PROC p(num)\nENDPROC", [(2, "RG201")]),
        ("PROC p()\nERROR (1, )\nTRYNEXT;\nENDPROC", [(3, "RG201")]),
        ("RECORD r\nnum 1;\nnum y;\nENDRECORD", [(3, "RG201")]),
        ("PROC p()\nTEST a\n<EIT>\nCASE 1:\nENDTEST\nENDPROC", [(4, "RG201")]),
        ("nonsense\n<TDN>", [(2, "RG201")]),
        ("LOCAL ALIAS num a;\nLOCAL RECORD r num x; ENDRECORD\nLOCAL PROC p()\nENDPROC", []),
        ("PROC p()\n<DDN>\nVAR num a;\nENDPROC", []),
        ("PROC p()\n<SMT>\nCONNECT <VAR> WITH t;\nFoo \\a?<VAR>;\nENDPROC", []),
    ],
)
def test_declarations(line, expected):
    assert places(f"MODULE m\n{line}\nENDMODULE\n") == expected


def test_junk_among_declarations_gives_single_error():
    text = "MODULE m\nVAR num a;\nthis is no declaration at all;\nVAR num b;\nENDMODULE\n"
    assert places(text) == [(3, "RG201")]
    assert [d.name for d in parse(text).data] == ["a", "b"]


def test_statements_around_an_error_stay_in_the_tree():
    module = parse(routine("a := 1;\nb := ;\nc := 3;"))
    assert [s.target.name for s in module.routines[0].body] == ["a", "c"]


def test_after_a_hundred_errors_the_rest_is_left():
    module = parse(routine("a := ;\n" * 500))
    assert len(module.diagnostics) == 101
    assert module.diagnostics[-1].code == "RG214"


ENDLESS = {
    "empty": b"",
    "blank": b" \r\n\t ",
    "comments": b"! nothing here\n! at all\n",
    "zero bytes": b"\0\1\2MODULE",
    "encoded": b"\xfc\x30\x1d\xe1\x0a\x01\x80\x02\x0e\x39\xc0\xd3",
    "utf-16": "MODULE a\nENDMODULE\n".encode("utf-16"),
    "too large": b"x" * 9_000_000,
    "brackets": b"MODULE m PROC p() a := " + b"[" * 10_000,
    "parentheses": b"MODULE m PROC p() a := " + b"(" * 10_000,
    "braces": b"MODULE m PROC p() a := " + b"a{" * 10_000,
    "calls": b"MODULE m PROC p() a := " + b"f(" * 10_000,
    "signs": b"MODULE m PROC p() a := " + b"-" * 10_000,
    "sum": b"MODULE m PROC p() a := " + b"1 + " * 10_000,
    "components": b"MODULE m PROC p() a := a" + b".b" * 10_000,
    "ifs": b"MODULE m PROC p() " + b"IF a THEN " * 10_000,
    "compact ifs": b"MODULE m PROC p() " + b"IF a " * 10_000 + b"b; ENDPROC ENDMODULE",
    "unfinished compact ifs": b"MODULE m PROC p() " + b"IF a " * 10_000,
    "digits": b"MODULE m PROC p() a := " + b"9" * 10_000 + b"; ENDPROC ENDMODULE",
    "hexadecimal digits": b"MODULE m PROC p() a := 0x" + b"F" * 999 + b"; ENDPROC ENDMODULE",
    "name": b"MODULE m PROC p() " + b"a" * 1_000_000 + b"; ENDPROC ENDMODULE",
    "loops": b"MODULE m PROC p() " + b"FOR i FROM 1 TO 2 DO " * 10_000,
    "module": b"MODULE",
    "module name": b"MODULE m",
    "attributes": b"MODULE m(",
    "declaration": b"MODULE m VAR",
    "datum": b"MODULE m VAR num a",
    "dimensions": b"MODULE m VAR num a{",
    "aggregate": b"MODULE m VAR pos a := [1, 2",
    "string": b'MODULE m CONST string a := "abc',
    "record": b"MODULE m RECORD r num a;",
    "routine": b"MODULE m PROC",
    "parameters": b"MODULE m PROC p(num a",
    "body": b"MODULE m PROC p() a := 1;",
    "statement": b"MODULE m PROC p() a :=",
    "if": b"MODULE m PROC p() IF a THEN",
    "test": b"MODULE m PROC p() TEST a CASE 1:",
    "handler": b"MODULE m PROC p() ERROR",
    "placeholder": b"MODULE m PROC p() <SM",
    "late call": b'MODULE m PROC p() %"x"',
    "optional argument": b"MODULE m PROC p() Foo 1 \\",
    "header": b"%%%\n VERSION:1\n",
}


@pytest.mark.parametrize("name", ENDLESS)
def test_bad_input_gives_single_diagnostic(name):
    module = parse(ENDLESS[name], path="bad.mod")
    assert len(module.diagnostics) == 1, module.diagnostics
    assert module.diagnostics[0].span.path == "bad.mod"


def test_truncated_module_gives_single_error():
    """Open blocks at the end are reported once, for any cut."""
    text = """MODULE m(SYSMODULE)
RECORD r num x; ENDRECORD
PERS r a := [1];
FUNC num f(num b, \\switch c | num d)
    VAR num e{2} := [1, -2];
    IF b > 1 AND (NOT Present(c)) THEN
        FOR i FROM 1 TO 2 DO e{i} := a.x; ENDFOR
    ELSEIF b = 1 TPWrite "x" \\Num:=b; ELSE
        TEST b CASE 1, 2: WHILE TRUE DO GOTO l; ENDWHILE DEFAULT: l: ENDTEST
    ENDIF
    RETURN f(1 \\c);
ERROR (1, ERR_DIVZERO)
    IF b = 1 RETRY;
    RAISE;
ENDFUNC
ENDMODULE
""".replace("TPWrite", "THEN TPWrite")
    tokens = parse(text).source.tokens
    assert parse(text).diagnostics == []
    for length in range(1, len(tokens)):
        result = parse(" ".join(tokens[:length])).diagnostics
        assert len(result) == 1, (" ".join(tokens[:length])[-60:], result)


def test_depth_limits_are_reached_without_harm():
    deep = "IF a THEN " * 100 + "x := " + "f(1+" * 99 + "1" + ")" * 99 + ";" + "ENDIF " * 100
    module = parse(routine(deep))
    assert module.diagnostics == []
    assert sum(1 for _ in walk(module)) > 500
    assert parse(routine("x := " + "(1+" * 199 + "1" + ")" * 199 + ";")).diagnostics == []


def test_an_encoded_module_is_a_note():
    result = parse(ENDLESS["encoded"]).diagnostics
    assert [(d.code, d.severity) for d in result] == [("RG219", Severity.INFO)]


@pytest.mark.parametrize(
    "value",
    [
        "(1+" * 199 + "1" + ")" * 199,
        "f(1+" * 99 + "1" + ")" * 99,
        "Abs(1+" * 99 + "1" + ")" * 99,
        "[" * 199 + "1" + "]" * 199,
        "1" + "+1" * 199,
        "a{" * 199 + "1" + "}" * 199,
        "(NOT " * 99 + "TRUE" + ")" * 99,
    ],
)
def test_the_deepest_expression_in_the_deepest_block_is_checked(value):
    deep = "IF a THEN " * 100 + f"x := {value}; Foo {value}; IF {value} TPErase;" + "ENDIF " * 100
    assert all(d.code.startswith("RG3") for d in check(parse(routine(deep), path="deep.mod")))
    data = f"MODULE m\nVAR num x := {value};\nPERS num y := {value};\nENDMODULE\n"
    assert all(d.code.startswith("RG3") for d in check(parse(data, path="deep.mod")))
