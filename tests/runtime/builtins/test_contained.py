"""Bad clients of one task do not affect the others.

Floods, garbage, a peer without reads. A whole controller in real time on the operating system's
sockets. T_PULSE answers each byte with its count; while it answers, the controller works.
"""

import os
import socket
import threading

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec

ECHO, PULSE, POUR = 12000, 12001, 12002
HEAD = """MODULE {name}
    VAR socketdev server;
    VAR socketdev client;
    VAR rawbytes data;
    VAR num count;
    PROC open()
        SocketCreate server;
        SocketBind server, "192.168.125.1", {port};
        SocketListen server;
    ENDPROC
    PROC main()
        open;
        WHILE TRUE DO
            SocketAccept server, client \\Time:=WAIT_MAX;
            serve;
            SocketClose client;
        ENDWHILE
    ENDPROC
    PROC serve()
        WHILE TRUE DO
{body}
        ENDWHILE
    ERROR
        RETURN;
    ENDPROC
ENDMODULE
"""
BODIES = {
    "echo": (ECHO, "SocketReceive client \\RawData:=data; SocketSend client \\RawData:=data;"),
    "pulse": (
        PULSE,
        "SocketReceive client \\RawData:=data \\ReadNoOfBytes:=1 \\Time:=WAIT_MAX;"
        ' count := count + 1; SocketSend client \\Str:=NumToStr(count, 0) + ";";',
    ),
    "pour": (POUR, "PackRawBytes 0, data, 1021 \\IntX:=DINT; SocketSend client \\RawData:=data;"),
}


def task(name: str) -> TaskSpec:
    port, body = BODIES[name]
    text = HEAD.format(name=name, port=port, body=body).encode()
    return TaskSpec(f"T_{name.upper()}", modules=(ModuleFile(name, f"{name}.mod", text),))


@pytest.fixture
def cell():
    """The controller, and a function that connects to one of its servers."""
    system = System("cell", tuple(task(name) for name in BODIES))
    with VirtualController(system, clock="real", ports="auto") as controller:
        listeners = controller.network.listeners
        listening = threading.Event()

        def look():
            if len(listeners) == len(BODIES):
                listening.set()

        controller.network.listening.add(look)
        controller.start()
        assert listening.wait(60), controller.call(controller.where)

        def connect(port):
            return socket.create_connection(("127.0.0.1", listeners[port][1]), timeout=60)

        yield controller, connect
        assert [t.fault for t in controller.tasks.values()] == [None] * len(BODIES)


class Pulse:
    """A client of T_PULSE: every beat must be answered with the next number."""

    def __init__(self, connect):
        self._link = connect(PULSE)
        self._count = 0

    def beat(self):
        self._link.sendall(b"x")
        self._count += 1
        reply = b""
        while not reply.endswith(b";"):
            reply += self._link.recv(16)
        assert reply == b"%d;" % self._count

    def close(self):
        self._link.close()


def echo(connect, text=b"still here"):
    """Connect until it is one's turn, and have a text sent back."""
    while True:
        with connect(ECHO) as link:
            try:
                link.sendall(text)
                reply = link.recv(len(text))
            except ConnectionError:
                continue
            if reply:
                assert text.startswith(reply)
                return


def test_a_thousand_connections(cell):
    _, connect = cell
    pulse = Pulse(connect)
    for _ in range(4):
        with connect(ECHO) as first:
            address = first.getpeername()
            flood = []
            for _ in range(250):
                one = socket.socket()
                one.setblocking(False)
                one.connect_ex(address)
                flood.append(one)
            pulse.beat()
            for one in flood:
                one.close()
        pulse.beat()
    echo(connect)
    pulse.close()


def test_garbage(cell):
    _, connect = cell
    pulse = Pulse(connect)
    for size in (1, 80, 1024, 5000, 70_000):
        with connect(ECHO) as link:
            sender = threading.Thread(target=_send, args=(link, os.urandom(size)))
            sender.start()
            left = size
            while left:
                left -= len(link.recv(left))
            sender.join()
        pulse.beat()
    with connect(ECHO) as link:
        link.sendall(os.urandom(200))
    echo(connect)
    pulse.close()


def _send(link, data):
    link.sendall(data)


def test_unread_data_do_not_block_controller(cell):
    controller, connect = cell
    pulse = Pulse(connect)
    with connect(POUR) as idle:
        idle.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        # Buffers are full when the task waits for room.
        while controller.call(lambda: controller.rapid_tasks["T_POUR"].waits_for) is None:
            pulse.beat()
        for _ in range(50):
            pulse.beat()
    with connect(POUR) as reader:
        left = 100_000
        while left:
            left -= len(reader.recv(left))
    pulse.beat()
    pulse.close()
