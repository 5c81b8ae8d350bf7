"""Texts of editors/vscode without VS Code: Node.js strips the types of src/texts.ts itself."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from tests.editors.node import node
from tests.viewer.conftest import absent

TEXTS = Path(__file__).parents[2] / "editors" / "vscode" / "src" / "texts.ts"
TASK = {
    "name": "T_ROB1",
    "type": "normal",
    "execution": "stopped",
    "selected": True,
    "pointer": "Main/main:12",
    "modules": [],
}
CERTIFICATE = {
    "code": "RG652",
    "message": "the certificate of 10.0.0.1 is not confirmed; no password was sent",
    "help": "compare it",
    "notes": ["there: AB CD EF"],
}
LINES = [
    "MODULE m",
    "  CONST robtarget p10 := [[1,2,3]];",
    "  LOCAL PERS JOINTTARGET home:=[[0]];",
    "  VAR num robtarget_count := 1;",
    "  ! CONST robtarget old",
]

CASES = {
    "failureIn": [
        [{"errors": [CERTIFICATE]}],
        [{"errors": [{"code": 5}]}],
        [{"name": "x"}],
        [None],
    ],
    "failureOf": [[3, "a\nlast line\n"], [None, ""]],
    "remedyOf": [[{"code": code, "notes": []}] for code in ("RG512", "RG651", "RG652", "RG650")]
    + [[CERTIFICATE]],
    "fingerprintIn": [[CERTIFICATE], [{"notes": ["there: $(rm)"]}]],
    "trustCommand": [["rwss://10.0.0.1", "ABCD"], ["a'; rm -rf ~", "ABCD"]],
    "placeOf": [["Main/main:12"], [""], ["Main"]],
    "taskText": [[TASK], [{**TASK, "selected": False, "pointer": ""}]],
    "moduleText": [
        [TASK, {"name": "MAIN", "system": False}],
        [TASK, {"name": "base", "system": True}],
    ],
    "datumText": [
        [{"value": "[1,2]", "type": "num", "dims": [2]}],
        [{"value": None, "type": "tooldata", "dims": []}],
    ],
    "declaredTargets": [[LINES], [["PERS robtarget a;"] * 600]],
    "statusArguments": [["--help", 2]],
    "sourceArguments": [["-x", "T_ROB1", "m"]],
    "valueArguments": [["-x", "T_ROB1", "m", 1]],
    "loadArguments": [["-x", "T", "-m.mod"], ["-x", "T", "-m.mod", "12ab"]],
}
SCRIPT = f"""
import * as texts from {json.dumps(TEXTS.as_uri())};
const cases = {json.dumps(CASES)};
const result = Object.fromEntries(Object.entries(cases).map(([name, all]) =>
  [name, all.map((words) => texts[name](...words) ?? null)]));
const lines = new texts.JsonLines();
result.JsonLines = ['{{"a":', '1}}\\nno JSON\\n[2', ']\\n3'].map((piece) => lines.take(piece));
console.log(JSON.stringify(result));
"""


@pytest.fixture(scope="module")
def results():
    version = subprocess.run([*node(), "--version"], capture_output=True, text=True, check=True)
    if int(re.match(r"v(\d+)", version.stdout)[1]) < 24:
        absent("Node.js 24, which strips types: the group `build`")
    words = [*node(), "--no-warnings", "--input-type=module", "--eval", SCRIPT]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_failures_have_reason_help_and_what_to_do(results):
    known, odd, none, empty = results["failureIn"]
    assert (known["code"], known["help"], known["notes"]) == (
        "RG652",
        "compare it",
        ["there: AB CD EF"],
    )
    assert (odd["code"], odd["message"]) == ("", "no reason given")
    assert none is empty is None
    assert [one["message"] for one in results["failureOf"]] == [
        "last line",
        "rapidgen has ended with exit code ?",
    ]
    # An unknown certificate without a fingerprint cannot be trusted by a command.
    assert results["remedyOf"] == ["password", "password", None, None, "certificate"]
    assert results["fingerprintIn"] == ["ABCDEF", ""]


def test_no_text_of_a_setting_becomes_an_option_or_a_shell_command(results):
    for name in ("statusArguments", "sourceArguments", "valueArguments"):
        (words,) = results[name]
        assert words.index("--") < min(i for i, w in enumerate(words) if w in ("--help", "-x"))
    plan, apply = results["loadArguments"]
    assert plan == ["load", "--json", "--plan", "--to=-x", "--task=T", "--", "-m.mod"]
    assert apply[2:4] == ["--expect=12ab", "--yes"]
    assert results["trustCommand"] == [
        "rapidgen status --fingerprint ABCD -- rwss://10.0.0.1",
        "rapidgen status --fingerprint ABCD -- 'a'\\''; rm -rf ~'",
    ]


def test_labels_of_tasks_modules_and_data(results):
    assert results["placeOf"] == [{"module": "Main", "routine": "main", "line": 12}, None, None]
    assert results["taskText"] == ["stopped, Main/main:12", "stopped, not selected"]
    assert results["moduleText"] == ["▶ main:12", "system module"]
    assert results["datumText"] == ["[1,2]  num{2}", "no value given  tooldata"]


def test_declared_targets_and_pieces_of_lines(results):
    found, many = results["declaredTargets"]
    assert found == [{"line": 1, "name": "p10"}, {"line": 2, "name": "home"}]
    assert len(many) == 500
    assert results["JsonLines"] == [[], [{"a": 1}], [[2]]]
