"""Datagrams of externally guided motion in real time, with a foreign client over UDP."""

import os
import signal
import socket
import threading

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.egm.exchange import Inputs
from rapidgen.servers.egm import ProcessLoop, UdpLink, serve_egm

abb = pytest.importorskip("abb_robot_client.egm")

PROGRAM = r"""MODULE m
CONST egm_minmax near := [-0.1, 0.1];
VAR egmident id;
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=@timeout;
EGMActJoint id \Tool:=tool0 \J1:=near \MaxSpeedDeviation:=100;
EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=0.1;
TPWrite "converged";
ERROR
TPWrite "no partner";
ENDPROC
ENDMODULE
"""


class Cell:
    """A controller on the real clock, on a thread of its own."""

    def __init__(self, path, address, timeout):
        (path / "m.mod").write_text(PROGRAM.replace("@timeout", str(timeout)))
        self.controller = VirtualController.from_files(
            {"T_ROB1": [path / "m.mod"]},
            robots=load_config("irb120").groups,
            cycle="once",
            clock="real",
        )
        self.end = serve_egm(self.controller, {"pc": address})
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def done(self):
        failed = self.controller.rapid_tasks["T_ROB1"].fault is not None
        return self.ended.is_set() or failed or bool(self.controller.operator.rows)

    def run(self):
        scheduler = self.controller.scheduler
        scheduler.rebase()
        while not self.done():
            scheduler.advance(scheduler.now + 10_000_000, self.done)
        self.end()

    def close(self):
        self.ended.set()
        self.thread.join()
        self.controller.close()


@pytest.fixture
def cell(tmp_path):
    made = []

    def make(port, timeout=60):
        made.append(Cell(tmp_path, ("127.0.0.1", port), timeout))
        return made[-1]

    yield make
    for one in made:
        one.close()


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_foreign_client_guides_the_robot(cell):
    """abb_robot_client 0.4 as it is: it binds the port and answers each message."""
    port = free_port()
    client = abb.EGM(port=port)
    try:
        one = cell(port)
        states = []
        while not one.done():
            received, state = client.receive_from_robot(0.1)
            if received:
                states.append(state)
                client.send_to_robot([10, 0, 0, 0, 30, 0])
        one.thread.join()
    finally:
        client.socket.close()
    assert list(one.controller.operator.rows) == ["converged"]
    assert states[0].joint_angles[0] == pytest.approx(0)
    assert states[-1].joint_angles[0] == pytest.approx(10, abs=0.1)
    assert all(state.motors_on and state.rapid_running for state in states)


def test_no_listener(cell):
    """A GoFa with RobotWare 7.20: 41830, and the program stops at once."""
    one = cell(free_port())
    one.thread.join()
    assert 41_830 in [event.code for event in one.controller.log]


def test_datagrams_of_other_addresses_are_dropped():
    link = UdpLink(("127.0.0.2", free_port()))
    port = link._socket.getsockname()[1]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        other.sendto(b"wrong", ("127.0.0.1", port))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as partner:
        partner.bind(("127.0.0.2", 0))
        partner.sendto(b"right", ("127.0.0.1", port))
    # UDP keeps the order on loopback: the first that is returned was sent second.
    received = None
    while received is None:
        received = link.receive()
    assert received == b"right"
    link.close()


def test_a_process_that_reads_nothing_does_not_delay_the_controller():
    """Its start takes hundreds of cycles; a full pipe must not stop the controller meanwhile."""
    loop = ProcessLoop(None, ("127.0.0.1", free_port()), 0.0)
    os.kill(loop._process.pid, signal.SIGSTOP)
    inputs = Inputs((0.0,) * 6, (0.0,) * 6, motors_on=True, program_runs=True)

    def cycles():
        for _ in range(3000):
            loop.cycle(inputs, 0.0)

    thread = threading.Thread(target=cycles, daemon=True)
    thread.start()
    thread.join(30)
    blocked = thread.is_alive()
    loop._process.kill()
    thread.join()
    loop.close()
    assert not blocked
