"""The command line as a whole: help, versions, exit codes, commands typed wrong."""

import inspect
import subprocess
import sys

import pytest

from rapidgen.cli.app import VERBS, function, main


def rapidgen(*words, **options):
    return subprocess.run(
        [sys.executable, "-m", "rapidgen.cli", *words], capture_output=True, text=True, **options
    )


def test_help_lists_every_verb_with_a_sentence():
    done = rapidgen("--help")
    assert done.returncode == 0
    lines = {line.split()[0]: line for line in done.stdout.splitlines() if line.startswith("  ")}
    for verb in VERBS:
        assert len(lines[verb].split()) > 2, verb


@pytest.mark.parametrize("verb", VERBS)
def test_the_listed_sentence_begins_the_verbs_own_help(verb):
    text = " ".join((inspect.getdoc(function(verb)) or "").split())
    assert text.startswith(VERBS[verb])


def test_start_up_imports_nothing_heavy():
    script = (
        "import sys, rapidgen.cli.app\n"
        "heavy = {'numpy', 'pydantic', 'jinja2', 'ruamel', 'yourdfpy', 'paramiko', 'rich',"
        " 'xacro', 'greenlet'}\n"
        "print(sorted(heavy & {name.partition('.')[0] for name in sys.modules}))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["biuld"], "did you mean 'build'"),
        (["build"], "build --help"),
        (["build", "irb120", "--speeed"], "--speeed"),
        (["explain", "RG9999"], "RG902"),
        ([], "usage"),
    ],
)
def test_a_command_typed_wrong_is_told_what_to_do(words, told, capsys):
    assert main(words) == 2
    shown = capsys.readouterr()
    assert told.casefold() in (shown.err + shown.out).casefold()
    assert "Traceback" not in shown.err


def test_version_and_explain_go_to_stdout(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("rapidgen ")
    assert main(["explain", "rg901"]) == 0
    assert capsys.readouterr().out.startswith("# RG901: ")
