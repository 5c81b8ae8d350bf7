"""The driver when the controller answers an open question the other way (motion and language)."""

import struct
from dataclasses import replace

import pytest

from rapidgen.machine.costs import Costs
from rapidgen.runtime.switches import Switches
from tests.generate.bench import STOP, close_to, trajectory
from tests.generate.driving import (
    FIVE,
    LONG,
    SECONDS,
    move_well,
    recover,
    reply_of,
    send_all,
)
from tests.generate.streams import (
    BEGIN,
    PAUSE,
    accepted,
    batch,
    batches,
    line,
    refused,
    reply,
    request,
)

SINGLE = {"unpack_ulint": "single"}
INVERTED = [
    {"stop_waits": True},
    {"cleared_move": "hang"},
    {"range_error": "fatal"},
    {"zero_length": "wait"},
    {"settle": 0.2},
    {"planning_lead": 0.02},
    {"planning_lead": 0.3},
    {"quick_factor": 1.0},
    {"stop_owner": "task"},
    {"refresh_timed": False},
    {"emergency_stop": "path"},
]
DIALECTS = [
    {"num_rounding": "operation"},
    {"for_loop": "tested"},
    {"unhandled_error": "stop"},
    {"integer_division": "floor"},
    {"retry_raised": False},
    {"negative_mod": "error"},
    {"cycle_resets_interrupts": True},
    {"dionum": "nonzero"},
    {"raise_in_handler": "error"},
    {"wait_until": "event"},
    {"e_stop_routines": False},
    {"fault_routines": True},
    {"after_error": "main"},
    {"receive_timeout": "drop"},
    {"unpack_beyond": "zero"},
    {"pack_beyond": "error"},
    {"send_attends": False},
    {"axis_limits_told": False},
    {"error_reach": "own"},
    {"find_behind": "error"},
    {"byte_to_str": "code"},
    SINGLE,
]
# The first message breaks the link, or a task stops at its start: nothing moves.
REFUSED = [
    {"unpack_ulint": "error"},
    {"alias_by_name": False},
]


def the_round(b):
    """Move, stop, move, get over a program stop and an emergency stop, move far."""
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client) == (1, (1,))
    b.vc.run_for(1.5)
    client.send(STOP)
    assert client.wait_frame() is not None
    b.vc.run_for(3)
    here = b.joints()
    assert 0.1 < here[0] < 0.25
    move_well(b, client)
    here = list(b.joints())
    send_all(client, trajectory([here, [v + 0.3 for v in here]], [10, 3]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1)
    b.vc.perform("stop")
    b.vc.run_for(1)
    here = b.joints()
    b.vc.perform("start")
    b.vc.run_for(3)
    assert close_to(b.joints(), here, 1e-6)
    move_well(b, client)
    here = list(b.joints())
    send_all(client, trajectory([here, [v - 0.3 for v in here]], [10, 3]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1)
    b.vc.perform("e-stop")
    b.vc.run_for(1)
    recover(b)
    here = b.joints()
    b.vc.run_for(3)
    assert close_to(b.joints(), here, 1e-6)
    move_well(b, client)
    here = list(b.joints())
    far = [[v + w for v, w in zip(here, row, strict=True)] for row in LONG[:200]]
    send_all(client, trajectory(far, [10] + [0.2] * 199))
    assert reply_of(client)[0] == 1
    b.vc.run_for(42)
    assert close_to(b.joints(), far[-1], 1e-5)
    assert b.healthy()


def the_stream_round(b):
    """Stream, starve, go on, pause, go on, stop over the control connection, a program stop."""
    client, own = b.client(), b.client(b.config.groups[0].ports.control)
    rows = line([0.0] * 6, 100)
    client.send(batch(7, 0, rows[:20], BEGIN))
    accepted(client)
    b.vc.run_for(4)
    assert close_to(b.joints(), rows[19][1], 1e-5)
    for first in (20, 50):
        client.send(batch(7, first, rows[first : first + 30]))
        accepted(client)
    b.vc.run_for(1)
    own.send(request(PAUSE, struct.pack("<i", 1)))
    assert reply(own, PAUSE) == (1, b"")
    b.vc.run_for(1)
    here = b.joints()
    b.vc.run_for(1)
    assert b.joints() == here
    own.send(request(PAUSE, struct.pack("<i", 0)))
    assert reply(own, PAUSE) == (1, b"")
    b.vc.run_for(1)
    assert rows[25][1][0] < b.joints()[0] < rows[60][1][0]
    own.send(STOP)
    assert reply(own, 11) == (1, b"")
    b.vc.run_for(2)
    here = b.joints()
    assert rows[25][1][0] < here[0] < rows[60][1][0]
    client.send(batch(7, 80, rows[80:]))
    assert refused(client)[3] == 40
    rows = line(list(here), 60)
    for data in batches(8, rows, end=False):
        client.send(data)
        accepted(client)
    b.vc.run_for(1)
    b.vc.perform("stop")
    b.vc.run_for(1)
    here = b.joints()
    b.vc.perform("start")
    b.vc.run_for(3)
    assert close_to(b.joints(), here, 1e-6)
    rows = line(list(here), 40, step=-0.002)
    for data in batches(9, rows):
        client.send(data)
        accepted(client)
    b.vc.run_for(7)
    assert close_to(b.joints(), rows[-1][1], 1e-5)
    assert b.healthy()


@pytest.mark.parametrize("switch", INVERTED, ids=str)
def test_motion_the_other_way_with_streams(bench, switch):
    b = bench()
    b.group.settings = replace(b.group.settings, **switch)
    the_stream_round(b)


@pytest.mark.parametrize("switch", [s for s in DIALECTS if s != SINGLE], ids=str)
def test_language_the_other_way_with_streams(bench, switch):
    the_stream_round(bench(options={"dialect": Switches(**switch)}))


def test_words_that_are_not_read_exactly_refuse_a_stream(bench):
    b = bench(options={"dialect": Switches(**SINGLE)})
    client = b.client()
    client.send(batch(7, 0, line([0.0] * 6, 20), BEGIN))
    assert refused(client)[3] in (10, 16)
    b.vc.run_for(2)
    assert b.joints() == (0.0,) * 6


@pytest.mark.parametrize("scale", [0.25, 4.0])
def test_faster_and_slower_controllers_with_streams(bench, scale):
    the_stream_round(bench(options={"costs": replace(Costs(), builtin_scale=scale)}))


@pytest.mark.parametrize("switch", INVERTED, ids=str)
def test_motion_the_other_way(bench, switch):
    b = bench()
    b.vc.motion.settings = replace(b.vc.motion.settings, **switch)
    the_round(b)


@pytest.mark.parametrize("switch", DIALECTS, ids=str)
def test_language_the_other_way(bench, switch):
    the_round(bench(options={"dialect": Switches(**switch)}))


@pytest.mark.parametrize("seed", range(3))
def test_other_schedules(bench, seed):
    the_round(bench(options={"seed": seed}))


@pytest.mark.parametrize("scale", [0.25, 4.0])
def test_faster_and_slower_controllers(bench, scale):
    the_round(bench(options={"costs": replace(Costs(), builtin_scale=scale)}))


@pytest.mark.parametrize("switch", REFUSED, ids=str)
def test_language_with_which_nothing_moves(bench, switch):
    b = bench(options={"dialect": Switches(**switch)})
    if not b.healthy():
        assert b.joints() == (0.0,) * 6
        return
    for _ in range(3):
        client = b.client()
        client.send(b"".join(trajectory(FIVE, SECONDS)))
        b.vc.run_for(3)
        client.pump()
        assert client.closed
        assert client.received == b""
        assert b.joints() == (0.0,) * 6
