"""Completion and signature help in statements that are being written."""

import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.editor import completion, formatting, tokens
from rapidgen.editor.documents import Document
from rapidgen.editor.workspace import Workspace

TEXT = """MODULE m
    RECORD part
        num size;
        robtarget place;
    ENDRECORD
    CONST robtarget p10 := [[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR part parts{3};
    VAR num count;
    PROC work(num amount, string title \\num limit | switch all)
    ENDPROC
    FUNC num twice(num value)
        RETURN value;
    ENDFUNC
    TRAP alarm
    ENDTRAP
    PROC main()
        VAR intnum id;
        VAR bool ready;
        again:
        @
    ENDPROC
ENDMODULE
"""


def at(statement, text=TEXT):
    """View, line and column of the `|` in a statement of main."""
    start = text.find("@")
    text = text.replace("@", statement)
    offset = text.index("|", start) if "|" in statement else text.index("$")
    text = text[:offset] + text[offset + 1 :]
    workspace = Workspace()
    workspace.open(Document("/nowhere/m.mod", text))
    (view,) = workspace.views("/nowhere/m.mod")
    return view, text.count("\n", 0, offset) + 1, offset - text.rfind("\n", 0, offset)


def items(statement, text=TEXT):
    found = completion.complete(*at(statement, text)).items
    return {item.label: item for item in found}


def best(statement):
    """Names of the best rank."""
    found = items(statement).values()
    rank = min(item.rank for item in found)
    return {item.label for item in found if item.rank == rank}


@pytest.mark.parametrize(
    ("statement", "offered", "missing"),
    [
        ("|", {"work", "MoveL", "IF", "count", "RETURN"}, {"twice", "p10", "Abs"}),
        ("MoveL p10,| ", {"v1000", "Offs", "p10"}, {"work", "IF"}),
        ("count := |", {"count", "twice", "Abs"}, {"work", "MoveL", "WHILE"}),
        ("IF |", {"ready", "count", "NOT", "twice"}, {"work"}),
        ("WHILE ready AND |", {"ready", "TRUE"}, {"MoveL"}),
        ("parts{1}.|", {"size", "place"}, {"count", "trans"}),
        ("parts{1}.place.tr|", {"trans", "rot"}, {"size"}),
        ('work 1, "a" \\|', {"limit", "all"}, {"amount", "count"}),
        ('work 1, "a" \\limit:=2 \\|', set(), {"limit", "all"}),
        ("MoveL p10, v100 \\T:=1, fine \\|", {"Z", "WObj"}, {"T", "V"}),
        ("GOTO |", {"again"}, {"count", "work"}),
        ("CONNECT id WITH |", {"alarm"}, {"work", "count"}),
        ("FOR i FROM 1 TO 3 DO\ncount := |", {"i"}, {"work"}),
        ("count := twice(|", {"count", "twice"}, {"work"}),
        ("! com|ment", set(), {"count"}),
        ('TPWrite "te|xt";', set(), {"count"}),
    ],
)
def test_what_is_offered(statement, offered, missing):
    found = items(statement)
    assert offered <= found.keys()
    assert not missing & found.keys()


def test_types_are_offered_in_declarations():
    text = TEXT.replace("VAR num count;", "VAR $ count;").replace("@", "")
    found = items("$", text)
    assert {"num", "part", "robtarget"} <= found.keys()
    assert "count" not in found
    text = TEXT.replace("PROC work(num amount", "PROC work($").replace("@", "")
    assert {"num", "switch"} <= items("$", text).keys()


def test_names_of_the_expected_type_come_first():
    assert best("MoveL |") == {"p10"}
    assert "v1000" in best("MoveL p10, |")
    assert best("ready := |") == {"ready"}


def test_calls_have_their_arguments():
    assert items("|")["work"].insert == "work ${1:amount}, ${2:title};$0"
    assert items("count := |")["twice"].insert == "twice(${1:value})$0"
    assert items('work 1, "a" \\|')["limit"].insert == "limit:=$0"
    assert items('work 1, "a" \\|')["all"].insert == "all"


@pytest.mark.parametrize(
    ("statement", "label", "active"),
    [
        ("work |", "work(num amount, string title \\num limit | switch all)", 0),
        ("work 1,|", "work(", 1),
        ('work 1, "a" \\limit:=|', "work(", 2),
        ("work twice(|", "num twice(num value)", 0),
        ("work twice(1), |", "work(", 1),
        ("MoveL Offs(p10, 1, |", "robtarget Offs(", 2),
        ("MoveL p10, v100, |", "MoveL(", 6),
        ("IF ready work 1, |", "work(", 1),
    ],
)
def test_the_parameter_that_is_written(statement, label, active):
    found = completion.signature_help(*at(statement))
    assert found.label.startswith(label)
    assert found.active == active


def test_a_header_of_a_routine_is_no_call():
    text = TEXT.replace("PROC work(num amount, ", "PROC work(num amount, $").replace("@", "")
    assert completion.signature_help(*at("$", text)) is None


@pytest.mark.parametrize("statement", ["count := |", "|", "count|", "! work |", "again: |"])
def test_no_signature_outside_of_calls(statement):
    assert completion.signature_help(*at(statement)) is None


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("if ready then$", "        IF ready THEN"),
        ("  count := 1;$", "        count := 1;"),
        ("IF ready THEN\nelse$\nENDIF", "        ELSE"),
        ("IF ready THEN\ncount := 1;$\nENDIF", "            count := 1;"),
        ("FOR i FROM 1 TO 2 DO\nendfor$", "        ENDFOR"),
    ],
)
def test_a_line_is_formatted_when_it_ends(line, expected):
    view, number, _ = at(line)
    assert [edit.text for edit in formatting.format_line(view, number)] == [expected]


def test_hints_name_arguments_and_values():
    view, line, _ = at('work count, "x";$ MoveL p10, v500, z10, tool0; work amount, title;')
    hints = [hint.text for hint in tokens.inlay_hints(view, (line, line))]
    assert hints == ["amount:=", "title:=", "500 mm/s", "10 mm"]


BROKEN = """MODULE b
PROC good()
count:=1;
if ready then
count:=2;
endif
ENDPROC
PROC bad()
count:=3;
IF ready THEN
count:=4;
waittime 1;
count:=(;
ENDIF
ENDPROC
PROC headless(
VAR num x;
ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("lines", "changes"),
    [
        ((4, 4), {4: "        IF ready THEN"}),
        ((9, 9), {9: "        count := 3;"}),
        ((11, 12), {11: "            count := 4;", 12: "            waittime 1;"}),
        ((6, 9), {6: "        ENDIF", 7: "    ENDPROC"}),
        ((12, 13), None),
        ((16, 16), None),
        ((17, 17), {17: "        VAR num x;"}),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_range_beside_a_syntax_error_is_formatted(lines, changes, end):
    workspace = Workspace()
    workspace.open(Document("/nowhere/b.mod", BROKEN.replace("\n", end)))
    (view,) = workspace.views("/nowhere/b.mod")
    if changes is None:
        with pytest.raises(DiagnosticError):
            formatting.format_document(view, lines)
        return
    edits = formatting.format_document(view, lines)
    written = {}
    for edit in edits:
        for number, line in enumerate(edit.text.split(end)[:-1], edit.span.line):
            written[number] = line
    assert {n: line for n, line in written.items() if lines[0] <= n <= lines[1]} == changes
