"""The control socket: every line gets an answer, what is no JSON object closes the connection."""

import contextlib
import json
import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.controller.operation import ACTIONS
from rapidgen.servers.control_commands import READABLE, commands, subscribe
from rapidgen.servers.control_socket import ControlSocket
from rapidgen.system.model import SignalSpec
from tests.runtime.booting import boot

PROGRAM = """
  PERS num n := 1;
  PERS pos p := [1,2,3];
  VAR string s := "a";
  VAR num list{3};
  VAR socketdev sock;
  CONST num C := 5;
  PROC main()
    WaitTime 0.01;
  ENDPROC
"""


class Client:
    """One connection: a line out, a line in."""

    def __init__(self, port: int, token: str) -> None:
        self.port = port
        self.token = token
        self.connect()

    def connect(self) -> None:
        self.socket = socket.create_connection(("127.0.0.1", self.port), timeout=60)
        self.file = self.socket.makefile("rb")

    def send(self, line: bytes) -> dict:
        """Send a line; connect again if the answer is that it is no JSON object."""
        self.socket.sendall(line.replace(b"\n", b" ") + b"\n")
        answer = json.loads(self.file.readline())
        if not answer["ok"] and "JSON" in answer["error"]:
            with contextlib.suppress(ConnectionResetError):
                assert self.file.read() == b""
            self.close()
            self.connect()
        return answer

    def ask(self, do: str, **request: object) -> dict:
        return self.send(json.dumps({"do": do, "token": self.token, **request}).encode())

    def close(self) -> None:
        self.file.close()
        self.socket.close()


@pytest.fixture(scope="module")
def client():
    controller, _ = boot(PROGRAM, signals=(SignalSpec("di", "DI"),), clock="real")
    with controller:
        control = ControlSocket(
            controller.scheduler,
            commands(controller),
            lambda tell, trusted: subscribe(controller, tell, trusted),
            readable=READABLE,
        )
        controller.start_program()
        controller.start()
        made = Client(control.address[1], control.token)
        yield made
        made.close()
        controller.call(control.close)


def test_values(client: Client) -> None:
    assert client.ask("set", task="t1", name="m:n", value="2.5")["ok"]
    assert client.ask("get", task="T1", name="m:n") == {"ok": True, "result": "2.5"}
    assert client.ask("get", task="T1", name="p", id=7) == {
        "id": 7,
        "ok": True,
        "result": "[1,2,3]",
    }
    for name in ("c", "sock", "nothing", "x:n"):
        assert not client.ask("set", task="T1", name=name, value="1")["ok"]
    assert not client.ask("get", task="T1", name="sock")["ok"]


def test_every_request_that_may_change_something_needs_the_token(client: Client) -> None:
    known = client.ask("?")["error"].split("can do ")[1].split(", ")
    changing = sorted({*known} - READABLE - {"subscribe"})
    assert {*ACTIONS, "mode", "override", "set", "set-signal", "answer", "step"} == {*changing}
    before = client.ask("status")["result"]
    request = {"task": "T1", "name": "di", "value": 1, "number": 1}
    for do in changing:
        answer = client.send(json.dumps({**request, "do": do}).encode())
        assert not answer["ok"]
        assert "token" in answer["error"]
    after = client.ask("status")["result"]
    assert {**before, "time": 0} == {**after, "time": 0}
    assert client.ask("signals")["result"] == {"di": 0}
    for do in sorted(READABLE):
        answer = client.send(json.dumps({"do": do, "task": "T1", "name": "n"}).encode())
        assert answer["ok"], answer


DIALOG = """
  VAR num n;
  PROC main()
    TPReadNum n, "how many";
  ERROR
    TPWrite "absent";
  ENDPROC
"""


@pytest.mark.parametrize(("trusted", "displayed"), [(False, "absent"), (True, None)])
def test_a_dialog_waits_only_for_who_may_answer(trusted: bool, displayed: str | None) -> None:
    controller, _ = boot(DIALOG)
    with controller:
        notify = []
        end = subscribe(controller, notify.append, trusted)
        controller.start_program()
        controller.run_for(1.0)
        requested = [event["text"] for event in notify if event["event"] == "question"]
        wrote = [event["text"] for event in notify if event["event"] == "screen"]
        assert (requested, wrote) == ((["how many"], []) if trusted else ([], [displayed]))
        end()


def test_step(client: Client) -> None:
    assert not client.ask("step", task="T1")["ok"]  # it runs
    assert not client.ask("step", task="absent")["ok"]
    client.ask("stop")
    assert client.ask("step", task="T1")["ok"]
    client.ask("start")


@pytest.mark.parametrize(
    "line",
    [
        b"garbage",
        b"\x00\xff\xfe",
        b"[]",
        b"{}",
        b'{"do": 5}',
        b'{"do": "nope"}',
        b"[" * 60_000,
        b'{"do": "status", "id": NaN}',
        b'{"do": "status", "id": 1e999}',
        b'{"do": "status", "id": [[]]}',
        b'{"do": "set-signal", "name": "di", "value": 1e999}',
        b'{"do": "set-signal", "name": "di", "value": -Infinity}',
        b'{"do": "set-signal", "name": "di", "value": 1' + b"0" * 400 + b"}",
        b'{"do": "set-signal", "name": "di", "value": 0.5}',
        b'{"do": "override", "value": 1' + b"0" * 5000 + b"}",
        b'{"do": "answer", "number": 1e999, "value": "x"}',
        b'{"do": "get", "task": [], "name": {}}',
        b'{"do": "set", "task": "T1", "name": "n", "value": "1E400"}',
        b'{"do": "set", "task": "T1", "name": "list", "value": "[1,2]"}',
    ],
)
def test_nonsense_is_refused_in_words(client: Client, line: bytes) -> None:
    answer = client.send(line)
    assert not answer["ok"]
    assert answer["error"]
    assert client.ask("where")["ok"]


VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text()
    | st.sampled_from(["T1", "m:n", "p", "s", "list", "sock", "di", "[1,2,3]", '"x"', "1E39"]),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=5,
)
# What would stop the program for the other tests is left out.
WORDS = sorted(
    {"get", "set", "set-signal", "log", "answer", "override", "questions", "screen", "where"}
    | {"status", "signals"}
)


@given(
    st.sampled_from(WORDS) | st.text(),
    st.dictionaries(
        st.sampled_from(["task", "name", "value", "number", "since", "group", "id", "without"]),
        VALUES,
    ),
)
def test_any_request_gets_an_answer(client: Client, do: str, request: dict) -> None:
    if do in ("e-stop", "stop", "power-loss", "manual", "motors-off", "subscribe"):
        return
    token = {} if "without" in request else {"token": client.token}
    answer = client.send(json.dumps({**request, **token, "do": do}).encode())
    assert answer["ok"] or answer["error"]


@pytest.mark.parametrize(
    "header",
    [
        b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: text/plain\r\n\r\n",
        b"\r\n\r\nPOST / HTTP/1.1\r\n\r\n",
        b"PUT /\n",
        b"[1]\n",
        b'"text"\n',
        b"null\n",
        b"\x16\x03\x01\n",
    ],
)
def test_request_of_a_web_page_is_not_executed(client: Client, header: bytes) -> None:
    client.ask("set", task="t1", name="m:n", value="1")
    order = {"do": "set", "token": client.token, "task": "t1", "name": "m:n", "value": "7"}
    other = Client(client.port, client.token)
    other.socket.sendall(header + json.dumps(order).encode() + b"\n")
    with contextlib.suppress(ConnectionResetError):
        answers = other.file.read().splitlines()
        assert [json.loads(answer)["ok"] for answer in answers] == [False]
    other.close()
    assert client.ask("get", task="t1", name="m:n")["result"] == "1"


def test_a_line_without_end_is_cut_off(client: Client) -> None:
    port = client.socket.getpeername()[1]
    other = Client(port, client.token)
    other.socket.sendall(b"x" * 100_000)
    assert not json.loads(other.file.readline())["ok"]
    with contextlib.suppress(ConnectionResetError):  # what was never read makes it a reset
        assert other.file.read() == b""
    other.close()
    assert client.ask("status")["ok"]
