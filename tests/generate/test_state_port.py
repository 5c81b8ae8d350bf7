"""Port 11002 with several clients: who is served, what they get, and what a deaf one may cost."""

import itertools
import math
import struct

import pytest

from rapidgen.runtime.switches import Switches
from tests.generate.bench import close_to, trajectory

JOINT, STATUS, FEEDBACK, HELLO, PROGRESS, EVENT = 10, 13, 15, 1300, 1301, 1308
WANT_PROGRESS, WANT_EVENTS, WANT_FEEDBACK = 1, 16, 32


def hello(client, wanted=0, version=2):
    client.send(struct.pack("<9i", 32, 1300, 2, 0, version, 0, 1, 0, wanted))


def kind(frame):
    return struct.unpack_from("<i", frame, 4)[0]


def subscribed(b, wanted):
    client = b.state_client()
    hello(client, wanted)
    b.vc.run_for(0.5)
    assert HELLO in {kind(f) for f in client.frames()}
    return client


def kinds_in(b, client, seconds=1.0):
    client.frames()
    b.vc.run_for(seconds)
    return {kind(f) for f in client.frames()}


def served(b, client, seconds=1.0):
    client.frames()
    b.vc.run_for(seconds)
    return bool(client.frames())


# -- who is served ------------------------------------------------------------------------------


def test_three_clients_get_the_same_at_once(bench):
    b = bench()
    clients = [b.state_client() for _ in range(3)]
    b.vc.run_for(2)
    for client in clients:
        client.frames()
    b.vc.run_for(5)
    told = [client.frames() for client in clients]
    assert told[0] == told[1] == told[2]
    assert len(told[0]) == pytest.approx(100, abs=2)


def test_a_fourth_takes_the_place_of_the_one_that_came_before_it(bench):
    b = bench()
    clients = []
    for _ in range(4):
        clients.append(b.state_client())
        b.vc.run_for(1)
    assert [served(b, client) for client in clients] == [True, True, False, True]
    assert clients[2].closed
    # A place that was left is taken first, nobody has to go.
    clients[1].close()
    b.vc.run_for(1)
    fifth = b.state_client()
    b.vc.run_for(1)
    assert [served(b, client) for client in (clients[0], clients[3], fifth)] == [True] * 3
    sixth = b.state_client()
    b.vc.run_for(1)
    served_now = [served(b, client) for client in (clients[0], clients[3], fifth, sixth)]
    assert served_now == [True, True, False, True]


def test_standard_nodes_that_come_again_do_not_disturb_the_first(bench):
    """A node that was dropped connects again within 5 s, and the action that waits for the first
    one's states gives its goal up after a second without any."""
    b = bench()
    first, second = b.state_client(), b.state_client()
    b.vc.run_for(1)
    b.state_client()
    first.frames()
    for _ in range(12):
        b.state_client()
        b.vc.run_for(2.5)
        assert len(first.frames()) == pytest.approx(50, abs=4)
        assert served(b, second, 0.3)
        first.frames()
    assert b.healthy()


def test_many_come_and_go(bench):
    b = bench()
    lasting = b.state_client()
    b.vc.run_for(1)
    for _ in range(30):
        passing = b.state_client()
        b.vc.run_for(0.37)
        passing.close()
        b.vc.run_for(0.21)
        assert served(b, lasting, 0.3)
    assert b.healthy()


def test_strangers_take_nobodys_place(bench):
    b = bench(allowed_clients=("10.0.0.7",))
    clients = [b.state_client() for _ in range(3)]
    b.vc.run_for(2)
    b.address = "10.0.0.66"
    for _ in range(5):
        stranger = b.state_client()
        b.vc.run_for(0.5)
        stranger.pump()
        assert stranger.closed
    assert all(served(b, client) for client in clients)


def test_hello_is_answered_within_a_second_at_any_rate(bench):
    """A client takes a longer silence for a plain driver."""
    b = bench(state_period=5.0)
    first = b.state_client()
    b.vc.run_for(7.3)
    second = b.state_client()
    hello(second)
    hello(first)
    asked = b.vc.scheduler.now
    for client in (first, second):
        assert b.vc.run_until(lambda c=client: HELLO in map(kind, c.frames()), timeout=0.9)
    assert b.vc.scheduler.now - asked < 0.9e9


def test_the_next_client_does_not_wait_for_the_turn_of_the_last(bench):
    b = bench(state_period=5.0)
    first = b.state_client()
    b.vc.run_for(1)
    first.close()
    b.vc.run_for(0.5)
    assert served(b, b.state_client(), 0.5)


def test_the_rate_of_one_is_kept_while_others_come_and_go(bench):
    """Stamps within one period of where they belong."""
    b = bench()
    steady = b.state_client()
    b.vc.run_for(1)
    steady.frames()
    begun, count = b.vc.scheduler.now, 0
    for n in range(40):
        other = b.state_client() if n % 2 else subscribed(b, WANT_PROGRESS | WANT_FEEDBACK)
        b.vc.run_for(0.73)
        count += len([f for f in steady.frames() if kind(f) == STATUS])
        assert abs(count - (b.vc.scheduler.now - begun) * 1e-8) <= 1
        other.close()


# -- a client that does not read ----------------------------------------------------------------


def longest_gap(b, client, seconds):
    """Longest time between two STATUS, in s."""
    times = []
    client.frames()
    for _ in range(round(seconds / 0.02)):
        b.vc.run_for(0.02)
        if any(kind(f) == STATUS for f in client.frames()):
            times.append(b.vc.scheduler.now * 1e-9)
    return max(late - early for early, late in itertools.pairwise(times))


@pytest.mark.parametrize("order", ["before", "behind"])
def test_a_deaf_client_costs_the_others_one_pause(bench, order):
    b = bench(overrides=["state.rate=50"])
    first = b.state_client()
    b.vc.run_for(1)
    second = b.state_client()
    b.vc.run_for(1)
    deaf, good = (first, second) if order == "before" else (second, first)
    b.vc.network.silence(deaf.endpoint)
    # Until its buffers are full, nobody can tell.
    assert longest_gap(b, good, 60) < 0.35
    assert longest_gap(b, good, 5) < 0.05
    assert b.vc.tasks["T_ROS_STATE"]["ROS_stateServer:clients"] == 1
    assert b.healthy()


def test_a_deaf_client_alone_does_not_keep_others_out(bench):
    b = bench(overrides=["state.rate=100"])
    deaf = b.state_client()
    b.vc.run_for(1)
    b.vc.network.silence(deaf.endpoint)
    b.vc.run_for(30)
    fresh = b.state_client()
    b.vc.run_for(1)
    assert served(b, fresh)


def test_a_deaf_client_when_no_trap_runs_in_a_send(bench):
    """Then the others wait until SocketSend gives up by itself, and are served again."""
    b = bench(overrides=["state.rate=50"], options={"dialect": Switches(send_attends=False)})
    deaf = subscribed(b, WANT_EVENTS)
    good = b.state_client()
    b.vc.run_for(1)
    b.vc.network.silence(deaf.endpoint)
    gap = longest_gap(b, good, 100)
    assert 50 < gap < 70
    assert longest_gap(b, good, 5) < 0.05
    assert b.healthy()


def test_a_client_that_reads_late_but_reads_is_kept(bench):
    b = bench()
    client = b.state_client()
    b.vc.run_for(40)
    # 41 kB waited for it.
    assert len(client.frames()) == pytest.approx(800, abs=10)
    assert served(b, client)
    assert not client.closed


# -- JOINT_FEEDBACK -----------------------------------------------------------------------------


def feedback_of(frames):
    """(valid, time, positions, velocities) of each JOINT_FEEDBACK."""
    found = []
    for frame in frames:
        if kind(frame) == FEEDBACK:
            assert len(frame) == 148
            _, valid, time, *values = struct.unpack_from("<2if30f", frame, 16)
            assert values[20:] == [0.0] * 10
            found.append((valid, time, values[:10], values[10:20]))
    return found


def test_only_who_asks_gets_feedback(bench):
    b = bench()
    plain = b.state_client()
    asks = subscribed(b, WANT_FEEDBACK)
    both = subscribed(b, WANT_FEEDBACK | WANT_PROGRESS)
    assert kinds_in(b, plain) == {JOINT, STATUS}
    assert kinds_in(b, asks) == {JOINT, STATUS, FEEDBACK}
    assert kinds_in(b, both) == {JOINT, STATUS, FEEDBACK, PROGRESS}
    # The last word counts.
    hello(both, WANT_PROGRESS)
    b.vc.run_for(0.5)
    assert kinds_in(b, both) == {JOINT, STATUS, PROGRESS}


@pytest.mark.parametrize("name", ["irb120", "irb120_track", "irb14050", "irb910sc"])
def test_feedback_is_time_position_and_speed(bench, name):
    b = bench(name, overrides=["state.rate=50"])
    client, state = b.client(), subscribed(b, WANT_FEEDBACK)
    here = list(b.joints())
    steps = [0.05 * (n + 1) / len(here) for n in range(len(here))]
    there = [v + s for v, s in zip(here, steps, strict=True)]
    client.send(b"".join(trajectory([here, there], [10, 2.0])))
    b.vc.run_for(0.9)
    state.frames()
    before, begun = b.joints(), b.vc.scheduler.now
    b.vc.run_for(0.5)
    told = feedback_of(state.frames())
    seconds = (b.vc.scheduler.now - begun) * 1e-9
    speeds = [(v - w) / seconds for v, w in zip(b.joints(), before, strict=True)]
    assert len(told) == pytest.approx(25, abs=1)
    for valid, _, positions, velocities in told:
        assert valid == 7
        assert close_to(velocities[: len(here)], speeds, 0.01 * max(speeds) + 1e-4)
        assert velocities[len(here) :] == positions[len(here) :] == [0.0] * (10 - len(here))
    for (_, early, old, _), (_, late, new, velocities) in itertools.pairwise(told):
        assert late - early == pytest.approx(0.02, abs=0.002)
        means = [(v - w) / (late - early) for v, w in zip(new, old, strict=True)]
        assert close_to(velocities, means, 2e-4)


def test_the_first_feedback_has_no_speed(bench):
    b = bench(state_period=0.5)
    state = b.state_client()
    hello(state, WANT_FEEDBACK)
    b.vc.run_for(0.4)
    b.vc.run_for(3)
    told = feedback_of(state.frames())
    assert told[0][0] in (3, 7)
    assert {t[0] for t in told[1:]} == {7}
    # Everybody leaves; the clock begins again with the next one.
    state.close()
    b.vc.run_for(2)
    state = b.state_client()
    b.vc.run_for(0.01)
    hello(state, WANT_FEEDBACK)
    b.vc.run_for(3)
    assert all(all(math.isfinite(v) for v in t[3]) for t in feedback_of(state.frames()))


def test_the_time_stamp_counts_a_thousand_seconds(bench):
    """Unwrapped it follows the controller's time over several rounds, and so do speeds."""
    b = bench(state_period=0.37)
    state = subscribed(b, WANT_FEEDBACK)
    b.vc.run_for(0.5)
    state.frames()
    begun, unwrapped, last = None, 0.0, None
    for _ in range(130):
        b.vc.run_for(50)
        for valid, time, _, velocities in feedback_of(state.frames()):
            assert 0 <= time < 1000
            assert valid == 7
            assert velocities == [0.0] * 10
            if last is None:
                begun = b.vc.scheduler.now * 1e-9
            else:
                step = (time - last) % 1000
                assert step == pytest.approx(0.37, abs=0.01)
                unwrapped += step
            last = time
    assert begun is not None
    assert unwrapped == pytest.approx(6500, abs=0.8)


def test_speed_is_right_where_the_time_stamp_begins_again(bench):
    b = bench(overrides=["state.rate=2"])
    client, state = b.client(), subscribed(b, WANT_FEEDBACK)
    b.vc.run_for(120)
    while (last := feedback_of(state.frames())[-1])[1] < 980:
        b.vc.run_for(5)
    assert last[3] == [0.0] * 10
    rows = [[0.05 * (n % 2)] * 6 for n in range(40)]
    client.send(b"".join(trajectory(rows, [10] + [1.3] * 39)))
    b.vc.run_for(40)
    told = feedback_of(state.frames())
    assert told[0][1] > 980
    assert told[-1][1] < 100
    for (_, early, old, _), (_, late, new, velocities) in itertools.pairwise(told):
        seconds = (late - early) % 1000
        means = [(v - w) / seconds for v, w in zip(new, old, strict=True)]
        assert close_to(velocities, means, 2e-4)


# -- EVENT --------------------------------------------------------------------------------------


def events_of(frames):
    found = []
    for frame in frames:
        if kind(frame) == EVENT:
            assert len(frame) == 108
            domain, number, type_ = struct.unpack_from("<3i", frame, 16)
            found.append((domain, number, type_, frame[28:].rstrip(b"\0").decode("latin-1")))
    return found


def test_events_reach_those_who_ask(bench):
    b = bench()
    plain, asks = b.state_client(), subscribed(b, WANT_EVENTS)
    b.vc.log.error(50_204, "Motion supervision")
    b.vc.log.warning(71_001, "Duplicated adress")
    b.vc.log.info(10_125, "Program stopped")
    b.vc.run_for(1)
    assert events_of(asks.frames()) == [
        (5, 204, 3, "Motion supervision"),
        (7, 1001, 2, "Duplicated adress"),
        (1, 125, 1, "Program stopped"),
    ]
    assert not events_of(plain.frames())


def test_events_of_before_are_not_told(bench):
    b = bench()
    first = subscribed(b, WANT_EVENTS)
    first.close()
    b.vc.run_for(1)
    b.vc.log.error(50_204, "while nobody asks")
    b.vc.run_for(1)
    leaves = subscribed(b, WANT_EVENTS)
    for _ in range(9):
        b.vc.log.error(50_204, "for one who leaves")
    b.vc.run_for(0.2)
    leaves.close()
    b.vc.run_for(1)
    second = subscribed(b, WANT_EVENTS)
    b.vc.run_for(1)
    assert events_of(second.frames()) == []
    b.vc.log.error(50_204, "now")
    b.vc.run_for(1)
    assert [e[3] for e in events_of(second.frames())] == ["now"]


def test_titles_of_any_kind(bench):
    b = bench()
    asks = subscribed(b, WANT_EVENTS)
    titles = ["", "x" * 80, "y" * 200, "Größe zu groß", "1"]
    for title in titles:
        b.vc.log.error(50_204, title)
    b.vc.run_for(2)
    assert [e[3] for e in events_of(asks.frames())] == [t[:80] for t in titles]
    assert served(b, asks)


def test_many_events_are_told_slowly_and_the_rest_counted(bench):
    """Ten a second; the state goes on at its rate, and nothing is lost without a word."""
    b = bench()
    asks = subscribed(b, WANT_EVENTS)
    for n in range(25):
        b.vc.log.info(10_000 + n, f"event {n}")
    state, told = 0, []
    for _ in range(5):
        b.vc.run_for(1)
        frames = asks.frames()
        new = events_of(frames)
        assert len(new) <= 11
        told += new
        state += sum(kind(f) == STATUS for f in frames)
    assert state == pytest.approx(50, abs=2)
    numbers = [e[1] for e in told if e[0] == 1]
    lost = sum(e[1] for e in told if e[0] == 0)
    assert numbers == sorted(numbers)
    assert len(numbers) >= 16
    assert len(numbers) + lost == 25
    assert b.healthy()


def test_a_refusal_comes_as_an_event(bench):
    b = bench()
    asks = subscribed(b, WANT_EVENTS)
    client = b.client()
    client.send(b"".join(trajectory([[9.0] * 6, [9.0] * 6], [10, 1])))
    b.vc.run_for(1)
    assert (8, 2, 2, "ROS: trajectory refused") in [
        (e[0], e[1], e[2], e[3]) for e in events_of(asks.frames())
    ]


# -- PROGRESS of what does not go on ------------------------------------------------------------


def test_paused_and_starved_are_states_of_a_motion(bench):
    """As the supervisor and the motion task tell them; an end is told rather than a pause."""
    b = bench()
    state = subscribed(b, WANT_PROGRESS)
    client = b.client()
    client.send(b"".join(trajectory([[0.0] * 6, [0.3] * 6], [10, 20])))
    b.vc.run_for(1)

    def told():
        b.vc.run_for(0.25)
        state.frames()
        b.vc.run_for(0.25)
        return {struct.unpack_from("<2i", f, 16) for f in state.frames() if kind(f) == PROGRESS}

    tasks = b.vc.tasks
    for name, task, number in (("starved", "T_ROB1", 7), ("paused", "T_ROS_SUP", 8)):
        for trajectory_number, wanted in ((1, number), (2, 2), (-1, 2)):
            tasks[task][f"ROS_common:ROS_{name}"] = trajectory_number
            assert told() == {(1, wanted)}
    tasks["T_ROB1"]["ROS_common:ROS_starved"] = 1
    tasks["T_ROS_SUP"]["ROS_common:ROS_paused"] = 1
    assert told() == {(1, 8)}
    b.vc.perform("stop")
    b.vc.run_for(1)
    assert told() == {(1, 5)}


@pytest.mark.parametrize("name", ["starved", "paused"])
def test_a_robot_that_only_waits_is_not_in_motion(bench, name):
    b = bench()
    state = b.state_client()
    client = b.client()
    # It stands at the second point for some time: a motion under way all the same.
    rows = [[0.0] * 6, [0.1] * 6, [0.1] * 6, [0.2] * 6]
    client.send(b"".join(trajectory(rows, [10, 1, 20, 1])))
    b.vc.run_for(4)
    assert b.status(state)[4] == 1
    task = {"starved": "T_ROB1", "paused": "T_ROS_SUP"}[name]
    b.vc.tasks[task][f"ROS_common:ROS_{name}"] = 1
    b.vc.run_for(0.3)
    assert b.status(state)[4] == 0
    b.vc.tasks[task][f"ROS_common:ROS_{name}"] = -1
    b.vc.run_for(0.3)
    assert b.status(state)[4] == 1


# -- HELLO --------------------------------------------------------------------------------------


def test_an_older_client_is_refused_and_served_as_before(bench):
    b = bench()
    state = b.state_client()
    hello(state, WANT_PROGRESS, version=1)
    b.vc.run_for(0.5)
    replies = [f for f in state.frames() if kind(f) == HELLO]
    assert [struct.unpack("<5i", f) for f in replies] == [(16, 1300, 3, 2, 2)]
    assert kinds_in(b, state) == {JOINT, STATUS}


def test_bits_that_nobody_knows_are_ignored(bench):
    b = bench()
    state = subscribed(b, -1)
    assert kinds_in(b, state) == {JOINT, STATUS, PROGRESS, FEEDBACK}


@pytest.mark.parametrize("data", [bytes(36), b"\xff" * 36, bytes(500), b"\x20" * 40])
def test_nonsense_breaks_that_link_and_no_other(bench, data):
    b = bench()
    good, bad = b.state_client(), b.state_client()
    b.vc.run_for(1)
    bad.send(data)
    b.vc.run_for(1)
    bad.pump()
    assert bad.closed
    assert served(b, good)
    assert b.healthy()
