"""Program.from_rapid: exported programs come back, others are rejected with their line."""

import random

import pytest

from rapidgen.client import Program
from rapidgen.client.core.group import Group
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.export.writer import WriterOptions
from tools.export_trials import OVERRIDES, START, STYLES, random_program


@pytest.fixture(scope="module")
def config():
    return load_config("irb120", overrides=OVERRIDES)


def body(text):
    """Declarations and instructions, without the header."""
    return [line for line in text.splitlines() if not line.strip().startswith("!")]


@pytest.mark.parametrize("seed", range(6))
def test_random_program_returns(config, seed):
    group = Group.of(config, config.groups[0])
    program = random_program(group, random.Random(seed))
    # A tool that no move uses leaves no instruction.
    program.move_joints(START)
    options = WriterOptions(targets=STYLES[seed % 3])
    text = program.to_rapid(config, options=options).text
    back = Program.from_rapid(text, config)
    again = back.to_rapid(config, start=START, options=options).text
    assert body(again) == body(text)
    moved = [step for step in program.steps if step.pose or step.joints]
    returned = [step for step in back.steps if step.pose or step.joints]
    assert len(moved) == len(returned)
    for one, other in zip(moved, returned, strict=True):
        assert one.speed.tcp == pytest.approx(other.speed.tcp)
        assert [t.signal for t in one.triggers] == [t.signal for t in other.triggers]


def module(line, more=""):
    return f"""MODULE m
    CONST robtarget p1 := [[400,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    {more}
    PROC main()
        ConfL \\On;
        {line}
    ENDPROC
ENDMODULE
"""


def test_edited_routine_is_read(config):
    program = Program.from_rapid(
        module("MoveJ p1, v100, z10, nozzle \\WObj:=table;\n SetDO glue, 1;\n WaitTime 2;"), config
    )
    move, signal, wait = program.steps
    assert (move.tool, move.work_object, move.zone.tcp) == ("nozzle", "table", 0.01)
    assert move.pose == ((0.4, 0.0, 0.5), (0.0, 0.0, 1.0, 0.0))
    assert (signal.signal, signal.value, wait.seconds) == ("glue", 1.0, 2.0)


@pytest.mark.parametrize(
    ("line", "report"),
    [
        ("IF TRUE WaitTime 1;", "CompactIf is no instruction"),
        ("MoveL Offs(p1,0,0,1), v100, fine, tool0;", "not known before the run"),
        ("MoveL p1, v100, fine, gun;", "no tool 'gun'"),
        ("MoveL p1, v100, fine, tool0 \\WObj:=shelf;", "no work object 'shelf'"),
        ("MoveL \\Conc, p1, v100, fine, tool0;", "\\conc has no counterpart"),
        ("weld 1;", "no routine 'weld'"),
    ],
)
def test_other_statement_is_rejected_with_its_line(config, line, report):
    with pytest.raises(DiagnosticError) as error:
        Program.from_rapid(module(line), config, path="m.mod")
    (fault,) = error.value.diagnostics
    assert (fault.code, fault.span.line) == ("RG763", 6)
    assert report in fault.message


def test_missing_or_invalid_routine_is_rejected(config):
    with pytest.raises(DiagnosticError, match="has no procedure 'work'"):
        Program.from_rapid(module("WaitTime 1;"), config, routine="work")
    with pytest.raises(DiagnosticError):
        Program.from_rapid(module("MoveL p1;"), config)
