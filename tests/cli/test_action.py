"""The GitHub Action and the hooks of pre-commit, as far as they run without either."""

import os
import re
import subprocess
import sys

import pytest
from ruamel.yaml import YAML

from rapidgen.system.paths import MODULE_SUFFIXES
from tests.docs.tree import ROOT

GOOD = 'MODULE good\n    PROC main()\n        TPWrite "hello";\n    ENDPROC\nENDMODULE\n'
BAD = "MODULE bad\n    PROC main()\n        VAR num a := TRUE;\n    ENDPROC\nENDMODULE\n"


@pytest.fixture
def act(tmp_path):
    program = tmp_path / "rapidgen"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m rapidgen.cli "$@"\n')
    program.chmod(0o755)
    folder = tmp_path / "repository"
    folder.mkdir()

    def run(files, **inputs):
        for name, text in files.items():
            (folder / name).write_text(text)
        where = {**os.environ, "PYTHONPATH": str(ROOT), "RAPIDGEN": str(program), **inputs}
        script = [ROOT / ".ci" / "action"]
        done = subprocess.run(
            script, cwd=folder, env=where, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    return run


def test_action_annotates_errors_of_the_whole_repository(act):
    code, said = act({"good.mod": GOOD, "bad.mod": BAD})
    assert code == 1
    assert re.search(r"^::error file=.*bad\.mod,line=3", said, re.MULTILINE)


def test_action_checks_the_format_only_if_asked(act):
    untidy = {"good.mod": GOOD.lower()}
    assert act(untidy)[0] == 0
    code, said = act(untidy, FORMAT="true")
    assert code == 1
    assert "good.mod" in said


def test_action_checks_the_given_paths_only(act):
    assert act({"good.mod": GOOD, "bad.mod": BAD}, PATHS="good.mod")[0] == 0


def test_hooks_take_every_module_file_and_name_commands():
    from rapidgen.cli.app import COMMANDS

    hooks = YAML(typ="safe").load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    assert {hook["entry"] for hook in hooks} == {"rapidgen check", "rapidgen fmt"}
    for hook in hooks:
        assert hook["entry"].split()[1] in COMMANDS
        for suffix in MODULE_SUFFIXES:
            assert re.search(hook["files"], f"HOME/main{suffix}")
        assert not re.search(hook["files"], "main.modern")
