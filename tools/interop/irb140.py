"""Trial: gizatt/ABB-IRB140, its server and logger with its Python client.

    python -m tools.interop.irb140 FOLDER

FOLDER is a checkout. The client abb.py is for Python 2: it is converted in memory (lib2to3, so that
this needs Python 3.12 or older), and its sockets take texts. The trial sends every command that
needs no option.
"""

import socket
import sys
import threading
import warnings
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from rapidgen.system import read_files
from tools.interop.serving import served

START = [10.0, 20.0, -10.0, 0.0, 40.0, 5.0]


class TextSocket(socket.socket):
    """A socket as in Python 2: sent and received data is text."""

    def send(self, data: str) -> int:
        """Send a text."""
        return super().send(data.encode("latin-1"))

    def recv(self, size: int) -> str:
        """Return the received text."""
        return super().recv(size).decode("latin-1")


def client(path: Path) -> ModuleType:
    """Return the module of a Python 2 file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from lib2to3.refactor import RefactoringTool, get_fixers_from_package
    tool = RefactoringTool(get_fixers_from_package("lib2to3.fixes"))
    text = str(tool.refactor_string(path.read_text().expandtabs(8) + "\n", str(path)))
    module = ModuleType("abb")
    exec(compile(text, str(path), "exec"), module.__dict__)
    names = ("AF_INET", "SOCK_STREAM", "SHUT_RDWR")
    module.socket = SimpleNamespace(  # type: ignore[attr-defined]
        socket=TextSocket, **{name: getattr(socket, name) for name in names}
    )
    return module


def near(result: object, expected: object, by: float) -> bool:
    """True if numbers are equal within a tolerance."""
    return all(abs(a - b) <= by for a, b in zip(result, expected, strict=True))  # type: ignore[call-overload]


def logged(ask: Any) -> list[float]:
    """Return the logger's values, after its client has found a message.

    Messages have no end; a client that reads two in one keeps the second inside the first.
    """
    while (result := ask()) is None or len(result) != 6:
        threading.Event().wait(0.01)
    return result


def everything(robot: Any, log: Any) -> None:
    """Send every command that needs no option."""
    robot.setJoints(START)
    while not near(robot.getJoints(), START, 0.01):
        pass
    current, turned = robot.getCartesian()
    robot.setSpeed([500, 100, 500, 100])
    robot.setCartesian([[current[0], current[1], current[2] + 30], turned])
    poses = [[[current[0], current[1] + y, current[2]], turned] for y in (10, 20, 30)]
    assert robot.setBuffer(poses)
    robot.setZone(finep=True)
    robot.executeBuffer()
    assert near(robot.getCartesian()[0], poses[-1][0], 0.1)
    robot.setZone("z1")
    # Its client waits for an answer "15 1 " that no server sends: the circle is skipped.
    assert not robot.setCircular([poses[0][0], turned], [current, turned])
    for axis in (12, 14, 16):
        robot.addJointPosBuffer([axis, *START[1:]])
    assert robot.lenJointPosBuffer() == 3
    robot.executeJointPosBuffer()
    robot.setJointPosBufferFTSetpoint()
    robot.executeJointPosBufferWithFT()
    robot.setMoveTime(0.5)
    for axis in (14, 12, 10):
        robot.addJointPosTimeBuffer([axis, *START[1:]])
    assert robot.lenJointPosTimeBuffer() == 3
    robot.executeJointPosTimeBuffer()
    robot.clearSoft()
    while not near(robot.getJoints(), START, 0.2):
        pass
    assert robot.getForceSensors() == [0.0] * 6
    print("robot info", robot.getRobotInfo())
    print("external axes", robot.getExternalAxis())
    text = [logged(log.getJoints), logged(log.getForceSensors)]
    assert near(text[0], START, 0.2)
    assert near(text[1], [0.0] * 6, 0)


def main(folder: Path) -> None:
    """Run moves, buffers, soft servos, force sensor and the logger."""
    abb = client(folder / "abb.py")
    system = read_files(
        {"T_ROB1": [folder / "RAPID" / "SERVER.mod"], "T_LOG": [folder / "RAPID" / "LOGGER.mod"]}
    )
    tasks = (
        replace(system.tasks[0], mechanical_unit_group="rob1"),
        replace(system.tasks[1], motion=False, mechanical_unit_group="rob1"),
    )
    irb140 = str(Path(__file__).with_name("irb140.yaml"))
    with served(replace(system, tasks=tasks), irb140, 2) as (_, (server, logger)):
        robot = abb.Robot("127.0.0.1", server)
        log = abb.Logger("127.0.0.1", logger)
        try:
            everything(robot, log)
        finally:
            log.stop()
            robot.close()
    print("connected, moved, buffered and logged with its own abb.py")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
