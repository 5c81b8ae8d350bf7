"""Rules of network faults, one at a time, on a network in memory."""

import pytest

from rapidgen.machine.network.fault_injection import FaultyNetwork, NetworkRule
from rapidgen.machine.network.interface import BUFFER, NetworkFault, NetworkReason
from rapidgen.machine.network.memory import LATENCY, MemoryNetwork
from rapidgen.machine.scheduler import MS, S, Scheduler

HOST = "127.0.0.1"
PORT = 11000


class Net(FaultyNetwork):
    def __init__(self, *rules):
        self.scheduler = Scheduler()
        self.plain = MemoryNetwork(self.scheduler)
        super().__init__(self.plain, self.scheduler, rules)
        self.listener = self.bind(HOST, PORT)
        self.listen(self.listener)

    def pair(self):
        """The program's end, and that of a client behind no rule."""
        client = self.plain.connect(HOST, PORT)
        self.scheduler.advance(self.scheduler.now + 10 * MS)
        return self.accept(self.listener), client

    def settle(self):
        self.scheduler.advance()

    def wait(self, time):
        self.scheduler.advance(self.scheduler.now + time + 1)

    def pieces_at(self, endpoint, network=None):
        """Pieces as they came, with their times in ms from now."""
        network, began, pieces = network or self, self.scheduler.now, []

        def take():
            while data := network.receive(endpoint, BUFFER):
                pieces.append((round((self.scheduler.now - began) / MS, 3), data))

        endpoint.changed.add(take)
        take()
        return pieces


def reason(function, *arguments, **options):
    with pytest.raises(NetworkFault) as fault:
        function(*arguments, **options)
    return fault.value.reason


def test_without_a_rule_everything_goes_straight_through():
    net = Net(NetworkRule("split", port=5), NetworkRule("reset", connection=2))
    program, client = net.pair()
    net.plain.send(client, b"hello")
    assert net.send(program, b"back") == 4
    net.settle()
    assert net.receive(program, 5, exact=True, peek=True) == b"hello"
    assert net.receive(program, 9) == b"hello"
    assert net.plain.receive(client, 9) == b"back"
    second, _ = net.pair()
    assert reason(net.send, second, b"x") is NetworkReason.RESET
    assert net.listeners == {PORT: (HOST, PORT)}


def test_rules_concern_a_port_and_a_connection():
    assert NetworkRule("split").concerns(5, 2)
    assert NetworkRule("split", port=5, connection=2).concerns(5, 2)
    assert not NetworkRule("split", port=4).concerns(5, 2)
    assert not NetworkRule("split", connection=1).concerns(5, 2)


def test_split_affects_given_direction_only():
    net = Net(NetworkRule("split", direction="in", bytes=2, seconds=0.001, after=1))
    program, client = net.pair()
    pieces, other = net.pieces_at(program), net.pieces_at(client, net.plain)
    net.plain.send(client, b"abcde")
    net.send(program, b"fghij")
    net.settle()
    assert pieces == [(0.1, b"a"), (1.1, b"bc"), (2.1, b"de")]
    assert other == [(0.1, b"fghij")]


def test_slow_in_the_other_direction():
    net = Net(NetworkRule("slow", direction="out", bytes=100))
    program, client = net.pair()
    net.wait(S)
    pieces = net.pieces_at(client, net.plain)
    net.send(program, bytes(25))
    net.settle()
    assert [(t, len(p)) for t, p in pieces] == [(0.1, 10), (100.1, 10), (200.1, 5)]


def test_slower_than_ten_bytes_a_second():
    net = Net(NetworkRule("slow", direction="out", bytes=5))
    program, client = net.pair()
    net.wait(S)
    pieces = net.pieces_at(client, net.plain)
    net.send(program, bytes(2))
    net.settle()
    assert [(t, len(p)) for t, p in pieces] == [(0.1, 1), (200.1, 1)]


def test_delayed_bytes_keep_their_order():
    net = Net(NetworkRule("delay", seconds=0.5))
    program, client = net.pair()
    pieces = net.pieces_at(client, net.plain)
    net.send(program, b"ab")
    net.wait(100 * MS)
    net.send(program, b"c")
    net.settle()
    assert pieces == [(500.1, b"ab"), (600.1, b"c")]


def test_merged_bytes_come_at_the_end_of_a_stretch():
    net = Net(NetworkRule("merge", direction="in", seconds=0.2))
    program, client = net.pair()
    net.scheduler.advance(round(1.05 * S))
    pieces = net.pieces_at(program)
    for _ in range(2):
        net.plain.send(client, b"a")
        net.wait(60 * MS)
    net.settle()
    assert [(round(t, 1), p) for t, p in pieces] == [(150.0, b"aa")]


@pytest.mark.parametrize("after", [0, 3])
def test_reset_follows_given_bytes(after):
    net = Net(NetworkRule("reset", direction="out", after=after))
    program, client = net.pair()
    if after:
        assert net.send(program, b"abcde") == 5
        net.wait(LATENCY)
    assert reason(net.send, program, b"x") is NetworkReason.RESET
    net.settle()
    got = client.incoming.arrived
    assert bytes(got) == b"abc"[:after]


def test_a_reset_in_the_other_direction():
    net = Net(NetworkRule("reset", direction="in", after=2))
    program, client = net.pair()
    assert net.receive(program, 1) is None
    net.plain.send(client, b"abcd")
    net.settle()
    assert net.receive(program, 9) == b"ab"
    assert reason(net.receive, program, 9) is NetworkReason.RESET
    net.settle()
    assert reason(net.plain.receive, client, 1) is NetworkReason.RESET


def test_silence_stops_both_directions():
    net = Net(NetworkRule("silent", after=2))
    program, client = net.pair()
    net.plain.send(client, b"abcd")
    assert net.send(program, b"efgh") == 4
    net.settle()
    assert net.receive(program, 9) == b"ab"
    assert net.plain.receive(client, 9) == b"ef"
    net.plain.close(client)
    net.settle()
    assert net.receive(program, 9) is None


def test_half_open():
    net = Net(NetworkRule("half-open"))
    program, client = net.pair()
    net.plain.send(client, b"ab")
    net.plain.close(client)
    net.settle()
    assert net.receive(program, 9) == b"ab"
    assert net.receive(program, 9) is None
    assert net.send(program, b"taken") == 5
    assert reason(net.send, program, b"x") is NetworkReason.RESET


def test_end_without_half_open_follows_data():
    net = Net(NetworkRule("delay", seconds=0.5))
    program, client = net.pair()
    net.plain.send(client, b"ab")
    net.plain.close(client)
    net.wait(10 * MS)
    assert net.receive(program, 9) is None
    net.settle()
    assert net.receive(program, 9) == b"ab"
    assert net.receive(program, 9) == b""


def test_the_other_end_s_reset_is_seen():
    net = Net(NetworkRule("delay", seconds=0.5))
    program, client = net.pair()
    net.plain.close(client, abort=True)
    net.settle()
    assert reason(net.receive, program, 9) is NetworkReason.RESET
    assert reason(net.send, program, b"x") is NetworkReason.RESET


@pytest.mark.parametrize("abort", [True, False])
def test_close_sends_waiting_bytes(abort):
    net = Net(NetworkRule("delay", seconds=0.5, direction="out"))
    program, client = net.pair()
    pieces = net.pieces_at(client, net.plain) if not abort else []
    net.send(program, b"last")
    net.close(program, abort=abort)
    net.settle()
    assert program.closed
    assert pieces == ([] if abort else [(500.1, b"last")])
    if not abort:
        assert net.plain.receive(client, 1) == b""


def test_buffer_size_is_that_of_a_connection():
    net = Net(NetworkRule("delay", seconds=0.5))
    program, client = net.pair()
    assert net.send(program, bytes(BUFFER + 1)) == BUFFER
    assert net.send(program, b"x") == 0
    net.settle()
    assert net.send(program, b"xy") == 2
    pieces = net.pieces_at(client, net.plain)
    net.settle()
    assert sum(len(p) for _, p in pieces) == BUFFER + 2
    net.plain.send(client, bytes(BUFFER))
    net.settle()
    net.plain.send(client, bytes(BUFFER))
    net.settle()
    assert len(net.receive(program, 3 * BUFFER)) == BUFFER
    assert net.receive(program, 1) is None
    net.settle()
    assert len(net.receive(program, 3 * BUFFER)) == BUFFER


def test_other_rules_for_connections_to_come():
    net = Net(NetworkRule("reset"))
    net.obey(())
    program, _ = net.pair()
    assert net.send(program, b"x") == 1
    net.obey((NetworkRule("reset"),))
    assert net.send(program, b"x") == 1
    assert reason(net.send, net.pair()[0], b"x") is NetworkReason.RESET


@pytest.mark.parametrize("rules", [(), (NetworkRule("delay", seconds=0.1),)])
def test_rule_applies_to_open_connection(rules):
    net = Net(*rules)
    program, client = net.pair()
    net.send(program, b"before")
    net.inject_fault(program, NetworkRule("silent", direction="out", after=2))
    assert net.send(program, b"abcd") == 4
    net.plain.send(client, b"in")
    net.settle()
    assert net.plain.receive(client, 99) == b"beforeab"
    assert net.receive(program, 99) == b"in"


def test_rule_applies_to_outgoing_connection():
    net = Net(NetworkRule("reset", port=7, direction="out"))
    other = net.plain.bind(HOST, 7)
    net.plain.listen(other)
    program = net.connect(HOST, 7)
    assert net.send(program, b"x") == 0
    net.wait(MS)
    assert reason(net.send, program, b"x") is NetworkReason.RESET


def test_everything_is_shut_down():
    net = Net(NetworkRule("delay", seconds=0.5))
    program, _ = net.pair()
    net.send(program, b"x")
    net.shut_down()
    assert program.closed
    assert net.listeners == {}


@pytest.mark.parametrize(("into", "out"), [(0.5, 0.2), (0.2, 0.5), (0.3, 0.3)])
def test_each_direction_passes_at_separate_times(into, out):
    net = Net(
        NetworkRule("delay", direction="in", seconds=into),
        NetworkRule("delay", direction="out", seconds=out),
    )
    program, client = net.pair()
    net.wait(S)
    received, seen = net.pieces_at(program), net.pieces_at(client, net.plain)
    net.plain.send(client, b"into")
    net.wait(LATENCY)
    net.send(program, b"out")
    net.settle()
    assert received == [(pytest.approx(1000 * into + 0.1, abs=0.001), b"into")]
    assert seen == [(pytest.approx(1000 * out + 0.2, abs=0.001), b"out")]


def test_bytes_beyond_peer_buffer_wait_in_order():
    net = Net(NetworkRule("delay", direction="out", seconds=0.1))
    program, client = net.pair()
    sent = b""
    # As much as a connection holds, in pieces that do not fit it, and as much again that waits.
    while count := net.send(program, bytes([len(sent) // 50_000 + 1]) * 50_000):
        sent += bytes([len(sent) // 50_000 + 1]) * count
        net.wait(S)
    assert len(sent) > 2 * BUFFER
    read = b""
    while data := net.plain.receive(client, 7000):
        read += data
        net.wait(S)
    assert read == sent
    assert net.send(program, b"e") == 1


def test_delayed_bytes_meet_reset():
    net = Net(NetworkRule("delay", direction="out", seconds=0.5))
    program, client = net.pair()
    assert net.send(program, b"late") == 4
    net.plain.close(client, abort=True)
    net.settle()
    assert reason(net.send, program, b"x") is NetworkReason.RESET


@pytest.mark.parametrize("other", [NetworkRule("delay"), NetworkRule("silent", after=99)])
def test_of_several_rules_each_holds(other):
    for rules in ((other, NetworkRule("half-open")), (NetworkRule("half-open"), other)):
        net = Net(*rules)
        program, client = net.pair()
        net.plain.close(client)
        net.settle()
        assert net.receive(program, 9) is None
        assert net.send(program, b"taken") == 5
        assert reason(net.send, program, b"x") is NetworkReason.RESET


def test_half_open_begins_after_given_bytes():
    net = Net(NetworkRule("half-open", direction="in", after=2))
    program, client = net.pair()
    net.plain.send(client, b"a")
    net.plain.close(client)
    net.settle()
    assert net.receive(program, 9) == b"a"
    assert net.receive(program, 9) == b""


@pytest.mark.parametrize(
    ("rules", "pieces"),
    [
        ([("split", 1, 0.001, 0)], [(0.1, b"a"), (1.1, b"b"), (2.1, b"c"), (3.1, b"d")]),
        ([("split", 0, 0.001, 0)], [(0.1, b"a"), (1.1, b"b"), (2.1, b"c"), (3.1, b"d")]),
        ([("split", 3, 0.001, 0)], [(0.1, b"abc"), (1.1, b"d")]),
        # The rule begins in the middle, or two do.
        ([("split", 1, 0.001, 2)], [(0.1, b"ab"), (1.1, b"c"), (2.1, b"d")]),
        ([("delay", 0, 0.5, 1), ("silent", 0, 0.0, 3)], [(0.1, b"a"), (500.1, b"bc")]),
        ([("silent", 0, 0.0, 3), ("delay", 0, 0.5, 1)], [(0.1, b"a"), (500.1, b"bc")]),
        # A tenth of what passes in a second at a time, at least one byte.
        ([("slow", 20, 0.0, 0)], [(0.1, b"ab"), (100.1, b"cd")]),
        ([("slow", 100, 0.0, 0)], [(0.1, b"abcd")]),
        ([("slow", 4, 0.0, 0)], [(0.1, b"a"), (250.1, b"b"), (500.1, b"c"), (750.1, b"d")]),
        ([("slow", 1, 0.0, 2)], [(0.1, b"ab"), (1000.1, b"c"), (2000.1, b"d")]),
        ([("slow", 0, 0.0, 2)], [(0.1, b"ab"), (1000.1, b"c"), (2000.1, b"d")]),
        # Pieces and a delay together: the delay counts from when they were sent.
        (
            [("split", 2, 0.1, 0), ("delay", 0, 0.5, 0)],
            [(500.1, b"ab"), (600.1, b"cd")],
        ),
    ],
)
def test_rules_apply_to_their_bytes(rules, pieces):
    made = (
        NetworkRule(do, direction="out", bytes=count, seconds=seconds, after=after)
        for do, count, seconds, after in rules
    )
    net = Net(*made)
    program, client = net.pair()
    net.wait(10 * S)
    received = net.pieces_at(client, net.plain)
    assert net.send(program, b"abcd") == 4
    net.settle()
    assert received == pieces
