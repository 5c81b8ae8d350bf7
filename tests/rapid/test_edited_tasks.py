"""A task that takes edits has the findings of a new check of the same texts."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.rapid import Dialect, parse
from rapidgen.rapid.binding import TaskScope
from rapidgen.rapid.checks import TaskCheck, check
from rapidgen.system import TaskSpec

NAMES = ("x", "y", "A", "B", "move", "pack")
_LINES = st.one_of(
    st.tuples(
        st.sampled_from(("", "LOCAL ")),
        st.sampled_from(("VAR", "PERS", "CONST")),
        st.sampled_from(("num", "string", "pack", "nowhere")),
        st.sampled_from(NAMES),
    ).map(lambda p: f"{p[0]}{p[1]} {p[2]} {p[3]};"),
    st.sampled_from(NAMES).map(lambda n: f"RECORD {n} num a; string b; ENDRECORD"),
    st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES), st.sampled_from(NAMES)).map(
        lambda p: f"PROC {p[0]}()\n {p[1]} := {p[2]};\n move;\nENDPROC"
    ),
    st.sampled_from(("PROC", "VAR num", "IF x THEN", "ENDPROC", '"', "PROC y() x := ; ENDPROC")),
)
_TEXTS = st.tuples(st.sampled_from(("A", "B", "C")), st.lists(_LINES, max_size=4)).map(
    lambda p: f"MODULE {p[0]}\n" + "\n".join(p[1]) + "\nENDMODULE\n"
)
_EDITS = st.lists(st.tuples(st.integers(0, 2), _TEXTS), min_size=1, max_size=6)


def new(texts, spec):
    task = TaskCheck(Dialect(), spec)
    for index, text in enumerate(texts):
        task.add(parse(text, path=f"{index}.mod"), installed=index == 2 and spec is not None)
    return task


@settings(max_examples=60)
@given(st.lists(_TEXTS, min_size=3, max_size=3), _EDITS, st.sampled_from((None, TaskSpec("T"))))
def test_any_sequence_of_edits_gives_the_findings_of_a_new_task(texts, edits, spec):
    task = new(texts, spec)
    for index, text in edits:
        task.findings()
        texts[index] = text
        task.replace(task.modules[index], parse(text, path=f"{index}.mod"))
    assert task.findings() == new(texts, spec).findings()


def test_a_renamed_global_gives_its_name_to_the_next_module():
    # The first module's name hid the second's: a third one sees the second's now.
    texts = [
        "MODULE A\nVAR num x;\nENDMODULE",
        "MODULE B\nVAR num x;\nENDMODULE",
        "MODULE C\nPROC main()\nx := 1;\nENDPROC\nENDMODULE",
    ]
    task = TaskCheck(Dialect(), TaskSpec("T"))
    modules = [task.add(parse(text, path=f"{k}.mod")) for k, text in enumerate(texts)]
    assert [d.code for d in task.findings()] == ["RG305"]
    task.replace(modules[0], parse("MODULE A\nVAR num other;\nENDMODULE", path="0.mod"))
    assert task.findings() == []


def test_an_edited_module_stays_the_first_one():
    task = TaskScope()
    first = task.add(parse("MODULE A\nVAR num x;\nENDMODULE"))
    task.add(parse("MODULE B\nVAR string x;\nENDMODULE"))
    edited = task.replace(first, parse("MODULE A\nVAR num x := 1;\nENDMODULE"))
    assert task.find("x").module is edited


# -- findings beside a syntax error ----------------------------------------------------------


BROKEN = """MODULE m
LOCAL VAR num used;
LOCAL VAR num unused;
{declaration}
PROC first()
    {statement}
ENDPROC
PROC second()
    nowhere := 1;
    first;
    later;
ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("declaration", "statement"),
    [
        ("", "used := ;"),
        ("", "MoveL used"),
        ("", "IF used"),
        ("VAR num later", "used := 1;"),
        ("PROC later", "used := 1;"),
        ("used", "later: later;"),
    ],
)
def test_findings_beside_a_syntax_error_remain(declaration, statement):
    text = BROKEN.format(declaration=declaration, statement=statement)
    codes = [(d.code, d.severity) for d in check(text, strict=True) if d.code >= "RG300"]
    assert ("RG302", "error") in codes
    assert ("RG324", "warning") in codes
    invented = [d for d in check(text) if d.code >= "RG300" and "'used'" in d.message]
    assert invented == []


def test_a_broken_routine_has_no_findings_of_meaning():
    text = "MODULE m\nPROC a()\nVAR num n;\nnowhere := 1;\nb(;\nENDPROC\nENDMODULE"
    assert {d.code for d in check(text, strict=True)} == {"RG201"}


def test_a_missing_end_breaks_its_own_routine():
    text = "MODULE m\nPROC a()\nx := 1;\nPROC b()\ny := 1;\nENDPROC\nENDMODULE"
    messages = [d.message for d in check(text, strict=True)]
    assert any("'y'" in m for m in messages)
    assert not any("'x'" in m for m in messages)
