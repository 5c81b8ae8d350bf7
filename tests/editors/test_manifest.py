"""editors/vscode/package.json against its documentation, rapidgen and the debug adapter."""

import json
import re
from pathlib import Path

import pytest

from rapidgen import __version__
from rapidgen.cli.app import COMMANDS
from rapidgen.dap.launch import read_launch

ROOT = Path(__file__).parents[2]
MANIFEST = json.loads((ROOT / "editors" / "vscode" / "package.json").read_text("utf-8"))
CONTRIBUTES = MANIFEST["contributes"]
PAGE = (ROOT / "docs" / "use" / "vscode.md").read_text("utf-8")
SOURCES = "\n".join(
    path.read_text("utf-8") for path in (ROOT / "editors" / "vscode" / "src").glob("*.ts")
)
REQUESTS = CONTRIBUTES["debuggers"][0]["configurationAttributes"]
KEYS = {**REQUESTS["launch"]["properties"], **REQUESTS["attach"]["properties"]}


def rows():
    """Names and texts of all tables of the page."""
    return dict(re.findall(r"^\| `([^`]+)` \| (.+) \|$", PAGE, re.MULTILINE))


def test_page_documents_settings_and_keys_as_the_manifest_does():
    described = {**CONTRIBUTES["configuration"]["properties"], **KEYS}
    texts = {k: v.get("description") or v["markdownDescription"] for k, v in described.items()}
    assert rows() == texts


def test_every_command_is_documented_and_registered():
    for command in CONTRIBUTES["commands"]:
        title = f"{command['category']}: {command['title']}"
        assert f"| {title} | `{command['command']}` |" in PAGE
        assert f'registerCommand("{command["command"]}"' in SOURCES


def test_tasks_are_commands_of_rapidgen():
    (task,) = CONTRIBUTES["taskDefinitions"]
    assert set(task["properties"]["command"]["enum"]) <= set(COMMANDS)


def test_version_is_that_of_rapidgen():
    assert __version__.startswith(MANIFEST["version"])


def test_adapter_takes_every_key_of_a_launch():
    launch = REQUESTS["launch"]["properties"]
    for key, schema in launch.items():
        kind = schema["type"] if isinstance(schema["type"], str) else schema["type"][0]
        wrong = {"boolean": 1}.get(kind, [None])
        with pytest.raises(Exception, match=key):
            read_launch({"program": "m.mod", key: wrong})


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("a b/m.mod:5:2: error[RG201]: met 'x'", ("a b/m.mod", "5", "2", "error", "RG201")),
        ("C:\\x\\m.mod:5:2: warning[RG302]: y", ("C:\\x\\m.mod", "5", "2", "warning", "RG302")),
    ],
)
def test_problem_matcher_reads_findings(line, found):
    (matcher,) = CONTRIBUTES["problemMatchers"]
    assert re.match(matcher["pattern"]["regexp"], line).groups()[:5] == found
