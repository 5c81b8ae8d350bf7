"""Fault plans: what a program sees of a connection that misbehaves."""

import pytest

from rapidgen.controller.faults import ControllerRule, read_plan
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.network.fault_injection import FaultyNetwork, NetworkRule
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import SocketDevice
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import RawBytes


@pytest.fixture
def server(make_bench):
    """Makes a bench whose RAPID server on port 5000 has the given rules."""

    def make(*rules):
        inner = []

        def network(scheduler):
            inner.append(MemoryNetwork(scheduler))
            return FaultyNetwork(inner[0], scheduler, rules)

        bench = make_bench(network=network)
        return bench, inner[0]

    return make


def serve(bench, body):
    listener, client = SocketDevice(), SocketDevice()

    def run(task):
        bench.call(task, "SocketCreate", listener)
        bench.call(task, "SocketBind", listener, "127.0.0.1", 5000)
        bench.call(task, "SocketListen", listener)
        bench.call(task, "SocketAccept", listener, client)
        return body(task, client)

    return run


def outside(bench, inner, script):
    """A client that is not under the plan."""

    def run(task):
        task.sleep(0.01)
        endpoint = inner.connect("127.0.0.1", 5000)
        task.wait_for(lambda: endpoint.connected, on=(endpoint.changed,))
        return script(task, endpoint)

    return run


def chunks(bench, count):
    """Receive until `count` bytes arrived: (milliseconds, bytes) of each."""

    def body(task, socket):
        got, raw = [], RawBytes()
        while sum(len(data) for _, data in got) < count:
            bench.call(task, "SocketReceive", socket, RawData=raw, Time=5)
            got.append((round(bench.now * 1000), bytes(raw.data)))
        return got

    return body


def test_split(server):
    bench, inner = server(NetworkRule("split", port=5000, direction="in", bytes=3))
    got = bench.run(
        serve(bench, chunks(bench, 8)),
        outside(bench, inner, lambda t, e: inner.send(e, b"abcdefgh")),
    )[0]
    assert [data for _, data in got] == [b"abc", b"def", b"gh"]


def test_merge_gathers_separate_sends(server):
    bench, inner = server(NetworkRule("merge", direction="in", seconds=0.2))

    def script(task, endpoint):
        for part in (b"ab", b"cd", b"ef"):
            inner.send(endpoint, part)
            task.sleep(0.02)

    got = bench.run(serve(bench, chunks(bench, 6)), outside(bench, inner, script))[0]
    assert [data for _, data in got] == [b"abcdef"]


def test_delay_keeps_order_and_content(server):
    bench, inner = server(NetworkRule("delay", direction="in", seconds=0.5, after=2))
    got = bench.run(
        serve(bench, chunks(bench, 6)), outside(bench, inner, lambda t, e: inner.send(e, b"abcdef"))
    )[0]
    assert [data for _, data in got] == [b"ab", b"cdef"]
    assert got[1][0] - got[0][0] == pytest.approx(500, abs=5)


def test_reset_after_byte_n(server):
    bench, inner = server(NetworkRule("reset", direction="in", after=4))

    def body(task, socket):
        raw = RawBytes()
        bench.call(task, "SocketReceive", socket, RawData=raw, Time=5)
        with pytest.raises(RapidError) as caught:
            bench.call(task, "SocketReceive", socket, RawData=RawBytes(), Time=5)
        return bytes(raw.data), caught.value.name

    got = bench.run(
        serve(bench, body), outside(bench, inner, lambda t, e: inner.send(e, b"abcdef"))
    )
    assert got[0] == (b"abcd", "ERR_SOCK_CLOSED")


def test_silent_after_byte_n_outwards(server):
    """The program gets no notification, the client only the first bytes."""
    bench, inner = server(NetworkRule("silent", direction="out", after=5, connection=1))

    def body(task, socket):
        for _ in range(3):
            bench.call(task, "SocketSend", socket, Str="abc")
        task.sleep(1)

    def script(task, endpoint):
        task.sleep(0.5)
        return inner.receive(endpoint, 100), inner.receive(endpoint, 100)

    got = bench.run(serve(bench, body), outside(bench, inner, script))
    assert got[1] == (b"abcab", None)


def test_half_open_hides_the_end_until_the_second_send(server):
    bench, inner = server(NetworkRule("half-open"))

    def body(task, socket):
        errors = []
        for name, options in (
            ("SocketReceive", {"RawData": RawBytes(), "Time": 2}),
            ("SocketSend", {"Str": "is it open?"}),
            ("SocketSend", {"Str": "hello?"}),
        ):
            try:
                bench.call(task, name, socket, **options)
                errors.append("")
            except RapidError as error:
                errors.append(error.name)
        return errors

    got = bench.run(serve(bench, body), outside(bench, inner, lambda t, e: inner.close(e)))
    assert got[0] == ["ERR_SOCK_TIMEOUT", "", "ERR_SOCK_CLOSED"]


def test_half_open_begins_at_byte_of_rule(server):
    """Before that many bytes, the end of the connection is visible."""
    bench, inner = server(NetworkRule("half-open", after=10))

    def body(task, socket):
        with pytest.raises(RapidError) as caught:
            bench.call(task, "SocketReceive", socket, RawData=RawBytes(), Time=2)
        return caught.value.name

    got = bench.run(serve(bench, body), outside(bench, inner, lambda t, e: inner.close(e)))
    assert got[0] == "ERR_SOCK_CLOSED"


def test_slow_reader_limits_sent_bytes(server):
    """1000 bytes per second: 64 kB fill the buffer, the rest waits."""
    bench, inner = server(NetworkRule("slow", direction="out", bytes=1000))

    def body(task, socket):
        for _ in range(70):
            bench.call(task, "SocketSend", socket, RawData=RawBytes(bytes(1000)))
        return bench.now

    got = bench.run(serve(bench, body), outside(bench, inner, lambda t, e: t.sleep(30)))
    assert 3.0 < got[0] < 6.0


def test_rule_applies_to_named_connection_only(server):
    bench, inner = server(NetworkRule("split", port=5001, direction="in", bytes=1))
    got = bench.run(
        serve(bench, chunks(bench, 4)), outside(bench, inner, lambda t, e: inner.send(e, b"abcd"))
    )[0]
    assert [data for _, data in got] == [b"abcd"]


def test_close_delivers_delayed_bytes(server):
    bench, inner = server(NetworkRule("delay", direction="out", seconds=0.3))

    def body(task, socket):
        bench.call(task, "SocketSend", socket, Str="bye")
        bench.call(task, "SocketClose", socket)

    def script(task, endpoint):
        task.sleep(1)
        return inner.receive(endpoint, 10), inner.receive(endpoint, 10)

    assert bench.run(serve(bench, body), outside(bench, inner, script))[1] == (b"bye", b"")


PLAN = """
network:
  - {do: split, port: 11000, direction: in, bytes: 3}
controller:
  - {do: e-stop, at: 2.5}
  - {do: stop, task: T_ROB1, module: ROS_motion, line: 40, pass: 3}
"""


def test_reading_a_plan(tmp_path):
    path = tmp_path / "plan.yaml"
    path.write_text(PLAN)
    plan = read_plan(path)
    assert plan.network == (NetworkRule("split", port=11000, direction="in", bytes=3),)
    assert plan.controller == (
        ControllerRule("e-stop", at=2.5),
        ControllerRule("stop", task="T_ROB1", module="ROS_motion", line=40, pass_=3),
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[]", "no mapping"),
        ("network: {}", "no list"),
        ("network: [split]", "no mapping"),
        ("network: [{do: lose}]", "one of split"),
        ("network: [{port: 1}]", "`do` is missing"),
        ("network: [{do: split, prot: 1}]", "unknown key 'prot'"),
        ("network: [{do: split, port: 1.5}]", "not whole"),
        ("network: [{do: split, port: -1}]", "from 0 on"),
        ("network: [{do: split, port: x}]", "from 0 on"),
        ("controller: [{do: e-stop}]", "either `at`"),
        ("controller: [{do: e-stop, at: 1, line: 2}]", "either `at`"),
        ("controller: [{do: e-stop, at: 1, task: 2}]", "no text"),
        ("a: [", "flow"),
    ],
)
def test_invalid_plan_is_rejected(tmp_path, text, words):
    path = tmp_path / "plan.yaml"
    path.write_text(text)
    with pytest.raises(DiagnosticError) as caught:
        read_plan(path)
    assert caught.value.diagnostics[0].code == "RG421"
    assert words in caught.value.diagnostics[0].message
