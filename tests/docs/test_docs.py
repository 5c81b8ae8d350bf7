"""The documentation's commands and Python examples run as they stand.

Fenced blocks: `console` (lines starting with `$ `, run in order in one scratch folder for each
document, where blocks that have a file's name behind their kind lie as files; a command ending in
` &` is waited for until it says `ready`), `python` (all blocks of a document are one program). `sh`
blocks set a machine up, `text` blocks are output: not run, and no command of rapidgen is in them.
A comment `# exit N` behind a command states its exit code. 192.168.125.1 is a controller
(at_address.py), and what is asked there is answered with yes, as at a terminal. The ports of
`--port-offset N` are free ones in truth.
"""

import json
import os
import pty
import re
import shlex
import subprocess
import sys
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest
import tomllib
import typer

from rapidgen.cli.app import COMMANDS, _app
from rapidgen.controller.faults import read_plan
from tests.docs import at_address
from tests.ports import free_port

ROOT = Path(__file__).resolve().parents[2]
# The site's build writes these pages from `explain` and `--help`, which have tests of their own.
GENERATED = [ROOT / "docs" / "reference" / name for name in ("cli.md", "codes.md")]
PAGES = [
    ROOT / "README.md",
    *(p for p in sorted((ROOT / "docs").glob("*/*.md")) if p not in GENERATED),
]
# Descriptions of robots that the reader of a page has: the shipped one, and what it says otherwise.
SAMPLES = {
    "robots.md": {
        "my_robot.urdf": ("irb120", {}),
        "my_robot.xacro": (
            "irb120",
            {
                '<robot name="irb120">': '<robot name="irb120" '
                'xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="prefix" default=""/>',
                '="joint_': '="$(arg prefix)joint_',
            },
        ),
        "cell.urdf": ("irb120_track", {'joint name="track"': 'joint name="rail"'}),
    }
}
# A jog ends where one of its two ends is held up for 0.2 s, as it has to: it is asked again.
HELD_UP = re.compile(r"RG603|the connection to the client was lost")
JOGS = 10
FENCE = re.compile(r"^```(\w+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(path, kind):
    return [
        text for result, text in FENCE.findall(path.read_text(encoding="utf-8")) if result == kind
    ]


def files(path):
    """(name, text) of the blocks that are files: ```yaml cell.yaml."""
    return re.findall(
        r"^```\w+ ([\w./]+)\n(.*?)^```$", path.read_text("utf-8"), re.MULTILINE | re.DOTALL
    )


def write_files(path, folder):
    for name, text in files(path):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")


@pytest.fixture
def environment(tmp_path):
    binaries = str(Path(sys.executable).parent)
    return {
        **os.environ,
        "PATH": binaries + os.pathsep + os.environ["PATH"],
        "NO_COLOR": "1",
        # Simulators of this page alone are found by `--to sim`.
        "XDG_RUNTIME_DIR": str(tmp_path),
        "XDG_STATE_HOME": str(tmp_path),
    }


@pytest.mark.parametrize("path", [p for p in PAGES if blocks(p, "console")], ids=lambda p: p.name)
def test_commands(path, tmp_path, environment):
    write_files(path, tmp_path)
    for name, (source, changes) in SAMPLES.get(path.name, {}).items():
        text = (ROOT / "robots" / "urdf" / f"{source}.urdf").read_text("utf-8")
        for old, new in changes.items():
            assert old in text
            text = text.replace(old, new)
        (tmp_path / name).write_text(text, encoding="utf-8")
    lines = re.sub(r"\\\n", "", "".join(blocks(path, "console"))).splitlines()
    with ExitStack() as stack:
        stands, own_password = elsewhere(lines), ""
        if any(at_address.WRITTEN in line for line in lines):
            stands |= stack.enter_context(at_address.standing(path.name, tmp_path))
        for line in lines:
            if not line.startswith("$ "):
                continue
            command, _, wanted = line[2:].partition("# exit ")
            if stands:
                # In one go: what stands there may be the text of another.
                written = "|".join(map(re.escape, stands))
                command = re.sub(written, lambda result: stands[result[0]], command)
            words = shlex.split(command, comments=True)
            assert words[0] in ("rapidgen", "cat", "ls", "pytest"), line
            if words[-1] == "&":
                ready = stack.enter_context(served(words[:-1], tmp_path, environment))
                if "sftp" in ready:
                    own_password = ready["sftp"]["password"]
                    (tmp_path / "known").write_text(ready["sftp"]["host_key"] + "\n")
                    stands["127.0.0.1:40022"] = f"127.0.0.1:{ready['sftp']['port']}"
                continue
            run, password = run_without_terminal, own_password
            if at_address.WRITTEN in line:
                run, password = agreed, at_address.PASSWORD
            own = {**environment, "RAPIDGEN_PASSWORD": password}
            code, message = run(words, cwd=tmp_path, env=own)
            again = JOGS if words[1:2] == ["jog"] else 0
            while again and HELD_UP.search(message):
                again -= 1
                code, message = run(words, cwd=tmp_path, env=own)
            assert code == int(wanted or 0), (line, message)


def elsewhere(lines):
    """What ports that a page writes are to be replaced by: this machine may use them otherwise."""
    match = re.search(r"--port-offset (\d+)", "\n".join(lines))
    if match is None:
        return {}
    written, free = int(match[1]), free_port(adjacent=2) - 11000
    return {match[0]: f"--port-offset {free}"} | {
        str(port + written): str(port + free) for port in (11000, 11001, 11002)
    }


@contextmanager
def served(words, folder, environment):
    """A command that goes on, from what it says when it is ready."""
    server = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, cwd=folder, env=environment)
    try:
        word, _, listed = server.stdout.readline().partition(" ")
        assert word == "ready", words
        yield json.loads(listed)
    finally:
        server.terminate()
        server.wait(60)
        server.stdout.close()


def run_without_terminal(words, **where):
    """Return exit code and output of a command without a terminal."""
    done = subprocess.run(
        words, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=200, **where
    )
    return done.returncode, done.stdout + done.stderr


def agreed(words, **where):
    """The same at a terminal with the answer yes to every question."""
    ours, theirs = pty.openpty()
    os.write(ours, b"y\n" * 8)
    process = subprocess.Popen(words, stdin=theirs, stdout=theirs, stderr=theirs, **where)
    os.close(theirs)
    message = b""
    with open(ours, "rb", buffering=0) as terminal, suppress(OSError):
        # The other end is closed: an error on Linux.
        while block := terminal.read(4096):
            message += block
    return process.wait(200), message.decode()


@pytest.mark.parametrize("path", [p for p in PAGES if blocks(p, "python")], ids=lambda p: p.name)
def test_python(path, tmp_path, environment):
    write_files(path, tmp_path)
    program = "\n".join(blocks(path, "python"))
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        timeout=200,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("path", PAGES, ids=lambda p: p.name)
def test_no_command_stands_where_it_is_not_run(path):
    """But as the form of one: with capitals or brackets for what a reader puts in."""
    for kind, text in FENCE.findall(path.read_text(encoding="utf-8")):
        if kind != "console":
            for line in text.splitlines():
                assert not re.match(r"(\$ )?rapidgen ", line), (path.name, line)
    remaining = re.sub(FENCE, "", path.read_text(encoding="utf-8"))
    for line in re.findall(r"^    (rapidgen .*)$", remaining, re.MULTILINE):
        assert re.search(r"\[|\b[A-Z]{3,}\b", line), (path.name, line)


def mentioned(text):
    """(verb, options) of every `rapidgen VERB ...` that stands as code, run or not."""
    code = [block for _, block in FENCE.findall(text)]
    code += re.findall(r"^    \S.*$", text, re.MULTILINE)
    code += re.findall(r"`(rapidgen [^`]+)`", re.sub(FENCE, "", text))
    for line in re.sub(r"\\\n", "", "\n".join(code)).splitlines():
        for command in re.findall(r"(?:^|\s)rapidgen ([a-z][a-z0-9-]*\b[^#|]*)", line):
            verb, *words = command.split()
            yield verb, [w.strip("[],.;:").partition("=")[0] for w in words if w.startswith("--")]


@pytest.mark.parametrize("path", PAGES, ids=lambda p: p.name)
def test_every_command_that_is_named_exists(path):
    for verb, options in mentioned(path.read_text(encoding="utf-8")):
        assert verb in COMMANDS, (path.name, verb)
        known = {name for option in options_of(verb) for name in option}
        for option in options:
            assert option in known, (path.name, verb, option)


@pytest.mark.parametrize(
    ("page", "verb"),
    [
        ("use/test-driver.md", "test"),
        ("start/simulation.md", "sim"),
        ("rapid/virtual-controller.md", "run"),
    ],
)
def test_a_table_of_options_names_all_there_are(page, verb):
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    rows = [line.split("|")[1] for line in text.splitlines() if line.startswith("| `--")]
    listed = {name for row in rows for name in re.findall(r"--[a-z-]+", row)}
    for names in options_of(verb):
        assert names & listed or names & {"--help"}, (page, names)
    assert listed <= {name for names in options_of(verb) for name in names}


def test_plans_of_faults_and_secrets_can_be_read(tmp_path):
    simulation, security = (
        (ROOT / "docs" / name).read_text(encoding="utf-8")
        for name in ("start/simulation.md", "use/security-files.md")
    )
    (tmp_path / "faults.yaml").write_text(
        next(text for kind, text in FENCE.findall(simulation) if kind == "yaml")
    )
    plan = read_plan(tmp_path / "faults.yaml")
    assert (len(plan.network), len(plan.controller)) == (2, 2)
    block = re.search(r"```toml\n(.*?)```", security, re.DOTALL)[1]
    secrets = tomllib.loads(re.sub(r"^   ", "", block, flags=re.MULTILINE))
    assert set(secrets["default"]) == {"user", "password"}


def options_of(verb):
    """The names of each option of a verb, long ones."""
    command = typer.main.get_command(_app([verb])).commands[verb]
    return [
        {name for name in (*option.opts, *option.secondary_opts) if name.startswith("--")}
        for option in command.params
        if option.param_type_name == "option"
    ]


LONGEST = 1500
# References, which are searched and not read, and one list of everything that was measured.
REFERENCES = {
    "develop/compatibility.md",
    "develop/performance.md",
    "develop/protocol.md",
    "rapid/language.md",
    "rapid/options.md",
    "rapid/runtime-rules.md",
    "reference/driver.md",
    "start/configuration.md",
    "start/robots.md",
}
LONGER = {"develop/architecture.md": 2000}


def test_no_page_is_longer_than_a_reader_has_time():
    found = {}
    for path in PAGES[1:]:
        name = path.relative_to(ROOT / "docs").as_posix()
        words = len(path.read_text(encoding="utf-8").split())
        if name in REFERENCES:
            assert words > LONGEST, f"{name} is no exception any more"
        elif words > LONGER.get(name, LONGEST):
            found[name] = words
    assert not found


def test_the_site_names_every_page():
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    pages = [p.relative_to(ROOT / "docs").with_suffix("").as_posix() for p in PAGES[1:]]
    named = re.split(r"[\s<>]+", index)
    assert [p for p in pages if p not in named and not p.startswith("changes/")] == []


def test_every_page_that_is_named_is_there():
    """By a link of a page, or by its path anywhere."""
    for page in [*PAGES, ROOT / "CONTRIBUTING.md"]:
        for link in re.findall(r"\]\(([^)#:]+\.md)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            target = (page.parent / link).resolve()
            assert target.is_file() or target in GENERATED, (page.name, link)
    texts = [path for kind in ("*.py", "*.md", "*.mod") for path in ROOT.glob(f"*/**/{kind}")]
    for path in texts:
        if path.is_relative_to(ROOT / ".venv") or path.is_relative_to(ROOT / "build"):
            continue
        for named in re.findall(
            r"\bdocs/[a-z/-]+\.md", path.read_text(encoding="utf-8", errors="replace")
        ):
            assert (ROOT / named).is_file(), (path, named)
