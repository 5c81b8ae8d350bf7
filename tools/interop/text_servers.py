"""Trial: servers with text commands, by their own documentation.

    python -m tools.interop.text_servers FOLDER

FOLDER is a checkout of joseballester/abb-rapidserver, jk4684/Gcode, RobotExMachina/Machina.NET or
FlyingSlap/MatrixComm, whose own clients are for ROS, GUIs, or C#.
"""

import socket
import struct
import sys
import threading
from contextlib import suppress
from pathlib import Path

from rapidgen.system.model import ModuleFile, System, TaskSpec
from tools.interop.programs import furnished, programs
from tools.interop.serving import Link, served


def only_program(folder: Path) -> System:
    """Return the first program of a folder, furnished."""
    return furnished(next(programs(folder)).read())


def rapidserver(folder: Path) -> None:
    """Run joseballester/abb-rapidserver: two tasks, motion and logger port."""
    joints = "+0010.00 +0020.00 -0010.00 +0000.00 +0040.00 +0005.00"
    with (
        served(only_program(folder), "irb1600", 2) as (_, (motion, logger)),
        Link(logger) as log,
        Link(motion) as link,
    ):
        assert log.until("# 1 ").startswith("# 0 ")
        replies = []
        for command in (
            f"2 001 {joints} #",
            "4 002 #",
            "2 003 +0999.00 +0020.00 -0010.00 +0000.00 +0040.00 +0005.00 #",
        ):
            link.send(command)
            replies.append(link.until("\n").split())
    done, target, limit = replies
    assert done[:3] == ["2", "001", "1"], done
    moving = [float(word) / axis for word, axis in zip(target[4:7], (10, 20, -10), strict=True)]
    assert 0.8 < min(moving) <= max(moving) <= 1, target  # a fly-by point: it still moves
    assert limit[:2] == ["2", "003"], limit
    assert limit[2] != "1", limit
    print("abb-rapidserver: moved, asked, logged; refuses joints by ReadCfgData's limits")


def gcode(folder: Path) -> None:
    """Run jk4684/Gcode: the server of a G-code player; the pen points down."""
    pose = "+0374.00 +0050.00 +0400.00 +0.0 +0.0 +1.0 +0.0"
    with served(only_program(folder), "irb120") as (_, (port,)), Link(port) as link:
        for command in ("08 +0500 +0100 +0500 +0100 #", f"02 {pose} #", f"01 {pose} #"):
            link.send(command)
            link.until("IC#")
        y = 0.0
        while abs(y - 50) > 0.01:
            link.until("! ")
            y = float(link.until(" #").split()[1])
    print("Gcode: moved, and streamed its position by an interrupt")


def machina(folder: Path) -> None:
    """Run RobotExMachina/Machina.NET, with its two placeholders filled in."""

    def module(name: str, port: str) -> ModuleFile:
        text = (folder / "src/Machina/Resources/DriverModules/ABB" / name).read_bytes()
        text = text.replace(b"{{HOSTNAME}}", b"127.0.0.1").replace(b"{{PORT}}", port.encode())
        return ModuleFile(Path(name).stem, name, text)

    driver = TaskSpec("T_ROB1", motion=True, modules=(module("machina_abb_driver.mod", "7000"),))
    monitor = TaskSpec("T_MON", modules=(module("Machina_ABB_Monitor.mod", "7001"),))
    system = furnished(System("machina", (driver, monitor)))
    with served(system, "irb120", 2) as (controller, (port, watch)), Link(port) as link:
        hello = [link.until(";") for _ in range(4)]
        assert hello[0] == "$20 1 4 2", hello
        with Link(watch) as tracking:
            commands = (
                "4 200 100 200 100;", "5 5;", "3 10 20 -10 0 40 5;", "6 0.5;", "5 0;",
                "1 350 40 450 0 0 1 0;", "8 0 0 100 1 0 0 0 1 0 0 50;", "9;", "14 1;",
                '7 "hello from a client";', "13 2;", "13 0;", "30 350 -40 450 0 0 1 0 370 0 450;",
                "18 10 0 0 1 0 0 0;", "19;", "103 0.05;", "101 1;",
            )  # fmt: skip
            for number, command in enumerate(commands, 1):
                link.send(f"@{number} {command}")
                print("   ", command, "->", link.until(";"))
            tracking.until("$24 ")
            seen = tracking.until(";").split()
        print("    monitor:", *seen)
        assert "hello from a client" in controller.call(lambda: list(controller.operator.rows))
        link.send("@99 100;")
    print("Machina: every instruction acknowledged")


def matrices(folder: Path) -> None:
    """Run FlyingSlap/MatrixComm: 4 x 4 singles, column by column."""
    sent = [float(n) / 8 for n in range(16)]
    # It waits a second before it listens, and listens again after its client disconnects.
    with served(only_program(folder), "irb120") as (controller, (port,)):
        for _ in range(2):
            with connected(port) as link:
                counts = []
                for _ in range(3):
                    counts.append(struct.unpack("<16f", link.recv(64, socket.MSG_WAITALL))[0])
                    link.sendall(struct.pack("<16f", *sent))
                assert counts[1] == counts[0] + 1, counts
            saved = controller.call(lambda: str(controller.task("T_ROB1")["RobotSide:nTestMatrix"]))
        assert "0.125" in saved, saved
    print("MatrixComm: matrices in both directions, twice")


def connected(port: int) -> socket.socket:
    """Return a connection that has received data.

    A server that is closing accepts, too.
    """
    while True:
        with suppress(ConnectionError):
            link = socket.create_connection(("127.0.0.1", port), timeout=10)
            with suppress(ConnectionError):
                if link.recv(1, socket.MSG_PEEK):
                    return link
            link.close()
        threading.Event().wait(0.05)


TRIALS = {
    "main.py": gcode,
    "RAPID/TASK2": rapidserver,
    "src/Machina": machina,
    "MatrixComm.xml": matrices,
}

if __name__ == "__main__":
    place = Path(sys.argv[1])
    next(trial for file, trial in TRIALS.items() if (place / file).exists())(place)
