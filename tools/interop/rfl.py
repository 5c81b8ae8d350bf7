"""Trial: two backups of createchaos/abb_communication.

    python -m tools.interop.rfl FOLDER

FOLDER is a checkout: two robots on gantries, five tasks. Its client is for Python 2 and a GUI; its
bytes are written here by hand. A backup's master and its robots both write `bWaitForJob` after the
same synchronisation point. Their timing decides if the master asks its operator: schedules are
tried until it does.
"""

import math
import socket
import struct
import sys
import threading
from dataclasses import replace
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.system import read_system

BACKUPS = "src/abb_communication/robotstudio"
JOB = "A009 Stefana"
COMMAND, POSE, JOINTS, EXECUTED = 1, 5, 6, 15
TO_JOINTS, TO_TARGET, BY_JOINTS = 1, 2, 5
ROBOT_3 = 3.0
START = [0.0, 10.0, 20.0, 0.0, 40.0, 0.0, 5000.0, -2000.0, -1500.0]


def started(backup: Path) -> VirtualController:
    """Return the controller in real time, with the operator's job selected."""
    system = read_system(backup)
    one, two = groups_for(system, load_config(str(Path(__file__).with_name("gantry.yaml"))).groups)
    (gantry,) = two.positioners
    other = replace(
        two, external_units=("Gantry22",), positioners=(replace(gantry, unit="Gantry22"),)
    )
    for seed in range(20):
        controller = VirtualController(
            system,
            (one, other),
            clock="real",
            ports="auto",
            speed=20,
            schedule="random",
            seed=seed,
            autostart=False,
        )
        requested = threading.Event()
        controller.operator.attach()
        controller.operator.asked.add(requested.set)
        controller.start_program()
        controller.start()
        if requested.wait(3):
            return controller
        controller.close()
    raise AssertionError("no schedule lets the master ask")


def port(controller: VirtualController, number: int) -> int:
    """Return the real port of a server, once it listens."""
    target = threading.Event()

    def look() -> None:
        if number in controller.network.listeners:
            target.set()

    controller.call(lambda: (controller.network.listening.add(look), look()))
    assert target.wait(20), number
    return controller.network.listeners[number][1]


class Robot:
    """The two connections of a client."""

    def __init__(self, sending: int, receiving: int) -> None:
        self._to = socket.create_connection(("127.0.0.1", sending), timeout=30)
        self._from = socket.create_connection(("127.0.0.1", receiving), timeout=30)
        self._count = 0

    def command(self, kind: int, *values: float, speed: int = 2, zone: int = 0) -> None:
        """Send a command with up to ten values; return after execution."""
        self._count += 1
        data = struct.pack(
            "<i10fif2if2i",
            kind,
            *values,
            *[0.0] * (10 - len(values)),
            speed,
            0,
            zone,
            0,
            ROBOT_3,
            0,
            0,
        )
        head = struct.pack("<2Q3I", len(data) + 12, COMMAND, self._count, 0, 0)
        self._to.sendall(head + data)
        while struct.unpack("<i", self.message(EXECUTED)[:4])[0] < self._count:
            pass

    def message(self, expected: int) -> bytes:
        """Return the next message of a kind."""
        while True:
            length, kind, *_ = struct.unpack("<2Q3I", self._from.recv(28, socket.MSG_WAITALL))
            data = self._from.recv(length - 12, socket.MSG_WAITALL)
            if kind == expected:
                return data

    def joints(self) -> list[float]:
        """Return axes of the third robot, deg and mm; messages have rad."""
        self.message(JOINTS)
        axes = struct.unpack("<36f", self.message(JOINTS))[18:27]
        return [*map(math.degrees, axes[:6]), *axes[6:]]

    def pose(self) -> list[float]:
        """Return TCP and gantry of the third robot."""
        self.message(POSE)
        return list(struct.unpack("<40f", self.message(POSE)))[20:30]

    def close(self) -> None:
        """Close both connections."""
        self._to.close()
        self._from.close()


def near(result: list[float], expected: list[float], by: float) -> bool:
    """True if numbers are equal within a tolerance."""
    return all(abs(a - b) <= by for a, b in zip(result, expected, strict=True))


def moved(backup: Path) -> None:
    """Move joints, relative joints and targets of a robot on a gantry."""
    controller = started(backup)
    try:
        number = controller.call(lambda: controller.operator.questions[0].number)
        controller.call(lambda: controller.operator.answer(number, JOB))
        robot = Robot(*(port(controller, number) for number in (30003, 30004)))
        robot.command(TO_JOINTS, *START)
        assert near(robot.joints(), START, 0.01), robot.joints()
        robot.command(BY_JOINTS, 5, 0, 0, 0, 0, 0, 100, 0, 0)
        assert near(robot.joints(), [5, *START[1:6], 5100, *START[7:]], 0.01), robot.joints()
        pose = robot.pose()
        print("    pose and gantry", *(round(v, 2) for v in pose))
        pose[0] += 50
        pose[1] -= 100
        robot.command(TO_TARGET, *pose)
        assert near(robot.pose(), pose, 0.1), robot.pose()
        # The gantry goes back, and the robot keeps its tool where it is.
        pose[7] -= 100
        robot.command(TO_TARGET, *pose)
        assert near(robot.pose(), pose, 0.1), robot.pose()
        robot.close()
    except (AssertionError, OSError, struct.error) as error:
        where = controller.call(lambda: [*controller.where(), *map(str, controller.log)])
        raise AssertionError("\n".join(where)) from error
    finally:
        controller.close()
    print(f"{backup.name}: moved by joints and targets, with the gantry")


if __name__ == "__main__":
    for place in sorted((Path(sys.argv[1]) / BACKUPS).glob("*_BACKUP_*")):
        moved(place)
