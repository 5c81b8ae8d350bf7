"""The driver when the controller answers an open question the other way (motion and language)."""

from dataclasses import replace

import pytest

from rapidgen.virtual.dialect import Dialect
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
    {"send_attends": False},
    {"axis_limits_told": False},
    {"error_reach": "own"},
    {"find_behind": "error"},
    {"byte_to_str": "code"},
    {"unpack_ulint": "single"},
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


@pytest.mark.parametrize("switch", INVERTED, ids=str)
def test_motion_the_other_way(bench, switch):
    b = bench()
    b.vc.motion.settings = replace(b.vc.motion.settings, **switch)
    the_round(b)


@pytest.mark.parametrize("switch", DIALECTS, ids=str)
def test_language_the_other_way(bench, switch):
    the_round(bench(options={"dialect": Dialect(**switch)}))


@pytest.mark.parametrize("seed", range(3))
def test_other_schedules(bench, seed):
    the_round(bench(options={"seed": seed}))


@pytest.mark.parametrize("scale", [0.25, 4.0])
def test_faster_and_slower_controllers(bench, scale):
    from rapidgen.virtual.costs import Costs

    the_round(bench(options={"costs": replace(Costs(), builtin_scale=scale)}))


@pytest.mark.parametrize("switch", REFUSED, ids=str)
def test_language_with_which_nothing_moves(bench, switch):
    b = bench(options={"dialect": Dialect(**switch)})
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
