"""Encodings, line ends and places."""

import pytest

from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.rapid import check, format_source, parse
from rapidgen.system import ModuleFile, System, TaskSpec

TEXT = 'MODULE größe\n    ! Maß\n    CONST string s := "Größe";\nENDMODULE\n'


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
def test_encoding_is_found_and_kept(encoding):
    data = TEXT.encode(encoding)
    module = parse(data)
    assert module.diagnostics == []
    assert (module.name, module.source.encoding) == ("größe", encoding)
    assert format_source(data) == data


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_are_kept(end):
    data = TEXT.replace("\n", end).encode()
    assert format_source(data) == data
    assert format_source(data.replace(b"    CONST", b"CONST")) == data


def test_mixed_line_ends_become_the_commoner():
    assert b"\r\n" not in format_source(b"MODULE m\r\nVAR num a;\nVAR num b;\nENDMODULE\n")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_and_columns_count_code_points_from_1(end):
    text = f"MODULE m{end}! größe{end}\tVAR nmu größe :={end} ;{end}ENDMODULE{end}"
    span = parse(text, path="x.mod").diagnostics[0].span
    assert (span.line, span.column) == (4, 2)


def test_header_is_kept():
    text = "%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\n\nMODULE m\nENDMODULE\n"
    assert parse(text).diagnostics == []
    assert format_source(text) == text


def test_string_escapes_resolve_to_bytes():
    text = 'MODULE m\nCONST string s := "a""b\\\\c\\0Aé";\nENDMODULE\n'
    assert parse(text).data[0].initial.value == 'a"b\\c\né'
    wide = 'MODULE m\nCONST string s := "漢";\nENDMODULE\n'
    assert parse(wide).data[0].initial.value == "漢".encode().decode("latin-1")


def test_formatting_a_wrong_text_is_refused():
    with pytest.raises(DiagnosticError) as refused:
        format_source("MODULE m\nVAR num\nENDMODULE\n", path="bad.mod")
    assert refused.value.exit_code == 1
    assert refused.value.diagnostics[0].span.path == "bad.mod"


def test_style():
    text = """module m
local var num a{2}:=[1 , -2];  ! trailing
proc p(num x,\\switch s|num t)
if a{1}=1 and not Present(s) then ! why
! inside
moveL offs(p1,1,2,-3),v100\\T:=2,z10,
tool0;
else
test x
case 1,2:
label: goto label;
default: %"p"%;
endtest
endif


if x=1 a{1}:=-a{2}*2;
error
retry;
endproc
endmodule"""
    assert (
        format_source(text)
        == """MODULE m
    LOCAL VAR num a{2} := [1,-2]; ! trailing
    PROC p(num x, \\switch s | num t)
        IF a{1} = 1 AND NOT Present(s) THEN ! why
            ! inside
            moveL offs(p1, 1, 2, -3), v100 \\T:=2, z10,
                tool0;
        ELSE
            TEST x
            CASE 1, 2:
                label:
                GOTO label;
            DEFAULT:
                %"p"%;
            ENDTEST
        ENDIF

        IF x = 1 a{1} := -a{2} * 2;
    ERROR
        RETRY;
    ENDPROC
ENDMODULE
"""
    )


def test_text_after_module_is_reported_and_preserved():
    text = "MODULE m\n  VAR num a;\nENDMODULE ! end\n\n  MoveL  p;\nendmodule\n"
    module = parse(text)
    findings = [(d.code, d.severity, d.span.line) for d in module.diagnostics]
    assert findings == [("RG217", Severity.WARNING, 5)]
    assert module.source.tokens[module.last] == "ENDMODULE"
    formatted = format_source(text)
    assert formatted == "MODULE m\n    VAR num a;\nENDMODULE ! end\n\nMoveL  p;\nendmodule\n"
    assert format_source(formatted) == formatted


def system(*texts):
    files = tuple(ModuleFile(f"m{k}", f"m{k}.mod", t.encode()) for k, t in enumerate(texts))
    return System("s", (TaskSpec("T_ROB1", modules=files),))


def test_names_of_unread_text_are_not_unknown():
    one = "MODULE a\nPROC main()\nelsewhere;\nENDPROC\nENDMODULE\n"
    after = "MODULE b\nENDMODULE\nMODULE c\nPROC elsewhere()\nENDPROC\nENDMODULE\n"
    other = "MODULE b\nENDMODULE\n"
    result = [(d.code, d.severity) for d in check(system(one, other))]
    assert result == [("RG301", Severity.ERROR)]
    result = [(d.code, d.severity) for d in check(system(one, after))]
    assert result == [("RG301", Severity.INFO), ("RG217", Severity.WARNING)]


@pytest.mark.parametrize("count", [1, 2])
def test_stray_zero_byte_is_reported_at_its_place(count):
    text = b"MODULE m\nVAR num" + b"\0" * count + b"a;\nENDMODULE\n"
    (result,) = parse(text, path="m.mod").diagnostics
    assert (result.code, result.span.line, result.span.column) == ("RG204", 2, 8)
    assert "U+0000" in result.message


def test_comments_have_indentation_of_their_block():
    """[K §2.10]: after the data they belong to routines or statements."""
    text = """MODULE m
! data
VAR num a;
! routines
PROC p()
! local data
VAR num b;
! statements
IF a = b THEN
TPErase;
! still inside
ELSE
TPErase;
ENDIF
! the end
ENDPROC
! nothing more
ENDMODULE
"""
    expected = """MODULE m
    ! data
    VAR num a;
    ! routines
    PROC p()
        ! local data
        VAR num b;
        ! statements
        IF a = b THEN
            TPErase;
            ! still inside
        ELSE
            TPErase;
        ENDIF
        ! the end
    ENDPROC
    ! nothing more
ENDMODULE
"""
    assert format_source(text) == expected
    assert format_source(expected) == expected
