"""Frames written by hand against a booted controller, over real sockets."""

import socket
import struct
import threading

from tests.acceptance.frames import FIVE_POINTS

STATE_BYTES = 60 + 44
"""One JOINT and one STATUS."""


class Ports:
    """A controller in real time whose servers listen, and its real ports."""

    def __init__(self, controller, motion=11000, state=11002):
        self.controller = controller
        listening = threading.Event()
        network = controller.network

        def look():
            if motion in network.listeners and state in network.listeners:
                listening.set()

        network.listening.add(look)
        controller.start()
        assert listening.wait(60), controller.call(controller.where)
        self.motion = network.listeners[motion][1]
        self.state = network.listeners[state][1]

    def connect(self, port):
        link = socket.create_connection(("127.0.0.1", port), timeout=60)
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return link


def read(link, count):
    data = b""
    while len(data) < count:
        more = link.recv(count - len(data))
        assert more, f"the controller closed the connection after {len(data)} bytes"
        data += more
    return data


def next_state(link):
    """JOINT and STATUS frames, in whichever order they come."""
    frames = {}
    while len(frames) < 2:
        head = read(link, 4)
        body = read(link, struct.unpack("<i", head)[0])
        frames[struct.unpack("<i", body[:4])[0]] = head + body
    return frames[10], frames[13]


def until(link, joint, status, tries=400):
    """Read states until both frames are those; all (joint, status) pairs seen."""
    seen = []
    for _ in range(tries):
        seen.append(next_state(link))
        if seen[-1] == (joint, status):
            return seen
    raise AssertionError(f"never {joint.hex()} with {status.hex()}; last {seen[-1]}")


def too_many(count):
    """A trajectory of `count` points: small steps of joint 1 (hand-made from FIVE_POINTS)."""
    frames = []
    for number in range(count):
        frame = bytearray(FIVE_POINTS[0] if number == 0 else FIVE_POINTS[1])
        sequence = -1 if number == 0 else -3 if number == count - 1 else number
        frame[16:20] = struct.pack("<i", sequence)
        frame[20:24] = struct.pack("<f", 0.001 * number)
        frames.append(bytes(frame))
    return b"".join(frames)
