"""Sockets of the driver: ports in use, and impossible message lengths."""

import struct
from itertools import product

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import JOINT_TRAJ_PT, PING, RawComm, encode
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.testbench import Bench

case = SuiteGroup("framing")

_PING = encode(messages.RawPing(), RawComm.REQUEST)


def _pings(link: RawLink, what: str) -> None:
    if not isinstance(link.reply(PING, 0.3), messages.RawAcknowledged):
        raise CheckFailed(f"{what}: PING is not confirmed")


@case("whole-headers", "lengths at their bounds and beyond, in whole headers", "R3")
def _whole_headers(bench: Bench) -> None:
    """Send lengths out of bounds, with any type and at any place."""
    lengths = (-(2**31), -1024, -16, -1, 0, 11, 1021, 100_000)
    for length, number in product(lengths, (PING, JOINT_TRAJ_PT, 1399)):
        for before in (b"", _PING):
            link = bench.motion()
            head = struct.pack("<4i", length, number, RawComm.REQUEST, 0)
            link.send(before + head)
            what = f"a message of type {number} and {length} bytes"
            if before:
                _pings(link, f"in front of {what}")
            link.wait_disconnected(0.2, f"{what} breaks the link")
            if link.read():
                raise CheckFailed(f"{what} is answered")
        link = bench.motion()
        link.send(head[:4])
        link.wait_disconnected(0.2, f"{length} as a length breaks the link")
    # Data that one client started does not affect the next one.
    link = bench.motion()
    link.send(_PING[:10])
    bench.run(0.05)
    link.close(then=0.05)
    link = bench.motion()
    for piece in (_PING[:10], _PING[10:] + _PING + _PING[:4], _PING[4:]):
        link.send(piece)
        bench.run(0.02)
    for _ in range(3):
        _pings(link, "PING in pieces, and another one after it")
    longest = struct.pack("<4i", 1020, 1399, RawComm.TOPIC, 0) + bytes(1008)
    for size in (16, 500, 1024):
        for at in range(0, len(longest), size):
            link.send(longest[at : at + size])
            bench.run(0.01)
        link.send(_PING)
        _pings(link, f"after a message of 1024 bytes in pieces of {size}")
    bench.assert_at_rest(0.5, "no client asked for motion")


@case("ports-open", "ports that are taken are waited for, then stay open", "R18")
def _ports_open(bench: Bench) -> None:
    """Retry ports in use at the start each second, then keep them open."""
    network, ports = bench.controller.network, bench.group.ports
    expected = [port for port in (ports.motion, ports.control, ports.state) if port]
    bench.run(1)
    last = bench.last_event
    network.address = "192.0.2.17"
    for action in ("power-loss", "pp-to-main"):
        bench.controller.perform(action)
    accepted = [network.bind("", port) for port in expected]
    bench.start_again()
    scheduler = bench.controller.scheduler
    idle, since = scheduler.idle, scheduler.now
    bench.run(2.5)
    share = 1 - (scheduler.idle - idle) / (scheduler.now - since)
    if share > 0.1 * len(bench.config.groups):
        raise CheckFailed(f"while ports are taken the driver takes {share:.0%} of the processor")
    for port in expected:
        title = f"ROS: port {port} cannot be opened"
        log_entries = [e for e in bench.controller.log.since(last) if e.title == title]
        if len(log_entries) != 1:
            raise CheckFailed(
                f"port {port} is taken, the event log says so {len(log_entries)} times"
            )
    changes: list[float] = []
    for endpoint in accepted:
        network.close(endpoint)
    bench.until(lambda: all(p in network.listeners for p in expected), 1.1, "ports are opened")
    # A virtual controller has no LAN port; the driver binds a configured address unchanged.
    hosts = {network.listeners[port][0] for port in expected}
    if bench.config.bind == "lan" and hosts != {"127.0.0.1"}:
        raise CheckFailed(f"the virtual controller listens at {hosts}")
    network.listening.add(lambda: changes.append(bench.now))
    for _ in range(3):
        links = [bench.motion(), bench.state()]
        if ports.control:
            links.append(bench.control())
        bench.run(0.7)
        for link in links:
            link.close()
        bench.run(0.2)
    if changes:
        raise CheckFailed(f"clients came and went, ports were opened or closed at {changes}")
