"""The JSON control socket: answers, limits, and clients that misbehave."""

import json
import socket

import pytest

from rapidgen.machine.scheduler import Scheduler
from rapidgen.servers.control_socket import MAX_CLIENTS, MAX_LINE, CommandError, ControlSocket


@pytest.fixture
def served():
    """A scheduler and a control socket with two commands and an event source."""
    scheduler = Scheduler(clock="real")
    listeners = []

    def subscribe(listener, trusted):
        listeners.append((listener, trusted))
        return lambda: listeners.remove((listener, trusted))

    def fail(_request):
        raise CommandError("cannot be done")

    changed = []
    commands = {
        "echo": lambda request: request.get("value"),
        "fail": fail,
        "change": lambda request: changed.append(request["value"]),
        "changes": lambda _request: [*changed],
    }
    control = ControlSocket(
        scheduler, commands, subscribe, readable=("echo", "fail", "changes"), token="good-token"
    )
    yield scheduler, control, listeners
    control.close()
    scheduler.close()


def client(control):
    sock = socket.create_connection(control.address, timeout=60)
    sock.setblocking(False)
    return sock


def until(scheduler, condition):
    """Let the scheduler run until `condition()`, at most 5 s."""
    scheduler.advance(until=scheduler.now + 5_000_000_000, stop=condition)
    assert condition()


def is_closed(sock):
    try:
        return sock.recv(1, socket.MSG_PEEK) == b""
    except BlockingIOError:
        return False


def receive(scheduler, sock, lines=1):
    data = bytearray()

    def target():
        try:
            while part := sock.recv(65_536):
                data.extend(part)
        except BlockingIOError:
            pass
        return data.count(b"\n") >= lines

    # The scheduler serves its sockets; ours is looked at between its turns.
    for _ in range(5000):
        if target():
            return [json.loads(line) for line in data.splitlines()]
        scheduler.advance(until=scheduler.now + 1_000_000)
    raise AssertionError(f"only {bytes(data)!r} came")


def ask(scheduler, sock, *requests):
    sock.sendall(b"".join(json.dumps(r).encode() + b"\n" for r in requests))
    return receive(scheduler, sock, len(requests))


def test_requests_and_answers(served):
    scheduler, control, _ = served
    with client(control) as sock:
        assert ask(
            scheduler, sock, {"do": "echo", "value": [1, 2], "id": 7}, {"do": "fail", "id": "x"}
        ) == [
            {"id": 7, "ok": True, "result": [1, 2]},
            {"id": "x", "ok": False, "error": "cannot be done"},
        ]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (b"{}", "object"),
        (b'{"do": 3}', "object"),
        (b'{"do": "dance"}', "can do change, changes, echo, fail, subscribe"),
    ],
)
def test_unknown_request_gets_an_answer_and_the_connection_stays(served, line, words):
    scheduler, control, _ = served
    with client(control) as sock:
        sock.sendall(line + b"\n")
        (answer,) = receive(scheduler, sock)
        assert answer["ok"] is False
        assert words in answer["error"]
        assert ask(scheduler, sock, {"do": "echo", "value": 1})[0]["ok"]


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"token": ""},
        {"token": None},
        {"token": "good-toke"},
        {"token": "good-token "},
        {"token": ["good-token"]},
        {"token": "good-tok\u00e9n"},
        {"token": "\ud800"},
        {"Token": "good-token"},
    ],
)
def test_a_change_without_the_token_is_refused_with_a_reason(served, given):
    scheduler, control, _ = served
    with client(control) as sock:
        refused, changes, done, after = ask(
            scheduler,
            sock,
            {"do": "change", "value": 1, "id": 1, **given},
            {"do": "changes"},
            {"do": "change", "value": 2, "token": "good-token"},
            {"do": "changes"},
        )
    assert (refused["ok"], refused["id"]) == (False, 1)
    assert "token" in refused["error"]
    assert "good-token" not in refused["error"]
    assert changes["result"] == []
    assert done["ok"]
    assert after["result"] == [2]


def test_the_token_is_of_one_request_and_not_of_the_connection(served):
    scheduler, control, _ = served
    with client(control) as sock:
        first, second = ask(
            scheduler,
            sock,
            {"do": "change", "value": 1, "token": "good-token"},
            {"do": "change", "value": 2},
        )
    assert (first["ok"], second["ok"]) == (True, False)


def test_each_socket_makes_a_token_of_its_own():
    scheduler = Scheduler(clock="real")
    made = [ControlSocket(scheduler, {}, lambda *_: lambda: None) for _ in range(2)]
    assert len({control.token for control in made}) == 2
    assert all(len(control.token) >= 32 for control in made)
    for control in made:
        control.close()
    scheduler.close()


def test_a_subscription_is_trusted_with_the_token_only(served):
    scheduler, control, listeners = served
    token = {"token": "good-token"}
    with client(control) as sock:
        for given, trusted in (({}, False), (token, True), ({}, True), (token, True)):
            ask(scheduler, sock, {"do": "subscribe", **given})
            assert [flag for _, flag in listeners] == [trusted]


def test_a_line_without_end_is_cut_off(served):
    scheduler, control, _ = served
    with client(control) as sock:
        sock.setblocking(True)
        sock.sendall(b"x" * (MAX_LINE + 10))
        sock.setblocking(False)
        (answer,) = receive(scheduler, sock)
        assert "at most" in answer["error"]
        until(scheduler, lambda: not control._clients)


def test_events_flow_after_subscribe_and_end_with_the_client(served):
    scheduler, control, listeners = served
    with client(control) as sock:
        ask(scheduler, sock, {"do": "subscribe"})
        listeners[0][0]({"event": "log", "code": 10_011})
        assert receive(scheduler, sock) == [{"event": "log", "code": 10_011}]
    until(scheduler, lambda: not listeners)


def test_a_client_that_does_not_read_is_dropped(served):
    scheduler, control, listeners = served
    with client(control) as sock:
        ask(scheduler, sock, {"do": "subscribe"})
        for _ in range(2000):
            if not listeners:
                break
            listeners[0][0]({"event": "x", "text": "y" * 10_000})
        assert not listeners


def test_clients_beyond_the_limit_are_closed_and_the_others_served(served):
    scheduler, control, _ = served
    first, crowd = client(control), []
    for number in range(40):
        # Each is looked at before the next: more than wait in line would hang in their connect.
        crowd.append(client(control))
        until(scheduler, lambda n=number: len(control._clients) > n + 1 or is_closed(crowd[n]))
    assert ask(scheduler, first, {"do": "echo", "value": 1})[0]["ok"]
    assert len(control._clients) == MAX_CLIENTS
    for sock in (first, *crowd):
        sock.close()
    until(scheduler, lambda: not control._clients)
