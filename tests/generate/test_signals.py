"""Signals that the configuration exposes, over the control connection.

That AliasIO takes a name as text, and that an unknown one can be recovered from, is assumed
(`alias_by_name`).
"""

import struct
from dataclasses import replace

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.system import SignalSpec
from tests.generate.bench import STOP
from tests.generate.driving import move_well
from tests.generate.streams import SIGNAL, reply, request

NO_SIGNAL, READ_ONLY, BAD_VALUE = 17, 18, 19
EXPOSED = [
    "signals.valve={kind: DO, access: write}",
    "signals.lamp={kind: DO}",
    "signals.part={kind: DI}",
    "signals.code={kind: GO, access: write}",
    "signals.line={kind: GI}",
    "signals.flow={kind: AO, access: write}",
    "signals.weight={kind: AI}",
]
VALVE, LAMP, PART, CODE, LINE, FLOW, WEIGHT = range(7)


@pytest.fixture
def cell(bench):
    """A bench with the signals, but for those that are named."""

    def make(*missing):
        b = bench(overrides=EXPOSED)
        b.vc.close()
        there = tuple(
            SignalSpec(s.name, s.kind, size=8 if s.kind[0] == "G" else 1)
            for s in b.config.signals
            if s.name not in missing
        )
        system = replace(b.system, signals=(*b.system.signals, *there))
        b.vc = VirtualController(system, b.config.groups)
        b.vc.run_for(0.5)
        return b, b.client(b.config.groups[0].ports.control)

    return make


def ask(own, index, value=None):
    """The value of a signal, after writing; or the reason of a refusal as a text."""
    write = value is not None
    own.send(request(SIGNAL, struct.pack("<2if", index, int(write), value if write else 0.0)))
    code, data = reply(own, SIGNAL)
    if code == 2:
        return f"refused {struct.unpack('<i', data)[0]}"
    found, read = struct.unpack("<if", data)
    assert found == index
    return read


def test_hello_tells_how_many_there_are(cell):
    b, own = cell()
    own.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 0))
    _, data = reply(own, 1300)
    assert struct.unpack_from("<i", data, 40)[0] & 8
    assert struct.unpack_from("<i", data, 208) == (7,)
    assert b.healthy()


def test_signals_are_read(cell):
    b, own = cell()
    assert [ask(own, n) for n in range(7)] == [0.0] * 7
    for name, value in (("lamp", 1), ("part", 1), ("line", 200), ("weight", 1.5)):
        b.vc.signals[name] = value
    assert [ask(own, n) for n in (LAMP, PART, LINE, WEIGHT)] == [1, 1, 200, 1.5]


def test_signals_are_written(cell):
    b, own = cell()
    assert ask(own, VALVE, 1.0) == 1
    assert ask(own, CODE, 137.0) == 137
    assert ask(own, FLOW, -2.25) == -2.25
    assert [b.vc.signals[name] for name in ("valve", "code", "flow")] == [1, 137, -2.25]
    assert ask(own, VALVE, 0.0) == 0
    assert b.vc.signals["valve"] == 0


@pytest.mark.parametrize("index", [LAMP, PART, LINE, WEIGHT])
def test_only_what_the_configuration_lets_be_written_is(cell, index):
    b, own = cell()
    before = dict(b.vc.signals)
    assert ask(own, index, 1.0) == f"refused {READ_ONLY}"
    assert dict(b.vc.signals) == before


@pytest.mark.parametrize("index", [7, -1, 2**31 - 1, -(2**31)])
@pytest.mark.parametrize("value", [None, 1.0])
def test_a_signal_that_there_is_not(cell, index, value):
    _, own = cell()
    assert ask(own, index, value) == f"refused {NO_SIGNAL}"


@pytest.mark.parametrize(
    ("index", "value"),
    [(VALVE, 2.0), (VALVE, 0.5), (VALVE, -1.0), (CODE, -1.0), (CODE, 1.5), (CODE, 256.0)]
    + [(n, v) for n in (VALVE, CODE, FLOW) for v in (float("nan"), float("inf"), 1e20)],
)
def test_values_that_a_signal_cannot_have(cell, index, value):
    b, own = cell()
    before = dict(b.vc.signals)
    assert ask(own, index, value) == f"refused {BAD_VALUE}"
    assert dict(b.vc.signals) == before
    assert b.healthy()


@pytest.mark.parametrize("write", [2, -1])
def test_a_flag_that_is_neither(cell, write):
    _, own = cell()
    own.send(request(SIGNAL, struct.pack("<2if", VALVE, write, 1.0)))
    assert reply(own, SIGNAL) == (2, struct.pack("<i", BAD_VALUE))


def test_a_signal_that_the_controller_does_not_have(cell):
    """It is refused, the others work: nothing is fatal (R15)."""
    b, own = cell("valve", "weight")
    assert b.healthy()
    assert ask(own, VALVE, 1.0) == f"refused {NO_SIGNAL}"
    assert ask(own, WEIGHT) == f"refused {NO_SIGNAL}"
    assert ask(own, CODE, 3.0) == 3
    own.send(STOP)
    assert reply(own, 11)[0] == 1
    move_well(b)


def test_without_signals_the_message_is_not_known(bench):
    b = bench()
    own = b.client(b.config.groups[0].ports.control)
    own.send(request(SIGNAL, bytes(12)))
    assert reply(own, SIGNAL) == (2, b"")
