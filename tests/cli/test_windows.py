"""Commands that run on Windows: without modules, functions and paths of POSIX alone.

A process that lacks what Windows lacks [Python documentation: availability of `os`, `signal`,
`select` and of the Unix specific services] runs each of them.
"""

import json
import ntpath
import posixpath
import subprocess
import sys

import pytest

from rapidgen._reading import is_within
from rapidgen.editor.documents import is_file, path_of, uri_of
from rapidgen.wire.framing import MessageSplitter, encode
from tests.cli.test_events import LOG

HIDING = """
import os, select, signal, sys
for name in ("fcntl", "termios", "pwd", "grp", "resource", "tty", "pty", "syslog", "readline"):
    sys.modules[name] = None
for name in (
    "fork", "getuid", "geteuid", "getgid", "register_at_fork", "mkfifo", "chown", "fchmod",
    "killpg", "setsid", "statvfs", "O_NONBLOCK", "O_NOFOLLOW", "O_DIRECTORY", "O_CLOEXEC",
    "O_NOCTTY", "O_PATH",
):
    delattr(os, name)
os.supports_dir_fd = set()
for name in ("SIGHUP", "SIGKILL", "SIGPIPE", "SIGALRM", "SIGUSR1", "SIGCHLD", "pthread_kill"):
    delattr(signal, name)
for name in ("epoll", "poll"):
    delattr(select, name)
from rapidgen.cli.app import main
"""
COMMANDS = """
import contextlib, io, json
results = {}
for words in json.loads(sys.argv[1]):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        code = main(words)
    results[words[0]] = (code, out.getvalue())
print(json.dumps(results))
"""
HELLO = 'MODULE hello\nPROC main()\nTPWrite "hello";\nENDPROC\nENDMODULE\n'


def started(text, folder, *words, data=b""):
    return subprocess.run(
        [sys.executable, "-c", HIDING + text, *words],
        cwd=folder,
        input=data,
        capture_output=True,
        timeout=60,
    )


def test_commands_run_without_what_windows_lacks(tmp_path):
    (tmp_path / "hello.mod").write_text(HELLO)
    (tmp_path / "plan.csv").write_text(
        "time,joint_1,joint_2,joint_3,joint_4,joint_5,joint_6\n0,0,0,0,0,0.5,0\n2,0.1,0,0,0,0.5,0\n"
    )
    (tmp_path / "events.txt").write_text(LOG)
    commands = [
        ["check", "hello.mod"],
        ["fmt", "hello.mod"],
        ["run", "hello.mod"],
        ["explain", "RG301"],
        ["log", "events.txt"],
        ["export", "plan.csv", "--config", "irb120", "-o", "plan.mod"],
    ]
    done = started(COMMANDS, tmp_path, json.dumps(commands))
    assert done.returncode == 0, done.stderr.decode()
    results = json.loads(done.stdout.splitlines()[-1])
    assert {name: code for name, (code, _) in results.items()} == dict.fromkeys(results, 0)
    assert results["run"][1] == "hello\n"
    assert "    PROC main()" in (tmp_path / "hello.mod").read_text()
    assert "PROC main" in (tmp_path / "plan.mod").read_text()


@pytest.mark.parametrize(
    ("command", "messages", "answer"),
    [
        (
            "lsp",
            [
                {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}},
                {"jsonrpc": "2.0", "id": 2, "method": "shutdown"},
                {"jsonrpc": "2.0", "method": "exit"},
            ],
            lambda m: m.get("id") == 1 and "capabilities" in m["result"],
        ),
        (
            "dap",
            [
                {"seq": 1, "type": "request", "command": "initialize", "arguments": {}},
                {"seq": 2, "type": "request", "command": "launch", "arguments": {"program": "."}},
                {"seq": 3, "type": "request", "command": "disconnect", "arguments": {}},
            ],
            lambda m: m.get("command") == "launch" and m["success"],
        ),
    ],
)
def test_servers_of_editors_run_without_what_windows_lacks(tmp_path, command, messages, answer):
    (tmp_path / "hello.mod").write_text(HELLO)
    data = b"".join(map(encode, messages))
    done = started(f"sys.exit(main([{command!r}]))", tmp_path, data=data)
    splitter = MessageSplitter()
    splitter.feed(done.stdout)
    found = []
    while (message := splitter.next()) is not None:
        found.append(message)
    assert any(map(answer, found)), (found, done.stderr.decode())
    assert done.returncode == 0, done.stderr.decode()


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("file:///c%3A/cell/m.mod", "c:\\cell\\m.mod"),
        ("file:///C:/cell/m%20n.mod", "C:\\cell\\m n.mod"),
        ("file:///d:/a/../b/gr%C3%BCn.mod", "d:\\b\\gr\u00fcn.mod"),
        ("file://server/share/m.mod", "\\\\server\\share\\m.mod"),
        ("file://localhost/c:/m.mod", "c:\\m.mod"),
        ("untitled:c:\\m.mod", "untitled:c:\\m.mod"),
    ],
)
def test_addresses_of_windows_are_paths(uri, path):
    assert path_of(uri, paths=ntpath) == path


@pytest.mark.parametrize(
    ("path", "uri"),
    [
        ("c:\\cell\\m.mod", "file:///c%3A/cell/m.mod"),
        ("C:\\a b\\..\\gr\u00fcn.mod", "file:///C%3A/gr%C3%BCn.mod"),
        ("\\\\server\\share\\m.mod", "file://server/share/m.mod"),
        ("d:/cell/m.mod", "file:///d%3A/cell/m.mod"),
    ],
)
def test_paths_of_windows_are_addresses(path, uri):
    assert uri_of(path, paths=ntpath) == uri
    assert path_of(uri, paths=ntpath) == ntpath.normpath(path)


def test_drives_are_no_schemes():
    assert is_file("c:\\m.mod")
    assert is_file("C:/m.mod")
    assert not is_file("untitled:Untitled-1")


@pytest.mark.parametrize(
    ("path", "folder", "paths", "expected"),
    [
        ("C:\\cell\\a.mod", "c:\\Cell", ntpath, True),
        ("c:\\cells\\a.mod", "c:\\cell", ntpath, False),
        ("d:\\cell\\a.mod", "c:\\cell", ntpath, False),
        ("\\\\server\\share\\a.mod", "c:\\cell", ntpath, False),
        ("/cell/a.mod", "/cell", posixpath, True),
        ("/Cell/a.mod", "/cell", posixpath, False),
        ("/cell", "/cell", posixpath, True),
    ],
)
def test_paths_within_a_folder(path, folder, paths, expected):
    assert is_within(path, folder, paths=paths) is expected
