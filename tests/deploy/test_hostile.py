"""Servers that say anything at all: each time a diagnostic, soon, and no password in it."""

import contextlib
import os
import random
import socket
import threading

import pytest

from rapidgen.deploy import make_plan
from rapidgen.deploy.secrets import Credentials, Secret
from rapidgen.deploy.transports.registry import Target
from rapidgen.diagnostics import DiagnosticError, render

ANSWERS = 10_000 if os.environ.get("RAPIDGEN_LONG") else 1_000
LOGIN = Credentials("u", Secret("s3cret-word"))
GOOD = {
    b"": b"220 hello\r\n",
    b"USER": b"331 password?\r\n",
    b"PASS": b"230 in\r\n",
    b"TYPE": b"200 binary\r\n",
    b"FEAT": b"211-x\r\n MLST a;\r\n211 end\r\n",
    b"PWD": b'257 "/"\r\n',
    b"CWD": b"250 ok\r\n",
    b"PASV": b"227 ok (127,0,0,1,%d,%d)\r\n",
    b"MLSD": b"150 ok\r\n226 done\r\n",
    b"LIST": b"150 ok\r\n226 done\r\n",
    b"RETR": b"150 ok\r\n226 done\r\n",
}


class Liar:
    """An FTP server that answers well until a step, then says `lie`; then goes on or hangs up."""

    def __init__(self):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.lie, self.step, self.data = b"", 0, b""
        self.thread = threading.Thread(target=self._serve, daemon=True)
        self.thread.start()

    def _serve(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            with client, contextlib.ExitStack() as held, contextlib.suppress(OSError):
                self._talk(client, held)

    def _talk(self, client, held):
        client.settimeout(30)
        pending, count, data = b"", 0, None
        word = b""
        while True:
            answer = GOOD.get(word, b"250 ok\r\n")
            if word == b"PASV":
                data = held.enter_context(socket.create_server(("127.0.0.1", 0)))
                data.settimeout(2)
                port = data.getsockname()[1]
                answer %= (port // 256, port % 256)
            if count == self.step:
                client.sendall(self.lie)
                return
            if word in (b"MLSD", b"LIST", b"RETR") and data is not None:
                with data.accept()[0] as line:
                    line.sendall(self.data)
            client.sendall(answer)
            count += 1
            while b"\r\n" not in pending:
                block = client.recv(4096)
                if not block:
                    return
                pending += block
            line, _, pending = pending.partition(b"\r\n")
            word = line.split(b" ")[0].upper()

    def close(self):
        self.listener.shutdown(socket.SHUT_RDWR)
        self.thread.join(5)
        self.listener.close()


@pytest.fixture
def liar():
    server = Liar()
    yield server
    server.close()


def lies(rng):
    """One hostile answer: noise, near misses, echoes of the password, answers without an end."""
    digits = "".join(rng.choice("0123456789") for _ in range(3)).encode()
    noise = bytes(rng.randrange(256) for _ in range(rng.randrange(80)))
    numbers = ",".join(str(rng.choice([0, 1, 127, 255, 256, 10**9])) for _ in range(6)).encode()
    return rng.choice(
        [
            noise,
            noise + b"\r\n",
            digits + b" " + noise + b"\r\n",
            digits + b"-" + noise + b"\r\n" * rng.randrange(3),
            digits + b"-" + b"x\r\n" * 600,
            b"227 (" + numbers + b")\r\n",
            b"227 " + noise + b"\r\n",
            b"257 " + noise + b"\r\n",
            b'257 "' + b"A" * 9000 + b'"\r\n',
            b"9" * 20_000,
            b"530 wrong: s3cret-word\r\n",
            b"",
        ]
    )


def outcome(port):
    """Diagnostics of one plan against the server, or none when it went through."""
    transport = None
    try:
        transport = Target("ftp", "127.0.0.1", port, "").open(LOGIN, 0.5)
        make_plan(transport, None)
    except DiagnosticError as error:
        return error.diagnostics
    finally:
        if transport is not None:
            transport.close()
    return ()


def test_garbled_answers_are_a_diagnostic_each(liar):
    rng = random.Random(20_26)
    codes: dict[str, int] = {}
    for number in range(ANSWERS):
        liar.step, liar.lie = number % 12, lies(rng)
        result = outcome(liar.port)
        assert result
        codes[result[0].code] = codes.get(result[0].code, 0) + 1
        displayed = render(result)
        assert "s3cret-word" not in displayed
        assert "\x1b" not in displayed
    assert set(codes) <= {"RG501", "RG502", "RG504", "RG505", "RG506", "RG507", "RG529"}
    assert min(codes["RG501"], codes["RG504"], codes["RG505"]) > 10


@pytest.mark.parametrize(
    "data",
    [
        b"x" * 5_000_000,
        b"a\r\n" * 30_000,
        b"type=file;size=99999999999999999999999; ../../x\r\n",
        b"type=dir; HOME\r\ntype=dir; \xff\xfe\r\n",
    ],
)
def test_hostile_listings(liar, data):
    liar.step, liar.data = 999, data
    for result in outcome(liar.port):
        assert result.code in ("RG504", "RG505", "RG506", "RG529")
