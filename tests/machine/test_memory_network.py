"""TCP and UDP in memory: ports, segments, room, ends, resets and silence.

Real stacks do all of it alike: RFC 9293 (3.5 connections, 3.6 ends, 3.8.6 windows), RFC 768.
"""

import pytest

from rapidgen.machine.network.interface import BUFFER, Endpoint, NetworkFault, NetworkReason
from rapidgen.machine.network.memory import BACKLOG, LATENCY, MSS, MemoryNetwork
from rapidgen.machine.scheduler import Scheduler

HOST = "127.0.0.1"
PORT = 11000


class Net(MemoryNetwork):
    """A network with its scheduler, a listener at PORT, and connections."""

    def __init__(self):
        self.scheduler = Scheduler()
        super().__init__(self.scheduler)
        self.listener = self.bind(HOST, PORT)
        self.listen(self.listener)

    def pair(self):
        client = self.connect(HOST, PORT)
        self.scheduler.advance()
        return client, self.accept(self.listener)

    def settle(self):
        self.scheduler.advance()


@pytest.fixture
def net():
    return Net()


def reason(function, *arguments, **options):
    with pytest.raises(NetworkFault) as fault:
        function(*arguments, **options)
    return fault.value.reason


@pytest.mark.parametrize("port", [-1, 65_536])
def test_ports_end_at_65535(net, port):
    assert reason(net.bind, HOST, port) is NetworkReason.ADDRESS_INVALID
    assert reason(net.connect, HOST, port) is NetworkReason.ADDRESS_INVALID
    assert net.bind(HOST, 65_535).local == (HOST, 65_535)
    assert net.bind(HOST, 1).local == (HOST, 1)
    assert reason(net.connect, HOST, 0) is NetworkReason.ADDRESS_INVALID
    assert net.connect(HOST, 65_535).peer == (HOST, 65_535)


def test_port_is_bound_once_per_protocol(net):
    datagram = net.bind(HOST, PORT, datagram=True)
    assert reason(net.bind, HOST, PORT) is NetworkReason.ADDRESS_IN_USE
    assert reason(net.bind, HOST, PORT, datagram=True) is NetworkReason.ADDRESS_IN_USE
    net.close(datagram)
    assert net.bind(HOST, PORT, datagram=True).connected
    first, second = net.bind(HOST, 0), net.bind(HOST, 0)
    assert first.local[1] == 49_152
    assert second.local[1] == 49_153
    assert not first.connected


def test_listeners_are_listed(net):
    report = []
    net.listening.add(lambda: report.append(dict(net.listeners)))
    other = net.bind(HOST, 5)
    assert net.listeners == {PORT: (HOST, PORT)}
    net.listen(other)
    net.close(net.listener)
    assert report == [{PORT: (HOST, PORT), 5: (HOST, 5)}, {5: (HOST, 5)}]
    net.close(net.bind(HOST, 6))  # it has not listened: nothing to tell
    assert len(report) == 2
    assert reason(net.accept, net.listener) is NetworkReason.CLOSED


def test_a_connection_has_two_ends(net):
    report = []
    client = net.connect(HOST, PORT)
    client.changed.add(lambda: report.append("client"))
    net.listener.changed.add(lambda: report.append("listener"))
    assert (client.connected, net.accept(net.listener)) == (False, None)
    assert net.send(client, b"too early") == 0
    net.scheduler.advance(LATENCY + 1)
    server = net.accept(net.listener)
    assert report == ["client", "listener"]
    assert client.connected
    assert server.connected
    assert (server.local, server.peer) == (client.peer, client.local)
    assert net.accept(net.listener) is None


def test_connect_without_listener_is_refused(net):
    bound = net.bind(HOST, 5)
    for port in (5, 6):
        report = []
        client = net.connect(HOST, port)
        client.changed.add(lambda report=report: report.append(1))
        net.settle()
        assert report == [1]
        assert not client.connected
        assert reason(net.receive, client, 1) is NetworkReason.REFUSED
        assert reason(net.send, client, b"x") is NetworkReason.REFUSED
    net.listen(bound)
    given_up = net.connect(HOST, 5)
    net.close(given_up)
    net.settle()
    assert net.accept(bound) is None


def test_full_backlog_delays_next_client(net):
    clients = [net.connect(HOST, PORT) for _ in range(BACKLOG + 1)]
    net.scheduler.advance(LATENCY + 1)
    assert [c.connected for c in clients] == [True] * BACKLOG + [False]
    accepted = net.accept(net.listener)
    assert accepted.peer == clients[0].local
    net.scheduler.advance(1_000_000_000 + LATENCY - 1)
    assert not clients[-1].connected
    net.scheduler.advance(1_000_000_000 + LATENCY + 1)
    assert clients[-1].connected


def test_bytes_arrive_in_order_after_the_latency(net):
    client, server = net.pair()
    began = net.scheduler.now
    report = []
    server.changed.add(lambda: report.append(net.scheduler.now - began))
    data = bytes(range(200)) * 10
    assert net.send(client, data) == 2000
    assert net.receive(server, 1) is None
    net.settle()
    assert report == [LATENCY] * 2
    assert len(data) > MSS
    assert net.receive(server, 1, peek=True) == data[:1]
    assert net.receive(server, 2001, exact=True) is None
    assert net.receive(server, 1999, exact=True) == data[:1999]
    assert net.receive(server, 10) == data[1999:]
    assert net.receive(server, 1) is None
    assert net.send(server, b"back") == 4
    net.settle()
    assert net.receive(client, 100) == b"back"


def test_sender_waits_for_reader(net):
    client, server = net.pair()
    report = []
    client.changed.add(lambda: report.append(1))
    assert net.send(client, bytes(BUFFER + 1)) == BUFFER
    net.settle()
    assert net.send(client, bytes(BUFFER + 1)) == BUFFER
    assert net.send(client, b"x") == 0
    net.settle()
    report.clear()
    assert len(net.receive(server, 10, peek=True)) == 10
    assert report == []
    assert len(net.receive(server, 1)) == 1
    assert report == [1]
    assert net.send(client, b"xx") == 1
    net.settle()
    assert len(net.receive(server, BUFFER)) == BUFFER
    assert report == [1, 1]
    net.settle()
    assert len(net.receive(server, 2 * BUFFER)) == BUFFER
    assert net.receive(server, 1) is None


def test_sent_data_precede_end(net):
    client, server = net.pair()
    net.send(client, b"bye")
    report = []
    client.changed.add(lambda: report.append(1))
    net.close(client)
    net.close(client)
    assert report == [1]
    assert reason(net.send, client, b"x") is NetworkReason.CLOSED
    assert net.receive(server, 1) is None
    net.settle()
    assert net.receive(server, 100) == b"bye"
    assert net.receive(server, 100) == b""
    assert net.send(server, b"x") == 1
    net.settle()
    assert reason(net.send, server, b"x") is NetworkReason.RESET


def test_the_end_waits_for_a_full_buffer(net):
    client, server = net.pair()
    net.send(client, bytes(BUFFER))
    net.settle()
    net.send(client, b"last")
    net.close(client)
    net.settle()
    assert len(net.receive(server, BUFFER)) == BUFFER
    assert net.receive(server, 1) is None
    net.settle()
    assert net.receive(server, 10) == b"last"
    net.settle()
    assert net.receive(server, 10) == b""


@pytest.mark.parametrize("why", ["abort", "unread", "reset", "listener", "shut down"])
def test_a_reset_is_seen_by_the_other_end(net, why):
    client, server = net.pair()
    report = []
    client.changed.add(lambda: report.append(1))
    net.send(server, bytes(3 * BUFFER))
    if why == "abort":
        net.close(server, abort=True)
    elif why == "unread":
        net.send(client, b"x")
        net.settle()
        report.clear()
        net.close(server)
    elif why == "reset":
        net.reset(server)
    elif why == "listener":
        client = net.connect(HOST, PORT)
        net.settle()
        net.close(net.listener)
    else:
        net.shut_down()
        assert (client.closed, net.listeners) == (True, {})
        return
    net.settle()
    while net.receive(client, BUFFER) if client.fault is None else None:
        pass
    while client.incoming.arrived:
        net.receive(client, BUFFER)
    assert reason(net.receive, client, 1) is NetworkReason.RESET
    if why == "reset":
        assert reason(net.send, server, b"x") is NetworkReason.RESET


def test_silent_connection_passes_nothing(net):
    client, server = net.pair()
    net.send(client, b"under way")
    net.silence(server)
    for one, other in ((client, server), (server, client)):
        assert net.send(one, b"x") == 1
        net.settle()
        assert net.receive(other, 1) is None
    net.close(client, abort=True)
    net.settle()
    assert net.receive(server, 1) is None
    assert server.fault is None


def test_datagrams(net):
    one, other = (net.bind(HOST, port, datagram=True) for port in (7, 8))
    report = []
    other.changed.add(lambda: report.append(1))
    assert net.receive(other, 10) is None
    assert net.send(one, b"hello", (HOST, 8)) == 5
    assert net.send(one, b"unread", (HOST, 9)) == 6
    assert net.send(one, b"second", (HOST, 8)) == 6
    assert net.receive(other, 10) is None
    net.settle()
    assert report == [1, 1]
    assert net.receive(other, 2, peek=True) == b"he"
    assert net.receive(other, 4) == b"hell"
    assert other.sender == (HOST, 7)
    assert net.receive(other, 10) == b"second"
    assert reason(net.send, one, b"x") is NetworkReason.FAILED
    net.close(other)
    assert reason(net.receive, other, 1) is NetworkReason.CLOSED


def test_datagrams_beyond_buffer_are_lost(net):
    one, other = (net.bind(HOST, port, datagram=True) for port in (7, 8))
    net.send(one, bytes(BUFFER - 1), (HOST, 8))
    net.send(one, b"xx", (HOST, 8))
    net.send(one, b"y", (HOST, 8))
    net.settle()
    assert len(net.receive(other, BUFFER)) == BUFFER - 1
    assert net.receive(other, BUFFER) == b"y"
    assert net.receive(other, BUFFER) is None


def test_endpoints_of_other_networks_are_no_use(net):
    with pytest.raises(TypeError):
        net.accept(Endpoint((HOST, 1)))
