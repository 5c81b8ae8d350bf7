"""Trial: Keyence's CV-X modules in Alienspartner/ABB-and-Keyence.

    python -m tools.interop.keyence FOLDER

FOLDER is a checkout. The trial plays the camera to which two programs connect: the set-up, which
answers every command of the camera, and the operation, which picks along paths that the camera
plans. The modules are unchanged; a main of the trial calls the set-up.
"""

import math
import socket
import sys
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.rapid.switches import Switches
from rapidgen.system.model import ModuleFile, System, TaskSpec
from tools.interop.programs import furnished

PORT = 8500
MAIN = 'MODULE TrialMain\nPROC main()\n  KeyenceSetup "192.168.0.10", 8500;\nENDPROC\nENDMODULE\n'
START = [10, 20, -10, 0, 40, 5]


class Camera:
    """The camera's end of a connection: lines that end with a carriage return."""

    def __init__(self, server: socket.socket) -> None:
        self._link, _ = server.accept()
        self._link.settimeout(30)
        self._left = b""

    def send(self, text: str) -> None:
        """Send a line."""
        self._link.sendall(text.encode() + b"\r")

    def receive(self) -> str:
        """Return the next line."""
        while b"\r" not in self._left:
            more = self._link.recv(4096)
            assert more, "the robot has closed the connection"
            self._left += more
        line, _, self._left = self._left.partition(b"\r")
        return line.decode()

    def ended(self) -> bool:
        """True if the robot closes the connection next."""
        return not self._left and not self._link.recv(1)

    def close(self) -> None:
        """End the connection."""
        self._link.close()


def module(path: Path) -> ModuleFile:
    """Return a file as a module of a task."""
    return ModuleFile(path.stem, path.name, path.read_bytes())


@contextmanager
def running(*modules: ModuleFile):
    """Run a robot with these modules in real time; yield the camera."""
    task = TaskSpec("T_ROB1", motion=True, modules=modules)
    system = furnished(System("keyence", (task,)))
    with socket.create_server(("127.0.0.1", PORT)) as server:
        server.settimeout(30)
        robots = groups_for(system, load_config("irb1200").groups)
        # Its check sums have seven digits.
        dialect = Switches(whole_text="all")
        with VirtualController(
            system, robots, clock="real", speed=20, dialect=dialect
        ) as controller:
            controller.operator.subscribe(_tell)
            controller.start()
            camera = Camera(server)
            try:
                yield camera
            except (AssertionError, OSError) as error:
                where = controller.call(lambda: [*controller.where(), *map(str, controller.log)])
                raise AssertionError("\n".join(where)) from error
            finally:
                camera.close()


def _tell(_task: str, text: str) -> None:
    print("    pendant:", text)


def setup(folder: Path) -> None:
    """Send every command of the set-up."""
    parts = (module(folder / "KeyenceRobotVisionSetup.sys"),)
    with running(*parts, ModuleFile("TrialMain", "TrialMain.mod", MAIN.encode())) as camera:
        request = 0

        def ask(operation: int, *values: float) -> list[float]:
            nonlocal request
            request += 1
            numbers = [operation, request, *values]
            camera.send(",".join(["CRBT", *map(str, numbers), str(sum(numbers))]))
            reply = camera.receive().split(",")
            assert reply[0] == "CRBT", reply
            result = [float(word) for word in reply[1:]]
            assert result[:3] == [operation, request, 0], reply
            assert sum(result[:-1]) == result[-1], reply
            print("   ", operation, *values, "->", *reply[3:-1], "sum", reply[-1])
            return result[3:-1]

        assert ask(1, 7, 8) == [7, 8]
        ask(7)
        ask(2)
        ask(3, 0, 0, 0, 50, 100)
        assert ask(2)[3] == 50
        ask(3, 0, 0, 0, 100, 100)
        joints = ask(15, *(1000 * a for a in START), 0, 0)
        assert _near(joints, [1000 * a for a in START], 5), joints
        x, y, z, rx, ry, rz = ask(9)
        moved = ask(10, 0, 20_000, -10_000, 0, 0, 0, 0, 0)
        assert _near(moved, [x, y + 20_000, z - 10_000, rx, ry, rz], 20), moved
        back = ask(11, x, y, z, rx, ry, rz, 0, 0)
        assert _near(back, [x, y, z, rx, ry, rz], 20), back
        in_tool = ask(5, 0, 0, 5_000, 0, 0, 0, 0, 1)
        assert abs(math.dist(in_tool[:3], (x, y, z)) - 5_000) < 20, in_tool
        ask(6, x, y, z, round(rx / 100), round(ry / 100), round(rz / 100), 0, 0)
        ask(4)
        ask(8, 0)
        ask(12)
        ask(13, 0)
        assert ask(14, 5_000, 0, 0, 0, 0, 0, 0, 0)[0] > 0
    print("set-up: every command answered")


def _near(result: list[float], expected: list[float], by: float) -> bool:
    return all(abs(a - b) <= by for a, b in zip(result, expected, strict=True))


LEGS = (3, 2, 2)
"""Points of each leg; the last one of a leg is the first one of the next."""
WAY = [[10 + 4 * i, 20, -10 + i, 0, 40, 5 + 10 * i] for i in range(sum(LEGS) - len(LEGS) + 1)]


def operation(folder: Path) -> None:
    """Run two picks along planned paths, then report no object."""
    names = [p for p in sorted((folder / "CV-X_OperationProgram_ABB").glob("*.mod"))]
    modules = [module(folder / "KeyenceRobotVisionSetup.sys"), *map(module, names)]
    requested: list[str] = []
    with running(*modules) as camera:
        triggers, picks = 0, 2
        while (line := camera.receive()) != "T1" or triggers < 2 * picks:
            requested.append(line)
            if line == "T1":
                triggers += 1
                camera.send("T1")
                # The second trigger of a round is given on the way, for the next picture.
                if triggers % 2:
                    camera.send("1")
                continue
            camera.send(_planned(*map(int, line.split(",")[1:])).ljust(125, "#"))
        camera.send("T1")
        camera.send("0")
        assert camera.ended()
    assert len({line for line in requested if line.startswith("PPR,3,")}) == len(WAY)
    print(f"operation: {picks} picks, {len(requested)} requests answered, then no path")


def _planned(command: int, *arguments: int) -> str:
    """Check the reply to PPR: settings and planned path."""
    if command == 3:
        leg, point = arguments[2:4]
        place = sum(LEGS[:leg]) - leg + point
        return "PPR," + ",".join(f"{angle:+08.3f}" for angle in WAY[place])
    first = {23: 3, 19: 1, 21: -1, 0: 3, 16: 0, 18: 1}
    if command in first:
        return f"PPR,{first[command]}"
    if command == 25:
        return "PPR," + ",".join(f"{angle:+08.3f}" for angle in START)
    return "PPR," + ",".join(map(str, {24: (0, 1, 2), 22: (50, 80, 100), 2: LEGS}[command]))


TRIALS: tuple[Callable[[Path], None], ...] = (setup, operation)

if __name__ == "__main__":
    for trial in TRIALS:
        trial(Path(sys.argv[1]))
