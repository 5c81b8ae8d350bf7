"""The documentation's commands and Python examples run as they stand.

Fenced blocks: `console` (lines starting with `$ `, run in order in one scratch folder for each
document; a command ending in ` &` is waited for until it says `ready`), `python` (all blocks of
a document are one program). `sh` blocks set a machine up, `text` blocks are output: not run.
A comment `# exit N` behind a command states its exit code.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^```(\w+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(path, kind):
    return [
        text for found, text in FENCE.findall(path.read_text(encoding="utf-8")) if found == kind
    ]


@pytest.fixture
def environment():
    binaries = str(Path(sys.executable).parent)
    return {**os.environ, "PATH": binaries + os.pathsep + os.environ["PATH"], "NO_COLOR": "1"}


@pytest.mark.parametrize("path", [p for p in PAGES if blocks(p, "console")], ids=lambda p: p.name)
def test_commands(path, tmp_path, environment):
    servers = []
    try:
        for block in blocks(path, "console"):
            for line in re.sub(r"\\\n", "", block).splitlines():
                if not line.startswith("$ "):
                    continue
                command, _, wanted = line[2:].partition("# exit ")
                words = shlex.split(command, comments=True)
                assert words[0] in ("rapidgen", "cat", "ls"), line
                if words[-1] == "&":
                    server = subprocess.Popen(
                        words[:-1], stdout=subprocess.PIPE, text=True, cwd=tmp_path, env=environment
                    )
                    servers.append(server)
                    assert server.stdout.readline().startswith("ready "), line
                    continue
                done = subprocess.run(
                    words,
                    capture_output=True,
                    text=True,
                    cwd=tmp_path,
                    env=environment,
                    timeout=100,
                )
                assert done.returncode == int(wanted or 0), (line, done.stdout, done.stderr)
    finally:
        for server in servers:
            server.terminate()
            server.wait(10)
            server.stdout.close()


@pytest.mark.parametrize("path", [p for p in PAGES if blocks(p, "python")], ids=lambda p: p.name)
def test_python(path, tmp_path, environment):
    program = "\n".join(blocks(path, "python"))
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        timeout=100,
    )
    assert done.returncode == 0, done.stderr
