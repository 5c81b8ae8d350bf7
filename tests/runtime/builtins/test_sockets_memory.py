"""Socket built-ins on the network in memory.

Programs test the rest: conformance/.
"""

import pytest

from rapidgen.machine.network.sockets import SocketDevice, SocketStatus
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import RawBytes

PORT = 5000


def serve(bench, task, server, client, **options):
    bench.call(task, "SocketCreate", server)
    bench.call(task, "SocketBind", server, "127.0.0.1", PORT)
    bench.call(task, "SocketListen", server)
    bench.call(task, "SocketAccept", server, client, **options)


def pair(bench, serving, asking):
    """Run a server's and a client's body over one connection."""
    server, accepted, client = SocketDevice(), SocketDevice(), SocketDevice()

    def one(task):
        serve(bench, task, server, accepted)
        return serving(task, accepted)

    def two(task):
        task.sleep(0.01)
        bench.call(task, "SocketCreate", client)
        bench.call(task, "SocketConnect", client, "127.0.0.1", PORT)
        return asking(task, client)

    return bench.run(one, two)


def failure(bench, task, name, *args, **options):
    with pytest.raises(RapidError) as caught:
        bench.call(task, name, *args, **options)
    return caught.value.name


def test_closing_a_task_closes_its_sockets_only(bench):
    mine, others = SocketDevice(), SocketDevice()
    bench.run(
        lambda task: bench.call(task, "SocketCreate", mine),
        lambda task: bench.call(task, "SocketCreate", others),
    )
    bench.controller.sockets.close_task("T1")
    assert (mine.status, others.status) == (SocketStatus.CLOSED, SocketStatus.CREATED)


def test_many_clients_wait_for_backlog(bench):
    """16 clients wait for accept; the 17th repeats its request, as in TCP."""
    network = bench.controller.network
    server = SocketDevice()
    accepted = [SocketDevice() for _ in range(20)]

    def body(task):
        serve(bench, task, server, accepted[0])
        task.sleep(0.5)
        for client in accepted[1:]:
            bench.call(task, "SocketAccept", server, client, Time=3)
        return round(bench.now)

    def crowd(task):
        task.sleep(0.1)
        endpoints = [network.connect("127.0.0.1", PORT) for _ in range(20)]
        task.sleep(0.4)
        early = sum(endpoint.connected for endpoint in endpoints)
        task.sleep(3)
        return early, sum(endpoint.connected for endpoint in endpoints)

    assert bench.run(body, crowd)[1] == (17, 20)


def test_a_closed_endpoint_gives_its_port_back(bench):
    network = bench.controller.network
    first = network.bind("127.0.0.1", 0)
    network.close(first)
    assert network.bind("127.0.0.1", 0).local == first.local


def test_cut_cable_is_not_reported(bench):
    """Only the reader's own time-out ends the wait; what is sent vanishes."""
    network = bench.controller.network

    def serving(task, socket):
        network.silence(socket.endpoint)
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes(), Time=3)

    def asking(task, socket):
        task.sleep(0.1)
        bench.call(task, "SocketSend", socket, Str="into the void")
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes(), Time=2)

    assert pair(bench, serving, asking) == ["ERR_SOCK_TIMEOUT", "ERR_SOCK_TIMEOUT"]


def test_reset_reaches_both_sides_at_once(bench):
    network = bench.controller.network

    def serving(task, socket):
        network.reset(socket.endpoint)
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes())

    def asking(task, socket):
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes())

    assert pair(bench, serving, asking) == ["ERR_SOCK_CLOSED", "ERR_SOCK_CLOSED"]
    assert bench.now < 0.1
