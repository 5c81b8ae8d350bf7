"""SFTP servers that say anything at all: a diagnostic or a sound result, never a traceback.

Two places to garble: the line below SSH, byte by byte in both directions, and the answers inside
the encrypted channel, where SSH itself guards nothing. A traceback in a thread of paramiko's
or ours fails the test too (pytest turns it into an error).
"""

import contextlib
import os
import random
import socket
import threading

import paramiko
import pytest

from rapidgen.deploy import make_plan
from rapidgen.deploy.secrets import Credentials, Secret
from rapidgen.deploy.transports.registry import Target
from rapidgen.diagnostics import DiagnosticError, render
from rapidgen.servers import serve_sftp

SEEDS = 5_000 if os.environ.get("RAPIDGEN_LONG") else 100
"""Of each of the two; `benchmarks/deploy.py --cuts` is the long form."""
OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"
WORD = "s3cret-word"
TIMEOUT = 0.3
HONEST = 20.0
"""Where the answer comes: a busy machine takes its time."""


@pytest.fixture
def service(home):
    server = serve_sftp(home, user="u", password=WORD)
    yield server
    server.close()


def access(service, tmp_path, port):
    """A login at `port`, where the service's key is the known one."""
    known = tmp_path / f"known-{port}"
    known.write_text(f"[127.0.0.1]:{port} {service.host_key.split(' ', 1)[1]}\n")
    return Credentials("u", Secret(WORD), known_hosts=str(known))


def attempt(action, port, login, timeout=TIMEOUT):
    """Diagnostics of `action` over a connection of its own; none when it went through."""
    transport = None
    try:
        transport = Target("sftp", "127.0.0.1", port, "").open(login, timeout)
        action(transport)
        result = ()
    except DiagnosticError as error:
        result = error.diagnostics
    finally:
        if transport is not None:
            transport.close()
    assert all(d.code.startswith("RG5") for d in result)
    displayed = render(result)
    assert WORD not in displayed
    assert "\x1b" not in displayed
    return result


# -- the line -----------------------------------------------------------------------------------


def spoil(rng, block):
    """`block` with one byte changed, some missing, or some too many."""
    at = rng.randrange(len(block))
    noise = bytes(rng.randrange(256) for _ in range(rng.randrange(1, 40)))
    return rng.choice(
        [
            block[:at] + bytes([block[at] ^ (1 << rng.randrange(8))]) + block[at + 1 :],
            block[:at] + noise + block[at:],
            block[:at] + block[at + rng.randrange(1, 20) :],
            block[:at] + noise + block[at + len(noise) :],
        ]
    )


class Line:
    """A proxy that spoils the packet `number` of one direction; counts those of both."""

    def __init__(self, port, rng, direction, number):
        self.target_port, self.rng, self.damaged = port, rng, (direction, number)
        self.count = [0, 0]
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.threads = [threading.Thread(target=self._accept)]
        self.threads[0].start()

    def _accept(self):
        with contextlib.suppress(OSError):
            client, _ = self.listener.accept()
            server = socket.create_connection(("127.0.0.1", self.target_port))
            back = threading.Thread(target=self._pipe, args=(server, client, 1))
            back.start()
            self._pipe(client, server, 0)
            back.join()
            client.close()
            server.close()

    def _pipe(self, source, sink, direction):
        with contextlib.suppress(OSError):
            while block := source.recv(65536):
                if (direction, self.count[direction]) == self.damaged:
                    block = spoil(self.rng, block)
                self.count[direction] += 1
                sink.sendall(block)
        for sock in (source, sink):
            with contextlib.suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)

    def close(self):
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        for thread in self.threads:
            thread.join(10)
        self.listener.close()


def test_damaged_connection_is_a_diagnostic(service, tmp_path):
    def look(transport):
        make_plan(transport, None, verb="rollback")

    codes = {}
    for seed in range(SEEDS):
        rng = random.Random(f"line {seed}")
        line = Line(service.port, rng, rng.randrange(2), rng.randrange(14))
        try:
            result = attempt(look, line.port, access(service, tmp_path, line.port))
        finally:
            line.close()
        code = result[0].code if result else "through"
        codes[code] = codes.get(code, 0) + 1
    # SSH covers every byte but the padding of the first packets.
    assert codes.get("through", 0) < SEEDS / 5, codes


# -- the answers --------------------------------------------------------------------------------


def lie(rng, kind, data):
    """An answer like (kind, data), but not quite; the request's number mostly stays."""
    number, body = data[:4], data[4:]
    big = rng.choice([2**31, 2**32 - 1, 2**24, 70_000, 0]).to_bytes(4, "big")
    at = rng.randrange(len(body) + 1)
    noise = bytes(rng.randrange(256) for _ in range(rng.randrange(60)))
    text = f"\x1b[31m {WORD} \r\n".encode()
    status = rng.randrange(40).to_bytes(4, "big") + len(text).to_bytes(4, "big") + text
    return rng.choice(
        [
            (kind, number + body[:at]),
            (kind, number + noise),
            (kind, number + big + body[4:]),
            (kind, number + body[:at] + big + body[at + 4 :]),
            (kind, number + body[:at] + noise + body[at + len(noise) :]),
            (kind, data[: rng.randrange(4)]),
            (kind, noise),
            (rng.randrange(256), data),
            (rng.choice([101, 102, 103, 104, 105]), number + noise),
            (104, number + big + b"\0" * 40),
            (105, number + b"\x80\0\0\0" + big),
            (101, number + status),
        ]
    )


@pytest.fixture
def liar(monkeypatch):
    """paramiko's server with one answer that is a lie: `at` says which, `rng` how."""

    class Liar(paramiko.SFTPServer):
        at, count, rng = 0, 0, random.Random(0)

        def _send_packet(self, kind, packet):
            data = packet.asbytes()
            Liar.count += 1
            if Liar.count == Liar.at:
                kind, data = lie(Liar.rng, kind, data)
            super()._send_packet(kind, paramiko.Message(data))

    monkeypatch.setattr(paramiko, "SFTPServer", Liar)
    return Liar


def test_garbled_answers_are_a_diagnostic_or_harmless(kit, service, liar, home, tmp_path):
    """During a deployment; afterwards HOME holds the old set, the new one, or one that refuses."""
    import shutil

    old, new = kit.driver(OLD), kit.driver(NEW)
    login = access(service, tmp_path, service.port)
    assert attempt(lambda t: kit.deploy(t, old), service.port, login, HONEST) == ()
    start = tmp_path / "start"
    shutil.copytree(home, start)
    liar.count = 0
    assert attempt(lambda t: kit.deploy(t, new), service.port, login, HONEST) == ()
    total = liar.count
    assert total > 100
    codes = {}
    for seed in range(SEEDS):
        rng = random.Random(f"answers {seed}")
        for path in home.iterdir():
            shutil.rmtree(path)
        shutil.copytree(start, home, dirs_exist_ok=True)
        liar.count, liar.at, liar.rng = 0, rng.randint(1, total), rng
        result = attempt(lambda t: kit.deploy(t, new), service.port, login)
        code = result[0].code if result else "through"
        codes[code] = codes.get(code, 0) + 1
        place = f"seed {seed}, answer {liar.at} of {total}: {code}"
        assert kit.verdict(home, old, new) in ("set 0", "set 1", "refuses"), place
        if not result:
            assert kit.verdict(home, new) == "set 0", place
    assert codes["RG504"] > SEEDS / 10, codes


ENTRY = b"\0\0\0\x01a" + b"\0\0\0\0" + b"\0\0\0\0"  # name, long name, no attributes


@pytest.mark.parametrize(
    "listing",
    [
        b"\x40\0\0\0" + b"\0" * 40,
        b"\0\0\0\x01" + ENTRY[:-4] + b"\x80\0\0\0\x7f\xff\xff\xff",
        b"\0\0\x01\xf4" + ENTRY * 500,
    ],
    ids=["2^30 names", "2^31 attributes", "for ever"],
)
def test_a_listing_without_an_end_ends(service, liar, tmp_path, monkeypatch, listing):
    def endless(self, kind, packet):
        data = packet.asbytes()
        liar.count += 1
        if liar.count > 4:  # version, where HOME is, that it is a folder, its handle
            kind, data = 104, data[:4] + listing
        super(liar, self)._send_packet(kind, paramiko.Message(data))

    monkeypatch.setattr(liar, "_send_packet", endless)
    login = access(service, tmp_path, service.port)
    result = attempt(lambda t: t.entries(""), service.port, login, HONEST)
    assert [d.code for d in result] == ["RG504"]


def test_a_server_that_falls_silent_is_a_diagnostic(service, liar, tmp_path, monkeypatch):
    """At the request for SFTP itself, where paramiko knows no time limit."""
    silent = threading.Event()

    def wait(self, channel, name):
        silent.wait(20)
        return False

    monkeypatch.setattr(paramiko.ServerInterface, "check_channel_subsystem_request", wait)
    result = attempt(lambda t: None, service.port, access(service, tmp_path, service.port))
    silent.set()
    assert [d.code for d in result] == ["RG505"]


def test_a_request_without_an_answer_says_that_it_timed_out(service, liar, tmp_path, monkeypatch):
    def mute(self, kind, packet):
        liar.count += 1
        if liar.count <= 3:  # version, where HOME is, that it is a folder
            super(liar, self)._send_packet(kind, packet)

    monkeypatch.setattr(liar, "_send_packet", mute)
    login = access(service, tmp_path, service.port)
    transport = Target("sftp", "127.0.0.1", service.port, "").open(login, HONEST)
    transport._sftp.get_channel().settimeout(TIMEOUT)
    with contextlib.closing(transport), pytest.raises(DiagnosticError) as refused:
        transport.entries("rapidgen")
    (result,) = refused.value.diagnostics
    assert (result.code, result.message) == ("RG505", "rapidgen: timed out")
