"""Trial: ten servers of courses, theses and small tools, with their clients.

    python -m tools.interop.text_pairs FOLDER...

Each FOLDER is a checkout of one of the repositories below. Their clients are GUIs, C#, C++, or need
a camera: the table has their messages and the expected answers. Cells are inferred, sockets are
real, and the programs are unchanged.
"""

import socket
import struct
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target

_READY = 10.0
Talk = Callable[["Line", VirtualController], None]


class Line:
    """A client's connection."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=60)

    def say(self, text: str | bytes) -> None:
        """Send."""
        self._socket.sendall(text if isinstance(text, bytes) else text.encode("latin-1"))

    def hear(self, expected: str) -> str:
        """Wait for data that contains a text."""
        seen = ""
        while expected not in seen:
            more = self._socket.recv(4096).decode("latin-1")
            assert more, f"closed after {seen!r}, without {expected!r}"
            seen += more
        return seen

    def close(self) -> None:
        """Disconnect."""
        self._socket.close()


@dataclass(frozen=True)
class Pair:
    """A server of a repository, and a dialogue with it."""

    repository: str
    files: tuple[str, ...]
    """Patterns; the first file of each."""
    talk: Talk
    robot: str = ""


@contextmanager
def serving(folder: Path, pair: Pair) -> Iterator[tuple[VirtualController, Line]]:
    """Run the server in real time; yield it and a client."""
    files = [sorted(folder.rglob(pattern))[0] for pattern in pair.files]
    result = load_target(files, BootOptions(cell="infer", robot=pair.robot))
    with VirtualController.boot(
        result, clock="real", host="127.0.0.1", ports="auto", speed=20, autostart=False
    ) as controller:
        controller.start()
        controller.call(controller.start_program)
        until = time.monotonic() + _READY
        while not controller.network.listeners and time.monotonic() < until:
            time.sleep(0.02)
        assert controller.network.listeners, controller.call(controller.where)
        line = Line(next(iter(controller.network.listeners.values()))[1])
        try:
            yield controller, line
        except (AssertionError, OSError) as error:
            where = controller.call(lambda: [*controller.where(), *map(str, controller.log)])
            raise AssertionError(f"{error}: {where}") from error
        finally:
            line.close()


def _shown(controller: VirtualController) -> list[str]:
    return controller.call(lambda: list(controller.operator.rows))


def drawing(line: Line, controller: VirtualController) -> None:
    """Draw as main.py: three floats in network order.

    R when they are read, D when the robot is there.
    """
    for place in ((0.0, 0.0, 0.0), (5.0, 5.0, -5.0)):
        line.say(struct.pack("!fff", *place))
        line.hear("R")
        line.hear("D")
    assert "Received Z:-5" in _shown(controller)


def datawood(line: Line, controller: VirtualController) -> None:
    """Talk as SocketClient.cs: ask, send a command's parts, wait for Ready."""
    line.say("listening?")
    line.hear("Yes")
    parts = "MoveAbsJ", "[200,500,5000,1000]", "[FALSE,5,5,5,5,5,5]", "[9E9,9E9,9E9,9E9,9E9,9E9]"
    for part in (*parts, "[0,10,0,0,30,0]"):
        line.say(part)
        time.sleep(0.2)
    line.hear("Ready")
    line.say("next")
    for part in ("Wait", "0.5"):
        time.sleep(0.2)
        line.say(part)
    line.hear("Ready")
    line.say("No more targets")
    axis = controller.call(lambda: controller.positions("rob1")["joint_2"])
    assert abs(axis - 0.1745) < 1e-3, axis


def laser(line: Line, _controller: VirtualController) -> None:
    """Talk as ABB_Lib.py: greeting, answer, and position of the robot."""
    line.hear("Robot ready")
    line.say("CONNECT Robot_access")
    line.hear("Message acknowledged")
    line.say("RPOSC")
    text = line.hear(",").split(",")
    assert float(text[0]) > 100, text


def chess(line: Line, _controller: VirtualController) -> None:
    """Talk as Controller.cpp: words with a trailing blank, one line back."""
    line.say("rdata num prueba ")
    assert line.hear("\n") == "num100\n"
    line.say("wrdata num prueba 5 ")
    assert line.hear("\n") == "ok\n"
    line.say("rdata num prueba ")
    assert line.hear("\n") == "num5\n"
    line.say("wrdata pos rpos [1,2,3] ")
    line.hear("ok\n")
    line.say("rdata pos rpos ")
    assert line.hear("\n") == "pos[1,2,3]\n"


def speech(line: Line, _controller: VirtualController) -> None:
    """Talk as python-example/client.py: function name, #, typed text."""
    line.say("CRobT_fc#0")
    line.hear("CurrentXYZ#")
    line.say("CJointT_fc#0")
    line.hear("CurrentJoints#")


def cups(line: Line, _controller: VirtualController) -> None:
    """Talk as Test.py: a word, its answer, and the next question."""
    for word, answer in (
        ("Connection_test", "Connection_Confirmed"),
        ("Coordinates", "_ack"),
        ("Gripp", "Ack_Gripp done"),
        ("anything", "default_anything"),
    ):
        line.say(word)
        received = line.hear(answer)
        if "Ask_next" not in received:
            line.hear("Ask_next")


def factory(line: Line, controller: VirtualController) -> None:
    """Talk as rs2YuMi: coordinates and gripper state, without an answer."""
    before = controller.call(controller.positions)
    line.say("400;0250;300;0")
    _until(lambda: any("Abierto" in row for row in _shown(controller)))
    _until(lambda: controller.call(controller.positions) != before)
    line.say("400;0200;300;1")
    _until(lambda: any("Cerrado" in row for row in _shown(controller)))


def voice(line: Line, _controller: VirtualController) -> None:
    """Send the words of IBR1200.cs' buttons."""
    for word, answer in (("DISTANCE", "DISTANCE OPTION"), ("Home", "HOME POSITION")):
        line.say(word)
        line.hear(answer)
        time.sleep(0.2)


def serial(line: Line, controller: VirtualController) -> None:
    """Talk as main.py: greeting, then a letter from a serial port.

    S moves.
    """
    line.hear("buna seara!")
    before = controller.call(controller.positions)
    line.say("S")
    _until(lambda: controller.call(controller.positions) != before)


def tester(line: Line, _controller: VirtualController) -> None:
    """Talk as Main.cs: the name of a procedure, echoed after it has run."""
    line.say("Path_10")
    received = line.hear("Done")
    assert received == "OngoingPath_10_RobotDone", received


def _until(holds: Callable[[], bool]) -> None:
    until = time.monotonic() + 10
    while not holds():
        assert time.monotonic() < until, "it did not come to that"
        time.sleep(0.05)


PAIRS = (
    Pair("CholsaKosal/robot_auto_Drawing", ("rapid_code.mod",), drawing),
    Pair("gieldid/DatawoodGH", ("Socket_Server.mod",), datawood),
    Pair("NghiaPhanbk/LaserVisionSystem", ("Module1.modx",), laser),
    Pair("FedePinna/IRC5-Server", ("MainServer.mod", "Server.mod", "Commands.mod"), chess),
    Pair("alexsleat/GPC_IRB-120", ("MainModuleG.mod",), speech),
    Pair("MDU-C2/MARC-HT25", ("left_main.mod", "server.mod", "Server_functions.mod"), cups),
    Pair("Kyll-GRX/ABB-YuMi", ("brazo_L_v1.2.mod",), factory, "irb14000"),
    Pair("TuanPhamUTE/Voice", ("VoiceCtrlRobot_221013-153201",), voice),
    Pair("AndreiOp235/Licenta", ("R2400L_250225-145639",), serial),
    Pair("biingen/ABB_Robot_SSS", ("Module1_RobotAsServer.mod",), tester),
)


def main(folders: list[Path]) -> None:
    """Talk with every server that is in one of the folders."""
    for pair in PAIRS:
        has = [f for f in folders if all(any(f.rglob(pattern)) for pattern in pair.files)]
        folder = next((f for f in has if pair.repository.split("/")[0] in str(f)), None)
        if folder is None:
            continue
        try:
            with serving(folder, pair) as (controller, line):
                pair.talk(line, controller)
        except AssertionError as error:
            print(f"{pair.repository}: {str(error)[:600]}")
        else:
            print(f"{pair.repository}: talks")


if __name__ == "__main__":
    main([Path(word) for word in sys.argv[1:]])
