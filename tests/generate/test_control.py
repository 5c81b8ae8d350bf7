"""The control server: STOP, PAUSE, SPEED, HEARTBEAT on a connection of their own.

Bytes by hand: docs/develop/protocol.md. IPers and its delay: [K §8.1]. Whether the StopMove of one
task that is no motion task is taken back by another's StartMove is remembered only: `stop_owner`.
"""

import struct
from dataclasses import replace

import pytest

from tests.generate.bench import STOP, close_to, point, trajectory
from tests.generate.driving import (
    CLIENT_LOST,
    FAILED,
    FIVE,
    MOVING,
    PAUSED,
    PROGRAM,
    SECONDS,
    STOPPED,
    STOPPED_STATE,
    all_progress,
    ask_progress,
    move_well,
    recover,
    reply_of,
    send_all,
    statements_of,
)
from tests.generate.streams import (
    BEGIN,
    END,
    HEAD,
    HEARTBEAT,
    PAUSE,
    SPEED,
    accepted,
    batch,
    batches,
    line,
    refused,
    reply,
    request,
)
from tests.generate.streams import STOPPED as STOPPED_MESSAGE

HOME = [0.0] * 6
IDLE, BAD_VALUE = 27, 19
TOLD = struct.Struct("<3i10f")


def control(b):
    return b.client(b.config.groups[0].ports.control)


def streaming(b, count=90):
    """A stream that is executed: motion client, control client, state client."""
    client, own, state = b.client(), control(b), ask_progress(b)
    rows = line(HOME, count)
    for data in batches(7, rows, end=False):
        client.send(data)
        accepted(client)
    b.vc.run_for(1.5)
    assert not b.group.is_standing
    return client, own, state


def pause(own, wanted=1):
    own.send(request(PAUSE, struct.pack("<i", wanted)))
    return outcome(own, PAUSE)


def speed(own, percent):
    own.send(request(SPEED, struct.pack("<f", percent)))
    return outcome(own, SPEED)


def beat(own, timeout):
    own.send(request(HEARTBEAT, struct.pack("<f", timeout)))
    code, data = reply(own, HEARTBEAT)
    return code, struct.unpack(f"<{len(data) // 4}i", data)


def outcome(own, kind):
    """0, or the reason of a refusal."""
    code, data = reply(own, kind)
    if code == 1:
        assert data == b""
        return 0
    return struct.unpack("<i", data)[0]


def stop(own):
    own.send(STOP)
    return reply(own, 11)


def stopped(own):
    """The next STOPPED."""
    while True:
        frame = own.wait_frame(timeout=3)
        assert frame is not None, "no STOPPED"
        if HEAD.unpack_from(frame)[1] == STOPPED_MESSAGE:
            assert HEAD.unpack_from(frame) == (64, STOPPED_MESSAGE, 1, 0)
            return TOLD.unpack_from(frame, 16)


def stays(b, seconds=3):
    here = b.joints()
    b.vc.run_for(seconds)
    assert b.joints() == here


# -- STOP -----------------------------------------------------------------------------------------


def test_stop(bench):
    b = bench()
    client, own, state = streaming(b)
    assert stop(own) == (1, b"")
    trajectory_number, reached, reason, *joints = stopped(own)
    assert b.group.is_standing
    assert (trajectory_number, reason) == (1, STOPPED)
    assert close_to(joints[:6], b.joints(), 1e-6)
    assert joints[6:] == [0.0] * 4
    assert reached == all_progress(state)[-1][4] or reached > 0
    stays(b)
    told = all_progress(state)[-1]
    assert told[1] == STOPPED_STATE
    assert told[4] == reached
    client.send(batch(7, 90, line(HOME, 5)))
    assert refused(client)[3] == STOPPED
    move_well(b, client)


@pytest.mark.parametrize("seed", range(8))
def test_the_robot_is_told_to_stop_within_20_ms_under_full_load(bench, seed):
    """Points that never end, three state clients that want everything at 50 Hz, heartbeats."""
    b = bench(overrides=["state.rate=50"], options={"seed": seed})
    client, own = b.client(), control(b)
    for _ in range(3):
        watcher = b.state_client()
        watcher.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 1 + 16 + 32))
    rows = line(HOME, 2000, step=0.0005)
    client.send(batch(7, 0, rows[:30], BEGIN))
    accepted(client)
    beat(own, 5)
    b.vc.run_for(1.1 + 0.0137 * seed)
    # As many bytes as the connection takes: the reader is busy until the stop.
    client.network.send(client.endpoint, b"".join(batches(7, rows, end=False)[1:40]))
    b.vc.run_for(0.004)
    own.network.send(own.endpoint, STOP)
    sent = b.vc.now
    assert b.vc.run_until(lambda: b.group.stop_reasons != (), timeout=1)
    assert b.vc.now - sent <= 0.020
    assert reply(own, 11)[0] == 1
    assert b.vc.now - sent < 0.1


def test_stop_of_a_download(bench):
    b = bench()
    client, own = b.client(), control(b)
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    assert stop(own) == (1, b"")
    b.vc.run_for(1)
    assert 0.1 < b.joints()[0] < 0.25
    stays(b)
    move_well(b, client)


def test_what_was_begun_before_a_stop_does_not_start(bench):
    """The end frame, or the first points, come behind a STOP that was answered already."""
    b = bench()
    client, own = b.client(), control(b)
    frames = trajectory(FIVE, SECONDS)
    send_all(client, frames[:-1])
    b.vc.run_for(0.1)
    assert stop(own) == (1, b"")
    client.send(frames[-1])
    assert reply_of(client)[:1] == (2,)
    client.send(batch(7, 0, [], BEGIN))
    accepted(client)
    assert stop(own) == (1, b"")
    client.send(batch(7, 0, line(HOME, 20), END))
    assert refused(client)[3] == STOPPED
    b.vc.run_for(2)
    assert b.joints() == tuple(HOME)
    move_well(b, client)


@pytest.mark.parametrize(
    ("module", "routine"),
    [
        ("ROS_acceptance", "ROS_hand_over"),
        ("ROS_acceptance", "ROS_what_hinders"),
        ("ROS_stream", "take_points"),
    ],
)
def test_a_stop_at_every_statement_of_a_beginning(bench, module, routine):
    """Whatever the motion server is at when it comes: nothing moves after the reply to it."""
    reached = 0
    for at in statements_of(bench(), routine, module):
        b = bench()
        client, own = b.client(), control(b)
        b.vc.run_for(0.3)
        sent = []

        def act(b=b, own=own, sent=sent):
            own.network.send(own.endpoint, STOP)
            sent.append(b.vc.now)

        b.vc.before_statement("T_ROS_RECV", module, at, 1, act)
        client.send(batch(7, 0, line(HOME, 20), BEGIN))
        b.vc.run_for(0.2)
        if not sent:
            continue
        reached += 1
        assert reply(own, 11) == (1, b""), at
        b.vc.run_for(0.5)
        stays(b, 2)
        assert b.joints()[0] < 0.01, at
        client.frames()
        move_well(b, client)
    assert reached >= 2


def test_stop_while_nothing_moves(bench):
    b = bench()
    own = control(b)
    assert stop(own) == (1, b"")
    assert b.group.stop_reasons == ()
    move_well(b)


def test_many_stops_at_every_moment(bench):
    """R5, R7: nothing can stay taken, whenever the stop comes."""
    b = bench()
    client, own = b.client(), control(b)
    for n in range(25):
        here = list(b.joints())
        there = [v + 0.3 * (1 if n % 2 == 0 else -1) for v in here]
        send_all(client, trajectory([here, there], [10, 1.0]))
        assert reply_of(client)[0] == 1
        b.vc.run_for(0.004 * n)
        assert stop(own) == (1, b""), n
        b.vc.run_for(0.7)
    assert b.healthy()
    assert b.group.stop_reasons == ()
    move_well(b, client)


@pytest.mark.parametrize("owner", ["kind", "task"])
def test_whoever_may_take_back_a_stop(bench, owner):
    b = bench()
    b.group.settings = replace(b.group.settings, stop_owner=owner)
    client, own, _ = streaming(b)
    assert stop(own) == (1, b"")
    own.close()
    b.vc.run_for(3)
    assert b.group.stop_reasons == ()
    move_well(b, client)


def test_stops_on_both_ports_at_once(bench):
    b = bench()
    client, own, _ = streaming(b)
    own.network.send(own.endpoint, STOP)
    client.network.send(client.endpoint, STOP)
    assert reply(own, 11) == (1, b"")
    assert reply_of(client) == (1, ())
    b.vc.run_for(1)
    stays(b)
    move_well(b, client)


# -- PAUSE ----------------------------------------------------------------------------------------


def test_a_pause_keeps_the_path(bench):
    b = bench()
    _, own, state = streaming(b)
    assert pause(own) == 0
    b.vc.run_for(0.6)
    stays(b)
    status = b.status(state)
    assert status[2:5] == (0, 0, 0)
    assert status[6] == 0
    assert all_progress(state)[-1][1] == PAUSED
    assert pause(own, 0) == 0
    b.vc.run_for(9)
    assert b.joints()[0] == pytest.approx(0.004 * 89, abs=1e-5)
    assert b.healthy()


def test_a_pause_of_a_download(bench):
    b = bench()
    client, own = b.client(), control(b)
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    assert pause(own) == 0
    b.vc.run_for(0.6)
    stays(b, 2)
    assert pause(own, 0) == 0
    b.vc.run_for(6)
    assert close_to(b.joints(), FIVE[-1], 1e-5)


def test_a_pause_of_nothing(bench):
    b = bench()
    own = control(b)
    assert pause(own) == IDLE
    assert pause(own, 0) == IDLE
    assert pause(own, 2) == BAD_VALUE
    assert pause(own, -1) == BAD_VALUE
    move_well(b)


def test_pauses_twice(bench):
    b = bench()
    _, own, _ = streaming(b)
    assert [pause(own), pause(own), pause(own, 0), pause(own, 0)] == [0, 0, 0, 0]
    b.vc.run_for(0.5)
    assert not b.group.is_standing


def test_points_come_in_a_pause(bench):
    b = bench()
    client, own, _ = streaming(b, 30)
    assert pause(own) == 0
    client.send(batch(7, 30, line(HOME, 60)[30:], END))
    assert accepted(client)[6] == PAUSED
    stays_after(b)
    assert pause(own, 0) == 0
    b.vc.run_for(6)
    assert b.joints()[0] == pytest.approx(0.004 * 59, abs=1e-5)


def stays_after(b, settling=0.6):
    b.vc.run_for(settling)
    stays(b, 1)


@pytest.mark.parametrize(
    ("action", "reasons"),
    [("stop", {PROGRAM}), ("e-stop", {22}), ("motors-off", {21}), ("manual", {47, 21, PROGRAM})],
)
def test_what_halts_a_motion_halts_a_paused_one(bench, action, reasons):
    b = bench()
    client, own, state = streaming(b)
    assert pause(own) == 0
    b.vc.run_for(1)
    b.vc.perform(action)
    b.vc.run_for(1)
    assert all_progress(state)[-1][1] == FAILED
    assert pause(own, 0) == IDLE
    recover(b)
    stays(b, 3)
    assert pause(own, 0) == IDLE
    stays(b, 1)
    assert b.group.stop_reasons == ()
    move_well(b, client)


@pytest.mark.parametrize("how", ["stop here", "stop there", "client", "download", "stream"])
def test_a_paused_motion_is_ended_like_any_other(bench, how):
    b = bench()
    client, own, _ = streaming(b)
    assert pause(own) == 0
    b.vc.run_for(1)
    here = b.joints()
    if how == "stop here":
        assert stop(own) == (1, b"")
    elif how == "stop there":
        client.send(STOP)
        assert reply_of(client) == (1, ())
    elif how == "client":
        client.close()
        client = None
    elif how == "download":
        client.send(point(-1, list(here), 10.0))
    else:
        client.send(batch(8, 0, [], BEGIN))
        accepted(client)
    b.vc.run_for(1)
    assert pause(own, 0) == IDLE
    b.vc.run_for(1)
    assert b.joints() == here
    assert b.group.stop_reasons == ()
    move_well(b, client)


def test_a_trajectory_that_ends_in_a_pause(bench):
    """By a fault of its own: nothing is left that could be paused, or go on."""
    b = bench()
    client, own, state = streaming(b)
    assert pause(own) == 0
    b.vc.run_for(1)
    number = b.pers("ROS_session")
    b.vc.tasks["T_ROB1"]["ROS_common:ROS_dead_reason"] = 44
    b.vc.tasks["T_ROB1"]["ROS_common:ROS_dead"] = number
    b.vc.run_for(2)
    assert b.group.stop_reasons == ()
    assert b.status(state)[6] == 1
    client.frames()
    move_well(b, client)


def test_a_stop_at_every_statement_of_going_on(bench):
    """STOP on the motion port while the supervisor lets a paused robot go on."""
    for at in statements_of(bench(), "go_on", "ROS_supervisor"):
        b = bench()
        client, own, _ = streaming(b)
        assert pause(own) == 0
        b.vc.run_for(1)
        b.vc.before_statement(
            "T_ROS_SUP", "ROS_supervisor", at, 1, lambda c=client: c.network.send(c.endpoint, STOP)
        )
        pause(own, 0)
        b.vc.run_for(1.5)
        stays(b, 2)
        client.frames()
        assert b.group.stop_reasons == ()
        move_well(b, client)


def test_a_starved_stream_can_be_paused(bench):
    b = bench()
    client, own, state = streaming(b, 30)
    b.vc.run_for(4)
    assert pause(own) == 0
    client.send(batch(7, 30, line(HOME, 60)[30:], END))
    accepted(client)
    stays(b, 2)
    assert all_progress(state)[-1][1] == PAUSED
    assert pause(own, 0) == 0
    b.vc.run_for(5)
    assert b.joints()[0] == pytest.approx(0.004 * 59, abs=1e-5)


# -- SPEED ----------------------------------------------------------------------------------------


def travelled(b, seconds):
    start = b.joints()[0]
    b.vc.run_for(seconds)
    return b.joints()[0] - start


@pytest.mark.parametrize("percent", [1.0, 25.0, 50.0, 99.5])
def test_speed(bench, percent):
    b = bench()
    _, own, _ = streaming(b)
    assert speed(own, percent) == 0
    b.vc.run_for(0.3)
    assert travelled(b, 1) == pytest.approx(0.04 * percent / 100, rel=0.1)
    assert speed(own, 100.0) == 0
    b.vc.run_for(0.3)
    assert travelled(b, 1) == pytest.approx(0.04, rel=0.05)


@pytest.mark.parametrize("percent", [0.0, 0.99, 100.5, -1.0, float("nan"), float("inf")])
def test_speeds_that_there_are_not(bench, percent):
    b = bench()
    _, own, _ = streaming(b)
    assert speed(own, percent) == BAD_VALUE
    assert travelled(b, 1) == pytest.approx(0.04, rel=0.05)


def test_the_next_trajectory_has_its_full_speed(bench):
    b = bench()
    client, own, _ = streaming(b)
    assert speed(own, 10) == 0
    assert stop(own)[0] == 1
    b.vc.run_for(1)
    assert speed(own, 10) == IDLE
    rows = line(list(b.joints()), 60)
    for data in batches(8, rows):
        client.send(data)
        accepted(client)
    b.vc.run_for(1)
    assert travelled(b, 1) == pytest.approx(0.04, rel=0.05)


def test_a_speed_for_what_has_not_begun_to_move(bench):
    b = bench(overrides=["trajectory.preload=3"])
    client, own = b.client(), control(b)
    rows = line(HOME, 60)
    client.send(batch(7, 0, rows[:20], BEGIN))
    accepted(client)
    assert speed(own, 25) == 0
    client.send(batch(7, 20, rows[20:50]))
    accepted(client)
    b.vc.run_for(1)
    assert travelled(b, 1) == pytest.approx(0.01, rel=0.1)


def test_speed_in_a_pause(bench):
    b = bench()
    _, own, _ = streaming(b)
    assert pause(own) == 0
    b.vc.run_for(0.6)
    assert speed(own, 50) == 0
    stays(b, 1)
    assert pause(own, 0) == 0
    b.vc.run_for(0.5)
    assert travelled(b, 1) == pytest.approx(0.02, rel=0.1)


# -- HEARTBEAT ------------------------------------------------------------------------------------


def test_a_heartbeat_tells_the_state(bench):
    b = bench()
    own = control(b)
    assert beat(own, 0) == (1, (0, 0))
    _, own, _ = streaming(b)
    assert beat(own, 0) == (1, (1, MOVING))


def test_a_missing_heartbeat_stops_the_robot(bench):
    b = bench()
    client, own, state = streaming(b)
    for _ in range(6):
        assert beat(own, 0.3)[0] == 1
        b.vc.run_for(0.25)
    assert not b.group.is_standing
    assert b.vc.run_until(lambda: b.group.stop_reasons != (), timeout=0.2)
    assert stopped(own)[2] == CLIENT_LOST
    b.vc.run_for(1)
    stays(b)
    told = all_progress(state)[-1]
    assert (told[1], told[5]) == (FAILED, CLIENT_LOST)
    client.send(batch(7, 90, line(HOME, 5)))
    assert refused(client)[3] == CLIENT_LOST
    # It was missed once: the next trajectory needs none until one is sent.
    move_well(b, client)


def test_heartbeats_may_end(bench):
    b = bench()
    _, own, _ = streaming(b)
    beat(own, 0.3)
    beat(own, 0)
    b.vc.run_for(2)
    assert not b.group.is_standing


@pytest.mark.parametrize("how", ["fin", "reset", "newer"])
def test_a_lost_connection_is_a_missing_heartbeat(bench, how):
    b = bench()
    client, own, state = streaming(b)
    beat(own, 10)
    if how == "newer":
        other = control(b)
    else:
        b.vc.network.close(own.endpoint, abort=how == "reset")
    assert b.vc.run_until(lambda: b.group.stop_reasons != (), timeout=0.5)
    b.vc.run_for(1)
    assert all_progress(state)[-1][5] == CLIENT_LOST
    if how == "newer":
        assert stop(other) == (1, b"")
    move_well(b, client)


def test_a_connection_without_heartbeats_may_be_lost(bench):
    b = bench()
    _, own, _ = streaming(b)
    own.close()
    b.vc.run_for(2)
    assert not b.group.is_standing


@pytest.mark.parametrize("timeout", [-1.0, 3601.0, float("nan"), float("inf")])
def test_heartbeats_that_there_are_not(bench, timeout):
    b = bench()
    _, own, _ = streaming(b)
    assert beat(own, timeout) == (2, (BAD_VALUE,))
    b.vc.run_for(1)
    assert not b.group.is_standing


# -- the connection -------------------------------------------------------------------------------


def test_the_newest_client_is_served(bench):
    """Whoever may stop the robot must be able to, whatever another client does."""
    b = bench()
    client, own, _ = streaming(b)
    own.send(request(HEARTBEAT, struct.pack("<f", 0))[:9])
    other = control(b)
    assert stop(other) == (1, b"")
    own.pump()
    assert own.closed
    move_well(b, client)


@pytest.mark.parametrize("size", [1, 5, 17, 1000])
def test_any_split_and_merge(bench, size):
    b = bench()
    client, own, _ = streaming(b)
    data = b"".join(
        [
            request(HEARTBEAT, struct.pack("<f", 0)),
            request(SPEED, struct.pack("<f", 50)),
            request(PAUSE, struct.pack("<i", 1)),
            STOP,
        ]
    )
    for at in range(0, len(data), size):
        own.send(data[at : at + size])
        b.vc.run_for(0.001)
    assert reply(own, HEARTBEAT)[0] == 1
    assert outcome(own, SPEED) == 0
    assert outcome(own, PAUSE) == 0
    assert reply(own, 11) == (1, b"")
    b.vc.run_for(1)
    move_well(b, client)


@pytest.mark.parametrize(
    "data",
    [
        struct.pack("<4i", -1, 11, 2, 0),
        struct.pack("<4i", 2000, 11, 2, 0),
        point(-1, HOME, 1.0, comm=2),
        point(-4, HOME, 0.0, comm=1),
        HEAD.pack(12, PAUSE, 2, 0),
        HEAD.pack(20, SPEED, 2, 0) + bytes(8),
        HEAD.pack(16, HEARTBEAT, 1, 0) + bytes(4),
        HEAD.pack(12, 11, 2, 0),
        bytes(36),
    ],
)
def test_nonsense_breaks_only_that_link(bench, data):
    b = bench()
    own = control(b)
    own.send(data)
    b.vc.run_for(1)
    own.pump()
    assert own.closed
    assert own.received == b""
    assert b.healthy()
    assert stop(control(b)) == (1, b"")
    move_well(b)


def test_a_message_that_it_does_not_know(bench):
    b = bench()
    own = control(b)
    own.send(HEAD.pack(20, 999, 2, 0) + bytes(8) + request(1))
    assert reply(own, 999) == (2, b"")
    assert reply(own, 1) == (1, b"")


def test_hello_tells_whose_port_it_is(bench):
    b = bench()
    own = control(b)
    own.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 0))
    code, data = reply(own, 1300)
    assert code == 1
    assert data[16:28] == b.output.build_id.encode()
    features, capacity = struct.unpack_from("<2i", data, 40)
    assert features & 6 == 6
    port, ring, preload, size, signals = struct.unpack_from("<2if2i", data, 192)
    assert (port, ring, preload, size, signals) == (11001, 127, 0.5, 30, 0)
    assert capacity == 1000


def test_a_driver_without_a_control_port(bench):
    b = bench(overrides=["ports.control=0"])
    assert "T_ROS_CONTROL" not in b.vc.tasks
    assert not any("ROS_control" in f.path for f in b.output.files)
    assert b"ROS_control_" not in b"".join(f.data for f in b.output.files if f.kind == "module")
    state = b.state_client()
    state.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 0))
    _, data = reply(state, 1300)
    (features,) = struct.unpack_from("<i", data, 40)
    assert features & 14 == 4
    assert struct.unpack_from("<i", data, 192) == (0,)
    client = b.client()
    for frame in batches(7, line(HOME, 40)):
        client.send(frame)
        accepted(client)
    b.vc.run_for(6)
    assert b.joints()[0] == pytest.approx(0.004 * 39, abs=1e-5)
    move_well(b, client)


def test_strangers_are_refused(bench):
    b = bench(allowed_clients=("10.0.0.9",))
    b.address = "10.0.0.8"
    stranger = control(b)
    b.vc.run_for(0.5)
    stranger.pump()
    assert stranger.closed
    b.address = "10.0.0.9"
    assert stop(control(b)) == (1, b"")


def test_an_idle_client_is_never_timed_out(bench):
    b = bench()
    own = control(b)
    b.vc.run_for(600)
    own.pump()
    assert not own.closed
    assert stop(own) == (1, b"")


def test_a_client_that_does_not_read_harms_nobody(bench):
    b = bench()
    client, own, _ = streaming(b)
    b.vc.network.silence(own.endpoint)
    for _ in range(3):
        client.send(STOP)
        b.vc.run_for(2)
        client.frames()
        move_well(b, client)
