"""Diagnostics: what is shown, in every format."""

import ast
import json
from pathlib import Path

import pytest

import rapidgen
from rapidgen.diagnostics import (
    Diagnostic,
    DiagnosticError,
    Format,
    Label,
    Severity,
    Span,
    error,
    refusal,
    render,
    suggest,
)

TEXT = ["robot:", "  axess: 6", "\tcount := \x1b[31mname;"]


def lines_of(path):
    assert path == "cell.yaml"
    return TEXT


UNKNOWN = Diagnostic(
    code="RG001",
    severity=Severity.ERROR,
    message="unknown key 'axess'",
    span=Span("cell.yaml", 2, 3, 2, 8),
    label="not a key of 'robot'",
    help="did you mean 'axes'?",
    notes=("keys are case-sensitive",),
    related=(Label(Span("cell.yaml", 1, 1, 1, 6), "in this mapping"),),
)


def test_full_shows_source_line_and_carets_under_the_span():
    assert render([UNKNOWN], lines_of=lines_of) == (
        "error[RG001]: unknown key 'axess'\n"
        " --> cell.yaml:2:3\n"
        "  |\n"
        "2 |   axess: 6\n"
        "  |   ^^^^^ not a key of 'robot'\n"
        "  |\n"
        "1 | robot:\n"
        "  | ----- in this mapping\n"
        "  = note: keys are case-sensitive\n"
        "  = help: did you mean 'axes'?\n"
    )


def test_carets_are_under_the_text_after_a_tab():
    result = Diagnostic("RG001", Severity.ERROR, "m", Span("cell.yaml", 3, 2, 3, 7))
    displayed = render([result], lines_of=lines_of).splitlines()
    assert displayed[3].index("count") == displayed[4].index("^^^^^")


@pytest.mark.parametrize("format", [Format.FULL, Format.CONCISE, Format.GITHUB])
def test_control_characters_never_reach_the_terminal(format):
    result = Diagnostic(
        "RG001",
        Severity.ERROR,
        "odd \x1b[2J name\x9b",
        Span("cell.yaml", 3, 1),
        help="no \x07 bell",
    )
    displayed = render([result], format, lines_of=lines_of)
    assert not {c for c in displayed if ord(c) < 32 or 127 <= ord(c) < 160} - {"\n"}


def test_json_is_one_array_with_places_from_one():
    assert render([], Format.JSON) == "[]\n"
    (first, second) = json.loads(
        render([UNKNOWN, Diagnostic("RG901", Severity.ERROR, "usage")], Format.JSON)
    )
    assert {k: first[k] for k in ("code", "severity", "path", "line", "column", "message")} == {
        "code": "RG001",
        "severity": "error",
        "path": "cell.yaml",
        "line": 2,
        "column": 3,
        "message": "unknown key 'axess'",
    }
    assert first["help"] == "did you mean 'axes'?"
    assert second["line"] is None


def test_concise_and_github_are_one_line_each():
    assert render([UNKNOWN], Format.CONCISE) == (
        "cell.yaml:2:3: error[RG001]: unknown key 'axess' (did you mean 'axes'?)\n"
    )
    assert render([UNKNOWN], Format.GITHUB) == (
        "::error file=cell.yaml,line=2,col=3,title=RG001::unknown key 'axess'. "
        "did you mean 'axes'?\n"
    )
    broken = Diagnostic("RG001", Severity.WARNING, "a\nb%", Span("x,y:z", 1, 1))
    assert render([broken], Format.GITHUB) == (
        "::warning file=x%2Cy%3Az,line=1,col=1,title=RG001::a%0Ab%25\n"
    )


def test_colour_is_only_there_when_asked_for():
    assert "\x1b[" in render([UNKNOWN], lines_of=lines_of, colour=True)
    assert "\x1b[" not in render([UNKNOWN], lines_of=lines_of)


def test_unreadable_place_still_gives_message_and_help(tmp_path):
    result = Diagnostic(
        "RG001", Severity.ERROR, "m", Span(str(tmp_path / "gone"), 7, 1), "here", "h"
    )
    displayed = render([result])
    assert "gone:7:1" in displayed
    assert "here" in displayed
    assert "help: h" in displayed


def test_a_very_long_line_is_shown_around_its_mark():
    text = "x" * 1_000_000 + "BAD" + "y" * 1_000_000
    result = Diagnostic("RG001", Severity.ERROR, "m", Span("f", 1, 1_000_001, 1, 1_000_004))
    displayed = render([result], lines_of=lambda _: [text])
    assert "BAD" in displayed
    assert len(displayed) < 1000


def test_suggest_ignores_case_and_is_empty_without_match():
    assert suggest("MOTIN", ["motion", "state"]) == "did you mean 'motion'?"
    assert suggest("zzz", ["motion", "state"]) == ""


def test_the_error_carries_its_diagnostics_and_exit_code():
    error = DiagnosticError(UNKNOWN, exit_code=1)
    assert error.diagnostics == (UNKNOWN,)
    assert error.exit_code == 1
    assert "RG001" in str(error)


def test_error_is_the_one_way_to_make_a_diagnostic():
    root = Path(rapidgen.__file__).parent
    made = [
        f"{path.relative_to(root)}:{node.lineno}"
        for path in sorted(root.rglob("*.py"))
        if path.parent.name != "diagnostics"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and getattr(node.func, "id", getattr(node.func, "attr", "")) == "Diagnostic"
    ]
    assert not made


def test_a_refusal_is_one_error_with_an_exit_code():
    span = Span("a.mod", 3, 1)
    raised = refusal("RG001", span, "no", "yes", label="here", notes=("so",), exit_code=1)
    assert raised.diagnostics == (error("RG001", span, "no", "yes", label="here", notes=("so",)),)
    assert raised.exit_code == 1
    assert refusal("RG001", None, "no").exit_code == 2
