"""Socket built-ins on the network in memory. Sources: 3HAC16581-1 [manual], abb_driver [code]."""

import pytest

from rapidgen.machine.network.sockets import SocketDevice, SocketStatus
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import RawBytes
from rapidgen.runtime.switches import Switches
from tests.runtime.booting import boot

PORT = 5000


def serve(bench, task, server, client, **options):
    bench.call(task, "SocketCreate", server)
    bench.call(task, "SocketBind", server, "127.0.0.1", PORT)
    bench.call(task, "SocketListen", server)
    bench.call(task, "SocketAccept", server, client, **options)


def connect(bench, task, socket, **options):
    bench.call(task, "SocketCreate", socket)
    bench.call(task, "SocketConnect", socket, "127.0.0.1", PORT, **options)


def pair(bench, serving, asking):
    """Run a server's and a client's body over one connection."""
    server, accepted, client = SocketDevice(), SocketDevice(), SocketDevice()

    def one(task):
        serve(bench, task, server, accepted)
        return serving(task, accepted)

    def two(task):
        task.sleep(0.01)
        connect(bench, task, client)
        return asking(task, client)

    return bench.run(one, two)


def failure(bench, task, name, *args, **options):
    with pytest.raises(RapidError) as caught:
        bench.call(task, name, *args, **options)
    return caught.value.name


def test_fresh_socket_shows_as_closed_and_states_follow_the_calls(bench):
    """abb_driver sets a server up by asking for the status at every step [code]."""
    socket = SocketDevice()

    def body(task):
        seen = [bench.call(task, "SocketGetStatus", socket)]
        for name, args in (
            ("SocketCreate", ()),
            ("SocketBind", ("127.0.0.1", PORT)),
            ("SocketListen", ()),
            ("SocketClose", ()),
            ("SocketClose", ()),
        ):
            bench.call(task, name, socket, *args)
            seen.append(bench.call(task, "SocketGetStatus", socket))
        return seen

    assert bench.run(body) == [[5, 1, 3, 4, 5, 5]]


def test_exact_reads_split_a_stream_at_byte_1_of_the_buffer(bench):
    """A rawbytes buffer is filled from byte 1 and its length is what came [abb_driver, code]."""
    raw = RawBytes(b"something longer that was there")
    count = bench.box(0)

    def serving(task, socket):
        bench.call(task, "SocketReceive", socket, RawData=raw, ReadNoOfBytes=4)
        first = bytes(raw.data)
        bench.call(task, "SocketReceive", socket, RawData=raw, ReadNoOfBytes=3, NoRecBytes=count)
        return first, bytes(raw.data), count.get()

    def asking(task, socket):
        for part in (b"ab", b"cde", b"fg"):
            bench.call(task, "SocketSend", socket, RawData=RawBytes(part))
            task.sleep(0.05)

    assert pair(bench, serving, asking)[0] == (b"abcd", b"efg", 3)


def test_receive_without_a_count_takes_what_is_there_up_to_80_characters(bench):
    text = bench.box("")

    def serving(task, socket):
        got = []
        for _ in range(2):
            bench.call(task, "SocketReceive", socket, Str=text)
            got.append(text.get())
        return got

    def asking(task, socket):
        bench.call(task, "SocketSend", socket, Str="x" * 80)
        bench.call(task, "SocketSend", socket, Str="yz")
        task.sleep(1)

    def late(task, socket):
        task.sleep(0.5)
        return serving(task, socket)

    assert pair(bench, late, asking)[0] == ["x" * 80, "yz"]


def test_bytes_that_came_before_a_time_out_stay(bench):
    """[mem]: so that RETRY loses nothing."""
    raw = RawBytes()

    def serving(task, socket):
        error = failure(
            bench, task, "SocketReceive", socket, RawData=raw, ReadNoOfBytes=4, Time=0.2
        )
        waiting = bench.call(task, "SocketPeek", socket)
        task.sleep(1)
        bench.call(task, "SocketReceive", socket, RawData=raw, ReadNoOfBytes=4)
        return error, waiting, bytes(raw.data)

    def asking(task, socket):
        bench.call(task, "SocketSend", socket, RawData=RawBytes(b"ab"))
        task.sleep(0.5)
        bench.call(task, "SocketSend", socket, RawData=RawBytes(b"cd"))
        task.sleep(1)

    assert pair(bench, serving, asking)[0] == ("ERR_SOCK_TIMEOUT", 2, b"abcd")


def test_peer_that_closes_is_seen_by_the_operation_not_by_the_status(bench):
    """ERR_SOCK_CLOSED; the status is the program's own view [manual]."""

    def serving(task, socket):
        task.sleep(1)
        before = bench.call(task, "SocketGetStatus", socket)
        error = failure(bench, task, "SocketReceive", socket, RawData=RawBytes())
        return before, error, bench.call(task, "SocketGetStatus", socket)

    def asking(task, socket):
        bench.call(task, "SocketClose", socket)

    assert pair(bench, serving, asking)[0] == (2, "ERR_SOCK_CLOSED", 5)


def test_what_was_sent_before_a_close_still_arrives(bench):
    text = bench.box("")

    def serving(task, socket):
        task.sleep(1)
        bench.call(task, "SocketReceive", socket, Str=text)
        return text.get(), failure(bench, task, "SocketReceive", socket, Str=text)

    def asking(task, socket):
        bench.call(task, "SocketSend", socket, Str="bye")
        bench.call(task, "SocketClose", socket)

    assert pair(bench, serving, asking)[0] == ("bye", "ERR_SOCK_CLOSED")


def test_part_of_a_buffer_is_sent_and_received_as_data(bench):
    """\\NoOfBytes is 1 to the length; \\Data fills the first elements and leaves the others."""
    data = bench.box({1: 9, 2: 9, 3: 9, 4: 9}, None, (4,))

    def serving(task, socket):
        bench.call(task, "SocketReceive", socket, Data=data, Time=5)
        return data.get()

    def asking(task, socket):
        raw = RawBytes(b"\1\2\3")
        errors = [
            failure(bench, task, "SocketSend", socket, RawData=raw, NoOfBytes=n)
            for n in (0, 4, 1.5)
        ]
        bench.call(task, "SocketSend", socket, Data={1: 1, 2: 2, 3: 3}, NoOfBytes=2)
        errors.append(failure(bench, task, "SocketSend", socket, Data={1: 256}))
        return errors

    assert pair(bench, serving, asking) == [
        {1: 1, 2: 2, 3: 9, 4: 9},
        ["ERR_ARGVALERR"] * 4,
    ]


@pytest.mark.parametrize("count", [0, 81, -1, 1.5])
def test_a_count_that_the_buffer_cannot_hold(bench, count):
    def serving(task, socket):
        return failure(bench, task, "SocketReceive", socket, Str=bench.box(""), ReadNoOfBytes=count)

    assert pair(bench, serving, lambda task, socket: None)[0] == "ERR_ARGVALERR"


def test_default_times_are_60_seconds(bench):
    server, client = SocketDevice(), SocketDevice()

    def body(task):
        with pytest.raises(RapidError) as caught:
            serve(bench, task, server, client)
        return caught.value.name, round(bench.now)

    assert bench.run(body) == [("ERR_SOCK_TIMEOUT", 60)]


def test_wait_max_waits_for_ever(bench):
    server, client = SocketDevice(), SocketDevice()

    def late(task):
        task.sleep(20_000_000)
        connect(bench, task, SocketDevice())

    def body(task):
        serve(bench, task, server, client, Time=9_999_999)
        return int(client.status)

    assert bench.run(body, late)[0] == SocketStatus.CONNECTED


def test_slow_reader_makes_the_sender_wait_and_then_time_out(bench):
    """64 kB of room in either buffer, then back-pressure; 60 s without progress [mem]."""

    def serving(task, socket):
        task.sleep(1000)

    def asking(task, socket):
        sent = 0
        while True:
            start = bench.now
            try:
                bench.call(task, "SocketSend", socket, RawData=RawBytes(bytes(1024)))
            except RapidError as error:
                return sent, error.name, round(bench.now - start)
            sent += 1024

    sent, error, waited = pair(bench, serving, asking)[1]
    assert sent == 2 * 65_536
    assert (error, waited) == ("ERR_SOCK_TIMEOUT", 60)


def test_a_socket_connects_again_behind_a_failure(bench):
    """A RETRY of SocketConnect, without a new socket: Keyence's CV-X modules [code]."""
    socket = SocketDevice()

    def calling(task):
        bench.call(task, "SocketCreate", socket)
        failed = failure(bench, task, "SocketConnect", socket, "127.0.0.1", PORT)
        task.sleep(1)
        bench.call(task, "SocketConnect", socket, "127.0.0.1", PORT)
        bench.call(task, "SocketSend", socket, Str="hello")
        return failed

    def serving(task):
        task.sleep(0.5)
        server, accepted, text = SocketDevice(), SocketDevice(), bench.box("")
        bench.call(task, "SocketCreate", server)
        bench.call(task, "SocketBind", server, "127.0.0.1", PORT)
        bench.call(task, "SocketListen", server)
        bench.call(task, "SocketAccept", server, accepted)
        bench.call(task, "SocketReceive", accepted, Str=text)
        return text.get()

    assert bench.run(calling, serving) == ["ERR_SOCK_TIMEOUT", "hello"]


def test_refused_connect_and_what_follows(bench):
    """The socket has to be closed and created again, and which error: [mem]."""
    bench.controller.dialect = Switches(failed_connect="create")
    socket = SocketDevice()

    def body(task):
        bench.call(task, "SocketCreate", socket)
        seen = [
            failure(bench, task, "SocketConnect", socket, "127.0.0.1", PORT),
            failure(bench, task, "SocketConnect", socket, "127.0.0.1", PORT),
        ]
        bench.call(task, "SocketClose", socket)
        bench.call(task, "SocketCreate", socket)
        seen.append(failure(bench, task, "SocketConnect", socket, "127.0.0.1", 70_000))
        return seen

    assert bench.run(body) == [["ERR_SOCK_TIMEOUT", "ERR_SOCK_UNSPEC", "ERR_SOCK_ADDR_INVALID"]]


@pytest.mark.parametrize(
    ("switch", "error"),
    [("unreachable", "ERR_SOCK_NET_UNREACH"), ("closed", "ERR_SOCK_CLOSED")],
)
def test_a_refused_connect_in_other_dialects(bench, switch, error):
    bench.controller.dialect = Switches(refused_connect=switch)
    socket = SocketDevice()

    def body(task):
        bench.call(task, "SocketCreate", socket)
        return failure(bench, task, "SocketConnect", socket, "127.0.0.1", PORT)

    assert bench.run(body) == [error]


def test_bytes_before_a_time_out_are_gone_in_the_other_dialect(bench):
    bench.controller.dialect = Switches(receive_timeout="drop")

    def serving(task, socket):
        raw = RawBytes()
        failure(bench, task, "SocketReceive", socket, RawData=raw, ReadNoOfBytes=4, Time=0.2)
        return bench.call(task, "SocketPeek", socket)

    def asking(task, socket):
        bench.call(task, "SocketSend", socket, RawData=RawBytes(b"ab"))
        task.sleep(1)

    assert pair(bench, serving, asking)[0] == 0


@pytest.mark.parametrize(
    ("steps", "name", "args", "error"),
    [
        ((), "SocketBind", ("127.0.0.1", 1), "ERR_SOCK_CLOSED"),
        ((), "SocketListen", (), "ERR_SOCK_CLOSED"),
        (("SocketCreate",), "SocketCreate", (), "ERR_SOCK_UNSPEC"),
        (("SocketCreate",), "SocketListen", (), "ERR_SOCK_NOT_BOUND"),
        (("SocketCreate",), "SocketSend", (), "ERR_SOCK_NOT_CONN"),
        (("SocketCreate",), "SocketPeek", (), "ERR_SOCK_NOT_CONN"),
    ],
)
def test_wrong_order_of_calls(bench, steps, name, args, error):
    socket = SocketDevice()
    options = {"Str": "x"} if name == "SocketSend" else {}

    def body(task):
        for step in steps:
            bench.call(task, step, socket)
        return failure(bench, task, name, socket, *args, **options)

    assert bench.run(body) == [error]


def test_port_in_use_and_bound_twice(bench):
    one, two = SocketDevice(), SocketDevice()

    def body(task):
        for socket in (one, two):
            bench.call(task, "SocketCreate", socket)
        bench.call(task, "SocketBind", one, "127.0.0.1", PORT)
        seen = [
            failure(bench, task, "SocketBind", one, "127.0.0.1", PORT + 1),
            failure(bench, task, "SocketBind", two, "127.0.0.1", PORT),
        ]
        bench.call(task, "SocketClose", one)
        bench.call(task, "SocketBind", two, "127.0.0.1", PORT)
        return seen

    assert bench.run(body) == [["ERR_SOCK_IS_BOUND", "ERR_SOCK_ADDR_INUSE"]]


def test_the_33rd_socket_is_refused_and_a_closed_one_makes_room(bench):
    """32 sockets of a controller (switch `sockets_limited`): a leak is stopped by an error."""
    sockets = [SocketDevice() for _ in range(33)]

    def body(task):
        for socket in sockets[:32]:
            bench.call(task, "SocketCreate", socket)
        error = failure(bench, task, "SocketCreate", sockets[32])
        bench.call(task, "SocketClose", sockets[0])
        bench.call(task, "SocketCreate", sockets[32])
        return error

    assert bench.run(body) == ["ERR_SOCK_UNSPEC"]


def test_any_number_of_sockets_in_the_other_dialect():
    text = (
        "VAR socketdev many{40};\nPROC main()\n FOR i FROM 1 TO 40 DO\n SocketCreate many{i};\n"
        ' ENDFOR\n TPWrite "40";\nERROR\n TPWrite "full";\n EXIT;\nENDPROC'
    )
    for limited, told in ((True, ["full"]), (False, ["40"])):
        controller, printed = boot(text, dialect=Switches(sockets_limited=limited), cycle="once")
        with controller:
            controller.start_program()
            controller.run(max_time=10)
        assert printed == told


def test_closing_a_task_closes_its_sockets_only(bench):
    mine, others = SocketDevice(), SocketDevice()
    bench.run(
        lambda task: bench.call(task, "SocketCreate", mine),
        lambda task: bench.call(task, "SocketCreate", others),
    )
    bench.controller.sockets.close_task("T1")
    assert (mine.status, others.status) == (SocketStatus.CLOSED, SocketStatus.CREATED)


def test_a_crowd_waits_until_there_is_room_in_the_backlog(bench):
    """16 clients wait to be accepted; the 17th asks again, as TCP does, and is served."""
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


def test_datagrams(bench):
    one, two = SocketDevice(), SocketDevice()
    text, address, port = bench.box(""), bench.box(""), bench.box(0)

    def receiver(task):
        bench.call(task, "SocketCreate", one, UDP=True)
        bench.call(task, "SocketBind", one, "127.0.0.1", PORT)
        bench.call(task, "SocketReceiveFrom", one, address, port, Str=text, Time=5)
        bench.call(task, "SocketSendTo", one, address.get(), port.get(), Str="back")
        return text.get()

    def sender(task):
        task.sleep(0.1)
        bench.call(task, "SocketCreate", two, UDP=True)
        bench.call(task, "SocketSendTo", two, "127.0.0.1", PORT, Str="hello")
        answer = bench.box("")
        bench.call(task, "SocketReceiveFrom", two, bench.box(""), bench.box(0), Str=answer, Time=5)
        return answer.get()

    assert bench.run(receiver, sender) == ["hello", "back"]


def test_a_cut_cable_is_not_told(bench):
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


def test_a_reset_is_told_to_both_sides_at_once(bench):
    network = bench.controller.network

    def serving(task, socket):
        network.reset(socket.endpoint)
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes())

    def asking(task, socket):
        return failure(bench, task, "SocketReceive", socket, RawData=RawBytes())

    assert pair(bench, serving, asking) == ["ERR_SOCK_CLOSED", "ERR_SOCK_CLOSED"]
    assert bench.now < 0.1


def test_closing_with_unread_bytes_resets_the_peer(bench):
    """As TCP does: the peer's next operation fails even though it was never told to end."""

    def serving(task, socket):
        task.sleep(0.1)
        bench.call(task, "SocketClose", socket)

    def asking(task, socket):
        bench.call(task, "SocketSend", socket, Str="never read")
        task.sleep(1)
        return failure(bench, task, "SocketSend", socket, Str="again")

    assert pair(bench, serving, asking)[1] == "ERR_SOCK_CLOSED"
