"""The adapter as a process: on stdio, on TCP, with Microsoft's client, and hostile input."""

import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from rapidgen._message_streams import MessageStream
from rapidgen.wire.framing import encode
from tests.dap.own_client import Refused
from tests.dap.test_session import PROGRAM
from tests.editors.node import MODULES, node

HERE = Path(__file__).parent
INITIALIZE = {"seq": 1, "type": "request", "command": "initialize", "arguments": {}}


def answers(data):
    """Send bytes to the adapter on stdio, and return its messages."""
    done = subprocess.run(
        [sys.executable, "-m", "rapidgen", "dap"], input=data, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr.decode()
    assert b"Traceback" not in done.stderr
    parts = done.stdout.split(b"Content-Length: ")[1:]
    return [json.loads(part.partition(b"\r\n\r\n")[2]) for part in parts]


def test_initialize_is_answered_before_the_controller_is_imported():
    code = (
        "import sys\n"
        "from rapidgen.cli.app import main\n"
        "assert main(['dap']) == 0\n"
        "assert 'rapidgen.controller' not in sys.modules\n"
        "assert 'rapidgen.rapid' not in sys.modules\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], input=encode(INITIALIZE), capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr.decode()
    assert b'"supportsConfigurationDoneRequest":true' in done.stdout


def test_wrong_messages_do_not_end_the_adapter():
    data = b"".join(
        [
            b'Content-Length: 2\r\n\r\n[]Content-Length: 3\r\n\r\n{"a',
            encode({"type": "request", "seq": "x", "command": 3}),
            encode({"type": "request", "seq": 2, "command": "launch", "arguments": {"program": 3}}),
            encode({"type": "request", "seq": 3, "command": "threads"}),
            encode({"type": "request", "seq": 4, "command": "launch", "arguments": {"speed": -1}}),
            encode(INITIALIZE),
        ]
    )
    messages = answers(data)
    responses = {m["request_seq"]: m["success"] for m in messages if m["type"] == "response"}
    assert responses == {2: False, 3: False, 4: False, 1: True}
    assert any("RG942" in m.get("message", "") for m in messages)


def test_broken_stream_ends_the_adapter():
    (message,) = answers(b"Content-Length: 99999999999999\r\n\r\n" + encode(INITIALIZE))
    assert message["event"] == "output"
    assert "at most" in message["body"]["output"]


def test_tcp_serves_one_client_after_another():
    with subprocess.Popen(
        [sys.executable, "-m", "rapidgen", "dap", "--tcp", "0"], stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            port = int(process.stderr.readline().rpartition(":")[2])
            for _ in range(2):
                with socket.create_connection(("127.0.0.1", port), timeout=10) as own:
                    stream = MessageStream(own.recv, own.sendall)
                    stream.write(INITIALIZE)
                    assert stream.read()["success"]
        finally:
            process.terminate()


@pytest.mark.skipif(not MODULES.is_dir(), reason="npm packages are not installed: .ci/editors")
def test_session_of_microsofts_client(program):
    path = program(PROGRAM)
    done = subprocess.run(
        [
            *node(),
            str(HERE / "microsoft_client.cjs"),
            str(MODULES),
            sys.executable,
            str(HERE / "stdio_adapter.py"),
            str(path),
        ],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env={**os.environ, "PYTHONPATH": str(HERE.parents[1])},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "passed\n"


@pytest.mark.parametrize(
    ("command", "arguments"),
    [
        ("stackTrace", {"threadId": 99}),
        ("stackTrace", {}),
        ("scopes", {"frameId": -1}),
        ("variables", {"variablesReference": 10**30}),
        ("setVariable", {"variablesReference": 1, "name": 3, "value": None}),
        ("setBreakpoints", {"source": {"path": "\0"}, "breakpoints": [{"line": 1}]}),
        ("setBreakpoints", {"source": {"path": "/m.mod"}, "breakpoints": [{"line": "1"}]}),
        ("setBreakpoints", {"source": {"sourceReference": 7}}),
        ("goto", {"threadId": 1, "targetId": 0}),
        ("evaluate", {"expression": ":run nan", "context": "repl"}),
        ("evaluate", {"expression": "work(1)"}),
        ("evaluate", {"expression": "(" * 2000}),
        ("evaluate", {"expression": "\ud800 := \0", "context": "repl"}),
        ("completions", {"text": 1, "column": 1}),
        ("rapidgen/answer", {"number": 1, "value": "x"}),
        ("rapidgen/runTo", {"threadId": 1, "source": {"path": "/m.mod"}, "line": 0}),
        ("launch", {"program": "m.mod"}),
        ("noSuchCommand", {}),
    ],
)
def test_wrong_request_is_refused_and_the_session_goes_on(client, program, command, arguments):
    client.begin(program(PROGRAM), [13])
    client.stopped()
    with pytest.raises(Refused):
        client.ask(command, **arguments)
    assert client.value("total") == "0"
