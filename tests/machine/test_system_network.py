"""Sockets of the operating system, on loopback and free ports."""

import socket

import pytest

from rapidgen.machine.network.interface import BUFFER, Endpoint, NetworkFault, NetworkReason
from rapidgen.machine.network.system import SystemNetwork
from rapidgen.machine.scheduler import S, Scheduler

HOST = "127.0.0.1"
PORT = 11000
NAMED = "192.168.125.1"
"""What a program says; it gets the host."""


class Net(SystemNetwork):
    def __init__(self):
        self.scheduler = Scheduler(clock="real")
        super().__init__(self.scheduler, ports="auto")

    def until(self, result):
        """Return the first result of `result` that is not None."""
        seen = []

        def look():
            value = result()
            if value is not None and value is not False:
                seen.append(value)
            return bool(seen)

        self.scheduler.advance(self.scheduler.now + 30 * S, look)
        return seen[0]

    def pair(self):
        listener = self.bind(NAMED, PORT)
        self.listen(listener)
        client = self.connect(NAMED, PORT)
        server = self.until(lambda: self.accept(listener))
        self.until(lambda: client.connected)
        return listener, client, server


@pytest.fixture
def net():
    network = Net()
    yield network
    network.shut_down()
    network.scheduler.close()


def reason(function, *arguments, **options):
    with pytest.raises(NetworkFault) as fault:
        function(*arguments, **options)
    return fault.value.reason


def test_program_port_maps_to_actual_port(net):
    report = []
    net.listening.add(lambda: report.append(dict(net.listeners)))
    listener, client, server = net.pair()
    assert listener.local[0] == HOST
    assert report == [{PORT: listener.local}]
    assert client.peer == (NAMED, PORT)
    assert server.peer == client.local
    net.close(server)
    assert len(report) == 1
    net.close(listener)
    assert report[1:] == [{}]
    again = net.bind(HOST, PORT)
    assert again.local == listener.local  # a server that comes back is where it was


def test_bytes_go_both_ways_and_end(net):
    _, client, server = net.pair()
    assert net.receive(server, 1) is None
    assert net.send(client, b"hello") == 5
    assert net.until(lambda: net.receive(server, 5, exact=True, peek=True)) == b"hello"
    assert net.receive(server, 6, exact=True) is None
    assert net.receive(server, 2) == b"he"
    assert net.receive(server, 9) == b"llo"
    assert net.send(server, b"back") == 4
    net.close(server)
    assert net.until(lambda: net.receive(client, 4, exact=True)) == b"back"
    assert net.until(lambda: net.receive(client, 1)) == b""
    assert reason(net.send, server, b"x") is NetworkReason.CLOSED


@pytest.mark.parametrize("why", ["abort", "unread"])
def test_a_reset_is_seen_by_the_other_end(net, why):
    _, client, server = net.pair()
    if why == "unread":
        net.send(client, b"xy")
        net.until(lambda: net.receive(server, 2, exact=True, peek=True))
    net.close(server, abort=why == "abort")

    def reset():
        try:
            return net.receive(client, 1)
        except NetworkFault as fault:
            return fault.reason

    assert net.until(reset) is NetworkReason.RESET
    assert reason(net.send, client, b"x") is NetworkReason.RESET


def test_connect_without_listener_is_refused(net):
    bound = net.bind(HOST, 5)
    client = net.connect(HOST, 5)

    def refused():
        try:
            net.receive(client, 1)
        except NetworkFault as fault:
            return fault.reason

    assert net.until(refused) is NetworkReason.REFUSED
    assert not client.connected
    assert not bound.connected


def test_sender_waits_for_buffer_space(net):
    _, client, server = net.pair()
    sent = 0
    while count := net.send(client, bytes(BUFFER)):
        sent += count
    report = []
    client.changed.add(lambda: report.append(1))
    read = 0
    while read < sent:
        read += len(net.until(lambda: net.receive(server, BUFFER)))
    net.until(lambda: bool(report))
    assert net.send(client, b"x") == 1


@pytest.mark.parametrize("port", [-1, 65_536])
def test_invalid_address_is_rejected(net, port):
    assert reason(net.bind, HOST, port) is NetworkReason.ADDRESS_INVALID
    assert reason(net.connect, HOST, port) is NetworkReason.ADDRESS_INVALID
    assert reason(net.connect, HOST, 0) is NetworkReason.ADDRESS_INVALID
    for method in (net.bind, net.connect):
        assert reason(method, "robot.local", 5) is NetworkReason.ADDRESS_INVALID
    assert net.bind(HOST, 65_535).port == 65_535
    assert net.bind(HOST, 1).port == 1


def test_ports_may_be_moved(net):
    with socket.socket() as free:
        free.bind((HOST, 0))
        actual = free.getsockname()[1]
    moved = SystemNetwork(net.scheduler, ports=actual - 1)
    assert moved.bind(HOST, 1).local == (HOST, actual)
    beyond = SystemNetwork(net.scheduler, ports=1)
    assert reason(beyond.bind, HOST, 65_535) is NetworkReason.ADDRESS_INVALID
    moved.shut_down()


def test_a_port_is_taken_once_by_each_protocol(net):
    first = net.bind(HOST, PORT)
    assert reason(net.bind, HOST, PORT) is NetworkReason.ADDRESS_IN_USE
    datagram = net.bind(HOST, PORT, datagram=True)
    assert (first.connected, datagram.connected) == (False, True)
    assert net.bind(HOST, 0).local != net.bind(HOST, 0).local
    net.shut_down()
    assert first.closed
    assert reason(net.accept, first) is NetworkReason.CLOSED


def test_datagrams(net):
    one, other = (net.bind(HOST, port, datagram=True) for port in (7, 8))
    assert net.receive(other, 10) is None
    assert net.send(one, b"hello", (HOST, 8)) == 5
    assert net.until(lambda: net.receive(other, 2, peek=True)) == b"he"
    assert net.receive(other, 4) == b"hell"
    assert other.sender == one.local
    assert reason(net.send, one, b"x") is NetworkReason.FAILED
    assert reason(net.send, one, b"x", ("nowhere", 8)) is NetworkReason.ADDRESS_INVALID
    net.close(other)
    assert reason(net.receive, other, 1) is NetworkReason.CLOSED


def test_endpoints_of_other_networks_are_no_use(net):
    with pytest.raises(TypeError):
        net.accept(Endpoint((HOST, 1)))
