"""Streams and the control connection for every kind of robot: axes, units, groups."""

import struct

import pytest

from rapidgen.wire.simple_message.messages import batch_points
from tests.generate.bench import STOP, close_to
from tests.generate.driving import move_well
from tests.generate.streams import (
    BEGIN,
    HEAD,
    accepted,
    batch,
    batches,
    refused,
    reply,
    send_stream,
)

ROBOTS = ["irb120_track", "irb2400", "irb460", "irb910sc", "irb14050", "crb15000", "irb6640"]
LIMIT = 4


def rows_for(b, group, count, *, share=0.3):
    """Every axis in steps of its own to where it has room, 0.2 s a segment."""
    here = list(b.joints(group.name))
    steps = []
    for joint, value in zip(group.joints, here, strict=True):
        up, down = joint.upper - value, joint.lower - value
        room = up if up > -down else down
        step = min(abs(room) / count, 0.2 * joint.speed * share) * (1 if room > 0 else -1)
        steps.append(step)
    return [
        (0.2 if n else 0.0, [v + s * n for v, s in zip(here, steps, strict=True)])
        for n in range(count)
    ]


@pytest.mark.parametrize("name", ROBOTS)
def test_every_axis_goes_where_it_is_sent(bench, name):
    """Prismatic axes are in m, the controller's axes are not coupled on the wire."""
    b = bench(name)
    (group,) = b.config.groups
    rows = rows_for(b, group, 45)
    client = b.client()
    size = batch_points(len(group.joints))
    sizes = {4: 41, 6: 30, 7: 30, 8: 24}
    assert size == sizes[len(group.joints)]
    send_stream(client, rows, size=size)
    b.vc.run_for(45 * 0.2 + 1.5)
    assert close_to(b.joints(), rows[-1][1], 2e-6)
    assert b.healthy()
    for axis, (start, end) in enumerate(zip(rows[0][1], rows[-1][1], strict=True)):
        assert abs(end - start) > 0.01, axis


@pytest.mark.parametrize("name", ROBOTS)
def test_every_axis_has_its_limits(bench, name):
    b = bench(name)
    (group,) = b.config.groups
    for n, joint in enumerate(group.joints):
        client = b.client()
        outside = list(b.joints())
        outside[n] = joint.upper + 0.001
        client.send(batch(n + 1, 0, [(0, outside), (1, outside)], BEGIN))
        assert refused(client)[3:] == (LIMIT, 0, n + 1)
        client.close()
        b.vc.run_for(0.1)
    assert b.healthy()


def test_two_arms_stream_and_stop_apart(bench):
    b = bench("irb14000")
    left, right = b.config.groups
    clients, rows = {}, {}
    for group in b.config.groups:
        clients[group.name] = b.client(group.ports.motion)
        rows[group.name] = rows_for(b, group, 40)
        for data in batches(7, rows[group.name], size=30):
            clients[group.name].send(data)
            assert accepted(clients[group.name])[1] == 1
    b.vc.run_for(2)
    own = b.client(left.ports.control)
    own.send(STOP)
    assert reply(own, 11) == (1, b"")
    frame = own.wait_frame(timeout=2)
    assert HEAD.unpack_from(frame)[1] == 1303
    joints = struct.unpack_from("<10f", frame, 28)
    assert close_to(joints[:7], b.joints(left.name), 1e-6)
    b.vc.run_for(8)
    assert close_to(b.joints(right.name), rows[right.name][-1][1], 2e-6)
    assert abs(b.joints(left.name)[0] - rows[left.name][-1][1][0]) > 0.01
    assert b.healthy()


def test_stopped_tells_linear_axes_in_m(bench):
    b = bench("irb120_track")
    (group,) = b.config.groups
    client, own = b.client(), b.client(group.ports.control)
    for data in batches(7, rows_for(b, group, 24), size=24):
        client.send(data)
        accepted(client)
    b.vc.run_for(2)
    own.send(STOP)
    assert reply(own, 11) == (1, b"")
    frame = own.wait_frame(timeout=2)
    joints = struct.unpack_from("<10f", frame, 28)
    count = len(group.joints)
    assert close_to(joints[:count], b.joints(), 1e-5)
    assert joints[count:] == (0.0,) * (10 - count)


@pytest.mark.parametrize("robotware", ["5.61", "7.10"])
def test_other_generations_stream_alike(bench, robotware):
    kind = "omnicore" if robotware.startswith("7") else "irc5"
    b = bench(overrides=[f"controller.robotware={robotware}", f"controller.type={kind}"])
    rows = rows_for(b, b.config.groups[0], 30)
    client = b.client()
    send_stream(client, rows)
    b.vc.run_for(8)
    assert close_to(b.joints(), rows[-1][1], 2e-6)
    move_well(b, client)
