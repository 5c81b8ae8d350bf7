"""The command line as a whole: help, versions, exit codes, commands typed wrong."""

import inspect
import json
import logging
import os
import re
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rapidgen.cli import terminal
from rapidgen.cli.app import COMMANDS, function, main

PACKAGES = ["client", "config", "controller", "deploy", "generate", "servers", "verification"]
PACKAGES += ["viewer"]


def rapidgen(*words, **options):
    return subprocess.run(
        [sys.executable, "-m", "rapidgen.cli", *words], capture_output=True, text=True, **options
    )


def test_help_lists_every_command_uncut():
    done = rapidgen("--help", env={**os.environ, "COLUMNS": "80"})
    assert done.returncode == 0
    lines = {line.split()[0]: line for line in done.stdout.splitlines() if line.startswith("  ")}
    for command, (_, sentence) in COMMANDS.items():
        assert len(sentence) <= 60, command
        assert lines[command].split(maxsplit=1)[1] == sentence


@pytest.mark.parametrize("command", COMMANDS)
def test_listed_sentence_begins_the_commands_help(command):
    text = " ".join((inspect.getdoc(function(command)) or "").split())
    assert text.startswith(COMMANDS[command][1])


def test_start_up_imports_nothing_heavy():
    script = (
        "import sys, rapidgen.cli.app\n"
        "heavy = {'numpy', 'pydantic', 'jinja2', 'ruamel', 'yourdfpy', 'paramiko', 'rich',"
        " 'xacro', 'greenlet'}\n"
        "print(sorted(heavy & {name.partition('.')[0] for name in sys.modules}))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


def test_interruption_during_start_up_has_no_traceback():
    script = """if True:
        import os, signal, sys
        from rapidgen.cli.entry import run

        class Interrupts:
            def find_spec(name, path=None, target=None):
                if name == "rapidgen.cli.app":
                    os.kill(os.getpid(), signal.SIGINT)

        signal.signal(signal.SIGINT, signal.default_int_handler)
        sys.meta_path.insert(0, Interrupts)
        sys.argv[1:] = ["--version"]
        run()
    """
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["biuld"], "did you mean 'build'"),
        (["build"], "build --help"),
        (["build", "irb120", "--speeed"], "--speeed"),
        (["explain", "RG9999"], "RG902"),
    ],
)
def test_wrong_command_is_reported_with_help(words, text, capsys):
    assert main(words) == 2
    displayed = capsys.readouterr()
    assert text.casefold() in (displayed.err + displayed.out).casefold()
    assert "Traceback" not in displayed.err


def test_version_and_explain_go_to_stdout(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("rapidgen ")
    assert main(["explain", "rg901"]) == 0
    assert capsys.readouterr().out.startswith("# RG901: ")


def test_nothing_typed_is_asking_for_help(capsys):
    assert main([]) == 0
    displayed = capsys.readouterr()
    assert "Commands:" in displayed.out
    assert displayed.err == ""


@pytest.mark.parametrize(
    ("text", "code", "exit_code"),
    [
        (["move", "irb120", "--json"], "RG901", 2),
        (["status", "--json", "host:0"], "RG657", 2),
        (["robots", "show", "irb121", "--json"], "RG009", 2),
        (["test", "", "--json"], "RG901", 2),
    ],
)
def test_an_error_is_json_where_json_was_asked_for(text, code, exit_code, capsys):
    assert main(text) == exit_code
    displayed = capsys.readouterr()
    assert [result["code"] for result in json.loads(displayed.out)["errors"]] == [code]
    assert displayed.err == ""


def test_interruption_is_reported_as_json(monkeypatch, capsys):
    def given_up(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("rapidgen.client.connect_target.resolve", given_up)
    assert main(["pose", "irb120", "--joints", "0,0,0,0,0,0", "--json"]) == 130
    displayed = capsys.readouterr()
    assert [result["code"] for result in json.loads(displayed.out)["errors"]] == ["RG906"]
    assert displayed.err == ""
    assert main(["pose", "irb120", "--joints", "0,0,0,0,0,0"]) == 130
    assert capsys.readouterr().err == "\nstopped\n"


@pytest.mark.parametrize("package", PACKAGES)
def test_each_package_with_actions_has_a_logger(package):
    """Exactly one, named after the package."""
    files = (Path(terminal.__file__).parents[1] / package).rglob("*.py")
    named = {
        name
        for file in files
        for name in re.findall(r'getLogger\("(rapidgen[^"]*)', file.read_text("utf-8"))
    }
    assert named - {"rapidgen"} == {f"rapidgen.{package}"}


def test_verbose_shows_progress_messages(tmp_path, capsys):
    assert main(["-v", "build", "irb120", "-o", str(tmp_path / "out")]) == 0
    message = capsys.readouterr().err
    assert "rapidgen.config: irb120: " in message
    assert "rapidgen.generate: " in message
    (tmp_path / "disk").mkdir()
    assert main(["-v", "deploy", "irb120", "--to", f"dir://{tmp_path}/disk", "--yes"]) == 0
    message = capsys.readouterr().err
    assert f"rapidgen.deploy: dir://{tmp_path}/disk: logged in" in message
    assert re.search(r"rapidgen.deploy: .*wrote .*ROS_motion", message)


@pytest.mark.parametrize(
    ("words", "levels"),
    [
        (["check", "irb120"], ["warning", "error"]),
        (["-v", "check", "irb120"], ["info", "warning", "error"]),
        (["check", "-v", "irb120", "-v"], ["debug", "info", "warning", "error"]),
        (["check", "irb120", "-vv"], ["debug", "info", "warning", "error"]),
        (["-q", "check", "irb120"], ["error"]),
    ],
)
def test_verbosity_options_set_log_level(words, levels, capsys):
    assert main(words) == 0
    log = logging.getLogger("rapidgen.client")
    for level in ("debug", "info", "warning", "error"):
        getattr(log, level)("this is %s", level)
    text = [line.rpartition(" ")[2] for line in capsys.readouterr().err.splitlines()]
    assert [word for word in text if word in ("debug", "info", "warning", "error")] == levels


def test_the_package_is_the_command_too():
    command = [sys.executable, "-m", "rapidgen", "explain", "RG0"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("error[RG902]")


def test_suggested_command_is_quoted_for_a_shell(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "my cell.yaml", "--robot", "irb120"]) == 0
    following = shlex.split(capsys.readouterr().err.split("next: rapidgen ")[1])
    assert following == ["build", "my cell.yaml"]
    assert main(["run", "my cell.yaml"]) == 2
    text = capsys.readouterr().err.split("`rapidgen ")[1].split("`")[0]
    assert shlex.split(text) == ["sim", "my cell.yaml"]
