"""Fixes of findings: after one, the finding is gone and no error is new."""

import pytest

from rapidgen.diagnostics import Severity, Tag, apply_edits
from rapidgen.rapid import Dialect, check, parse

CASES = {
    "assignment": ("n = 1;", "n := 1;", True),
    "comparison": ("IF n == 1 n := 2;", "IF n = 1 n := 2;", True),
    "call": ("TPErase();", "TPErase;", True),
    "blank": ("IF n = 1THEN\nn := 2;\nENDIF", "IF n = 1 THEN\nn := 2;\nENDIF", True),
    "tab": ('TPWrite "a\tb";', 'TPWrite "a\\09b";', True),
    "invisible": ("n :=\u00a01;", "n := 1;", True),
    "semicolon": ("n := 1\nn := 2;", "n := 1;\nn := 2;", False),
    "instruction": ('TPWrit\u0065x "a";', 'TPWrite "a";', False),
    "datum": ("count := n; n := cuont;", "count := n; n := count;", False),
    "argument": ('TPWrite "a"\\Nun:=n;', 'TPWrite "a"\\Num:=n;', False),
    "component": ("p.trnas.x := n;", "p.trans.x := n;", False),
    "label": ("again: GOTO agian;", "again: GOTO again;", False),
}
MODULE = (
    "MODULE m\nVAR num n;\nVAR num count;\nVAR robtarget p;\nPROC main()\n{}\nENDPROC\nENDMODULE\n"
)


def fixed(text, fix):
    source = parse(text).source
    return apply_edits(text, fix.edits, source.offset)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_fix_corrects_a_slip(case):
    wrong, right, is_safe = case
    text = MODULE.format(wrong)
    (fix,) = [fix for d in check(text, strict=True) for fix in d.fixes]
    assert fixed(text, fix) == MODULE.format(right)
    assert fix.is_safe is is_safe
    assert [d for d in check(MODULE.format(right)) if d.severity is Severity.ERROR] == []


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("    IF n = 1 THEN\n        n := 2;\n", "    IF n = 1 THEN\n        n := 2;\n    ENDIF\n"),
        ("    WHILE TRUE DO\n", "    WHILE TRUE DO\n    ENDWHILE\n"),
    ],
)
def test_missing_ends_are_added_with_their_indentation(wrong, right):
    text = f"MODULE m\nVAR num n;\nPROC main()\n{wrong}ENDPROC\nENDMODULE\n"
    (fix,) = [fix for d in check(text) for fix in d.fixes]
    assert fixed(text, fix) == text.replace(wrong, right)


def test_an_unused_datum_is_removed_with_its_line():
    text = "MODULE m\nPROC main()\n    VAR num a;\n    VAR num b; ! keep\nENDPROC\nENDMODULE\n"
    (finding,) = check(text)
    assert finding.tags == (Tag.UNNECESSARY,)
    (fix,) = finding.fixes
    assert fix.is_safe
    assert fixed(text, fix) == "MODULE m\nPROC main()\n     ! keep\nENDPROC\nENDMODULE\n"


def test_a_datum_that_is_written_stays():
    text = "MODULE m\nPROC main()\nVAR num a;\na := 1;\nENDPROC\nENDMODULE\n"
    (finding,) = check(text)
    assert finding.fixes == ()


def test_an_argument_of_older_releases_is_deprecated():
    # \\ASCII of UnpackRawBytes went with RobotWare 7.0: builtins/communication.rapid.
    body = "VAR rawbytes r;\nVAR string s;\nUnpackRawBytes r, 1, s\\ASCII:=4;\nTPWrite s;"
    text = f"MODULE m\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
    assert [d.tags for d in check(text, dialect=Dialect((7, 0)))] == [(Tag.DEPRECATED,)]


def test_a_note_of_unknown_names_has_all_places():
    text = "MODULE m\nPROC main()\nfar := 1;\nfurther := far;\nENDPROC\nENDMODULE\n"
    (finding,) = check(text)
    assert (finding.span.line, [r.span.line for r in finding.related]) == (3, [4])
