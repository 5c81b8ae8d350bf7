"""Descriptions of built-in names: each belongs to one, and each example is valid RAPID."""

import re

import pytest

from rapidgen.editor import hover
from rapidgen.editor.documents import Document
from rapidgen.editor.workspace import Workspace
from rapidgen.rapid import check
from rapidgen.rapid.binding import builtin
from rapidgen.rapid.builtins import signatures

DATA = """
    VAR robtarget here; VAR robtarget found; VAR jointtarget joints;
    CONST robtarget p10 := [[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p20 := [[600,100,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR robtarget p30; VAR robtarget q10; VAR robtarget q20; VAR robtarget q30;
    CONST jointtarget jpos10 := [[0,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num n; PERS num count := 0; VAR dnum big; VAR string name; VAR pos point; VAR pose shift;
    PERS bool busy := FALSE; VAR byte mask; VAR num numbers{3};
    PERS tooldata tool := [TRUE,[[0,0,120],[1,0,0,0]],[1.5,[0,0,60],[1,0,0,0],0,0,0]];
    PERS wobjdata frame := [FALSE,TRUE,"",[[800,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    PERS wobjdata table := [FALSE,TRUE,"",[[800,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    VAR clock watch; VAR intnum id; VAR errnum ERR_NO_PART := -1; VAR triggdata glue;
    VAR iodev report; VAR dir folder; VAR socketdev server; VAR socketdev client;
    VAR rawbytes packet; VAR rawbytes copy; VAR shapedata volume; VAR wztemporary no_entry;
    VAR egmident guide; VAR egm_minmax window := [-1,1]; VAR loadsession loading;
    VAR syncident begin; PERS tasks both{2} := [["T_ROB1"],["T_ROB2"]]; VAR datapos where;
    CONST listitem parts{2} := [["","bolt"],["","nut"]]; VAR signaldo alias_do;
    VAR jointtarget tolerance; VAR jointtarget low_limit; VAR jointtarget high_limit;
"""
OBJECTS = (
    "INOUT num value, VAR signaldi di1, VAR signaldo do1, VAR signalgi gi1, VAR signalgo go1, "
    "VAR signalai ai1, VAR signalao ao1, VAR mecunit STN1, VAR mecunit ROB_1 \\num limit"
)


def names():
    return [
        line.partition(": ")[0]
        for line in (signatures._FOLDER / "descriptions.txt").read_text("utf-8").splitlines()
        if not line.startswith((" ", "!"))
    ]


def test_each_description_is_of_a_built_in_name():
    listed = names()
    assert len(listed) == len({name.lower() for name in listed})
    for name in listed:
        assert name in (getattr(builtin(name.lower()), "name", ""), "switch")
        assert re.fullmatch(r"[A-Z0-9].*\.", signatures.description(name.upper()))
    assert signatures.description("nowhere") == ""


def test_at_least_200_names_have_an_example():
    assert sum(bool(signatures.described(name).example) for name in names()) >= 250


def test_examples_are_valid_rapid_and_use_their_name():
    """All examples in one module: no finding but data and routines that are not used."""
    lines, routines = [], []
    for name in names():
        example = signatures.described(name).example
        assert not example or re.search(rf"\b{name}\b", example), name
        declared = re.match(r"(?:VAR|CONST|PERS) \w+ (\w+)", example)
        if declared is not None:
            lines.append(example.replace(f" {declared[1]}", f" e_{declared[1]}", 1))
        elif example:
            routines.append(f"PROC e{len(routines)}({OBJECTS})\n{example}\nENDPROC")
    calls = "PROC work()\nENDPROC\nPROC extra()\nENDPROC\nTRAP alarm\nENDTRAP"
    text = "\n".join(("MODULE examples", DATA, *lines, calls, *routines, "ENDMODULE"))
    code = text.splitlines()
    found = [(code[d.span.line - 1], d.code, d.message) for d in check(text, strict=True)]
    assert [one for one in found if one[1] != "RG324"] == []


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("DebugBreak", "Available from RobotWare 7.0."),
        ("Break", "Available before RobotWare 7.0."),
        ("dnum", "Available from RobotWare 5.12."),
        ("SocketSend", "Available with the option 616-1 PC Interface."),
        ("EGMStop", "Available from RobotWare 5.61 and with the option 689-1 Externally Guided"),
        ("StopMove", "Arguments: `\\Quick` before RobotWare 7.0."),
        ("MoveL", "```rapid\nMoveL p20, v200, fine, tool0 \\WObj:=wobj0;\n```"),
    ],
)
def test_hover_shows_release_option_and_example(name, expected):
    """Releases: marks in the headers, whose comments name the sources."""
    workspace = Workspace()
    workspace.open(Document("/nowhere/m.mod", "MODULE m\nENDMODULE\n"))
    (view,) = workspace.views("/nowhere/m.mod")
    assert expected in hover.describe(view, builtin(name.lower()))
