"""Sockets in use: owners, maximum number, and notifications."""

import pytest

from rapidgen.machine.network.interface import NetworkFault, NetworkReason
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import (
    MAX_SOCKETS,
    SocketDevice,
    SocketNews,
    SocketStatus,
    SocketTable,
)
from rapidgen.machine.scheduler import Scheduler

HOST = "127.0.0.1"


class Table(SocketTable):
    def __init__(self, **options):
        self.scheduler = Scheduler()
        self.network = MemoryNetwork(self.scheduler)
        super().__init__(self.network, **options)
        self.news = []
        self.listeners.append(self.news.append)

    def bound(self, port, task):
        device = SocketDevice()
        device.endpoint, device.status = self.network.bind(HOST, port), SocketStatus.BOUND
        self.add(device, task)
        return device

    def connected(self, task):
        listener = self.bound(11000, "T_OTHER")
        self.network.listen(listener.endpoint)
        device, peer = SocketDevice(), self.network.connect(HOST, 11000)
        self.scheduler.advance()
        device.endpoint = self.network.accept(listener.endpoint)
        device.status = SocketStatus.CONNECTED
        self.add(device, task)
        return device, peer


@pytest.fixture
def table():
    return Table()


def test_every_socket_of_a_task_is_closed_and_none_of_another(table):
    own = [table.bound(port, "T_ROB1") for port in (1, 2, 3)]
    other = table.bound(4, "T_ROB2")
    endpoints = [device.endpoint for device in own]
    table.close_task("T_ROB1")
    assert all(endpoint.closed for endpoint in endpoints)
    assert {device.status for device in own} == {SocketStatus.CLOSED}
    assert {device.endpoint for device in own} == {None}
    assert dict(table.in_use) == {other: "T_ROB2"}
    assert not other.endpoint.closed
    table.release(own[0])


@pytest.mark.parametrize(("limited", "full"), [(True, True), (False, False)])
def test_number_of_sockets_is_limited(limited, full):
    # [S4 datasys SocketCreate: 32 sockets; switch `sockets_limited`]
    table = Table(limited=limited)
    for _ in range(MAX_SOCKETS - 1):
        table.add(SocketDevice(), "T_ROB1")
    assert not table.full
    last = SocketDevice()
    table.add(last, "T_ROB1")
    assert table.full is full
    table.release(last)
    assert not table.full


def test_listeners_receive_connection_and_end(table):
    device, peer = table.connected("T_ROB1")
    here, target = device.endpoint.local, device.endpoint.peer
    assert table.connections() == [SocketNews("open", "T_ROB1", here, target)]
    table.tell("in", device, b"x")
    table.tell("out", device, b"y", ("10.0.0.1", 5))
    table.release(device)
    table.release(device)
    assert table.news == [
        SocketNews("in", "T_ROB1", here, target, b"x"),
        SocketNews("out", "T_ROB1", here, ("10.0.0.1", 5), b"y"),
        SocketNews("close", "T_ROB1", here, target),
    ]
    assert table.connections() == []
    table.scheduler.advance()
    assert table.network.receive(peer, 1) == b""


@pytest.mark.parametrize("abort", [True, False])
def test_aborted_socket_is_reset(table, abort):
    device, peer = table.connected("T_ROB1")
    table.release(device, abort=abort)
    table.scheduler.advance()
    if abort:
        with pytest.raises(NetworkFault):
            table.network.receive(peer, 1)
    else:
        assert table.network.receive(peer, 1) == b""


def test_cut_connection_is_reset_at_both_ends(table):
    device, peer = table.connected("T_ROB1")
    table.cut(device)
    table.scheduler.advance()
    for endpoint in (device.endpoint, peer):
        with pytest.raises(NetworkFault) as fault:
            table.network.receive(endpoint, 1)
        assert fault.value.reason is NetworkReason.RESET
    table.cut(SocketDevice())
