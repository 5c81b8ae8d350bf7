"""A proxy of our own before real servers: it cuts, delays or garbles at a chosen command.

FTP is read command by command, and its data connections pass the proxy too; of SFTP, which it
cannot read, it counts what the client sends.
"""

import contextlib
import os
import random
import re
import shutil
import socket
import threading

import pytest

from rapidgen.deploy import make_plan
from rapidgen.diagnostics import DiagnosticError

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"
FTP = ("pyftpdlib", "vsftpd", "proftpd", "pure-ftpd")
CHANGES = ("STOR", "RNFR", "RNTO", "DELE", "MKD")
LONG = bool(os.environ.get("RAPIDGEN_LONG"))
pytestmark = [pytest.mark.server, pytest.mark.timeout(1200 if LONG else 300)]


class Proxy:
    """Before a server. `act(number, line) -> None | 'before' | 'after' | bytes`:

    cut before or after command `number`, or answer it with these bytes; `data_limit` cuts every
    data connection after so many bytes.
    """

    def __init__(self, server, act=lambda number, line: None, *, data_limit=None):
        self.host, self.target_port = server.target.host, server.port
        self.act, self.ftp = act, server.target.scheme == "ftp"
        self.data_limit = data_limit
        self.count, self.log, self.cut = 0, [], False
        self.sockets, self.threads = [], []
        self.lock, self.closed = threading.Lock(), False
        self.listener, self.port = self._listen()
        self._spawn(self._accept)

    def _listen(self):
        listener = socket.create_server((self.host, 0))
        return listener, listener.getsockname()[1]

    def _spawn(self, target, *arguments):
        thread = threading.Thread(target=target, args=arguments, daemon=True)
        self.threads.append(thread)
        thread.start()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                client, _ = self.listener.accept()
                self._keep(client)
                server = socket.create_connection((self.host, self.target_port))
                self._keep(server)
                self._spawn(self._commands, client, server)
                self._spawn(self._answers, server, client)

    def _keep(self, *sockets):
        """Sockets to close at the end; at once when the end has come."""
        with self.lock:
            for sock in sockets:
                sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self.sockets.append(sock)
                if self.closed:
                    sock.close()

    def _end(self):
        self.cut = True
        for sock in self.sockets:
            with contextlib.suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)

    def _commands(self, client, server):
        with contextlib.suppress(OSError):
            pending = b""
            while block := client.recv(65536):
                if self.ftp:
                    *lines, pending = (pending + block).split(b"\r\n")
                    for line in lines:
                        self._command(client, server, line + b"\r\n")
                else:
                    self._command(client, server, block)
        self._finish(server)

    def _command(self, client, server, data):
        self.count += 1
        self.log.append(data.split()[0].decode("latin-1") if self.ftp else len(data))
        what = self.act(self.count, data)
        if isinstance(what, bytes):
            client.sendall(what)
        elif what == "before":
            self._end()
        else:
            self.muted = what == "after"
            server.sendall(data)

    muted = False

    def _answers(self, server, client):
        with contextlib.suppress(OSError):
            while block := server.recv(65536):
                if self.muted:  # the server has done it, the answer is lost
                    self._end()
                    break
                if self.ftp and (passive := re.search(rb"227 [^(]*\(([\d,]+)\)", block)):
                    numbers = [int(n) for n in passive[1].split(b",")]
                    port = self._data(numbers[4] * 256 + numbers[5])
                    text = [*self.host.split("."), str(port // 256), str(port % 256)]
                    block = block.replace(passive[1], ",".join(text).encode())
                client.sendall(block)
        self._finish(client)

    def _data(self, port):
        # At once: after a command that it refuses the server lets its port go, and what comes too
        # late can meet the next who has it.
        server = socket.create_connection((self.host, port))
        listener, outer = self._listen()
        self._keep(server, listener)

        def serve():
            with contextlib.suppress(OSError):
                client, _ = listener.accept()
                self._keep(client)
                left = [self.data_limit]
                self._spawn(self._copy, client, server, left)
                self._copy(server, client, left)

        self._spawn(serve)
        return outer

    def _copy(self, source, sink, left):
        with contextlib.suppress(OSError):
            while block := source.recv(4096):
                if left[0] is not None:
                    block, left[0] = block[: left[0]], left[0] - len(block[: left[0]])
                    if not block or left[0] <= 0:
                        sink.sendall(block)
                        self._end()
                        return
                sink.sendall(block)
        self._finish(sink)

    @staticmethod
    def _finish(sock):
        with contextlib.suppress(OSError):
            sock.shutdown(socket.SHUT_WR)

    def close(self):
        with self.lock:
            self.closed = True
            for sock in (self.listener, *self.sockets):
                with contextlib.suppress(OSError):
                    sock.shutdown(socket.SHUT_RDWR)
        for thread in self.threads:
            thread.join(10)
        for sock in (self.listener, *self.sockets):
            sock.close()


@contextlib.contextmanager
def through(server, act=lambda number, line: None, **options):
    """A proxy before `server`, closed at the end."""
    proxy = Proxy(server, act, **options)
    try:
        yield proxy
    finally:
        proxy.close()


def run(kit, server, proxy, wanted, *, action=None):
    """Codes of the refusal of one deployment through the proxy; none when it went through."""
    transport = None
    try:
        transport = server.connect(proxy.port)
        (action or kit.deploy)(transport, wanted)
    except DiagnosticError as error:
        return [d.code for d in error.diagnostics]
    finally:
        if transport is not None:
            transport.close()
    return []


def reset(server, copy):
    for path in server.home.iterdir():
        shutil.rmtree(path)
    shutil.copytree(copy, server.home, dirs_exist_ok=True)
    owner = server.home.stat()
    if owner.st_uid != os.getuid():
        for path in server.home.rglob("*"):
            os.chown(path, owner.st_uid, owner.st_gid)


@pytest.mark.parametrize("server", [*FTP, "paramiko", "sshd"], indirect=True)
def test_cut_at_every_command(kit, server, tmp_path):
    old, new = kit.driver(OLD), kit.driver(NEW)
    transport = server.connect()
    kit.deploy(transport, old)
    transport.close()
    start = tmp_path / "start"
    shutil.copytree(server.home, start)
    if server.kind in ("paramiko", "sshd"):
        # The proxy's port has no host key of its own in known_hosts.
        _alias_host_key(server)
    with through(server) as proxy:
        if proxy.ftp is False:
            _alias_host_key(server, proxy.port)
        assert run(kit, server, proxy, new) == []
        total, log = proxy.count, proxy.log
    assert total > 50
    points = range(1, total + 1)
    if not LONG:
        # One of every command, two of those that change something.
        rng = random.Random(server.kind)
        kinds: dict[object, list[int]] = {}
        for number, word in enumerate(log, 1):
            kinds.setdefault(word if proxy.ftp else number % 4, []).append(number)
        points = []
        for word, numbers in kinds.items():
            points += rng.sample(numbers, min(len(numbers), 2 if word in CHANGES else 1))
    seen = set()
    for number in sorted(points):
        for how in ("before", "after") if LONG else (("after", "before")[number % 2],):
            reset(server, start)
            with through(
                server, lambda n, _, at=number, how=how: how if n == at else None
            ) as proxy:
                if not proxy.ftp:
                    _alias_host_key(server, proxy.port)
                codes = run(kit, server, proxy, new)
            place = f"{server.kind}: {how} command {number} {log[number - 1]}"
            result = kit.verdict(server.home, old, new)
            seen.add(result)
            assert result in ("set 0", "set 1", "refuses"), place
            if codes:
                assert set(codes) <= {"RG501", "RG502", "RG504", "RG505", "RG527"}, (place, codes)
            transport = server.connect()
            kit.deploy(transport, new)
            assert kit.verdict(server.home, new) == "set 0", place
            assert make_plan(transport, new).is_empty, place
            transport.close()
    assert "set 0" in seen


def _alias_host_key(server, port=None):
    from pathlib import Path

    path = Path(server.access.known_hosts)
    line = path.read_text().splitlines()[0]
    ports = [server.port] if port is None else [server.port, port]
    key = line.split(" ", 1)[1]
    path.write_text("".join(f"[{server.target.host}]:{p} {key}\n" for p in ports))


@pytest.mark.parametrize("server", FTP, indirect=True)
def test_cut_in_the_middle_of_data(kit, server, tmp_path):
    old, new = kit.driver(OLD, lines=200), kit.driver(NEW, lines=200)
    transport = server.connect()
    kit.deploy(transport, old)
    transport.close()
    start = tmp_path / "start"
    shutil.copytree(server.home, start)
    for limit in (1, 100, 3000, 4096):
        reset(server, start)
        with through(server, data_limit=limit) as proxy:
            codes = run(kit, server, proxy, new)
        assert codes
        assert kit.verdict(server.home, old) == "set 0"
    transport = server.connect()
    kit.deploy(transport, new)
    transport.close()
    assert kit.verdict(server.home, new) == "set 0"


@pytest.mark.parametrize("server", ["proftpd"], indirect=True)
@pytest.mark.parametrize("without", ["RNFR", "MLSD"])
def test_commands_that_a_server_does_not_know(kit, server, without):
    """No rename: deployment overwrites in place, within the fence."""

    def act(_, line):
        if line.split()[0] == without.encode():
            return b"500 what?\r\n"
        return b"211 none\r\n" if line.split()[0] == b"FEAT" else None

    old, new = kit.driver(OLD), kit.driver(NEW)
    for wanted in (old, new):
        with through(server, act) as proxy:
            assert run(kit, server, proxy, wanted) == []
        assert kit.verdict(server.home, wanted) == "set 0"
    if without == "RNFR":
        state = server.home / "rapidgen_deploy"
        assert {p.name for p in state.iterdir()} == {
            "manifest.json",
            "SYS.cfg",
            "EIO.cfg",
            "backup",
        }


@pytest.mark.parametrize("server", ["vsftpd"], indirect=True)
def test_a_full_disk_is_refused_before_anything_changes(kit, server):
    old, new = kit.driver(OLD), kit.driver(NEW)
    transport = server.connect()
    kit.deploy(transport, old)
    transport.close()
    before = {p: p.read_bytes() for p in server.home.rglob("*") if p.is_file()}

    def act(_, line):
        if line.startswith(b"STOR") and b"ROS_motion.mod.rg-new" in line:
            return b"452 Insufficient storage space.\r\n"
        return None

    with through(server, act) as proxy:
        assert run(kit, server, proxy, new) == ["RG507"]
    assert {p: p.read_bytes() for p in server.home.rglob("*") if p.is_file()} == before


@pytest.mark.parametrize("server", ["vsftpd"], indirect=True)
def test_a_garbled_answer_at_every_command(kit, server):
    wanted = kit.driver(OLD)
    rng = random.Random(7)
    with through(server) as proxy:
        transport = server.connect(proxy.port)
        make_plan(transport, wanted)
        transport.close()
        total = proxy.count
    codes = set()
    for number in range(1, total):
        noise = bytes(rng.randrange(256) for _ in range(rng.randrange(1, 60))) + b"\r\n"
        with through(server, lambda n, _, at=number, x=noise: x if n == at else None) as proxy:
            codes |= set(run(kit, server, proxy, wanted, action=make_plan))
    # RG506: an answer that by chance looks like a refusal.
    assert codes <= {"RG501", "RG502", "RG504", "RG505", "RG506"}
    assert "RG504" in codes
    assert list(server.home.iterdir()) == []
