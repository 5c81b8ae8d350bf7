"""Socket built-ins on the system's sockets, in real time."""

import socket
import threading

import pytest

from rapidgen.machine.network.interface import NetworkFault, NetworkReason
from rapidgen.machine.network.sockets import SocketDevice, SocketStatus
from rapidgen.machine.network.system import SystemNetwork
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import RawBytes
from tests.ports import free_port


@pytest.fixture
def real(make_bench):
    """A real-time bench on any free ports."""
    return make_bench(clock="real", network=lambda k: SystemNetwork(k, ports="auto"))


def serve(bench, task, server, accepted, port=11000):
    bench.call(task, "SocketCreate", server)
    bench.call(task, "SocketBind", server, "192.168.125.1", port)
    bench.call(task, "SocketListen", server)
    bench.call(task, "SocketAccept", server, accepted, Time=10)


def talk(bench, script, port=11000):
    """Run `script(socket)` in a thread once the bench listens.

    Raises its errors here.
    """
    started, failed = [], []

    def client(address):
        try:
            with socket.create_connection(address, timeout=60) as sock:
                script(sock)
        except OSError as error:
            failed.append(error)

    def begin():
        if not started and port in bench.controller.network.listeners:
            thread = threading.Thread(
                target=client, args=(bench.controller.network.listeners[port],)
            )
            started.append(thread)
            thread.start()

    bench.controller.network.listening.add(begin)

    def finish():
        started[0].join(10)
        if failed:
            raise failed[0]

    return finish


def test_an_echo_over_loopback(real):
    server, accepted, raw = SocketDevice(), SocketDevice(), RawBytes()
    seen = []

    def script(sock):
        sock.sendall(b"hel")
        sock.sendall(b"lo")
        seen.append(sock.recv(100))

    finish = talk(real, script)

    def body(task):
        address = real.box("")
        serve(real, task, server, accepted)
        real.call(task, "SocketReceive", accepted, RawData=raw, ReadNoOfBytes=5)
        real.call(task, "SocketSend", accepted, RawData=raw)
        return address.get()

    real.run(body)
    finish()
    assert seen == [b"hello"]


def test_binding_is_to_loopback_for_any_address(real):
    endpoint = real.controller.network.bind("192.168.125.1", 11000)
    assert endpoint.local[0] == "127.0.0.1"
    assert endpoint.local[1] != 11000


def test_ports_are_moved_by_an_offset(make_bench):
    free = free_port()
    bench = make_bench(clock="real", network=lambda k: SystemNetwork(k, ports=free - 11000))
    endpoint = bench.controller.network.bind("127.0.0.1", 11000)
    bench.controller.network.listen(endpoint)
    assert bench.controller.network.listeners == {11000: ("127.0.0.1", free)}


def test_port_of_other_process_is_in_use(make_bench):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        bench = make_bench(clock="real", network=SystemNetwork)
        with pytest.raises(NetworkFault) as caught:
            bench.controller.network.bind("127.0.0.1", port)
    assert caught.value.reason is NetworkReason.ADDRESS_IN_USE


def test_reset_and_end_of_client_differ(real):
    server, accepted = SocketDevice(), SocketDevice()

    def script(sock):
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")

    finish = talk(real, script)

    def body(task):
        serve(real, task, server, accepted)
        with pytest.raises(RapidError) as caught:
            real.call(task, "SocketReceive", accepted, RawData=RawBytes(), Time=10)
        return caught.value.name, accepted.status

    assert real.run(body) == [("ERR_SOCK_CLOSED", SocketStatus.CLOSED)]
    finish()


def test_peer_without_reads_blocks_sender(real):
    """Back-pressure blocks the task until the peer reads."""
    server, accepted = SocketDevice(), SocketDevice()
    total = 4_000_000
    gate = threading.Event()

    def script(sock):
        gate.wait(60)
        got = 0
        while got < total:
            got += len(sock.recv(65_536))

    finish = talk(real, script)
    blocked = []

    def body(task):
        serve(real, task, server, accepted)
        network = real.controller.network
        sent = 0
        while sent < total:
            in_use = network.send(accepted.endpoint, bytes(min(65_536, total - sent)))
            sent += in_use
            if not in_use:
                blocked.append(sent)
                gate.set()
                task.wait_for(
                    lambda: network.send(accepted.endpoint, b"") == 0 or True, timeout=0.001
                )
                task.sleep(0.001)
        return sent

    assert real.run(body) == [total]
    finish()
    assert blocked
    assert blocked[0] < total


def test_connecting_out_reaches_this_machine_only(real):
    """A loopback controller reaches this machine for any address."""
    with socket.socket() as partner:
        partner.bind(("127.0.0.1", 0))
        partner.listen()
        port = partner.getsockname()[1]
        client = SocketDevice()

        def body(task):
            real.call(task, "SocketCreate", client)
            real.call(task, "SocketConnect", client, "192.168.125.77", port, Time=10)
            real.call(task, "SocketSend", client, Str="hi")

        real.run(body)
        accepted, _ = partner.accept()
        with accepted:
            assert accepted.recv(10) == b"hi"


def test_refused(real):
    client = SocketDevice()

    def body(task):
        real.call(task, "SocketCreate", client)
        with pytest.raises(RapidError) as caught:
            real.call(task, "SocketConnect", client, "127.0.0.1", port, Time=10)
        return caught.value.name

    with socket.socket() as deaf:  # bound, so in use, and without listen()
        deaf.bind(("127.0.0.1", 0))
        port = deaf.getsockname()[1]
        assert real.run(body) == ["ERR_SOCK_TIMEOUT"]


def test_a_thousand_connections_do_not_hurt(real):
    """A flood fills the backlog and is ignored; the first in line are served."""
    server, accepted = SocketDevice(), SocketDevice()
    served = []

    def script(sock):
        address = sock.getpeername()
        flood = []
        for _ in range(300):
            one = socket.socket()
            one.setblocking(False)
            one.connect_ex(address)
            flood.append(one)
        sock.sendall(b"x")
        for one in flood:
            one.close()

    finish = talk(real, script)

    def body(task):
        serve(real, task, server, accepted)
        real.call(task, "SocketReceive", accepted, RawData=RawBytes(), ReadNoOfBytes=1, Time=10)
        served.append(1)

    real.run(body)
    finish()
    assert served
